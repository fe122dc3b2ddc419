#include "base/diagnostics.h"

#include <algorithm>
#include <utility>

namespace cnctrans {

void MoreDiagnostics::add(Severity s, const Span& span) {
  severity = std::max(severity, s);
  ++count;
  if (span.known()) add_lines({span.file, span.line, std::max(span.line, span.end_line)});
}

void MoreDiagnostics::add_lines(const Lines& range) {
  if (!lines.empty() && lines.back().file == range.file && range.first >= lines.back().first &&
      range.first <= lines.back().last + 1) {
    lines.back().last = std::max(lines.back().last, range.last);
  } else if (lines.size() < max_ranges) {
    lines.push_back(range);
  } else {
    lines_complete = false;
  }
}

void Diagnostics::add(Diagnostic d) {
  errors_ += d.severity == Severity::error ? 1 : 0;
  warnings_ += d.severity == Severity::warning ? 1 : 0;
  // The pieces of one block often say the same of it one behind the other: once is enough to read.
  constexpr std::ptrdiff_t looked_back = 16;
  const auto first = list_.end() - std::min(looked_back, std::ssize(list_));
  if (d.span.known() && std::find(first, list_.end(), d) != list_.end()) return;
  auto& kept = kept_[d.code];
  const bool same_line = d.span.known() && d.span.file == kept.line.file && d.span.line == kept.line.line;
  kept.on_line = same_line ? kept.on_line + 1 : 1;
  kept.line = d.span;
  if (kept.count < limit_ && kept.on_line <= line_limit) {
    ++kept.count;
    list_.push_back(std::move(d));
    return;
  }
  auto [it, fresh] = more_.try_emplace(d.code);
  if (fresh) it->second.severity = d.severity;
  it->second.add(d.severity, d.span);
}

void Diagnostics::error(std::string_view code, Span span, std::string message, std::string hint) {
  add({std::string(code), Severity::error, span, std::move(message), std::move(hint)});
}

void Diagnostics::warning(std::string_view code, Span span, std::string message, std::string hint) {
  add({std::string(code), Severity::warning, span, std::move(message), std::move(hint)});
}

void Diagnostics::note(std::string_view code, Span span, std::string message, std::string hint) {
  add({std::string(code), Severity::note, span, std::move(message), std::move(hint)});
}

void Diagnostics::clear() {
  *this = Diagnostics(limit_);
}

void Diagnostics::append(const Diagnostics& other) {
  if (&other == this) {  // its own list would grow under the loop
    append(Diagnostics(other));
    return;
  }
  // Those of the other that were only counted are not in its list, but are in its counts.
  std::size_t errors = errors_ + other.errors_;
  std::size_t warnings = warnings_ + other.warnings_;
  for (const Diagnostic& d : other.list_) add(d);
  for (const auto& [code, theirs] : other.more_) {
    auto [it, fresh] = more_.try_emplace(code, theirs);
    if (fresh) continue;
    MoreDiagnostics& ours = it->second;
    ours.severity = std::max(ours.severity, theirs.severity);
    ours.count += theirs.count;
    ours.lines_complete = ours.lines_complete && theirs.lines_complete;
    for (const auto& range : theirs.lines) ours.add_lines(range);
  }
  errors_ = errors;
  warnings_ = warnings;
}

}  // namespace cnctrans
