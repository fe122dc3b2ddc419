#include "backends/sinumerik/expressions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/saturate.h"
#include "dialects/sinumerik/asked.h"
#include "dialects/sinumerik/frames.h"
#include "dialects/sinumerik/g_functions.h"
#include "dialects/sinumerik/operators.h"
#include "ir/edit/whole_numbers.h"

namespace cnctrans::backends::sinumerik {
namespace {

namespace dialect = cnctrans::sinumerik;

constexpr int weakest = 12;
constexpr int level_of(int priority) {
  return weakest - priority;
}

constexpr auto make_binary() {
  std::array<BinaryText, dialect::operators.size()> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto& row = dialect::operators[i];
    table[i] = BinaryText{row.op, row.text, static_cast<std::uint8_t>(level_of(row.priority)),
                          dialect::is_word_operator(row.text)};
  }
  return table;
}
constexpr auto make_functions() {
  std::array<FunctionText, dialect::functions.size()> table{};
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = {dialect::functions[i].function, dialect::functions[i].name};
  return table;
}
constexpr int prefix_level = level_of(dialect::prefix_priority);
constexpr int product_level = level_of(2);
constexpr int sum_level = level_of(3);
constexpr int concat_level = level_of(10);

constexpr auto binary_table = make_binary();
constexpr auto function_table = make_functions();
constexpr std::array unary_table{UnaryText{ir::UnaryOp::negate, "-", prefix_level},
                                 UnaryText{ir::UnaryOp::logical_not, "NOT", prefix_level},
                                 UnaryText{ir::UnaryOp::bit_not, "B_NOT", prefix_level}};
constexpr ExpressionStyle expression_style{
    .binary = binary_table, .unary = unary_table, .functions = function_table, .sign_after_comparison = true};

struct SystemName {
  ir::Datum datum;
  std::string_view name;
  bool axis;
};
constexpr std::array system_names{SystemName{ir::Datum::programmed_position, "$P_EP", true},
                                  SystemName{ir::Datum::work_position, "$AA_IW", true},
                                  SystemName{ir::Datum::machine_position, "$AA_IM", true},
                                  SystemName{ir::Datum::work_offset, "$P_UIFR", true},
                                  SystemName{ir::Datum::programmed_shift, "$P_PFRAME", true},
                                  SystemName{ir::Datum::tool_number, "$P_TOOLNO", false},
                                  SystemName{ir::Datum::offset_number, "$P_TOOL", false},
                                  SystemName{ir::Datum::tool_radius, "$P_TOOLR", false},
                                  SystemName{ir::Datum::active_offset, "$P_UIFRNUM", false},
                                  SystemName{ir::Datum::frame_programmed, "$P_PFRAME", false},
                                  SystemName{ir::Datum::part_count, "$AC_ACTUAL_PARTS", false},
                                  SystemName{ir::Datum::cycle_time, "$AC_CYCLE_TIME", false}};

const SystemName* system_name(ir::Datum datum) {
  for (const SystemName& n : system_names) {
    if (n.datum == datum) return &n;
  }
  return nullptr;
}

/// The datum of an edge of a tool, both given by number (11.1): the length of a turning tool is one along X and one
/// along Z.
std::string_view tool_datum(const ir::SystemRef& s) {
  if (s.args.size() != 2) return {};
  if (s.datum == ir::Datum::tool_radius) return "$TC_DP6";
  if (s.datum != ir::Datum::tool_length) return {};
  return s.axis == ir::axis::z ? "$TC_DP4" : "$TC_DP3";
}

const ir::Call* as_call(const ir::ExprPtr& e, ir::Function f) {
  const auto* c = e ? std::get_if<ir::Call>(&e->node) : nullptr;
  return c != nullptr && c->function == f && c->args.size() == 1 ? c : nullptr;
}

std::optional<double> literal(const ir::ExprPtr& e) {
  const auto* n = e ? std::get_if<ir::Number>(&e->node) : nullptr;
  return n != nullptr ? std::optional<double>(n->value) : std::nullopt;
}

}  // namespace

bool has_system_name(const ir::SystemRef& s) {
  if (!tool_datum(s).empty()) return true;
  const bool of_active_tool = s.datum == ir::Datum::tool_radius;  // $P_TOOLR takes no index
  return system_name(s.datum) != nullptr && !(of_active_tool && !s.args.empty());
}

