#include "ir/expr.h"

#include <array>
#include <cmath>
#include <utility>

namespace cnctrans::ir {

ExprPtr number(double value, std::string text) {
  Expr e;
  const bool integer = std::nearbyint(value) == value && std::fabs(value) < 1e15;
  e.node = Number{value, std::move(text), integer};
  e.type = Type::real;
  return std::make_shared<const Expr>(std::move(e));
}

ExprPtr string_literal(std::string text) {
  Expr e;
  e.node = String{std::move(text)};
  e.type = Type::string;
  return std::make_shared<const Expr>(std::move(e));
}

ExprPtr variable(VarRef ref, Type type) {
  Expr e;
  e.node = std::move(ref);
  e.type = type;
  return std::make_shared<const Expr>(std::move(e));
}

ExprPtr numbered(SpaceId space, std::int64_t n, Type type) {
  return variable(VarRef{space, {}, number(static_cast<double>(n)), {}}, type);
}

ExprPtr unary(UnaryOp op, ExprPtr operand) {
  Expr e;
  e.type = op == UnaryOp::logical_not ? Type::boolean : op == UnaryOp::bit_not ? Type::integer : operand->type;
  e.node = Unary{op, std::move(operand)};
  return std::make_shared<const Expr>(std::move(e));
}

namespace {

Type binary_type(BinaryOp op) {
  switch (op) {
    case BinaryOp::eq:
    case BinaryOp::ne:
    case BinaryOp::lt:
    case BinaryOp::le:
    case BinaryOp::gt:
    case BinaryOp::ge:
    case BinaryOp::logical_and:
    case BinaryOp::logical_or:
    case BinaryOp::logical_xor: return Type::boolean;
    case BinaryOp::bit_and:
    case BinaryOp::bit_or:
    case BinaryOp::bit_xor:
    case BinaryOp::int_divide: return Type::integer;
    case BinaryOp::concat: return Type::string;
    default: return Type::real;
  }
}

Type function_type(Function f) {
  switch (f) {
    case Function::to_integer:
    case Function::string_length:
    case Function::index_of:
    case Function::last_index_of:
    case Function::index_of_any:
    case Function::character_code: return Type::integer;
    case Function::frame_shift:
    case Function::frame_fine:
    case Function::frame_turn:
    case Function::frame_solid_turn:
    case Function::frame_stretch:
    case Function::frame_mirror:
    case Function::frame_inverse:
    case Function::frame_chain:
    case Function::frame_with: return Type::frame;
    case Function::to_boolean:
    case Function::is_number: return Type::boolean;
    case Function::to_string:
    case Function::upper_case:
    case Function::lower_case:
    case Function::character:
    case Function::axis_text:
    case Function::substring: return Type::string;
    default: return Type::real;
  }
}

bool equal_lists(const std::vector<ExprPtr>& a, const std::vector<ExprPtr>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!equal(a[i], b[i])) return false;
  }
  return true;
}

struct EqualNodes {
  const Expr& other;
  bool operator()(const Number& a) const { return a.value == std::get<Number>(other.node).value; }
  bool operator()(const String& a) const { return a.text == std::get<String>(other.node).text; }
  bool operator()(const AxisName& a) const { return a.axis == std::get<AxisName>(other.node).axis; }
  bool operator()(const VarRef& a) const {
    const auto& b = std::get<VarRef>(other.node);
    return a.space == b.space && a.name == b.name && equal(a.index, b.index) && equal_lists(a.indices, b.indices);
  }
  bool operator()(const SystemRef& a) const {
    const auto& b = std::get<SystemRef>(other.node);
    return a.datum == b.datum && a.axis == b.axis && a.text == b.text && a.given == b.given &&
           equal_lists(a.args, b.args);
  }
  bool operator()(const Unary& a) const {
    const auto& b = std::get<Unary>(other.node);
    return a.op == b.op && equal(a.operand, b.operand);
  }
  bool operator()(const Binary& a) const {
    const auto& b = std::get<Binary>(other.node);
    return a.op == b.op && a.compare == b.compare && equal(a.left, b.left) && equal(a.right, b.right);
  }
  bool operator()(const Call& a) const {
    const auto& b = std::get<Call>(other.node);
    return a.function == b.function && a.half == b.half && equal_lists(a.args, b.args);
  }
};

constexpr double degrees = 57.29577951308232087680;

