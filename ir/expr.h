// Expressions: typed trees with IR semantics. Precedence is gone, angles are degrees; what controls do differently
// (comparison tolerance, rounding of halves) is an attribute of the node.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/span.h"
#include "ir/axis.h"

namespace cnctrans::ir {

enum class Type : std::uint8_t { real, integer, boolean, string, axis, frame };

enum class UnaryOp : std::uint8_t { negate, logical_not, bit_not };
enum class BinaryOp : std::uint8_t {
  add,
  subtract,
  multiply,
  divide,
  modulo,      ///< a - trunc(a/b)*b: the sign of a
  int_divide,  ///< trunc(a/b)
  power,
  eq,
  ne,
  lt,
  le,
  gt,
  ge,  ///< yield boolean (1 or 0 as a number)
  logical_and,
  logical_or,
  logical_xor,  ///< no short circuit
  bit_and,
  bit_or,
  bit_xor,  ///< 32-bit integers
  concat    ///< strings
};
enum class Function : std::uint8_t {
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  atan2,  ///< atan2(y, x) in (-180, 180]
  arg,    ///< arg(x, y) in [0, 360)
  sqrt,
  square,
  exp,
  ln,
  log10,
  abs,
  sign,
  trunc,  ///< toward zero
  ceil,   ///< the next integer toward +infinity
  floor,
  round,
  min,
  max,
  bound,  ///< bound(low, high, value)
  to_bcd,
  from_bcd,
  to_integer,
  to_boolean,
  to_string,
  string_length,
  upper_case,
  lower_case,
  substring,
  index_of,
  to_number,
  is_number,
  last_index_of,   ///< last_index_of(text, text): from the end; -1: nowhere
  index_of_any,    ///< index_of_any(text, set): first character that is in the set
  character,       ///< character(code): a text of one
  character_code,  ///< of the first character; 0 of an empty text
  axis_text,       ///< the name of an axis
  // Frames: pairs of an axis and a number
  frame_shift,
  frame_fine,
  frame_turn,        ///< degrees about the geometry axes: Z, then the new Y, then the new X
  frame_solid_turn,  ///< one or two solid angles
  frame_stretch,
  frame_mirror,   ///< axes only
  frame_inverse,  ///< frame_inverse(frame)
  frame_chain,    ///< frame_chain(outer, inner)
  frame_part,     ///< frame_part(frame, axis, FramePart): one component
  frame_with      ///< frame_with(frame, axis, FramePart, value): the frame with another component
};
/// Components of a frame; in frame_part and frame_with a literal number.
enum class FramePart : std::uint8_t { shift, fine, turn, scale, mirror };
/// How two reals compare: exactly, or equal when they differ by less than 1e-12 of their size.
enum class Compare : std::uint8_t { exact, relative_1e12 };
enum class RoundHalf : std::uint8_t { away, up, even };

struct Expr;
using ExprPtr = std::shared_ptr<const Expr>;

/// Index into Program::spaces.
using SpaceId = std::uint16_t;

/// A variable. Numbered spaces: `index` is the number (usually a literal). Named spaces: `name` and, for arrays,
/// `indices`.
struct VarRef {
  SpaceId space = 0;
  std::string name;
  ExprPtr index;
  std::vector<ExprPtr> indices;
};

/// Machine data that several controls can read; `other` is known by its name only.
/// active_modal: args are the source's code, the Setting (setting_count: the motion function, setting_count + 1: the
/// work offset) and the value that makes it 1.
enum class Datum : std::uint8_t {
  other,
  programmed_position,
  machine_position,
  work_position,
  work_offset,
  active_offset,
  programmed_shift,
  tool_number,
  next_tool,
  offset_number,
  tool_length,
  tool_radius,
  tool_wear,
  feed,
  spindle_speed,
  feed_override,
  part_count,
  cycle_time,
  active_modal,
  call_has_argument,
  position_start,
  active_shift,  ///< all of the offsets of `axis` that are not incremental ones: table row and preset
  pole_first,    ///< abscissa and ordinate of the polar origin
  pole_second,
  tool_nose,  ///< orientation code of the tool's nose
  tool_nose_width,
  feed_per_minute,  ///< the programmed feed of each feed mode
  feed_per_rev,
  feed_inverse_time,
  rpm,  ///< the programmed speed of each spindle mode
  cutting_speed,
  spindle_limit,
  spindle_state,  ///< args: the source's code, SpindleState; 1 when the spindle is in it
  active_plane,   ///< 16 * abscissa + ordinate; axes numbered from 1 in the machine's order
  mirrored_axes,  ///< bit n: axis n of the machine (from 0) is mirrored
  scale_factor,
  axis_scale,
  rotation_angle,
  diameter_on,        ///< 1: words of a diameter axis are diameters
  frame_programmed,   ///< whole frames: the programmable one
  frame_settable,     ///< row args[0] of the table of settable frames
  frame_active,       ///< the settable frame in force
  frame_total,        ///< all of them
  work_offset_fine,   ///< fine part of the work offset of row args[0]
  settable_position,  ///< position before the programmable frame
  measured_machine,   ///< of the last probing move
  measured_work,
  probe_state,  ///< 1: probe args[0] was triggered
  axis_feed     ///< feed of `axis` when it is positioned by itself (mm/min, deg/min); 0: as fast as it goes
};
/// A system variable. `text` is the name in the source's spelling. `args` its indices; `axis` when it speaks of one.
struct SystemRef {
  Datum datum = Datum::other;
  AxisId axis = axis::none;
  std::string text;
  std::vector<ExprPtr> args;
  bool given = false;  ///< `text` is what stands for it on the target: the map of names says so
};

struct Number {
  double value = 0;
  std::string text;  ///< as written; empty: made by a pass
  bool integer = false;
};
struct String {
  std::string text;
};
struct AxisName {
  AxisId axis = axis::none;
};
struct Unary {
  UnaryOp op = UnaryOp::negate;
  ExprPtr operand;
};
struct Binary {
  BinaryOp op = BinaryOp::add;
  ExprPtr left, right;
  Compare compare = Compare::exact;
};
struct Call {
  Function function = Function::sin;
  std::vector<ExprPtr> args;
  RoundHalf half = RoundHalf::away;
};

struct Expr {
  std::variant<Number, String, AxisName, VarRef, SystemRef, Unary, Binary, Call> node;
  Type type = Type::real;
  WordPos pos;
};

// Builders.
ExprPtr number(double value, std::string text = {});
ExprPtr string_literal(std::string text);
ExprPtr variable(VarRef ref, Type type = Type::real);
/// Variable number `n` of the numbered space.
ExprPtr numbered(SpaceId space, std::int64_t n, Type type = Type::real);
ExprPtr unary(UnaryOp op, ExprPtr operand);
ExprPtr binary(BinaryOp op, ExprPtr left, ExprPtr right, Compare compare = Compare::exact);
ExprPtr call(Function f, std::vector<ExprPtr> args, RoundHalf half = RoundHalf::away);
ExprPtr at(const ExprPtr& e, WordPos pos);  ///< the same expression with another place

bool equal(const ExprPtr& a, const ExprPtr& b);  ///< structurally, places and number texts ignored
/// The value when the tree has only literals (division by zero: nullopt).
std::optional<double> constant_value(const ExprPtr& e);
bool is_comparison(BinaryOp op);
BinaryOp negated(BinaryOp comparison);
/// Calls `visit` for `e` and every node below it, parents first.
template <class Visitor>
void walk(const ExprPtr& e, const Visitor& visit);

std::string_view name(UnaryOp op);
std::string_view name(BinaryOp op);
std::string_view name(Function f);
std::string_view name(Type t);
std::string_view name(Datum d);

template <class Visitor>
void walk(const ExprPtr& e, const Visitor& visit) {
  if (!e) return;
  visit(e);
  if (const auto* v = std::get_if<VarRef>(&e->node)) {
    walk(v->index, visit);
    for (const auto& i : v->indices) walk(i, visit);
  } else if (const auto* s = std::get_if<SystemRef>(&e->node)) {
    for (const auto& a : s->args) walk(a, visit);
  } else if (const auto* u = std::get_if<Unary>(&e->node)) {
    walk(u->operand, visit);
  } else if (const auto* b = std::get_if<Binary>(&e->node)) {
    walk(b->left, visit);
    walk(b->right, visit);
  } else if (const auto* c = std::get_if<Call>(&e->node)) {
    for (const auto& a : c->args) walk(a, visit);
  }
}

}  // namespace cnctrans::ir
