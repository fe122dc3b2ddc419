/* The C interface of cnctrans: the same as api.h for C, and for every language that calls C.
 *
 * A job holds options; a call with a job and a program gives a result, which is asked and freed. Texts that a result
 * hands out last as long as the result. Functions may be called from several threads, one thread to a job at a time.
 * Null is taken as an empty text; a null job or result is a job without options, an empty result. */
#ifndef CNCTRANS_CNCTRANS_H
#define CNCTRANS_CNCTRANS_H

#include <stddef.h>

#include "cnctrans/export.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The exit statuses of the command. */
typedef enum cnctrans_status {
  CNCTRANS_OK = 0,
  CNCTRANS_REFUSED = 1, /* errors: nothing was written, or the program stopped with an error */
  CNCTRANS_USAGE = 2,   /* an option, a dialect, a machine or a file that does not exist */
  CNCTRANS_DIFFERS = 3  /* not verified, or stopped by a limit */
} cnctrans_status;

typedef enum cnctrans_severity { CNCTRANS_NOTE = 0, CNCTRANS_WARNING = 1, CNCTRANS_ERROR = 2 } cnctrans_severity;

typedef struct cnctrans_job cnctrans_job;
typedef struct cnctrans_result cnctrans_result;

/* "0.2.0" */
CNCTRANS_API const char* cnctrans_version(void);

/* Null when there is no memory. */
CNCTRANS_API cnctrans_job* cnctrans_job_new(void);
CNCTRANS_API void cnctrans_job_free(cnctrans_job* job);
/* An option under its name on the command line without the dashes: "from", "to", "dialect", "machine",
 * "target-machine", "lib", "set" (NAME=VALUE), "skip" (0,3), "unsupported", "numbering", "number-step", "cycles",
 * "structure", "annotate" (1 or 0), "origin" (1 or 0), "verify" (1: what can't be replayed is refused; 0: as
 * "no-verify"), "no-verify" (1: without a proof), "explore" (most replays), "one-file", "encoding", "eol",
 * "max-events".
 * "lib" and "set" add, the others replace. CNCTRANS_USAGE: there is no such option, or it does not take this value. */
CNCTRANS_API cnctrans_status cnctrans_job_set(cnctrans_job* job, const char* option, const char* value);
/* A program in memory that may be called; `name` as a file's. */
CNCTRANS_API cnctrans_status cnctrans_job_add_program(cnctrans_job* job, const char* name, const char* bytes,
                                                      size_t size);

/* A program: the file `name`, or, where `bytes` is not null, this text under the name of a file. Every call gives a
 * result, null only when there is no memory. */
CNCTRANS_API cnctrans_result* cnctrans_translate(const cnctrans_job* job, const char* name, const char* bytes,
                                                 size_t size);
CNCTRANS_API cnctrans_result* cnctrans_check(const cnctrans_job* job, const char* name, const char* bytes, size_t size);
/* Gets one event as JSON in one line; `json` is not ended by a null byte and lasts for the call. */
typedef void (*cnctrans_event_sink)(void* user, const char* json, size_t size);
CNCTRANS_API cnctrans_result* cnctrans_run(const cnctrans_job* job, const char* name, const char* bytes, size_t size,
                                           cnctrans_event_sink sink, void* user);
/* Compares the file `source` with a translation, the file `target`, made by anyone; further programs of the
 * translation are found in its folder. */
CNCTRANS_API cnctrans_result* cnctrans_verify(const cnctrans_job* job, const char* source, const char* target);
CNCTRANS_API void cnctrans_result_free(cnctrans_result* result);

CNCTRANS_API cnctrans_status cnctrans_result_status(const cnctrans_result* result);
/* With CNCTRANS_USAGE: what is wrong. Else empty. */
CNCTRANS_API const char* cnctrans_result_error(const cnctrans_result* result);
/* Of a comparison or a translation, as the command prints it: "verified: ...", "not verified: ...", "not proved:
 * ...". Empty: no proof was asked for, or nothing was translated. */
CNCTRANS_API const char* cnctrans_result_verdict(const cnctrans_result* result);

/* The programs of a translation, the main program first. There also where the status is CNCTRANS_DIFFERS: not to be
 * cut with. An index out of range: null. */
CNCTRANS_API size_t cnctrans_result_output_count(const cnctrans_result* result);
CNCTRANS_API const char* cnctrans_result_output_name(const cnctrans_result* result, size_t index);
CNCTRANS_API const char* cnctrans_result_output_bytes(const cnctrans_result* result, size_t index, size_t* size);

typedef struct cnctrans_diagnostic {
  cnctrans_severity severity;
  const char* code;
  const char* file;
  unsigned line, column, end_line, end_column; /* from 1 on; line 0: nowhere in particular */
  const char* message;
  const char* hint;  /* may be empty */
  const char* shown; /* as the command prints it */
} cnctrans_diagnostic;
CNCTRANS_API size_t cnctrans_result_diagnostic_count(const cnctrans_result* result);
/* 1: filled in; 0: no such index. */
CNCTRANS_API int cnctrans_result_diagnostic(const cnctrans_result* result, size_t index, cnctrans_diagnostic* out);

#ifdef __cplusplus
}
#endif

#endif
