// What several commands need: turning arguments into library options, printing diagnostics, progress.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "cli/commands.h"
#include "cli/messages.h"
#include "translator/pipeline.h"

namespace cnctrans::cli {

/// What the outcome of a verification is to the caller: 1 when it could not be made, 3 when it found a difference.
int exit_of(const verifier::Verdict& verdict);
/// False and a message on stderr when an argument is not usable.
bool translate_options(const Arguments& a, translator::TranslateOptions& out);
/// The same for a command that makes translations: with the proof that it is to have.
bool proved_options(const Arguments& a, translator::TranslateOptions& out);
/// The names that the machine defines by "sizes" of a names file. False, and the reason is said: its control has none.
bool add_definitions(const Arguments& a, const translator::Names& names, translator::InputOptions& out);
bool run_options(const Arguments& a, translator::RunOptions& out);
/// Says on stderr why the call can't be done; the exit status for it.
int usage_error(const Arguments& a, std::string_view message);
/// A file that an option names for writing.
struct OutputOption {
  std::string option, path;
};
/// Why these files can't be written: one of them is among `read`, or two are the same. Empty: they can.
std::string output_conflict(const std::vector<OutputOption>& outputs, const std::vector<std::string>& read);
/// What --machine and --target-machine name.
std::vector<std::string> machine_files(const Arguments& a);
/// The path names a file that `files` were read from.
bool was_read(const std::string& path, const FileTable& files);
/// The program that an argument names: a file, or (`-`) what came on standard input.
translator::Input input_of(const Arguments& a, const std::string& name);
/// What --color and NO_COLOR say of a stream.
bool coloured(const Arguments& a, std::FILE* stream);
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
