// Source text: bytes as they came, their encoding and line ends, and lines to read them by. Nothing about CNC.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/span.h"

namespace cnctrans {

namespace os {
class ReadFile;
}

enum class Encoding : std::uint8_t { utf8, windows1252 };
enum class Eol : std::uint8_t { lf, crlf, cr };

/// One line of a source: text without its line end (NUL, ^Z, EOT inside are left to the reader).
struct SourceLine {
  std::string_view text;
  std::uint32_t number = 0;  ///< 1-based
  Eol eol = Eol::lf;
  bool has_eol = true;  ///< false only on a last line without a line end
};

/// A whole source file in memory (memory-mapped when it comes from disk). Bytes are never changed: comments and texts
/// keep their bytes. Lines are found on demand; LF, CRLF and CR are accepted, also mixed.
class SourceText {
 public:
  /// Opens a file; nullptr and a message in `error` when it can't be read.
  static std::shared_ptr<const SourceText> open(const std::string& path, std::string* error);
  static std::shared_ptr<const SourceText> from_string(std::string name, std::string bytes);
  /// Some lines of a text, in its order: `numbers` says which ones (1-based, ascending), `last` how many there are.
  static std::shared_ptr<const SourceText> from_lines(std::string name, std::string bytes,
                                                      std::vector<std::uint32_t> numbers, std::uint32_t last);

  ~SourceText();
  SourceText(const SourceText&) = delete;
  SourceText& operator=(const SourceText&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }  ///< path as given
  [[nodiscard]] std::string stem() const;                          ///< file name without folder and extension
  [[nodiscard]] std::string extension() const;                     ///< lower case, without the dot
  [[nodiscard]] std::string_view bytes() const { return bytes_; }  ///< everything, BOM included
  [[nodiscard]] std::string_view text() const;                     ///< bytes without a BOM
  [[nodiscard]] bool has_bom() const { return has_bom_; }
  [[nodiscard]] Encoding encoding() const { return encoding_; }  ///< UTF-8 when valid, else Windows-1252
  [[nodiscard]] Eol main_eol() const { return eol_; }            ///< of the first line that has one
  /// All lines of `text()`; built at the first call (safe from several threads). Lines may be left out (from_lines):
  /// `number` tells which one it is, not the place in the list.
  [[nodiscard]] const std::vector<SourceLine>& lines() const;
  /// Number of the last line, 0 when there is none.
  [[nodiscard]] std::uint32_t last_line() const;

  /// One line, empty when there is no such line (1-based).
  [[nodiscard]] std::string_view line_text(std::uint32_t number) const;

 private:
  SourceText() = default;
  void set_bytes(std::string_view bytes);
  std::string name_;
  std::string_view bytes_;
  std::string owned_;
  std::unique_ptr<os::ReadFile> file_;  ///< of the bytes; null: they are owned
  bool has_bom_ = false;
  Encoding encoding_ = Encoding::utf8;
  Eol eol_ = Eol::lf;
  std::vector<std::uint32_t> numbers_;  ///< of the lines; empty: all are here
  std::uint32_t last_ = 0;              ///< where some are not
  mutable std::vector<SourceLine> lines_;
  mutable std::once_flag lines_once_;
};
using SourcePtr = std::shared_ptr<const SourceText>;

/// Names and texts of the files that spans point into. Index 0 is "no file".
class FileTable {
 public:
  FileId add(SourcePtr source);
  /// A file known by name only (a stream, or text that is gone).
  FileId add_name(std::string name);
  /// Gives the text of a file that was added by name, so that diagnostics can show its lines.
  void attach(FileId id, SourcePtr source);
  [[nodiscard]] const std::string& name(FileId id) const;
  [[nodiscard]] const SourceText* source(FileId id) const;
  [[nodiscard]] SourcePtr source_ptr(FileId id) const;
  [[nodiscard]] std::size_t size() const { return files_.size(); }

 private:
  struct Entry {
    std::string name;
    SourcePtr source;
  };
  std::vector<Entry> files_{Entry{}};
};

/// Reads a file in windows of whole lines, so that memory stays flat whatever its size.
class LineWindowReader {
 public:
  explicit LineWindowReader(std::size_t window_bytes = 1U << 20U);
  ~LineWindowReader();
  LineWindowReader(const LineWindowReader&) = delete;
  LineWindowReader& operator=(const LineWindowReader&) = delete;

  [[nodiscard]] bool open(const std::string& path, std::string* error);
  /// The next window: whole lines, ending with a line end except at the end of the file. Empty at the end. The view is
  /// valid until the next call. A line longer than the window makes the window grow.
  std::string_view next();
  /// So many bytes at the end of the last window (whole lines) come again, at the begin of the next one.
  void give_back(std::size_t bytes);
  /// Why `next()` came to an early end; empty when it did not. To be asked after the last window.
  [[nodiscard]] const std::string& read_error() const;
  [[nodiscard]] std::size_t bytes_read() const;
  [[nodiscard]] std::size_t file_size() const;  ///< 0 when it is not a regular file

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Takes the next line off the front of `text` (LF, CRLF or CR end it) and counts `line.number` up by one. False, and
/// `line` unchanged, when `text` is empty.
bool take_line(std::string_view& text, SourceLine& line);

/// Well-formed UTF-8 (no overlong forms, no surrogates, nothing above U+10FFFF). ASCII runs at memory speed.
bool valid_utf8(std::string_view bytes);
/// Length in bytes (1-4) of the well-formed UTF-8 character at the front of `bytes`; 0 when there is none.
std::size_t utf8_length(std::string_view bytes, char32_t* code_point = nullptr);
/// Windows-1252 <-> UTF-8. Undefined bytes map to their C1 code point, so the round trip is exact.
std::string windows1252_to_utf8(std::string_view bytes);
/// nullopt when a character does not exist there; `bad` gets its byte offset.
std::optional<std::string> utf8_to_windows1252(std::string_view text, std::size_t* bad = nullptr);
/// `text` as it is when valid UTF-8, else read as Windows-1252.
std::string to_utf8(std::string_view text);
std::string_view eol_text(Eol eol);

}  // namespace cnctrans
