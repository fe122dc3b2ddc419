// Diagnostics: stable codes, a place, what happens and what to do. Nothing about CNC.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/span.h"

namespace cnctrans {

class FileTable;

enum class Severity : std::uint8_t { note, warning, error };

/// One finding. `code` is stable ("FAG-012", "TRN-003") and has a paragraph in docs/diagnostics.md.
struct Diagnostic {
  std::string code;
  Severity severity = Severity::error;
  Span span;
  std::string message;  ///< what is the matter, and what happens because of it
  std::string hint;     ///< what to do; may be empty

  bool operator==(const Diagnostic&) const = default;
};

/// What became of the diagnostics of one code after its limit was reached: how many, and on which lines.
struct MoreDiagnostics {
  struct Lines {
    FileId file = 0;
    std::uint32_t first = 0;  ///< 1-based
    std::uint32_t last = 0;   ///< inclusive
    bool operator==(const Lines&) const = default;
  };
  Severity severity = Severity::error;  ///< the gravest of them
  std::size_t count = 0;
  std::vector<Lines> lines;  ///< in order of arrival, neighbours joined, at most `max_ranges`
  bool lines_complete = true;

  static constexpr std::size_t max_ranges = 100;
  void add(Severity s, const Span& span);
  void add_lines(const Lines& range);
};

/// Collects diagnostics in order. Never throws. Keeps all of them up to `limit` of each code, and up to `line_limit` of
/// each code on one line; further ones of that code are counted with their lines, and the renderers say how many and
/// where. The counts count all.
class Diagnostics {
 public:
  static constexpr std::size_t line_limit = 10;

  explicit Diagnostics(std::size_t limit = 200) : limit_(limit) {}
  void add(Diagnostic d);
  void error(std::string_view code, Span span, std::string message, std::string hint = {});
  void warning(std::string_view code, Span span, std::string message, std::string hint = {});
  void note(std::string_view code, Span span, std::string message, std::string hint = {});

  [[nodiscard]] const std::deque<Diagnostic>& all() const { return list_; }
  [[nodiscard]] bool has_errors() const { return errors_ != 0; }
  [[nodiscard]] std::size_t error_count() const { return errors_; }
  [[nodiscard]] std::size_t warning_count() const { return warnings_; }
  [[nodiscard]] bool empty() const { return list_.empty(); }
  /// Those that were counted only, by code.
  [[nodiscard]] const std::map<std::string, MoreDiagnostics, std::less<>>& more() const { return more_; }
  void clear();
  void append(const Diagnostics& other);

 private:
  std::size_t limit_;
  std::deque<Diagnostic> list_;
  struct Kept {
    std::size_t count = 0;
    Span line;                ///< of the last one
    std::size_t on_line = 0;  ///< in a row on that line
  };
  std::map<std::string, Kept, std::less<>> kept_;
  std::map<std::string, MoreDiagnostics, std::less<>> more_;
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
};

std::string_view severity_text(Severity s);  ///< "note", "warning", "error"

/// Text for people, ends with a line end: `file:line:column: error CODE: message`, then the source line as UTF-8
/// (control bytes as '.', cut around the place when it is longer than 160 columns), a line with `^~~~` under the span,
/// and `  hint: ...`. The source lines are left out when the file table has only the file's name. The column counts
/// bytes.
std::string render_text(const Diagnostic& d, const FileTable& files, bool colour = false);
std::string render_text(const Diagnostics& ds, const FileTable& files, bool colour = false);
/// JSON for tools: an array of {code, severity, file, line, column, end_line, end_column, message, hint}; codes that
/// ran over the limit end it with {code, severity, more, message} each.
std::string render_json(const Diagnostics& ds, const FileTable& files);

}  // namespace cnctrans
