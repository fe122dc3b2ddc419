// Expressions as Sinumerik writes them (reference-language 4).
#pragma once

#include <string>

#include "backends/common/expression_printer.h"

namespace cnctrans::backends::sinumerik {

/// Machine data that have a name on this control (reference-motion 24.1).
bool has_system_name(const ir::SystemRef& s);

class Expressions final : public ExpressionPrinter {
 public:
  Expressions(const ir::Program& program, bool own);

  /// As the value of a variable of `type`: conversions that the assignment does by itself are not written.
  std::string assigned(const ir::ExprPtr& e, ir::Type type);
  std::string condition(const ir::ExprPtr& e);
  /// The variable's name, also left of an equals sign: "R5", "R[R1+2]", "NAME[1,2]".
  std::string name(const ir::VarRef& v);
  std::string name(const ir::SystemRef& s);
  ir::Type type_of(const ir::VarRef& v) const;
  /// `F1[X,TR]=5` for an assignment that only changes one component of its frame; empty for any other.
  std::string component_assignment(const ir::Assign::Item& item);
  std::string character_assignment(const ir::Assign::Item& item);

 protected:
  std::string variable(const ir::ExprPtr& e, const ir::VarRef& v) override;
  std::string system(const ir::ExprPtr& e, const ir::SystemRef& s) override;
  Printed number(const ir::Number& n) override;
  std::string string(const ir::ExprPtr& e, const ir::String& s) override;
  std::optional<Printed> special(const ir::ExprPtr& e) override;

 private:
  std::string bits(const ir::ExprPtr& e, int level, bool left);
  std::optional<Printed> special_binary(const ir::ExprPtr& e, const ir::Binary& b);
  std::optional<Printed> active_code(const ir::ExprPtr& e);
  std::optional<Printed> frame_call(const ir::Call& c);
  std::string component(const ir::ExprPtr& frame, const ir::ExprPtr& axis, const ir::ExprPtr& part);
  std::optional<Printed> special_call(const ir::ExprPtr& e, const ir::Call& c);
  Printed power(const ir::ExprPtr& e, const ir::Binary& b);
  std::string index(const ir::ExprPtr& e);
  std::string asked(const ir::SystemRef& s);
  bool own_;  ///< the program was read from Sinumerik
};

}  // namespace cnctrans::backends::sinumerik