std::optional<double> constant_binary(BinaryOp op, double a, double b) {
  switch (op) {
    case BinaryOp::add: return a + b;
    case BinaryOp::subtract: return a - b;
    case BinaryOp::multiply: return a * b;
    case BinaryOp::divide: return b == 0 ? std::nullopt : std::optional(a / b);
    case BinaryOp::modulo: return b == 0 ? std::nullopt : std::optional(a - std::trunc(a / b) * b);
    case BinaryOp::int_divide: return b == 0 ? std::nullopt : std::optional(std::trunc(a / b));
    case BinaryOp::power: return a == 0 && b <= 0 ? std::nullopt : std::optional(std::pow(a, b));
    default: break;
  }
  // Numbers that are nearly equal compare differently on different controls.
  if (a != b && std::fabs(a - b) <= 1e-6 * std::max(std::fabs(a), std::fabs(b))) return std::nullopt;
  switch (op) {
    case BinaryOp::eq: return a == b ? 1 : 0;
    case BinaryOp::ne: return a != b ? 1 : 0;
    case BinaryOp::lt: return a < b ? 1 : 0;
    case BinaryOp::le: return a <= b ? 1 : 0;
    case BinaryOp::gt: return a > b ? 1 : 0;
    case BinaryOp::ge: return a >= b ? 1 : 0;
    default: return std::nullopt;
  }
}

/// The digits of `x` in one base as those of another; nullopt: it has none, or digits above 9 (the control's matter).
std::optional<double> other_base(double x, std::int64_t from, std::int64_t into) {
  if (!(x >= 0 && x <= 4294967295.0) || x != std::floor(x)) return std::nullopt;
  auto rest = static_cast<std::int64_t>(x);
  std::int64_t value = 0, unit = 1;
  for (; rest > 0; rest /= from, unit *= into) {
    if (rest % from > 9) return std::nullopt;
    value += rest % from * unit;
  }
  return static_cast<double>(value);
}

std::optional<double> constant_call(const Call& c) {
  if (c.args.empty()) return std::nullopt;
  const auto a = constant_value(c.args[0]);
  if (!a) return std::nullopt;
  if ((c.function == Function::min || c.function == Function::max) && c.args.size() == 2) {
    const auto b = constant_value(c.args[1]);
    if (!b) return std::nullopt;
    return c.function == Function::min ? std::min(*a, *b) : std::max(*a, *b);
  }
  switch (c.function) {
    case Function::sin: return std::sin(*a / degrees);
    case Function::cos: return std::cos(*a / degrees);
    case Function::abs: return std::fabs(*a);
    case Function::square: return *a * *a;
    case Function::sqrt: return *a < 0 ? std::nullopt : std::optional(std::sqrt(*a));
    case Function::trunc: return std::trunc(*a);
    case Function::ceil: return std::ceil(*a);
    case Function::floor: return std::floor(*a);
    case Function::exp: return std::exp(*a);
    case Function::ln: return *a > 0 ? std::optional(std::log(*a)) : std::nullopt;
    case Function::log10: return *a > 0 ? std::optional(std::log10(*a)) : std::nullopt;
    case Function::to_bcd: return *a <= 99'999'999 ? other_base(*a, 10, 16) : std::nullopt;
    // With a digit above 9 it is no such code: a binary number already.
    case Function::from_bcd: {
      const auto code = other_base(*a, 16, 10);
      return code || !(*a >= 0 && *a <= 4294967295.0 && *a == std::floor(*a)) ? code : a;
    }
    default: return std::nullopt;
  }
}

constexpr std::array<std::string_view, 3> unary_names{"neg", "not", "bitnot"};
constexpr std::array<std::string_view, 20> binary_names{"+",  "-",   "*",      "/",     "mod",    "div", "pow",
                                                        "==", "!=",  "<",      "<=",    ">",      ">=",  "and",
                                                        "or", "xor", "bitand", "bitor", "bitxor", "<<"};
constexpr std::array<std::string_view, 49> function_names{"sin",
                                                          "cos",
                                                          "tan",
                                                          "asin",
                                                          "acos",
                                                          "atan",
                                                          "atan2",
                                                          "arg",
                                                          "sqrt",
                                                          "square",
                                                          "exp",
                                                          "ln",
                                                          "log10",
                                                          "abs",
                                                          "sign",
                                                          "trunc",
                                                          "ceil",
                                                          "floor",
                                                          "round",
                                                          "min",
                                                          "max",
                                                          "bound",
                                                          "to_bcd",
                                                          "from_bcd",
                                                          "to_integer",
                                                          "to_boolean",
                                                          "to_string",
                                                          "string_length",
                                                          "upper_case",
                                                          "lower_case",
                                                          "substring",
                                                          "index_of",
                                                          "to_number",
                                                          "is_number",
                                                          "last_index_of",
                                                          "index_of_any",
                                                          "character",
                                                          "character_code",
                                                          "axis_text",
                                                          "frame_shift",
                                                          "frame_fine",
                                                          "frame_turn",
                                                          "frame_solid_turn",
                                                          "frame_stretch",
                                                          "frame_mirror",
                                                          "frame_inverse",
                                                          "frame_chain",
                                                          "frame_part",
                                                          "frame_with"};
