// A thread by a single point on a mill: synchronous passes along the tool axis.
#include <algorithm>
#include <array>
#include <cmath>

#include "ir/cycles/milling/mill_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

constexpr double aside = 2;  ///< mm, of the oriented point from the wall
constexpr double most_mill_passes = 10'000;

struct Way {
  double p, q;
};
constexpr std::array<Way, 5> ways{{{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// From the bottom to the reference plane, over the middle. `start`: the angle at which the pass began up there.
void withdraw(MillPath& path, int back, double pitch, double degrees, double start) {
  const auto& n = path.levels();
  if (back == 2) {  // in the groove: by as many turns as the pass has made
    const double turns = std::abs(n.reference - n.bottom) / pitch;
    path.spindle(MillStep::reverse);
    path.thread_to(n.reference, pitch, std::remainder(start + 360 * turns, 360));
    path.spindle(MillStep::restart);
    path.rapid(0, 0);
    return;
  }
  if (back == 0) {
    const auto [p, q] = path.local();
    path.spindle(MillStep::orient, degrees);
    path.rapid(p + aside * std::cos(degrees * radians), q + aside * std::sin(degrees * radians));
  } else {
    path.rapid(0, 0);
  }
  path.rapid_to(n.reference);
  path.rapid(0, 0);
  if (back == 0) path.spindle(MillStep::restart);
}

}  // namespace

void MillPath::thread_to(double w, double pitch, double degrees) {
  if (std::abs(w - w_) < least_mm) return;
  put(MillStep::thread, u_, v_, w, false);
  moves_.back().amount = pitch;
  moves_.back().angle = degrees;
}

void MillPath::spindle(MillStep step, double degrees) {
  MillMove m;
  m.step = step;
  m.u = u_;
  m.v = v_;
  m.w = w_;
  m.angle = degrees;
  moves_.push_back(m);
}

/// Passes of equal section to the depth without the last pass, then the last one, as for the thread of a lathe.
bool chased_thread(MillPath& path, std::string* error) {
  const auto& n = path.levels();
  const double pitch = std::abs(path.get("pitch")), depth = std::abs(path.get("depth"));
  const double last = std::abs(path.get("last_pass")), passes = std::max(1.0, std::round(path.get("passes", 1)));
  const double starts = std::clamp(std::round(path.get("starts", 1)), 1.0, 1000.0);
  const double radial = path.get("radial"), back = path.get("back");
  if (pitch < least_mm) return *error = "the thread has no pitch", false;
  if (depth < least_mm || last > depth + least_mm) return *error = "the thread has no depth", false;
  if (std::abs(n.reference - n.bottom) < least_mm) return *error = "the thread has no length", false;
  if (passes > most_mill_passes) return *error = "the number of passes of the thread makes no sense", false;
  if (radial < 0 || radial > 4 || back < 0 || back > 2)
    return *error = "this way of cutting a thread is not carried out", false;
  const Way out = ways[static_cast<std::size_t>(radial)];
  const auto [u, v] = path.place();
  path.frame(u, v, 0);
  path.approach(0, 0);
  for (double k = 0; k < starts; ++k) {
    for (double i = 1; i <= passes; ++i) {
      const double d = i < passes ? (depth - last) * std::sqrt(i / (passes - 1)) : depth;
      path.rapid(out.p * d, out.q * d);
      path.thread_to(n.bottom, pitch, 360 * k / starts);
      withdraw(path, static_cast<int>(back), pitch, path.get("angle"), 360 * k / starts);
    }
  }
  path.retract();
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