Expressions::Expressions(const ir::Program& program, bool own)
    : ExpressionPrinter(program, expression_style, NumberFormat{15, 12, own}), own_(own) {}

std::string Expressions::assigned(const ir::ExprPtr& e, ir::Type type) {
  const auto* text = e ? std::get_if<ir::String>(&e->node) : nullptr;
  if (own_ && text != nullptr && text->text == "\"") return "34";  // a CHAR: the mark itself can't stand in a text
  if (type == ir::Type::integer) {
    if (const ir::Call* c = as_call(e, ir::Function::to_integer)) return print(c->args[0]);
  }
  if (type == ir::Type::boolean) {
    if (const ir::Call* c = as_call(e, ir::Function::to_boolean)) return print(c->args[0]);
  }
  const auto* b = e ? std::get_if<ir::Binary>(&e->node) : nullptr;
  if (b != nullptr && ir::is_comparison(b->op) && !own_) return '(' + print(e) + ')';
  return print(e);
}

std::string Expressions::condition(const ir::ExprPtr& e) {
  if (const ir::Call* c = as_call(e, ir::Function::to_boolean)) return print(c->args[0]);
  return print(e);
}

std::string Expressions::index(const ir::ExprPtr& e) {
  return assigned(e, ir::Type::integer);
}

ir::Type Expressions::type_of(const ir::VarRef& v) const {
  return v.space < program_.spaces.size() ? program_.spaces[v.space].type : ir::Type::real;
}

std::string Expressions::name(const ir::VarRef& v) {
  if (v.name.empty()) {
    const bool r = v.space < program_.spaces.size() && program_.spaces[v.space].prefix == "R";
    if (!r) {
      problem(v.index, "a variable of another control reached the writer");
      return {};
    }
    const auto n = literal(v.index);
    if (n && *n == std::floor(*n) && *n >= 0 && *n < 1e15) return 'R' + std::to_string(saturate<std::int64_t>(*n));
    return "R[" + index(v.index) + ']';
  }
  std::string text = v.name;
  for (std::size_t i = 0; i < v.indices.size(); ++i) text += (i == 0 ? "[" : ",") + index(v.indices[i]);
  if (!v.indices.empty()) text += ']';
  return text;
}

/// ISFILE("..") and its like.
std::string Expressions::asked(const ir::SystemRef& s) {
  std::string text = s.text;
  for (std::size_t i = 0; i < s.args.size(); ++i) text += (i == 0 ? "(" : ",") + print(s.args[i]);
  return text + ')';
}

std::string Expressions::name(const ir::SystemRef& s) {
  if (const auto datum = own_ ? std::string_view{} : tool_datum(s); !datum.empty())
    return std::string(datum) + '[' + index(s.args[0]) + ',' + index(s.args[1]) + ']';
  if (s.given) return s.text;
  const SystemName* known = system_name(s.datum);
  const bool own_name = own_ && !s.text.empty();
  if (known == nullptr && !own_name) {
    problem(nullptr, "the machine datum '" + s.text + "' has no name on this control");
    return {};
  }
  std::string text = own_name ? s.text : std::string(known->name);
  if (s.datum == ir::Datum::call_has_argument && own_name && s.args.size() == 1) {  // counted from 1
    if (const auto n = literal(s.args[0]))
      return text + '[' + std::to_string(saturate<std::int32_t>(*n) + std::int64_t{1}) + ']';
    const auto* less = std::get_if<ir::Binary>(&s.args[0]->node);
    if (less != nullptr && literal(less->right) == 1.0) return text + '[' + index(less->left) + ']';
  }
  if (const auto* frame = own_name ? cnctrans::sinumerik::row_frame(s.text) : nullptr;
      frame != nullptr && s.args.size() == 1) {
    const auto row = literal(s.args[0]);
    if (!frame->indexed || !row) return text;
    return text + '[' + std::to_string(saturate<std::int32_t>(*row) - frame->row) + ']';
  }
  if (own_name && cnctrans::sinumerik::asked_function(s.text) != nullptr) return asked(s);
  std::vector<std::string> indices;
  if (s.datum == ir::Datum::work_offset || s.datum == ir::Datum::work_offset_fine) {
    for (const ir::ExprPtr& a : s.args) indices.push_back(index(a));
    indices.emplace_back(program_.axis_name(s.axis));
    indices.emplace_back(s.datum == ir::Datum::work_offset ? "TR" : "FI");
  } else if (s.datum == ir::Datum::programmed_shift && !own_name) {
    indices.emplace_back(program_.axis_name(s.axis));
    indices.emplace_back("TR");
  } else {
    if (s.axis != ir::axis::none) indices.emplace_back(program_.axis_name(s.axis));
    for (const ir::ExprPtr& a : s.args) {
      const auto* word = a ? std::get_if<ir::String>(&a->node) : nullptr;  // component names are kept as texts
      indices.push_back(word != nullptr ? word->text : index(a));
    }
  }
  for (std::size_t i = 0; i < indices.size(); ++i) text += (i == 0 ? "[" : ",") + indices[i];
  if (!indices.empty()) text += ']';
  return text;
}

