#include "verifier/similar_pocket.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "base/text.h"
#include "verifier/normalise.h"
#include "verifier/similar_ways.h"

namespace cnctrans::verifier {

using interpreter::CycleRun;
using interpreter::Event;
using interpreter::EventKind;

namespace {

constexpr std::size_t directions = 720;  ///< in which the walls are looked at
constexpr std::size_t cells = 240;       ///< along the longer side, in which the floor is looked at
constexpr double sagitta = 2e-4;         ///< of the chords that stand for an arc, mm
constexpr double full = 6.283185307179586;

/// Middle of the tool: in the plane, and over the floor (upward from the material).
struct PocketPoint {
  double u = 0, v = 0, w = 0;
};
struct PocketMove {
  const Event* event = nullptr;
  std::vector<PocketPoint> points;
};

/// The directions, as points on a circle of radius 1.
const std::array<PocketPoint, directions>& ways_around() {
  static const auto ways = [] {
    std::array<PocketPoint, directions> out;
    for (std::size_t d = 0; d < directions; ++d) {
      const double angle = full * static_cast<double>(d) / directions;
      out[d] = {std::cos(angle), std::sin(angle), 0};
    }
    return out;
  }();
  return ways;
}

/// What the tool sweeps in the plane lies in it.
struct Extent {
  double u0 = 0, v0 = 0, u1 = 0, v1 = 0;
  Extent(const PocketMove& m, double r) {
    u0 = u1 = m.points.front().u;
    v0 = v1 = m.points.front().v;
    for (const auto& p : m.points) join({p.u, p.v, p.u, p.v});
    join({u0 - r, v0 - r, u1 + r, v1 + r});
  }
  Extent(double low_u, double low_v, double high_u, double high_v) : u0(low_u), v0(low_v), u1(high_u), v1(high_v) {}
  [[nodiscard]] bool meets(const Extent& o) const { return u0 <= o.u1 && o.u0 <= u1 && v0 <= o.v1 && o.v0 <= v1; }
  void join(const Extent& o) {
    u0 = std::min(u0, o.u0);
    v0 = std::min(v0, o.v0);
    u1 = std::max(u1, o.u1);
    v1 = std::max(v1, o.v1);
  }
};

class Side {
 public:
  Side(const CyclePasses& passes, const CycleRun& run) : run_(run), axes_(ir::plane_axes(run.plane)) {
    PocketPoint at = of(passes.start);
    for (const Event* e : passes.events) {
      if (e->kind != EventKind::rapid && !cuts(*e)) continue;
      PocketMove m;
      m.event = e;
      m.points.push_back(at);
      const PocketPoint to = of(e->to);
      if (e->kind == EventKind::arc && e->plane == run.plane) arc(m, at, to, *e);
      m.points.push_back(to);
      at = to;
      if (cuts(*e)) lowest_ = std::min(lowest_, to.w);
      moves_.push_back(std::move(m));
    }
  }
  [[nodiscard]] const std::vector<PocketMove>& moves() const { return moves_; }
  [[nodiscard]] double lowest() const { return lowest_; }
  [[nodiscard]] double radius() const { return run_.radius; }
  [[nodiscard]] double surface() const { return run_.surface * run_.out; }

