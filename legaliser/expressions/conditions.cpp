// Conditions: what one relation can't say becomes several jumps; comparisons with a tolerance.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "legaliser/expressions/expression_lowering.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// The width that a control with tolerant comparison takes for equal; exact controls get this band, or the last place
/// of their constants.
double band_of(const Capabilities& target) {
  return std::pow(10, -std::min(6, target.constant_decimals));
}

double equal_within(const machine::Profile& machine) {
  return machine.policies.compare_equal_within;
}

bool is_whole(const ExprPtr& e) {
  const auto* n = as_number(e);
  return e->type == Type::integer || (n != nullptr && std::nearbyint(n->value) == n->value);
}

/// A condition whose value is known: a number, or a relation between two of them.
bool is_truth_literal(const ExprPtr& e, bool& value) {
  if (const auto c = constant_value(e)) {
    value = *c != 0;
    return true;
  }
  const auto* b = std::get_if<Binary>(&e->node);
  if (b == nullptr || !is_comparison(b->op)) return false;
  const auto left = constant_value(b->left), right = constant_value(b->right);
  if (!left || !right) return false;
  switch (b->op) {
    case BinaryOp::eq: value = *left == *right; break;
    case BinaryOp::ne: value = *left != *right; break;
    case BinaryOp::lt: value = *left < *right; break;
    case BinaryOp::le: value = *left <= *right; break;
    case BinaryOp::gt: value = *left > *right; break;
    case BinaryOp::ge: value = *left >= *right; break;
    default: return false;
  }
  return true;
}

}  // namespace

// --- whole numbers ----------------------------------------------------------------------------------------------

std::string IntegerVariables::key(const VarRef& v) {
  std::string k = std::to_string(v.space) + ":" + v.name;
  if (v.index) {
    const auto n = constant_index(v);
    k += n ? std::to_string(*n) : "?";
  }
  return k;
}

IntegerVariables::IntegerVariables(const Program& program, double grid) : grid_(grid) {
  std::vector<std::pair<std::string, ExprPtr>> writes;
  const auto unknown = [this](const VarRef& v) {
    assigned_.insert(key(v));
    not_whole_.insert(key(v));
  };
  std::set<const Routine*> called;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* c = std::get_if<CallRoutine>(&s.node);
      const auto* m = std::get_if<ModalCall>(&s.node);
      if (c == nullptr && m != nullptr && !m->off && !m->cycle) c = &m->call;
      const Routine* callee = c != nullptr && !c->computed ? program.find(c->routine) : nullptr;
      if (callee == nullptr) return;
      called.insert(callee);
      for (std::size_t i = 0; i < c->arguments.size(); ++i) {
        const auto& a = c->arguments[i];
        for (std::size_t k = 0; k < callee->parameters.size(); ++k) {
          const auto& p = callee->parameters[k];
          if (a.name.empty() ? k != i : a.name != p.name) continue;
          if (a.by_reference)
            unknown(p.variable);
          else if (a.value)
            writes.emplace_back(key(p.variable), a.value);
        }
      }
    });
  }
  for (const auto& r : program.routines) {
    for (const auto& p : r.parameters) {
      if (called.count(&r) == 0 && p.type != Type::integer && p.type != Type::boolean) unknown(p.variable);
      assigned_.insert(key(p.variable));
      if (p.default_value) writes.emplace_back(key(p.variable), p.default_value);
    }
    for_each_statement(r.body, [&](const Statement& s) {
      if (const auto* a = std::get_if<Assign>(&s.node)) {
        for (const auto& i : a->items) {
          if (!i.to_system) writes.emplace_back(key(i.target), i.value);
        }
      } else if (const auto* f = std::get_if<For>(&s.node)) {
        writes.emplace_back(key(f->counter), f->from);
        if (f->step) writes.emplace_back(key(f->counter), f->step);
      } else {
        each_target(s, unknown);
      }
    });
  }
  for (const auto& [k, e] : writes) assigned_.insert(k);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [k, e] : writes) {
      if (not_whole_.count(k) == 0 && !exact(e)) changed = not_whole_.insert(k).second || changed;
    }
  }
}

