// Expressions: syntax::Expr -> ir::Expr. Every habit of the control becomes explicit here: comparison tolerance,
// rounding when a real is put into an INT, strings made of numbers by `<<`.
#pragma once

#include "dialects/sinumerik/addresses.h"
#include "frontends/common/syntax.h"
#include "frontends/sinumerik/context.h"

namespace cnctrans::sinumerik {

class ExprLowering {
 public:
  explicit ExprLowering(FileContext& context) : c_(context) {}

  /// Null after an error (reported).
  ir::ExprPtr lower(const syntax::Expr& e);
  /// As `type`: INT rounds, BOOL is "not zero", STRING takes only strings. Null after an error.
  ir::ExprPtr lower_as(const syntax::Expr& e, ir::Type type);
  ir::ExprPtr convert(ir::ExprPtr e, ir::Type type, WordPos pos);
  /// A condition (any type; not zero is true).
  ir::ExprPtr condition(const syntax::Expr& e) { return lower(e); }

  /// Value of a word; a position attribute round it goes to `attribute`.
  ir::Value value(const syntax::Block& block, const syntax::Word& word, Attribute& attribute);
  ir::Value value_of(const syntax::Expr& e, Attribute& attribute);

  /// The variable that `e` names (R parameter, declared name, array element); nullopt after an error.
  std::optional<ir::VarRef> variable(const syntax::Expr& e, ir::Type& type);
  ir::VarRef r_parameter(const syntax::Expr& index, bool& ok);
  /// A system variable; true for those the control evaluates to a constant in a plain run.
  ir::SystemRef system(const syntax::Expr& e);
  /// True for a name (or array) that nothing in this file defines.
  [[nodiscard]] bool is_undefined(const syntax::Expr& e) const;
  /// Such a name as a datum known by its name only; warned about once a file.
  ir::SystemRef undefined(const syntax::Expr& e);

 private:
  ir::ExprPtr named(const syntax::Expr& e);
  ir::ExprPtr unary(const syntax::Expr& e);
  ir::ExprPtr binary(const syntax::Expr& e);
  ir::ExprPtr call(const syntax::Expr& e);
  ir::ExprPtr concat(const syntax::Expr& e);
  ir::ExprPtr as_string(ir::ExprPtr e);
  ir::ExprPtr system_operand(const syntax::Expr& e);
  void warn_priority(const syntax::Expr& e);

  FileContext& c_;
};

}  // namespace cnctrans::sinumerik
