#include "lsp/words/tokens.h"

#include <algorithm>
#include <string>

#include "base/text.h"

namespace cnctrans::lsp {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$';
}

class LineTokens {
 public:
  LineTokens(std::string_view line, const Language& language, bool lathe)
      : t_(line), language_(language), lathe_(lathe) {}

  std::vector<Token> read() {
    block_number();
    while (i_ < t_.size()) step();
    return std::move(out_);
  }

 private:
  void add(std::size_t begin, std::size_t end, TokenType type) {
    if (end > begin)
      out_.push_back({static_cast<std::uint32_t>(begin + 1), static_cast<std::uint32_t>(end - begin), type});
  }
  [[nodiscard]] std::size_t digits_from(std::size_t i) const {
    while (i < t_.size() && is_digit(t_[i])) ++i;
    return i;
  }
  void block_number() {
    i_ = std::min(t_.find_first_not_of(" \t/"), t_.size());
    if (i_ == t_.size()) return;
    const bool marked = t_[i_] == 'N' || t_[i_] == 'n' || t_[i_] == ':';
    const std::size_t digits = marked ? i_ + 1 : i_, end = digits_from(digits);
    if ((!marked && language_.numbered_by_n) || end == digits) return;
    add(i_, end, TokenType::label);
    i_ = end;
  }
  void step() {
    const char c = t_[i_];
    const std::string_view rest = t_.substr(i_);
    if ((!language_.line_comment.empty() && rest.starts_with(language_.line_comment)) ||
        (language_.message_lines && c == '$' && out_.empty())) {
      add(i_, t_.size(), c == '$' ? TokenType::string : TokenType::comment);
      i_ = t_.size();
    } else if (!language_.comment_open.empty() && rest.starts_with(language_.comment_open)) {
      const std::size_t close = t_.find(language_.comment_close, i_);
      const std::size_t end = close == std::string_view::npos ? t_.size() : close + 1;
      add(i_, end, TokenType::comment);
      i_ = end;
    } else if (c == '"') {
      const std::size_t close = t_.find('"', i_ + 1);
      const std::size_t end = close == std::string_view::npos ? t_.size() : close + 1;
      add(i_, end, TokenType::string);
      i_ = end;
    } else if (is_digit(c) || (c == '.' && i_ + 1 < t_.size() && is_digit(t_[i_ + 1]))) {
      const std::size_t begin = i_;
      i_ = digits_from(i_);
      if (i_ < t_.size() && t_[i_] == '.') i_ = digits_from(i_ + 1);
      add(begin, i_, TokenType::number);
    } else if (is_letter(c)) {
      word();
    } else {
      ++i_;
    }
  }
  static TokenType type_of(WordKind kind) {
    switch (kind) {
      case WordKind::code: return TokenType::function;
      case WordKind::keyword: return TokenType::keyword;
      case WordKind::function: return TokenType::function;
      case WordKind::cycle: return TokenType::macro;
    }
    return TokenType::keyword;
  }
  [[nodiscard]] bool variable_letter(char c) const {
    const char capital = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
    return language_.variable_letters.find(capital) != std::string_view::npos;
  }
  void word() {
    const std::size_t begin = i_;
    while (i_ < t_.size() && is_letter(t_[i_])) ++i_;
    const std::size_t letters = i_, digits = digits_from(i_);
    std::size_t whole = digits;  // an identifier: CYCLE81, _P1X
    while (whole < t_.size() && (is_letter(t_[whole]) || is_digit(t_[whole]))) ++whole;
    const auto known = [&](std::size_t end) { return language_.find(t_.substr(begin, end - begin), lathe_); };
    if (const WordInfo* w = known(whole)) return take(begin, whole, type_of(w->kind));
    if (const WordInfo* w = digits > letters ? known(digits) : nullptr) return take(begin, digits, type_of(w->kind));
    if (const WordInfo* w = known(letters)) return take(begin, letters, type_of(w->kind));
    if (digits > letters) {
      const char last = t_[letters - 1];
      if ((last == 'N' || last == 'n') && letters - begin == 1 && language_.numbered_by_n)
        return take(begin, digits, TokenType::label);
      if (variable_letter(last)) {
        add(begin, letters - 1, TokenType::property);
        return take(letters - 1, digits, TokenType::variable);
      }
      const char first = t_[begin];
      if (first == 'R' || first == 'r' || first == 'Q' || first == 'q' || first == '$') {
        if (language_.variables.find(first == 'q' || first == 'Q' ? 'Q' : 'R') != std::string_view::npos &&
            whole == digits)
          return take(begin, digits, TokenType::variable);
      }
    }
    if (whole > digits || letters - begin > 2) return take(begin, whole, TokenType::variable);
    add(begin, letters, TokenType::property);
    i_ = letters;
  }
  void take(std::size_t begin, std::size_t end, TokenType type) {
    add(begin, end, type);
    i_ = end;
  }

  std::string_view t_;
  const Language& language_;
  bool lathe_;
  std::size_t i_ = 0;
  std::vector<Token> out_;
};

}  // namespace

std::vector<Token> tokens_of(std::string_view line, const Language& language, bool lathe) {
  return LineTokens(line, language, lathe).read();
}

}  // namespace cnctrans::lsp
