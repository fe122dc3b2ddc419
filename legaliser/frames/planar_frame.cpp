#include "legaliser/frames/planar_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnctrans::ir::passes {

namespace {

bool same(const std::optional<Value>& a, const std::optional<Value>& b) {
  return a.has_value() == b.has_value() && (!a || equal(*a, *b));
}

void meet(std::optional<Value>& a, const std::optional<Value>& b) {
  if (a && (!b || !equal(*a, *b))) a.reset();
}

bool odd(std::uint32_t mirror, Plane plane) {
  const auto p = plane_axes(plane);
  return ((mirror >> p.u ^ mirror >> p.v) & 1U) != 0;
}

Value multiplied(const Value& a, const Value& b) {
  if (a.is(0) || b.is(0)) return Value{0.0};
  if (b.literal()) return b.number == -1 ? negate(a) : scale(a, b.number);
  if (a.literal()) return a.number == -1 ? negate(b) : scale(b, a.number);
  return Value{binary(BinaryOp::multiply, a.expr, b.expr)};
}

/// cos(angle - 90 * quarter): quarter 0 the cosine, 1 the sine. Exact at multiples of 90.
Value wave(const Value& angle, int quarter) {
  if (!angle.literal())
    return Value{call(quarter == 0 ? Function::cos : Function::sin, std::vector<ExprPtr>{angle.expr})};
  const double turned = std::fmod(angle.number - 90.0 * quarter, 360);
  const double quarters = turned / 90;
  if (quarters == std::floor(quarters)) {
    const int n = (static_cast<int>(quarters) % 4 + 4) % 4;
    return Value{n == 0 ? 1.0 : (n == 2 ? -1.0 : 0.0)};
  }
  return Value{std::cos(turned * std::numbers::pi / 180)};
}

struct PlanePoint {
  std::optional<Value> u, v;
};

/// R(angle) (u, v).
PlanePoint turned(const PlanePoint& p, const std::optional<Value>& angle) {
  if (angle && angle->is(0)) return p;
  if (p.u && p.v && p.u->is(0) && p.v->is(0)) return p;
  if (!angle || !p.u || !p.v) return {};
  const Value c = wave(*angle, 0), s = wave(*angle, 1);
  return {subtract(multiplied(*p.u, c), multiplied(*p.v, s)), add(multiplied(*p.u, s), multiplied(*p.v, c))};
}

}  // namespace

PlanarFrame::PlanarFrame() : angle(Value{0.0}), factor(Value{1.0}), mirror(0U) {
  shift.fill(Value{0.0});
}

bool PlanarFrame::known() const {
  return !foreign && angle && factor && mirror &&
         std::all_of(shift.begin(), shift.end(), [](const auto& v) { return v.has_value(); });
}

PlanarFrame PlanarFrame::with_axes() const {
  PlanarFrame f = *this;
  f.foreign = foreign && !by_axes;
  return f;
}

bool PlanarFrame::has_shift() const {
  return std::any_of(shift.begin(), shift.end(), [](const auto& v) { return !v || !v->is(0); });
}

bool PlanarFrame::has_expressions() const {
  const auto computed = [](const std::optional<Value>& v) { return v && v->expr; };
  return computed(angle) || computed(factor) || std::any_of(shift.begin(), shift.end(), computed);
}

bool PlanarFrame::neutral() const {
  return known() && !has_shift() && !turns() && !scales() && !mirrors();
}

FrameWord PlanarFrame::word(std::size_t a) const {
  FrameWord w;
  w.axis = static_cast<AxisId>(a);
  w.value = *shift[a];
  w.scale = shift_scale[a];
  return w;
}

std::vector<FrameWord> PlanarFrame::shift_words(bool drop_zero) const {
  std::vector<FrameWord> words;
  for (std::size_t a = 0; a < axes; ++a) {
    if (shift[a] && !(drop_zero && shift[a]->is(0))) words.push_back(word(a));
  }
  return words;
}

void PlanarFrame::each_value(const std::function<void(std::optional<Value>&)>& visit) {
  for (auto& s : shift) visit(s);
  visit(angle);
  visit(factor);
}

void PlanarFrame::join(const PlanarFrame& other) {
  by_axes = by_axes && other.by_axes && scaled == other.scaled;
  foreign = foreign || other.foreign || (turns() && other.turns() && plane != other.plane);
  if (!turns()) plane = other.plane;
  for (std::size_t a = 0; a < axes; ++a) {
    const bool both_zero = shift[a] && shift[a]->is(0) && other.shift[a] && other.shift[a]->is(0);
    if (shift_scale[a] != other.shift_scale[a] && !both_zero) {
      shift[a].reset();
    } else {
      meet(shift[a], other.shift[a]);
    }
  }
  meet(angle, other.angle);
  meet(factor, other.factor);
  if (mirror != other.mirror) mirror.reset();
}

bool PlanarFrame::operator==(const PlanarFrame& o) const {
  return foreign == o.foreign && by_axes == o.by_axes && same_shift(*this, o) && same_turn(*this, o) &&
         same_factor(*this, o) && same_mirror(*this, o);
}

bool same_shift(const PlanarFrame& a, const PlanarFrame& b) {
  for (std::size_t i = 0; i < PlanarFrame::axes; ++i) {
    if (!same(a.shift[i], b.shift[i])) return false;
    if (a.shift[i] && !a.shift[i]->is(0) && a.shift_scale[i] != b.shift_scale[i]) return false;
  }
  return true;
}
bool same_turn(const PlanarFrame& a, const PlanarFrame& b) {
  return same(a.angle, b.angle) && (!a.turns() || a.plane == b.plane);
}
bool same_factor(const PlanarFrame& a, const PlanarFrame& b) {
  return same(a.factor, b.factor) && (!a.scales() || a.scaled == b.scaled);
}
bool same_mirror(const PlanarFrame& a, const PlanarFrame& b) {
  return a.mirror == b.mirror;
}

