#include "interpreter/values/frame.h"

#include <cmath>
#include <numbers>

namespace cnctrans::interpreter {

Axes Frame::apply(const Axes& p) const {
  Axes r;
  for (std::size_t i = 0; i < 3; ++i) r[i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2] + t[i];
  for (std::size_t i = 3; i < r.size(); ++i) r[i] = d[i] * p[i] + t[i];
  return r;
}

bool Frame::is_translation() const {
  Frame f = *this;
  f.t.fill(0);
  return f == Frame{};
}

bool Frame::is_identity() const {
  return *this == Frame{};
}

Frame Frame::linear_part() const {
  Frame f = *this;
  f.t.fill(0);
  return f;
}

Frame translation(const Axes& t) {
  Frame f;
  f.t = t;
  return f;
}

Frame rotation(ir::AxisId u, ir::AxisId v, double degrees) {
  Frame f;
  const double s = sin_degrees(degrees), c = cos_degrees(degrees);
  f.m[u][u] = c;
  f.m[v][v] = c;
  f.m[u][v] = -s;
  f.m[v][u] = s;
  return f;
}

Frame compose(const Frame& a, const Frame& b) {
  Frame r;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
    }
  }
  for (std::size_t i = 3; i < r.d.size(); ++i) r.d[i] = a.d[i] * b.d[i];
  r.t = a.apply(b.t);
  return r;
}

bool invert(const Frame& f, Frame& out) {
  const auto& m = f.m;
  const auto minor = [&m](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, e = (j + 2) % 3;
    return m[a][c] * m[b][e] - m[a][e] * m[b][c];
  };
  const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  if (std::abs(det) < 1e-15) return false;
  Frame r;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) r.m[j][i] = minor(i, j) / det;
  }
  for (std::size_t i = 3; i < r.d.size(); ++i) {
    if (std::abs(f.d[i]) < 1e-15) return false;
    r.d[i] = 1 / f.d[i];
  }
  Axes back = r.apply(f.t);
  for (auto& x : back) x = x == 0 ? 0 : -x;
  r.t = back;
  out = r;
  return true;
}

PlaneMap plane_map(const Frame& f, ir::Plane plane) {
  const auto [u, v, w] = ir::plane_axes(plane);
  const auto& m = f.m;
  constexpr double eps = 1e-9;
  PlaneMap map;
  const double a = m[u][u], b = m[u][v], c = m[v][u], d = m[v][v];
  const double lu = std::hypot(a, c), lv = std::hypot(b, d);
  map.circles = std::abs(m[w][u]) < eps && std::abs(m[w][v]) < eps && std::abs(m[u][w]) < eps &&
                std::abs(m[v][w]) < eps && std::abs(lu - lv) < eps * lu && std::abs(a * b + c * d) < eps * lu * lv;
  map.mirrored = a * d - b * c < 0;
  return map;
}

namespace {

/// sin of 0..45 degrees.
double sin_octant(double a) {
  return a == 30 ? 0.5 : std::sin(a * std::numbers::pi / 180);
}
double cos_octant(double a) {
  return a == 0 ? 1 : std::cos(a * std::numbers::pi / 180);
}

}  // namespace

double sin_degrees(double degrees) {
  double a = std::fmod(degrees, 360);
  double sign = 1;
  if (a < 0) {
    a = -a;
    sign = -1;
  }
  if (a >= 180) {
    a -= 180;
    sign = -sign;
  }
  if (a > 90) a = 180 - a;
  const double value = a <= 45 ? sin_octant(a) : (a == 60 ? std::numbers::sqrt3 / 2 : cos_octant(90 - a));
  return value == 0 ? 0 : sign * value;
}

double cos_degrees(double degrees) {
  double a = std::fabs(std::fmod(degrees, 360));
  if (a > 180) a = 360 - a;
  double sign = 1;
  if (a > 90) {
    a = 180 - a;
    sign = -1;
  }
  const double value = a <= 45 ? (a == 30 ? std::numbers::sqrt3 / 2 : cos_octant(a)) : sin_octant(90 - a);
  return value == 0 ? 0 : sign * value;
}

}  // namespace cnctrans::interpreter
