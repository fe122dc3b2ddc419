#include "frontends/sinumerik/state/expr.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/sinumerik/addresses.h"
#include "dialects/sinumerik/asked.h"
#include "dialects/sinumerik/limits.h"
#include "dialects/sinumerik/operators.h"
#include "ir/edit/whole_numbers.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

namespace {

bool is_logical(std::string_view op) {
  return op == "AND" || op == "OR" || op == "XOR";
}
bool is_relation(std::string_view op) {
  return op == "==" || op == "<>" || op == ">" || op == "<" || op == ">=" || op == "<=" || op == "=";
}

ir::Type arithmetic_type(ir::BinaryOp op, ir::Type left, ir::Type right) {
  switch (op) {
    case ir::BinaryOp::add:
    case ir::BinaryOp::subtract:
    case ir::BinaryOp::multiply:
    case ir::BinaryOp::modulo:
    case ir::BinaryOp::int_divide:
      return left == ir::Type::integer && right == ir::Type::integer ? ir::Type::integer : ir::Type::real;
    case ir::BinaryOp::bit_and:
    case ir::BinaryOp::bit_or:
    case ir::BinaryOp::bit_xor: return ir::Type::integer;
    case ir::BinaryOp::divide:
    case ir::BinaryOp::power: return ir::Type::real;
    case ir::BinaryOp::concat: return ir::Type::string;
    default: return ir::Type::boolean;
  }
}

bool is_search(ir::Function f) {
  return f == ir::Function::index_of || f == ir::Function::last_index_of || f == ir::Function::index_of_any;
}

/// A system variable that is known by its name only: its type is not known either.
bool is_unknown_datum(const ir::ExprPtr& e) {
  const auto* ref = std::get_if<ir::SystemRef>(&e->node);
  return ref != nullptr && ref->datum == ir::Datum::other;
}

/// What `name` means without a symbol: TRUE, FALSE.
std::optional<double> constant_name(std::string_view name) {
  if (name == "TRUE") return 1;
  if (name == "FALSE") return 0;
  return std::nullopt;
}

}  // namespace

ir::ExprPtr ExprLowering::lower(const Expr& e) {
  switch (e.kind) {
    case ExprKind::number: {
      ir::Number n;
      n.value = e.number;
      n.text = e.text;
      const bool based = !e.text.empty() && e.text.front() == '\'';
      n.integer = based || e.text.find_first_of(".Xx") == std::string::npos;
      if (!based && e.text.find_first_of("Xx") != std::string::npos)
        n.text.clear();  // plain decimals travel as text, 'H1F' for its own language
      const ir::Type type = n.integer ? ir::Type::integer : ir::Type::real;
      return make_expr(std::move(n), type, e.pos);
    }
    case ExprKind::string: return make_expr(ir::String{e.text}, ir::Type::string, e.pos);
    case ExprKind::variable:
    case ExprKind::name: return named(e);
    case ExprKind::unary: return unary(e);
    case ExprKind::binary: return binary(e);
    case ExprKind::call: return call(e);
    case ExprKind::missing: break;
  }
  c_.error("SIN-012", e.pos, "a value is missing here");
  return nullptr;
}

