// Lines that say nothing but where to go, and which two of them are alike: same words in the same order, same codes of
// motion, the same motion in force before, other numbers.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "frontends/common/frontend.h"

namespace cnctrans::translator {

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// How a number is spelt, as far as a writer may care: sign, digits before the point, point, zeros at the end.
using NumberForm = std::uint8_t;
inline constexpr std::size_t number_forms = 64;

struct PlainNumber {
  std::string_view text;  ///< without a plus sign
  char letter = 0;        ///< of its word
  NumberForm form = 0;
  std::uint8_t places = 0;  ///< digits behind the point
};

/// The code of motion in force, as far as plain lines tell: 0 to 3, or this.
inline constexpr std::int8_t motion_unknown = -1;

class PlainLine {
 public:
  static constexpr std::size_t max_key = 40, max_numbers = 10;
  enum class Kind : std::uint8_t {
    plain,
    odd,   ///< nothing but such words, with a number that has to be looked at
    other  ///< anything else
  };

  explicit PlainLine(const frontends::PlainWords& words);

  /// Looks at a line. What follows is about it, where it is plain.
  Kind scan(std::string_view line, std::int8_t motion_before);

  [[nodiscard]] std::string_view key() const { return {key_.data(), key_size_}; }
  [[nodiscard]] std::uint32_t hash() const { return hash_; }
  static std::uint32_t hash_of(std::string_view key);
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const PlainNumber& number(std::size_t i) const { return numbers_[i]; }
  /// Of another line: it is nothing but a comment.
  [[nodiscard]] bool comment() const { return comment_; }
  /// Bit 0 is A: letters of its words.
  [[nodiscard]] std::uint32_t letters() const { return letters_; }
  [[nodiscard]] std::int8_t motion_after() const { return motion_; }

 private:
  bool take_number(const char*& p, const char* end, const frontends::FreeNumber& rule, PlainNumber& number, bool& odd);

  std::array<frontends::FreeNumber, 26> rules_;
  frontends::FreeNumber radius_;
  std::uint32_t other_blocks_;
  frontends::CommentLine comments_;
  bool comment_ = false;
  std::array<char, max_key> key_{};
  std::size_t key_size_ = 0, count_ = 0;
  std::array<PlainNumber, max_numbers> numbers_{};
  std::uint32_t hash_ = 0, letters_ = 0;
  std::int8_t motion_ = motion_unknown;
};

}  // namespace cnctrans::translator
