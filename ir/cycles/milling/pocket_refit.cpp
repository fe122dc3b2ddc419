#include "ir/cycles/milling/pocket_refit.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cnctrans::ir::cycles {

namespace {

constexpr double full_turn = 6.283185307179586;

/// Angle of the arc in its sense, above 0.
double sweep_of(const MillElement& e) {
  const double a = std::atan2(e.v0 - e.cv, e.u0 - e.cu), b = std::atan2(e.v1 - e.cv, e.u1 - e.cu);
  double turn = e.ccw ? b - a : a - b;
  if (std::hypot(e.u1 - e.u0, e.v1 - e.v0) < 1e-9) return full_turn;
  while (turn <= 0) turn += full_turn;
  return turn;
}

}  // namespace

double length_of(const MillElement& e) {
  return e.arc ? std::hypot(e.u0 - e.cu, e.v0 - e.cv) * sweep_of(e) : std::hypot(e.u1 - e.u0, e.v1 - e.v0);
}

PocketPoint point_on(const MillElement& e, double at) {
  if (!e.arc) return {e.u0 + at * (e.u1 - e.u0), e.v0 + at * (e.v1 - e.v0)};
  const double turn = sweep_of(e) * at * (e.ccw ? 1 : -1), c = std::cos(turn), s = std::sin(turn);
  const double ru = e.u0 - e.cu, rv = e.v0 - e.cv;
  return {e.cu + ru * c - rv * s, e.cv + ru * s + rv * c};
}

PocketWay reversed(const PocketWay& way) {
  PocketWay out(way.rbegin(), way.rend());
  for (auto& e : out) {
    std::swap(e.u0, e.u1);
    std::swap(e.v0, e.v1);
    e.ccw = !e.ccw;
  }
  return out;
}

PocketWay started_at(const PocketWay& way, std::size_t index, double at) {
  PocketWay out;
  const MillElement& cut = way[index];
  const double length = length_of(cut);
  const bool whole = way.size() == 1 && cut.arc;
  const auto p = point_on(cut, at);
  if (whole) {
    out.push_back(cut);
    out[0].u0 = out[0].u1 = p.u;
    out[0].v0 = out[0].v1 = p.v;
    return out;
  }
  const bool at_start = at * length < 1e-6, at_end = (1 - at) * length < 1e-6;
  if (!at_end) {
    out.push_back(cut);
    if (!at_start) {
      out.back().u0 = p.u;
      out.back().v0 = p.v;
    }
  }
  for (std::size_t k = 1; k < way.size(); ++k) out.push_back(way[(index + k) % way.size()]);
  if (!at_start) {
    out.push_back(cut);
    if (!at_end) {
      out.back().u1 = p.u;
      out.back().v1 = p.v;
    }
  }
  return out;
}

namespace detail {

namespace {

double distance(PocketPoint a, PocketPoint b) {
  return std::hypot(a.u - b.u, a.v - b.v);
}

/// The straight line from a to b runs along the curve.
bool follows(const ExactCurve& c, PocketPoint a, PocketPoint b, double off) {
  const double eu = b.u - a.u, ev = b.v - a.v;
  if (!c.arc) {
    const auto aside = [&c](PocketPoint p) { return std::abs((p.u - c.u) * c.dv - (p.v - c.v) * c.du); };
    return aside(a) <= off && aside(b) <= off && (eu * c.du + ev * c.dv > 0 || std::hypot(eu, ev) <= 2 * off);
  }
  const auto aside = [&c](PocketPoint p) { return std::abs(std::hypot(p.u - c.u, p.v - c.v) - c.radius); };
  const PocketPoint middle{(a.u + b.u) / 2, (a.v + b.v) / 2};
  if (aside(a) > off || aside(b) > off || aside(middle) > off) return false;
  const double turn = (a.u - c.u) * ev - (a.v - c.v) * eu;
  return std::hypot(eu, ev) <= 2 * off || (turn > 0) == c.ccw;
}

PocketPoint on_curve(const ExactCurve& c, PocketPoint p) {
  if (!c.arc) {
    const double along = (p.u - c.u) * c.du + (p.v - c.v) * c.dv;
    return {c.u + along * c.du, c.v + along * c.dv};
  }
  const double d = std::hypot(p.u - c.u, p.v - c.v);
  return d < 1e-12 ? p : PocketPoint{c.u + (p.u - c.u) / d * c.radius, c.v + (p.v - c.v) / d * c.radius};
}

/// Where two curves meet next to `near`; nullopt: they do not.
std::optional<PocketPoint> meeting(const ExactCurve& a, const ExactCurve& b, PocketPoint near, double off) {
  if (!a.arc && !b.arc) {
    const double det = a.du * b.dv - a.dv * b.du;
    if (std::abs(det) < 1e-9) return on_curve(a, near);
    const double t = ((b.u - a.u) * b.dv - (b.v - a.v) * b.du) / det;
    return PocketPoint{a.u + t * a.du, a.v + t * a.dv};
  }
  if (!a.arc || !b.arc) {
    const ExactCurve &line = a.arc ? b : a, &circle = a.arc ? a : b;
    const PocketPoint foot = on_curve(line, {circle.u, circle.v});
    const double d = std::hypot(foot.u - circle.u, foot.v - circle.v);
    if (d > circle.radius + off) return std::nullopt;
    // A line that touches the circle, or misses it by dust only.
    if (d > circle.radius - 1e-7) return foot;
    const double half = std::sqrt(circle.radius * circle.radius - d * d);
    const PocketPoint one{foot.u + half * line.du, foot.v + half * line.dv};
    const PocketPoint other{foot.u - half * line.du, foot.v - half * line.dv};
    return distance(one, near) < distance(other, near) ? one : other;
  }
  const double d = std::hypot(b.u - a.u, b.v - a.v);
  if (d < 1e-9) return std::abs(a.radius - b.radius) < off ? std::optional(on_curve(a, near)) : std::nullopt;
  const double eu = (b.u - a.u) / d, ev = (b.v - a.v) / d;
  const double along = (d * d + a.radius * a.radius - b.radius * b.radius) / (2 * d);
  const double square = a.radius * a.radius - along * along;
  if (square < -off * (a.radius + off)) return std::nullopt;
  const PocketPoint foot{a.u + along * eu, a.v + along * ev};
  if (square < 1e-7) return on_curve(a, foot);
  const double half = std::sqrt(square);
  const PocketPoint one{foot.u - half * ev, foot.v + half * eu}, other{foot.u + half * ev, foot.v - half * eu};
  return distance(one, near) < distance(other, near) ? one : other;
}

struct Group {
  const ExactCurve* curve = nullptr;  ///< null: a side of the polygon
  PocketPoint start;                  ///< of the polygon
  double length = 0;                  ///< of its sides
};

/// Sides in a row along one curve each.
std::vector<Group> grouped(const std::vector<PocketPoint>& polygon, const std::vector<ExactCurve>& curves, double off) {
  const std::size_t n = polygon.size();
  std::vector<std::vector<const ExactCurve*>> fits(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (const auto& c : curves) {
      if (follows(c, polygon[i], polygon[(i + 1) % n], off)) fits[i].push_back(&c);
    }
  }
  const auto common = [](const std::vector<const ExactCurve*>& a, const std::vector<const ExactCurve*>& b) {
    std::vector<const ExactCurve*> both;
    for (const auto* c : a) {
      if (std::find(b.begin(), b.end(), c) != b.end()) both.push_back(c);
    }
    return both;
  };
  // Begin where one curve surely ends.
  std::size_t first = 0;
  while (first < n && !common(fits[(first + n - 1) % n], fits[first]).empty()) ++first;
  std::vector<Group> out;
  std::vector<const ExactCurve*> now;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (first + k) % n;
    const double side = distance(polygon[i], polygon[(i + 1) % n]);
    const auto both = out.empty() ? now : common(now, fits[i]);
    if (both.empty() || out.empty()) {
      out.push_back({fits[i].empty() ? nullptr : fits[i].front(), polygon[i], side});
      now = fits[i];
      continue;
    }
    now = both;
    out.back().curve = now.front();
    out.back().length += side;
  }
  return out;
}

PocketWay sides(const std::vector<PocketPoint>& polygon) {
  PocketWay out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    out.push_back({a.u, a.v, b.u, b.v});
  }
  return out;
}

}  // namespace