ir::ExprPtr ExprLowering::convert(ir::ExprPtr e, ir::Type type, WordPos pos) {
  if (!e || e->type == type || is_unknown_datum(e)) return e;
  const bool from_string = e->type == ir::Type::string;
  const bool to_string = type == ir::Type::string;
  if (to_string && (e->type == ir::Type::real || e->type == ir::Type::integer || e->type == ir::Type::boolean)) {
    c_.keep("SIN-012", pos, "a number for a text is not carried yet", "use `<<` to make a text of a number");
    return nullptr;
  }
  if (e->type == ir::Type::frame || type == ir::Type::frame) {
    c_.error("SIN-012", pos, "a frame can't stand for a " + std::string(ir::name(type)));
    return nullptr;
  }
  if (from_string && (type == ir::Type::integer || type == ir::Type::real)) {  // a CHAR counts as its code
    const auto* variable = std::get_if<ir::VarRef>(&e->node);
    const auto* call = std::get_if<ir::Call>(&e->node);
    if (variable != nullptr || (call != nullptr && call->function == ir::Function::substring))
      return make_expr(ir::Call{ir::Function::character_code, {std::move(e)}}, ir::Type::integer, pos);
  }
  if (from_string && type == ir::Type::boolean) {  // an empty text is FALSE
    return make_expr(ir::Binary{ir::BinaryOp::ne, std::move(e), ir::string_literal({}), ir::Compare::exact},
                     ir::Type::boolean, pos);
  }
  if (from_string != to_string || e->type == ir::Type::axis || type == ir::Type::axis) {
    c_.error("SIN-012", pos,
             "a value of type " + std::string(ir::name(e->type)) + " can't become " + std::string(ir::name(type)),
             from_string ? "use NUMBER() to read a number from a text" : "use `<<` to make a text of a number");
    return nullptr;
  }
  if (type == ir::Type::real) return e;
  if (type == ir::Type::integer) {
    if (e->type == ir::Type::boolean) return e;
    if (const auto* n = std::get_if<ir::Number>(&e->node); n != nullptr && n->value == std::trunc(n->value)) return e;
    return make_expr(ir::Call{ir::Function::to_integer, {std::move(e)}, ir::RoundHalf::away}, ir::Type::integer, pos);
  }
  if (const auto* n = std::get_if<ir::Number>(&e->node); n != nullptr && (n->value == 0 || n->value == 1)) return e;
  return make_expr(ir::Call{ir::Function::to_boolean, {std::move(e)}, ir::RoundHalf::away}, ir::Type::boolean, pos);
}

ir::ExprPtr ExprLowering::lower_character(const Expr& e) {
  ir::ExprPtr value = lower(e);
  if (value && value->type == ir::Type::string) {
    const auto* text = std::get_if<ir::String>(&value->node);
    const auto begins = [](char ch) { return (static_cast<unsigned char>(ch) & 0xC0U) != 0x80U; };  // no UTF-8 tail
    if (text == nullptr || std::count_if(text->text.begin(), text->text.end(), begins) <= 1) return value;
    c_.error("SIN-114", e.pos, "a CHAR takes one character, and this text has more");
    return nullptr;
  }
  if (!value) return nullptr;
  const auto* n = std::get_if<ir::Number>(&value->node);
  if (n != nullptr && n->value >= 1 && n->value <= 127 && n->value == std::trunc(n->value))
    return make_expr(ir::String{std::string(1, static_cast<char>(saturate<unsigned char>(n->value)))}, ir::Type::string,
                     e.pos);
  value = convert(std::move(value), ir::Type::integer, e.pos);
  if (!value) return nullptr;
  return make_expr(ir::Call{ir::Function::character, {std::move(value)}}, ir::Type::string, e.pos);
}

ir::ExprPtr ExprLowering::lower_as(const Expr& e, ir::Type type) {
  return convert(lower(e), type, e.pos);
}

// --- variables --------------------------------------------------------------------------------------------------

ir::VarRef ExprLowering::r_parameter(const Expr& index, bool& ok) {
  ir::VarRef ref;
  ref.space = space::r;
  ref.index = lower_as(index, ir::Type::integer);
  ok = ref.index != nullptr;
  if (ok && !c_.real_time.cells.empty()) ok = settled(ref, index);
  if (const auto* n = ok ? std::get_if<ir::Number>(&ref.index->node) : nullptr; n != nullptr) {
    if (n->value < 0 || n->value > r_parameter_max) {
      c_.error("SIN-017", index.pos, "there is no R parameter with this number",
               "R0 to R" + std::to_string(r_parameter_max));
      ok = false;
    } else if (n->value >= c_.machine.r_count) {
      c_.beyond_r_parameters(index.pos);
    }
    ir::Number plain = *n;
    plain.text.clear();  // R01 is R1
    ref.index = make_expr(std::move(plain), ir::Type::integer, index.pos);
  }
  return ref;
}

