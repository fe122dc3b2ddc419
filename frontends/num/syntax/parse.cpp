#include "frontends/num/syntax/parse.h"

#include <array>
#include <cctype>
#include <utility>

#include "base/text.h"
#include "frontends/common/control_bytes.h"
#include "frontends/num/syntax/tree.h"

namespace cnctrans::frontends::num {

namespace {

using cnc_num::NumLexer;
using cnc_num::NumParser;

/// Bytes as code points: columns are bytes, and no byte is invalid.
class ByteStream : public antlr4::ANTLRInputStream {
 public:
  void set(std::string_view line) {
    _data.clear();
    for (const char c : line) _data.push_back(static_cast<char32_t>(static_cast<unsigned char>(c)));
    p = 0;
  }
};

/// Keeps the first fault of lexer or parser.
class FirstError : public antlr4::BaseErrorListener {
 public:
  bool any = false;
  WordPos pos;
  std::string message;
  std::string_view line;

  void start(std::string_view text) {
    any = false;
    line = text;
  }
  void syntaxError(antlr4::Recognizer* who, antlr4::Token* offending, std::size_t, std::size_t column,
                   const std::string&, std::exception_ptr) override {
    if (any && column + 1 >= pos.column) return;
    any = true;
    pos = {static_cast<std::uint32_t>(column + 1), 1};
    message =
        offending == nullptr || dynamic_cast<antlr4::Lexer*>(who) != nullptr ? lexical(column) : structural(*offending);
  }

 private:
  [[nodiscard]] std::string lexical(std::size_t column) const {
    const char c = column < line.size() ? line[column] : ' ';
    if (c == '(') return "the comment that begins here is not closed by `)`";
    if (c == '[') return "the symbol that begins here is not closed by `]`";
    if (c == 'O' || c == 'o') return "`O` is a letter and no address; was the digit 0 meant?";
    if (std::isprint(static_cast<unsigned char>(c)) == 0) return "a byte that is no character of the control";
    return std::string("`") + c + "` means nothing here";
  }
  std::string structural(const antlr4::Token& t) {
    if (t.getType() == antlr4::Token::EOF) {
      pos = {static_cast<std::uint32_t>(line.empty() ? 1 : line.size()), 1};
      return "the block ends too early";
    }
    const std::size_t begin = t.getStartIndex();
    pos = {static_cast<std::uint32_t>(begin + 1), static_cast<std::uint32_t>(t.getStopIndex() - begin + 1)};
    const std::string text(line.substr(begin, t.getStopIndex() - begin + 1));
    switch (t.getType()) {
      case NumLexer::NUMBER: return "the number `" + text + "` has no address before it";
      case NumLexer::MESSAGE: return "a `$` message must be the last thing in a block";
      case NumLexer::PERCENT: return "a program header must stand alone in its line";
      case NumLexer::L:
      case NumLexer::E: return "a variable stands here that nothing uses (an assignment needs `=`)";
      default: return "`" + text + "` can't stand here";
    }
  }
};

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// The text after skip mark, block number and comments.
std::string_view after_number(std::string_view line) {
  std::size_t i = 0;
  const auto blanks = [&] {
    for (;;) {
      while (i < line.size() && is_blank(line[i])) ++i;
      if (i >= line.size() || line[i] != '(') return;
      const auto close = line.find(')', i);
      if (close == std::string_view::npos) return;
      i = close + 1;
    }
  };
  blanks();
  if (i < line.size() && line[i] == '/') ++i;
  blanks();
  if (i < line.size() && (line[i] == 'N' || line[i] == 'n')) {
    std::size_t j = i + 1;
    while (j < line.size() && (is_blank(line[j]) || is_digit(line[j]))) ++j;
    if (j > i + 1) i = j;
  }
  blanks();
  return line.substr(i < line.size() ? i : line.size());
}

}  // namespace

bool begins_with_keyword(std::string_view line) {
  constexpr std::array<std::string_view, 27> keywords = {
      "DOWNTO", "REPEAT", "SEARCH", "DELETE", "WHILE", "UNTIL", "BUILD", "R.OFF", "THEN",
      "ELSE",   "ENDI",   "ENDW",   "ENDF",   "ENDV",  "EXIT",  "PUSH",  "PULL",  "BSET",
      "BCLR",   "MOVE",   "SORT",   "SAVE",   "CUT",   "FOR",   "VAR",   "IF",    "DO"};
  const std::string_view text = after_number(line);
  if (text.size() < 2 || !is_letter(text[0]) || !(is_letter(text[1]) || text[1] == '.')) return false;
  for (const std::string_view k : keywords) {
    if (text.size() < k.size() || !iequals_ascii(text.substr(0, k.size()), k)) continue;
    // `IF100` is the words I0 F100; `IF L1`, `IFL1`, `IF[A]` are the statement.
    return text.size() == k.size() || !(is_digit(text[k.size()]) || text[k.size()] == '.');
  }
  return false;
}

struct BlockParser::State {
  bool structured = true;
  ByteStream input;
  NumLexer lexer{&input};
  antlr4::CommonTokenStream tokens{&lexer};
  NumParser parser{&tokens};
  FirstError first_error;
  std::shared_ptr<antlr4::ANTLRErrorStrategy> bail = std::make_shared<antlr4::BailErrorStrategy>();
  std::shared_ptr<antlr4::ANTLRErrorStrategy> recover = std::make_shared<antlr4::DefaultErrorStrategy>();

