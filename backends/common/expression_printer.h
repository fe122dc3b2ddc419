// Expressions as text: a precedence table and minimal parentheses. A dialect derives from it for its variables and for
// what its language says in another way.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "backends/common/numbers.h"
#include "ir/expr.h"
#include "ir/program.h"

namespace cnctrans::backends {

/// `level`: higher binds tighter, 1..99. Operators of one level are read from left to right.
struct BinaryText {
  ir::BinaryOp op;
  std::string_view text;
  std::uint8_t level;
  bool blanks;  ///< blanks around it
};
struct UnaryText {
  ir::UnaryOp op;
  std::string_view text;
  std::uint8_t level;  ///< of the operand it takes: an operand of a lower level gets parentheses
};
struct FunctionText {
  ir::Function function;
  std::string_view name;
};

struct ExpressionStyle {
  std::span<const BinaryText> binary;
  std::span<const UnaryText> unary;
  std::span<const FunctionText> functions;
  std::string_view open = "(", close = ")", separator = ",";
  std::string_view string_quote = "\"";
  /// A sign stands only at the start of an expression or of parentheses: R1*(-R2).
  bool sign_needs_parentheses = true;
  /// ... and right of a comparison: R1==-1.
  bool sign_after_comparison = false;
  /// Comparisons that are operands stand in parentheses whatever their level.
  bool comparison_needs_parentheses = true;
};

inline constexpr int primary_level = 100;

struct Printed {
  std::string text;
  int level = primary_level;
  bool signed_front = false;  ///< begins with a sign
};

class ExpressionPrinter {
 public:
  ExpressionPrinter(const ir::Program& program, const ExpressionStyle& style, const NumberFormat& numbers)
      : program_(program), style_(style), numbers_(numbers) {}
  virtual ~ExpressionPrinter() = default;
  ExpressionPrinter(const ExpressionPrinter&) = delete;
  ExpressionPrinter& operator=(const ExpressionPrinter&) = delete;

  /// The text; what could not be said is in `problem` afterwards.
  [[nodiscard]] std::string print(const ir::ExprPtr& e);
  /// As an operand of an operator of `level`: in parentheses when it binds weaker.
  [[nodiscard]] std::string operand(const ir::ExprPtr& e, int level, bool front);
  /// First thing that could not be said since the last call; empty: all was said. `pos` (may be null): its place.
  [[nodiscard]] std::string take_problem(WordPos* pos = nullptr);

 protected:
  [[nodiscard]] Printed print_node(const ir::ExprPtr& e);
  void problem(const ir::ExprPtr& e, std::string text);
  [[nodiscard]] std::string arguments(const std::vector<ir::ExprPtr>& args);
  [[nodiscard]] Printed binary(const ir::ExprPtr& e, const ir::Binary& b);

  // --- what a dialect says itself ---
  virtual std::string variable(const ir::ExprPtr& e, const ir::VarRef& v) = 0;
  virtual std::string system(const ir::ExprPtr& e, const ir::SystemRef& s);
  virtual std::string axis(const ir::AxisName& a);
  virtual Printed number(const ir::Number& n);
  virtual std::string string(const ir::ExprPtr& e, const ir::String& s);
  /// Called before the tables: operators and functions that are written in another way. nullopt: by the tables.
  virtual std::optional<Printed> special(const ir::ExprPtr& e);

  const ir::Program& program_;
  const ExpressionStyle& style_;
  NumberFormat numbers_;

 private:
  [[nodiscard]] Printed unary(const ir::ExprPtr& e, const ir::Unary& u);
  [[nodiscard]] Printed function(const ir::ExprPtr& e, const ir::Call& c);
  std::string problem_;
  WordPos problem_pos_;
};

}  // namespace cnctrans::backends
