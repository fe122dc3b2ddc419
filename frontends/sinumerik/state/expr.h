// Expressions: syntax::Expr -> ir::Expr. Every habit of the control becomes explicit here: comparison tolerance,
// rounding when a real is put into an INT, strings made of numbers by `<<`.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

#include "dialects/sinumerik/addresses.h"
#include "frontends/common/syntax.h"
#include "frontends/sinumerik/state/context.h"

namespace cnctrans::sinumerik {

/// An expression of this type that stands at `pos`.
template <class Node>
ir::ExprPtr make_expr(Node node, ir::Type type, WordPos pos) {
  ir::Expr e;
  e.node = std::move(node);
  e.type = type;
  e.pos = pos;
  return std::make_shared<const ir::Expr>(std::move(e));
}

/// A whole number as if it stood in the text.
inline ir::ExprPtr written_number(int n, WordPos pos) {
  return make_expr(ir::Number{static_cast<double>(n), std::to_string(n), true}, ir::Type::integer, pos);
}
/// The comparison of a value with a whole number, as if it stood in the text.
inline ir::ExprPtr is_number(ir::ExprPtr value, int n, WordPos pos) {
  const auto compare = value->type == ir::Type::real ? ir::Compare::relative_1e12 : ir::Compare::exact;
  return make_expr(ir::Binary{ir::BinaryOp::eq, std::move(value), written_number(n, pos), compare}, ir::Type::boolean,
                   pos);
}

class ExprLowering {
 public:
  explicit ExprLowering(FileContext& context) : c_(context) {}

  /// Null after an error (reported).
  ir::ExprPtr lower(const syntax::Expr& e);
  /// As `type`: INT rounds, BOOL is "not zero", STRING takes only strings. Null after an error.
  ir::ExprPtr lower_as(const syntax::Expr& e, ir::Type type);
  /// For a CHAR: a text of one character, or its code.
  ir::ExprPtr lower_character(const syntax::Expr& e);
  ir::ExprPtr convert(ir::ExprPtr e, ir::Type type, WordPos pos);
  /// A condition (any type; not zero is true).
  ir::ExprPtr condition(const syntax::Expr& e) { return lower(e); }

  /// Value of a word; a position attribute round it goes to `attribute`.
  ir::Value value(const syntax::Block& block, const syntax::Word& word, Attribute& attribute);
  ir::Value value_of(const syntax::Expr& e, Attribute& attribute);
  /// The axis that a position by its number belongs to.
  void of_axis(ir::Value& value, ir::AxisId axis, Attribute& attribute) const;

  /// The variable that `e` names (R parameter, declared name, array element); nullopt after an error.
  std::optional<ir::VarRef> variable(const syntax::Expr& e, ir::Type& type);
  ir::VarRef r_parameter(const syntax::Expr& index, bool& ok);
  /// A system variable; true for those the control evaluates to a constant in a plain run.
  ir::SystemRef system(const syntax::Expr& e);
  /// True for a name (or array) that nothing in this file defines.
  [[nodiscard]] bool is_undefined(const syntax::Expr& e) const;
  /// Such a name as a datum known by its name only; warned about once a file.
  ir::SystemRef undefined(const syntax::Expr& e);
  /// A frame: CTRANS() and its like, chains, frame variables. Null after an error.
  ir::ExprPtr frame(const syntax::Expr& e);
  /// The whole frame that `e` names ($P_PFRAME, $P_UIFR[n], a variable of type FRAME), its component taken off;
  /// nullopt when it names none. `component` and `axis` are null for the whole frame.
  struct FrameName {
    ir::ExprPtr whole, axis, component;
  };
  std::optional<FrameName> frame_name(const syntax::Expr& e);
  std::optional<FrameName> component(const syntax::Expr& e, std::size_t indices, FrameName out);
  /// The axis that an index names, or a variable of type AXIS; null after an error.
  ir::ExprPtr axis_operand(const syntax::Expr& e);
  /// The axis of the channel that a machine's own axis name stands for (X1: X; AX2: the second axis), else `e`.
  [[nodiscard]] syntax::Expr channel_axis(const syntax::Expr& e) const;
  /// An array that is named as a whole, to be handed over; nullopt when `e` names none.
  std::optional<ir::VarRef> whole_array(const syntax::Expr& e, ir::Type& type);

  /// The element of an array that `array` names.
  ir::ExprPtr element(const syntax::Expr& array, std::initializer_list<int> indices);

 private:
  std::optional<ir::Value> numbered_position(const syntax::Expr& e, Attribute& out);
  ir::ExprPtr frame_function(const syntax::Expr& e);
  void tell_position(const syntax::Expr& e);
  bool settled(const ir::VarRef& ref, const syntax::Expr& index);
  ir::ExprPtr turn_in_plane(const syntax::Expr& e);
  ir::ExprPtr spindle_of_axis(const syntax::Expr& e);
  ir::ExprPtr axis_function(const syntax::Expr& e, bool& known);
  ir::ExprPtr asked(const syntax::Expr& e);
  ir::ExprPtr table_function(const syntax::Expr& e);
  bool give_back(const syntax::Expr& e, std::size_t index, ir::ExprPtr value);
  ir::ExprPtr measured_frame(const syntax::Expr& e);
  ir::ExprPtr active_g_function(const syntax::Expr& e);
  ir::ExprPtr character_of(const syntax::Expr& e);
  ir::ExprPtr named(const syntax::Expr& e);
  bool may_be_read(const syntax::Expr& e);
  bool told_by_contour(const syntax::Expr& e);
  ir::ExprPtr unary(const syntax::Expr& e);
  ir::ExprPtr binary(const syntax::Expr& e);
  ir::ExprPtr call(const syntax::Expr& e);
  ir::ExprPtr whole_bits(ir::ExprPtr e, WordPos pos);
  ir::ExprPtr concat(const syntax::Expr& e);
  ir::ExprPtr as_string(ir::ExprPtr e);
  ir::ExprPtr system_operand(const syntax::Expr& e);
  void warn_priority(const syntax::Expr& e);

  FileContext& c_;
};

}  // namespace cnctrans::sinumerik
