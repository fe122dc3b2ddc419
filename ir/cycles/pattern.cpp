#include "ir/cycles/pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/noise.h"
#include "base/tiny.h"
#include "ir/cycles/words.h"

namespace cnctrans::ir::cycles {

namespace {

constexpr double most_points = 10'000;

constexpr std::array patterns = {
    Pattern{"points.line", PatternKind::line, true},      Pattern{"points.outline", PatternKind::outline, true},
    Pattern{"points.grid", PatternKind::grid, true},      Pattern{"points.circle", PatternKind::circle, true},
    Pattern{"points.arc", PatternKind::arc, true},        Pattern{"points.chord", PatternKind::chord, true},
    Pattern{"points.row", PatternKind::row, false},       Pattern{"points.ring", PatternKind::ring, false},
    Pattern{"points.matrix", PatternKind::matrix, false}, Pattern{"points.frame", PatternKind::frame, false},
    Pattern{"points.list", PatternKind::list, false},
};

constexpr std::array pattern_parameters = {
    PatternParameter{"u", PatternQuantity::length},         PatternParameter{"v", PatternQuantity::length},
    PatternParameter{"length", PatternQuantity::length},    PatternParameter{"step", PatternQuantity::length},
    PatternParameter{"count", PatternQuantity::plain},      PatternParameter{"length2", PatternQuantity::length},
    PatternParameter{"step2", PatternQuantity::length},     PatternParameter{"count2", PatternQuantity::plain},
    PatternParameter{"angle", PatternQuantity::plain},      PatternParameter{"side_angle", PatternQuantity::plain},
    PatternParameter{"centre_u", PatternQuantity::length},  PatternParameter{"centre_v", PatternQuantity::length},
    PatternParameter{"radius", PatternQuantity::length},    PatternParameter{"first", PatternQuantity::length},
    PatternParameter{"angle_step", PatternQuantity::plain}, PatternParameter{"total", PatternQuantity::plain},
    PatternParameter{"axis_angle", PatternQuantity::plain}, PatternParameter{"chord", PatternQuantity::length},
    PatternParameter{"way", PatternQuantity::plain},        PatternParameter{"way_feed", PatternQuantity::feed},
    PatternParameter{"skip1", PatternQuantity::plain},      PatternParameter{"skip2", PatternQuantity::plain},
    PatternParameter{"skip3", PatternQuantity::plain},      PatternParameter{"skip4", PatternQuantity::plain},
    PatternParameter{"skip5", PatternQuantity::plain},      PatternParameter{"skip6", PatternQuantity::plain},
    PatternParameter{"skip7", PatternQuantity::plain},      PatternParameter{"u1", PatternQuantity::length},
    PatternParameter{"v1", PatternQuantity::length},        PatternParameter{"u2", PatternQuantity::length},
    PatternParameter{"v2", PatternQuantity::length},        PatternParameter{"u3", PatternQuantity::length},
    PatternParameter{"v3", PatternQuantity::length},        PatternParameter{"u4", PatternQuantity::length},
    PatternParameter{"v4", PatternQuantity::length},        PatternParameter{"u5", PatternQuantity::length},
    PatternParameter{"v5", PatternQuantity::length},        PatternParameter{"u6", PatternQuantity::length},
    PatternParameter{"v6", PatternQuantity::length},        PatternParameter{"u7", PatternQuantity::length},
    PatternParameter{"v7", PatternQuantity::length},        PatternParameter{"u8", PatternQuantity::length},
    PatternParameter{"v8", PatternQuantity::length},        PatternParameter{"u9", PatternQuantity::length},
    PatternParameter{"v9", PatternQuantity::length},
};

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

class Builder {
 public:
  Builder(const Pattern& p, const PatternNumbers& n, double u, double v, std::string* error)
      : pattern_(p), numbers_(n), u_(u), v_(v), error_(error) {}

  std::optional<std::vector<PatternPoint>> build() {
    bool done = false;
    switch (pattern_.kind) {
      case PatternKind::line: done = line(); break;
      case PatternKind::outline:
      case PatternKind::grid: done = parallelogram(); break;
      case PatternKind::circle:
      case PatternKind::arc: done = round(); break;
      case PatternKind::chord: done = chord(); break;
      case PatternKind::row: done = row(); break;
      case PatternKind::ring: done = ring(); break;
      case PatternKind::matrix:
      case PatternKind::frame: done = matrix(); break;
      case PatternKind::list: done = list(); break;
    }
    if (!done || !leave_out()) return std::nullopt;
    return std::move(points_);
  }