std::optional<ir::VarRef> ExprLowering::variable(const Expr& e, ir::Type& type) {
  type = ir::Type::real;
  if (e.text == "R" && e.args.size() == 1) {
    bool ok = false;
    ir::VarRef ref = r_parameter(e.args[0], ok);
    if (!ok) return std::nullopt;
    return ref;
  }
  const Symbol* symbol = c_.symbol(e.text);
  if (symbol != nullptr && !c_.prepared.empty() && !told_by_contour(e)) return std::nullopt;
  if (symbol == nullptr) {
    if (is_reserved(e.text)) {
      c_.keep("SIN-007", e.pos, "the value of " + e.text + " is not carried yet");
      return std::nullopt;
    }
    if (c_.machine.options.undefined_names != UndefinedNames::global) {
      c_.keep("SIN-006", e.pos, e.text + " is not defined in this program; a variable of the program is needed here");
      return std::nullopt;
    }
    if (c_.first_time(e.text)) {
      c_.warning("SIN-006", e.pos,
                 e.text + " is not defined in this program: taken as a global user variable that starts at 0");
    }
  }
  ir::VarRef ref;
  ref.space = symbol != nullptr ? symbol->space : space::global_real;
  ref.name = e.text;
  if (symbol != nullptr) type = symbol->type;
  if (symbol != nullptr && e.args.empty() && symbol->dimensions != 0) {
    c_.keep("SIN-008", e.pos, "the array " + e.text + " as a whole is not carried yet");
    return std::nullopt;
  }
  if (symbol != nullptr && e.args.size() != symbol->dimensions) {
    c_.error("SIN-017", e.pos,
             e.text + " has " + std::to_string(symbol->dimensions) + " dimensions, but " +
                 std::to_string(e.args.size()) + " indices are written");
    return std::nullopt;
  }
  for (const Expr& index : e.args) {
    ref.indices.push_back(lower_as(index, ir::Type::integer));
    if (!ref.indices.back()) return std::nullopt;
  }
  return ref;
}

std::optional<ir::VarRef> ExprLowering::whole_array(const Expr& e, ir::Type& type) {
  const Symbol* symbol = e.kind == ExprKind::name || e.kind == ExprKind::variable ? c_.symbol(e.text) : nullptr;
  if (symbol == nullptr || symbol->dimensions == 0 || !e.args.empty()) return std::nullopt;
  if (!may_be_read(e) || !told_by_contour(e)) return std::nullopt;
  ir::VarRef ref;
  ref.space = symbol->space;
  ref.name = e.text;
  type = symbol->type;
  return ref;
}

/// False (reported) for what no text tells of a table of a prepared contour: some columns, and so the table as a whole.
bool ExprLowering::told_by_contour(const Expr& e) {
  const auto it = c_.prepared.find(e.text);
  if (it == c_.prepared.end()) return true;
  constexpr double columns = 11;
  const bool literal =
      e.args.size() == 2 && e.args[1].kind == ExprKind::number && e.args[1].number >= 0 && e.args[1].number < columns;
  if (literal && (it->second >> static_cast<unsigned>(e.args[1].number) & 1U) == 0) return true;
  c_.keep("SIN-140", e.pos,
          std::string(c_.slice(e.pos)) + ": this part of the table of a prepared contour is known to the control only",
          "columns are read by a written number; 7 (extremes of the contour) is not described");
  return false;
}

/// False (reported) when a procedure that the run goes past has set the variable.
bool ExprLowering::may_be_read(const Expr& e) {
  if (c_.symbol(e.text) == nullptr) return true;
  c_.read_names.insert(e.text);
  if (!c_.unknown_names.contains(e.text)) return true;
  c_.keep("SIN-046", e.pos, e.text + " has got its value from the machine or from a file: no run knows it");
  return false;
}

