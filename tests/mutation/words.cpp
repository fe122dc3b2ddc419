#include "tests/mutation/words.h"

#include <cctype>
#include <cstdlib>

namespace cnctrans::mutation {

namespace {

bool alpha(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$';
}
bool digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}
/// Behind the number that begins at `at`; `at` itself: there is none.
std::size_t number_end(const std::string& line, std::size_t at) {
  std::size_t end = at;
  if (end < line.size() && (line[end] == '-' || line[end] == '+')) ++end;
  const std::size_t first = end;
  while (end < line.size() && (digit(line[end]) || line[end] == '.')) ++end;
  return end == first ? at : end;
}

}  // namespace

std::vector<Word> words_of(const std::string& line) {
  std::vector<Word> words;
  int open = 0;
  for (std::size_t i = 0; i < line.size();) {
    const char c = line[i];
    if (c == ';') break;
    if (c == '"' || c == '\'') {
      const std::size_t close = line.find(c, i + 1);
      if (close == std::string::npos) break;
      i = close + 1;
      continue;
    }
    if (c == '(' || c == '[') ++open;
    if (c == ')' || c == ']') --open;
    Word word{{}, i, i, i, open > 0};
    std::size_t at = i;
    while (at < line.size() && alpha(line[at])) ++at;
    word.name = line.substr(i, at - i);
    if (at < line.size() && line[at] == '=' && !word.name.empty()) ++at;
    std::size_t end = number_end(line, at);
    if (end < line.size() && line[end] == '=' && end > at && !word.name.empty()) {  // R1=5
      const std::size_t behind = number_end(line, end + 1);
      if (behind > end + 1) {
        word.name += line.substr(at, end - at);
        at = end + 1;
        end = behind;
      }
    }
    const bool sign_of_expression = word.name.empty() && i > 0 &&
                                    (std::isalnum(static_cast<unsigned char>(line[i - 1])) != 0 || line[i - 1] == ')');
    if (sign_of_expression && !digit(c)) {
      ++i;
      continue;
    }
    if (end > at) {
      word.value = at;
      word.end = end;
      words.push_back(word);
      i = end;
    } else {
      i = at > i ? at : i + 1;
    }
  }
  return words;
}

std::vector<Code> codes_of(const std::string& line, const char* letter) {
  std::vector<Code> out;
  for (const auto& word : words_of(line)) {
    if (word.name != letter || word.end - word.value > 4 || !digit(line[word.value])) continue;
    out.push_back({word, std::atoi(line.substr(word.value, word.end - word.value).c_str())});
  }
  return out;
}

}  // namespace cnctrans::mutation