std::string Expressions::variable(const ir::ExprPtr& /*e*/, const ir::VarRef& v) {
  return name(v);
}
std::string Expressions::system(const ir::ExprPtr& /*e*/, const ir::SystemRef& s) {
  return name(s);
}

Printed Expressions::number(const ir::Number& n) {
  constexpr double pi = 3.14159265358979323846;
  if (n.text.empty() && n.value == pi) return {"$PI", primary_level, false};
  return ExpressionPrinter::number(n);
}

std::string Expressions::string(const ir::ExprPtr& /*e*/, const ir::String& s) {
  std::string text = s.text;
  if (!own_) {
    for (char& c : text) {
      if (c == '"') c = '\'';
    }
  }
  return '"' + text + '"';
}

/// An operand of B_AND and its like, where the control rounds a REAL: what shall be cut is cut before.
std::string Expressions::bits(const ir::ExprPtr& e, int level, bool left) {
  if (const ir::Call* c = as_call(e, ir::Function::to_integer)) return operand(c->args[0], level, left);
  const auto* datum = std::get_if<ir::SystemRef>(&e->node);
  const bool own = datum != nullptr && datum->datum == ir::Datum::other;  // of this control, with a type of its own
  return own || ir::is_whole(e) ? operand(e, level, left) : "TRUNC(" + print(e) + ')';
}

std::optional<Printed> Expressions::special(const ir::ExprPtr& e) {
  if (const auto* b = std::get_if<ir::Binary>(&e->node)) return special_binary(e, *b);
  const auto* u = std::get_if<ir::Unary>(&e->node);
  if (u != nullptr && u->op == ir::UnaryOp::bit_not)
    return Printed{"B_NOT " + bits(u->operand, prefix_level, false), prefix_level, false};
  if (const auto* c = std::get_if<ir::Call>(&e->node)) return special_call(e, *c);
  const auto* n = std::get_if<ir::Number>(&e->node);
  if (n != nullptr && e->type == ir::Type::boolean && n->text.empty()) {
    return Printed{n->value != 0 ? "TRUE" : "FALSE", primary_level, false};
  }
  return std::nullopt;
}

/// $P_GG[6] was taken apart into its codes; the group of the first of them is that of all.
std::optional<Printed> Expressions::active_code(const ir::ExprPtr& e) {
  const ir::Expr* at = e.get();
  while (const auto* b = std::get_if<ir::Binary>(&at->node)) {
    const bool sum = b->op == ir::BinaryOp::add;
    if (!sum && b->op != ir::BinaryOp::multiply) return std::nullopt;
    const ir::ExprPtr& next = sum ? b->left : b->right;
    if (!next) return std::nullopt;
    at = next.get();
  }
  const auto* ref = std::get_if<ir::SystemRef>(&at->node);
  if (ref == nullptr || ref->text != "$P_GG" || ref->args.empty()) return std::nullopt;
  const auto number = literal(ref->args[0]);
  const auto code = saturate<std::int32_t>(number.value_or(0));
  const dialect::GFunction* g = !number    ? nullptr
                                : code < 0 ? dialect::g_function(-code / 100, -code % 100)
                                           : dialect::g_function(code);
  if (g == nullptr) return std::nullopt;
  return Printed{"$P_GG[" + std::to_string(g->group) + ']', primary_level, false};
}

