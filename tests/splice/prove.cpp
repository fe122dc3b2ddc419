#include "tests/splice/prove.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "translator/pipeline.h"

namespace cnctrans::splice {

namespace {

constexpr std::uint64_t most_events = 4000, most_steps = 100'000, most_silent = 10'000;
constexpr std::size_t replays = 20;

void limit(interpreter::Options& run) {
  run.max_events = most_events;
  run.max_steps = most_steps;
  run.max_silent_steps = most_silent;
}

/// Counts the moves and forgets them.
class Moves : public interpreter::TraceSink {
 public:
  explicit Moves(std::size_t& count) : count_(count) {}
  void on_event(const interpreter::Event& e) override {
    using interpreter::EventKind;
    if (e.kind == EventKind::rapid || e.kind == EventKind::linear || e.kind == EventKind::arc) ++count_;
  }

 private:
  std::size_t& count_;
};

/// Digits and what follows from them go; what is left names the kind of the difference.
std::string without_numbers(const std::string& text) {
  std::string out;
  for (const char c : text.substr(0, text.find('\n'))) {
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-') {
      if (out.empty() || out.back() != '#') out += '#';
    } else {
      out += c;
    }
  }
  return out;
}

/// Warnings that stand at a line for another reason than its moves: they foretell a difference only in what they speak
/// of (part of its kind; empty: in nothing that a trace shows).
struct Narrow {
  std::string_view code, about;
};
constexpr std::array<Narrow, 3> narrow = {{{"TRN-159", "feed"}, {"TRN-392", ""}, {"TRN-394", ""}}};
/// Said once for all moves up to the next word of an offset, or once for the program.
constexpr std::array<Narrow, 2> lasting = {{{"TRN-522", "tool offset"}, {"TRN-210", "feed"}}};

/// A word D stands behind line `from` (counted from 1), at `to` or before, and no switch leaves it out.
bool has_offset_word(const Program& p, std::uint32_t from, std::uint32_t to) {
  for (std::size_t i = from; i < std::min<std::size_t>(to, p.lines.size()); ++i) {
    const std::string& line = p.lines[i];
    if (line.rfind('/', 0) == 0) continue;
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const bool begins = k == 0 || std::isalpha(static_cast<unsigned char>(line[k - 1])) == 0;
      if (line[k] == 'D' && begins && std::isdigit(static_cast<unsigned char>(line[k + 1])) != 0) return true;
    }
  }
  return false;
}

bool foretells(const Program& p, const Diagnostic& d, const std::string& kind, FileId file, std::uint32_t line) {
  if (d.severity != Severity::warning || !d.span.known() || d.span.file != file) return false;
  const auto says = [&](const Narrow& n) {
    return n.code == d.code && !n.about.empty() && kind.find(n.about) != std::string::npos;
  };
  if (line >= d.span.line && std::any_of(lasting.begin(), lasting.end(), says) &&
      !has_offset_word(p, d.span.line, line))
    return true;
  if (line < d.span.line || line > std::max(d.span.line, d.span.end_line)) return false;
  return std::none_of(narrow.begin(), narrow.end(), [&](const Narrow& n) { return n.code == d.code; }) ||
         std::any_of(narrow.begin(), narrow.end(), says);
}

/// The lines of the source that the first difference stands at: that of the source's event, and the one that the line
/// of the translation's event was written for.
std::vector<std::pair<FileId, std::uint32_t>> lines_of(const translator::TranslateResult& r) {
  const auto& d = r.verdict.difference;
  std::vector<std::pair<FileId, std::uint32_t>> lines{{d.source_file, d.source_line}};
  if (d.target_file > 0 && d.target_file <= r.outputs.size()) {
    const auto& map = r.outputs[d.target_file - 1].map.lines;
    if (d.target_line > 0 && d.target_line <= map.size())
      lines.emplace_back(map[d.target_line - 1].file, map[d.target_line - 1].line);
  }
  return lines;
}

Outcome judged(const Program& p, const translator::TranslateResult& r) {
  Outcome out;
  if (r.refused || !r.error.empty()) {
    out.fate = Fate::refused;
    return out;
  }
  const auto& v = r.verdict;
  if (v.good()) {
    out.fate = Fate::equal;
    return out;
  }
  out.said = verifier::describe(v, r.files, r.target_files);
  if (v.status != verifier::Status::differs && !v.target_stopped) {
    out.fate = Fate::not_replayed;
    return out;
  }
  out.kind = without_numbers(v.status == verifier::Status::differs ? v.difference.what : v.reason);
  for (const auto& d : r.diagnostics.all()) {
    for (const auto& [file, line] : lines_of(r)) {
      if (foretells(p, d, out.kind, file, line)) out.codes.insert(d.code);
    }
  }
  out.fate = out.codes.empty() ? Fate::silent : Fate::foretold;
  return out;
}

}  // namespace

bool valid(const Program& p) {
  translator::RunOptions options;
  options.dialect = p.dialect;
  options.machine = p.machine();
  limit(options.run);
  const translator::Input input(SourceText::from_string(p.file_name(), p.text()));
  const auto read = translator::check(input, options);
  if (!read.error.empty() || read.diagnostics.has_errors()) return false;
  std::size_t moves = 0;
  const auto run =
      translator::run(input, options, [&](const auto&, const auto&) { return std::make_unique<Moves>(moves); });
  return run.error.empty() && run.result.reason == interpreter::EndReason::program_end && moves > 0;
}

Outcome prove(const Program& p, const std::string& to) {
  translator::TranslateOptions options;
  options.from = p.dialect;
  options.to = to;
  options.machine = p.machine();
  options.verify = true;
  options.further = {true, replays, std::nullopt};
  limit(options.run);
  return judged(p, translator::translate(SourceText::from_string(p.file_name(), p.text()), options));
}

std::string command(const Program& p, const std::string& to) {
  return "cnctrans --from " + p.dialect + " --to " + to + " --machine " + p.machine() + " --explore --replays " +
         std::to_string(replays) + " --max-events " + std::to_string(most_events) + " -o - " + p.file_name();
}

}  // namespace cnctrans::splice
