// Lines that say nothing but where to go, and which two of them are alike: same words in the same order, same codes of
// motion, the same motion in force before, other numbers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "frontends/common/frontend.h"

namespace cnctrans::translator {

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// How a number is spelt, as far as a writer may care: sign, digits before the point, point, zeros at the end.
using NumberForm = std::uint8_t;
inline constexpr std::size_t number_forms = 128;

struct PlainNumber {
  std::string_view text;  ///< without a plus sign, and without a minus that is told by the key
  char letter = 0;        ///< of its word
  NumberForm form = 0;
  std::uint8_t places = 0;  ///< digits behind the point
  bool minus = false;       ///< told by the key
  bool increment = false;   ///< of the place of an axis
};

/// The motion in force, as far as plain lines tell: 0 to 3 as of G0 to G3, or one of these. An F beside a rapid move
/// waits in some languages for the first move that has it.
inline constexpr std::int8_t motion_unknown = -1, rapid_with_feed = 4;

inline constexpr std::int64_t place_scale = 10000, full_turn = 360 * place_scale;
/// A plain number in ten thousandths.
std::int64_t scaled(std::string_view number);

/// The shortest way to write so many ten thousandths.
std::string spelt(std::int64_t value);
/// With its sign.
std::int64_t signed_value(const PlainNumber& number);

class PlainLine;

/// Ten thousandths of X, Y, Z, A, B and C.
using AxisNumbers = std::array<std::int64_t, 6>;

/// What their last numbers in this run of plain lines come to.
struct PlainPlace {
  AxisNumbers at{};
  std::array<bool, 6> known{};
  bool increments = false;  ///< numbers of axes are increments here
  /// -1: no letter of an axis.
  static constexpr int index_of(char letter) {
    return letter >= 'X' && letter <= 'Z' ? letter - 'X' : letter >= 'A' && letter <= 'C' ? letter - 'A' + 3 : -1;
  }
  /// After the plain line.
  void follow(const PlainLine& line);
};

/// A line, or two of which the first one says the centre of the arc in the second.
struct PlainUnit {
  std::string_view text;  ///< without the last line end
  std::uint32_t first = 0, last = 0;
  bool room = false;  ///< eight bytes behind it are there
};

inline constexpr int increment_bits = 26;
inline constexpr std::uint32_t all_increments = 0x3FU << increment_bits;

class PlainLine {
 public:
  static constexpr std::size_t max_key = 40, max_numbers = 10, max_code = 4;
  static constexpr std::size_t key_room = max_key + 16;  ///< the last word of a key may be longer than a code
  enum class Kind : std::uint8_t {
    plain,
    odd,   ///< nothing but such words, with a number that has to be looked at
    other  ///< anything else
  };

  explicit PlainLine(const frontends::PlainWords& words);

  /// Cuts the next unit off. `line`: what take_line found last.
  bool take(std::string_view& text, SourceLine& line, PlainUnit& unit) const;

  /// Of a piece of text, what ends with a whole unit.
  [[nodiscard]] std::string_view whole_units(std::string_view text) const;

  /// Looks at the text of a unit. What follows is about it, where it is plain. `room`: its end and eight bytes can be
  /// read behind it.
  Kind scan(std::string_view line, std::int8_t motion_before, const PlainPlace& before, bool room = false);

  [[nodiscard]] std::string_view key() const { return {key_.data(), key_size_}; }
  [[nodiscard]] std::uint32_t hash() const { return hash_; }
  static std::uint32_t hash_of(std::string_view key);
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const PlainNumber& number(std::size_t i) const { return numbers_[i]; }
  /// Of another line: it is nothing but a comment.
  [[nodiscard]] bool comment() const;
  /// Does a line that is not plain leave increments in force?
  [[nodiscard]] bool increments_after(std::string_view line, bool before) const;
  /// Bit 0 is A: letters of its words; from increment_bits on: axes that it moves by increments, X the first.
  [[nodiscard]] std::uint32_t letters() const { return letters_; }
  /// Of its words: the axis stands there already, and its number is not among the others.
  [[nodiscard]] std::uint32_t still() const { return still_; }
  [[nodiscard]] std::int8_t motion_after() const { return motion_; }
  /// By which a jump may ask for the line; a number without a letter is none.
  [[nodiscard]] std::optional<std::uint64_t> block_number() const {
    return bare_block_number_ ? std::nullopt : std::optional<std::uint64_t>(block_);
  }
  /// Letters of axes whose words go by the way there.
  [[nodiscard]] std::uint32_t by_way() const { return by_way_; }

 private:
  /// By which way the axis comes to the number: `<`, `>`, `~` where it stands there; 0: not known, or half a turn and
  /// more.
  static char way_to(const PlainNumber& number, const PlainPlace& before);

  struct Cursor;
  Cursor begin(std::string_view line, bool room);
  void add(Cursor& at, char c);
  bool take_code(Cursor& at);
  bool take_motion(Cursor& at);
  bool take_word(char c, const PlainPlace& before, Cursor& at);
  static bool take_number(Cursor& at, const frontends::FreeNumber& rule, PlainNumber& number);

  [[nodiscard]] const frontends::PlainCode* code_at(const char* at, const char* end) const;
  [[nodiscard]] bool is_lead(std::string_view line) const;
  [[nodiscard]] std::string_view without_number(std::string_view line) const;

  std::array<frontends::FreeNumber, 26> rules_;
  std::span<const frontends::PlainCode> codes_;
  std::uint32_t code_letters_ = 0;  ///< bit 0 is A: letters that codes begin with
  bool bare_block_number_;
  std::string_view lead_, increments_, places_;
  char increment_;
  frontends::FreeNumber radius_;
  std::uint32_t other_blocks_;
  frontends::CommentLine comments_;
  std::string_view line_;
  std::vector<char> copy_;
  std::array<char, key_room> key_{};
  std::size_t key_size_ = 0, count_ = 0;
  std::array<PlainNumber, max_numbers> numbers_{};
  std::uint32_t hash_ = 0, letters_ = 0, still_ = 0, by_way_ = 0;
  std::optional<std::uint32_t> block_;
  std::int8_t motion_ = motion_unknown;
};

}  // namespace cnctrans::translator
