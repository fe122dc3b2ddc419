#include "ir/cycles/milling/pocket_moves.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "base/text.h"
#include "ir/cycles/milling/mill_moves.h"

namespace cnctrans::ir::cycles {

namespace detail {

namespace {

constexpr double usual_pocket_step = 0.75;  ///< of the diameter, where the source names no other factor
constexpr double most_rings = 5000;

double spread(const PocketPiece& piece) {
  double low = 1e300, high = -1e300;
  for (const auto& e : piece.outside) {
    low = std::min({low, e.u0, e.v0});
    high = std::max({high, e.u0, e.v0});
  }
  return high - low;
}

/// A piece of the area at one distance from the walls, and what lies further inside.
struct Round {
  PocketPiece piece;
  std::vector<Round> inner;
  std::vector<PocketWay> rest;  ///< what the ways leave here
};

void collect(const Round& ring, std::vector<PocketWay>& ways) {
  for (const auto& r : ring.inner) collect(r, ways);
  ways.insert(ways.end(), ring.rest.begin(), ring.rest.end());
  ways.insert(ways.end(), ring.piece.islands.begin(), ring.piece.islands.end());
  ways.push_back(ring.piece.outside);
}

/// The innermost ring that a point lies in; null: none.
Round* innermost(Round& ring, double u, double v) {
  if (!contains(ring.piece, u, v)) return nullptr;
  for (auto& r : ring.inner) {
    if (Round* found = innermost(r, u, v)) return found;
  }
  return &ring;
}

/// All ways of the roughing of one piece, in their order.
struct Job {
  PocketPiece piece;
  std::vector<PocketWay> ways;
};

struct IslandPlan {
  std::optional<PocketArea> area;
  double step = 0, wall = 0;
  bool natural = true;  ///< with the pocket on the left of its ways
  bool lines = false;
};

bool read_plan(MillPath& path, const MillContext& context, IslandPlan& plan, std::string* error) {
  if (context.contours == nullptr) return *error = "the pocket needs its contours", false;
  plan.area = PocketArea::of(*context.contours, path.says("outside"), context.tolerance, error);
  if (!plan.area) return false;
  if (path.says("apart") && plan.area->overlap())
    return *error = "contours of the pocket that cross each other are not carried out yet", false;
  plan.step = path.step(usual_pocket_step, error);
  plan.wall = std::abs(path.get("wall_stock"));
  const double along = path.get("along");
  plan.natural = along != 0 ? plan.area->outside_ccw() == (along > 0) : path.inside_ccw(error);
  plan.lines = !std::isnan(path.get("pass_angle", std::nan("")));
  if (error->empty() && plan.step < 1e-3) *error = "the step in the plane is too small";
  return error->empty();
}

/// What is left between the ways is cut before the ring that lies round it.
bool clear_rest(const PocketArea& area, Round& top, double radius, std::string* error) {
  constexpr int most_rounds = 8;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<PocketWay> ways;
    collect(top, ways);
    const auto rest = area.left_over(top.piece, ways, radius);
    if (rest.empty()) return true;
    for (const auto& way : rest) {
      Round* at = innermost(top, way.front().u0, way.front().v0);
      (at != nullptr ? *at : top).rest.push_back(way);
    }
  }
  return *error = "the passes do not clear the pocket", false;
}

std::optional<std::vector<Job>> jobs(MillPath& path, const IslandPlan& plan, std::string* error) {
  const double radius = path.tool_radius(), first = radius + plan.wall;
  std::vector<Job> out;
  std::vector<Round> tops;
  for (auto& piece : plan.area->inside(first)) tops.push_back({std::move(piece), {}, {}});
  if (tops.empty()) return *error = "the tool is too large for the pocket and its allowance", std::nullopt;
  for (const auto& top : tops) {
    if (spread(top.piece) / plan.step > most_rings) return *error = "the cycle has too many passes", std::nullopt;
  }
  if (plan.lines) {
    for (auto& top : tops) {
      Job job;
      job.ways = top.piece.islands;
      job.ways.insert(job.ways.begin(), top.piece.outside);
      for (const auto& line : stripes(top.piece, path.get("pass_angle"), plan.step)) job.ways.push_back({line});
      job.piece = std::move(top.piece);
      out.push_back(std::move(job));
    }
    return out;
  }
  std::vector<Round*> level;
  for (auto& top : tops) level.push_back(&top);
  for (long k = 1; !level.empty(); ++k) {
    std::vector<Round*> next;
    for (auto& piece : plan.area->inside(first + static_cast<double>(k) * plan.step)) {
      const auto from = piece.outside.front();
      const auto round = std::find_if(level.begin(), level.end(),
                                      [&from](const Round* r) { return contains(r->piece, from.u0, from.v0); });
      if (round != level.end()) (*round)->inner.push_back({std::move(piece), {}, {}});
    }
    for (Round* r : level) {
      for (auto& i : r->inner) next.push_back(&i);
    }
    level = std::move(next);
  }
  for (auto& top : tops) {
    if (!clear_rest(*plan.area, top, radius, error)) return std::nullopt;
    Job job;
    collect(top, job.ways);
    job.piece = std::move(top.piece);
    out.push_back(std::move(job));
  }
  return out;
}

bool closed(const PocketWay& way) {
  return std::hypot(way.back().u1 - way.front().u0, way.back().v1 - way.front().v0) < 1e-6;
}

/// A closed way begins at its corner next to the tool, a circle at its point next to it.
PocketWay from_next(const PocketWay& way, PocketPoint tool) {
  if (!closed(way)) return way;
  if (way.size() == 1) {
    PocketWay out = way;
    auto& e = out[0];
    const double r = std::hypot(e.u0 - e.cu, e.v0 - e.cv), d = std::hypot(tool.u - e.cu, tool.v - e.cv);
    if (d < 1e-6) return out;
    e.u0 = e.u1 = e.cu + (tool.u - e.cu) / d * r;
    e.v0 = e.v1 = e.cv + (tool.v - e.cv) / d * r;
    return out;
  }
  std::size_t best = 0;
  double least = 1e300;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const double d = std::hypot(way[i].u0 - tool.u, way[i].v0 - tool.v);
    if (d > least - 1e-9) continue;
    least = d;
    best = i;
  }
  return started_at(way, best, 0);
}

class Mill {
 public:
  Mill(MillPath& path, const MillContext& context) : path_(path), context_(context) {}