/// `NAME[5]` of a text: the character at this place.
ir::ExprPtr ExprLowering::character_of(const Expr& e) {
  Expr whole = e;
  whole.args.pop_back();
  ir::ExprPtr text = named(whole);
  ir::ExprPtr at = text ? lower_as(e.args.back(), ir::Type::integer) : nullptr;
  if (!at) return nullptr;
  return make_expr(ir::Call{ir::Function::substring, {std::move(text), std::move(at), ir::number(1)}}, ir::Type::string,
                   e.pos);
}

ir::ExprPtr ExprLowering::named(const Expr& e) {
  if (!e.text.empty() && e.text[0] == '$') return system_operand(e);
  if (!may_be_read(e)) return nullptr;
  if (const Symbol* symbol = c_.symbol(e.text); symbol != nullptr) {
    if (symbol->type == ir::Type::string && e.args.size() == symbol->dimensions + 1U) return character_of(e);
    if (symbol->type == ir::Type::frame) {
      const std::uint32_t before = c_.errors;
      auto name = frame_name(e);
      if (name && !name->component) return name->whole;
      if (name) {
        return make_expr(ir::Call{ir::Function::frame_part, {name->whole, name->axis, name->component}}, ir::Type::real,
                         e.pos);
      }
      if (c_.errors == before)
        c_.error("SIN-012", e.pos, e.text + " is a frame: its components are TR, FI, RT, SC, MI");
      return nullptr;
    }
  }
  if (e.kind == ExprKind::name && c_.symbol(e.text) == nullptr) {
    if (const auto constant = constant_name(e.text); constant) {
      return make_expr(ir::Number{*constant, {}, true}, ir::Type::boolean, e.pos);
    }
    if (const ir::AxisId id = c_.machine.axis(e.text); id != ir::axis::none) {
      return make_expr(ir::AxisName{id}, ir::Type::axis, e.pos);
    }
  }
  if (is_undefined(e)) {
    const std::uint32_t before = c_.errors;
    ir::SystemRef ref = undefined(e);
    if (c_.errors != before) return nullptr;
    return make_expr(std::move(ref), ir::Type::real, e.pos);
  }
  ir::Type type = ir::Type::real;
  auto ref = variable(e, type);
  if (!ref) return nullptr;
  return make_expr(std::move(*ref), type, e.pos);
}

// --- operators --------------------------------------------------------------------------------------------------

/// An operand of B_AND and its like: a REAL becomes an INT first, and that rounds (4.3, 4.4).
ir::ExprPtr ExprLowering::whole_bits(ir::ExprPtr e, WordPos pos) {
  return ir::is_whole(e) ? std::move(e) : convert(std::move(e), ir::Type::integer, pos);
}

ir::ExprPtr ExprLowering::unary(const Expr& e) {
  if (e.text == "<<") return as_string(lower(e.args[0]));
  ir::ExprPtr operand = lower(e.args[0]);
  if (!operand) return nullptr;
  if (operand->type == ir::Type::string || operand->type == ir::Type::axis) {
    c_.error("SIN-012", e.pos, "`" + e.text + "` needs a number");
    return nullptr;
  }
  if (e.text == "+") return operand;
  if (e.text == "NOT") {
    return make_expr(ir::Unary{ir::UnaryOp::logical_not, std::move(operand)}, ir::Type::boolean, e.pos);
  }
  if (e.text == "B_NOT") {
    operand = whole_bits(std::move(operand), e.args[0].pos);
    if (!operand) return nullptr;
    return make_expr(ir::Unary{ir::UnaryOp::bit_not, std::move(operand)}, ir::Type::integer, e.pos);
  }
  const ir::Type type = operand->type == ir::Type::boolean ? ir::Type::integer : operand->type;
  return make_expr(ir::Unary{ir::UnaryOp::negate, std::move(operand)}, type, e.pos);
}

