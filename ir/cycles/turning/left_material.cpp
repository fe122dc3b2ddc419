#include "ir/cycles/turning/left_material.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cnctrans::ir::cycles {

namespace {

constexpr std::size_t cells = 4000;
constexpr double most_parts = 1e5;

/// The material over the contour, as columns along q: how high each still stands.
class Columns {
 public:
  Columns(double from, double to) : from_(from), width_((to - from) / double(cells)), height_(cells + 1, none) {}
  static constexpr double none = -std::numeric_limits<double>::infinity();

  /// The tool passes: `up`, the highest that it comes; else what it leaves.
  void pass(const RoleLine& points, bool up) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const RolePoint &a = points[i - 1], &b = points[i];
      const double way = b.q - a.q, low = (std::min(a.q, b.q) - from_) / width_, high = low + std::fabs(way) / width_;
      const bool upright = std::fabs(way) < 1e-9;
      const double first = upright ? std::round(low) : std::ceil(low - 1e-6);
      const double last = upright ? first : std::floor(high + 1e-6);
      for (double n = std::max(first, 0.0); n <= std::min(last, double(cells)); ++n) {
        const auto k = static_cast<std::size_t>(n);
        const double at = from_ + width_ * n;
        const double part = std::fabs(way) < 1e-9 ? -1 : std::clamp((at - a.q) / way, 0.0, 1.0);
        const double p = part < 0 ? (up ? std::max(a.p, b.p) : std::min(a.p, b.p)) : a.p + (b.p - a.p) * part;
        height_[k] = up ? std::max(height_[k], p) : std::min(height_[k], p);
      }
    }
  }
  /// The lowest, or the highest, of the columns around q.
  [[nodiscard]] double around(double q, bool lowest) const {
    const std::size_t k = index(q);
    double best = height_[k];
    constexpr std::size_t by = 2;
    for (std::size_t i = k < by ? 0 : k - by; i <= std::min(k + by, cells); ++i)
      best = lowest ? std::min(best, height_[i]) : std::max(best, height_[i]);
    return best;
  }
  [[nodiscard]] bool inside(double q) const { return q >= from_ && q <= from_ + width_ * double(cells); }
  [[nodiscard]] double place(std::size_t k) const { return from_ + width_ * double(k); }
  [[nodiscard]] double at(std::size_t k) const { return height_[k]; }

 private:
  [[nodiscard]] std::size_t index(double q) const {
    return static_cast<std::size_t>(std::clamp(std::round((q - from_) / width_), 0.0, double(cells)));
  }
  double from_, width_;
  std::vector<double> height_;
};

/// The part of a move over the contour.
RoleLine clipped(const RoleLine& points, double from, double to) {
  RoleLine out;
  const auto cut = [](const RolePoint& a, const RolePoint& b, double q) {
    return RolePoint{a.p + (b.p - a.p) * (q - a.q) / (b.q - a.q), q};
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    RolePoint a = points[i - 1], b = points[i];
    if (std::max(a.q, b.q) < from || std::min(a.q, b.q) > to) continue;
    const RolePoint whole_a = a, whole_b = b;
    for (RolePoint* end : {&a, &b}) {
      if (end->q < from) *end = cut(whole_a, whole_b, from);
      if (end->q > to) *end = cut(whole_a, whole_b, to);
    }
    if (out.empty()) out.push_back(a);
    out.push_back(b);
  }
  return out;
}

std::optional<MaterialFault> dives(const RoleMove& m, const Columns& mine, double room) {
  for (const auto& p : m.points) {
    if (mine.inside(p.q) && p.p < mine.around(p.q, true) - 2 * room) return MaterialFault{true, p};
  }
  return std::nullopt;
}

std::optional<MaterialFault> more(const Columns& mine, const Columns& left, double room) {
  for (std::size_t k = 0; k <= cells; ++k) {
    if (left.at(k) == Columns::none) continue;
    const double q = left.place(k);
    if (mine.at(k) > left.around(q, false) + 2 * room) return MaterialFault{false, {mine.at(k), q}};
  }
  return std::nullopt;
}

}  // namespace

void TurnRole::come_from_the_low_end(const RoleLine& contour) {
  const RolePoint &a = contour.front(), &b = contour.back();
  const RolePoint& low = a.p <= b.p ? a : b;
  const RolePoint& high = a.p <= b.p ? b : a;
  if (low.q < high.q) back = -back;
}

RoleLine role_straight(const TurnRole& role, TurnPoint from, TurnPoint to) {
  RoleLine out{role.of(from)};
  const double way = std::hypot(to.x - from.x, to.z - from.z);
  const double parts = std::clamp(std::ceil(way / role_step), 1.0, most_parts);
  for (double k = 1; k <= parts; ++k)
    out.push_back(role.of(from.x + (to.x - from.x) * k / parts, from.z + (to.z - from.z) * k / parts));
  return out;
}

RoleLine role_arc(const TurnRole& role, TurnPoint from, TurnPoint to, TurnPoint centre, bool ccw) {
  RoleLine out{role.of(from)};
  const double r = std::hypot(from.x - centre.x, from.z - centre.z);
  const double start = std::atan2(from.x - centre.x, from.z - centre.z);
  double sweep = std::atan2(to.x - centre.x, to.z - centre.z) - start;
  constexpr double full = 6.283185307179586;
  if (ccw && sweep <= 0) sweep += full;
  if (!ccw && sweep >= 0) sweep -= full;
  const double parts = std::clamp(std::ceil(r * std::fabs(sweep) / role_step), 8.0, most_parts);
  for (double k = 1; k < parts; ++k) {
    const double a = start + sweep * k / parts;
    out.push_back(role.of(centre.x + r * std::sin(a), centre.z + r * std::cos(a)));
  }
  out.push_back(role.of(to));
  return out;
}

std::optional<MaterialFault> material_fault(const RoleLine& bound, const std::vector<RoleMove>& there,
                                            const std::vector<RoleMove>& here, double room) {
  if (bound.empty()) return std::nullopt;
  double from = bound.front().q, to = from;
  for (const auto& p : bound) {
    from = std::min(from, p.q);
    to = std::max(to, p.q);
  }
  if (to - from < 1e-6) return std::nullopt;
  Columns blank(from, to);
  for (const auto& m : there) {
    if (m.cuts) blank.pass(clipped(m.points, from, to), true);
  }
  Columns left = blank, mine = blank;
  for (const bool finishing : {false, true}) {
    for (const auto& m : there) {
      if (m.cuts && m.finishing == finishing) left.pass(clipped(m.points, from, to), false);
    }
    bool finished = false;  // the ways behind a finishing pass go through what it has cut
    for (const auto& m : here) {
      finished = finished || (m.cuts && m.finishing);
      if (m.cuts && m.finishing == finishing) mine.pass(clipped(m.points, from, to), false);
      if (m.cuts || finished != finishing) continue;
      if (auto fault = dives(m, mine, room)) return fault;
    }
    if (auto fault = more(mine, left, room)) return fault;
  }
  return std::nullopt;
}

}  // namespace cnctrans::ir::cycles