  void rough(const Job& job, bool natural, const std::vector<double>& depths) {
    const auto& n = path_.levels();
    for (std::size_t k = 0; k < depths.size(); ++k) {
      clear_above_ = k == 0 ? n.reference : depths[k - 1] + n.up * level_lift;
      bool first = true;
      for (const auto& way : job.ways) {
        PocketWay now = natural || !closed(way) ? way : reversed(way);
        if (!first) now = from_next(now, at_);
        go(job.piece, std::move(now), depths[k], first);
        first = false;
      }
      path_.rapid_to(n.reference);
    }
  }

  void finish(const PocketPiece& piece, bool natural, const std::vector<double>& depths) {
    std::vector<PocketWay> ways = piece.islands;
    ways.insert(ways.begin(), piece.outside);
    const auto& n = path_.levels();
    for (const auto& way : ways) {
      const Entry entry = entry_of(piece, natural ? way : reversed(way));
      for (std::size_t k = 0; k < depths.size(); ++k) {
        to(entry.from);
        if (k > 0) path_.rapid_to(depths[k - 1] + n.up * level_lift);
        path_.plunge(depths[k]);
        if (entry.radius > 0)
          path_.mill_arc(entry.way.front().u0, entry.way.front().v0, entry.centre.u, entry.centre.v, entry.ccw);
        follow(entry.way);
        if (entry.radius > 0) path_.mill_arc(entry.to.u, entry.to.v, entry.centre.u, entry.centre.v, entry.ccw);
        at_ = entry.to;
        path_.rapid_to(n.reference);
      }
    }
  }

  /// Over the reference plane.
  void to(PocketPoint p) {
    if (!begun_)
      path_.approach(p.u, p.v);
    else
      path_.rapid(p.u, p.v);
    begun_ = true;
    at_ = p;
  }

 private:
  struct Entry {
    PocketWay way;
    double radius = 0;  ///< 0: straight down onto the way
    bool ccw = false;
    PocketPoint from, to, centre;
  };

  void follow(const PocketWay& way) {
    for (const auto& e : way) {
      if (e.arc)
        path_.mill_arc(e.u1, e.v1, e.cu, e.cv, e.ccw);
      else
        path_.mill(e.u1, e.v1);
      at_ = {e.u1, e.v1};
    }
  }

  void go(const PocketPiece& piece, PocketWay way, double w, bool first) {
    const PocketPoint start{way.front().u0, way.front().v0};
    if (!first && context_.links_at_depth && passes(piece, at_, start)) {
      path_.mill(start.u, start.v);
    } else {
      if (begun_) path_.rapid_to(path_.levels().reference);
      to(start);
      path_.rapid_to(clear_above_);
      way = down(std::move(way), w);
    }
    follow(way);
  }

  /// Into the material at the start of the way, or on a ramp along it. What remains is the whole way from there on.
  PocketWay down(PocketWay way, double w) {
    const double angle = path_.get("plunge_angle");
    if (angle <= 0 || angle >= 90) {
      path_.plunge(w);
      return way;
    }
    const double top = path_.height(), slope = std::tan(angle * radians);
    const double need = std::abs(top - w) / slope;
    double done = 0;
    const bool ring = closed(way);
    double round = 0;
    for (const auto& e : way) round += length_of(e);
    if (path_.times(need / std::max(round, least_mm)) < 1 || path_.too_many()) return way;
    for (std::size_t i = 0; done < need - least_mm; i = (i + 1) % way.size()) {
      if (!ring && i == 0 && done > 0) {
        way = reversed(way);
        i = 0;
      }
      const auto& e = way[i];
      const double length = length_of(e), part = std::min(1.0, (need - done) / length);
      done += length * part;
      const auto p = part < 1 ? point_on(e, part) : PocketPoint{e.u1, e.v1};
      const double height = done > need - least_mm ? w : top + (w - top) * done / need;
      if (e.arc)
        path_.plunge_arc_to(p.u, p.v, height, e.cu, e.cv, e.ccw);
      else
        path_.plunge_to(p.u, p.v, height);
      at_ = p;
      if (done > need - least_mm) {
        if (ring) return started_at(way, i, part);
        path_.mill(way.front().u0, way.front().v0);
        return way;
      }
    }
    return way;
  }

