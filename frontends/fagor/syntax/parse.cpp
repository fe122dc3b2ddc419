#include "frontends/fagor/syntax/parse.h"

#include <antlr4-runtime.h>

#include "fagor/FagorLexer.h"
#include "fagor/FagorParser.h"
#include "frontends/common/control_bytes.h"
#include "frontends/fagor/syntax/tree_reader.h"

namespace cnctrans::fagor {

namespace {

using cnc_fagor::FagorLexer;
using cnc_fagor::FagorParser;

/// Remembers the first fault only.
class FirstError : public antlr4::BaseErrorListener {
 public:
  void syntaxError(antlr4::Recognizer* /*recognizer*/, antlr4::Token* token, std::size_t /*line*/, std::size_t column,
                   const std::string& message, std::exception_ptr /*e*/) override {
    if (seen_) return;
    seen_ = true;
    token_ = token;
    column_ = column;
    message_ = message;
  }
  void reset() { seen_ = false; }
  [[nodiscard]] bool seen() const { return seen_; }
  [[nodiscard]] const antlr4::Token* token() const { return token_; }
  [[nodiscard]] std::size_t column() const { return column_; }

 private:
  bool seen_ = false;
  const antlr4::Token* token_ = nullptr;
  std::size_t column_ = 0;
  std::string message_;
};

/// Capitals, one byte for one byte; bytes outside ASCII become 0x1A, which is no part of any token but texts.
void fold_line(std::string_view line, std::string& out) {
  out.resize(line.size());
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool ascii = static_cast<unsigned char>(c) < 0x80 && c != '\n' && c != '\r';
    out[i] = !ascii ? '\x1a' : (c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c);
  }
}

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 20;
  std::string s = "'";
  s += text.substr(0, longest);
  if (text.size() > longest) s += "...";
  return s + "'";
}

std::string describe_byte(char c) {
  const auto code = static_cast<unsigned char>(c);
  if (c == '"') return "the text in quotes is not closed";
  if (c == ')') return "a bracket ) too many";
  if (code >= 0x21 && code < 0x7f) return std::string("the character '") + c + "' has no meaning here";
  return "a byte with code " + std::to_string(code) + " has no meaning in a block";
}

}  // namespace

struct BlockParser::Impl {
  antlr4::ANTLRInputStream input;
  FagorLexer lexer{&input};
  antlr4::CommonTokenStream tokens{&lexer};
  FagorParser parser{&tokens};
  std::shared_ptr<antlr4::ANTLRErrorStrategy> bail = std::make_shared<antlr4::BailErrorStrategy>();
  std::shared_ptr<antlr4::ANTLRErrorStrategy> report = std::make_shared<antlr4::DefaultErrorStrategy>();
  FirstError errors;
  std::string folded;

  Impl() {
    lexer.removeErrorListeners();
    lexer.addErrorListener(&errors);
    parser.removeErrorListeners();
  }

  bool within_limits(std::string_view line, ParseError& error);
  FagorParser::BlockContext* tree();
  void explain(std::string_view line, ParseError& error) const;
};

/// Depth of brackets and of prefix operators is bounded before parsing, so that no line can exhaust the stack.
bool BlockParser::Impl::within_limits(std::string_view line, ParseError& error) {
  int depth = 0, prefixes = 0;
  bool statement = false;
  for (const auto& owned : tokens.getTokens()) {
    const antlr4::Token* t = owned;
    const std::size_t type = t->getType();
    if (type == FagorLexer::LPAREN) {
      statement = true;
      ++depth;
    } else if (type == FagorLexer::RPAREN) {
      --depth;
    }
    const bool prefix = type == FagorLexer::MINUS || type == FagorLexer::PLUS || type == FagorLexer::NOT ||
                        type == FagorLexer::FUNCTION;
    prefixes = prefix ? prefixes + 1 : 0;
    if (depth > max_nesting || prefixes > max_nesting) {
      error = {{static_cast<std::uint32_t>(t->getStartIndex() + 1), 1}, "brackets or functions are nested too deeply"};
      return false;
    }
  }
  if (statement && line.size() > max_statement_length) {
    error = {{1, static_cast<std::uint32_t>(line.size())}, "the statement is longer than 4096 characters"};
    return false;
  }
  return true;
}

