#include "legaliser/expressions/expression_lowering.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace cnctrans::ir::passes {

namespace {

bool commutes(BinaryOp op) {
  return op == BinaryOp::add || op == BinaryOp::multiply || op == BinaryOp::bit_and || op == BinaryOp::bit_or ||
         op == BinaryOp::bit_xor;
}

bool is_logical(BinaryOp op) {
  return op == BinaryOp::logical_and || op == BinaryOp::logical_or || op == BinaryOp::logical_xor;
}

/// What may stand behind an operator of a chain: no sign in front.
bool is_simple(const ExprPtr& e) {
  if (const auto* n = as_number(e)) return n->value >= 0;
  if (const auto* c = std::get_if<Call>(&e->node))
    return c->args.size() == 1 && is_primary(c->args[0]) && is_simple(c->args[0]);
  return is_primary(e);
}

}  // namespace

bool is_condition(const ExprPtr& e) {
  if (!e) return false;
  if (const auto* b = std::get_if<Binary>(&e->node)) return is_comparison(b->op) || is_logical(b->op);
  const auto* u = std::get_if<Unary>(&e->node);
  return u != nullptr && u->op == UnaryOp::logical_not;
}

bool expression_fits(const ExprPtr& e, const Capabilities& target) {
  bool fits = target.expressions == ExpressionForm::full;
  walk(e, [&](const ExprPtr& n) {
    if (const auto* b = std::get_if<Binary>(&n->node)) fits = fits && target.binary.count(b->op) != 0;
    if (const auto* u = std::get_if<Unary>(&n->node)) fits = fits && target.unary.count(u->op) != 0;
    if (const auto* c = std::get_if<Call>(&n->node)) fits = fits && target.functions.count(c->function) != 0;
    if (const auto* v = std::get_if<Number>(&n->node)) {
      fits = fits && std::fabs(v->value) <= target.constant_max &&
             parse_decimal(rounded(v->value, target.constant_decimals)) == v->value;
    }
  });
  return fits;
}

ExprPtr negated_condition(const ExprPtr& e) {
  if (!e) return e;
  if (const auto* u = std::get_if<Unary>(&e->node); u != nullptr && u->op == UnaryOp::logical_not) return u->operand;
  if (const auto* b = std::get_if<Binary>(&e->node)) {
    if (is_comparison(b->op)) return binary(negated(b->op), b->left, b->right, b->compare);
    if (b->op == BinaryOp::logical_and)
      return binary(BinaryOp::logical_or, negated_condition(b->left), negated_condition(b->right));
    if (b->op == BinaryOp::logical_or)
      return binary(BinaryOp::logical_and, negated_condition(b->left), negated_condition(b->right));
  }
  if (e->type == Type::boolean) return unary(UnaryOp::logical_not, e);
  return binary(BinaryOp::eq, e, number(0));
}

ExpressionLowering::~ExpressionLowering() {
  for (const auto& v : taken_) editor_.release(v);
}

std::optional<VarRef> ExpressionLowering::temporary() {
  if (scratch_ && !scratch_used_) {
    scratch_used_ = true;
    return scratch_;
  }
  auto v = editor_.take(like_);
  if (v) taken_.push_back(*v);
  return v;
}

void ExpressionLowering::assign(const VarRef& v, const ExprPtr& e) {
  pre.push_back(make_assign(like_, v, e));
}

void ExpressionLowering::label_here(const LabelRef& l) {
  pre.push_back(make_label(like_, l, editor_.program));
}

void ExpressionLowering::assign_if(const ExprPtr& relation, const VarRef& v, const ExprPtr& e) {
  if (const auto fixed = constant_value(relation)) {
    if (*fixed != 0) assign(v, e);
    return;
  }
  const auto& t = editor_.target();
  if ((t.structured_if || t.one_line_if_action) && like_.skip_mask == 0) {
    If i;
    i.condition = relation;
    i.one_line = !t.structured_if;
    i.then_body.push_back(make_assign(like_, v, e));
    pre.push_back(made(like_, std::move(i)));
    return;
  }
  const LabelRef behind = editor_.fresh_label();
  pre.push_back(make_jump(like_, behind, variable_first(negated_condition(relation))));
  assign(v, e);
  label_here(behind);
}

ExprPtr ExpressionLowering::fail(const ExprPtr& e, std::string_view what) {
  editor_.context.diagnostics.error("TRN-111", word_span(like_.span, e->pos), std::string(what),
                                    "compute the value in another way, or set it before");
  return e;
}

ExprPtr ExpressionLowering::into_temporary(const ExprPtr& e) {
  const auto v = temporary();
  if (!v) return e;
  assign(*v, e);
  return variable(*v, e->type == Type::boolean ? Type::real : e->type);
}

ExprPtr ExpressionLowering::primary(const ExprPtr& e) {
  if (!e) return e;
  const ExprPtr low = lower(e);
  return is_primary(low) ? low : into_temporary(low);
}

ExprPtr ExpressionLowering::lower(const ExprPtr& e) {
  if (!e) return e;
  const ExprPtr supported = node(e);
  return editor_.target().expressions == ExpressionForm::left_to_right ? chain(supported) : supported;
}