void parallel_curves(const PocketWay& way, double d, std::vector<ExactCurve>& out) {
  for (const auto& e : way) {
    ExactCurve c;
    if (e.arc) {
      c = {true, e.ccw, e.cu, e.cv, 0, 0, std::hypot(e.u0 - e.cu, e.v0 - e.cv) + (e.ccw ? -d : d)};
      if (c.radius > 0) out.push_back(c);
    } else {
      const Direction t = direction_at(e, false);
      out.push_back({false, false, e.u0 - d * t.v, e.v0 + d * t.u, t.u, t.v, 0});
    }
    if (d > 0) out.push_back({true, false, e.u0, e.v0, 0, 0, d});
  }
}

PocketWay refit(const std::vector<PocketPoint>& polygon, const std::vector<ExactCurve>& curves, double off) {
  auto groups = grouped(polygon, curves, off);
  if (groups.size() == 1 && groups[0].curve != nullptr && groups[0].curve->arc) {
    const auto& c = *groups[0].curve;
    const double u = c.u + c.radius;
    return {{u, c.v, u, c.v, true, c.ccw, c.u, c.v}};
  }
  if (groups.size() < 2) return sides(polygon);
  std::vector<ExactCurve> own(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto &a = groups[i].start, &b = groups[(i + 1) % groups.size()].start;
    const double l = std::max(distance(a, b), 1e-12);
    own[i] = groups[i].curve != nullptr ? *groups[i].curve
                                        : ExactCurve{false, false, a.u, a.v, (b.u - a.u) / l, (b.v - a.v) / l, 0};
  }
  std::vector<PocketPoint> corner(groups.size());  // where each one starts
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::size_t before = (i + groups.size() - 1) % groups.size();
    const auto p = meeting(own[before], own[i], groups[i].start, off);
    const double most = 20 * off + std::min(groups[before].length, groups[i].length) / 2;
    if (!p || distance(*p, groups[i].start) > most) return sides(polygon);
    corner[i] = *p;
  }
  PocketWay out;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto a = corner[i], b = corner[(i + 1) % groups.size()];
    const double l = distance(a, b);
    const auto& c = own[i];
    if (l < 1e-7 && groups[i].length < 10 * off) continue;
    if (!c.arc && (b.u - a.u) * c.du + (b.v - a.v) * c.dv <= 0) return sides(polygon);
    out.push_back({a.u, a.v, b.u, b.v, c.arc, c.ccw, c.arc ? c.u : 0, c.arc ? c.v : 0});
    // An arc that would go nearly all the way round in the place of a short one.
    if (c.arc && std::abs(length_of(out.back()) - groups[i].length) > 0.2 * groups[i].length + 50 * off)
      return sides(polygon);
  }
  return out.size() < 2 ? sides(polygon) : out;
}

}  // namespace detail

}  // namespace cnctrans::ir::cycles
