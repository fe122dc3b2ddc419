#include "legaliser/cycles/turning/turning_computed.h"

#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "ir/cycles/machining.h"
#include "ir/known_number.h"
#include "legaliser/cycles/parts/cycle_computed.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

namespace {

bool simple(const Value& v) {
  return v.literal() || is_primary(v.expr);
}

}  // namespace

ComputedTurn::ComputedTurn(const NamedCycle& cycle, const LineInfo& like, const ModalState& modes, TurnStart start,
                           double nose_width, Editor& editor)
    : cycle_(cycle), start_(std::move(start)), nose_width_(nose_width), editor_(editor) {
  like_.span = like.span;
  like_.skip_mask = like.skip_mask;
  unit_ = modes.units == Units::inch ? 25.4 : 1;
  const double k = modes.diameter == DiameterMode::radius ? 1 : 2;
  const auto* row = cycles::find_machining(cycle.name);
  p_ = {axis::x, k};
  q_ = {axis::z, 1};
  if (row != nullptr && row->face) std::swap(p_, q_);
  lead_axis_ = q_.axis;
}

ComputedTurn::~ComputedTurn() {
  for (const auto& v : taken_) editor_.release(v);
}

std::optional<Body> ComputedTurn::run() {
  const auto* row = cycles::find_machining(cycle_.name);
  bool done = false;
  if (row != nullptr && row->kind == cycles::MachiningKind::thread) {
    done = cycle_.name == "thread.counted"  ? thread_by_count()
           : cycle_.name == "thread.chased" ? thread_from_here()
           : cycle_.name == "thread.chain"  ? fail("its words are computed when the program runs")
                                            : thread_by_section();
  } else if (row != nullptr && row->kind == cycles::MachiningKind::groove) {
    done = groove();
  } else if (row != nullptr && row->kind == cycles::MachiningKind::straight) {
    done = straight();
  } else {
    fail("its words are computed when the program runs");
  }
  if (!done || !error.empty()) return std::nullopt;
  lower_structures(editor_, out_);
  return std::move(out_);
}

// --- words and variables
// ----------------------------------------------------------------------------------------------

bool ComputedTurn::fail(std::string text) {
  if (error.empty()) error = std::move(text);
  return false;
}

const Value* ComputedTurn::find(std::string_view name) const {
  for (const auto& [w, v] : cycle_.words) {
    if (w == name) return &v;
  }
  return nullptr;
}

Value ComputedTurn::word(std::string_view name, double otherwise) const {
  const Value* v = find(name);
  if (v == nullptr) return Value(otherwise);
  if (const auto n = known_number(*v)) return Value(*n);
  Value out = *v;
  out.text = {};
  return out;
}

double ComputedTurn::number_word(std::string_view name, double otherwise) {
  const Value v = word(name, otherwise);
  if (!v.literal()) fail("its word for the " + std::string(name) + " is computed when the program runs");
  return v.number;
}

Value ComputedTurn::coordinate(bool of_p, bool end) const {
  const AxisId axis = of_p ? p_.axis : q_.axis;
  return word(axis == axis::x ? (end ? "x_end" : "x") : (end ? "z_end" : "z"));
}

std::optional<VarRef> ComputedTurn::variable_of(const Value& v) {
  const auto var = editor_.take(like_);
  if (!var) {
    fail("there are no variables left to compute its passes");
    return std::nullopt;
  }
  taken_.push_back(*var);
  set(*var, v);
  return var;
}
void ComputedTurn::set(const VarRef& v, const Value& value) {
  body_->push_back(make_assign(like_, v, as_expr(value)));
}
Value ComputedTurn::kept(const Value& v) {
  if (simple(v)) return v;
  const auto var = variable_of(v);
  return var ? Value(variable(*var)) : v;
}
void ComputedTurn::when(ExprPtr condition, const VarRef& v, const Value& value) {
  If node;
  node.condition = std::move(condition);
  node.then_body.push_back(make_assign(like_, v, as_expr(value)));
  body_->push_back(made(like_, std::move(node)));
}

