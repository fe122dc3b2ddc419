// Letters of a Sinumerik block for the word scanner (reference 1.4, 1.5).
#pragma once

#include "frontends/common/word_scanner.h"

namespace cnctrans::sinumerik {

/// One letter and a number is a plain word. Names have two letters, `=` needs the grammar. Blanks are tolerated between
/// address and value.
constexpr frontends::ScanTable make_scan_table() {
  frontends::ScanTable t;
  for (unsigned c = 'A'; c <= 'Z'; ++c) {
    const auto c_class = c == 'N' ? frontends::LetterClass::number : frontends::LetterClass::word;
    t.letters[c] = c_class;
    t.letters[c + ('a' - 'A')] = c_class;
  }
  t.comment_open = ';';
  t.comment_close = 0;
  t.skip_mark = '/';
  t.skip_first_level = 0;   // `/` is `/0`
  t.skip_digit_offset = 0;  // `/1` is level 1
  t.skip_digits = true;
  t.blank_before_value = true;
  t.bare_words = false;
  t.main_block_mark = ':';
  return t;
}
inline constexpr frontends::ScanTable scan_table = make_scan_table();

}  // namespace cnctrans::sinumerik
