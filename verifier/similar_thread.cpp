#include "verifier/similar_thread.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "base/text.h"
#include "verifier/commands.h"
#include "verifier/similar_ways.h"

namespace cnctrans::verifier {

using interpreter::Event;
using interpreter::EventKind;

namespace {

struct ThreadPoint {
  double p = 0, q = 0;  ///< across and along the thread
};
struct Pass {
  ThreadPoint from, to;
  const Event* event = nullptr;
};
struct Way {
  ThreadPoint from, to;
};

/// The passes of each start of the thread, by its angle in thousandths of a degree, and the rapid moves.
struct Thread {
  std::map<long, std::vector<Pass>> starts;
  std::vector<Way> rapids;
};

Thread thread_of(const CyclePasses& side, bool face) {
  Thread out;
  const auto role = [face](const interpreter::Position& p) {
    const double x = p.value[ir::axis::x], z = p.value[ir::axis::z];
    return face ? ThreadPoint{z, x} : ThreadPoint{x, z};
  };
  ThreadPoint at = role(side.start);
  for (const Event* e : side.events) {
    if (e->kind != EventKind::thread && e->kind != EventKind::rapid) continue;
    const ThreadPoint to = role(e->to);
    if (e->kind == EventKind::rapid) {
      out.rapids.push_back({at, to});
    } else {
      double angle = std::fmod(e->start_angle, 360);
      if (angle < 0) angle += 360;
      out.starts[std::lround(angle * 1000) % 360'000].push_back({at, to, e});
    }
    at = to;
  }
  return out;
}

/// Main axis of the first pass.
bool along_x(const CyclePasses& side) {
  interpreter::Position at = side.start;
  for (const Event* e : side.events) {
    if (e->kind == EventKind::thread)
      return std::fabs(e->to.value[ir::axis::x] - at.value[ir::axis::x]) >
             std::fabs(e->to.value[ir::axis::z] - at.value[ir::axis::z]);
    if (e->kind == EventKind::rapid) at = e->to;
  }
  return false;
}

double on_line(const Pass& pass, double q) {
  const double way = pass.to.q - pass.from.q;
  return std::fabs(way) < 1e-9 ? pass.to.p : pass.from.p + (pass.to.p - pass.from.p) * (q - pass.from.q) / way;
}

/// How far along the thread the passes begin from the last one, per depth that is left: tangent of the flank's angle.
/// Infinite: no pass tells.
template <class Depth>
double slope_of(const std::vector<Pass>& passes, const Depth& depth) {
  constexpr double least = 0.02;  // mm
  double most = -1;
  for (const auto& p : passes) {
    const double left = depth(p);
    if (left > least) most = std::max(most, std::fabs(p.from.q - passes.back().from.q) / left);
  }
  return most < 0 ? std::numeric_limits<double>::infinity() : most;
}

}  // namespace

std::string thread_difference(const CyclePasses& source, const CyclePasses& target, const Tolerances& t,
                              double& max_length) {
  const bool face = along_x(source);
  if (face != along_x(target)) return "the threads run along different axes";
  const Thread there = thread_of(source, face), here = thread_of(target, face);
  if (there.starts.empty() || here.starts.empty()) return "a threading cycle cuts no thread";
  if (there.starts.size() != here.starts.size())
    return fmt::format("the thread has {} starts in the source, {} in the translation", there.starts.size(),
                       here.starts.size());
  const Pass& any = there.starts.begin()->second.back();
  double out = 0;
  for (const auto& r : there.rapids) out += r.to.p - on_line(any, r.to.q);
  out = out < 0 ? -1 : 1;
  // The lowest height over the finished thread at which the tool goes along it, and the greatest infeed.
  const auto clear = [&](const Thread& side) {
    double low = std::numeric_limits<double>::infinity();
    for (const auto& r : side.rapids) {
      const double from = std::min(any.from.q, any.to.q), to = std::max(any.from.q, any.to.q);
      const bool over = std::max(r.from.q, r.to.q) > from + t.contour && std::min(r.from.q, r.to.q) < to - t.contour;
      if (!over || std::fabs(r.from.q - r.to.q) <= (to - from) / 2) continue;
      for (const ThreadPoint& p : {r.from, r.to}) low = std::min(low, out * (p.p - on_line(any, p.q)));
    }
    return low;
  };
  for (const auto& [angle, passes] : there.starts) {
    auto it = here.starts.find(angle);
    for (long by : {-1L, 1L}) {
      if (it == here.starts.end()) it = here.starts.find((angle + by + 360'000) % 360'000);
    }
    if (it == here.starts.end())
      return fmt::format("the thread that starts at {} degrees is missing in the translation", double(angle) / 1000);
    const Pass &a = passes.back(), &b = it->second.back();
    const double apart = std::max({std::fabs(a.from.p - b.from.p), std::fabs(a.from.q - b.from.q),
                                   std::fabs(a.to.p - b.to.p), std::fabs(a.to.q - b.to.q)});
    if (apart > t.contour)
      return fmt::format("the last pass of the thread is {} mm apart from the source's", rounded(apart, 4));
    max_length = std::max(max_length, apart);
    const auto same_pitch = [&](const Event& u, const Event& v) {
      return close_relative(u.pitch, v.pitch, t.feed_relative) && std::fabs(u.pitch_change - v.pitch_change) <= 1e-6;
    };
    double before = 0, infeed_there = 0, infeed_here = 0, top_there = 0;
    const auto depth = [&](const Pass& p) { return out * (p.to.p - on_line(a, p.to.q)); };
    top_there = depth(passes.front());
    before = top_there;
    for (const auto& p : passes) {
      infeed_there = std::max(infeed_there, before - depth(p));
      before = depth(p);
    }
    const double flank = slope_of(passes, depth);
    before = top_there;
    for (const auto& p : it->second) {
      if (std::fabs(p.from.q - b.from.q) > flank * std::max(1e-9, depth(p)) + t.contour)
        return fmt::format(
            "a pass of the translation begins {} mm along the thread from the last one, outside of its V",
            rounded(std::fabs(p.from.q - b.from.q), 3));
      if (!same_pitch(*a.event, *p.event))
        return fmt::format("a pass of the thread has the pitch {}, in the source {}", shortest(p.event->pitch),
                           shortest(a.event->pitch));
      if (auto what = stroke_difference(*a.event, *p.event, t); !what.empty()) return what;
      if (depth(p) < -t.contour || out * (p.from.p - on_line(a, p.from.q)) < -t.contour)
        return "a pass of the translation goes below the thread";
      if (std::fabs(p.to.q - a.to.q) > t.contour) return "a pass of the translation ends elsewhere along the thread";
      infeed_here = std::max(infeed_here, before - depth(p));
      before = depth(p);
    }
    // The first infeed counts from the first pass of the source; the others may be a little deeper by another law.
    if (too_deep(infeed_here, std::max(infeed_there, top_there / 4)))
      return fmt::format("a pass of the translation cuts {} mm deep, none of the source's more than {}",
                         rounded(infeed_here, 3), rounded(infeed_there, 3));
  }
  if (clear(here) < clear(there) - t.contour)
    return "a rapid move of the translation comes closer to the thread than the source's";
  return {};
}

}  // namespace cnctrans::verifier
