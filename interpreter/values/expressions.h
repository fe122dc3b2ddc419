// Expressions compiled to a flat pool of nodes with variables resolved to their places, and their evaluation.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/trace/failure.h"
#include "interpreter/values/variables.h"
#include "ir/expr.h"
#include "ir/value.h"

namespace cnctrans::interpreter {

/// Machine data that expressions may read and programs may write. False and a failure when it is not known.
class SystemData {
 public:
  virtual ~SystemData() = default;
  virtual bool read(const ir::SystemRef& ref, std::span<const double> args, double& out) = 0;
  virtual bool write(const ir::SystemRef& ref, std::span<const double> args, double value) = 0;
  virtual bool read_frame(const ir::SystemRef& ref, std::span<const double> args, Frame& out) = 0;
  virtual bool write_frame(const ir::SystemRef& ref, std::span<const double> args, const Frame& f) = 0;
  /// mm (radius) or degrees that a number means as a coordinate of this axis.
  [[nodiscard]] virtual double length_of(ir::AxisId axis, double value) const = 0;
  [[nodiscard]] virtual std::string axis_name(ir::AxisId axis) const = 0;
};

/// How names and spaces of one routine are to be understood.
struct NameScope {
  const ir::Program* program = nullptr;
  const std::vector<NumberedSpace*>* spaces = nullptr;  ///< by SpaceId
  struct LocalName {
    std::uint32_t index = 0;  ///< in Locals
    bool is_text = false;
  };
  std::map<std::string, LocalName, std::less<>> locals;
};

using ExprId = std::uint32_t;
inline constexpr ExprId no_expr = 0xffffffff;

/// Values of words: what the block level needs of the evaluator. Literal values never come here.
class ValueSource {
 public:
  virtual ~ValueSource() = default;
  virtual double number_of(const ir::ExprPtr& e) = 0;
};

class Evaluator final : public ValueSource {
 public:
  Evaluator(Variables& variables, Failure& failure) : variables_(variables), failure_(failure) {}
  void set_system(SystemData* system) { system_ = system; }
  /// Numbers that differ by no more than this are equal for = and <> (machine profile, compare.equal_within).
  void set_equal_within(double difference) { equal_within_ = difference; }
  /// Statements at which two numbers were equal by that difference only, each once, in order.
  [[nodiscard]] const std::vector<Span>& nearly_equal() const { return nearly_equal_; }
  /// The routine now running: names are looked up there, its locals read.
  void enter(const NameScope* scope, Locals* locals) {
    scope_ = scope;
    locals_ = locals;
  }

  ExprId compile(const ir::Expr& e, const NameScope& scope);
  /// 0 and a failure when it has no value.
  double number(ExprId id);
  std::string text(ExprId id);
  [[nodiscard]] bool is_text(ExprId id) const { return nodes_[id].is_text; }
  double number_of(const ir::ExprPtr& e) override;
  /// The compiled form in the routine now running.
  ExprId id_of(const ir::ExprPtr& e);
  /// Number or text as a message shows it.
  std::string shown(ExprId id);
  /// Where an assignment to `ref` goes. Fails when there is no such variable, or it must not be written.
  /// `whole`: an array without indices stands for itself (to hand it over by reference).
  bool place(const ir::VarRef& ref, const NameScope& scope, Place& out, bool whole = false);
  bool assign(const Place& place, ExprId value);
  /// Values of a system datum's indices, valid until the next call.
  std::span<const double> arguments(const ir::SystemRef& ref);
  /// A value of type frame; a neutral one and a failure when it has none.
  Frame frame(const ir::Expr& e);

 private:
  enum class Kind : std::uint8_t {
    number,
    text,
    global_number,
    level_number,
    computed_number,
    local,
    global_name,
    system,
    unary,
    binary,
    function,
    frame_part,
    fault
  };
  struct Node {
    Kind kind = Kind::number;
    bool is_text = false;
    std::uint8_t op = 0;         ///< UnaryOp, BinaryOp, Function
    std::uint8_t attribute = 0;  ///< Compare, RoundHalf
    std::uint32_t a = 0, b = 0;  ///< children; number of the variable; first child and their count
    double value = 0;
    const void* what = nullptr;  ///< space, variable, SystemRef
  };
  ExprId add(const Node& n);
  ExprId fault(std::string text);
  NamedVariable& global_of(const ir::VarRef& v, const NameScope& scope);
  ExprId compile_variable(const ir::VarRef& v, const NameScope& scope);
  ExprId compile_call(const ir::Call& c, const NameScope& scope);
  std::uint32_t compile_list(const std::vector<ir::ExprPtr>& list, const NameScope& scope);
  bool named_place(NamedVariable& v, std::span<const double> indices, Place& out);
  bool local_place(std::size_t local, std::span<const double> indices, Place& out);
  bool global_place(NamedVariable& v, std::span<const double> indices, Place& out);
  bool node_place(const Node& n, Place& out);
  double binary(const Node& n);
  double compare_text(const Node& n);
  bool equal(double a, double b, ir::Compare how);
  double function(const Node& n);
  double text_function(const Node& n);
  Frame frame_call(const ir::Call& c);
  double frame_part(const ir::Call& c);
  bool axis_of(const ir::ExprPtr& e, ir::AxisId& out);
  std::string text_result(const Node& n);
  double checked(double value, std::string_view what);
  std::string text_operand(ExprId id);

  struct CacheEntry {
    const ir::Expr* expr = nullptr;
    const NameScope* scope = nullptr;
    ExprId id = no_expr;
  };
  CacheEntry& cache_slot(const ir::Expr* e);

  Variables& variables_;
  Failure& failure_;
  SystemData* system_ = nullptr;
  const NameScope* scope_ = nullptr;
  Locals* locals_ = nullptr;
  std::vector<Node> nodes_;
  std::vector<ExprId> children_;
  std::vector<std::string> texts_;
  std::vector<CacheEntry> cache_;
  std::size_t cached_ = 0;
  std::vector<double> arguments_;
  double equal_within_ = 0;
  std::vector<Span> nearly_equal_;
};

/// Number as a message shows it: at most 10 decimals, no trailing zeros.
std::string number_text(double value);
/// a == b as the attribute says.
bool equal_numbers(double a, double b, ir::Compare how);
double rounded_half(double x, ir::RoundHalf half);

}  // namespace cnctrans::interpreter
