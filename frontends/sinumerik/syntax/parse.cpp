#include "frontends/sinumerik/syntax/parse.h"

#include <algorithm>
#include <utility>

#include "frontends/common/control_bytes.h"
#include "frontends/sinumerik/syntax/tree.h"
#include "sinumerik/SinumerikLexer.h"
#include "sinumerik/SinumerikParser.h"

namespace cnctrans::sinumerik {

namespace {

using cnc_sinumerik::SinumerikLexer;
using cnc_sinumerik::SinumerikParser;

/// The bytes of a line as characters 0-255: comments and texts may be in any encoding, columns count bytes.
class ByteStream final : public antlr4::CharStream {
 public:
  void assign(std::string_view text) {
    text_ = text;
    at_ = 0;
  }
  void consume() override { ++at_; }
  std::size_t LA(ssize_t i) override {
    if (i == 0) return 0;
    const auto where = static_cast<ssize_t>(at_) + (i > 0 ? i - 1 : i);
    if (where < 0 || where >= static_cast<ssize_t>(text_.size())) return IntStream::EOF;
    return static_cast<unsigned char>(text_[static_cast<std::size_t>(where)]);
  }
  ssize_t mark() override { return -1; }
  void release(ssize_t) override {}
  std::size_t index() override { return at_; }
  void seek(std::size_t index) override { at_ = std::min(index, text_.size()); }
  std::size_t size() override { return text_.size(); }
  std::string getSourceName() const override { return "block"; }
  std::string toString() const override { return std::string(text_); }
  std::string getText(const antlr4::misc::Interval& interval) override {
    const auto first = static_cast<std::size_t>(std::max<ssize_t>(interval.a, 0));
    if (first >= text_.size() || interval.b < interval.a) return {};
    return std::string(text_.substr(first, static_cast<std::size_t>(interval.b - interval.a + 1)));
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

std::string_view token_text(const antlr4::Token& t, std::string_view line) {
  const std::size_t first = t.getStartIndex();
  const std::size_t stop = t.getStopIndex();
  if (first >= line.size() || stop < first) return {};
  return line.substr(first, stop - first + 1);
}

/// A word of the text in quotation marks, cut when long and with unprintable bytes replaced.
std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 24;
  std::string out = "`";
  for (const char c : text.substr(0, longest)) out += static_cast<unsigned char>(c) < 32 ? '?' : c;
  if (text.size() > longest) out += "...";
  return out + '`';
}

/// Remembers the first error and puts it in a machinist's words.
class FirstError final : public antlr4::BaseErrorListener {
 public:
  FirstError(std::string_view& line, ParseError& error) : line_(line), error_(error) {}
  void syntaxError(antlr4::Recognizer*, antlr4::Token* offending, std::size_t, std::size_t column, const std::string&,
                   std::exception_ptr) override {
    if (seen_) return;
    seen_ = true;
    error_.column = static_cast<std::uint32_t>(column) + 1;
    error_.length = 1;
    if (offending == nullptr) return;
    describe(*offending);
  }
  void reset() { seen_ = false; }
  [[nodiscard]] bool seen() const { return seen_; }

 private:
  void describe(const antlr4::Token& t) {
    const std::string_view text = token_text(t, line_);
    error_.column = static_cast<std::uint32_t>(t.getStartIndex()) + 1;
    error_.length = static_cast<std::uint32_t>(std::max<std::size_t>(text.size(), 1));
    switch (t.getType()) {
      case antlr4::Token::EOF:
      case SinumerikLexer::COMMENT:
        error_.length = 1;
        error_.message =
            "the block ends here, but something is still missing (a value, an operand or a closing bracket)";
        return;
      case SinumerikLexer::OPEN_STRING: error_.message = "the text has no closing quotation mark"; return;
      case SinumerikLexer::OTHER:
        error_.message = "the character " + quoted(text) + " has no meaning in a block";
        return;
      case SinumerikLexer::LPAREN:
      case SinumerikLexer::LBRACK:
        error_.message = quoted(text) + " can't open here; a value that is an expression needs `=` after its address";
        return;
      case SinumerikLexer::MINUS:
      case SinumerikLexer::PLUS:
        error_.message =
            quoted(text) + " is not expected here; a value that is an expression needs `=` after its address";
        return;
      default:
        error_.message = quoted(text) + " is not expected here";
        if (after_sign(t)) error_.message += "; a value that is an expression needs `=` after its address";
    }
  }

