#include "verifier/cycle_pairs.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "verifier/normalise.h"

namespace cnctrans::verifier {

using interpreter::CycleRun;
using interpreter::Event;
using interpreter::EventKind;
using interpreter::Position;

namespace {

constexpr std::size_t most_moves_around = 4;  ///< rapid moves that lead to the translation's cycle, or away from it

bool together(const Position& a, const Position& b, double by) {
  const std::uint32_t axes = a.known & b.known;
  for (std::size_t k = 0; k < a.value.size(); ++k) {
    if ((axes >> k & 1U) != 0 && std::fabs(a.value[k] - b.value[k]) > by) return false;
  }
  return true;
}

std::string comp_after(const std::vector<const Event*>& events) {
  std::string state;
  for (const Event* e : events) {
    if (e->kind == EventKind::comp) state = e->state;
  }
  return state;
}

/// Sense and speed; empty: no command.
std::string spindle_after(const std::vector<const Event*>& events) {
  std::string said;
  for (const Event* e : events) {
    if (e->kind == EventKind::spindle) said = e->state + (e->state == "off" ? "" : " " + shortest(e->value));
  }
  return said;
}

/// Each axis stands with the tool offset, or without it, as it does at some move of the source's cycle.
std::string offset_difference(const std::vector<const Event*>& source, const std::vector<const Event*>& target,
                              bool switches) {
  std::uint32_t with = 0, without = 0;
  for (const Event* e : source) {
    if (!is_motion(e->kind)) continue;
    const std::uint32_t known = known_of_source(*e, switches);
    with |= known & e->offset.with;
    without |= known & ~e->offset.with;
  }
  for (const Event* e : target) {
    if (!is_motion(e->kind)) continue;
    const std::uint32_t known = e->offset.known & (with | without);
    if ((known & ((e->offset.with & ~with) | (~e->offset.with & ~without))) != 0)
      return "the tool offset is in force on one side only";
  }
  return {};
}

}  // namespace

const CycleRun* CyclePairs::run_at(std::size_t at, bool source) const {
  const auto* runs = source ? options_.source_cycles : options_.target_cycles;
  const auto& events = source ? a_ : b_;
  if (runs == nullptr || at >= events.size()) return nullptr;
  const std::size_t n = number(events[at], source);
  const auto it = std::upper_bound(runs->begin(), runs->end(), n,
                                   [](std::size_t value, const CycleRun& run) { return value < run.last; });
  return it != runs->end() && it->first <= n ? &*it : nullptr;
}

const CycleRun* CyclePairs::begins(std::size_t i) const {
  const auto* run = run_at(i, true);
  return run != nullptr && (i == 0 || run_at(i - 1, true) != run) ? run : nullptr;
}

bool CyclePairs::about(const CycleRun& run, const PairPlace& start, const PairPlace& now) const {
  if (now.i < a_.size() && now.i > 0 && number(a_[now.i - 1], true) >= run.last) {
    // The source has left its cycle: the translation may still be in its own, which began where the source's did.
    const auto* other = run_at(now.j, false);
    return other != nullptr && now.j > start.j && run_at(now.j - 1, false) == other;
  }
  return true;
}

const CycleRun* CyclePairs::next_run(std::size_t k, bool source) const {
  const auto& events = source ? a_ : b_;
  for (std::size_t n = 0; k < events.size() && n <= most_moves_around; ++k) {
    if (const auto* found = run_at(k, source); found != nullptr) return found;
    if (events[k]->kind == EventKind::rapid)
      ++n;
    else if (is_barrier(events[k]->kind))
      return nullptr;
  }
  return nullptr;
}

CyclePairs::Next CyclePairs::next_cycle(const CyclePasses& source, const CyclePasses& target,
                                        const PairPlace& at) const {
  const bool tap = target.run->family == "tap";
  if (target.run->family != "pocket" && !tap) return Next::elsewhere;
  const auto axes = ir::plane_axes(target.run->plane);
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  bool any = false;
  const auto cuts = [](const Event* e) {
    return e->kind == EventKind::linear || e->kind == EventKind::arc || e->kind == EventKind::thread;
  };
  const auto widen = [&](double u, double v, double by) {
    u0 = any ? std::min(u0, u - by) : u - by;
    u1 = any ? std::max(u1, u + by) : u + by;
    v0 = any ? std::min(v0, v - by) : v - by;
    v1 = any ? std::max(v1, v + by) : v + by;
    any = true;
  };
  for (const Event* e : source.events) {
    if (!cuts(e)) continue;
    const double u = e->to.value[axes.u], v = e->to.value[axes.v];
    widen(u, v, 0);
    // The rounds of a circular pocket begin and end in one place: their circles say how wide it is.
    if (e->kind == EventKind::arc && e->plane == target.run->plane)
      widen(e->center_u, e->center_v, std::hypot(u - e->center_u, v - e->center_v));
  }
  /// The next cycle of the side machines the same pocket, or one of the same slots.
  const auto here = [&](std::size_t k, bool of_source) {
    const auto* next = next_run(k, of_source);
    if (!any || next == nullptr || next == target.run || next->family != target.run->family) return false;
    const auto& events = of_source ? a_ : b_;
    while (k < events.size() && (number(events[k], of_source) < next->first || !cuts(events[k]))) ++k;
    if (k == events.size()) return false;
    const double u = events[k]->to.value[axes.u], v = events[k]->to.value[axes.v];
    const double by = tap ? options_.tolerances.length : target.run->radius;
    return u > u0 - by && u < u1 + by && v > v0 - by && v < v1 + by;
  };
  if (!here(at.j, false)) return Next::elsewhere;
  return here(at.i, true) ? Next::here_of_both : Next::here;
}

std::optional<PairPlace> CyclePairs::skip(const CycleRun& run, const PairPlace& start, double& max_length,
                                          std::string& what) const {
  PairPlace at = start;
  CyclePasses source{&run, start.from_a, {}}, target{nullptr, start.from_b, {}};
  const auto rapid = [this](std::size_t j) { return j < b_.size() && b_[j]->kind == EventKind::rapid; };
  // The way to the translation's cycle.
  std::size_t first = at.j;
  while (run_at(first, false) == nullptr && rapid(first) && first - at.j < most_moves_around) ++first;
  target.run = run_at(first, false);
  if (target.run == nullptr) return std::nullopt;
  if (first > 0 && run_at(first - 1, false) == target.run) return std::nullopt;  // in the middle of it
  const auto take = [](const Event* e, CyclePasses& side, Position& from, std::size_t& k) {
    side.events.push_back(e);
    if (is_motion(e->kind)) from = e->to;
    ++k;
  };
  while (at.i < a_.size() && number(a_[at.i], true) < run.last) take(a_[at.i], source, at.from_a, at.i);
  while (at.j < b_.size() && (at.j < first || number(b_[at.j], false) < target.run->last))
    take(b_[at.j], target, at.from_b, at.j);
  const double by = options_.tolerances.length;
  std::uint64_t last_of_target = target.run->last;
  // Roughing and finishing, or the pecks of a tap, are cycles of their own. Where the source machines the place once
  // more, the translation has its next cycle as soon as this one is complete.
  for (Next next = next_cycle(source, target, at); next != Next::elsewhere; next = next_cycle(source, target, at)) {
    double length = max_length;
    const bool complete = similar_difference(source, target, options_.tolerances, length).empty();
    if (complete && (next == Next::here_of_both || target.run->family == "tap")) break;
    while (run_at(at.j, false) == nullptr) take(b_[at.j], target, at.from_b, at.j);
    const auto* second = run_at(at.j, false);
    while (at.j < b_.size() && number(b_[at.j], false) < second->last) take(b_[at.j], target, at.from_b, at.j);
    last_of_target = second->last;
  }
  for (std::size_t k = 0; k < most_moves_around && !together(at.from_a, at.from_b, by); ++k) {
    if (!rapid(at.j) || run_at(at.j, false) != nullptr) break;
    take(b_[at.j], target, at.from_b, at.j);
  }
  // The sense that a tap leaves stands behind the moves that follow it.
  const auto spindle = [&](bool of_source, std::size_t k, std::uint64_t last) {
    const auto& events = of_source ? a_ : b_;
    return run.family == "tap" && k < events.size() && events[k]->kind == EventKind::spindle &&
           number(events[k], of_source) < last;
  };
  while (spindle(true, at.i, run.last)) take(a_[at.i], source, at.from_a, at.i);
  while (spindle(false, at.j, last_of_target)) take(b_[at.j], target, at.from_b, at.j);
  // A speed that the source's tap leaves is said behind the target's.
  while (run.family == "tap" && at.j < b_.size() && b_[at.j]->kind == EventKind::spindle &&
         spindle_after(source.events) != spindle_after(target.events))
    take(b_[at.j], target, at.from_b, at.j);
  what = offset_difference(source.events, target.events, options_.switches_length);
  if (what.empty()) what = similar_difference(source, target, options_.tolerances, max_length);
  if (!what.empty()) return std::nullopt;
  if (!together(at.from_a, at.from_b, by)) {
    what = "the tool stands elsewhere behind the cycle";
    return std::nullopt;
  }
  if (run.family == "tap" && spindle_after(source.events) != spindle_after(target.events)) {
    what = "the spindle stands otherwise behind the tap";
    return std::nullopt;
  }
  if (comp_after(source.events) != comp_after(target.events)) {
    what = "radius compensation differs behind the cycle";
    return std::nullopt;
  }
  return at;
}

}  // namespace cnctrans::verifier
