// A chain of three threads on one line of crest points, by a number of passes.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ir/cycles/turning_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

constexpr std::size_t segments = 3;

struct Link {
  std::string_view x, z, pitch;
};
/// The corner points, each with the pitch of the thread that begins there.
constexpr std::array points = {Link{"x", "z", "pitch"}, Link{"x_2", "z_2", "pitch_2"}, Link{"x_3", "z_3", "pitch_3"},
                               Link{"x_end", "z_end", ""}};

/// The crest at q on the line through two points.
double crest(RolePoint a, RolePoint b, double q) {
  return a.p + (q - a.q) * (b.p - a.p) / (b.q - a.q);
}

}  // namespace

/// Passes, clearance and flank as in counted_thread(); the synchronous moves of a pass follow each other.
bool chained_thread(Roles& r, std::string* error) {
  std::array<RolePoint, segments + 1> at;
  for (std::size_t k = 0; k < at.size(); ++k) at[k] = r.point(points[k].x, points[k].z);
  const double dir = sign(at[1].q - at[0].q);
  for (std::size_t k = 0; k < segments; ++k) {
    if (dir * (at[k + 1].q - at[k].q) < tiny)
      return *error = "the points of the thread chain do not follow each other along its axis", false;
    if (std::abs(r.number(points[k].pitch)) < tiny) return *error = "the thread has no pitch", false;
  }
  const double depth = std::abs(r.number("depth")), stock = std::abs(r.number("finish_stock"));
  const double count = std::round(r.number("passes")), idle = std::round(r.number("idle"));
  const int variant = static_cast<int>(std::clamp(r.number("variant"), -1.0, 1e6));
  if (depth < tiny || stock > depth) return *error = "the thread has no depth", false;
  if (count < 0 || count > most_thread_passes || idle < 0 || idle > most_thread_passes ||
      (count < 1 && stock < depth - tiny))
    return *error = "the number of passes of the thread makes no sense", false;
  if (variant < 1 || variant > 4) return *error = "this way of cutting a thread is not carried out", false;
  const double out = variant % 2 == 0 ? -1 : 1;
  const double from = at[0].q - dir * r.number("run_in"), to = at[3].q + dir * r.number("run_out");
  const double lift = r.number("withdrawal") != 0 ? std::abs(r.number("withdrawal")) : 1;
  double clear = out * std::max(out * crest(at[0], at[1], from), out * crest(at[2], at[3], to));
  for (const RolePoint& t : at) clear = out * std::max(out * clear, out * t.p);
  clear += out * lift;
  std::vector<double> list;
  for (double i = 1; i <= count; ++i)
    list.push_back((depth - stock) * (variant > 2 ? std::sqrt(i / count) : i / count));
  if (stock > tiny || list.empty()) list.push_back(depth);
  for (double i = 0; i < idle; ++i) list.push_back(depth);
  const double angle = r.number("infeed_angle");
  const double starts = std::clamp(std::round(r.number("starts")), 1.0, 1000.0);
  r.rapid({clear, from});
  for (double k = 0; k < starts; ++k) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const double h = list[i], q = from + dir * flank_shift(angle, depth, h, i % 2 == 1);
      r.rapid({crest(at[0], at[1], q) - out * h, q});
      for (std::size_t n = 0; n < segments; ++n) {
        RolePoint end = at[n + 1];
        if (n + 1 == segments) end = {crest(at[n], at[n + 1], to), to};
        if (TurnMove* m = r.thread({end.p - out * h, end.q})) {
          m->pitch = std::abs(r.number(points[n].pitch));
          m->start_angle = r.number("start_angle") + 360 * k / starts;
        }
      }
      r.rapid({clear, to});
      r.rapid({clear, from});
    }
  }
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
