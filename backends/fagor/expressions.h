// Expressions of the high-level language (manual ch. 11).
#pragma once

#include <set>
#include <string>
#include <utility>

#include "backends/common/expression_printer.h"

namespace cnctrans::backends::fagor {

/// Functions that the printer can say: those of the language and those said by others of them.
std::set<ir::Function> sayable_functions();

/// Name and index of machine data ("PPOSX", "TOX3" without its index); empty: none on this model.
std::string system_name(const ir::SystemRef& s, bool lathe);

/// A comparison, or conditions joined by AND OR XOR NOT: what IF accepts.
bool is_condition(const ir::ExprPtr& e);

class Printer : public ExpressionPrinter {
 public:
  Printer(const ir::Program& program, bool lathe, const NumberFormat& numbers);

  /// `e` as a condition of IF: a bare value becomes a comparison with zero.
  [[nodiscard]] std::string condition(const ir::ExprPtr& e);
  /// Line of the source, when it is of this language: a parameter written as a letter there stays one (A = P0).
  void set_source(std::string line) { source_ = std::move(line); }
  /// A parameter or a sign and a parameter ("P100", "-P3"): all an ISO word can hold. Empty: it is something else.
  [[nodiscard]] std::string parameter(const ir::ExprPtr& e);

 protected:
  std::string variable(const ir::ExprPtr& e, const ir::VarRef& v) override;
  std::string system(const ir::ExprPtr& e, const ir::SystemRef& s) override;
  Printed number(const ir::Number& n) override;
  std::string string(const ir::ExprPtr& e, const ir::String& s) override;
  std::optional<Printed> special(const ir::ExprPtr& e) override;

 private:
  std::optional<Printed> comparison(const ir::Binary& b);
  std::optional<Printed> special_binary(const ir::ExprPtr& e, const ir::Binary& b);
  std::optional<Printed> special_unary(const ir::ExprPtr& e, const ir::Unary& u);
  std::optional<Printed> special_call(const ir::ExprPtr& e, const ir::Call& c);
  [[nodiscard]] std::string index(const ir::ExprPtr& e);

  bool lathe_;
  std::string source_;
};

}  // namespace cnctrans::backends::fagor
