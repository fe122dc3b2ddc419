// Diagnostics: stable codes, a place, what happens and what to do. Nothing about CNC.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
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

/// Collects diagnostics in order. Never throws. Keeps all of them up to `limit` of each code (further ones of that
/// code are counted, and `render_text` says how many).
class Diagnostics {
 public:
  void add(Diagnostic d);
  void error(std::string_view code, Span span, std::string message, std::string hint = {});
  void warning(std::string_view code, Span span, std::string message, std::string hint = {});
  void note(std::string_view code, Span span, std::string message, std::string hint = {});

  [[nodiscard]] const std::deque<Diagnostic>& all() const { return list_; }
  [[nodiscard]] bool has_errors() const { return errors_ != 0; }
  [[nodiscard]] std::size_t error_count() const { return errors_; }
  [[nodiscard]] std::size_t warning_count() const { return warnings_; }
  [[nodiscard]] bool empty() const { return list_.empty(); }
  void clear();
  void append(const Diagnostics& other);

 private:
  std::deque<Diagnostic> list_;
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
};

/// Text for people: `file:line:column: error CODE: message`, the source line, carets, the hint.
std::string render_text(const Diagnostic& d, const FileTable& files, bool colour = false);
std::string render_text(const Diagnostics& ds, const FileTable& files, bool colour = false);
/// JSON for tools: an array of {code, severity, file, line, column, end_line, end_column, message, hint}.
std::string render_json(const Diagnostics& ds, const FileTable& files);

}  // namespace cnctrans
