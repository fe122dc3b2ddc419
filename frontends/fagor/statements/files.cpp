#include "frontends/fagor/statements/files.h"

#include <cctype>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/fagor/limits.h"
#include "frontends/fagor/statements/expr.h"
#include "frontends/fagor/statements/statement.h"
#include "ir/edit/file_line.h"

namespace cnctrans::fagor {

namespace {

namespace facts = dialects::fagor;
using syntax::Expr;
using syntax::ExprKind;

bool digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_p(char c) {
  return c == 'P' || c == 'p';
}

/// A value in a written block has the decimals of a word: at most five (2.2).
ir::ExprPtr as_word(ir::ExprPtr value, bool negative) {
  constexpr double step = 1e5;
  if (negative) value = ir::unary(ir::UnaryOp::negate, std::move(value));
  auto steps = ir::call(ir::Function::round, {ir::binary(ir::BinaryOp::multiply, std::move(value), ir::number(step))});
  return ir::binary(ir::BinaryOp::divide, std::move(steps), ir::number(step));
}

/// The text of WRITE in pieces.
class WrittenText {
 public:
  explicit WrittenText(LowerState& state) : state_(state) {}

  /// ISO text: every parameter is its value; `X$P100` writes XP100, and a $ that follows no axis stays.
  std::vector<ir::ExprPtr> iso(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
      if (text[i] == ';') {  // a comment
        plain_ += text.substr(i);
        break;
      }
      const bool dollar = text[i] == '$' && i + 1 < text.size() && is_p(text[i + 1]);
      if (dollar) {
        const bool axis = i > 0 && std::isalpha(static_cast<unsigned char>(text[i - 1])) != 0;
        plain_ += axis ? "P" : "$P";
        for (i += 2; i < text.size() && digit(text[i]); ++i) plain_ += text[i];
      } else if (const std::size_t end = parameter(text, i); end != 0) {
        const bool negative = !plain_.empty() && plain_.back() == '-';
        if (negative || (!plain_.empty() && plain_.back() == '+')) plain_.pop_back();
        add(text.substr(i + 1, end - i - 1), negative);
        i = end;
      } else {
        plain_ += text[i++];
      }
    }
    return finish();
  }

  /// High-level text: only `?P100` is the value.
  std::vector<ir::ExprPtr> high_level(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
      const std::size_t end = text[i] == '?' ? parameter(text, i + 1) : 0;
      if (end == 0) {
        plain_ += text[i++];
        continue;
      }
      add(text.substr(i + 2, end - i - 2), false);
      i = end;
    }
    return finish();
  }

 private:
  /// The end of a parameter that begins at `i`; 0: there is none.
  static std::size_t parameter(std::string_view text, std::size_t i) {
    if (i >= text.size() || !is_p(text[i])) return 0;
    std::size_t end = text.find_first_not_of(" \t", i + 1);
    if (end == std::string_view::npos || !digit(text[end])) return 0;
    while (end < text.size() && digit(text[end])) ++end;
    const std::size_t next = text.find_first_not_of(" \t", end);
    return next != std::string_view::npos && text[next] == '=' ? 0 : end;  // G180 P1=5: an argument
  }
  void add(std::string_view number, bool negative) {
    const double n = parse_decimal(trim(number)).value_or(0);
    if (!facts::valid_parameter(saturate<std::int64_t>(n)))
      state_.error("FAG-018", {}, "the parameter P" + std::string(trim(number)) + " does not exist");
    if (!plain_.empty()) parts_.push_back(ir::string_literal(std::move(plain_)));
    plain_.clear();
    parts_.push_back(as_word(ir::numbered(parameter_space, saturate<std::int64_t>(n)), negative));
  }
  std::vector<ir::ExprPtr> finish() {
    if (!plain_.empty() || parts_.empty()) parts_.push_back(ir::string_literal(std::move(plain_)));
    return std::move(parts_);
  }

  LowerState& state_;
  std::string plain_;
  std::vector<ir::ExprPtr> parts_;
};

/// A statement of the high-level language, behind a label or skip mark.
bool is_high_level(std::string_view text) {
  const std::size_t first = text.find('(');
  return first != std::string_view::npos && text.find(';') > first;
}

}  // namespace

std::optional<ir::Message> lower_open(const syntax::Statement& s, std::string source, LowerState& state) {
  const std::size_t errors = state.errors();
  ir::FileUse use = ir::FileUse::create;
  std::string comment;
  for (std::size_t i = 1; i < s.args.size(); ++i) {
    const Expr& e = s.args[i];
    if (e.kind == ExprKind::string) {
      comment = to_upper_ascii(e.text);
    } else if (e.text == "A" || e.text == "D") {
      if (use != ir::FileUse::create) state.error("FAG-100", e.pos, "OPEN takes A or D, once [181]");
      use = e.text == "A" ? ir::FileUse::append : ir::FileUse::replace;
    } else if (e.text.size() == 1) {
      state.error("FAG-100", e.pos, "OPEN takes A (go on behind what is there) or D (delete it) [181]");
    }
  }
  constexpr double most = 999999;
  const Expr& number = s.args.at(0);
  if (number.kind == ExprKind::number && !(number.number >= 0 && number.number <= most))
    state.error("FAG-013", number.pos, "a program has a number from 0 to 999999");
  ir::Message m;
  const auto longest = static_cast<std::size_t>(facts::max_header_comment);
  if (comment.size() > longest) comment.resize(longest);
  m.parts.push_back(ir::string_literal('%' + comment + (comment.size() == longest ? ",MX," : " ,MX,")));
  ir::mark_file(m, use, std::move(source), lower_expr(number, state));
  if (state.errors() != errors) return std::nullopt;
  return m;
}

std::optional<ir::Message> lower_write(const syntax::Statement& s, std::string source, LowerState& state) {
  const std::size_t errors = state.errors();
  ir::Message m;
  const std::string text(trim(s.text));
  WrittenText written(state);
  m.parts = is_high_level(text) ? written.high_level(text) : written.iso(text);
  ir::mark_file(m, ir::FileUse::line, std::move(source), nullptr);
  if (state.errors() != errors) return std::nullopt;
  return m;
}

}  // namespace cnctrans::fagor
