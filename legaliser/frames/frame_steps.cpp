#include "legaliser/frames/frame_steps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnctrans::ir::passes {

namespace {

bool in_numbers(PlanarFrame f) {
  bool literal = f.known() && !f.foreign;
  f.each_value([&literal](std::optional<Value>& v) { literal = literal && v && v->literal(); });
  return literal;
}

/// The rotation of a frame, about its zero point.
void turn(FrameSteps::Place& at, Plane plane, double degrees) {
  if (degrees == 0) return;
  const PlaneAxes axes = plane_axes(plane);
  auto &u = at[axes.u], &v = at[axes.v];
  if (!u || !v) {
    u.reset();
    v.reset();
    return;
  }
  const double radians = degrees * std::numbers::pi / 180, c = std::cos(radians), s = std::sin(radians);
  const double turned = c * *u - s * *v;
  v = s * *u + c * *v;
  u = turned;
}
void mirror(FrameSteps::Place& at, std::uint32_t axes) {
  for (std::size_t i = 0; i < PlanarFrame::axes; ++i) {
    if (at[i] && (axes >> i & 1U) != 0) at[i] = -*at[i];
  }
}
void stretch(FrameSteps::Place& at, double factor) {
  for (std::size_t i = 0; i < PlanarFrame::axes; ++i) {
    if (at[i]) *at[i] *= factor;
  }
}
void shift(FrameSteps::Place& at, const PlanarFrame& f, double sign) {
  for (std::size_t i = 0; i < PlanarFrame::axes; ++i) {
    if (at[i]) *at[i] += sign * f.shift[i]->number;
  }
}

}  // namespace

FrameSteps::FrameSteps(const Program& program, const FactsOf& facts, const machine::Profile& machine,
                       const LegaliseContext& context)
    : facts_(facts),
      machine_(machine),
      states_(program, facts,
              LegaliseContext{context.target, machine, context.target_machine, context.options, context.diagnostics,
                              nullptr, context.source_numbers, context.names}) {}

std::optional<FrameSteps::Step> FrameSteps::step(const Statement& s) const {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || s.line.skip_mask != 0) return std::nullopt;
  FrameState state = states_.before(s);
  Step step{state.whole(machine_), {}};
  for (const auto& a : b->actions) {
    const auto* f = std::get_if<FrameOp>(&a.data);
    const auto* m = std::get_if<ModalSet>(&a.data);
    if (std::holds_alternative<WorkOffset>(a.data) ||
        (m != nullptr && (m->setting == Setting::units || m->setting == Setting::diameter)))
      return std::nullopt;
    if (f == nullptr) continue;
    if (!f->change || f->change->combine == FrameCombine::preset) return std::nullopt;
    state.apply(*f->change, facts_.before(s), *b, machine_);
  }
  step.after = state.whole(machine_);
  for (const auto& a : machine_.axes) {
    const bool shifted = a.id < PlanarFrame::axes && a.diameter &&
                         !(step.before.shift[a.id] && step.before.shift[a.id]->is(0) && step.after.shift[a.id] &&
                           step.after.shift[a.id]->is(0));
    if (shifted) return std::nullopt;
  }
  return step;
}

FrameSteps::Place FrameSteps::seen(const Statement& s, const Place& before) const {
  const auto step = this->step(s);
  if (!step || !in_numbers(step->before) || !in_numbers(step->after)) return {};
  const PlanarFrame &from = step->before, &to = step->after;
  if (from.factor->number == 0 || to.factor->number == 0) return {};
  Place at = before;
  mirror(at, *from.mirror);
  stretch(at, from.factor->number);
  turn(at, from.plane, from.angle->number);
  shift(at, from, 1);
  shift(at, to, -1);
  turn(at, to.plane, -to.angle->number);
  stretch(at, 1 / to.factor->number);
  mirror(at, *to.mirror);
  for (auto& x : at) {
    constexpr double steps = 1e9;  // in 1 mm: finer is noise of sines and cosines
    if (x) x = std::round(*x * steps) / steps + 0.0;
  }
  return at;
}

bool FrameSteps::moves_zero(const Statement& s) const {
  const auto step = this->step(s);
  const auto is_set = [](const std::optional<Value>& v) { return v.has_value(); };
  return !step || !std::all_of(step->before.shift.begin(), step->before.shift.end(), is_set) ||
         !same_shift(step->before, step->after);
}

}  // namespace cnctrans::ir::passes
