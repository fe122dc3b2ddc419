#include "cli/common.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "base/os/os.h"
#include "translator/option_words.h"

namespace cnctrans::cli {

namespace fs = std::filesystem;

namespace {

/// What is taken as given but is most often a slip.
void say_doubts(const Arguments& a) {
  std::error_code ignored;
  for (const auto& folder : a.libraries) {
    if (!fs::exists(folder, ignored))
      a.messages->say(Severity::warning, "CNC-LIB",
                      "cnctrans: warning: --lib " + folder + ": there is no such folder or file");
  }
}

bool run_limits(const Arguments& a, interpreter::Options& run) {
  if (a.max_events) run.max_events = *a.max_events;
  run.max_steps = a.max_steps;
  for (const auto& item : a.set) {
    if (translator::add_setting(run, item)) continue;
    usage_error(a, "--set wants NAME=VALUE, not '" + item + "'");
    return false;
  }
  say_doubts(a);
  if (translator::add_skips(run, a.skip, translator::find_dialect(a.dialect.empty() ? a.from : a.dialect))) return true;
  usage_error(a, "--skip wants levels such as 0,3 and not '" + a.skip + "'");
  return false;
}

}  // namespace

bool translate_options(const Arguments& a, translator::TranslateOptions& out) {
  out.from = a.from;
  out.to = a.to;
  out.machine = a.machine;
  out.target_machine = a.target_machine;
  out.libraries = a.libraries;
  out.tools = a.tools;
  if (a.explore) out.further.explore = static_cast<std::size_t>(a.replays);
  out.annotate = a.annotate;
  out.origin = !a.no_origin;
  out.draft = a.draft;
  out.number_step = a.number_step;
  const std::pair<std::string_view, std::string_view> words[] = {
      {"reader", a.reader}, {"unsupported", a.unsupported}, {"numbering", a.numbering},
      {"cycles", a.cycles}, {"structure", a.structure},     {"encoding", a.encoding},
      {"eol", a.eol}};
  for (const auto& [option, word] : words) translator::set_word(out, option, word);  // the command line was checked
  if (a.draft) out.unsupported = backends::Unsupported::comment;
  out.run.max_events = translator::kept_events;
  return run_limits(a, out.run);
}

bool proved_options(const Arguments& a, translator::TranslateOptions& out) {
  const bool asked = a.verify || a.explore;
  if (asked && a.no_verify) {
    usage_error(a, std::string(a.verify ? "--verify" : "--explore") + " and --no-verify contradict each other");
    return false;
  }
  if (!translate_options(a, out)) return false;
  if (a.no_verify) return true;
  const translator::FurtherReplays asked_for = out.further;
  translator::prove_as_usual(out);
  out.strict = asked;
  if (a.explore) out.further = asked_for;
  return true;
}

bool add_definitions(const Arguments& a, const translator::Names& names, translator::InputOptions& out) {
  std::string error;
  if (SourcePtr text = translator::definitions_of(names, a.from, a.names, &error)) out.definitions.push_back(text);
  if (!error.empty()) usage_error(a, error);
  return error.empty();
}

bool run_options(const Arguments& a, translator::RunOptions& out) {
  translator::TranslateOptions words;
  translator::set_word(words, "reader", a.reader);
  out.dialect = a.dialect;
  out.machine = a.machine;
  out.libraries = a.libraries;
  out.tools = a.tools;
  out.reader = words.reader;
  return run_limits(a, out.run);
}

int usage_error(const Arguments& a, std::string_view message) {
  a.messages->say(Severity::error, "CNC-USAGE", "cnctrans: " + std::string(message));
  if (a.diagnostics != "json") write_all(stderr, "Try 'cnctrans --help'.\n");
  return usage;
}

namespace {

/// Files of one name, or one file by several. Pipes and devices can be named as often as one likes.
bool same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  if (fs::exists(a, ignored) && !fs::is_regular_file(a, ignored)) return false;
  return fs::equivalent(a, b, ignored) ||
         fs::weakly_canonical(fs::absolute(a), ignored) == fs::weakly_canonical(fs::absolute(b), ignored);
}

}  // namespace

int exit_of(const verifier::Verdict& verdict) {
  if (verdict.good()) return ok;
  return verdict.status == verifier::Status::differs || verdict.target_stopped ? limit_or_difference : refused;
}

std::vector<std::string> machine_files(const Arguments& a) {
  std::vector<std::string> list;
  for (const auto& file : {a.machine, a.target_machine, a.tools}) {
    if (!file.empty()) list.push_back(file);
  }
  return list;
}

std::string output_conflict(const std::vector<OutputOption>& outputs, const std::vector<std::string>& read) {
  for (auto it = outputs.begin(); it != outputs.end(); ++it) {
    if (it->path.empty() || it->path == "-") continue;
    for (const auto& input : read) {
      if (same_file(it->path, input)) return it->option + " " + it->path + " would write over a file that is read";
    }
    for (auto other = outputs.begin(); other != it; ++other) {
      if (!other->path.empty() && other->path != "-" && same_file(it->path, other->path))
        return other->option + " and " + it->option + " name the same file: " + it->path;
    }
  }
  return {};
}

bool was_read(const std::string& path, const FileTable& files) {
  for (FileId i = 1; i < files.size(); ++i) {
    if (same_file(path, files.name(i))) return true;
  }
  return false;
}

bool stdout_arrived(std::string* why) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  if (why != nullptr && errno != 0) *why = std::string(": ") + std::strerror(errno);
  return false;
}

translator::Input input_of(const Arguments& a, const std::string& name) {
  return name == "-" ? translator::Input(a.standard_input) : translator::Input(name);
}

bool coloured(const Arguments& a, std::FILE* stream) {
  if (a.color != "auto") return a.color == "always";
  const char* no = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool plain = (no != nullptr && *no != '\0') || (terminal != nullptr && std::string_view(terminal) == "dumb");
  return !plain && os::is_terminal(stream);
}

bool write_all(std::FILE* file, std::string_view bytes) {
  return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
}

ProgressLine::ProgressLine(std::string label)
    : label_(std::move(label)), terminal_(os::is_terminal(stderr)), start_(std::chrono::steady_clock::now()) {}

ProgressLine::~ProgressLine() {
  if (shown_) write_all(stderr, "\r\x1b[K");
}

void ProgressLine::operator()(double part) {
  if (!terminal_) return;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const int percent = static_cast<int>(part * 100);
  if (seconds < 1 || percent == last_percent_) return;
  last_percent_ = percent;
  shown_ = true;
  const double left = part > 0 ? seconds / part - seconds : 0;
  char line[160];
  const int n = std::snprintf(line, sizeof line, "\r\x1b[K%.80s %3d%%  %.0f s left", label_.c_str(), percent, left);
  if (n > 0) write_all(stderr, std::string_view(line, static_cast<std::size_t>(n)));
}

}  // namespace cnctrans::cli
