// Expressions of a language without precedence: one chain, from left to right.
#pragma once

#include "backends/common/expression_printer.h"

namespace cnctrans::backends::num {

/// A factor that the reader put beside machine data: system units in a millimetre or a degree.
bool system_units(const ir::ExprPtr& e);

class ChainPrinter final : public ExpressionPrinter {
 public:
  using ExpressionPrinter::ExpressionPrinter;
  /// "L5", "E80001", "[NAME]"; empty and a problem when there is no such variable.
  std::string variable(const ir::ExprPtr& e, const ir::VarRef& v) override;

 protected:
  std::string system(const ir::ExprPtr& e, const ir::SystemRef& s) override;
  std::string string(const ir::ExprPtr& e, const ir::String& s) override;
  /// A right operand is a primary (number, variable, function of a primary): everything else needs a temporary, which
  /// the passes have made; what is left is a problem.
  std::optional<Printed> special(const ir::ExprPtr& e) override;

 private:
  [[nodiscard]] static bool primary(const ir::ExprPtr& e);
  [[nodiscard]] Printed chain(const ir::ExprPtr& e, const ir::Binary& b);
};

}  // namespace cnctrans::backends::num
