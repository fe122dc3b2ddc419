// The commands of the executable. Each is one library call and the printing around it; each returns an exit status.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/source.h"

namespace cnctrans::cli {

class Messages;

/// Exit statuses of the contract (docs/trace.md).
enum Exit : int { ok = 0, refused = 1, usage = 2, limit_or_difference = 3, draft = 4 };

/// What the command line says; every command reads the fields it has options for.
struct Arguments {
  std::string from, to, dialect;
  std::string machine, target_machine, tools;
  std::vector<std::string> libraries;
  std::vector<std::string> inputs;
  std::string output;
  std::string unsupported = "error";
  std::string reader = "scanner";
  std::string numbering = "keep";
  std::int32_t number_step = 10;
  std::string encoding, eol;
  std::string cycles = "native";
  std::string structure = "keep";
  std::string report;
  std::string names;
  std::string diagnostics = "text";
  bool verify = false, no_verify = false;
  bool explore = false;
  int replays = 100;
  bool draft = false;
  bool annotate = false;
  bool no_origin = false;
  bool force = false;  ///< files that are not cnctrans's own are replaced
  bool quiet = false;
  std::vector<std::string> set;
  std::string skip;
  std::optional<std::uint64_t> max_events;  ///< else by command: 50 million, or 2 million where traces are kept
  std::uint64_t max_steps = 500'000'000;
  std::string trace, vars, written;
  bool json = false;
  bool places = false;
  std::string after_pass, only_pass;
  bool list_passes = false;
  std::string shell;
  bool stdio = false;
  std::string grammar;  ///< lsp: print the TextMate grammar of a dialect
  std::string color = "auto";
  std::string code;                                    ///< explain
  std::string profile_action, profile_name, language;  ///< profile; `language`: only options that this control reads
  SourcePtr standard_input;                            ///< what stands for the input "-"
  unsigned jobs = 1, timeout = 300;                    ///< batch: processes side by side; seconds for a program
  std::string shard;                                   ///< batch: "K/N"
  bool again = false, collect = false, reports = false;
  unsigned survey_jobs = 0;      ///< survey, names: processes side by side; 0: one a core
  bool status = false;           ///< project: look, translate nothing
  std::string stub;              ///< names: folder of the programs
  Messages* messages = nullptr;  ///< stderr of the call; set by main()
};

int convert(const Arguments& a);
int batch(const Arguments& a);
int run(const Arguments& a);
int verify(const Arguments& a);
int check(const Arguments& a);
int print_ir(const Arguments& a);
int list_dialects(const Arguments& a);
int explain(const Arguments& a);
int profile(const Arguments& a);
int language_server(const Arguments& a);
int survey(const Arguments& a);
int project(const Arguments& a);
int names(const Arguments& a);

}  // namespace cnctrans::cli
