#include "lsp/words/words.h"

#include <algorithm>
#include <array>

#include "base/text.h"

namespace cnctrans::lsp {

namespace {

/// G01 is G1.
std::string without_zeros(std::string_view word) {
  std::string key = to_upper_ascii(word);
  if (key.size() > 2 && (key[0] == 'G' || key[0] == 'M')) {
    std::size_t zeros = 1;
    while (zeros + 1 < key.size() && key[zeros] == '0' && key[zeros + 1] >= '0' && key[zeros + 1] <= '9') ++zeros;
    key.erase(1, zeros - 1);
  }
  return key;
}

std::array<Language, 4> all_languages() {
  return {Language{"fagor", ";", "", "", false, "P[0-9]+", "P", true, fagor_words()},
          Language{"num", "", "(", ")", true, "L[0-9]+|E[0-9]{5}", "LE", true, num_words()},
          Language{"sinumerik", ";", "", "", false, "R[0-9]+|\\$[A-Z_0-9]+", "", true, sinumerik_words()},
          Language{"heidenhain", ";", "", "", false, "Q[LRS]?[0-9]+", "", false, heidenhain_words()}};
}

}  // namespace

const WordInfo* Language::find(std::string_view word, bool lathe) const {
  const std::string key = without_zeros(word);
  const auto fits = [&](const WordInfo& w) { return w.word == key && (lathe ? w.lathe : w.mill); };
  const auto found = std::find_if(words.begin(), words.end(), fits);
  return found == words.end() ? nullptr : &*found;
}

const Language* language(std::string_view dialect) {
  static const std::array<Language, 4> languages = all_languages();
  const auto found =
      std::find_if(languages.begin(), languages.end(), [dialect](const Language& l) { return l.dialect == dialect; });
  return found == languages.end() ? nullptr : &*found;
}

std::string spoken(std::string_view name) {
  std::string out(name);
  std::replace(out.begin(), out.end(), '_', ' ');
  std::replace(out.begin(), out.end(), '.', ' ');
  return out;
}

}  // namespace cnctrans::lsp