  /// The places that it cuts, apart from each other: one for a pocket, one for each of several slots.
  [[nodiscard]] std::vector<Extent> places() const {
    std::vector<Extent> out;
    for (const auto& m : moves_) {
      if (!cuts(*m.event)) continue;
      Extent box(m, radius());
      for (auto it = out.begin(); it != out.end();) {
        if (!it->meets(box)) {
          ++it;
          continue;
        }
        box.join(*it);
        out.erase(it);
        it = out.begin();  // it may meet others now
      }
      out.push_back(box);
    }
    return out;
  }
  /// How far the part is cut there in each direction; `floor`: at the floor only.
  [[nodiscard]] std::array<double, directions> reach(const Extent& place, bool floor, double room) const {
    std::array<double, directions> out{};
    out.fill(-std::numeric_limits<double>::infinity());
    const auto& toward = ways_around();
    for (const auto& m : moves_) {
      if (!cuts(*m.event) || !place.meets(Extent(m, 0))) continue;
      for (std::size_t k = 1; k < m.points.size(); ++k) {
        for (const PocketPoint& p : {m.points[k - 1], m.points[k]}) {
          if (floor ? p.w > lowest_ + room : p.w > surface() - room) continue;
          for (std::size_t d = 0; d < directions; ++d)
            out[d] = std::max(out[d], p.u * toward[d].u + p.v * toward[d].v + radius());
        }
      }
    }
    return out;
  }

 private:
  [[nodiscard]] PocketPoint of(const interpreter::Position& p) const {
    return {p.value[axes_.u], p.value[axes_.v], p.value[axes_.w] * run_.out};
  }
  void arc(PocketMove& m, const PocketPoint& from, const PocketPoint& to, const Event& e) const {
    const double r = std::hypot(from.u - e.center_u, from.v - e.center_v);
    const double start = std::atan2(from.v - e.center_v, from.u - e.center_u);
    double sweep = std::atan2(to.v - e.center_v, to.u - e.center_u) - start;
    if (!e.cw && sweep <= 1e-9) sweep += full;
    if (e.cw && sweep >= -1e-9) sweep -= full;
    sweep += (e.cw ? -full : full) * e.turns;
    const double step = r > sagitta ? 2 * std::acos(1 - sagitta / r) : full;
    const double n = std::min(std::ceil(std::fabs(sweep) / step), 1e5);
    for (double k = 1; k < n; ++k) {
      const double a = start + sweep * k / n;
      m.points.push_back(
          {e.center_u + r * std::cos(a), e.center_v + r * std::sin(a), from.w + (to.w - from.w) * k / n});
    }
  }
  const CycleRun& run_;
  ir::PlaneAxes axes_;
  std::vector<PocketMove> moves_;
  double lowest_ = std::numeric_limits<double>::infinity();
};

/// The material in cells, each as high as it still stands.
class Grid {
 public:
  Grid(double u0, double v0, double u1, double v1, double top) : u_(u0), v_(v0) {
    size_ = std::max({u1 - u0, v1 - v0, 1e-3}) / static_cast<double>(cells);
    nu_ = static_cast<std::size_t>(std::ceil((u1 - u0) / size_)) + 1;
    nv_ = static_cast<std::size_t>(std::ceil((v1 - v0) / size_)) + 1;
    height_.assign(nu_ * nv_, top);
  }
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] std::size_t count() const { return height_.size(); }
  [[nodiscard]] double at(std::size_t k) const { return height_[k]; }
  [[nodiscard]] PocketPoint place(std::size_t k) const {
    return {u_ + size_ * static_cast<double>(k % nu_), v_ + size_ * static_cast<double>(k / nu_), 0};
  }
  void cut(const PocketMove& m, double r) {
    each_step(m, [&](const PocketPoint& a, const PocketPoint& b, double /*low*/, double high) {
      along(a, b, r, [high](double& h) { h = std::min(h, high); });
    });
  }
  /// Some cell under the way stands higher than the tool comes.
  bool hits(const PocketMove& m, double r, double room) {
    bool hit = false;
    each_step(m, [&](const PocketPoint& a, const PocketPoint& b, double low, double /*high*/) {
      if (!hit) along(a, b, r, [&](const double& h) { hit = hit || h > low + room; });
    });
    return hit;
  }