bool IntegerVariables::untouched(const ExprPtr& e) const {
  const auto* v = as_variable(e);
  return v != nullptr && assigned_.count(key(*v)) == 0 && assigned_.count(std::to_string(v->space) + ":?") == 0;
}

bool IntegerVariables::exact(const ExprPtr& e) const {
  if (!e) return false;
  if (e->type == Type::integer || e->type == Type::boolean) return true;
  if (const auto* n = as_number(e)) return std::nearbyint(n->value * grid_) == n->value * grid_;
  if (const auto* v = as_variable(e)) {
    const std::string k = key(*v);
    return assigned_.count(k) != 0 && not_whole_.count(k) == 0 &&
           not_whole_.count(std::to_string(v->space) + ":?") == 0;
  }
  if (const auto* u = std::get_if<Unary>(&e->node)) return exact(u->operand);
  if (const auto* b = std::get_if<Binary>(&e->node)) {
    if (is_comparison(b->op)) return true;
    switch (b->op) {
      case BinaryOp::add:
      case BinaryOp::subtract: return exact(b->left) && exact(b->right);
      case BinaryOp::multiply:
        return exact(b->left) && exact(b->right) && (grid_ == 1 || is_whole(b->left) || is_whole(b->right));
      case BinaryOp::modulo:
      case BinaryOp::int_divide:
      case BinaryOp::bit_and:
      case BinaryOp::bit_or:
      case BinaryOp::bit_xor: return exact(b->left) && exact(b->right);
      default: return b->op == BinaryOp::logical_and || b->op == BinaryOp::logical_or || b->op == BinaryOp::logical_xor;
    }
  }
  if (const auto* c = std::get_if<Call>(&e->node)) {
    switch (c->function) {
      case Function::trunc:
      case Function::ceil:
      case Function::floor:
      case Function::round:
      case Function::sign:
      case Function::to_integer: return true;
      case Function::abs:
      case Function::min:
      case Function::max:
      case Function::bound: {
        for (const auto& a : c->args) {
          if (!exact(a)) return false;
        }
        return true;
      }
      default: return false;
    }
  }
  return false;
}

// --- lowering of conditions -------------------------------------------------------------------------------------

ExprPtr ExpressionLowering::condition(const ExprPtr& e) {
  if (editor_.target().conditions == ConditionForm::expression) {
    if (const auto* b = std::get_if<Binary>(&e->node)) {
      if (is_comparison(b->op)) {
        const ExprPtr left = node(b->left), right = node(b->right);
        return left == b->left && right == b->right ? e : binary(b->op, left, right, b->compare);
      }
      if ((b->op == BinaryOp::logical_and || b->op == BinaryOp::logical_or) && has(b->op)) {
        return binary(b->op, condition(b->left), condition(b->right));
      }
    }
    if (!is_condition(e) && e->type != Type::boolean) return binary(BinaryOp::ne, node(e), number(0));
    if (const auto* u = std::get_if<Unary>(&e->node); u != nullptr && u->op == UnaryOp::logical_not) {
      return editor_.target().unary.count(u->op) != 0 ? unary(u->op, condition(u->operand))
                                                      : condition(negated_condition(u->operand));
    }
    return node(e);
  }
  return e;
}

