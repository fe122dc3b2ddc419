// Tools of the passes: walk and rebuild bodies, values and expressions. No pass lives here.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "ir/program.h"

namespace cnctrans::ir::passes {

// --- expressions ----------------------------------------------------------------------------------------------

using ExprMap = std::function<ExprPtr(const ExprPtr&)>;
/// Rebuilds the tree from the leaves up: `change` sees each node after its children; unchanged parts are shared.
ExprPtr map_expr(const ExprPtr& e, const ExprMap& change);
/// A constant index of a numbered variable.
std::optional<std::int64_t> constant_index(const VarRef& ref);
bool same_variable(const VarRef& a, const VarRef& b);
/// True when `e` reads the variable (a computed index of the same space counts as reading it).
bool reads(const ExprPtr& e, const VarRef& ref);
/// A number, a variable, a machine datum or a text.
bool is_primary(const ExprPtr& e);
const Number* as_number(const ExprPtr& e);
const VarRef* as_variable(const ExprPtr& e);

// --- values of a block ----------------------------------------------------------------------------------------

enum class Role : std::uint8_t {
  coordinate,
  center,
  radius,
  pitch,
  lead,
  polar_radius,  // lengths
  angle,
  turns,
  feed,
  spindle,
  tool,
  offset,
  work_offset,
  machine,
  frame_length,
  frame_factor,
  frame_angle,
  dwell,
  count,
  cycle_level,   ///< a height
  cycle_length,  ///< a distance
  cycle_feed,
  cycle_other,
  corner
};
struct Place {
  Role role = Role::coordinate;
  AxisId axis = axis::none;
  WordPos pos;
};
/// Calls `visit(value, place)` for every value of the block in the order of its words; the visitor says whether it
/// changed the value (shared parts are copied then).
using ValueVisitor = std::function<bool(Value&, const Place&)>;
void visit_values(Block& block, const ValueVisitor& visit);
void visit_values(Cycle& cycle, const ValueVisitor& visit, bool& changed);
/// True when some value of the block is an expression. Cheap.
bool has_expression(const Block& block);

// --- statements -----------------------------------------------------------------------------------------------

/// Calls `change` on every expression that the statement itself holds (not its nested bodies) and puts its answer in
/// the place. Targets of assignments are seen through `targets`.
struct StatementVisitor {
  std::function<ExprPtr(const ExprPtr&)> expression;
  std::function<void(VarRef&)> target;  ///< written variables; may be empty
};
void visit_statement(Statement& s, const StatementVisitor& visit);
/// Read-only walk over every expression node (targets' indices too) and every written variable of one statement.
void each_expression(const Statement& s, const std::function<void(const ExprPtr&)>& visit);
void each_target(const Statement& s, const std::function<void(const VarRef&)>& visit);

/// Bodies nested directly in the statement.
void each_body(Statement& s, const std::function<void(Body&)>& visit);

/// Puts what `rewrite(statement, out)` makes in the place of each statement; nested bodies first.
template <class Rewrite>
void rewrite_body(Body& body, const Rewrite& rewrite) {
  Body out;
  out.reserve(body.size());
  for (auto& s : body) {
    each_body(s, [&rewrite](Body& inner) { rewrite_body(inner, rewrite); });
    rewrite(std::move(s), out);
  }
  body = std::move(out);
}

/// A statement made by a pass at the place and under the skip levels of `like`.
template <class Node>
Statement made(const LineInfo& like, Node node) {
  Statement s;
  s.line.span = like.span;
  s.line.skip_mask = like.skip_mask;
  s.node = std::move(node);
  return s;
}
Statement make_assign(const LineInfo& like, VarRef target, ExprPtr value);
Statement make_jump(const LineInfo& like, const LabelRef& target, ExprPtr condition = nullptr);
Statement make_label(const LineInfo& like, const LabelRef& label, Program& program);
Statement make_comment(std::string text, Program& program);
Statement make_block(const LineInfo& like, Action action);
/// A line with nothing but comments, or an empty one.
bool is_remark(const Statement& s);
/// Behind the declarations and the remarks at the head of a routine: where a pass puts statements that come first.
Body::iterator below_head(Body& body);
/// Puts a label on a line.
void set_label(LineInfo& line, const LabelRef& label, Program& program);
/// A block action made by a pass.
template <class Data>
Action action(Data data, Order order = Order::before) {
  Action a;
  a.data = std::move(data);
  a.order = order;
  return a;
}

LabelRef label_of(std::string text, bool is_number);
/// Labels of a line in the form LabelRef compares: number without leading zeros, identifiers in capitals.
std::vector<LabelRef> labels_on(const LineInfo& line);
bool same_label(const LabelRef& a, const LabelRef& b);
/// "N10" or "LAB10", for texts.
std::string label_text(const LabelRef& label);

/// Takes what the line showed (number, labels, blank lines, own-line comments) to `to`, which now stands first.
void move_head(LineInfo& from, LineInfo& to);

// --- reporting ------------------------------------------------------------------------------------------------

std::string quoted(std::string_view name);

/// Name of a variable in messages: P100, LEN, R5.
std::string variable_text(const VarRef& ref, const Program& program);

}  // namespace cnctrans::ir::passes