/// `R1==1 AND R2==2` is `R1==(1 AND R2)==2` on this control: almost never what was meant.
void ExprLowering::warn_priority(const Expr& e) {
  if (!is_relation(e.text)) return;
  for (const Expr& a : e.args) {
    const bool loose =
        (a.kind == ExprKind::binary && is_logical(a.text)) || (a.kind == ExprKind::unary && a.text == "NOT");
    if (!loose || a.pos.column == 0) continue;
    std::size_t before = a.pos.column - 1;
    while (before > 0 && (c_.text[before - 1] == ' ' || c_.text[before - 1] == '\t')) --before;
    if (before > 0 && c_.text[before - 1] == '(' && &a != &e.args[0]) continue;
    const std::size_t after = c_.text.find_first_not_of(" \t", a.pos.column - 1 + a.pos.length);
    if (&a == &e.args[0] && after != std::string_view::npos && c_.text[after] == ')') continue;
    c_.warning("SIN-014", e.pos,
               "comparisons bind weaker than " + a.text + ": this compares the result of `" +
                   std::string(c_.slice(a.pos)) + "`",
               "put the comparisons in parentheses");
    return;
  }
}

ir::ExprPtr ExprLowering::as_string(ir::ExprPtr e) {
  if (!e || e->type == ir::Type::string || is_unknown_datum(e)) return e;
  const WordPos pos = e->pos;
  if (e->type == ir::Type::axis || e->type == ir::Type::frame) {
    c_.error("SIN-012", pos, "an axis can't be made a text by `<<`", "use AXSTRING()");
    return nullptr;
  }
  return make_expr(ir::Call{ir::Function::to_string, {std::move(e)}, ir::RoundHalf::away}, ir::Type::string, pos);
}

ir::ExprPtr ExprLowering::concat(const Expr& e) {
  ir::ExprPtr left = as_string(lower(e.args[0]));
  ir::ExprPtr right = as_string(lower(e.args[1]));
  if (!left || !right) return nullptr;
  return make_expr(ir::Binary{ir::BinaryOp::concat, std::move(left), std::move(right), ir::Compare::exact},
                   ir::Type::string, e.pos);
}

ir::ExprPtr ExprLowering::binary(const Expr& e) {
  if (e.text == "<<") return concat(e);
  if (e.text == ":") return frame(e);
  warn_priority(e);
  std::string_view op = e.text;
  if (op == "=") op = "==";
  if (op == "=<") op = "<=";
  if (op == "=>") op = ">=";
  if (op != e.text) {
    c_.warning("SIN-013", e.pos, "`" + e.text + "` in a condition is read as the comparison `" + std::string(op) + "`",
               "write `" + std::string(op) + "`");
  }
  const OperatorRow* row = binary_operator(op);
  ir::ExprPtr left = lower(e.args[0]);
  ir::ExprPtr right = lower(e.args[1]);
  if (!left || !right || row == nullptr) return nullptr;
  const bool relation = ir::is_comparison(row->op);
  const auto is_number = [](ir::Type t) {
    return t == ir::Type::real || t == ir::Type::integer || t == ir::Type::boolean;
  };
  const bool counts = relation || (row->op != ir::BinaryOp::concat && row->op != ir::BinaryOp::power);
  const auto is_character = [](const ir::ExprPtr& x) {
    const auto* call = std::get_if<ir::Call>(&x->node);
    return x->type == ir::Type::string && (std::holds_alternative<ir::VarRef>(x->node) ||
                                           (call != nullptr && call->function == ir::Function::substring));
  };
  if (counts && is_character(left) && is_number(right->type) && !is_unknown_datum(right)) {
    left = convert(std::move(left), ir::Type::integer, e.args[0].pos);  // a CHAR beside a number
  } else if (counts && is_character(right) && is_number(left->type) && !is_unknown_datum(left)) {
    right = convert(std::move(right), ir::Type::integer, e.args[1].pos);
  }
  if (!left || !right) return nullptr;
  if (left->type == ir::Type::frame || right->type == ir::Type::frame) {
    c_.error("SIN-012", e.pos, "`" + e.text + "` can't work on frames");
    return nullptr;
  }
  const bool texts = left->type == ir::Type::string || right->type == ir::Type::string;
  const bool axes = left->type == ir::Type::axis || right->type == ir::Type::axis;
  const bool unknown = is_unknown_datum(left) || is_unknown_datum(right);
  if (!unknown && (texts || axes) &&
      (left->type != right->type || (row->op != ir::BinaryOp::eq && row->op != ir::BinaryOp::ne))) {
    c_.error("SIN-012", e.pos,
             "`" + e.text + "` can't join " + std::string(ir::name(left->type)) + " and " +
                 std::string(ir::name(right->type)));
    return nullptr;
  }
  if (relation && unknown && left->type != right->type && (texts || axes)) {
    // The unknown side is of the type of the other.
    const auto as = [](const ir::ExprPtr& e2, ir::Type type) {
      ir::Expr copy = *e2;
      copy.type = type;
      return std::make_shared<const ir::Expr>(std::move(copy));
    };
    if (is_unknown_datum(left))
      left = as(left, right->type);
    else
      right = as(right, left->type);
  }
  if (ir::works_on_bits(row->op)) {
    left = whole_bits(std::move(left), e.args[0].pos);
    right = whole_bits(std::move(right), e.args[1].pos);
    if (!left || !right) return nullptr;
  }
  const bool reals = left->type == ir::Type::real || right->type == ir::Type::real;
  const bool order = row->op == ir::BinaryOp::gt || row->op == ir::BinaryOp::lt;
  const bool within = relation && reals && !(order && c_.machine.options.exact_greater);
  const ir::Compare compare = within ? ir::Compare::relative_1e12 : ir::Compare::exact;
  const ir::Type type = arithmetic_type(row->op, left->type, right->type);
  return make_expr(ir::Binary{row->op, std::move(left), std::move(right), compare}, type, e.pos);
}