PlanarFrame compose(const PlanarFrame& a, const PlanarFrame& b) {
  if (a.neutral()) return b;
  if (b.neutral()) return a;
  PlanarFrame r = a;
  bool foreign = a.with_axes().foreign || b.with_axes().foreign || (a.scales() && b.scales() && a.scaled != b.scaled);
  if (!a.scales()) r.scaled = b.scaled;
  if (b.has_shift()) {
    auto moved = b.shift;
    for (std::size_t i = 0; i < PlanarFrame::axes; ++i) {
      auto& v = moved[i];
      if (!v || v->is(0)) continue;
      if (!a.mirror || (i >= 3 && a.scales()) || (i < 3 && !a.factor)) {
        v.reset();
        continue;
      }
      if ((*a.mirror >> i & 1U) != 0) v = negate(*v);
      if ((a.scaled >> i & 1U) != 0) v = multiplied(*v, *a.factor);
      if (a.turns() && b.shift_scale[i] == WordScale::diameter) foreign = true;
    }
    const auto p = plane_axes(a.plane);
    const PlanePoint at = turned({moved[p.u], moved[p.v]}, a.angle);
    moved[p.u] = at.u;
    moved[p.v] = at.v;
    for (std::size_t i = 0; i < PlanarFrame::axes; ++i) {
      if (moved[i] && moved[i]->is(0)) continue;
      const bool mixed = r.shift[i] && !r.shift[i]->is(0) && r.shift_scale[i] != b.shift_scale[i];
      if (mixed) foreign = true;
      r.shift_scale[i] = b.shift_scale[i];
      if (r.shift[i] && r.shift[i]->is(0))
        r.shift[i] = moved[i];
      else if (r.shift[i] && moved[i])
        r.shift[i] = add(*r.shift[i], *moved[i]);
      else
        r.shift[i].reset();
    }
  }
  if (b.turns()) {
    const auto p = plane_axes(b.plane);
    const bool one_scaled = a.scales() && ((a.scaled >> p.u ^ a.scaled >> p.v) & 1U) != 0;
    if ((a.turns() && a.plane != b.plane) || one_scaled) foreign = true;
    r.plane = b.plane;
    if (!a.mirror || !b.angle || !a.angle)
      r.angle.reset();
    else
      r.angle = add(*a.angle, odd(*a.mirror, b.plane) ? negate(*b.angle) : *b.angle);
  }
  if (a.factor && b.factor)
    r.factor = multiplied(*a.factor, *b.factor);
  else
    r.factor.reset();
  if (a.mirror && b.mirror)
    r.mirror = *a.mirror ^ *b.mirror;
  else
    r.mirror.reset();
  const bool partly = r.scales() && r.scaled != PlanarFrame::linear;
  r.foreign = foreign || partly;
  r.by_axes = partly && !foreign;
  return r;
}

PlanarFrame rotation_about(const PlanarFrame& centre, const Value& angle, Plane plane) {
  PlanarFrame r;
  r.angle = angle;
  r.plane = plane;
  r.foreign = centre.foreign;
  if (!centre.has_shift()) return r;
  const auto p = plane_axes(plane);
  const PlanePoint c{centre.shift[p.u], centre.shift[p.v]};
  const PlanePoint t = turned(c, angle);
  for (const auto& [axis, from, to] : {std::tuple{p.u, c.u, t.u}, std::tuple{p.v, c.v, t.v}}) {
    if (from && to)
      r.shift[axis] = subtract(*from, *to);
    else
      r.shift[axis].reset();
    r.shift_scale[axis] = centre.shift_scale[axis];
    if (centre.shift_scale[axis] == WordScale::diameter) r.foreign = true;
  }
  return r;
}

std::optional<PlanarFrame> in_slots(const PlanarFrame& f, const std::vector<FrameSlot>& order) {
  const auto place = [&order](FrameSlot s) {
    const auto it = std::find(order.begin(), order.end(), s);
    return it == order.end() ? -1 : static_cast<int>(it - order.begin());
  };
  const int shift = place(FrameSlot::shift), turn = place(FrameSlot::rotation), mirror = place(FrameSlot::mirror),
            factor = place(FrameSlot::scale);
  if ((f.has_shift() && shift < 0) || (f.turns() && turn < 0) || (f.mirrors() && mirror < 0) ||
      (f.scales() && factor < 0))
    return std::nullopt;
  PlanarFrame r = f;
  if (f.has_shift() && f.turns() && turn < shift) return std::nullopt;
  if (f.mirrors() && f.has_shift() && mirror < shift) {
    for (std::size_t i = 0; i < PlanarFrame::axes; ++i) {
      if (!f.mirror)
        r.shift[i].reset();
      else if (r.shift[i] && (*f.mirror >> i & 1U) != 0)
        r.shift[i] = negate(*r.shift[i]);
    }
  }
  if (f.scales() && f.has_shift() && factor < shift) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!f.factor || !r.shift[i])
        r.shift[i].reset();
      else if (!r.shift[i]->is(0))
        r.shift[i] = f.factor->literal() ? scale(*r.shift[i], 1 / f.factor->number)
                                         : Value{binary(BinaryOp::divide, as_expr(*r.shift[i]), f.factor->expr)};
    }
  }
  if (f.mirrors() && f.turns() && mirror < turn) {
    if (!f.mirror)
      r.angle.reset();
    else if (r.angle && odd(*f.mirror, f.plane))
      r.angle = negate(*r.angle);
  }
  return r;
}

}  // namespace cnctrans::ir::passes
