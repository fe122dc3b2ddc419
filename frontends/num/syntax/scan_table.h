// What the word scanner needs to know of NUM: which letters are addresses of plain words. L and E (variables,
// two-letter addresses) and O (no address) are left to the grammar, and so is N anywhere but at the start.
#pragma once

#include <string_view>

#include "frontends/common/word_scanner.h"

namespace cnctrans::frontends::num {

constexpr ScanTable make_scan_table() {
  ScanTable t;
  for (const char c : std::string_view("ABCDFGHIJKMPQRSTUVWXYZ")) {
    t.letters[static_cast<unsigned char>(c)] = LetterClass::word;
    t.letters[static_cast<unsigned char>(c - 'A' + 'a')] = LetterClass::word;
  }
  t.letters['N'] = t.letters['n'] = LetterClass::number;
  t.comment_open = '(';
  t.comment_close = ')';
  t.blank_before_value = true;
  t.bare_words = true;
  return t;
}
inline constexpr ScanTable scan_table = make_scan_table();

}  // namespace cnctrans::frontends::num
