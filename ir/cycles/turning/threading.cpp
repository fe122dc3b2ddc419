// Threads of a lathe: infeeds, entries, exits, several starts.
#include <algorithm>

#include "base/saturate.h"
#include "ir/cycles/turning_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

struct Thread {
  RolePoint first, last;
  double out = 1;  ///< sign of p away from the work
  double dir = 1;  ///< sense of the thread along q
  double depth = 0, clearance = 0, pitch = 0, tan_angle = 0;
  int entry = 1;  ///< 0 radial, 1 first flank, 2 centre and first, 3 last flank, 4 centre and last, 5 both
};

/// Depth after each pass: B * sqrt(n) growing by at least E, or n * |B|; the finishing pass last.
bool depths(const Roles& r, double depth, std::vector<double>& out, std::string* error) {
  constexpr std::size_t most = 10'000;
  const double b = r.number("infeed"), least = r.number("minimum_infeed");
  const double stock = std::abs(r.number("finish_stock")), rough = depth - stock;
  if (std::abs(b) < tiny) return *error = "the infeed of the thread is zero", false;
  double d = 0;
  while (rough > tiny && d < rough - tiny && out.size() < most) {
    const double k = static_cast<double>(out.size() + 1);
    d = std::min(rough, b > 0 ? std::max(b * std::sqrt(k), d + least) : k * -b);
    out.push_back(d);
  }
  if (stock > tiny) {
    out.push_back(depth);
  } else if (r.has("finish_stock") && !out.empty()) {
    out.push_back(out.back());
  }
  return true;
}

/// The entry by H, or by the sign of A.
int entry_of(const Roles& r) {
  if (r.has("entry")) return saturate<int>(r.number("entry"));
  const double a = r.number("infeed_angle", 30);
  return a == 0 ? 0 : a > 0 ? 1 : 2;
}

double shift(const Thread& t, double d, bool odd) {
  const double s = -t.dir * (t.depth - d) * t.tan_angle;
  switch (t.entry) {
    case 1: return s;
    case 2: return odd ? s : 0;
    case 3: return -s;
    case 4: return odd ? -s : 0;
    case 5: return odd ? -s : s;
    default: return 0;
  }
}

void cut(Roles& r, const Thread& t, double d, double s, double angle, double change) {
  const double exit = r.number("exit");
  const auto on = [&](double q) {  // the flank line at depth d
    const double part = (q - t.first.q) / (t.last.q - t.first.q);
    return RolePoint{t.first.p + part * (t.last.p - t.first.p) - t.out * d, q};
  };
  const RolePoint safe_start{t.first.p + t.out * t.clearance, t.first.q};
  const RolePoint safe_end{t.last.p + t.out * t.clearance, t.last.q};
  r.rapid(safe_start);
  r.rapid({t.first.p - t.out * d, t.first.q + s});
  const auto threaded = [&](RolePoint to) {
    if (TurnMove* m = r.thread(to)) {
      m->pitch = t.pitch;
      m->start_angle = angle;
      m->pitch_change = change;
    }
  };
  if (exit > 0) {
    threaded(on(t.last.q - t.dir * exit));
    threaded(safe_end);
  } else {
    threaded(on(t.last.q));
    r.rapid(safe_end);
  }
  r.rapid(safe_start);
}

}  // namespace

bool thread(Roles& r, std::string* error) {
  Thread t;
  t.first = r.point("x", "z");
  t.last = r.point("x_end", "z_end");
  const double depth = r.number("depth"), pitch = r.number("pitch");
  t.out = sign(depth);
  t.dir = sign(t.last.q - t.first.q);
  t.depth = std::abs(depth);
  t.clearance = std::abs(r.number("clearance"));
  t.tan_angle = std::tan(std::abs(r.number("infeed_angle", 30)) * std::acos(-1.0) / 180);
  t.entry = entry_of(r);
  const double length = std::abs(t.last.q - t.first.q);
  if (t.depth < tiny) return *error = "the thread has no depth", false;
  if (length < tiny) return *error = "the thread has no length", false;
  if (std::abs(pitch) < tiny) return *error = "the thread has no pitch", false;
  if (t.entry < 0 || t.entry > 5) return *error = "the kind of entry of the thread is 0 to 5", false;
  if (r.has("measured") || r.has("measured_x") || r.number("repair") != 0)
    return *error = "repairing a thread needs the machine; it is not carried out", false;
  if (std::abs(r.number("exit")) > length - tiny) return *error = "the exit is longer than the thread", false;
  // A positive pitch counts along the slope, a negative one along the axis.
  t.pitch = pitch < 0 ? -pitch : pitch * length / std::hypot(length, t.last.p - t.first.p);
  std::vector<double> list;
  if (!depths(r, t.depth, list, error)) return false;
  const double starts = std::clamp(std::round(r.number("starts")), 1.0, 1000.0);
  for (std::size_t k = 0; k < list.size(); ++k) {
    for (double v = 0; v < starts; ++v) {
      cut(r, t, list[k], shift(t, list[k], k % 2 == 1), r.number("start_angle") + 360 * v / starts,
          r.number("pitch_change"));
    }
  }
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