 private:
  /// Calls `f` with the steps of the move and the heights between which each lies. Chords of an arc that are shorter
  /// than half a cell are taken together.
  template <class F>
  void each_step(const PocketMove& m, F f) const {
    const PocketPoint* from = &m.points.front();
    double low = from->w, high = from->w;
    for (std::size_t k = 1; k < m.points.size(); ++k) {
      const PocketPoint& to = m.points[k];
      low = std::min(low, to.w);
      high = std::max(high, to.w);
      if (k + 1 < m.points.size() && std::hypot(to.u - from->u, to.v - from->v) < size_ / 2) continue;
      f(*from, to, low, high);
      from = &to;
      low = high = to.w;
    }
  }
  /// Calls `f` with every cell within `r` of the way from a to b: row by row, since they lie side by side.
  template <class F>
  void along(const PocketPoint& a, const PocketPoint& b, double r, F f) {
    if (r <= 0) return;
    const auto first = [](double from, double by) {
      return static_cast<std::ptrdiff_t>(std::max(0.0, std::ceil(from / by)));
    };
    const auto last = [](double to, double by, std::size_t n) {
      return static_cast<std::ptrdiff_t>(std::min(std::floor(to / by), static_cast<double>(n) - 1));
    };
    const double du = b.u - a.u, dv = b.v - a.v, length = std::hypot(du, dv);
    const PocketPoint aside{length > 0 ? -dv / length * r : 0, length > 0 ? du / length * r : 0, 0};
    const std::ptrdiff_t end = last(std::max(a.v, b.v) + r - v_, size_, nv_);
    for (std::ptrdiff_t j = first(std::min(a.v, b.v) - r - v_, size_); j <= end; ++j) {
      const double v = v_ + size_ * static_cast<double>(j);
      double from = std::numeric_limits<double>::infinity(), to = -from;
      const auto take = [&](double u) { from = std::min(from, u), to = std::max(to, u); };
      for (const PocketPoint* p : {&a, &b}) {  // the tool at both ends
        const double square = r * r - (v - p->v) * (v - p->v);
        if (square < 0) continue;
        take(p->u - std::sqrt(square));
        take(p->u + std::sqrt(square));
      }
      for (const double side : {-1.0, 1.0}) {  // the walls that it leaves between them
        const double k = dv != 0 ? (v - a.v - side * aside.v) / dv : -1;
        if (k >= 0 && k <= 1) take(a.u + side * aside.u + k * du);
      }
      if (from > to) continue;
      const auto row = height_.begin() + j * static_cast<std::ptrdiff_t>(nu_);
      for (std::ptrdiff_t i = first(from - u_, size_), in = last(to - u_, size_, nu_); i <= in; ++i) f(row[i]);
    }
  }

  double u_, v_, size_ = 1;
  std::size_t nu_ = 0, nv_ = 0;
  std::vector<double> height_;
};

class Pockets {
 public:
  Pockets(const CyclePasses& source, const CyclePasses& target, const Tolerances& tolerances)
      : a_(source, *source.run), b_(target, *target.run), places_(a_.places()), t_(tolerances) {}
  double apart = 0;

  std::string difference() {
    if (std::fabs(a_.lowest() - b_.lowest()) > t_.contour)
      return fmt::format("the floors of the two pockets are {} mm apart", rounded(a_.lowest() - b_.lowest(), 4));
    if (std::fabs(a_.surface() - b_.surface()) > t_.contour) return "the two pockets begin at other heights";
    std::string what = walls(true);
    if (what.empty()) what = walls(false);
    if (what.empty()) what = elsewhere();
    if (what.empty()) what = feeds();
    if (what.empty()) what = material();
    if (what.empty()) what = infeeds();
    if (what.empty() && begin(b_) < a_.surface() + t_.contour && begin(a_) > a_.surface() + t_.contour)
      what = "a rapid move of the translation's cycle comes down to the material";
    return what;
  }

