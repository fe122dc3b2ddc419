// Threads by a number of passes with words that only the run knows.
#include <cmath>

#include "base/saturate.h"
#include "legaliser/cycles/parts/cycle_computed.h"
#include "legaliser/cycles/turning/turning_computed.h"

namespace cnctrans::ir::passes {

/// A given number of passes: ir/cycles/turning/counted_threads.cpp.
bool ComputedTurn::thread_by_count() {
  const int variant = saturate<int>(number_word("variant"));
  if (variant < 1 || variant > 4) return fail("this way of cutting a thread is not carried out");
  const bool inside = variant % 2 == 0;
  out_sign_ = Value(inside ? -1.0 : 1.0);
  first_p_ = kept(word("x"));
  last_p_ = word("x_end");
  if (!equal(word("x"), last_p_)) return fail("the taper of the thread is computed when the program runs");
  first_q_ = word("z");
  last_q_ = word("z_end");
  const Value run_in = word("run_in"), run_out = word("run_out");
  const double angle = number_word("infeed_angle");
  if (!run_in.is(0) || !run_out.is(0) || angle != 0) dir_ = sign_of(subtract(last_q_, first_q_));
  const auto beyond = [&](const Value& q, const Value& by, bool back) {
    if (by.is(0)) return q;
    if (!dir_.literal()) {
      const Value way = times(dir_, by);
      return back ? subtract(q, way) : add(q, way);
    }
    return (dir_.number < 0) == back ? add(q, by) : subtract(q, by);
  };
  first_q_ = kept(beyond(first_q_, run_in, true));
  last_q_ = kept(beyond(last_q_, run_out, false));
  const Value size = word("size"), pitch = word("pitch");
  if (!size.is(0)) return fail("the pitch of the thread follows from its size");
  if (pitch.is(0)) return fail("the thread has no pitch");
  pitch_ = magnitude(pitch);
  const Value lift = word("withdrawal");
  Value away;
  if (lift.literal()) {
    away = Value(lift.number != 0 ? std::fabs(lift.number) : 1 / unit_);
  } else {
    const auto var = variable_of(Value(call(Function::abs, {lift.expr})));
    if (!var) return false;
    when(binary(BinaryOp::eq, variable(*var), number(0)), *var, Value(1 / unit_));
    away = Value(variable(*var));
  }
  safe_first_ = kept(inside ? subtract(first_p_, scale(away, p_.k)) : moved(first_p_, p_, away));
  depth_ = magnitude(word("depth"));
  const Value stock = magnitude(word("finish_stock"));
  tan_ = tangent(Value(angle));
  angle_ = word("start_angle");
  starts_ = std::fmax(1, std::round(number_word("starts")));
  if (starts_ > 12) return fail("it has too many starts");
  const Value passes = word("passes"), idle = word("idle");
  if (!error.empty()) return false;
  alternates_ = angle < 0;
  if (alternates_ && !(side_ = variable_of(Value(-1.0)))) return false;
  const Value rough = kept(subtract(depth_, stock));
  rapid({safe_first_, first_q_});
  return counted_starts(passes, rough, stock, idle, variant > 2);
}

/// Every start with its passes, `falling`: by the root of their count; then those without infeed.
bool ComputedTurn::counted_starts(const Value& passes, const Value& rough, const Value& stock, const Value& idle,
                                  bool falling) {
  const double starts = starts_;
  const Value angle_now = angle_;
  for (double s = 0; s < starts; ++s) {
    angle_ = add(angle_now, Value(360 * s / starts));
    if (s > 0 && alternates_) set(*side_, Value(-1.0));
    const auto i = variable_of(Value(1.0));
    if (!i) return false;
    const Value at(variable(*i));
    const auto loop = [&](const Value& count, const Value& h) {
      Body inner;
      Body* outer = open(inner);
      counted_pass(h);
      set(*i, add(at, Value(1.0)));
      close_while(outer, more(add(count, Value(0.5)), at), std::move(inner));
    };
    const Value part = quotient(at, passes);
    loop(passes, times(rough, falling ? root(part) : part));
    if (!stock.literal()) {
      If node;
      node.condition = more(stock, Value(least_rest / unit_));
      Body* outer = open(node.then_body);
      counted_pass(depth_);
      body_ = outer;
      body_->push_back(made(like_, std::move(node)));
    } else if (stock.number > 0 || passes.is(0)) {
      counted_pass(depth_);
    }
    if (idle.is(0)) continue;
    if (idle.literal() && idle.number < 4) {
      for (double n = 0; n < std::round(idle.number); ++n) counted_pass(depth_);
      continue;
    }
    set(*i, Value(1.0));
    loop(idle, depth_);
  }
  return error.empty();
}

void ComputedTurn::counted_pass(const Value& h) {
  const Value d = kept(h);
  Spot in{out_sign_.number < 0 ? moved(first_p_, p_, d) : subtract(first_p_, scale(d, p_.k)), std::nullopt};
  if (!tan_.is(0)) {
    const Value by = alternates_ ? times(Value(variable(*side_)), times(tan_, subtract(depth_, d))) : times(tan_, d);
    in.q = !dir_.literal()   ? add(first_q_, times(dir_, by))
           : dir_.number < 0 ? subtract(first_q_, by)
                             : add(first_q_, by);
  }
  rapid(in);
  thread({std::nullopt, last_q_}, angle_);
  rapid({safe_first_, std::nullopt});
  rapid({std::nullopt, first_q_});
  if (alternates_) set(*side_, negate(Value(variable(*side_))));
}

/// From the place of the tool to the root: chased_thread() in ir/cycles/turning/counted_threads.cpp.
bool ComputedTurn::thread_from_here() {
  if (!start_.x || !start_.z) return fail("the place of the tool before it is not known here");
  if (!word("cone").is(0)) return fail("the cone of the thread is not known as numbers alone");
  if (!word("exit").is(0)) return fail("the exit of the thread is not known as numbers alone");
  safe_first_ = kept(*start_.x);
  first_q_ = kept(*start_.z);
  const Value end = has("x_end") ? word("x_end") : *start_.x;
  last_q_ = word("z_end");
  out_sign_ = sign_of(subtract(safe_first_, end));
  depth_ = magnitude(word("depth"));
  const Value last = magnitude(word("finish_stock"));
  const double angle = number_word("infeed_angle");
  tan_ = tangent(Value(angle));
  if (angle != 0) dir_ = sign_of(subtract(last_q_, first_q_));
  pitch_ = magnitude(word("pitch"));
  starts_ = std::fmax(1, std::round(number_word("starts", 1)));
  if (starts_ > 12) return fail("it has too many starts");
  // The crest, from which depths are counted.
  if (out_sign_.literal())
    first_p_ = kept(out_sign_.number < 0 ? subtract(end, scale(depth_, p_.k)) : moved(end, p_, depth_));
  else
    first_p_ = kept(moved(end, p_, times(out_sign_, depth_)));
  const Value gaps = kept(subtract(word("passes", 1), Value(1.0)));
  const Value rough = kept(subtract(depth_, last));
  if (!error.empty()) return false;
  const auto go = [&](const Value& h) {
    const Value d = kept(h);
    Spot in;
    if (out_sign_.literal())
      in.p = out_sign_.number < 0 ? moved(first_p_, p_, d) : subtract(first_p_, scale(d, p_.k));
    else
      in.p = subtract(first_p_, scale(times(out_sign_, d), p_.k));
    if (!tan_.is(0)) {
      const Value by = times(tan_, d);
      in.q = !dir_.literal()   ? add(first_q_, times(dir_, by))
             : dir_.number < 0 ? subtract(first_q_, by)
                               : add(first_q_, by);
    }
    rapid(in);
    thread({std::nullopt, last_q_}, angle_);
    rapid({safe_first_, std::nullopt});
    rapid({std::nullopt, first_q_});
  };
  for (double s = 0; s < starts_; ++s) {
    angle_ = Value(360 * s / starts_);
    if (!(gaps.literal() && gaps.number < 0.5)) {
      const auto i = variable_of(Value(1.0));
      if (!i) return false;
      const Value at(variable(*i));
      Body inner;
      Body* outer = open(inner);
      go(times(rough, root(quotient(at, gaps))));
      set(*i, add(at, Value(1.0)));
      close_while(outer, more(add(gaps, Value(0.5)), at), std::move(inner));
    }
    go(depth_);
  }
  return error.empty();
}

}  // namespace cnctrans::ir::passes
