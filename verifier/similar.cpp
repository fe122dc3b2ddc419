#include "verifier/similar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "ir/cycles/turning/left_material.h"
#include "verifier/normalise.h"
#include "verifier/similar_pocket.h"
#include "verifier/similar_tap.h"
#include "verifier/similar_thread.h"
#include "verifier/similar_ways.h"

namespace cnctrans::verifier {

using interpreter::CyclePoint;
using interpreter::CycleRun;
using interpreter::Event;
using interpreter::EventKind;

namespace {

using Point = ir::cycles::RolePoint;
using Line = ir::cycles::RoleLine;
using Frame = ir::cycles::TurnRole;
constexpr double step = ir::cycles::role_step;

Line line_of(const Frame& f, const std::vector<CyclePoint>& points) {
  Line line;
  for (const auto& c : points) line.push_back(f.of(c.x, c.z));
  return line;
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a.p - b.p, a.q - b.q);
}
double distance_to(const Line& line, const Point& t) {
  double best = distance(line.front(), t);
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point &a = line[i - 1], &b = line[i];
    const double dp = b.p - a.p, dq = b.q - a.q, whole = dp * dp + dq * dq;
    const double k = whole > 0 ? std::clamp(((t.p - a.p) * dp + (t.q - a.q) * dq) / whole, 0.0, 1.0) : 0;
    best = std::min(best, distance({a.p + k * dp, a.q + k * dq}, t));
  }
  return best;
}
/// The greatest distance of a point of `a` from `b`, looked at every `step`.
double farthest(const Line& a, const Line& b) {
  double most = distance_to(b, a.front());
  for (std::size_t i = 1; i < a.size(); ++i) {
    const double parts = std::max(1.0, std::ceil(distance(a[i - 1], a[i]) / step));
    for (double k = 1; k <= parts; ++k) {
      const Point t{a[i - 1].p + (a[i].p - a[i - 1].p) * k / parts, a[i - 1].q + (a[i].q - a[i - 1].q) * k / parts};
      most = std::max(most, distance_to(b, t));
    }
  }
  return most;
}
/// The lowest point of the line within `room` of q; nullopt: it is not there.
std::optional<double> height(const Line& line, double q, double room) {
  std::optional<double> low;
  const auto take = [&low](double p) { low = low ? std::min(*low, p) : p; };
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point &a = line[i - 1], &b = line[i];
    const double from = std::max(std::min(a.q, b.q), q - room), to = std::min(std::max(a.q, b.q), q + room);
    if (from > to) continue;
    const double way = b.q - a.q;
    for (const double at : {from, to}) {
      if (std::fabs(way) < 1e-9) {
        take(std::min(a.p, b.p));
      } else {
        take(a.p + (b.p - a.p) * (at - a.q) / way);
      }
    }
  }
  return low;
}

/// A move as points close to each other, by role.
struct Move {
  const Event* event = nullptr;
  Line points;
  bool comp = false;  ///< with radius compensation: the finishing pass
};

Line points_of(const Frame& f, const CyclePoint& from, const Event& e) {
  const ir::cycles::TurnPoint a{from.x, from.z}, b{e.to.value[ir::axis::x], e.to.value[ir::axis::z]};
  if (e.kind == EventKind::arc) return ir::cycles::role_arc(f, a, b, {e.center_v, e.center_u}, !e.cw);
  return ir::cycles::role_straight(f, a, b);
}

std::vector<Move> moves_of(const Frame& f, const CyclePasses& side) {
  std::vector<Move> out;
  CyclePoint at{side.start.value[ir::axis::x], side.start.value[ir::axis::z]};
  bool comp = false;
  for (const Event* e : side.events) {
    if (e->kind == EventKind::comp) comp = e->state != "off";
    if (e->kind != EventKind::rapid && e->kind != EventKind::linear && e->kind != EventKind::arc) continue;
    out.push_back({e, points_of(f, at, *e), comp});
    at = {e->to.value[ir::axis::x], e->to.value[ir::axis::z]};
  }
  return out;
}

class Stock {
 public:
  Stock(const CyclePasses& source, const CyclePasses& target, const Tolerances& tolerances)
      : a_(source), b_(target), t_(tolerances) {}
  double apart = 0;

