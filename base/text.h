// Numbers and small text helpers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cnctrans {

/// Shortest decimal text that reads back to the same double; never an exponent ("0.0000001", not "1e-07"); "-0" is "0".
/// Values that are no numbers give "nan", "inf", "-inf".
std::string shortest(double value);
void append_shortest(std::string& out, double value);
/// At most `decimals` places (0 and more), rounded half away from zero, no trailing zeros, no exponent; "-0" is "0".
/// What is rounded is the shortest decimal text, as a person would: rounded(1.005, 2) is "1.01".
std::string rounded(double value, int decimals);
void append_rounded(std::string& out, double value, int decimals);
/// A decimal number such as "+5", ".5", "5.", "-0.5" that takes all of `text`; nullopt otherwise (also when it is out
/// of a double's range). No exponents.
std::optional<double> parse_decimal(std::string_view text);
std::string to_upper_ascii(std::string_view text);
std::string_view trim(std::string_view text);
bool iequals_ascii(std::string_view a, std::string_view b);

/// Writes a file through a temporary beside it and a rename: the old file, or the new one, never half of it. Keeps the
/// permissions of a file it replaces; writes through a symbolic link; a read-only file is refused. A target that is
/// no regular file (a pipe, /dev/null) is written directly.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();  ///< without commit() nothing is left behind
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  [[nodiscard]] bool open(std::string* error);
  [[nodiscard]] bool write(std::string_view bytes, std::string* error);
  [[nodiscard]] bool commit(std::string* error);

 private:
  bool flush(std::string* error);
  bool fail(std::string* error, const char* what);
  std::string path_;
  std::string target_;     ///< `path_` after symbolic links
  std::string temporary_;  ///< empty: written directly
  std::string buffer_;
  int fd_ = -1;
};

}  // namespace cnctrans
