// A short sum of bytes, to tell whether a file is still the one that was seen before.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cnctrans {

/// FNV-1a, 64 bits, in pieces as the bytes come.
class Sum {
 public:
  void add(std::string_view bytes);
  /// 16 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t h_ = 14695981039346656037ULL;
};

std::string sum_of(std::string_view bytes);
/// Of a file's bytes; empty when it can't be read.
std::string sum_of_file(const std::string& path);

}  // namespace cnctrans