Value ComputedTurn::magnitude(const Value& v) {
  return v.literal() ? Value(std::fabs(v.number)) : kept(Value(call(Function::abs, {v.expr})));
}
Value ComputedTurn::sign_of(const Value& v) {
  if (v.literal()) return Value(v.number < 0 ? -1.0 : 1.0);
  const auto var = variable_of(Value(1.0));
  if (!var) return Value(1.0);
  when(binary(BinaryOp::lt, v.expr, number(0)), *var, Value(-1.0));
  return Value(variable(*var));
}
Value ComputedTurn::moved(const Value& base, const Role& role, const Value& by) const {
  if (by.is(0)) return base;
  if (by.literal()) return add(base, Value(by.number * role.k));
  const auto* u = std::get_if<Unary>(&by.expr->node);
  if (u != nullptr && u->op == UnaryOp::negate) return subtract(base, scale(Value(u->operand), role.k));
  return add(base, scale(by, role.k));
}
Value ComputedTurn::tangent(const Value& degrees) {
  if (degrees.literal()) {  // a millionth is less than a control resolves over any depth of a thread
    return Value(std::round(std::tan(std::fabs(degrees.number) * std::acos(-1.0) / 180) * 1e5) / 1e5);
  }
  return kept(Value(call(Function::tan, {call(Function::abs, {degrees.expr})})));
}

// --- moves
// ------------------------------------------------------------------------------------------------------------

void ComputedTurn::move(MotionKind kind, const Spot& to) {
  Block b;
  b.has_motion = true;
  b.motion.kind = kind;
  b.motion.explicit_code = true;
  b.motion.keeps_modal = false;
  for (const AxisId axis : {axis::x, axis::z}) {
    const auto& v = axis == p_.axis ? to.p : to.q;
    if (!v) continue;
    CoordWord w;
    w.axis = axis;
    w.mode = WordMode::absolute;
    w.value = *v;
    b.motion.coords.push_back(w);
  }
  body_->push_back(made(like_, std::move(b)));
}

void ComputedTurn::thread(const Spot& to, const Value& angle) {
  move(change_.is(0) ? MotionKind::thread : MotionKind::thread_variable, to);
  auto& motion = std::get<Block>(body_->back().node).motion;
  auto extra = std::make_shared<MotionExtra>();
  extra->has_lead = true;
  extra->lead = pitch_;
  extra->lead_axis = lead_axis_;
  extra->lead_change = change_;
  if (!angle.is(0)) {
    extra->has_start_angle = true;
    extra->start_angle = angle;
  }
  motion.extra = std::move(extra);
}

Body* ComputedTurn::open(Body& inner) {
  Body* outer = body_;
  body_ = &inner;
  return outer;
}
void ComputedTurn::close_while(Body* outer, ExprPtr condition, Body&& inner) {
  body_ = outer;
  While node;
  node.condition = std::move(condition);
  node.body = std::move(inner);
  body_->push_back(made(like_, std::move(node)));
}

// --- threads
// ----------------------------------------------------------------------------------------------------------