constexpr std::array<std::string_view, 6> type_names{"real", "integer", "boolean", "string", "axis", "frame"};
constexpr std::array<std::string_view, 49> datum_names{"other",
                                                       "programmed_position",
                                                       "machine_position",
                                                       "work_position",
                                                       "work_offset",
                                                       "active_offset",
                                                       "programmed_shift",
                                                       "tool_number",
                                                       "next_tool",
                                                       "offset_number",
                                                       "tool_length",
                                                       "tool_radius",
                                                       "tool_wear",
                                                       "feed",
                                                       "spindle_speed",
                                                       "feed_override",
                                                       "part_count",
                                                       "cycle_time",
                                                       "active_modal",
                                                       "call_has_argument",
                                                       "position_start",
                                                       "active_shift",
                                                       "pole_first",
                                                       "pole_second",
                                                       "tool_nose",
                                                       "tool_nose_width",
                                                       "feed_per_minute",
                                                       "feed_per_rev",
                                                       "feed_inverse_time",
                                                       "rpm",
                                                       "cutting_speed",
                                                       "spindle_limit",
                                                       "spindle_state",
                                                       "active_plane",
                                                       "mirrored_axes",
                                                       "scale_factor",
                                                       "axis_scale",
                                                       "rotation_angle",
                                                       "diameter_on",
                                                       "frame_programmed",
                                                       "frame_settable",
                                                       "frame_active",
                                                       "frame_total",
                                                       "work_offset_fine",
                                                       "settable_position",
                                                       "measured_machine",
                                                       "measured_work",
                                                       "probe_state",
                                                       "axis_feed"};

}  // namespace

ExprPtr binary(BinaryOp op, ExprPtr left, ExprPtr right, Compare compare) {
  Expr e;
  e.type = binary_type(op);
  e.node = Binary{op, std::move(left), std::move(right), compare};
  return std::make_shared<const Expr>(std::move(e));
}

ExprPtr call(Function f, std::vector<ExprPtr> args, RoundHalf half) {
  Expr e;
  e.type = function_type(f);
  e.node = Call{f, std::move(args), half};
  return std::make_shared<const Expr>(std::move(e));
}

ExprPtr at(const ExprPtr& e, WordPos pos) {
  Expr copy = *e;
  copy.pos = pos;
  return std::make_shared<const Expr>(std::move(copy));
}

bool equal(const ExprPtr& a, const ExprPtr& b) {
  if (a == b) return true;
  if (!a || !b || a->node.index() != b->node.index()) return false;
  return std::visit(EqualNodes{*b}, a->node);
}

std::optional<double> constant_value(const ExprPtr& e) {
  if (!e) return std::nullopt;
  if (const auto* n = std::get_if<Number>(&e->node)) return n->value;
  if (const auto* u = std::get_if<Unary>(&e->node)) {
    const auto v = constant_value(u->operand);
    return v && u->op == UnaryOp::negate ? std::optional(-*v) : std::nullopt;
  }
  if (const auto* b = std::get_if<Binary>(&e->node)) {
    const auto l = constant_value(b->left);
    const auto r = constant_value(b->right);
    return l && r ? constant_binary(b->op, *l, *r) : std::nullopt;
  }
  if (const auto* c = std::get_if<Call>(&e->node)) return constant_call(*c);
  return std::nullopt;
}

bool is_comparison(BinaryOp op) {
  return op >= BinaryOp::eq && op <= BinaryOp::ge;
}

BinaryOp negated(BinaryOp comparison) {
  switch (comparison) {
    case BinaryOp::eq: return BinaryOp::ne;
    case BinaryOp::ne: return BinaryOp::eq;
    case BinaryOp::lt: return BinaryOp::ge;
    case BinaryOp::le: return BinaryOp::gt;
    case BinaryOp::gt: return BinaryOp::le;
    case BinaryOp::ge: return BinaryOp::lt;
    default: return comparison;
  }
}

std::string_view name(UnaryOp op) {
  return unary_names[static_cast<std::size_t>(op)];
}
std::string_view name(BinaryOp op) {
  return binary_names[static_cast<std::size_t>(op)];
}
std::string_view name(Function f) {
  return function_names[static_cast<std::size_t>(f)];
}
std::string_view name(Type t) {
  return type_names[static_cast<std::size_t>(t)];
}
std::string_view name(Datum d) {
  return datum_names[static_cast<std::size_t>(d)];
}

}  // namespace cnctrans::ir
