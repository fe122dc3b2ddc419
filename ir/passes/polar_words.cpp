#include "ir/passes/polar_words.h"

#include <cmath>
#include <numbers>

namespace cnctrans::ir::passes {

double clean(double x) {
  return std::round(x * 1e9) / 1e9 + 0.0;
}

Point2 around(Point2 pole, double r, double q) {
  const double angle = q * std::numbers::pi / 180;
  return {clean(pole.u + r * std::cos(angle)), clean(pole.v + r * std::sin(angle))};
}

Value around(const Value& r, const Value& q, Function wave, double from, double factor) {
  const ExprPtr turn = q.literal() ? as_expr(q) : q.expr;
  const Value leg{binary(BinaryOp::multiply, as_expr(r), call(wave, std::vector<ExprPtr>{turn}))};
  return add(scale(leg, 1 / factor), Value{from / factor});
}

bool is_polar_arc(const Block& b, const Facts& facts) {
  if (!b.has_motion || !b.motion.extra) return false;
  const auto kind = motion_in(b, facts);
  if (kind != MotionKind::arc_cw && kind != MotionKind::arc_ccw) return false;
  return b.motion.extra->has_polar_angle || b.motion.extra->has_polar_radius;
}

bool is_polar_line(const Block& b, const Facts& facts) {
  if (!b.has_motion || !b.motion.extra) return false;
  const auto kind = motion_in(b, facts);
  return (kind == MotionKind::linear || kind == MotionKind::rapid) &&
         (b.motion.extra->has_polar_angle || b.motion.extra->has_polar_radius);
}

bool uses_polar(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      const MotionExtra* x = b->has_motion ? b->motion.extra.get() : nullptr;
      found = found || (x != nullptr && (x->has_polar_angle || x->has_polar_radius));
      for (const auto& a : b->actions) {
        const auto* p = std::get_if<PoleSet>(&a.data);
        found = found || (p != nullptr && p->at && !p->at->words.empty());
      }
    });
  }
  return found;
}

}  // namespace cnctrans::ir::passes