  /// On a quadrant about a point on the free side, at the longest element where there is room for it.
  Entry entry_of(const PocketPiece& piece, const PocketWay& way) const {
    Entry out;
    out.way = way;
    out.from = out.to = {way.front().u0, way.front().v0};
    if (!context_.entry_on_arc) return out;
    std::vector<std::size_t> order(way.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&way](auto a, auto b) { return length_of(way[a]) > length_of(way[b]) + 1e-9; });
    for (const double part : {1.0, 0.5, 0.25}) {
      const double r = path_.tool_radius() * part;
      for (std::size_t i = 0; i < std::min<std::size_t>(order.size(), 50); ++i) {
        const PocketWay turned = started_at(way, order[i], 0.5);
        const PocketPoint s{turned.front().u0, turned.front().v0};
        const Direction t = direction_at(turned.front(), false);
        for (const double side : {1.0, -1.0}) {
          const PocketPoint c{s.u - side * r * t.v, s.v + side * r * t.u};
          const PocketPoint from{c.u - r * t.u, c.v - r * t.v}, to{c.u + r * t.u, c.v + r * t.v};
          if (!off_wall(turned.front(), from, r) || !off_wall(turned.front(), to, r)) continue;
          if (!free(piece, s, c, from) || !free(piece, s, c, to)) continue;
          return {turned, r, side > 0, from, to, c};
        }
      }
    }
    return out;
  }
  /// The tool goes into the material where it is clear of the wall.
  static bool off_wall(const MillElement& e, PocketPoint p, double r) {
    return !e.arc || std::abs(std::hypot(p.u - e.cu, p.v - e.cv) - std::hypot(e.u0 - e.cu, e.v0 - e.cv)) > r / 4;
  }
  /// The quadrant from the wall to `end` lies in the piece.
  static bool free(const PocketPiece& piece, PocketPoint wall, PocketPoint centre, PocketPoint end) {
    constexpr int parts = 8;
    PocketPoint last = wall;
    for (int k = 1; k <= parts; ++k) {
      const double a = 90 * radians * k / parts;
      const PocketPoint p{centre.u + (wall.u - centre.u) * std::cos(a) + (end.u - centre.u) * std::sin(a),
                          centre.v + (wall.v - centre.v) * std::cos(a) + (end.v - centre.v) * std::sin(a)};
      if (!passes(piece, last, p)) return false;
      last = p;
    }
    return true;
  }

  MillPath& path_;
  const MillContext& context_;
  PocketPoint at_;
  double clear_above_ = 0;
  bool begun_ = false;
};

}  // namespace

bool contour_pocket(MillPath& path, const MillContext& context, std::string* error) {
  IslandPlan plan;
  if (!read_plan(path, context, plan, error)) return false;
  const auto operation = path.operation(error);
  if (!error->empty()) return false;
  const auto& n = path.levels();
  const double surface = context.contours->front().surface.value_or(n.surface);
  if ((n.reference - surface) * n.up < -least_mm)
    return *error = "the reference plane does not lie above the surface of the pocket", false;
  if ((surface - n.bottom) * n.up < least_mm) return *error = "the pocket has no depth", false;
  path.frame(0, 0, 0);
  Mill mill(path, context);
  if (operation != Operation::finish) {
    const auto list = jobs(path, plan, error);
    if (!list) return false;
    const auto depths = path.depths(surface, n.bottom + n.up * std::abs(path.get("floor_stock")));
    for (const auto& job : *list) mill.rough(job, plan.natural, depths);
  }
  if (operation != Operation::rough) {
    const auto pieces = plan.area->inside(path.tool_radius());
    if (pieces.empty()) return *error = "the tool is too large for the pocket", false;
    path.finishing(true);
    for (const auto& piece : pieces) mill.finish(piece, plan.natural, path.depths(surface, n.bottom));
    path.finishing(false);
  }
  path.retract();
  return true;
}

}  // namespace detail

std::vector<PocketPoint> pocket_entries(const MillNumbers& mill, const MillContext& context, std::string* error) {
  error->clear();
  HoleNumbers levels;
  detail::MillPath path(mill, levels, context);
  detail::IslandPlan plan;
  if (!detail::read_plan(path, context, plan, error)) return {};
  const auto list = detail::jobs(path, plan, error);
  if (!list) return {};
  std::vector<PocketPoint> out;
  for (const auto& job : *list) {
    const auto way = plan.natural ? job.ways.front() : reversed(job.ways.front());
    out.push_back({way.front().u0, way.front().v0});
  }
  return out;
}

}  // namespace cnctrans::ir::cycles
