// Reading of expressions, variables and values of the textual IR.
#include <array>
#include <utility>

#include "base/text.h"
#include "ir/text/text_reader.h"

namespace cnctrans::ir::detail {
namespace {

constexpr int depth_limit = 200;

/// How strongly an operator binds. The printer puts nested operators in parentheses, so this only serves people.
int strength(BinaryOp op) {
  switch (op) {
    case BinaryOp::logical_or:
    case BinaryOp::logical_xor: return 1;
    case BinaryOp::logical_and: return 2;
    case BinaryOp::eq:
    case BinaryOp::ne:
    case BinaryOp::lt:
    case BinaryOp::le:
    case BinaryOp::gt:
    case BinaryOp::ge: return 3;
    case BinaryOp::bit_or:
    case BinaryOp::bit_xor: return 4;
    case BinaryOp::bit_and: return 5;
    case BinaryOp::concat: return 6;
    case BinaryOp::add:
    case BinaryOp::subtract: return 7;
    case BinaryOp::multiply:
    case BinaryOp::divide:
    case BinaryOp::modulo:
    case BinaryOp::int_divide: return 8;
    case BinaryOp::power: break;
  }
  return 9;
}

/// The operator at the front of `text`, the longest that fits; 0 characters when there is none.
std::pair<BinaryOp, std::size_t> operator_at(std::string_view text) {
  std::pair<BinaryOp, std::size_t> best{BinaryOp::add, 0};
  for (std::size_t i = 0; i < EnumText<BinaryOp>::count; ++i) {
    const std::string_view name = EnumText<BinaryOp>::at(i);
    if (name.size() <= best.second || text.substr(0, name.size()) != name) continue;
    const bool is_word = is_word_start(name[0]);
    if (is_word && text.size() > name.size() && is_word_char(text[name.size()])) continue;
    best = {static_cast<BinaryOp>(i), name.size()};
  }
  return best;
}

ExprPtr shared(Expr e) {
  return std::make_shared<const Expr>(std::move(e));
}

}  // namespace

bool Reader::sign_before_number() const {
  const char next = peek_raw(1);
  return (peek_raw() == '-' || peek_raw() == '+') && (is_digit(next) || next == '.');
}

void Reader::read(Value& x) {
  const char c = peek();
  if (c == '#') {
    ++at_;
    read(x.number);
    if (peek_raw() == '"') read(x.text);
  } else if (is_digit(c) || c == '.' || sign_before_number()) {
    const std::size_t start = at_;
    read(x.number);
    x.text = program_.keep(std::string(text_.substr(start, at_ - start)));
  } else {
    x.expr = operand();
    if (ok() && !x.expr) fail("a value is expected");
  }
}

void Reader::number_node(Number& n) {
  if (accept("#")) {
    read(n.value);
    if (peek_raw() == '"') read(n.text);
  } else {
    const std::size_t start = at_;
    read(n.value);
    n.text = text_.substr(start, at_ - start);
  }
  n.integer = natural_integer(n.value);
  const char flag = peek_raw();
  if ((flag != 'i' && flag != 'r') || is_word_char(peek_raw(1))) return;
  n.integer = flag == 'i';
  ++at_;
}

ExprPtr Reader::with_suffix(Expr e) {
  e.type = natural_type(e);
  if (accept_adjacent(':')) read(e.type);
  if (accept_adjacent('^')) {
    read(e.pos.column);
    expect("+");
    read(e.pos.length);
  }
  return shared(std::move(e));
}

/// In brackets and lists a number that stands alone has no source text.
ExprPtr Reader::index() {
  if (is_digit(peek())) {
    const std::size_t start = at_;
    Number n;
    number_node(n);
    const char next = peek();
    if (ok() && (next == ',' || next == ']' || next == ')')) {
      n.text.clear();
      Expr e;
      e.node = std::move(n);
      return shared(std::move(e));
    }
    at_ = start;
  }
  return expression(0);
}

void Reader::index_list(std::string_view close, std::vector<ExprPtr>& list) {
  if (accept(close)) return;
  do {
    list.push_back(index());
  } while (accept(","));
  expect(close);
}

void Reader::exprs(std::string_view, std::vector<ExprPtr>& list) {
  if (accept("(")) index_list(")", list);
}

void Reader::read(VarRef& x) {
  space("space", x.space);
  if (accept_adjacent('[')) {
    x.index = index();
    expect("]");
  }
  if (!accept_adjacent('.')) return;
  if (peek_raw() == '"') {
    read(x.name);
  } else {
    x.name = take_word();
  }
  if (accept_adjacent('[')) index_list("]", x.indices);
}

void Reader::call_or_system(std::string_view name, Expr& e) {
  if (name == "axis") {
    AxisName a;
    axis(name, a.axis);
    expect(")");
    e.node = a;
    return;
  }
  if (name == "sys" || name == "given") {
    SystemRef s;
    s.given = name == "given";
    read(s.datum);
    expect(",");
    axis(name, s.axis);
    expect(",");
    read(s.text);
    if (accept(",")) {
      index_list(")", s.args);
    } else {
      expect(")");
    }
    e.node = std::move(s);
    return;
  }
  const auto function = enum_value<Function>(name);
  if (!function) return fail("unknown function " + std::string(name));
  Call c;
  c.function = *function;
  index_list(")", c.args);
  e.node = std::move(c);
}

ExprPtr Reader::operand() {
  if (failed_) return nullptr;
  if (depth_ > depth_limit) {
    fail("expressions are nested too deeply");
    return nullptr;
  }
  Expr e;
  const char c = peek();
  if (c == '(') {
    ++at_;
    ++depth_;
    const ExprPtr inner = expression(0);
    --depth_;
    expect(")");
    if (!ok() || !inner || (peek_raw() != ':' && peek_raw() != '^')) return inner;
    return with_suffix(*inner);
  }
  if (c == '-' || peek_word() == "not" || peek_word() == "bitnot") {
    Unary u;
    u.op = c == '-' ? UnaryOp::negate : c == 'n' ? UnaryOp::logical_not : UnaryOp::bit_not;
    if (c == '-') {
      ++at_;
    } else {
      take_word();
    }
    ++depth_;
    u.operand = operand();
    --depth_;
    e.node = std::move(u);
    e.type = natural_type(e);
    return shared(std::move(e));
  }
  if (is_digit(c) || c == '.' || c == '#') {
    Number n;
    number_node(n);
    e.node = std::move(n);
    return with_suffix(std::move(e));
  }
  if (c == '"') {
    String s;
    read(s.text);
    e.node = std::move(s);
    return with_suffix(std::move(e));
  }
  const std::string_view name = peek_word();
  if (name == "nothing") {
    take_word();
    return nullptr;
  }
  if (name.empty()) {
    fail("an expression is expected");
    return nullptr;
  }
  const std::size_t start = at_;
  take_word();
  std::optional<RoundHalf> half;
  if (enum_value<Function>(name) && accept_adjacent('.')) half = enum_value<RoundHalf>(take_word());
  ++depth_;
  if (accept_adjacent('(')) {
    call_or_system(name, e);
    if (auto* call = std::get_if<Call>(&e.node); call != nullptr && half) call->half = *half;
  } else {
    at_ = start;
    VarRef v;
    read(v);
    e.node = std::move(v);
  }
  --depth_;
  return ok() ? with_suffix(std::move(e)) : nullptr;
}

ExprPtr Reader::expression(int lowest) {
  ExprPtr left = operand();
  while (ok()) {
    skip_blanks();
    const auto [op, length] = operator_at(text_.substr(at_));
    if (length == 0 || strength(op) < lowest) break;
    at_ += length;
    Binary b;
    b.op = op;
    b.compare = accept_adjacent('~') ? Compare::relative_1e12 : Compare::exact;
    b.left = std::move(left);
    ++depth_;
    b.right = expression(strength(op) + 1);
    --depth_;
    Expr e;
    e.node = std::move(b);
    e.type = natural_type(e);
    left = shared(std::move(e));
  }
  return left;
}

}  // namespace cnctrans::ir::detail
