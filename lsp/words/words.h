// What a word of a language is: the tables of `dialects` in one form for completion, hover, colours and grammars.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cnctrans::lsp {

enum class WordKind : std::uint8_t {
  code,      ///< a G or M function
  keyword,   ///< of a statement
  function,  ///< of an expression
  cycle      ///< with parameters
};
struct WordParameter {
  std::string name;     ///< as it is written: "RTP", "Q200", "I"
  std::string meaning;  ///< with the unit
  bool needed = true;
};
struct WordInfo {
  std::string word;  ///< as it is written
  WordKind kind = WordKind::keyword;
  std::string title;
  std::vector<WordParameter> parameters;
  bool mill = true, lathe = true;
};

struct Language {
  std::string_view dialect;
  std::string_view line_comment;                 ///< ";" or empty
  std::string_view comment_open, comment_close;  ///< or both empty
  bool message_lines = false;                    ///< `$ text`
  std::string_view variables;                    ///< an expression for them ("P[0-9]+")
  std::string_view variable_letters;             ///< that stand behind an address: XP6
  bool numbered_by_n = true;                     ///< block numbers have an N before them
  std::vector<WordInfo> words;

  /// In any case; for a code without the zeros at its front ("G01"). Null: it is not in the tables.
  [[nodiscard]] const WordInfo* find(std::string_view word, bool lathe) const;
};
/// Null: no dialect that is read has this name.
const Language* language(std::string_view dialect);

/// "plunge_feed" for people.
std::string spoken(std::string_view name);

// One function a dialect.
std::vector<WordInfo> fagor_words();
std::vector<WordInfo> num_words();
std::vector<WordInfo> sinumerik_words();
std::vector<WordInfo> heidenhain_words();

}  // namespace cnctrans::lsp