/// Passes by the section of the chip: ir/cycles/turning/threading.cpp.
bool ComputedTurn::thread_by_section() {
  if (has("measured") || has("measured_x") || !word("repair").is(0))
    return fail("repairing a thread needs the machine; it is not carried out");
  first_p_ = coordinate(true, false);
  last_p_ = coordinate(true, true);
  first_q_ = kept(coordinate(false, false));
  last_q_ = coordinate(false, true);
  const bool cylinder = equal(first_p_, last_p_);
  if (!cylinder && !(first_p_.literal() && last_p_.literal() && first_q_.literal() && last_q_.literal()))
    return fail("the taper of the thread is computed when the program runs");
  const Value depth = word("depth");
  if (depth.is(0)) return fail("the thread has no depth");
  out_sign_ = sign_of(depth);
  depth_ = magnitude(depth);
  const Value clearance = magnitude(word("clearance"));
  const auto lifted = [&](const Value& p) {
    if (out_sign_.literal()) return moved(p, p_, out_sign_.number < 0 ? negate(clearance) : clearance);
    return moved(p, p_, times(out_sign_, clearance));
  };
  safe_first_ = kept(lifted(first_p_));
  safe_last_ = cylinder ? safe_first_ : lifted(last_p_);
  const double angle = number_word("infeed_angle", 30);
  entry_ = has("entry") ? saturate<int>(number_word("entry")) : angle == 0 ? 0 : angle > 0 ? 1 : 2;
  if (entry_ < 0 || entry_ > 5) return fail("the kind of entry of the thread is 0 to 5");
  tan_ = tangent(Value(angle));
  if (tan_.is(0)) entry_ = 0;
  const Value exit = word("exit");
  if (!exit.literal()) return fail("the exit of the thread is computed when the program runs");
  has_exit_ = exit.number > 0;
  if (has_exit_ && !cylinder) return fail("the exit of a tapered thread is computed when the program runs");
  if (entry_ != 0 || has_exit_) dir_ = sign_of(subtract(last_q_, first_q_));
  const Value pitch = word("pitch");
  if (pitch.is(0)) return fail("the thread has no pitch");
  if (pitch.literal()) {
    double along = 1;
    if (!cylinder && pitch.number > 0) {
      const double l = std::fabs(last_q_.number - first_q_.number) / q_.k;
      along = l / std::hypot(l, (last_p_.number - first_p_.number) / p_.k);
    }
    pitch_ = Value(std::fabs(pitch.number) * along);
  } else {
    if (!cylinder) return fail("the pitch of a tapered thread is computed when the program runs");
    pitch_ = magnitude(pitch);
  }
  if (!cylinder &&
      std::fabs(last_q_.number - first_q_.number) / q_.k < std::fabs(last_p_.number - first_p_.number) / p_.k)
    lead_axis_ = p_.axis;
  change_ = word("pitch_change");
  angle_ = word("start_angle");
  starts_ = std::fmax(1, std::round(number_word("starts")));
  if (starts_ > 12) return fail("it has too many starts");
  if (!error.empty()) return false;
  alternates_ = entry_ == 2 || entry_ == 4 || entry_ == 5;
  if (alternates_) {
    side_ = variable_of(Value(entry_ == 5 ? 1.0 : 0.0));
    if (!side_) return false;
  }
  const Value stock = magnitude(word("finish_stock"));
  const Value rough = kept(subtract(depth_, stock));
  const auto n = variable_of(Value(0.0)), d = variable_of(Value(0.0));
  if (!n || !d) return false;
  rapid({safe_first_, first_q_});
  if (!law(rough, *d, *n)) return false;
  if (has("finish_stock")) pass(depth_);
  return error.empty();
}

bool ComputedTurn::law(const Value& rough, const VarRef& d, const VarRef& n) {
  const Value b = word("infeed"), least = word("minimum_infeed"), depth(variable(d)), count(variable(n));
  if (b.is(0)) return fail("the infeed of the thread is zero");
  Body inner;
  Body* outer = open(inner);
  set(n, add(count, Value(1.0)));
  const bool linear = b.literal() && b.number < 0;
  const bool grows = !linear && !(least.literal() && least.number <= 0);
  Value next = depth;
  if (grows) next = kept(add(depth, least));
  set(d, linear ? times(Value(-b.number), count) : times(b, root(count)));
  if (grows) when(more(next, depth), d, next);
  if (!b.literal()) when(binary(BinaryOp::lt, b.expr, number(0)), d, negate(times(b, count)));
  when(more(depth, rough), d, rough);
  pass(depth);
  close_while(outer, more(rough, add(depth, Value(least_rest / unit_))), std::move(inner));
  return error.empty();
}

