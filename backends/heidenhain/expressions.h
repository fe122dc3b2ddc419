// Formulas and the operands of FN functions (reference 12, 13).
#pragma once

#include "backends/common/expression_printer.h"

namespace cnctrans::backends::heidenhain {

class Expressions final : public ExpressionPrinter {
 public:
  explicit Expressions(const ir::Program& program);
  /// A number or a parameter with its sign: `+5`, `-Q3`. Anything else is a problem.
  std::string operand_of_fn(const ir::ExprPtr& e);
  /// A number or a parameter, perhaps with a sign: what FN 0 and a word take.
  static bool is_plain(const ir::ExprPtr& e);

 protected:
  std::string variable(const ir::ExprPtr& e, const ir::VarRef& v) override;
  std::string system(const ir::ExprPtr& e, const ir::SystemRef& s) override;
  std::optional<Printed> special(const ir::ExprPtr& e) override;
};

}  // namespace cnctrans::backends::heidenhain
