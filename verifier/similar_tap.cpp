#include "verifier/similar_tap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/text.h"
#include "verifier/commands.h"

namespace cnctrans::verifier {

using interpreter::Event;
using interpreter::EventKind;

namespace {

struct Hole {
  double u = 0, v = 0;
  double depth = 0, top = 0;  ///< of its strokes, below the reference plane
  double pitch = 0;
};

/// nullopt with a sentence: the strokes are not those of one tap.
std::optional<Hole> hole_of(const CyclePasses& side, const Tolerances& t, std::string& what) {
  const auto axes = ir::plane_axes(side.run->plane);
  std::optional<Hole> hole;
  for (const Event* e : side.events) {
    const double below = (side.run->surface - e->to.value[axes.w]) * side.run->out;
    if (e->kind == EventKind::thread) {
      const Hole here{e->to.value[axes.u], e->to.value[axes.v], below, below, std::fabs(e->pitch)};
      if (!hole) hole = here;
      hole->depth = std::max(hole->depth, below);
      hole->top = std::min(hole->top, below);
      const bool same = std::fabs(hole->u - here.u) <= t.length && std::fabs(hole->v - here.v) <= t.length &&
                        close_relative(hole->pitch, here.pitch, t.feed_relative);
      if (!same) return what = "the strokes of a tap have other places or pitches", std::nullopt;
    } else if (e->kind == EventKind::rapid && below > t.length) {
      return what = "a rapid move of a tap ends in its hole", std::nullopt;
    } else if (e->kind == EventKind::linear || e->kind == EventKind::arc) {
      return what = "a tap has a move at a feed", std::nullopt;
    }
  }
  if (!hole) what = "a tap has no stroke";
  return hole;
}

/// The strokes into the hole, or back out of it: each way has a speed of its own.
std::vector<const Event*> strokes_of(const CyclePasses& side, bool back) {
  const auto w = ir::plane_axes(side.run->plane).w;
  double from = side.start.value[w];
  std::vector<const Event*> out;
  for (const Event* e : side.events) {
    const double to = e->to.value[w];
    if (e->kind == EventKind::thread && ((to - from) * side.run->out > 0) == back) out.push_back(e);
    if (e->kind == EventKind::thread || e->kind == EventKind::rapid) from = to;
  }
  return out;
}

}  // namespace

std::string tap_difference(const CyclePasses& source, const CyclePasses& target, const Tolerances& tolerances) {
  const auto &a = *source.run, &b = *target.run;
  if (!a.comparable || !b.comparable || a.plane != b.plane || a.out * b.out < 0)
    return "the taps lie along axes that can't be compared";
  if (a.radius != b.radius) return "one of the taps cuts a left-hand thread, the other a right-hand one";
  std::string what;
  const auto there = hole_of(source, tolerances, what);
  const auto here = there ? hole_of(target, tolerances, what) : std::nullopt;
  if (!there || !here) return what;
  if (std::fabs(there->u - here->u) > tolerances.length || std::fabs(there->v - here->v) > tolerances.length)
    return "the taps stand at other places";
  if (std::fabs(a.surface - b.surface) > tolerances.length) return "the taps begin at other heights";
  if (std::fabs(there->depth - here->depth) > tolerances.length)
    return fmt::format("the threads are {} and {} mm deep", rounded(there->depth, 4), rounded(here->depth, 4));
  if (std::fabs(there->top - here->top) > tolerances.length)
    return fmt::format("the strokes come back to {} mm above the reference plane, and to {} mm",
                       rounded(-there->top, 4), rounded(-here->top, 4));
  const auto in = strokes_of(source, false);
  for (const bool back : {false, true}) {
    const auto of_source = strokes_of(source, back), of_target = strokes_of(target, back);
    for (const auto* strokes : {&of_source, &of_target}) {
      const auto other = [strokes](const Event* e) { return e->pitch * strokes->front()->pitch < 0; };
      if (std::any_of(strokes->begin(), strokes->end(), other)) return "a tap has strokes of both hands";
    }
    if (of_source.empty()) continue;
    for (const Event* e : of_target) {
      // A tap of one speed leaves the hole as it came in.
      if (back && !in.empty() && stroke_difference(*in.front(), *e, tolerances).empty()) continue;
      if (what = stroke_difference(*of_source.front(), *e, tolerances); !what.empty()) return what;
    }
  }
  if (!close_relative(there->pitch, here->pitch, tolerances.feed_relative))
    return fmt::format("thread pitch {} in the source, {} in the translation", shortest(there->pitch),
                       shortest(here->pitch));
  return {};
}

}  // namespace cnctrans::verifier
