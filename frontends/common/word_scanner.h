// The word scanner: reads blocks made of plain words (`N120 G1 X10.5 Z-3 F0.2 ;text`) at memory speed. Everything else
// is left to the grammar, which is the definition.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "frontends/common/syntax.h"

namespace cnctrans::frontends {

enum class LetterClass : std::uint8_t {
  none,   ///< not an address of a plain word: the block goes to the grammar
  word,   ///< address of a plain word
  number  ///< block number, at the start of a block only (elsewhere: the grammar)
};

/// Facts of a dialect that the scanner needs; constexpr data in dialects/<d>/scan_table.h.
struct ScanTable {
  std::array<LetterClass, 256> letters{};
  char comment_open = ';';
  char comment_close = 0;         ///< 0: to the end of the line; else the comment ends at the first one
  bool comment_only_last = true;  ///< a closed comment followed by words goes to the grammar
  char skip_mark = '/';
  std::uint8_t skip_first_level = 0;   ///< level of a bare skip mark
  std::uint8_t skip_digit_offset = 0;  ///< level = digit - offset (`/1` -> 0 with offset 1)
  bool skip_digits = false;            ///< a digit may follow the skip mark
  bool blank_before_value = false;     ///< `X 10` is a plain word
  bool bare_words = false;             ///< a word without a value is a plain word (value 0)
  char main_block_mark = 0;            ///< ':' where the dialect has main blocks
};

/// Reads a plain block. False: not plain, `out` is undefined, use the grammar. Never reports anything. A line of blanks
/// gives an empty plain block. Numbers are as in `parse_decimal`; more than 17 digits goes to the grammar.
bool scan_plain(std::string_view line, const ScanTable& table, syntax::Block& out);

}  // namespace cnctrans::frontends
