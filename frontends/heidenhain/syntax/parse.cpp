#include "frontends/heidenhain/syntax/parse.h"

#include <cctype>
#include <utility>

#include "base/text.h"
#include "frontends/common/control_bytes.h"
#include "frontends/heidenhain/syntax/tree.h"

namespace cnctrans::frontends::heidenhain {

namespace {

using cnc_heidenhain::HeidenhainLexer;
using cnc_heidenhain::HeidenhainParser;

/// Bytes as code points: columns are bytes, and no byte is invalid.
class LineBytes : public antlr4::ANTLRInputStream {
 public:
  void set(std::string_view line) {
    _data.clear();
    for (const char c : line) _data.push_back(static_cast<char32_t>(static_cast<unsigned char>(c)));
    p = 0;
  }
};

/// Keeps the first fault of lexer or parser.
class FirstFault : public antlr4::BaseErrorListener {
 public:
  bool any = false;
  WordPos pos;
  std::string message;
  std::string_view line;

  void start(std::string_view text) {
    any = false;
    line = text;
  }
  void syntaxError(antlr4::Recognizer* /*who*/, antlr4::Token* offending, std::size_t, std::size_t column,
                   const std::string&, std::exception_ptr) override {
    if (any) return;
    any = true;
    pos = {static_cast<std::uint32_t>(column + 1), 1};
    message = "this can't stand here";
    if (offending == nullptr) return;
    if (offending->getType() == antlr4::Token::EOF) {
      pos = {static_cast<std::uint32_t>(line.empty() ? 1 : line.size()), 1};
      message = "the block ends where more is needed";
      return;
    }
    const std::size_t begin = offending->getStartIndex();
    pos = {static_cast<std::uint32_t>(begin + 1), static_cast<std::uint32_t>(offending->getStopIndex() - begin + 1)};
    message = "`" + std::string(line.substr(begin, pos.length)) + "` can't stand here";
  }
};

}  // namespace

double number_of(std::string_view text) {
  std::string digits(text);
  for (char& c : digits) {
    if (c == ',') c = '.';
  }
  return parse_decimal(digits).value_or(0);
}

bool take_tilde(std::string_view& comment) {
  const std::string_view text = trim(comment);
  if (text.empty() || text.back() != '~') return false;
  comment = comment.substr(0, comment.rfind('~'));
  return true;
}

struct BlockParser::State {
  LineBytes input;
  HeidenhainLexer lexer{&input};
  antlr4::CommonTokenStream tokens{&lexer};
  HeidenhainParser parser{&tokens};
  FirstFault fault;
  std::shared_ptr<antlr4::ANTLRErrorStrategy> bail = std::make_shared<antlr4::BailErrorStrategy>();
  std::shared_ptr<antlr4::ANTLRErrorStrategy> recover = std::make_shared<antlr4::DefaultErrorStrategy>();

  State() {
    lexer.removeErrorListeners();
    lexer.addErrorListener(&fault);
    parser.removeErrorListeners();
    parser.addErrorListener(&fault);
  }

  /// Tokens of the line; the parser is at the first one.
  void load(std::string_view line) {
    input.set(line);
    lexer.setInputStream(&input);
    tokens.setTokenSource(&lexer);
    tokens.fill();
    parser.setTokenStream(&tokens);
  }
  /// Brackets and prefix functions are counted before the parser goes down into them.
  [[nodiscard]] bool too_deep() {
    constexpr int most = 100;
    int depth = 0, deepest = 0, prefixes = 0;
    for (antlr4::Token* t : tokens.getTokens()) {
      const auto type = t->getType();
      if (type == HeidenhainLexer::LPAREN) deepest = std::max(deepest, ++depth);
      if (type == HeidenhainLexer::RPAREN) --depth;
      const bool prefix =
          type == HeidenhainLexer::WORD || type == HeidenhainLexer::PLUS || type == HeidenhainLexer::MINUS;
      prefixes = prefix ? prefixes + 1 : 0;
      if (deepest > most || prefixes > most) return true;
    }
    return false;
  }
  HeidenhainParser::BlockContext* run(antlr4::atn::PredictionMode mode,
                                      const std::shared_ptr<antlr4::ANTLRErrorStrategy>& strategy) {
    parser.getInterpreter<antlr4::atn::ParserATNSimulator>()->setPredictionMode(mode);
    parser.setErrorHandler(strategy);
    return parser.block();
  }
};

BlockParser::BlockParser() : state_(std::make_unique<State>()) {}
BlockParser::~BlockParser() = default;

bool BlockParser::parse(std::string_view line, syntax::Block& out, ParseError& error) {
  out.clear();
  if (line.size() > longest_block) {
    error = {{longest_block + 1, 1}, "the line is far longer than the control takes"};
    return false;
  }
  if (const std::size_t at = find_control_byte(line, ';', '"', '"'); at != std::string_view::npos) {
    error = {{static_cast<std::uint32_t>(at + 1), 1}, "a byte that is no character of the control"};
    return false;
  }
  State& s = *state_;
  s.fault.start(line);
  try {
    s.load(line);
    if (s.too_deep()) {
      error = {{1, static_cast<std::uint32_t>(line.size())}, "brackets or functions are nested too deeply"};
      return false;
    }
    HeidenhainParser::BlockContext* tree = nullptr;
    try {
      tree = s.run(antlr4::atn::PredictionMode::SLL, s.bail);
    } catch (const antlr4::ParseCancellationException&) {
      s.tokens.seek(0);
      s.parser.reset();
      tree = s.run(antlr4::atn::PredictionMode::LL, s.recover);
    }
    if (s.fault.any) {
      error = {s.fault.pos, s.fault.message};
      out.clear();
      return false;
    }
    if (build_block(*tree, line, out, error)) return true;
  } catch (const std::exception& e) {
    error = {{1, static_cast<std::uint32_t>(line.empty() ? 1 : line.size())}, e.what()};
  }
  out.clear();
  return false;
}

}  // namespace cnctrans::frontends::heidenhain