 private:
  bool fail(std::string text) {
    *error_ = std::move(text);
    return false;
  }
  [[nodiscard]] bool has(std::string_view name) const { return numbers_.contains(name); }
  [[nodiscard]] double number(std::string_view name, double otherwise = 0) const {
    const auto it = numbers_.find(name);
    return it == numbers_.end() ? otherwise : it->second;
  }
  static double clean(double x) { return without_noise(x, 1e10); }
  void add(double u, double v) {
    PatternPoint p;
    p.u = clean(u);
    p.v = clean(v);
    points_.push_back(p);
  }
  bool whole(double x, double& n, std::string_view what) {
    n = std::round(x);
    if (std::abs(x - n) > 1e-6 || n < 1 || n > most_points)
      return fail("the number of " + std::string(what) + " of the pattern is not a whole number from 1 up");
    return true;
  }
  /// Two of length, step and number give the third: length = step (number - 1).
  bool side(std::string_view length, std::string_view step, std::string_view count, double& d, double& n) {
    const int given = static_cast<int>(has(length)) + static_cast<int>(has(step)) + static_cast<int>(has(count));
    if (given != 2) return fail("a side of the pattern needs two of its length, step and number of points");
    if (has(count) && !whole(number(count), n, "points")) return false;
    d = number(step);
    if (has(length) && has(count)) {
      if (n > 1) d = number(length) / (n - 1);
      return true;
    }
    if (has(length)) {
      if (std::abs(d) < tiny) return fail("the step of the pattern is zero");
      if (!whole(std::abs(number(length) / d) + 1, n, "steps")) return false;
      d = std::copysign(d, number(length));
    }
    return true;
  }

  bool line() {
    double d = 0, n = 0;
    if (!side("length", "step", "count", d, n)) return false;
    const double a = radians(number("angle"));
    for (double k = 1; k < n; ++k) add(u_ + k * d * std::cos(a), v_ + k * d * std::sin(a));
    return true;
  }
  bool parallelogram() {
    double d = 0, n = 0, e = 0, m = 0;
    if (!side("length", "step", "count", d, n) || !side("length2", "step2", "count2", e, m)) return false;
    if (n * m > most_points) return fail("the pattern has too many points");
    const double a = radians(number("angle")), b = a + radians(number("side_angle", 90));
    const auto at = [&](double i, double j) {
      add(u_ + i * d * std::cos(a) + j * e * std::cos(b), v_ + i * d * std::sin(a) + j * e * std::sin(b));
    };
    if (pattern_.kind == PatternKind::grid) {
      for (double j = 0; j < m; ++j) {
        for (double i = 0; i < n; ++i) at(std::fmod(j, 2) == 0 ? i : n - 1 - i, j);
      }
      points_.erase(points_.begin());
      return true;
    }
    if (n < 2 || m < 2) return fail("a side of the outline has fewer than two points");
    for (double i = 1; i < n; ++i) at(i, 0);
    for (double j = 1; j < m; ++j) at(n - 1, j);
    for (double i = n - 2; i >= 0; --i) at(i, m - 1);
    for (double j = m - 2; j >= 1; --j) at(0, j);
    return true;
  }

  // --- round a centre from the tool --------------------------------------------------------------------------------

  void set_way(PatternPoint& p) const {
    const double way = number("way");
    p.way = way == 1   ? PatternPoint::Way::linear
            : way == 2 ? PatternPoint::Way::cw
            : way == 3 ? PatternPoint::Way::ccw
                       : PatternPoint::Way::rapid;
    p.centre_u = centre_u();
    p.centre_v = centre_v();
    p.feed = number("way_feed");
  }
  [[nodiscard]] double centre_u() const { return u_ + number("centre_u"); }
  [[nodiscard]] double centre_v() const { return v_ + number("centre_v"); }
  bool circle_words() {
    const double way = number("way");
    if (way != 0 && way != 1 && way != 2 && way != 3) return fail("the way between the points is 0, 1, 2 or 3");
    if (way != 0 && number("way_feed") <= 0)
      return fail("the way between the points has no feed: the greatest feed of the machine is not known");
    if (std::hypot(number("centre_u"), number("centre_v")) < tiny)
      return fail("the centre of the pattern is where the tool stands");
    return true;
  }
  /// The sense goes by the arc of the way, else by the sign of the step.
  [[nodiscard]] double turned(double step) const {
    const double way = number("way");
    return way == 2 ? -std::abs(step) : way == 3 ? std::abs(step) : step;
  }
  void on_circle(double angle) {
    const double r = std::hypot(number("centre_u"), number("centre_v"));
    add(centre_u() + r * std::cos(angle), centre_v() + r * std::sin(angle));
    set_way(points_.back());
  }
  [[nodiscard]] double start_angle() const { return std::atan2(-number("centre_v"), -number("centre_u")); }