ExprPtr ExpressionLowering::node(const ExprPtr& e) {
  if (!e) return e;
  if (++depth_ > 400) {
    --depth_;
    return fail(e, "the expression is too deep");
  }
  ExprPtr out = e;
  if (std::holds_alternative<Number>(e->node)) {
    out = constant(e);
  } else if (const auto* b = std::get_if<Binary>(&e->node)) {
    out = binary_rule(*b, e);
  } else if (const auto* u = std::get_if<Unary>(&e->node)) {
    out = unary_rule(*u, e);
  } else if (const auto* c = std::get_if<Call>(&e->node)) {
    out = call_rule(*c, e);
  } else if (const auto* v = std::get_if<VarRef>(&e->node); v != nullptr && v->index && !constant_value(v->index)) {
    VarRef copy = *v;
    copy.index = lower(v->index);
    out = variable(std::move(copy), e->type);
  } else if (v != nullptr && !v->indices.empty()) {
    VarRef copy = *v;
    for (auto& i : copy.indices) i = element_index(i);
    out = variable(std::move(copy), e->type);
  }
  --depth_;
  return out;
}

/// What brackets behind the name of an array take: a variable or a number, or the sum of two.
ExprPtr ExpressionLowering::element_index(const ExprPtr& e) {
  const ExprPtr low = lower(e);
  const auto* b = std::get_if<Binary>(&low->node);
  const bool sum = b != nullptr && (b->op == BinaryOp::add || b->op == BinaryOp::subtract) && is_primary(b->left) &&
                   is_primary(b->right);
  return sum || is_primary(low) ? low : into_temporary(low);
}

/// Constants with more places than the target takes: a sum of two that it takes.
ExprPtr ExpressionLowering::constant(const ExprPtr& e) {
  const auto& t = editor_.target();
  const double v = std::get<Number>(e->node).value;
  const double kept = parse_decimal(rounded(v, t.constant_decimals)).value_or(v);
  if (std::fabs(v) > t.constant_max) {
    const double factor = std::pow(10, std::ceil(std::log10(std::fabs(v) / t.constant_max)));
    return node(binary(BinaryOp::multiply, number(v / factor), number(factor)));
  }
  if (kept == v || t.constant_decimals > 12) return e;
  const double unit = std::pow(10, t.constant_decimals);
  const double rest = parse_decimal(rounded((v - kept) * unit, t.constant_decimals)).value_or(0);
  if (rest == 0) return number(kept);
  return binary(BinaryOp::add, number(kept), binary(BinaryOp::divide, number(rest), number(unit)));
}

// --- one chain from left to right -------------------------------------------------------------------------------

/// What may stand behind an operator: itself, or a temporary that holds it.
ExprPtr ExpressionLowering::operand(const ExprPtr& e) {
  if (is_simple(e)) return e;
  const ExprPtr c = chain(e);
  return is_simple(c) ? c : into_temporary(c);
}

ExprPtr ExpressionLowering::chain(const ExprPtr& e) {
  if (is_primary(e)) return e;
  if (const auto* u = std::get_if<Unary>(&e->node)) {
    const ExprPtr inner = chain(u->operand);
    if (u->op != UnaryOp::negate) return is_primary(inner) ? unary(u->op, inner) : unary(u->op, into_temporary(inner));
    if (const auto* n = as_number(inner)) return number(-n->value);
    return unary(u->op, is_primary(inner) ? inner : into_temporary(inner));
  }
  if (const auto* c = std::get_if<Call>(&e->node)) {
    Args args;
    for (const auto& a : c->args) {
      const ExprPtr low = chain(a);
      args.push_back(is_primary(low) && is_simple(low) ? low : into_temporary(low));
    }
    return call(c->function, std::move(args), c->half);
  }
  if (const auto* b = std::get_if<Binary>(&e->node)) return chain_binary(*b);
  return e;
}

ExprPtr ExpressionLowering::chain_binary(const Binary& b) {
  const auto* n = as_number(b.right);
  if (n != nullptr && n->value < 0 && (b.op == BinaryOp::add || b.op == BinaryOp::subtract)) {
    return chain(binary(b.op == BinaryOp::add ? BinaryOp::subtract : BinaryOp::add, b.left, number(-n->value)));
  }
  if (const auto* u = std::get_if<Unary>(&b.right->node);
      u != nullptr && u->op == UnaryOp::negate && (b.op == BinaryOp::add || b.op == BinaryOp::subtract)) {
    return chain(binary(b.op == BinaryOp::add ? BinaryOp::subtract : BinaryOp::add, b.left, u->operand));
  }
  if (commutes(b.op) && !is_simple(b.right) && is_simple(b.left)) {
    return binary(b.op, chain(b.right), b.left, b.compare);
  }
  // The right side first: the accumulator of the chain is the left one.
  const ExprPtr right = operand(b.right);
  return binary(b.op, chain(b.left), right, b.compare);
}

// --- words ------------------------------------------------------------------------------------------------------

Value ExpressionLowering::word(const Value& v) {
  if (v.literal()) return v;
  const auto& t = editor_.target();
  if (const auto* n = as_number(v.expr)) return Value{n->value};
  if (const auto c = constant_value(v.expr); c && std::fabs(*c) < 1e12) return Value{*c};
  const auto plain_variable = [&](const ExprPtr& e) {
    const auto* ref = as_variable(e);
    return ref != nullptr && t.word_variable &&
           (!ref->index || constant_value(ref->index) || (t.word_indirect && t.word_indirect_value));
  };
  if (t.word_expression) return Value{lower(v.expr)};
  if (plain_variable(v.expr)) return Value{lower(v.expr)};
  if (const auto* u = std::get_if<Unary>(&v.expr->node);
      u != nullptr && u->op == UnaryOp::negate && t.word_variable_sign && plain_variable(u->operand))
    return v;
  const ExprPtr low = lower(v.expr);
  if (plain_variable(low)) return Value{low};
  if (const auto* n = as_number(low)) return Value{n->value};
  return Value{into_temporary(low)};
}

}  // namespace cnctrans::ir::passes
