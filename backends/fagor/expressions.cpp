#include "backends/fagor/expressions.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "backends/fagor/tables.h"
#include "base/saturate.h"
#include "base/text.h"
#include "dialects/fagor/limits.h"
#include "dialects/fagor/operators.h"
#include "dialects/fagor/variables.h"

namespace cnctrans::backends::fagor {
namespace {

namespace facts = dialects::fagor;
using ir::BinaryOp;
using ir::Datum;
using ir::ExprPtr;
using ir::Function;

ExprPtr ge_zero(BinaryOp op, const ExprPtr& e) {
  return ir::binary(op, e, ir::number(0));
}
ExprPtr truth(const ExprPtr& e) {
  return is_condition(e) ? e : ge_zero(BinaryOp::ne, e);
}
ExprPtr times(const ExprPtr& a, const ExprPtr& b) {
  return ir::binary(BinaryOp::multiply, a, b);
}
ExprPtr minus(const ExprPtr& a, const ExprPtr& b) {
  return ir::binary(BinaryOp::subtract, a, b);
}
ExprPtr plus(const ExprPtr& a, const ExprPtr& b) {
  return ir::binary(BinaryOp::add, a, b);
}
ExprPtr floor_of(const ExprPtr& x) {
  const ExprPtr cut = ir::call(Function::trunc, {x});
  return minus(cut, ir::binary(BinaryOp::lt, x, cut));
}
/// a*(a LE b)+b*(a GT b): relations are 1 or 0.
ExprPtr smaller(const ExprPtr& a, const ExprPtr& b) {
  return plus(times(a, ir::binary(BinaryOp::le, a, b)), times(b, ir::binary(BinaryOp::gt, a, b)));
}
ExprPtr larger(const ExprPtr& a, const ExprPtr& b) {
  return plus(times(a, ir::binary(BinaryOp::ge, a, b)), times(b, ir::binary(BinaryOp::lt, a, b)));
}

/// What a function that the language lacks is in functions that it has; null: nothing.
ExprPtr by_others(const ir::Call& c) {
  const auto& a = c.args;
  switch (c.function) {
    case Function::atan2: {  // ARG yields 0..360
      if (a.size() != 2) return nullptr;
      const ExprPtr arg = ir::call(Function::arg, {a[1], a[0]});
      return minus(arg, times(ir::number(360), ir::binary(BinaryOp::gt, arg, ir::number(180))));
    }
    case Function::square: return ir::binary(BinaryOp::power, a.at(0), ir::number(2));
    case Function::sign: return minus(ge_zero(BinaryOp::gt, a.at(0)), ge_zero(BinaryOp::lt, a.at(0)));
    case Function::floor: return floor_of(a.at(0));
    case Function::ln: return times(ir::call(Function::log10, {a.at(0)}), ir::number(2.302585092994046));
    case Function::exp: return ir::binary(BinaryOp::power, ir::number(2.718281828459045), a.at(0));
    case Function::to_boolean: return ge_zero(BinaryOp::ne, a.at(0));
    case Function::min:
    case Function::max: {
      ExprPtr e = a.at(0);
      for (std::size_t i = 1; i < a.size(); ++i) e = c.function == Function::min ? smaller(e, a[i]) : larger(e, a[i]);
      return e;
    }
    case Function::bound: return a.size() == 3 ? smaller(larger(a[2], a[0]), a[1]) : nullptr;
    case Function::round:
    case Function::to_integer:
      if (c.half == ir::RoundHalf::up) return floor_of(plus(a.at(0), ir::number(0.5)));
      if (c.half == ir::RoundHalf::away && c.function == Function::to_integer)
        return ir::call(Function::round, {a.at(0)});
      return nullptr;
    default: return nullptr;
  }
}

/// A constant within +-6.5: at most six digits before and five after the point (manual 11.1).
bool short_constant(std::string_view text) {
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  const auto point = text.find('.');
  const std::size_t whole = point == std::string_view::npos ? text.size() : point;
  return whole <= 6 && decimals_of(text) <= facts::constant_decimals;
}

/// Longer constants are built from short ones: 2.718281828 = 2.71828+0.18280/100000; whole ones beyond six digits in
/// hex.
Printed built_constant(double value) {
  const bool negative = value < 0;
  const std::string digits = shortest(std::fabs(value));
  const auto point = digits.find('.');
  const std::string whole = digits.substr(0, point);
  std::string rest = point == std::string::npos ? std::string{} : digits.substr(point + 1);
  std::string text;
  if (whole.size() <= 6) {
    text = whole;
  } else if (std::fabs(value) < 2147483648.0) {
    char hex[16];
    std::snprintf(hex, sizeof hex, "$%X", saturate<unsigned>(std::fabs(value)));
    text = hex;
  } else {  // groups of six digits: (123456*1000+...) by powers of 1000
    std::string left = whole;
    text = left.substr(0, left.size() % 3 == 0 ? 3 : left.size() % 3);
    left.erase(0, text.size());
    while (!left.empty()) {
      const std::string group = std::to_string(std::stoi(left.substr(0, 3)));
      text = (text.find_first_of("*+") == std::string::npos ? text : '(' + text + ')') + "*1000";
      if (group != "0") text += '+' + group;
      left.erase(0, 3);
    }
  }
  bool sum = text.find_first_of("*+") != std::string::npos;
  std::string divisor;
  const bool hex = !text.empty() && text.front() == '$';
  while (!rest.empty()) {
    const std::string group = rest.substr(0, 5);
    rest.erase(0, group.size());
    if (group.find_first_not_of('0') != std::string::npos) {
      if (divisor.empty() && !hex && !sum) {
        text += '.' + group;
      } else {
        text = (text == "0" ? "" : text + '+') + "0." + group + divisor;
        sum = true;
      }
    }
    divisor += "/100000";
  }
  if (negative) text = sum ? "-(" + text + ')' : '-' + text;
  if (sum && !negative) return {'(' + text + ')', primary_level, false};
  return {text, primary_level, negative};
}

}  // namespace

std::set<ir::Function> sayable_functions() {
  std::set<Function> all{Function::atan2, Function::square,     Function::sign,      Function::floor,
                         Function::ln,    Function::exp,        Function::min,       Function::max,
                         Function::bound, Function::to_boolean, Function::to_integer};
  for (const auto& f : facts::functions) all.insert(f.function);
  return all;
}

bool is_condition(const ExprPtr& e) {
  if (!e) return false;
  if (const auto* u = std::get_if<ir::Unary>(&e->node)) return u->op == ir::UnaryOp::logical_not;
  const auto* b = std::get_if<ir::Binary>(&e->node);
  return b != nullptr && (ir::is_comparison(b->op) || b->op == BinaryOp::logical_and || b->op == BinaryOp::logical_or ||
                          b->op == BinaryOp::logical_xor);
}

std::string system_name(const ir::SystemRef& s, bool lathe) {
  if (s.given) return s.text;
  const auto known = facts::find_variable(s.text);
  if (known.info != nullptr) return s.text;
  const std::string axis(ir::fixed_axis_name(s.axis));
  switch (s.datum) {
    case Datum::programmed_position: return axis.empty() ? "" : "PPOS" + axis;
    case Datum::machine_position: return axis.empty() ? "" : "POS" + axis;
    case Datum::work_position: return axis.empty() ? "" : "APOS" + axis;
    case Datum::work_offset: return axis.empty() || s.args.size() != 1 ? "" : "ORG" + axis;
    case Datum::programmed_shift: return axis.empty() ? "" : "ADDORG" + axis;
    case Datum::tool_number: return "TOOL";
    case Datum::next_tool: return "NXTOOL";
    case Datum::offset_number: return "TOD";
    case Datum::tool_radius: return s.args.size() == 1 ? "TOR" : "";
    case Datum::tool_length:
      if (s.args.size() != 1) return "";
      if (!lathe) return "TOL";
      return s.axis == ir::axis::x ? "TOX" : s.axis == ir::axis::z ? "TOZ" : "";
    case Datum::feed_per_minute: return "FEED";
    case Datum::feed_per_rev: return "PRGFPR";
    case Datum::spindle_speed: return s.args.empty() ? "SPEED" : "";  // of the one spindle
    case Datum::part_count: return "PARTC";
    default: return "";
  }
}

/// The reader makes n - 53 * (n > 20) of a computed index n: 54 to 59 are the rows 1 to 6. Null: not of this form.
static ExprPtr code_of_row(const ExprPtr& row) {
  const auto* difference = row ? std::get_if<ir::Binary>(&row->node) : nullptr;
  if (difference == nullptr || difference->op != ir::BinaryOp::subtract) return nullptr;
  const ExprPtr& n = difference->left;
  const auto relation = ir::binary(ir::BinaryOp::gt, n, ir::number(20));
  const auto expected = ir::binary(ir::BinaryOp::multiply, ir::number(53), relation);
  return ir::equal(difference->right, expected) ? n : nullptr;
}

Printer::Printer(const ir::Program& program, bool lathe, const NumberFormat& numbers)
    : ExpressionPrinter(program, expression_style(), numbers), lathe_(lathe) {}

std::string Printer::condition(const ExprPtr& e) {
  return print(truth(e));
}

std::string Printer::parameter(const ExprPtr& e) {
  const ir::Expr* node = e.get();
  std::string sign;
  while (node != nullptr) {
    const auto* u = std::get_if<ir::Unary>(&node->node);
    if (u == nullptr || u->op != ir::UnaryOp::negate) break;
    sign = sign.empty() ? "-" : "";
    node = u->operand.get();
  }
  const auto* v = node != nullptr ? std::get_if<ir::VarRef>(&node->node) : nullptr;
  if (v == nullptr || !v->index || !std::holds_alternative<ir::Number>(v->index->node)) return {};
  return sign + variable(e, *v);
}

/// After P, or after the name of a table: digits, a parameter, or an expression in parentheses.
std::string Printer::index(const ExprPtr& e) {
  if (const auto v = ir::constant_value(e); v && *v >= 0 && *v == std::floor(*v)) return shortest(*v);
  const auto* ref = e ? std::get_if<ir::VarRef>(&e->node) : nullptr;
  if (ref != nullptr && ref->index && std::holds_alternative<ir::Number>(ref->index->node)) return variable(e, *ref);
  return '(' + print(e) + ')';
}

std::string Printer::variable(const ExprPtr& e, const ir::VarRef& v) {
  const bool known = v.space < program_.spaces.size() && program_.spaces[v.space].prefix == "P";
  if (!known || !v.index || !v.indices.empty()) {
    problem(e, "the variable '" + v.name + "' has no parameter P of the control");
    return "P?";
  }
  if (const auto n = ir::constant_value(v.index)) {
    constexpr double most = 1e6;  // no control has so many; what is larger need not fit an integer
    const bool whole = *n == std::floor(*n) && std::fabs(*n) <= most;
    const bool own = program_.dialect == dialect_name && whole && facts::unlisted_parameter(saturate<std::int64_t>(*n));
    if (!own && (!whole || !facts::valid_parameter(saturate<std::int64_t>(*n)))) {
      problem(e, "the control has no parameter P" + shortest(*n));
    }
    const std::size_t at = e->pos.column;
    const bool letter = *n >= 0 && *n <= 25 && e->pos.length == 1 && at != 0 && at <= source_.size() &&
                        source_[at - 1] == facts::parameter_letter(saturate<int>(*n));
    if (letter) return std::string(1, source_[at - 1]);
    return 'P' + shortest(*n);
  }
  return "P(" + print(v.index) + ')';
}

std::string Printer::system(const ExprPtr& e, const ir::SystemRef& s) {
  std::string name = system_name(s, lathe_);
  if (name.empty() && program_.dialect == dialect_name) name = s.text;  // unknown to the manuals
  if (name.empty()) {
    problem(e, "the machine datum '" + (s.text.empty() ? std::string(ir::name(s.datum)) : s.text) +
                   "' has no counterpart there");
    return s.text;
  }
  if (s.args.empty()) return name;
  if (s.datum == Datum::active_modal || s.datum == Datum::spindle_state) return name + index(s.args[0]);
  const auto program = s.args.size() == 2 ? ir::constant_value(s.args[1]) : std::nullopt;
  if (program && name.starts_with("GPOS")) return name + " N" + index(s.args[0]) + " P" + shortest(*program);
  if (s.args.size() > 1) {
    name += '(';
    name += arguments(s.args);
    return name + ')';
  }
  if (s.datum == Datum::work_offset) {  // rows 1..6 are G54..G59
    const auto row = ir::constant_value(s.args[0]);
    if (row && *row >= 1 && *row <= 6) return name + shortest(*row + 53);
    if (const ExprPtr code = code_of_row(s.args[0])) return name + index(code);
  }
  return name + index(s.args[0]);
}

Printed Printer::number(const ir::Number& n) {
  if (!n.text.empty() &&
      (numbers_.verbatim || (plain_number(n.text) && short_constant(n.text) && n.text.front() != '+'))) {
    return {n.text, primary_level, n.text.front() == '-'};
  }
  if (n.value == facts::pi) return {"PI", primary_level, false};
  const std::string text = shortest(n.value);
  if (short_constant(text)) return {text, primary_level, text.front() == '-'};
  return built_constant(n.value);
}

std::string Printer::string(const ExprPtr& e, const ir::String& s) {
  problem(e, "a text can't be part of an expression there");
  return '"' + s.text + '"';
}

std::optional<Printed> Printer::special(const ExprPtr& e) {
  if (const auto* b = std::get_if<ir::Binary>(&e->node)) return special_binary(e, *b);
  if (const auto* u = std::get_if<ir::Unary>(&e->node)) return special_unary(e, *u);
  if (const auto* c = std::get_if<ir::Call>(&e->node)) return special_call(e, *c);
  return std::nullopt;
}

/// A sign may follow the word of a relation: P1 GT -20.
std::optional<Printed> Printer::comparison(const ir::Binary& b) {
  const auto* right = std::get_if<ir::Number>(&b.right->node);
  const auto* sign = std::get_if<ir::Unary>(&b.right->node);
  if (sign != nullptr && sign->op == ir::UnaryOp::negate) right = std::get_if<ir::Number>(&sign->operand->node);
  const auto* o = facts::find_operator(b.op);
  if (right == nullptr || o == nullptr || is_condition(b.left)) return std::nullopt;
  Printed value = sign != nullptr ? print_node(b.right) : number(*right);
  if (!value.signed_front) return std::nullopt;
  const Printed left = print_node(b.left);
  const auto level = level_of(o->level);
  std::string text = left.level < level ? '(' + left.text + ')' : left.text;
  text += ' ';
  text += o->word;
  return Printed{text + ' ' + value.text, level, left.signed_front && left.level >= level};
}

/// AND, OR, XOR join conditions; between numbers they would act on bits.
std::optional<Printed> Printer::special_binary(const ExprPtr& e, const ir::Binary& b) {
  if (b.op == BinaryOp::int_divide) {
    return print_node(ir::call(Function::trunc, {ir::at(ir::binary(BinaryOp::divide, b.left, b.right), e->pos)}));
  }
  if (ir::is_comparison(b.op)) return comparison(b);
  const bool logical = b.op == BinaryOp::logical_and || b.op == BinaryOp::logical_or || b.op == BinaryOp::logical_xor;
  if (!logical || (is_condition(b.left) && is_condition(b.right))) return std::nullopt;
  return print_node(ir::at(ir::binary(b.op, truth(b.left), truth(b.right)), e->pos));
}

std::optional<Printed> Printer::special_unary(const ExprPtr& e, const ir::Unary& u) {
  if (u.op == ir::UnaryOp::logical_not && !is_condition(u.operand)) {
    return print_node(ir::at(ge_zero(BinaryOp::eq, u.operand), e->pos));
  }
  if (u.op == ir::UnaryOp::bit_not && is_condition(u.operand))
    problem(e, "NOT of a condition acts on its truth there, not on its bits");
  return std::nullopt;
}

std::optional<Printed> Printer::special_call(const ExprPtr& e, const ir::Call& c) {
  const bool own = facts::find_function(c.function) != nullptr;
  if (own && !(c.function == Function::round && c.half != ir::RoundHalf::away)) return std::nullopt;
  const ExprPtr other = by_others(c);
  if (other) return print_node(ir::at(other, e->pos));
  if (own) problem(e, "the control rounds halves away from zero; this rounding has no counterpart there");
  return std::nullopt;
}

}  // namespace cnctrans::backends::fagor
