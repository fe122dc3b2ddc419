#include "cli/common.h"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>

namespace cnctrans::cli {

namespace {

/// A verification keeps both traces in memory: about 0.5 kB an event.
constexpr std::uint64_t kept_events = 2'000'000;

bool run_limits(const Arguments& a, interpreter::Options& run) {
  const auto* dialect = translator::find_dialect(a.dialect.empty() ? a.from : a.dialect);
  if (a.max_events) run.max_events = *a.max_events;
  run.max_steps = a.max_steps;
  for (const auto& item : a.set) {
    const auto equals = item.find('=');
    if (equals == std::string::npos || equals == 0) {
      usage_error("--set wants NAME=VALUE, not '" + item + "'");
      return false;
    }
    run.set.emplace_back(item.substr(0, equals), item.substr(equals + 1));
  }
  std::string_view levels = a.skip;
  while (!levels.empty()) {
    unsigned level = 0;
    const auto [end, error] = std::from_chars(levels.data(), levels.data() + levels.size(), level);
    if (error != std::errc{} || level > 15) {
      usage_error("--skip wants levels such as 0,3 and not '" + a.skip + "'");
      return false;
    }
    // A mark without a number is that of the first switch, whatever its number: 0 always means it.
    const unsigned first = dialect != nullptr ? static_cast<unsigned>(dialect->first_skip_switch) : 0;
    run.skip_mask = static_cast<std::uint16_t>(run.skip_mask | (1U << (level > first ? level - first : 0)));
    levels.remove_prefix(static_cast<std::size_t>(end - levels.data()));
    if (!levels.empty() && levels.front() == ',') levels.remove_prefix(1);
  }
  return true;
}

frontends::Reader reader_of(const Arguments& a) {
  if (a.reader == "antlr") return frontends::Reader::antlr;
  return a.reader == "both" ? frontends::Reader::both : frontends::Reader::scanner;
}

}  // namespace

bool translate_options(const Arguments& a, translator::TranslateOptions& out) {
  out.from = a.from;
  out.to = a.to;
  out.machine = a.machine;
  out.target_machine = a.target_machine;
  out.libraries = a.libraries;
  out.reader = reader_of(a);
  out.verify = a.verify;
  out.annotate = a.annotate;
  out.number_step = a.number_step;
  if (a.unsupported == "warn") out.unsupported = backends::Unsupported::warn;
  if (a.unsupported == "comment") out.unsupported = backends::Unsupported::comment;
  if (a.numbering == "none") out.numbering = backends::Numbering::none;
  if (a.numbering == "renumber") out.numbering = backends::Numbering::renumber;
  if (a.cycles == "explode") out.cycles = ir::CycleWriting::explode;
  out.raise_structure = a.structure == "raise";
  if (a.encoding == "utf-8") out.encoding = Encoding::utf8;
  if (a.encoding == "windows-1252") out.encoding = Encoding::windows1252;
  if (a.eol == "lf") out.eol = Eol::lf;
  if (a.eol == "crlf") out.eol = Eol::crlf;
  if (a.eol == "cr") out.eol = Eol::cr;
  out.run.max_events = kept_events;
  return run_limits(a, out.run);
}

bool run_options(const Arguments& a, translator::RunOptions& out) {
  out.dialect = a.dialect;
  out.machine = a.machine;
  out.libraries = a.libraries;
  out.reader = reader_of(a);
  return run_limits(a, out.run);
}

void print_diagnostics(const Arguments& a, const Diagnostics& diagnostics, const FileTable& files) {
  if (diagnostics.empty() && a.diagnostics != "json") return;
  const std::string text = a.diagnostics == "json" ? render_json(diagnostics, files) + "\n"
                                                   : render_text(diagnostics, files, isatty(STDERR_FILENO) != 0);
  write_all(stderr, text);
}

int usage_error(std::string_view message) {
  const std::string text = "cnctrans: " + std::string(message) + "\nTry 'cnctrans --help'.\n";
  write_all(stderr, text);
  return usage;
}

bool stdout_arrived(std::string* why) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  if (why != nullptr && errno != 0) *why = std::string(": ") + std::strerror(errno);
  return false;
}

bool write_all(std::FILE* file, std::string_view bytes) {
  return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
}

ProgressLine::ProgressLine(std::string label)
    : label_(std::move(label)), terminal_(isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()) {}

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