  explicit State(bool with_statements) : structured(with_statements) {
    lexer.removeErrorListeners();
    lexer.addErrorListener(&first_error);
    parser.removeErrorListeners();
    parser.addErrorListener(&first_error);
  }

  /// Tokens of the line; the parser is at the first one.
  void load(std::string_view line) {
    input.set(line);
    lexer.setInputStream(&input);
    if (structured && begins_with_keyword(line)) lexer.setMode(NumLexer::STATEMENT);
    tokens.setTokenSource(&lexer);
    tokens.fill();
    parser.setTokenStream(&tokens);
  }

  NumParser::BlockContext* run(antlr4::atn::PredictionMode mode,
                               const std::shared_ptr<antlr4::ANTLRErrorStrategy>& strategy) {
    parser.getInterpreter<antlr4::atn::ParserATNSimulator>()->setPredictionMode(mode);
    parser.setErrorHandler(strategy);
    return parser.block();
  }
};

BlockParser::BlockParser(bool structured) : state_(std::make_unique<State>(structured)) {}
BlockParser::~BlockParser() = default;

bool BlockParser::parse(std::string_view line, syntax::Block& out, ParseError& error) {
  out.clear();
  if (line.size() > longest_block) {
    error = {{longest_block + 1, 1}, "the block is far longer than the 118 characters that the control takes"};
    return false;
  }
  if (const std::size_t at = find_control_byte(line, '$', '(', ')'); at != std::string_view::npos) {
    error = {{static_cast<std::uint32_t>(at + 1), 1}, "a byte that is no character of the control"};
    return false;
  }
  State& s = *state_;
  s.first_error.start(line);
  try {
    s.load(line);
    NumParser::BlockContext* tree = nullptr;
    if (!s.first_error.any) {
      try {
        tree = s.run(antlr4::atn::PredictionMode::SLL, s.bail);
      } catch (const antlr4::ParseCancellationException&) {
        s.tokens.seek(0);
        s.parser.reset();
        tree = s.run(antlr4::atn::PredictionMode::LL, s.recover);
      }
    }
    if (s.first_error.any) {
      error = {s.first_error.pos, s.first_error.message};
      out.clear();
      return false;
    }
    if (!build_block(*tree, line, out, error)) {
      out.clear();
      return false;
    }
    for (antlr4::Token* t : s.tokens.getTokens()) {
      if (t->getType() != NumLexer::COMMENT) continue;
      const std::size_t begin = t->getStartIndex(), length = t->getStopIndex() - begin + 1;
      out.comments.push_back({line.substr(begin + 1, length - 2),
                              {static_cast<std::uint32_t>(begin + 1), static_cast<std::uint32_t>(length)}});
    }
    return true;
  } catch (const std::exception& e) {
    error = {{1, static_cast<std::uint32_t>(line.empty() ? 1 : line.size())}, e.what()};
    out.clear();
    return false;
  }
}

}  // namespace cnctrans::frontends::num