void ExpressionLowering::jump_if(const ExprPtr& e, const LabelRef& target) {
  if (!e) return;
  bool always = false;
  if (is_truth_literal(e, always)) {
    if (always) pre.push_back(make_jump(like_, target));
    return;
  }
  if (editor_.target().conditions == ConditionForm::expression) {
    pre.push_back(make_jump(like_, target, condition(e)));
    return;
  }
  if (const auto* u = std::get_if<Unary>(&e->node); u != nullptr && u->op == UnaryOp::logical_not) {
    const auto* x = std::get_if<Binary>(&u->operand->node);
    if (x != nullptr && x->op == BinaryOp::logical_xor)
      return jump_if(binary(BinaryOp::eq, truth_value(x->left), truth_value(x->right)), target);
    const ExprPtr turned = negated_condition(u->operand);
    if (const auto* again = std::get_if<Unary>(&turned->node); again == nullptr || again->op != UnaryOp::logical_not) {
      return jump_if(turned, target);
    }
    return jump_if(binary(BinaryOp::eq, u->operand, number(0)), target);
  }
  const auto* b = std::get_if<Binary>(&e->node);
  if (b != nullptr && b->op == BinaryOp::logical_or) {
    jump_if(b->left, target);
    return jump_if(b->right, target);
  }
  if (b != nullptr && b->op == BinaryOp::logical_and) {
    const LabelRef behind = editor_.fresh_label();
    jump_if(negated_condition(b->left), behind);
    jump_if(b->right, target);
    return label_here(behind);
  }
  if (b != nullptr && b->op == BinaryOp::logical_xor) {
    return jump_if(binary(BinaryOp::ne, truth_value(b->left), truth_value(b->right)), target);
  }
  if (b != nullptr && is_comparison(b->op)) return jump_if_relation(e, target);
  jump_if(binary(BinaryOp::ne, e, number(0)), target);
}

ExprPtr variable_first(const ExprPtr& relation) {
  const auto* b = std::get_if<Binary>(&relation->node);
  if (b == nullptr || !is_comparison(b->op) || as_number(b->left) == nullptr || as_number(b->right) != nullptr)
    return relation;
  BinaryOp op = b->op;
  switch (b->op) {
    case BinaryOp::lt: op = BinaryOp::gt; break;
    case BinaryOp::le: op = BinaryOp::ge; break;
    case BinaryOp::gt: op = BinaryOp::lt; break;
    case BinaryOp::ge: op = BinaryOp::le; break;
    default: break;
  }
  return binary(op, b->right, b->left, b->compare);
}

void ExpressionLowering::jump_if_relation(const ExprPtr& relation, const LabelRef& target) {
  if (const auto fixed = constant_value(relation)) {
    if (*fixed != 0) pre.push_back(make_jump(like_, target));
    return;
  }
  const ExprPtr turned = variable_first(relation);
  const auto& b = std::get<Binary>(turned->node);
  const ExprPtr left = b.left, right = b.right;
  const BinaryOp op = b.op;
  // The side that needs more goes first, so that its temporaries are free for the other.
  const ExprPtr r = editor_.target().condition_right_chain ? lower(right) : primary(right);
  const ExprPtr l = primary(left);
  pre.push_back(make_jump(like_, target, binary(op, l, r, b.compare)));
}

// --- the pass ---------------------------------------------------------------------------------------------------

namespace {

class ConditionPass {
 public:
  ConditionPass(Program& program, const LegaliseContext& context)
      : context_(context),
        band_(band_of(context.target)),
        near_(equal_within(context.source_machine) > 0 && equal_within(context.target_machine) == 0),
        far_(equal_within(context.source_machine) == 0 && equal_within(context.target_machine) > 0),
        numbers_(program) {}

  void routine(Program& program, Routine& r) {
    Editor editor(program, r, context_);
    rewrite_body(r.body, [&](Statement&& s, Body& out) {
      tolerance(s);
      auto* j = std::get_if<Jump>(&s.node);
      if (j == nullptr || !j->condition || context_.target.conditions == ConditionForm::expression ||
          j->target.computed || s.line.skip_mask != 0) {
        out.push_back(std::move(s));
        return;
      }
      split(editor, std::move(s), out);
    });
  }