  /// `X-R1`: the sign was taken for that of a number.
  [[nodiscard]] bool after_sign(const antlr4::Token& t) const {
    std::size_t i = t.getStartIndex();
    while (i > 0 && (line_[i - 1] == ' ' || line_[i - 1] == '\t')) --i;
    return i > 0 && (line_[i - 1] == '-' || line_[i - 1] == '+');
  }

  std::string_view& line_;
  ParseError& error_;
  bool seen_ = false;
};

/// Stops at the first error, but tells the listener about it.
class ReportAndBail final : public antlr4::DefaultErrorStrategy {
 public:
  void recover(antlr4::Parser*, std::exception_ptr e) override { std::rethrow_exception(e); }
  antlr4::Token* recoverInline(antlr4::Parser* parser) override {
    antlr4::InputMismatchException e(parser);
    reportError(parser, e);
    throw antlr4::ParseCancellationException("stop");
  }
  void sync(antlr4::Parser*) override {}
};

/// Bytes before the comment; a `;` inside a text is not one.
std::size_t code_length(std::string_view line) {
  bool in_text = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') in_text = !in_text;
    if (line[i] == ';' && !in_text) return i;
  }
  return line.size();
}

}  // namespace

struct BlockParser::State {
  std::string_view line;
  ParseError scratch;
  ByteStream input;
  SinumerikLexer lexer{&input};
  antlr4::CommonTokenStream tokens{&lexer};
  SinumerikParser parser{&tokens};
  std::shared_ptr<antlr4::BailErrorStrategy> bail = std::make_shared<antlr4::BailErrorStrategy>();
  std::shared_ptr<ReportAndBail> report = std::make_shared<ReportAndBail>();
  FirstError listener{line, scratch};

  State() {
    lexer.removeErrorListeners();
    parser.removeErrorListeners();
  }

  void load(std::string_view text) {
    line = text;
    scratch = {};
    input.assign(text);
    lexer.setInputStream(&input);
    tokens.setTokenSource(&lexer);
    tokens.fill();
  }

  /// Nesting and runs of signs that would make the recursive parser deep.
  [[nodiscard]] const antlr4::Token* too_deep() {
    int depth = 0;
    int run = 0;
    for (const antlr4::Token* t : tokens.getTokens()) {
      switch (t->getType()) {
        case SinumerikLexer::LPAREN:
        case SinumerikLexer::LBRACK: ++depth; break;
        case SinumerikLexer::RPAREN:
        case SinumerikLexer::RBRACK: --depth; break;
        case SinumerikLexer::PLUS:
        case SinumerikLexer::MINUS:
        case SinumerikLexer::NOT:
        case SinumerikLexer::B_NOT:
        case SinumerikLexer::CONCAT: ++run; break;
        default: run = 0;
      }
      if (depth > max_nesting || run > max_nesting) return t;
    }
    return nullptr;
  }

  SinumerikParser::BlockContext* parse_fast() {
    parser.getInterpreter<antlr4::atn::ParserATNSimulator>()->setPredictionMode(antlr4::atn::PredictionMode::SLL);
    parser.setErrorHandler(bail);
    parser.setTokenStream(&tokens);
    try {
      return parser.block();
    } catch (const antlr4::ParseCancellationException&) {
      return nullptr;
    }
  }