  bool round() {
    if (!circle_words()) return false;
    if (has("angle_step") == has("count")) return fail("the pattern needs either its angular step or its number");
    const bool full = pattern_.kind == PatternKind::circle;
    const double total = full ? 360 : std::abs(number("total"));
    double n = 0, step = number("angle_step");
    if (!full && total < tiny) return fail("the angle of the arc is zero");
    if (has("count")) {
      if (!whole(number("count"), n, "points")) return false;
      step = full ? 360 / n : n > 1 ? total / (n - 1) : 0;
    } else {
      if (std::abs(step) < tiny) return fail("the angular step of the pattern is zero");
      if (!whole(total / std::abs(step) + (full ? 0 : 1), n, "steps")) return false;
    }
    const double signed_step = radians(turned(step));
    for (double k = 1; k < n; ++k) on_circle(start_angle() + k * signed_step);
    return true;
  }
  bool chord() {
    if (!circle_words()) return false;
    if (has("axis_angle") == has("chord")) return fail("the pattern needs either its angle or its chord");
    if (has("axis_angle")) {
      on_circle(2 * radians(number("axis_angle")) - start_angle());
      return true;
    }
    const double r = std::hypot(number("centre_u"), number("centre_v")), half = number("chord") / (2 * r);
    if (std::abs(half) > 1) return fail("the chord is longer than the diameter of the circle");
    on_circle(start_angle() + turned(2 * std::asin(half)));
    return true;
  }

  // --- by absolute coordinates ---------------------------------------------------------------------------------------

  bool row() {
    double n = 0;
    if (!whole(number("count"), n, "holes")) return false;
    const double a = radians(number("angle"));
    const auto at = [&](double k) {
      const double l = number("first") + k * number("step");
      return PatternPoint{clean(number("u") + l * std::cos(a)), clean(number("v") + l * std::sin(a))};
    };
    const auto far = [&](const PatternPoint& p) { return std::hypot(p.u - u_, p.v - v_); };
    const bool backwards = far(at(n - 1)) < far(at(0)) - tiny;
    for (double k = 0; k < n; ++k) points_.push_back(at(backwards ? n - 1 - k : k));
    return true;
  }
  bool ring() {
    double n = 0;
    if (!whole(number("count"), n, "holes")) return false;
    const double step = std::abs(number("angle_step")) < tiny ? 360 / n : number("angle_step");
    for (double k = 0; k < n; ++k) {
      const double a = radians(number("angle") + k * step);
      add(number("u") + number("radius") * std::cos(a), number("v") + number("radius") * std::sin(a));
    }
    return true;
  }
  bool list() {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 9> places{{{"u1", "v1"},
                                                                                   {"u2", "v2"},
                                                                                   {"u3", "v3"},
                                                                                   {"u4", "v4"},
                                                                                   {"u5", "v5"},
                                                                                   {"u6", "v6"},
                                                                                   {"u7", "v7"},
                                                                                   {"u8", "v8"},
                                                                                   {"u9", "v9"}}};
    for (const auto& [u, v] : places) {
      if (has(u) || has(v)) add(number(u), number(v));
    }
    return true;
  }
  bool matrix() {
    double n = 0, m = 0;
    if (!whole(number("count"), n, "columns") || !whole(number("count2"), m, "rows")) return false;
    if (n * m > most_points) return fail("the pattern has too many points");
    const double a = radians(number("angle")), c = std::cos(a), s = std::sin(a);
    const auto at = [&](double i, double j) {
      const double x = i * number("step"), y = j * number("step2");
      add(number("u") + x * c - y * s, number("v") + x * s + y * c);
    };
    if (pattern_.kind == PatternKind::matrix || n < 2 || m < 2) {
      for (double j = 0; j < m; ++j) {
        for (double i = 0; i < n; ++i) at(i, j);
      }
      return true;
    }
    for (double i = 0; i < n; ++i) at(i, 0);
    for (double j = 1; j < m; ++j) at(n - 1, j);
    for (double i = n - 2; i >= 0; --i) at(i, m - 1);
    for (double j = m - 2; j >= 1; --j) at(0, j);
    return true;
  }

  // --- points left out
  // -------------------------------------------------------------------------------------------------

  /// Numbers count from the point after the tool's. They rise, and 10.013 is 10 to 13.
  bool leave_out() {
    std::vector<bool> out(points_.size() + 1, false);
    double before = 0;
    for (const std::string_view name : {"skip1", "skip2", "skip3", "skip4", "skip5", "skip6", "skip7"}) {
      if (!has(name)) continue;
      const double x = number(name), from = std::floor(x + 5e-7), part = std::round((x - from) * 1000);
      const double to = part == 0 ? from : part;
      if (from <= before || to < from) return fail("the numbers of the points left out do not rise from 1");
      before = to;
      for (double k = from; k <= to && k < static_cast<double>(out.size()); ++k)
        out[static_cast<std::size_t>(k)] = true;
    }
    std::size_t number = 0;
    std::erase_if(points_, [&](const PatternPoint&) { return out[++number]; });
    return true;
  }

  const Pattern& pattern_;
  const PatternNumbers& numbers_;
  double u_, v_;
  std::string* error_;
  std::vector<PatternPoint> points_;
};

}  // namespace

const Pattern* find_pattern(std::string_view name) {
  return find_row(patterns, name);
}
const PatternParameter* find_pattern_parameter(std::string_view name) {
  return find_row(pattern_parameters, name);
}

std::optional<std::vector<PatternPoint>> pattern_points(const Pattern& pattern, const PatternNumbers& numbers, double u,
                                                        double v, std::string* error) {
  error->clear();
  return Builder(pattern, numbers, u, v, error).build();
}

}  // namespace cnctrans::ir::cycles
