// The limit of a spindle's speed by two words of the source (one for every speed, one for a constant cutting speed): in
// one program the reader tells the lower one; in programs that call each other only the run knows both.
#pragma once

#include <string>
#include <string_view>

#include "ir/program.h"

namespace cnctrans::ir {

/// The letters at the front of a word as written: "LIMS" of `LIMS=3000`, "S" of `S2000`.
inline std::string word_of_limit(std::string_view written) {
  std::string out;
  for (const char c : written) {
    const char capital = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (capital < 'A' || capital > 'Z') break;
    out += capital;
  }
  return out;
}

/// Calls `found(statement, word)` for each word of the routine that limits the speed of a spindle from above.
template <class Found>
void each_limit_word(const Routine& routine, const Found& found) {
  for_each_statement(routine.body, [&found](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    for (const Action& a : b->actions) {
      const auto* limit = std::get_if<SpindleLimit>(&a.data);
      if (limit != nullptr && !limit->lower && !a.text.empty()) found(s, word_of_limit(a.text));
    }
  });
}

/// Collects the words of routines one after the other.
class LimitWords {
 public:
  /// The first statement of the routine whose word is another one than those of a routine before; null: none.
  const Statement* add(const Routine& routine) {
    const Statement* other = nullptr;
    std::string own;
    each_limit_word(routine, [&](const Statement& s, const std::string& word) {
      if (other == nullptr && !before_.empty() && (mixed_ || differ(word, before_))) other = &s;
      if (own.empty()) own = word;
      mixed_ = mixed_ || differ(word, own);
    });
    if (before_.empty()) before_ = own;
    return other;
  }

 private:
  /// `S` and `SP` (with the number of a parameter behind it) are one word.
  static bool differ(std::string_view a, std::string_view b) { return !a.starts_with(b) && !b.starts_with(a); }

  std::string before_;
  bool mixed_ = false;
};

}  // namespace cnctrans::ir