  SinumerikParser::BlockContext* parse_slow() {
    parser.getInterpreter<antlr4::atn::ParserATNSimulator>()->setPredictionMode(antlr4::atn::PredictionMode::LL);
    parser.setErrorHandler(report);
    listener.reset();
    parser.addErrorListener(&listener);
    tokens.seek(0);  // setTokenStream does not rewind
    parser.setTokenStream(&tokens);
    SinumerikParser::BlockContext* tree = nullptr;
    try {
      tree = parser.block();
    } catch (const antlr4::RecognitionException&) {
    } catch (const antlr4::ParseCancellationException&) {
    }
    parser.removeErrorListeners();
    return listener.seen() ? nullptr : tree;
  }

  /// After a failure: what stands before the block and the comment behind it.
  void salvage(syntax::Block& out) {
    out.clear();
    const auto& list = tokens.getTokens();
    for (const antlr4::Token* t : list) {
      if (t->getType() != SinumerikLexer::COMMENT) continue;
      const std::string_view text = token_text(*t, line);
      out.comments.push_back(syntax::Comment{text.substr(1), WordPos{static_cast<std::uint32_t>(t->getStartIndex()) + 1,
                                                                     static_cast<std::uint32_t>(text.size())}});
    }
    std::size_t at = 0;
    const auto type = [&](std::size_t i) { return i < list.size() ? list[i]->getType() : antlr4::Token::EOF; };
    if (type(at) == SinumerikLexer::SLASH) at += type(at + 1) == SinumerikLexer::INTEGER ? 2 : 1;
    if ((type(at) == SinumerikLexer::LETTER_N || type(at) == SinumerikLexer::COLON) &&
        type(at + 1) == SinumerikLexer::INTEGER) {
      out.number = token_text(*list[at + 1], line);
      out.number_mark = type(at) == SinumerikLexer::COLON ? ':' : 'N';
      const auto first = static_cast<std::uint32_t>(list[at]->getStartIndex());
      out.number_pos = WordPos{first + 1, static_cast<std::uint32_t>(list[at + 1]->getStopIndex()) + 1 - first};
    }
  }
};

BlockParser::BlockParser() : state_(std::make_unique<State>()) {}
BlockParser::~BlockParser() = default;
BlockParser::BlockParser(BlockParser&&) noexcept = default;
BlockParser& BlockParser::operator=(BlockParser&&) noexcept = default;

bool BlockParser::parse_block(std::string_view line, syntax::Block& out, ParseError& error) {
  out.clear();
  error = {};
  State& s = *state_;
  if (code_length(line) > max_block_bytes) {
    error.column = static_cast<std::uint32_t>(max_block_bytes) + 1;
    error.message =
        "the block is longer than " + std::to_string(max_block_bytes) + " bytes; the control takes 512 characters";
    return false;
  }
  if (const std::size_t at = frontends::find_control_byte(line, ';', '"', '"'); at != std::string_view::npos) {
    error.column = static_cast<std::uint32_t>(at + 1);
    error.message = "a byte with code " + std::to_string(line[at]) + " has no meaning in a block";
    return false;
  }
  s.load(line);
  if (s.tokens.size() > max_block_tokens) {
    error.column = static_cast<std::uint32_t>(s.tokens.get(max_block_tokens)->getStartIndex()) + 1;
    error.message =
        "the block has more than " + std::to_string(max_block_tokens) + " parts; the control takes 512 characters";
    s.salvage(out);
    return false;
  }
  if (const antlr4::Token* t = s.too_deep(); t != nullptr) {
    error.column = static_cast<std::uint32_t>(t->getStartIndex()) + 1;
    error.message = "brackets or signs are nested deeper than " + std::to_string(max_nesting);
    s.salvage(out);
    return false;
  }
  SinumerikParser::BlockContext* tree = s.parse_fast();
  if (tree == nullptr) tree = s.parse_slow();
  if (tree != nullptr && build_block(*tree, line, out, error)) return true;
  if (tree == nullptr) error = s.scratch;
  if (error.message.empty()) error.message = "the block can't be read";
  s.salvage(out);
  return false;
}

}  // namespace cnctrans::sinumerik