  std::string difference() {
    const CycleRun &a = *a_.run, &b = *b_.run;
    if (!a.comparable || !b.comparable) return "the frame of a cycle turns or scales its axes";
    if (a.face != b.face || a.out != b.out) return "the passes of the two cycles come from different sides";
    if (a.rough.empty() != b.rough.empty() || a.finish.empty() != b.finish.empty())
      return fmt::format("the cycle {} there, {} here", work(a), work(b));
    if (a.rough.empty() && a.finish.empty()) return "the contour of a cycle is not known";
    const auto& contour = a.rough.empty() ? a.finish : a.rough;
    frame_ = {a.face, a.out, 1};
    frame_.come_from_the_low_end(line_of(frame_, contour));
    for (const bool finish : {false, true}) {
      const std::string what = contours(finish);
      if (!what.empty()) return what;
    }
    const auto there = moves_of(frame_, a_), here = moves_of(frame_, b_);
    top_ = highest(line_of(frame_, contour));
    for (const auto& m : there) {
      if (cuts(*m.event)) top_ = std::max(top_, highest(m.points));
    }
    std::string what = feeds(there, here);
    if (what.empty()) what = below(there, "source");
    if (what.empty()) what = below(here, "translation");
    if (what.empty()) what = material(there, here);
    if (what.empty()) what = infeeds(there, here);
    return what;
  }

 private:
  static std::string work(const CycleRun& run) {
    if (!run.rough.empty()) return run.finish.empty() ? "only roughs" : "roughs and finishes";
    return run.finish.empty() ? "does nothing" : "only finishes";
  }
  [[nodiscard]] Line contour(const CycleRun& run, bool finish) const {
    return line_of(frame_, finish ? run.finish : run.rough);
  }

  std::string contours(bool finish) {
    const Line whole_a = contour(*a_.run, finish), whole_b = contour(*b_.run, finish);
    if (whole_a.empty()) return {};
    const Line a = finish ? whole_a : without_tail(whole_a, whole_b),
               b = finish ? whole_b : without_tail(whole_b, whole_a);
    const double far = std::max(farthest(a, b), farthest(b, a));
    if (far > t_.contour)
      return fmt::format("the contours that the two cycles {} are {} mm apart", finish ? "finish" : "leave",
                         rounded(far, 4));
    apart = std::max(apart, far);
    return {};
  }

  /// A wall that goes on straight out from the highest point of the other contour bounds passes over it, nothing else.
  [[nodiscard]] Line without_tail(const Line& line, const Line& other) const {
    const Point& top = other.front().p > other.back().p ? other.front() : other.back();
    const bool ends = highest(other) <= top.p + t_.contour;
    Line out;
    for (const auto& t : line) {
      const bool over = ends && t.p > top.p + t_.contour && std::fabs(t.q - top.q) <= t_.contour;
      out.push_back(over ? Point{top.p, t.q} : t);
    }
    return out;
  }

  std::string feeds(const std::vector<Move>& there, const std::vector<Move>& here) const {
    const auto plunges = [](const Move& m) {
      const Point &a = m.points.front(), &b = m.points.back();
      return a.p - b.p > std::fabs(a.q - b.q);
    };
    const bool dives =
        std::any_of(there.begin(), there.end(), [&](const Move& m) { return cuts(*m.event) && !m.comp && plunges(m); });
    for (const auto& m : here) {
      if (!cuts(*m.event)) continue;
      const bool any_way = m.comp || (plunges(m) && !dives);
      const bool known = std::any_of(there.begin(), there.end(), [&](const Move& o) {
        return cuts(*o.event) && o.comp == m.comp && (any_way || plunges(o) == plunges(m)) &&
               o.event->feed_mode == m.event->feed_mode &&
               close_relative(o.event->feed, m.event->feed, t_.feed_relative);
      });
      if (!known)
        return fmt::format("a {} of the translation's cycle has the feed {} ({}), none of the source's has",
                           plunges(m) && !m.comp ? "plunge" : "pass", shortest(m.event->feed),
                           ir::name(m.event->feed_mode));
    }
    return {};
  }

  /// The passes straight along the part, in the order in which they are cut: how far each lies below those before it.
  /// `first`: above the first one at its place; nullopt: not counted.
  template <class First>
  static double deepest(const std::vector<Move>& moves, const First& first) {
    struct Level {
      double p, low, high;
    };
    std::vector<Level> cut;
    double most = 0;
    for (const auto& m : moves) {
      const Point &a = m.points.front(), &b = m.points.back();
      constexpr double least = 0.1;  // mm
      if (m.comp || m.event->kind != EventKind::linear || std::fabs(a.p - b.p) > 1e-4 || std::fabs(a.q - b.q) < least)
        continue;
      const Level now{a.p, std::min(a.q, b.q), std::max(a.q, b.q)};
      std::optional<double> before;
      for (const auto& c : cut) {
        const bool over = std::min(c.high, now.high) - std::max(c.low, now.low) > (now.high - now.low) / 2;
        if (over) before = before ? std::min(*before, c.p) : c.p;
      }
      if (!before) before = first(now.low, now.high);
      if (before) most = std::max(most, *before - now.p);
      cut.push_back(now);
    }
    return most;
  }
  [[nodiscard]] std::string infeeds(const std::vector<Move>& there, const std::vector<Move>& here) const {
    const double most = deepest(there, [](double, double) { return std::optional<double>(); });
    // The material begins where the source cuts first.
    const double deep = deepest(here, [&](double low, double high) -> std::optional<double> {
      std::optional<double> top;
      for (const auto& m : there) {
        if (!cuts(*m.event) || m.comp) continue;
        for (const auto& p : m.points) {
          if (p.q > low && p.q < high) top = top ? std::max(*top, p.p) : p.p;
        }
      }
      return top;
    });
    if (most == 0 || !too_deep(deep, most)) return {};
    return fmt::format("a pass of the translation cuts {} mm deep, none of the source's more than {}", rounded(deep, 3),
                       rounded(most, 3));
  }