ir::ExprPtr ExprLowering::call(const Expr& e) {
  bool known = false;
  if (auto made = axis_function(e, known); known) return made;
  if (asked_function(e.text) != nullptr && c_.symbol(e.text) == nullptr) return asked(e);
  const FunctionRow* row = expression_function(e.text);
  if (row == nullptr) {
    const bool attribute_word = attribute(e.text) != Attribute::none;
    if (attribute_word) {
      c_.error("SIN-007", e.pos, e.text + "() may stand only right of an address");
    } else {
      c_.keep("SIN-007", e.pos, "the function " + e.text + "() is not carried yet");
    }
    return nullptr;
  }
  if (e.args.size() < row->arguments_min || e.args.size() > row->arguments_max) {
    c_.error(
        "SIN-012", e.pos,
        e.text + "() takes " + std::to_string(row->arguments_min) + " values, not " + std::to_string(e.args.size()));
    return nullptr;
  }
  std::vector<ir::ExprPtr> args;
  bool integers = true;
  const bool wants_texts = row->result == ir::Type::string || row->function == ir::Function::string_length ||
                           is_search(row->function) || row->function == ir::Function::to_number ||
                           row->function == ir::Function::is_number;
  for (const Expr& a : e.args) {
    ir::ExprPtr arg = lower(a);
    if (!arg) return nullptr;
    const bool text_expected = wants_texts && (args.empty() || is_search(row->function));
    const bool fits = (arg->type == ir::Type::string) == text_expected && arg->type != ir::Type::axis;
    if (!fits && !is_unknown_datum(arg)) {
      c_.error("SIN-012", a.pos, e.text + "() needs a " + (text_expected ? "text" : "number") + " here");
      return nullptr;
    }
    integers = integers && arg->type == ir::Type::integer;
    args.push_back(std::move(arg));
  }
  const bool keeps_integer = row->function == ir::Function::abs || row->function == ir::Function::min ||
                             row->function == ir::Function::max || row->function == ir::Function::bound ||
                             row->function == ir::Function::ceil;
  const ir::Type type = keeps_integer && integers ? ir::Type::integer : row->result;
  return make_expr(ir::Call{row->function, std::move(args), ir::RoundHalf::away}, type, e.pos);
}

// --- values of words --------------------------------------------------------------------------------------------

}  // namespace cnctrans::sinumerik