std::optional<Printed> Expressions::special_binary(const ir::ExprPtr& e, const ir::Binary& b) {
  if (const auto* row = ir::works_on_bits(b.op) ? dialect::binary_operator(b.op) : nullptr) {
    const int level = level_of(row->priority);
    const std::string left = bits(b.left, level, true);
    const bool sign = !left.empty() && left.front() == '-';
    return Printed{left + ' ' + std::string(row->text) + ' ' + bits(b.right, level + 1, true), level, sign};
  }
  if (own_ && (b.op == ir::BinaryOp::add || b.op == ir::BinaryOp::multiply)) {
    if (auto text = active_code(e)) return text;
  }
  const bool integers = b.left && b.right && b.left->type == ir::Type::integer && b.right->type == ir::Type::integer;
  switch (b.op) {
    case ir::BinaryOp::power: return power(e, b);
    case ir::BinaryOp::concat: {  // the operator makes texts of its operands by itself
      const auto bare = [](const ir::ExprPtr& x) {
        const ir::Call* c = as_call(x, ir::Function::to_string);
        return c != nullptr ? c->args[0] : x;
      };
      const std::string left = operand(bare(b.left), concat_level, true);
      return Printed{left + "<<" + operand(bare(b.right), concat_level + 1, true), concat_level, false};
    }
    case ir::BinaryOp::modulo: {  // MOD is for INT only
      if (own_ || integers) return std::nullopt;
      const std::string left = operand(b.left, sum_level, true);
      return Printed{left + "-TRUNC(" + operand(b.left, product_level, true) + '/' +
                         operand(b.right, prefix_level, false) + ")*" + operand(b.right, prefix_level, false),
                     sum_level, !left.empty() && left.front() == '-'};
    }
    case ir::BinaryOp::int_divide:
      if (own_ || integers) return std::nullopt;
      return Printed{
          "TRUNC(" + operand(b.left, product_level, true) + '/' + operand(b.right, prefix_level, false) + ')',
          primary_level, false};
    default: return std::nullopt;
  }
}

/// The control has no power operator: squares, roots and small whole powers exactly, else by logarithm.
Printed Expressions::power(const ir::ExprPtr& /*e*/, const ir::Binary& b) {
  const auto exponent = literal(b.right);
  if (exponent == 2.0) return {"POT(" + print(b.left) + ')', primary_level, false};
  if (exponent == 0.5) return {"SQRT(" + print(b.left) + ')', primary_level, false};
  if (exponent == 1.0) return print_node(b.left);
  if (exponent && *exponent == std::floor(*exponent) && *exponent >= 3 && *exponent <= 8) {
    const std::string factor = operand(b.left, prefix_level, false);
    std::string text = factor;
    for (int i = 1; i < static_cast<int>(*exponent); ++i) text += '*' + factor;
    return {std::move(text), product_level, false};
  }
  return {"EXP(" + operand(b.right, product_level, true) + "*LN(" + print(b.left) + "))", primary_level, false};
}

namespace {

constexpr int chain_level = 13;  // `:` binds tighter than everything

std::string_view frame_word(ir::Function f) {
  switch (f) {
    case ir::Function::frame_shift: return "CTRANS";
    case ir::Function::frame_fine: return "CFINE";
    case ir::Function::frame_turn: return "CROT";
    case ir::Function::frame_solid_turn: return "CROTS";
    case ir::Function::frame_stretch: return "CSCALE";
    case ir::Function::frame_mirror: return "CMIRROR";
    case ir::Function::frame_inverse: return "INVFRAME";
    default: return {};
  }
}

}  // namespace

/// The name of a frame with an axis and a component: "$P_PFRAME[X,TR]", "F1[2,Z,RT]".
std::string Expressions::component(const ir::ExprPtr& frame, const ir::ExprPtr& axis, const ir::ExprPtr& part) {
  constexpr std::array<std::string_view, 5> words{"TR", "FI", "RT", "SC", "MI"};
  std::string text = print(frame);
  const bool indexed = !text.empty() && text.back() == ']';
  if (indexed) text.pop_back();
  const auto at = static_cast<std::size_t>(literal(part).value_or(0));
  return text + (indexed ? "," : "[") + print(axis) + ',' + std::string(words[std::min(at, words.size() - 1)]) + ']';
}

std::string Expressions::component_assignment(const ir::Assign::Item& item) {
  const auto* c = item.value ? std::get_if<ir::Call>(&item.value->node) : nullptr;
  if (c == nullptr || c->function != ir::Function::frame_with) return {};
  return component(c->args[0], c->args[1], c->args[2]) + '=' + print(c->args[3]);
}

