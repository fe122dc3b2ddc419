/* Carries a program out and prints what the machine does, one event a line.
 * usage: trace DIALECT PROGRAM */
#include <stdio.h>

#include "cnctrans/cnctrans.h"

static void print_event(void* user, const char* json, size_t size) {
  (void)user;
  fwrite(json, 1, size, stdout);
  putchar('\n');
}

int main(int argc, char** argv) {
  if (argc != 3) return CNCTRANS_USAGE;
  cnctrans_job* job = cnctrans_job_new();
  cnctrans_job_set(job, "dialect", argv[1]);
  cnctrans_result* result = cnctrans_run(job, argv[2], NULL, 0, print_event, NULL);

  cnctrans_diagnostic d;
  for (size_t i = 0; cnctrans_result_diagnostic(result, i, &d); ++i) fputs(d.shown, stderr);
  if (cnctrans_result_error(result)[0] != '\0') fprintf(stderr, "%s\n", cnctrans_result_error(result));

  const cnctrans_status status = cnctrans_result_status(result);
  cnctrans_result_free(result);
  cnctrans_job_free(job);
  return (int)status;
}
