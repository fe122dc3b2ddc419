// Words of a block, as much of them as a fault needs to know.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace cnctrans::mutation {

/// `X-10.5`, `CR=5`, `R1=7`, or a number without an address.
struct Word {
  std::string name;                          ///< letters before the number ("X", "CR", "R1"); empty: there are none
  std::size_t from = 0, value = 0, end = 0;  ///< the word is [from, end), its number [value, end)
  bool in_brackets = false;
};

/// The words with numbers, without those in texts and in comments of a semicolon.
std::vector<Word> words_of(const std::string& line);

/// A G code of the words of a line: where its number stands.
struct Code {
  Word word;
  int number = 0;
};
std::vector<Code> codes_of(const std::string& line, const char* letter);

}  // namespace cnctrans::mutation
