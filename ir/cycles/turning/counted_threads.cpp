// Threads given by a number of passes.
#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "ir/cycles/turning_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

/// Metric coarse pitches by the nominal diameter.
struct Nominal {
  double size, pitch;
};
constexpr std::array coarse = {
    Nominal{3, 0.5},   Nominal{4, 0.7},  Nominal{5, 0.8},  Nominal{6, 1},    Nominal{8, 1.25}, Nominal{10, 1.5},
    Nominal{12, 1.75}, Nominal{14, 2},   Nominal{16, 2},   Nominal{18, 2.5}, Nominal{20, 2.5}, Nominal{22, 2.5},
    Nominal{24, 3},    Nominal{27, 3},   Nominal{30, 3.5}, Nominal{33, 3.5}, Nominal{36, 4},   Nominal{39, 4},
    Nominal{42, 4.5},  Nominal{45, 4.5}, Nominal{48, 5},   Nominal{52, 5},   Nominal{56, 5.5}, Nominal{60, 5.5}};

}  // namespace

double coarse_pitch(double size) {
  const auto row = std::find_if(coarse.begin(), coarse.end(), [size](const Nominal& n) { return n.size == size; });
  return row == coarse.end() ? 0 : row->pitch;
}

bool thread_pitch(const TurnNumbers& numbers, double& pitch, std::string* error) {
  const auto number = [&](std::string_view name) {
    const auto it = numbers.find(name);
    return it == numbers.end() ? 0.0 : it->second;
  };
  pitch = std::abs(number("pitch"));
  const double size = number("size");
  if (size == 0) {
    if (pitch < tiny) return *error = "the thread has no pitch", false;
    return true;
  }
  const double usual = coarse_pitch(size);
  if (usual == 0) return *error = "the thread has a size without a coarse pitch", false;
  if (pitch > tiny && std::abs(pitch - usual) > tiny)
    return *error = "the pitch of the thread is not that of its size", false;
  pitch = usual;
  return true;
}

namespace {

double tangent(double degrees) {
  return std::tan(std::abs(degrees) * std::numbers::pi / 180);
}

/// Roughing by equal depths or equal sections, the finishing pass, the idle ones.
std::vector<double> depths(double depth, double stock, double count, double idle, bool equal_sections) {
  std::vector<double> out;
  for (double i = 1; i <= count; ++i)
    out.push_back((depth - stock) * (equal_sections ? std::sqrt(i / count) : i / count));
  if (stock > tiny || out.empty()) out.push_back(depth);
  for (double i = 0; i < idle; ++i) out.push_back(depth);
  return out;
}

void cut(Roles& r, RolePoint to, double pitch, double angle) {
  if (TurnMove* m = r.thread(to)) {
    m->pitch = pitch;
    m->start_angle = angle;
  }
}

}  // namespace

double flank_shift(double degrees, double depth, double h, bool odd) {
  if (degrees >= 0) return h * tangent(degrees);
  return (odd ? 1 : -1) * (depth - h) * tangent(degrees);
}

/// Between two crest points, with run-in and run-out on the same line.
bool counted_thread(Roles& r, std::string* error) {
  const RolePoint first = r.point("x", "z"), last = r.point("x_end", "z_end");
  const double depth = std::abs(r.number("depth")), stock = std::abs(r.number("finish_stock"));
  const double count = std::round(r.number("passes")), idle = std::round(r.number("idle"));
  const int variant = static_cast<int>(std::clamp(r.number("variant"), -1.0, 1e6));
  double pitch = 0;
  if (!thread_pitch(r.numbers(), pitch, error)) return false;
  if (std::abs(last.q - first.q) < tiny) return *error = "the thread has no length", false;
  if (depth < tiny || stock > depth) return *error = "the thread has no depth", false;
  if (count < 0 || count > most_thread_passes || idle < 0 || idle > most_thread_passes ||
      (count < 1 && stock < depth - tiny))
    return *error = "the number of passes of the thread makes no sense", false;
  if (variant < 1 || variant > 4) return *error = "this way of cutting a thread is not carried out", false;
  const bool inside = variant % 2 == 0;
  const double out = inside ? -1 : 1, dir = sign(last.q - first.q);
  const double slope = (last.p - first.p) / (last.q - first.q);
  const double from = first.q - dir * r.number("run_in"), to = last.q + dir * r.number("run_out");
  const auto crest = [&](double q) { return first.p + (q - first.q) * slope; };
  const double lift = r.number("withdrawal") != 0 ? std::abs(r.number("withdrawal")) : 1;
  const double clear = (inside ? std::min(crest(from), crest(to)) : std::max(crest(from), crest(to))) + out * lift;
  const auto list = depths(depth, stock, count, idle, variant > 2);
  const double angle = r.number("infeed_angle");
  const double starts = std::clamp(std::round(r.number("starts")), 1.0, 1000.0);
  r.rapid({clear, from});
  for (double k = 0; k < starts; ++k) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const double h = list[i], q = from + dir * flank_shift(angle, depth, h, i % 2 == 1);
      r.rapid({crest(q) - out * h, q});
      cut(r, {crest(to) - out * h, to}, pitch, r.number("start_angle") + 360 * k / starts);
      r.rapid({clear, to});
      r.rapid({clear, from});
    }
  }
  return true;
}

/// From the place of the call; the end point is the root at full depth.
bool chased_thread(Roles& r, std::string* error) {
  const RolePoint start = r.here();
  RolePoint end = r.point("x_end", "z_end");
  if (!r.has("x_end")) end.p = start.p;
  const double depth = std::abs(r.number("depth")), last = std::abs(r.number("finish_stock"));
  const double passes = std::max(1.0, std::round(r.number("passes", 1))), pitch = std::abs(r.number("pitch"));
  const double exit = std::abs(r.number("exit")), length = std::abs(end.q - start.q), dir = sign(end.q - start.q);
  if (length < tiny) return *error = "the thread has no length", false;
  if (pitch < tiny) return *error = "the thread has no pitch", false;
  if (depth < tiny || last > depth + tiny) return *error = "the thread has no depth", false;
  if (exit > length - tiny) return *error = "the exit is longer than the thread", false;
  if (passes > most_thread_passes) return *error = "the number of passes of the thread makes no sense", false;
  const double out = sign(start.p - end.p), slope = tangent(r.number("cone")) * sign(r.number("cone"));
  // A positive cone opens from the start to the end.
  const auto root = [&](double q) { return end.p - slope * std::abs(end.q - q); };
  if (out * (start.p - root(start.q)) < depth - tiny || out * (start.p - end.p) < depth - tiny)
    return *error = "wrong tool position for the cycle: the tool stands within the thread", false;
  const double flank = tangent(r.number("infeed_angle"));
  const double starts = std::clamp(std::round(r.number("starts", 1)), 1.0, 1000.0);
  for (double k = 0; k < starts; ++k) {
    for (double i = 1; i <= passes; ++i) {
      const double d = i < passes ? (depth - last) * std::sqrt(i / (passes - 1)) : depth;
      const double up = out * (depth - d), q = start.q + dir * d * flank, angle = 360 * k / starts;
      r.rapid({root(q) + up, q});
      if (exit > tiny) {
        const double turn = end.q - dir * exit;
        cut(r, {root(turn) + up, turn}, pitch, angle);
        cut(r, {end.p + up + out * depth, end.q}, pitch, angle);
      } else {
        cut(r, {end.p + up, end.q}, pitch, angle);
      }
      r.rapid({start.p, end.q});
      r.rapid(start);
    }
  }
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
