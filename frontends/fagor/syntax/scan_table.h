// Letters of a Fagor block for the word scanner (manual ch. 2, 5).
#pragma once

#include "frontends/common/word_scanner.h"

namespace cnctrans::fagor {

/// Any letter with a number, or bare, is a plain word; `P` may be the value of the word before it and `N` at the end of
/// a block is the repeat count: both go to the grammar. Blanks may stand between letter and value.
constexpr frontends::ScanTable make_scan_table() {
  frontends::ScanTable t;
  for (unsigned c = 'A'; c <= 'Z'; ++c) {
    if (c == 'P') continue;
    const auto letter = c == 'N' ? frontends::LetterClass::number : frontends::LetterClass::word;
    t.letters[c] = letter;
    t.letters[c + ('a' - 'A')] = letter;
  }
  t.skip_first_level = 0;  // `/` and `/1` are the first level
  t.skip_digit_offset = 1;
  t.skip_digits = true;
  t.blank_before_value = true;
  t.bare_words = true;
  return t;
}
inline constexpr frontends::ScanTable scan_table = make_scan_table();

}  // namespace cnctrans::fagor
