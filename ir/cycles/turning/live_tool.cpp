// Drilling in pecks, and the cycles of a driven tool: holes and keys around the work, the spindle held.
#include <algorithm>

#include "ir/cycles/turning_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

constexpr int most_pecks = 100'000;
constexpr double most_places = 10'000;

void tap(Roles& r, const Hole& hole, double speed, bool rigid) {
  const auto threaded = [&](double p) {
    if (TurnMove* m = r.thread({p, hole.q})) {
      m->per_minute = true;
      m->speed = speed;
    }
  };
  threaded(hole.surface - hole.depth);
  if (!rigid) r.act(TurnStep::live_run).speed = -speed;
  threaded(hole.start);
}

void key(Roles& r, const Hole& hole, double length, double feed) {
  const double bottom = hole.surface - hole.depth, end = hole.q - length;
  r.feed_per_minute({bottom, hole.q});
  r.feed_per_minute({bottom, end}, feed);
  r.rapid({hole.start, end});
  r.rapid({hole.start, hole.q});
}

}  // namespace

bool hole_of(const Roles& r, Hole& hole, std::string* error) {
  const RolePoint surface = r.point("x", "z");
  hole.surface = surface.p;
  hole.q = surface.q;
  hole.depth = r.number("depth");
  hole.peck = r.number("peck");
  if (std::abs(hole.depth) < tiny) return *error = "the hole has no depth", false;
  if (hole.peck < 0) return *error = "the peck of the cycle is negative", false;
  hole.start = surface.p + sign(hole.depth) * std::abs(r.number("clearance"));
  return true;
}

void pecks(Roles& r, const Hole& hole, bool per_minute) {
  const double g = -sign(hole.depth);
  const auto above = [&](double p) { return g * p < g * hole.start ? hole.start : p; };
  double factor = r.number("factor");
  if (factor == 0) factor = 1;
  const double least = factor == 1 ? 0 : r.number("minimum_peck"), lift = std::abs(r.number("lift"));
  const double gap = std::abs(r.number("reapproach", 1));
  double p = hole.surface, rest = std::abs(hole.depth), next = hole.peck;
  for (int count = 0; rest > tiny && count < most_pecks; ++count) {
    double size = std::min(std::max(next, least), rest);
    if (size < tiny || rest - size < tiny) size = rest;
    if (count > 0) {
      r.rapid({lift > 0 ? above(p - g * lift) : hole.start, hole.q});
      r.rapid({above(p - g * gap), hole.q});
    }
    p += g * size;
    rest -= size;
    next *= factor;
    if (per_minute)
      r.feed_per_minute({p, hole.q});
    else
      r.feed({p, hole.q});
  }
  r.dwell(r.number("dwell"));
  r.rapid({hole.start, hole.q});
}

bool live_tool(Roles& r, bool is_key, std::string* error) {
  Hole hole;
  if (!hole_of(r, hole, error)) return false;
  const double count = r.number("count"), speed = r.number("live_speed"), length = r.number("length");
  if (count < 1 || count != std::floor(count) || count > most_places)
    return *error = "the number of operations of the cycle is not a whole number from 1", false;
  if (std::abs(speed) < tiny) return *error = "the driven tool has no speed", false;
  if (is_key && std::abs(length) < tiny) return *error = "the key has no length", false;
  const bool taps = !is_key && hole.peck < tiny, rigid = taps && r.number("factor") != 0;
  r.rapid({hole.start, hole.q});
  if (!rigid) r.act(TurnStep::live_run).speed = speed;
  for (double k = 0; k < count; ++k) {
    if (k > 0 && taps && !rigid) r.act(TurnStep::live_run).speed = speed;
    r.act(TurnStep::spindle_orient).start_angle = r.number("first_angle") + k * r.number("angle_step");
    if (is_key)
      key(r, hole, length, r.number("mill_feed"));
    else if (taps)
      tap(r, hole, speed, rigid);
    else
      pecks(r, hole, true);
  }
  r.act(TurnStep::live_stop);
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
