#include "legaliser/frames/frame_constants.h"

#include <algorithm>
#include <cmath>

namespace cnctrans::ir::passes {

namespace {

std::optional<AxisId> axis_in(const ExprPtr& e) {
  const auto* a = e ? std::get_if<AxisName>(&e->node) : nullptr;
  if (a == nullptr || a->axis >= PlanarFrame::axes) return std::nullopt;
  return a->axis;
}

std::optional<Plane> plane_about(AxisId normal) {
  for (const Plane p : {Plane::xy, Plane::zx, Plane::yz}) {
    if (plane_axes(p).w == normal) return p;
  }
  return std::nullopt;
}

std::optional<FramePart> part_in(const ExprPtr& e) {
  const auto n = constant_value(e);
  if (!n || *n < 0 || *n > static_cast<double>(FramePart::mirror)) return std::nullopt;
  return static_cast<FramePart>(static_cast<int>(*n));
}

bool whole(const PlanarFrame& f) {
  return f.known() && (!f.angle || f.angle->literal()) && (!f.factor || f.factor->literal());
}

std::optional<PlanarFrame> shifted(const Call& c) {
  PlanarFrame f;
  for (std::size_t i = 0; i + 1 < c.args.size(); i += 2) {
    const auto axis = axis_in(c.args[i]);
    const auto value = constant_value(c.args[i + 1]);
    if (!axis || !value) return std::nullopt;
    f.shift[*axis] = Value{*value};
  }
  return f;
}

/// About one axis only: several turns incline the plane.
std::optional<PlanarFrame> turned(const Call& c) {
  PlanarFrame f;
  for (std::size_t i = 0; i + 1 < c.args.size(); i += 2) {
    const auto axis = axis_in(c.args[i]);
    const auto plane = axis ? plane_about(*axis) : std::nullopt;
    const auto angle = constant_value(c.args[i + 1]);
    if (!plane || !angle) return std::nullopt;
    if (*angle == 0) continue;
    if (f.turns()) return std::nullopt;
    f.angle = Value{*angle};
    f.plane = *plane;
  }
  return f;
}

std::optional<PlanarFrame> stretched(const Call& c) {
  PlanarFrame f;
  std::array<double, 3> factor{1, 1, 1};
  for (std::size_t i = 0; i + 1 < c.args.size(); i += 2) {
    const auto axis = axis_in(c.args[i]);
    const auto value = constant_value(c.args[i + 1]);
    if (!axis || !value || *axis > axis::z || *value <= 0) return std::nullopt;
    factor[*axis] = *value;
  }
  if (factor[0] != factor[1] || factor[0] != factor[2]) return std::nullopt;
  f.factor = Value{factor[0]};
  return f;
}

std::optional<PlanarFrame> mirrored(const Call& c) {
  PlanarFrame f;
  for (const auto& a : c.args) {
    const auto axis = axis_in(a);
    if (!axis) return std::nullopt;
    f.mirror = *f.mirror | 1U << *axis;
  }
  return f;
}

/// p = M . 1/k . R(-angle) . T(-shift) p'
std::optional<PlanarFrame> inverse(const PlanarFrame& f) {
  if (!whole(f) || f.factor->is(0)) return std::nullopt;
  PlanarFrame mirror, factor, turn, shift;
  mirror.mirror = f.mirror;
  factor.factor = Value{1 / f.factor->number};
  turn.angle = negate(*f.angle);
  turn.plane = f.plane;
  for (std::size_t i = 0; i < PlanarFrame::axes; ++i) {
    shift.shift[i] = negate(*f.shift[i]);
    shift.shift_scale[i] = f.shift_scale[i];
  }
  return compose(compose(compose(mirror, factor), turn), shift);
}

std::optional<PlanarFrame> with_component(PlanarFrame f, AxisId axis, FramePart part, double value) {
  switch (part) {
    case FramePart::shift: f.shift[axis] = Value{value}; return f;
    case FramePart::fine:
      if (!f.shift[axis]) return std::nullopt;
      f.shift[axis] = add(*f.shift[axis], Value{value});
      return f;
    case FramePart::turn: {
      const auto plane = plane_about(axis);
      if (f.mirrors() || !plane || !f.angle) return std::nullopt;
      if (f.turns() && f.plane != *plane) {
        if (value != 0) return std::nullopt;
        return f;
      }
      f.plane = *plane;
      f.angle = Value{value};
      return f;
    }
    case FramePart::mirror:
      if (f.turns() || !f.mirror) return std::nullopt;
      f.mirror = value != 0 ? *f.mirror | 1U << axis : *f.mirror & ~(1U << axis);
      return f;
    case FramePart::scale: {
      const auto now = component_of(f, axis, part);
      if (!now || *now != value) return std::nullopt;  // of a single axis
      return f;
    }
  }
  return std::nullopt;
}

}  // namespace

bool only_shifts(const PlanarFrame& f) {
  return !f.foreign && !f.turns() && !f.scales() && !f.mirrors();
}

std::optional<double> component_of(const PlanarFrame& f, AxisId axis, FramePart part) {
  if (axis >= PlanarFrame::axes || f.foreign) return std::nullopt;
  switch (part) {
    case FramePart::fine: return 0;
    case FramePart::shift:
      if (!f.shift[axis] || !f.shift[axis]->literal()) return std::nullopt;
      return f.shift[axis]->number;
    case FramePart::scale:
      if (axis > axis::z) return 1;
      return f.factor && f.factor->literal() ? std::optional(f.factor->number) : std::nullopt;
    case FramePart::turn: {
      if (f.mirrors() || !f.angle || !f.angle->literal()) return std::nullopt;
      if (!f.turns() || plane_axes(f.plane).w != axis) return 0;
      const double angle = std::remainder(f.angle->number, 360);
      const bool over = axis == axis::y && std::abs(angle) > 90;  // about Y it reads -90..90, the others turn as well
      return over ? std::nullopt : std::optional(angle == -180 ? 180 : angle);
    }
    case FramePart::mirror: {
      if (!f.mirror || (f.mirrors() && f.turns())) return std::nullopt;
      const std::uint32_t linear = *f.mirror & 7U;
      const bool one = linear == 0 || linear == 1 || linear == 2 || linear == 4;  // two of them are a turn
      if (!one) return std::nullopt;
      return (*f.mirror >> axis & 1U) != 0 ? 1 : 0;
    }
  }
  return std::nullopt;
}

std::optional<PlanarFrame> constant_frame(const ExprPtr& e, const FrameLookup& held) {
  if (!e) return std::nullopt;
  const auto* c = std::get_if<Call>(&e->node);
  if (c == nullptr) return held(*e);
  const auto frame = [&](std::size_t n) { return constant_frame(c->args[n], held); };
  switch (c->function) {
    case Function::frame_shift:
    case Function::frame_fine: return shifted(*c);
    case Function::frame_turn: return turned(*c);
    case Function::frame_solid_turn: return c->args.size() <= 2 ? turned(*c) : std::nullopt;
    case Function::frame_stretch: return stretched(*c);
    case Function::frame_mirror: return mirrored(*c);
    case Function::frame_inverse: {
      const auto f = frame(0);
      return f ? inverse(*f) : std::nullopt;
    }
    case Function::frame_chain: {
      const auto outer = frame(0);
      const auto inner = outer ? frame(1) : std::nullopt;
      if (!inner) return std::nullopt;
      PlanarFrame both = compose(*outer, *inner);
      return both.foreign ? std::nullopt : std::optional(both);
    }
    case Function::frame_with: {
      const auto f = frame(0);
      const auto axis = axis_in(c->args[1]);
      const auto part = part_in(c->args[2]);
      const auto value = constant_value(c->args[3]);
      if (!f || !axis || !part || !value) return std::nullopt;
      return with_component(*f, *axis, *part, *value);
    }
    default: return std::nullopt;
  }
}

std::optional<double> constant_component(const ExprPtr& e, const FrameLookup& held) {
  const auto* c = e ? std::get_if<Call>(&e->node) : nullptr;
  if (c == nullptr || c->function != Function::frame_part) return std::nullopt;
  const auto f = constant_frame(c->args[0], held);
  const auto axis = axis_in(c->args[1]);
  const auto part = part_in(c->args[2]);
  if (!f || !axis || !part) return std::nullopt;
  return component_of(*f, *axis, *part);
}

}  // namespace cnctrans::ir::passes
