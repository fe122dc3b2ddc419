// Stock removal against a straight element with words that only the run knows.
#include "legaliser/cycles/parts/cycle_computed.h"
#include "legaliser/cycles/turning/turning_computed.h"

namespace cnctrans::ir::passes {

namespace {

/// `by` in the sense of the sign.
Value toward(const Value& base, const Value& sense, const Value& by) {
  if (by.is(0)) return base;
  if (!sense.literal()) return add(base, times(sense, by));
  return sense.number < 0 ? subtract(base, by) : add(base, by);
}

}  // namespace

void ComputedTurn::feed_at(const Spot& to, const Value& f) {
  feed(to);
  std::get<Block>(body_->back().node).actions.push_back(action(SetFeed{f, false}));
}

/// rise / way; 0 where the way is none, so that the target never divides by 0: no height lies between the ends then.
Value ComputedTurn::slope_of(const Value& rise, const Value& way) {
  if (way.literal()) return kept(quotient(rise, way));
  const Value run = kept(way), length = magnitude(run);
  const auto slope = variable_of(Value(0.0));
  if (!slope) return Value(0.0);
  when(more(length, Value(least_rest / unit_)), *slope, quotient(rise, run));
  return Value(variable(*slope));
}

/// Equal passes from the place of the call: straight_or_arc() in ir/cycles/turning/turning.cpp.
bool ComputedTurn::straight() {
  const bool across = p_.axis == axis::x;
  const auto& at_p = across ? start_.x : start_.z;
  const auto& at_q = across ? start_.z : start_.x;
  if (!at_p || !at_q) return fail("the place of the tool before it is not known here");
  const Value from_p = kept(*at_p), from_q = kept(*at_q);
  const Value pi = kept(coordinate(true, false)), pf = kept(coordinate(true, true));
  const Value qi = kept(coordinate(false, false)), qf = kept(coordinate(false, true));
  const bool even = equal(qi, qf) || equal(pi, pf);
  const Value sp = sign_of(subtract(from_p, pi)), sq = sign_of(subtract(from_q, qi));
  const Value stock_p = scale(word(across ? "stock_x" : "stock_z"), p_.k);
  const Value stock_q = scale(word(across ? "stock_z" : "stock_x"), q_.k);
  const Value first_p = kept(toward(pi, sp, stock_p)), last_p = kept(toward(pf, sp, stock_p));
  const Value first_q = kept(toward(qi, sq, stock_q)), last_q = kept(toward(qf, sq, stock_q));
  const Value way = kept(subtract(first_p, from_p));
  const Value step = scale(word("step"), p_.k), least(least_rest / unit_);
  const Value n0(call(Function::ceil, {as_expr(subtract(quotient(magnitude(way), step), least))}));
  const auto n = variable_of(n0);
  if (!n) return false;
  const Value count(variable(*n));
  when(binary(BinaryOp::lt, count.expr, number(1)), *n, Value(1.0));
  Value slope;
  if (!even) slope = slope_of(subtract(last_q, first_q), subtract(last_p, first_p));
  const bool follows = !has("withdrawal");
  const auto k = variable_of(Value(1.0)), level = variable_of(from_p);
  const auto before = follows ? variable_of(from_p) : std::nullopt;
  const auto end = even ? std::nullopt : variable_of(last_q);
  if (!k || !level || (follows && !before) || (!even && !end)) return false;
  const Value pass(variable(*k)), height(variable(*level));
  const Value stop = even ? last_q : Value(variable(*end));
  // How far a height lies outside of the last point.
  const auto beyond = [&](const Value& h) { return times(sp, subtract(h, last_p)); };
  const auto on_line = [&](const Value& h) { return add(first_q, times(subtract(h, first_p), slope)); };
  Body inner;
  Body* outer = open(inner);
  if (follows) set(*before, height);
  set(*level, add(from_p, quotient(times(way, pass), count)));
  if (!even) {
    set(*end, on_line(height));
    when(more(beyond(height), negate(least)), *end, last_q);
  }
  rapid({height, std::nullopt});
  feed({std::nullopt, stop});
  if (follows) {
    const Value old(variable(*before));
    if (even)
      feed({old, std::nullopt});
    else
      withdraw_along(beyond(height), beyond(old), old, on_line(old), {last_p, last_q});
  } else if (const Value d = word("withdrawal"); !d.is(0)) {
    const Value away = magnitude(d);
    rapid({toward(height, sp, scale(away, p_.k)), toward(stop, sq, scale(away, q_.k))});
  }
  rapid({std::nullopt, from_q});
  set(*k, add(pass, Value(1.0)));
  close_while(outer, more(add(count, Value(0.5)), pass), std::move(inner));
  const double rough = number_word("rough_feed"), fine = number_word("finish_feed");
  const bool restored = (rough > 0 || fine > 0) && !usual_feed.none;
  if (restored && !usual_feed.value) return fail("the feed after the cycle's own one is not known here");
  if (rough > 0) {
    rapid({first_p, first_q});
    feed_at({last_p, last_q}, Value(rough));
  }
  if (fine > 0) {
    rapid({from_p, std::nullopt});
    rapid({std::nullopt, from_q});
    rapid({pi, std::nullopt});
    feed_at({std::nullopt, qi}, Value(fine));
    feed({pf, qf});
  }
  rapid({from_p, std::nullopt});
  rapid({std::nullopt, from_q});
  if (restored) body_->push_back(make_block(like_, action(SetFeed{Value(*usual_feed.value), false})));
  return error.empty();
}

/// Back along the element to the height of the pass before; beyond the last point straight out.
void ComputedTurn::withdraw_along(const Value& now, const Value& then, const Value& height, const Value& there,
                                  const Spot& last) {
  const Value least(least_rest / unit_);
  If below;
  below.condition = more(negate(least), now);
  Body* outer = open(below.then_body);
  If within;
  within.condition = more(then, least);
  within.has_else = true;
  Body* middle = open(within.then_body);
  feed(last);
  body_ = &within.else_body;
  feed({height, there});
  body_ = middle;
  body_->push_back(made(like_, std::move(within)));
  body_ = outer;
  body_->push_back(made(like_, std::move(below)));
  If out;
  out.condition = more(then, least);
  outer = open(out.then_body);
  feed({height, std::nullopt});
  body_ = outer;
  body_->push_back(made(like_, std::move(out)));
}

}  // namespace cnctrans::ir::passes