 private:
  /// The place that the move cuts; null: none of the source's.
  [[nodiscard]] const Extent* place_of(const PocketMove& m) const {
    const Extent box(m, 0);
    const auto it = std::find_if(places_.begin(), places_.end(), [&box](const Extent& p) { return p.meets(box); });
    return it == places_.end() ? nullptr : &*it;
  }
  [[nodiscard]] std::string elsewhere() const {
    for (const auto& m : b_.moves()) {
      if (cuts(*m.event) && place_of(m) == nullptr)
        return "the translation's cycle cuts where the source's does not, at " + said(m);
    }
    return {};
  }
  std::string walls(bool floor) {
    double most = 0;
    for (const Extent& place : places_) {
      const auto there = a_.reach(place, floor, t_.contour), here = b_.reach(place, floor, t_.contour);
      for (std::size_t d = 0; d < directions; ++d) {
        if (std::isinf(there[d]) != std::isinf(here[d])) return "one of the two pockets has no walls";
        if (!std::isinf(there[d])) most = std::max(most, std::fabs(there[d] - here[d]));
      }
    }
    if (most > t_.contour) return fmt::format("the walls of the two pockets are {} mm apart", rounded(most, 4));
    apart = std::max(apart, most);
    return {};
  }
  [[nodiscard]] bool goes_down(const PocketMove& m) const {
    const PocketPoint &from = m.points.front(), &to = m.points.back();
    return to.w < from.w && std::hypot(to.u - from.u, to.v - from.v) <= t_.contour;
  }
  /// What a cut is for: straight down, in the plane along the walls that are to stay, elsewhere in the plane, or both
  /// at once (a ramp).
  enum class Role { plunge, wall, plane, ramp };
  [[nodiscard]] Role role_of(const PocketMove& m, const std::array<double, directions>& walls) const {
    if (goes_down(m)) return Role::plunge;
    if (std::fabs(m.points.back().w - m.points.front().w) > t_.contour) return Role::ramp;
    // All along a wall: the middle of the way, too.
    const PocketPoint &a = m.points.front(), &b = m.points.back(), &c = m.points[m.points.size() / 2];
    const PocketPoint middle = m.points.size() > 2 ? c : PocketPoint{(a.u + b.u) / 2, (a.v + b.v) / 2, a.w};
    for (std::size_t d = 0; d < directions; ++d) {
      const PocketPoint& toward = ways_around()[d];
      const double far = middle.u * toward.u + middle.v * toward.v + a_.radius();
      if (far > walls[d] - t_.contour) return Role::wall;
    }
    return Role::plane;
  }
  [[nodiscard]] std::string feeds() const {
    std::vector<std::array<double, directions>> walls;
    for (const Extent& place : places_) walls.push_back(a_.reach(place, false, t_.contour));
    const auto walls_at = [&](const PocketMove& m) -> const auto& {
      return walls[place_of(m) - places_.data()];
    };
    std::set<Role> roles;
    std::vector<std::pair<Role, const Event*>> there;
    for (const auto& m : a_.moves()) {
      if (!cuts(*m.event)) continue;
      there.emplace_back(role_of(m, walls_at(m)), m.event);
      roles.insert(there.back().first);
    }
    const bool dives = std::any_of(a_.moves().begin(), a_.moves().end(), [this](const PocketMove& m) {
      return !cuts(*m.event) && goes_down(m) && m.points.back().w < a_.surface() - t_.contour;
    });
    for (const auto& m : b_.moves()) {
      if (!cuts(*m.event)) continue;
      const Role role = role_of(m, walls_at(m));
      if (dives && role == Role::plunge) continue;  // at feed where the source goes down in rapid
      const bool known = std::any_of(there.begin(), there.end(), [&](const auto& o) {
        return (o.first == role || roles.count(role) == 0) && o.second->feed_mode == m.event->feed_mode &&
               close_relative(o.second->feed, m.event->feed, t_.feed_relative);
      });
      if (!known)
        return fmt::format("a {} of the translation's cycle has the feed {} ({}), none of the source's has",
                           role == Role::plunge ? "plunge"
                           : role == Role::wall ? "pass along the wall"
                                                : "pass",
                           shortest(m.event->feed), ir::name(m.event->feed_mode));
    }
    return {};
  }
  /// How far below the ones before it the tool cuts in a plane.
  [[nodiscard]] double infeed(const Side& side) const {
    double lowest = side.surface(), most = 0;
    for (const auto& m : side.moves()) {
      const double from = m.points.front().w, to = m.points.back().w;
      if (!cuts(*m.event) || std::fabs(from - to) > t_.contour || to >= lowest) continue;
      most = std::max(most, lowest - to);
      lowest = to;
    }
    return most;
  }
  /// Height from which the tool cuts first.
  static double begin(const Side& side) {
    for (const auto& m : side.moves()) {
      if (cuts(*m.event)) return m.points.front().w;
    }
    return side.surface();
  }
  [[nodiscard]] std::string infeeds() const {
    const double there = infeed(a_), here = infeed(b_);
    if (!too_deep(here, there)) return {};
    return fmt::format("a pass of the translation cuts {} mm deep, none of the source's more than {}", rounded(here, 3),
                       rounded(there, 3));
  }
  /// Both cut the same cells down to the floor, and the translation makes no rapid move through what stands.
  [[nodiscard]] std::string material() const {
    double u0 = std::numeric_limits<double>::infinity(), v0 = u0, u1 = -u0, v1 = -u0;
    for (const auto& m : a_.moves()) {
      if (!cuts(*m.event)) continue;
      for (const auto& p : m.points) {
        u0 = std::min(u0, p.u - a_.radius());
        v0 = std::min(v0, p.v - a_.radius());
        u1 = std::max(u1, p.u + a_.radius());
        v1 = std::max(v1, p.v + a_.radius());
      }
    }
    if (u1 < u0) return {};
    const double top = a_.surface();
    Grid surely_a(u0, v0, u1, v1, top), perhaps_a = surely_a, surely_b = surely_a, perhaps_b = surely_a;
    const double room = 0.75 * surely_a.size();
    for (const auto& m : a_.moves()) {
      if (!cuts(*m.event)) continue;
      surely_a.cut(m, a_.radius() - room);
      perhaps_a.cut(m, a_.radius() + room);
    }
    for (const auto& m : b_.moves()) {
      if (!cuts(*m.event)) {
        if (perhaps_b.hits(m, b_.radius() - room, t_.contour))
          return "a rapid move of the translation's cycle goes through material that is not cut yet, at " + said(m);
        continue;
      }
      surely_b.cut(m, b_.radius() - room);
      perhaps_b.cut(m, b_.radius() + room);
    }
    for (std::size_t k = 0; k < surely_a.count(); ++k) {
      const PocketPoint p = surely_a.place(k);
      if (surely_a.at(k) < perhaps_b.at(k) - t_.contour)
        return fmt::format("the translation's cycle leaves more than the source's, at {} {}", rounded(p.u, 2),
                           rounded(p.v, 2));
      if (surely_b.at(k) < perhaps_a.at(k) - t_.contour)
        return fmt::format("the translation's cycle takes more than the source's, at {} {}", rounded(p.u, 2),
                           rounded(p.v, 2));
    }
    return {};
  }
  static std::string said(const PocketMove& m) {
    const PocketPoint& p = m.points.back();
    return fmt::format("{} {}", rounded(p.u, 3), rounded(p.v, 3));
  }

  Side a_, b_;
  std::vector<Extent> places_;
  const Tolerances& t_;
};

}  // namespace

std::string pocket_difference(const CyclePasses& source, const CyclePasses& target, const Tolerances& tolerances,
                              double& max_length) {
  const CycleRun &a = *source.run, &b = *target.run;
  if (!a.comparable || !b.comparable || a.plane != b.plane || a.out * b.out < 0)
    return "the pockets lie in planes that can't be compared";
  Pockets pockets(source, target, tolerances);
  std::string what = pockets.difference();
  max_length = std::max(max_length, pockets.apart);
  return what;
}

}  // namespace cnctrans::verifier
