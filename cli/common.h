// What several commands need: turning arguments into library options, printing diagnostics, progress.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "cli/commands.h"
#include "translator/pipeline.h"

namespace cnctrans::cli {

/// False and a message on stderr when an argument is not usable.
bool translate_options(const Arguments& a, translator::TranslateOptions& out);
bool run_options(const Arguments& a, translator::RunOptions& out);
/// Prints to stderr, as text (coloured on a terminal) or JSON.
void print_diagnostics(const Arguments& a, const Diagnostics& diagnostics, const FileTable& files);
int usage_error(std::string_view message);
bool write_all(std::FILE* file, std::string_view bytes);
/// What was printed on standard output has arrived. False when it has not (a full disk): main() says so at the end.
bool stdout_arrived(std::string* why = nullptr);

/// A progress line on stderr for jobs over a second, on a terminal only.
class ProgressLine {
 public:
  explicit ProgressLine(std::string label);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void operator()(double part);

 private:
  std::string label_;
  bool terminal_;
  bool shown_ = false;
  int last_percent_ = -1;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace cnctrans::cli
