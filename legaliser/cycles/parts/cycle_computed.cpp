// The pecks of a hole whose depth only the run knows: ir::cycles::peck_sizes as a loop.
#include "legaliser/cycles/parts/cycle_computed.h"

namespace cnctrans::ir::passes {

/// Distance from the place where the pecks begin to the bottom, and which way is out.
Value ComputedHole::depth() {
  const Value top = c_.pecks.first_from_surface ? surface_ : reference_;
  const Value signed_depth = difference(top, bottom_);
  if (signed_depth.literal()) {
    up_ = signed_depth.number < 0 ? -1 : 1;
    return Value(std::fabs(signed_depth.number));
  }
  const auto constant = constant_value(signed_depth.expr);
  if (constant) {
    up_ = *constant < 0 ? -1 : 1;
    return Value(std::fabs(*constant));
  }
  taken_downward_ = true;
  return signed_depth;
}

void ComputedHole::pecks() {
  const Pecks& p = c_.pecks;
  if (p.law == PeckLaw::none) {
    first_feed();
    feed(bottom_);
    return dwell(c_.dwell_bottom);
  }
  const auto rest = variable_of(depth());
  if (!rest) return;
  const Value left = value_of(*rest);
  if (p.first_to.given) {
    const Value top = p.first_from_surface ? surface_ : reference_;
    const Value at = level(p.first_to, &c_.surface, true);
    first_ = up_ > 0 ? subtract(top, at) : subtract(at, top);
  } else {
    first_ = p.first;
  }
  first_.text = {};
  whole_ = left;
  const Value gap = reapproach(left);
  if (!above_deepest(gap) || !above_deepest(p.lift)) whole_ = kept_copy(left);
  if (!law_begin(left)) return;
  first_feed();
  Body inner;
  loop_ = &inner;
  set(*rest, subtract(left, peck_));
  feed(height(left));
  dwell(p.dwell);
  after_first();  // the lift of a chip is driven at the usual feed
  between(left, gap);
  law_next(left);
  loop_ = nullptr;
  While node;
  node.condition = more(left, add(peck_, tiny_));
  node.body = std::move(inner);
  out_.push_back(made(like_, std::move(node)));
  feed(bottom_);
  dwell(c_.dwell_bottom);
  after_first();
}

Value ComputedHole::kept_copy(const Value& v) {
  const auto var = variable_of(v);
  return var ? value_of(*var) : v;
}

/// The tool stands under the reference plane at that distance above any bottom of a peck.
bool ComputedHole::above_deepest(const Value& distance) const {
  if (zero_value(distance)) return true;
  if (!distance.literal() || !first_.literal()) return false;
  const bool halved = c_.pecks.law == PeckLaw::balanced || c_.pecks.law == PeckLaw::arithmetic;
  const bool kept_size = halved || c_.pecks.law == PeckLaw::constant || c_.pecks.law == PeckLaw::count;
  return kept_size && distance.number <= first_.number / (halved ? 2 : 1);
}

/// `distance` above the bottom of a peck, at most the reference plane.
Value ComputedHole::over(const Value& left, const Value& distance) {
  const Value sum = zero_value(distance) ? left : add(left, distance);
  if (above_deepest(distance)) return height(sum);
  const auto var = variable_of(sum);
  if (!var) return sum;
  // The reference plane may lie above the place where the pecks begin.
  Value most = whole_;
  if (c_.pecks.first_from_surface && !equal(surface_, reference_))
    most = add(whole_, up_ > 0 ? subtract(reference_, surface_) : subtract(surface_, reference_));
  when(more(value_of(*var), most), *var, most);
  return height(value_of(*var));
}

void ComputedHole::between(const Value& left, const Value& gap) {
  const Pecks& p = c_.pecks;
  if (c_.kind == HoleKind::peck_full) {
    rapid(p.withdraws_to_retract ? retract_ : reference_);
    dwell(c_.dwell_top);
    return rapid(over(left, gap));
  }
  if (zero_value(p.lift)) return;
  const Value lifted = over(left, p.lift);
  if (!p.lift_rapid) return feed(lifted);
  rapid(lifted);
  if (p.lift.literal() && gap.literal() && gap.number < p.lift.number)
    rapid(over(left, gap));
  else if (!p.lift.literal() || !gap.literal())
    fail("the lift of its pecks is computed when the program runs");
}

/// 0.6 mm down to a depth of 30 mm, else a fiftieth of the depth, at most 7 mm.
Value ComputedHole::reapproach(const Value& depth_now) {
  if (!c_.pecks.reapproach_automatic) {
    Value v = c_.pecks.reapproach;
    v.text = {};
    return v;
  }
  if (c_.kind != HoleKind::peck_full) return Value(0.0);
  const auto gap = variable_of(Value(0.6 / unit_));
  if (!gap) return {};
  when(more(depth_now, Value(30 / unit_)), *gap, quotient(depth_now, Value(50.0)));
  when(more(value_of(*gap), Value(7 / unit_)), *gap, Value(7 / unit_));
  return value_of(*gap);
}

bool ComputedHole::law_begin(const Value& left) {
  const Pecks& p = c_.pecks;
  peck_ = first_;
  switch (p.law) {
    case PeckLaw::constant:
    case PeckLaw::count: peck_ = kept(first_); return error.empty();
    case PeckLaw::balanced:
    case PeckLaw::arithmetic: return halving_begin();
    case PeckLaw::geometric: return geometric_begin();
    case PeckLaw::linear: return linear_begin(left);
    default: return fail("the law of its pecks is not carried out");
  }
}

bool ComputedHole::peck_variable(const Value& v) {
  peck_var_ = variable_of(v);
  if (peck_var_) peck_ = value_of(*peck_var_);
  return peck_var_.has_value();
}

bool ComputedHole::halving_begin() {
  if (!peck_variable(first_)) return false;
  least_ = first_;
  if (c_.pecks.law == PeckLaw::arithmetic) {
    const Value& d = c_.pecks.degression;
    const Value& m = c_.pecks.minimum;
    if (d.literal() && m.literal() && first_.literal()) {
      least_ = Value(std::fmin(first_.number, std::fmax(d.number, m.number)));
    } else {
      const auto var = variable_of(d);
      if (!var) return false;
      least_ = value_of(*var);
      if (!zero_value(m)) when(more(m, least_), *var, m);
      when(more(least_, first_), *var, first_);
    }
  }
  return error.empty();
}

/// The last two pecks share what is left below two of the smallest ones.
void ComputedHole::halve(const Value& left) {
  If outer, inner;
  inner.condition = more(left, add(peck_, tiny_));
  inner.then_body.push_back(make_assign(like_, *peck_var_, as_expr(quotient(left, Value(2.0)))));
  const Value twice = product(Value(2.0), c_.pecks.law == PeckLaw::arithmetic ? least_ : peck_);
  outer.condition = more(subtract(twice, tiny_), left);
  outer.then_body.push_back(made(like_, std::move(inner)));
  body().push_back(made(like_, std::move(outer)));
}

bool ComputedHole::geometric_begin() {
  const Pecks& p = c_.pecks;
  if (!p.degression.literal()) return fail("the factor of its pecks is computed when the program runs");
  if (p.degression.number > 1 || (p.degression.number < 1 && (!p.minimum.literal() || p.minimum.number <= 0)))
    return fail("its pecks get smaller without a least one, and how many there are is known when the program runs");
  if (!peck_variable(first_)) return false;
  if (p.degression.number != 1) when(more(p.minimum, peck_), *peck_var_, p.minimum);
  return true;
}

/// n pecks from the first evenly to the last, all times one factor so that they end at the bottom.
bool ComputedHole::linear_begin(const Value& left) {
  const Value sum = kept(add(first_, c_.pecks.minimum));
  const Value n0 = quotient(product(Value(2.0), left), sum);
  const Value n1(call(Function::ceil, {as_expr(subtract(n0, Value(least_rest)))}));
  const auto n = variable_of(n1);
  if (!n) return false;
  when(binary(BinaryOp::lt, variable(*n), number(2)), *n, Value(2.0));
  // The factor that brings them to the bottom: depth / (n * sum / 2).
  const auto factor = variable_of(quotient(quotient(product(Value(2.0), left), value_of(*n)), sum));
  if (!factor || !peck_variable(product(first_, value_of(*factor)))) return false;
  const Value fall = product(subtract(first_, c_.pecks.minimum), value_of(*factor));
  step_ = kept(quotient(fall, subtract(value_of(*n), Value(1.0))));
  return error.empty();
}

void ComputedHole::law_next(const Value& left) {
  const Pecks& p = c_.pecks;
  switch (p.law) {
    case PeckLaw::balanced: return halve(left);
    case PeckLaw::arithmetic:
      set(*peck_var_, subtract(peck_, p.degression));
      when(more(least_, peck_), *peck_var_, least_);
      return halve(left);
    case PeckLaw::geometric:
      if (p.degression.number == 1) return;
      set(*peck_var_, product(peck_, p.degression));
      when(more(p.minimum, peck_), *peck_var_, p.minimum);
      return;
    case PeckLaw::linear: return set(*peck_var_, subtract(peck_, step_));
    default: return;
  }
}

std::optional<Explosion> explode_computed(const HoleCycle& c, const LineInfo& like, const Block& b, const Facts& facts,
                                          const FeedBefore& feed, std::optional<double> defined_at,
                                          std::optional<SpindleState> sense, Editor& editor, bool* downward,
                                          std::string* error) {
  ComputedHole hole(c, like, b, facts, feed, defined_at, sense, editor);
  auto moves = hole.run();
  *downward = hole.taken_downward();
  if (!moves) *error = hole.error;
  if (moves) lower_structures(editor, moves->blocks);
  return moves;
}

}  // namespace cnctrans::ir::passes