/// `NAME[5]="X"`: the reader makes the whole text of it. Empty: no such assignment.
std::string Expressions::character_assignment(const ir::Assign::Item& item) {
  const auto binary = [](const ir::ExprPtr& e, ir::BinaryOp op) {
    const auto* b = e ? std::get_if<ir::Binary>(&e->node) : nullptr;
    return b != nullptr && b->op == op ? b : nullptr;
  };
  const auto part = [&item](const ir::ExprPtr& e, std::size_t size) {
    const auto* c = e ? std::get_if<ir::Call>(&e->node) : nullptr;
    const bool fits = c != nullptr && c->function == ir::Function::substring && c->args.size() == size &&
                      ir::equal(c->args[0], ir::variable(item.target, ir::Type::string));
    return fits ? c : nullptr;
  };
  const auto* whole = binary(item.value, ir::BinaryOp::concat);
  const auto* rest = whole != nullptr ? binary(whole->right, ir::BinaryOp::concat) : nullptr;
  const auto* before = rest != nullptr ? part(whole->left, 3) : nullptr;
  const auto* after = before != nullptr ? part(rest->right, 2) : nullptr;
  const auto* next = after != nullptr ? binary(after->args[1], ir::BinaryOp::add) : nullptr;
  if (next == nullptr || literal(before->args[1]) != 0.0 || literal(next->right) != 1.0 ||
      !ir::equal(before->args[2], next->left)) {
    return {};
  }
  std::string text = name(item.target);
  const bool indexed = !item.target.indices.empty();
  if (indexed) text.pop_back();
  return text + (indexed ? "," : "[") + index(next->left) + "]=" + assigned(rest->left, ir::Type::string);
}

std::optional<Printed> Expressions::frame_call(const ir::Call& c) {
  switch (c.function) {
    case ir::Function::frame_chain: {
      const std::string outer = operand(c.args[0], chain_level, true);
      return Printed{outer + ':' + operand(c.args[1], chain_level + 1, true), chain_level, false};
    }
    case ir::Function::frame_part: return Printed{component(c.args[0], c.args[1], c.args[2]), primary_level, false};
    case ir::Function::substring: {  // NAME[5]: one character
      const auto* n = c.args.size() == 3 && c.args[2] ? std::get_if<ir::Number>(&c.args[2]->node) : nullptr;
      const auto* v = c.args[0] ? std::get_if<ir::VarRef>(&c.args[0]->node) : nullptr;
      if (n == nullptr || v == nullptr || n->value != 1 || !n->text.empty()) return std::nullopt;
      std::string text = name(*v);
      const bool indexed = !v->indices.empty();
      if (indexed) text.pop_back();
      return Printed{text + (indexed ? "," : "[") + index(c.args[1]) + ']', primary_level, false};
    }
    case ir::Function::axis_text: return Printed{"AXSTRING(" + print(c.args[0]) + ')', primary_level, false};
    case ir::Function::character:
    case ir::Function::character_code: return print_node(c.args[0]);  // the language converts by itself
    default: break;
  }
  const std::string_view word = frame_word(c.function);
  if (word.empty()) return std::nullopt;
  return Printed{std::string(word) + '(' + arguments(c.args) + ')', primary_level, false};
}

std::optional<Printed> Expressions::special_call(const ir::ExprPtr& e, const ir::Call& c) {
  if (own_) {
    if (auto text = frame_call(c)) return text;
  }
  const auto one = [&](std::string_view before, std::string_view after) {
    return Printed{std::string(before) + print(c.args[0]) + std::string(after), primary_level, false};
  };
  if (c.args.empty()) return std::nullopt;
  switch (c.function) {
    case ir::Function::atan: return one("ATAN2(", ",1)");
    case ir::Function::to_integer:
    case ir::Function::round: return one("ROUND(", ")");
    case ir::Function::floor: {
      const auto minus = ir::unary(ir::UnaryOp::negate, c.args[0]);
      return Printed{"-ROUNDUP(" + print(minus) + ')', prefix_level, true};
    }
    case ir::Function::log10: {
      return Printed{"LN(" + print(c.args[0]) + ")/LN(10)", product_level, false};
    }
    case ir::Function::to_boolean:
      if (own_) return print_node(c.args[0]);  // the control converts by itself
      if (e->type == ir::Type::boolean && c.args[0]->type == ir::Type::boolean) return print_node(c.args[0]);
      return Printed{'(' + operand(c.args[0], concat_level, true) + "<>0)", primary_level, false};
    case ir::Function::to_string:
      return Printed{"<<" + operand(c.args[0], concat_level + 1, true), concat_level, false};
    default: return std::nullopt;
  }
}

}  // namespace cnctrans::backends::sinumerik