 private:
  /// One jump with a condition of several relations: several jumps. The last carries the line.
  static void split(Editor& editor, Statement&& s, Body& out) {
    Jump j = std::get<Jump>(s.node);
    ExpressionLowering lowering(editor, s.line);
    lowering.jump_if(j.condition, j.target);
    Body pieces = std::move(lowering.pre);
    if (pieces.empty()) {  // never taken
      s.node = Label{};
      out.push_back(std::move(s));
      return;
    }
    std::size_t main = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      auto* piece = std::get_if<Jump>(&pieces[i].node);
      if (piece == nullptr || !same_label(piece->target, j.target)) continue;
      piece->search = j.search;
      piece->quiet = j.quiet;
      main = i;
    }
    s.node = std::move(pieces[main].node);
    pieces[main] = std::move(s);
    editor.put_group(out, std::move(pieces), main);
  }

  /// Comparisons of computed values on a control that compares exactly: a band around the bound.
  void tolerance(Statement& s) {
    if (context_.target.compare == Compare::relative_1e12) return exactly(s);
    StatementVisitor visit;
    visit.expression = [&](const ExprPtr& e) {
      return map_expr(e, [&](const ExprPtr& x) {
        const auto* b = std::get_if<Binary>(&x->node);
        if (b == nullptr || !is_comparison(b->op)) return x;
        if (near_ && b->compare == Compare::exact && equality(b->op)) return nearly(s, x);
        if (far_ && b->compare == Compare::exact && equality(b->op)) return by_order(s, e, x);
        if (b->compare == Compare::exact) return x;
        if (b->left->type == Type::string || (exact(b->left) && exact(b->right)))
          return binary(b->op, b->left, b->right);
        if (zero(b->left) || zero(b->right)) return binary(b->op, b->left, b->right);  // relative: only 0 equals 0
        warn(s);
        return b->op == BinaryOp::eq || b->op == BinaryOp::ne ? within(*b) : beyond(*b);
      });
    };
    visit_statement(s, visit);
  }
  static bool equality(BinaryOp op) { return op == BinaryOp::eq || op == BinaryOp::ne; }
  /// The source takes what differs by rounding for equal (compare.equal_within), the target does not.
  ExprPtr nearly(const Statement& s, const ExprPtr& x) {
    const auto& b = std::get<Binary>(x->node);
    if (b.left->type == Type::string || (exact(b.left) && exact(b.right))) return x;
    if (!computed(b.left) && !computed(b.right)) return x;
    warn(s);
    return within(b);
  }
  /// Equality on the target has a tolerance that the source lacks; less and greater have none.
  ExprPtr by_order(const Statement& s, const ExprPtr& whole, const ExprPtr& x) {
    const auto& b = std::get<Binary>(x->node);
    if (b.left->type == Type::string || (exact(b.left) && exact(b.right))) return x;
    if (!computed(b.left) && !computed(b.right)) return x;
    const auto* top = std::get_if<Binary>(&whole->node);
    const bool structure = std::holds_alternative<If>(s.node) || std::holds_alternative<While>(s.node) ||
                           std::holds_alternative<Until>(s.node);
    if (structure && (top == nullptr || !is_comparison(top->op))) {  // one chain of relations, without brackets
      warn(s);
      return x;
    }
    const bool eq = b.op == BinaryOp::eq;
    return binary(eq ? BinaryOp::logical_and : BinaryOp::logical_or,
                  binary(eq ? BinaryOp::le : BinaryOp::lt, b.left, b.right),
                  binary(eq ? BinaryOp::ge : BinaryOp::gt, b.left, b.right));
  }
  static bool zero(const ExprPtr& side) { return constant_value(side) == 0.0; }
  /// The target takes values within 1e-12 of their size for equal, the source does not: a difference compared with 0 is
  /// exact there as well, because nothing but 0 is that near to 0.
  void exactly(Statement& s) {
    StatementVisitor visit;
    visit.expression = [&](const ExprPtr& e) {
      return map_expr(e, [&](const ExprPtr& x) {
        const auto* b = std::get_if<Binary>(&x->node);
        if (b == nullptr || !is_comparison(b->op) || b->compare != Compare::exact) return x;
        if (near_ && equality(b->op)) return x;  // what rounding leaves is equal on both
        if (b->left->type == Type::string || zero(b->left) || zero(b->right)) return x;
        if (exact(b->left) && exact(b->right)) return x;
        if (!computed(b->left) && !computed(b->right)) return x;
        return binary(b->op, binary(BinaryOp::subtract, b->left, b->right), number(0), b->compare);
      });
    };
    visit_statement(s, visit);
  }
  /// A value that the program computes, with rounding errors; not one that comes from outside.
  [[nodiscard]] bool computed(const ExprPtr& e) const {
    return e && !plain(e) && !exact(e) && !numbers_.parts.untouched(e);
  }
  /// A number as it is written, or one that is computed without rounding.
  static bool plain(const ExprPtr& e) {
    const auto value = constant_value(e);
    const auto* minus = std::get_if<Unary>(&e->node);
    const bool written = as_number(e) != nullptr || (minus != nullptr && as_number(minus->operand) != nullptr);
    constexpr double parts = 1024;
    return value && (written || std::nearbyint(*value * parts) == *value * parts);
  }
  /// Computed without rounding: whole numbers, halves, quarters... The comparison needs no tolerance then.
  [[nodiscard]] bool exact(const ExprPtr& e) const { return numbers_.has(e); }
  /// Equality: a difference of at most the band.
  ExprPtr within(const Binary& b) const {
    const ExprPtr difference = binary(BinaryOp::subtract, b.left, b.right);
    if (context_.target.functions.count(Function::abs) != 0) {
      return binary(b.op == BinaryOp::eq ? BinaryOp::le : BinaryOp::gt, call(Function::abs, {difference}),
                    number(band_));
    }
    const ExprPtr above = binary(BinaryOp::le, difference, number(band_)),
                  below = binary(BinaryOp::ge, difference, number(-band_));
    const ExprPtr inside = binary(BinaryOp::logical_and, above, below);
    return b.op == BinaryOp::eq ? inside : negated_condition(inside);
  }
  /// Order: what is equal within the band counts as equal, so `<` and `>` want more than it, `<=` and `>=` allow it.
  ExprPtr beyond(const Binary& b) const {
    const bool number_left = constant_value(b.left).has_value() && !constant_value(b.right);
    const bool up = (b.op == BinaryOp::le || b.op == BinaryOp::gt) != number_left;
    const auto moved = [this, up](const ExprPtr& bound) {
      if (const auto c = constant_value(bound)) return number(*c + (up ? band_ : -band_));
      return binary(up ? BinaryOp::add : BinaryOp::subtract, bound, number(band_));
    };
    return number_left ? binary(b.op, moved(b.left), b.right) : binary(b.op, b.left, moved(b.right));
  }
  void warn(const Statement& s) {
    context_.diagnostics.warning(
        "TRN-115", s.line.span,
        far_ ? std::string("the target takes values that differ by rounding only for equal, the source does not")
             : std::string(near_ ? "the source takes values that differ by rounding only for equal, the target "
                                 : "the source takes values that differ by less than 1e-12 of their size for equal, "
                                   "the target ") +
                   "compares exactly: written so that values within " + shortest(band_) + " count as equal",
        "count with whole numbers where you can");
  }

  const LegaliseContext& context_;
  double band_;
  bool near_;  ///< equality of the source has a tolerance that the target lacks
  bool far_;   ///< and the other way round
  ExactNumbers numbers_;
};

}  // namespace

void lower_conditions(Program& program, const LegaliseContext& context) {
  ConditionPass pass(program, context);
  for (auto& r : program.routines) pass.routine(program, r);
}

}  // namespace cnctrans::ir::passes
