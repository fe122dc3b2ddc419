#include "legaliser/expressions/fold_texts.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "ir/text/texts.h"

namespace cnctrans::ir::passes {

namespace {

ExprPtr placed(ExprPtr made, const ExprPtr& like) {
  return at(made, like->pos);
}

/// `inside`: within a text, where a number is shown as it is now.
ExprPtr folded(const ExprPtr& e, const KnownValues& known, bool inside) {
  if (!e) return e;
  if (const auto* v = as_variable(e)) {
    const bool number = e->type != Type::string && e->type != Type::axis;
    const ExprPtr value = number && !inside ? nullptr : known.variable(*v);
    return value ? placed(value, e) : e;
  }
  const bool text = e->type == Type::string;
  Expr copy = *e;
  bool changed = false;
  const auto child = [&](ExprPtr& x, bool in_text) {
    const ExprPtr to = folded(x, known, in_text);
    changed = changed || to != x;
    x = to;
  };
  if (auto* u = std::get_if<Unary>(&copy.node)) {
    child(u->operand, inside);
  } else if (auto* b = std::get_if<Binary>(&copy.node)) {
    const bool texts = b->op == BinaryOp::concat;
    child(b->left, inside || texts);
    child(b->right, inside || texts);
  } else if (auto* c = std::get_if<Call>(&copy.node)) {
    const bool of_text = text || is_text_function(e);
    for (auto& a : c->args) child(a, inside || of_text);
  } else if (auto* s = std::get_if<SystemRef>(&copy.node)) {
    for (auto& a : s->args) child(a, inside);
  } else {
    return e;
  }
  const ExprPtr now = changed ? std::make_shared<const Expr>(std::move(copy)) : e;
  if (text) {
    if (const auto* c = std::get_if<Call>(&now->node); c != nullptr && c->function == Function::axis_text) {
      const auto* axis = std::get_if<AxisName>(&c->args[0]->node);
      return axis != nullptr && known.axis_name ? placed(string_literal(known.axis_name(axis->axis)), e) : now;
    }
    const auto known_text = constant_text(now);
    return known_text ? placed(string_literal(*known_text), e) : now;
  }
  const auto value = constant_of_texts(now);
  return value ? placed(number(*value), e) : now;
}

/// The label that a text names, as the control finds it: an identifier of the routine, else a block number.
LabelRef label_named(const std::string& text, const Routine& routine) {
  LabelRef l;
  l.text = to_upper_ascii(trim(text));
  bool identifier = false;
  for_each_statement(routine.body, [&](const Statement& s) {
    const auto on = labels_on(s.line);
    identifier = identifier || std::any_of(on.begin(), on.end(),
                                           [&l](const LabelRef& x) { return !x.is_number && x.text == l.text; });
  });
  std::string_view digits = l.text;
  if (!digits.empty() && (digits[0] == 'N' || digits[0] == ':')) digits.remove_prefix(1);
  if (identifier || digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) return l;
  const std::size_t first = digits.find_first_not_of('0');
  return label_of(first == std::string_view::npos ? "0" : std::string(digits.substr(first)), true);
}

const std::string* text_of(const ExprPtr& e) {
  const auto* s = e ? std::get_if<String>(&e->node) : nullptr;
  return s != nullptr ? &s->text : nullptr;
}

void say_label(LabelRef& l, const Routine& routine) {
  if (const auto* text = text_of(l.computed)) l = label_named(*text, routine);
}

void say_routine(CallRoutine& c, const KnownValues& known) {
  if (!c.computed) return;
  if (const auto* text = text_of(c.computed)) {
    c.routine = RoutineName{-1, to_upper_ascii(trim(*text))};
    c.computed = nullptr;
    return;
  }
  const auto* whole = std::get_if<Call>(&c.computed->node);
  const bool rounds = whole != nullptr && whole->function == Function::to_integer;
  const auto n = constant_value(folded(rounds ? whole->args[0] : c.computed, known, true));
  if (!n || *n < 0 || *n > 1e9) return;
  c.routine = RoutineName{std::llround(*n), {}};
  c.computed = nullptr;
}

bool nothing_in(const MotionExtra& e) {
  const bool words = e.has_turns || e.has_pitch || e.has_angle || e.has_polar_radius || e.has_polar_angle ||
                     e.has_line_angle || e.has_lead || e.has_start_angle || e.has_probe_edge || e.has_fixed_point ||
                     e.has_interval || e.has_weight || e.has_degree;
  return !words && e.through.empty() && e.computed.empty() && e.polynomials.empty() && e.lead_change.is(0) &&
         e.probe_tolerance.is(0);
}

/// AX[NAME]=5 with a known axis is a word of that axis.
void say_axes(Block& b, const KnownValues& known) {
  if (!b.motion.extra || b.motion.extra->computed.empty()) return;
  auto extra = std::make_shared<MotionExtra>(*b.motion.extra);
  std::vector<ComputedWord> left;
  for (auto& w : extra->computed) {
    const ExprPtr axis = folded(w.axis, known, false);
    const auto* name = std::get_if<AxisName>(&axis->node);
    const bool twice = name != nullptr && std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                                                      [name](const CoordWord& c) { return c.axis == name->axis; });
    if (name == nullptr || twice) {
      w.axis = axis;
      left.push_back(std::move(w));
      continue;
    }
    CoordWord word;
    word.axis = name->axis;
    word.mode = w.mode;
    word.value = std::move(w.value);
    word.pos = w.pos;
    b.motion.coords.push_back(std::move(word));
  }
  extra->computed = std::move(left);
  if (nothing_in(*extra))
    b.motion.extra.reset();
  else
    b.motion.extra = std::move(extra);
}

}  // namespace

ExprPtr with_known_texts(const ExprPtr& e, const KnownValues& known) {
  return folded(e, known, false);
}

void say_known_names(Statement& s, const KnownValues& known, const Program& program, const Routine& routine) {
  if (auto* j = std::get_if<Jump>(&s.node)) {
    say_label(j->target, routine);
  } else if (auto* sw = std::get_if<Switch>(&s.node)) {
    for (auto& [value, to] : sw->cases) say_label(to.target, routine);
    for (auto& to : sw->fallback) say_label(to.target, routine);
  } else if (auto* r = std::get_if<Repeat>(&s.node); r != nullptr && !r->has_program) {
    say_label(r->first, routine);
    say_label(r->last, routine);
  } else if (auto* c = std::get_if<CallRoutine>(&s.node)) {
    say_routine(*c, known);
    const Routine* callee = c->has_range && !c->computed ? program.find(c->routine) : nullptr;
    if (callee != nullptr) say_label(c->first, *callee);
    if (callee != nullptr) say_label(c->last, *callee);
  } else if (auto* m = std::get_if<ModalCall>(&s.node)) {
    say_routine(m->call, known);
  } else if (auto* b = std::get_if<Block>(&s.node)) {
    say_axes(*b, known);
  }
}

bool is_text_function(const ExprPtr& e) {
  const auto* c = std::get_if<Call>(&e->node);
  return c != nullptr && number_of_text(c->function, "0", "0").has_value();
}

void each_axis_expression(const Statement& s, const std::function<void(const ExprPtr&)>& visit) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || !b->motion.extra) return;
  for (const auto& w : b->motion.extra->computed) visit(w.axis);
}

}  // namespace cnctrans::ir::passes
