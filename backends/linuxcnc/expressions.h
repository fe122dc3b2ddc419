// Expressions as LinuxCNC writes them: [#100 + 2*SIN[#101]].
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "backends/common/expression_printer.h"

namespace cnctrans::backends::linuxcnc {

class Expressions final : public ExpressionPrinter {
 public:
  explicit Expressions(const ir::Program& program);

  /// As the value of a word, a parameter or a condition: a number, #100, -#100, or in brackets.
  std::string value(const ir::ExprPtr& e);
  /// In brackets always.
  std::string condition(const ir::ExprPtr& e);
  /// "#100", "#[#101 + 2]".
  std::string name(const ir::VarRef& v);
  /// An EQ or NE was written since the last call; both take values as equal that differ by less than 0.0001.
  [[nodiscard]] bool take_tolerant() { return std::exchange(tolerant_, false); }

 protected:
  std::string variable(const ir::ExprPtr& e, const ir::VarRef& v) override;
  std::string string(const ir::ExprPtr& e, const ir::String& s) override;
  std::optional<Printed> special(const ir::ExprPtr& e) override;

 private:
  std::optional<Printed> special_call(const ir::ExprPtr& e, const ir::Call& c);
  std::string bracket(const ir::ExprPtr& e);
  [[nodiscard]] std::string sign(const std::string& x) const;
  Printed truncated(const ir::ExprPtr& e);
  bool tolerant_ = false;
};

}  // namespace cnctrans::backends::linuxcnc