/// One pass at the depth, for each start.
void ComputedTurn::pass(const Value& d) {
  const auto deep = [&](const Value& p) {
    if (out_sign_.literal()) return out_sign_.number < 0 ? moved(p, p_, d) : subtract(p, scale(d, p_.k));
    return subtract(p, scale(times(out_sign_, d), p_.k));
  };
  Value begin = first_q_;
  if (entry_ != 0) {
    // Against the thread by the tangent of what is missing to the full depth.
    Value shift = times(tan_, subtract(depth_, d));
    if (alternates_) shift = times(Value(variable(*side_)), shift);
    const bool last_flank = entry_ == 3 || entry_ == 4;
    if (dir_.literal()) {
      const bool plus = (dir_.number < 0) != last_flank;
      begin = plus ? moved(first_q_, q_, shift) : subtract(first_q_, scale(shift, q_.k));
    } else {
      shift = times(dir_, shift);
      begin = last_flank ? moved(first_q_, q_, shift) : subtract(first_q_, scale(shift, q_.k));
    }
  }
  for (double v = 0; v < starts_; ++v) {
    Spot in{kept(deep(first_p_)), std::nullopt};
    if (entry_ != 0) in.q = begin;
    rapid(in);
    const Value angle = add(angle_, Value(360 * v / starts_));
    const bool cylinder = equal(first_p_, last_p_);
    if (has_exit_) {
      const double exit = word("exit").number;
      const Value turn = dir_.literal() ? add(last_q_, Value(-dir_.number * exit * q_.k))
                                        : subtract(last_q_, times(dir_, Value(exit * q_.k)));
      thread({std::nullopt, turn}, angle);
      thread({safe_last_, last_q_}, angle);
    } else {
      thread({cylinder ? std::nullopt : std::optional(deep(last_p_)), last_q_}, angle);
      rapid({safe_last_, std::nullopt});
    }
    rapid({cylinder ? std::nullopt : std::optional(safe_first_), first_q_});
  }
  if (!alternates_) return;
  const Value side(variable(*side_));
  set(*side_, entry_ == 5 ? negate(side) : subtract(Value(1.0), side));
}

// --- grooves
// ----------------------------------------------------------------------------------------------------------

/// Plunges of equal distance: groove() in ir/cycles/turning/turning.cpp.
bool ComputedTurn::groove() {
  if (nose_width_ <= 0)
    return fail("the width of the grooving tool is not known: \"nose_width\" of the tool in the profile");
  const auto& start_p = p_.axis == axis::x ? start_.x : start_.z;
  const auto& start_q = p_.axis == axis::x ? start_.z : start_.x;
  if (!start_p || !start_q) return fail("the place of the tool before it is not known here");
  const Value top = word(p_.axis == axis::x ? "x" : "z"), floor = coordinate(true, true);
  const Value from = kept(coordinate(false, false)), to = coordinate(false, true);
  const Value width(nose_width_ / unit_);
  const Value step = word("step", nose_width_ / unit_), clearance = magnitude(word("clearance"));
  const Value up = sign_of(subtract(top, floor));
  const Value safe = kept(up.literal() ? moved(top, p_, up.number < 0 ? negate(clearance) : clearance)
                                       : moved(top, p_, times(up, clearance)));
  const Value way = kept(scale(subtract(to, from), 1 / q_.k));
  const auto rest = variable_of(subtract(magnitude(way), width));
  if (!rest) return false;
  const Value left(variable(*rest)), least(least_rest / unit_);
  const auto gaps = variable_of(Value(call(Function::ceil, {as_expr(subtract(quotient(left, step), least))})));
  if (!gaps) return false;
  const Value count(variable(*gaps));
  when(binary(BinaryOp::lt, count.expr, number(1)), *gaps, Value(1.0));
  when(binary(BinaryOp::lt, left.expr, as_expr(least)), *gaps, Value(0.0));
  // From here on the distance of two plunges, with its sign, in words of the axis.
  when(more(count, Value(0.5)), *rest, quotient(left, count));
  const Value sense = sign_of(way);
  set(*rest, scale(times(sense, left), q_.k));
  const auto k = variable_of(Value(0.0));
  if (!k) return false;
  const Value at(variable(*k));
  Body inner;
  Body* outer = open(inner);
  rapid({safe, add(from, times(left, at))});
  feed({floor, std::nullopt});
  if (const Value pause = word("dwell"); !pause.is(0))
    body_->push_back(make_block(like_, action(Dwell{pause, 0.01, false})));
  rapid({safe, std::nullopt});
  set(*k, add(at, Value(1.0)));
  close_while(outer, more(add(count, Value(0.5)), at), std::move(inner));
  rapid({*start_p, std::nullopt});
  rapid({std::nullopt, *start_q});
  return error.empty();
}

}  // namespace cnctrans::ir::passes
