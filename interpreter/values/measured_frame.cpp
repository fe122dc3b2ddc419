#include "interpreter/values/measured_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cnctrans::interpreter {

namespace {

using SpacePoint = std::array<double, 3>;
using ThreePoints = std::array<SpacePoint, 3>;
using Matrix4 = std::array<std::array<double, 4>, 4>;

SpacePoint minus(const SpacePoint& a, const SpacePoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double length(const SpacePoint& a) {
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

bool on_a_line(const ThreePoints& p) {
  const SpacePoint a = minus(p[1], p[0]), b = minus(p[2], p[0]);
  const SpacePoint cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  constexpr double nearly = 1e-6;
  const double longest = std::max({length(a), length(b), length(minus(p[2], p[1]))});
  return length(cross) <= nearly * longest * longest;
}

SpacePoint middle(const ThreePoints& p) {
  SpacePoint out{};
  for (const auto& x : p) {
    for (std::size_t k = 0; k < 3; ++k) out[k] += x[k] / 3;
  }
  return out;
}

/// The eigenvector of the largest eigenvalue of a symmetric matrix, by turns that clear one element each (Jacobi).
std::array<double, 4> largest_eigenvector(Matrix4 a) {
  Matrix4 v{};
  for (std::size_t i = 0; i < 4; ++i) v[i][i] = 1;
  constexpr int sweeps = 60;
  for (int n = 0; n < sweeps; ++n) {
    for (std::size_t p = 0; p < 3; ++p) {
      for (std::size_t q = p + 1; q < 4; ++q) {
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (std::size_t k = 0; k < 4; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
          const double kp = v[k][p], kq = v[k][q];
          v[k][p] = c * kp - s * kq;
          v[k][q] = s * kp + c * kq;
        }
      }
    }
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    if (a[i][i] > a[best][best]) best = i;
  }
  return {v[0][best], v[1][best], v[2][best], v[3][best]};
}

}  // namespace

MeasuredFrame measured_frame(std::span<const double, 18> points) {
  ThreePoints ideal{}, measured{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      ideal[i][k] = points[3 * i + k];
      measured[i][k] = points[9 + 3 * i + k];
    }
  }
  MeasuredFrame out;
  if (on_a_line(ideal)) {
    out.quality = -1;
    return out;
  }
  if (on_a_line(measured)) {
    out.quality = -2;
    return out;
  }
  const SpacePoint from = middle(ideal), to = middle(measured);
  std::array<std::array<double, 3>, 3> s{};  // sums of products of the coordinates about the middles
  for (std::size_t i = 0; i < 3; ++i) {
    const SpacePoint a = minus(ideal[i], from), b = minus(measured[i], to);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t l = 0; l < 3; ++l) s[k][l] += a[k] * b[l];
    }
  }
  // The turn as a unit quaternion: the largest eigenvector of this matrix (Horn).
  const Matrix4 n{{{s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
                   {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
                   {s[2][0] - s[0][2], s[0][1] + s[1][0], s[1][1] - s[0][0] - s[2][2], s[1][2] + s[2][1]},
                   {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], s[2][2] - s[0][0] - s[1][1]}}};
  const auto [w, x, y, z] = largest_eigenvector(n);
  if (!std::isfinite(w + x + y + z)) {
    out.quality = -4;
    return out;
  }
  out.frame.m = {{{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                  {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                  {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}};
  for (auto& row : out.frame.m) {
    for (auto& e : row) {
      constexpr double noise = 1e-14;
      if (std::abs(e - std::round(e)) < noise) e = std::round(e);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    out.frame.t[k] = to[k];
    for (std::size_t l = 0; l < 3; ++l) out.frame.t[k] -= out.frame.m[k][l] * from[l];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    Axes at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = ideal[i][k];
    const Axes seen = out.frame.apply(at);
    out.quality += length(minus({seen[0], seen[1], seen[2]}, measured[i]));
  }
  constexpr double rounding = 1e-9;
  if (out.quality < rounding) out.quality = 0;
  return out;
}

}  // namespace cnctrans::interpreter