/// SLL with no recovery first; what that refuses is tried again in full, which decides and finds the place.
FagorParser::BlockContext* BlockParser::Impl::tree() {
  auto* interpreter = parser.getInterpreter<antlr4::atn::ParserATNSimulator>();
  try {
    interpreter->setPredictionMode(antlr4::atn::PredictionMode::SLL);
    parser.setErrorHandler(bail);
    parser.removeErrorListeners();
    return parser.block();
  } catch (const antlr4::ParseCancellationException&) {
    interpreter->setPredictionMode(antlr4::atn::PredictionMode::LL);
    parser.setErrorHandler(report);
    parser.addErrorListener(&errors);
    parser.reset();
    return parser.block();
  }
}

void BlockParser::Impl::explain(std::string_view line, ParseError& error) const {
  const antlr4::Token* t = errors.token();
  if (!t || t->getType() == antlr4::Token::EOF) {
    const auto column = static_cast<std::uint32_t>(t ? line.size() : errors.column()) + 1;
    int open = 0;
    for (const auto& owned : const_cast<antlr4::CommonTokenStream&>(tokens).getTokens()) {
      const antlr4::Token* each = owned;
      open += each->getType() == FagorLexer::LPAREN ? 1 : each->getType() == FagorLexer::RPAREN ? -1 : 0;
    }
    error = {{column, 1}, open > 0 ? "the closing bracket ) is missing" : "the block ends where more is needed"};
    return;
  }
  const auto start = t->getStartIndex(), stop = t->getStopIndex();
  error.pos = {static_cast<std::uint32_t>(start + 1), static_cast<std::uint32_t>(stop >= start ? stop - start + 1 : 1)};
  const std::string_view text = line.substr(start, error.pos.length);
  const bool iso = line.substr(0, start).find('(') == std::string_view::npos;
  switch (t->getType()) {
    case FagorLexer::BAD: error.message = describe_byte(text.empty() ? '?' : text.front()); break;
    case FagorLexer::RPAREN: error.message = "the bracket ) does not fit here"; break;
    case FagorLexer::LPAREN:
      error.message = iso && start > 0 ? "a block holds either ISO words or one ( ) statement, not both"
                                       : "the bracket ( does not fit here";
      break;
    case FagorLexer::NUMBER:
      error.message =
          iso ? "the number " + std::string(text) + " has no letter before it" : quoted(text) + " does not fit here";
      break;
    default: error.message = quoted(text) + " does not fit here"; break;
  }
}

BlockParser::BlockParser() : impl_(std::make_unique<Impl>()) {}
BlockParser::~BlockParser() = default;

bool BlockParser::parse_block(std::string_view line, syntax::Block& out, ParseError& error) {
  out.clear();
  if (const std::size_t at = frontends::find_control_byte(line, ';', '"', '"'); at != std::string_view::npos) {
    error = {{static_cast<std::uint32_t>(at + 1), 1}, describe_byte(line[at])};
    return false;
  }
  Impl& p = *impl_;
  fold_line(line, p.folded);
  p.errors.reset();
  p.input.load(p.folded);
  p.lexer.setInputStream(&p.input);
  p.tokens.setTokenSource(&p.lexer);
  p.tokens.seek(0);  // a block given up leaves the stream where its fault stood
  p.tokens.fill();
  if (p.errors.seen()) {
    p.explain(line, error);
    return false;
  }
  if (!p.within_limits(line, error)) return false;
  p.parser.setTokenStream(&p.tokens);
  FagorParser::BlockContext* tree = p.tree();
  if (p.errors.seen()) {
    p.explain(line, error);
    return false;
  }
  return read_tree(tree, line, out, error);
}

}  // namespace cnctrans::fagor