  /// No pass, and no rapid move, under the contour that is to stay.
  std::string below(const std::vector<Move>& moves, std::string_view side) const {
    const CycleRun& run = *a_.run;  // the contours agree
    const Line rough = contour(run, false), finish = contour(run, true);
    bool finished = rough.empty();
    for (const auto& m : moves) {
      finished = finished || (m.comp && !finish.empty());
      const Line& bound = (cuts(*m.event) ? (m.comp || rough.empty()) : finished) && !finish.empty() ? finish : rough;
      double end = bound.front().q;
      for (const auto& p : bound) end = std::min(end, p.q);
      for (const auto& p : m.points) {
        const auto floor = height(bound, p.q, t_.contour);
        const bool beyond = p.q < end - t_.contour && p.p < top_ + t_.contour;
        if (!beyond && (!floor || p.p >= *floor - t_.contour)) continue;
        return fmt::format("a {} of the cycle in the {} goes {} the contour, at {}", interpreter::name(m.event->kind),
                           side, beyond ? "beyond the end of" : "below", said(p));
      }
    }
    return {};
  }
  static double highest(const Line& line) {
    double p = line.front().p;
    for (const auto& t : line) p = std::max(p, t.p);
    return p;
  }
  [[nodiscard]] std::string said(const Point& t) const {
    const double u = frame_.out * t.p, v = frame_.back * t.q;
    return fmt::format("X{} Z{}", rounded(frame_.face ? v : u, 3), rounded(frame_.face ? u : v, 3));
  }

  /// What the source's passes cut is taken for the blank.
  std::string material(const std::vector<Move>& there, const std::vector<Move>& here) const {
    const auto by_role = [](const std::vector<Move>& moves) {
      std::vector<ir::cycles::RoleMove> out;
      out.reserve(moves.size());
      for (const auto& m : moves) out.push_back({m.points, cuts(*m.event), m.comp});
      return out;
    };
    const auto fault =
        ir::cycles::material_fault(contour(*a_.run, a_.run->rough.empty()), by_role(there), by_role(here), t_.contour);
    if (!fault) return {};
    return (fault->in_rapid ? "a rapid move of the translation's cycle goes through material that is not cut yet, at "
                            : "the translation's cycle leaves more than the source's, at ") +
           said(fault->at);
  }

  const CyclePasses &a_, &b_;
  const Tolerances& t_;
  Frame frame_;
  double top_ = 0;  ///< the highest point that the source's passes come to
};

/// By what both leave.
std::string part_difference(const CyclePasses& source, const CyclePasses& target, const Tolerances& tolerances,
                            double& max_length) {
  if (source.run->family == "tap") return tap_difference(source, target, tolerances);
  if (source.run->family == "pocket") return pocket_difference(source, target, tolerances, max_length);
  if (source.run->family == "thread") return thread_difference(source, target, tolerances, max_length);
  if (source.run->family != "stock") return "cycles of this kind are compared move by move";
  Stock stock(source, target, tolerances);
  std::string found = stock.difference();
  max_length = std::max(max_length, stock.apart);
  return found;
}

}  // namespace

std::string similar_difference(const CyclePasses& source, const CyclePasses& target, const Tolerances& tolerances,
                               double& max_length) {
  if (source.run->family != target.run->family) return "the cycles are of different kinds";
  std::string what = beside_the_moves(source, target);
  const bool turned = source.run->family == "stock" || source.run->family == "thread";
  if (what.empty()) what = part_difference(source, target, tolerances, max_length);
  if (what.empty() && !turned) what = crossing_difference(source, target);
  return what.empty() ? way_difference(source, target, turned) : what;
}

}  // namespace cnctrans::verifier
