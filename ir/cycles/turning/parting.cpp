// Parting off (operating manual turning, CYCLE92): the edge of the part, down at the feed to the depth from which feed
// and speed are less, on to the final depth, and back.
#include <algorithm>

#include "base/saturate.h"
#include "ir/cycles/turning/groove_shape.h"

namespace cnctrans::ir::cycles::detail {

namespace {

/// A word that holds one decision a digit.
struct Digits {
  std::int64_t value = 0;
  [[nodiscard]] int at(int place) const {
    std::int64_t v = value;
    for (; place > 0; --place) v /= 10;
    return static_cast<int>(v % 10);
  }
};

/// How the spindle turns down to the depth of change.
bool first_speed(Roles& r, const TurnContext& context, bool by_mode, std::string* error) {
  const double speed = r.number("first_speed"), limit = r.number("speed_limit");
  const bool constant_cut = by_mode || (!context.choices.parting_by_mode && limit > 0);
  const auto sense = saturate<int>(r.number("sense"));
  if (speed < 0 || limit < 0) return *error = "a spindle speed is not negative", false;
  if (sense != 0 && sense != 3 && sense != 4) return *error = "the sense of the spindle is 3 or 4", false;
  if (speed == 0 && sense == 0) return true;
  if (speed == 0) return *error = "parting off needs the speed for the sense of its spindle", false;
  TurnMove& m = r.act(constant_cut ? TurnStep::spindle_cutting_speed : TurnStep::spindle_speed);
  m.speed = speed;
  m.limit = constant_cut ? limit : 0;
  m.sense = sense == 3 ? 1 : sense == 4 ? -1 : 0;
  if (constant_cut && r.number("second_speed") == 0)
    return *error = "parting off at a cutting speed without a speed behind it is not carried out", false;
  return true;
}

}  // namespace

bool part_off(Roles& r, const TurnContext& context, std::string* error) {
  const Digits variant{saturate<std::int64_t>(std::abs(r.number("variant")))};
  const Digits mode{saturate<std::int64_t>(std::abs(r.number("mode")))};
  if (variant.value > 1) return *error = "parting off with a part catcher is not carried out", false;
  if (mode.at(0) > 1 || mode.at(1) > 1 || mode.at(2) > 1 || mode.at(3) > 1 || mode.value > 9999)
    return *error = "this mode of parting off is not carried out", false;
  const double surface = r.number("nominal") / 2, lift = std::abs(r.number("clearance"));
  const auto down = [&](std::string_view name, bool increment) {
    return increment ? std::abs(r.number(name)) : surface - r.number(name) / 2;
  };
  const double last = down("depth", mode.at(1) == 1);
  double change = down("change_depth", mode.at(0) == 1);
  const double reduced = std::abs(r.number("finish_feed")), second = r.number("second_speed");
  if (surface < tiny || last < tiny) return *error = "parting off has no depth", false;
  if (second < 0) return *error = "a spindle speed is not negative", false;
  const bool changes = reduced > 0 || second > 0;
  if (change > last - tiny && changes)
    return *error = "the depth from which feed and speed are less lies below the final depth", false;
  if (!changes) change = last;
  const double edge = std::abs(r.number("outer_1"));
  if (change < edge + context.nose_radius - tiny)
    return *error = "the depth of the change lies within the edge of the part", false;

  const double into = context.choices.part_at_plus ? -1 : 1;
  Insert tool(r, {surface, r.number("z")}, 1, into, context, false);
  if (tool.shifted_by_width() && tool.width() <= 0)
    return *error = "the width of the grooving tool is not known: \"nose_width\" of the tool in the profile", false;
  const bool chamfer = mode.at(2) == 1 || r.number("outer_1") < 0;
  Chain side;
  corner_element(side, {0, 0}, {0, -1}, {-1, 0}, chamfer ? -edge : edge, edge);
  side.push_back({{-edge, 0}, {-last - tool.radius() - 1, 0}, false, false, {}});
  const auto path = offset(side, tool.radius(), error);
  if (!path || path->empty()) return false;
  const RolePoint first = path->front().a;
  const double u = -(first.q + tool.radius());
  tool.approach(lift, u, false);
  if (!first_speed(r, context, mode.at(3) == 1, error)) return false;
  tool.feed_rate(std::abs(r.number("rough_feed")));
  if (path->size() > 1) tool.feed(first.p - tool.radius(), u);
  for (std::size_t k = 0; k + 1 < path->size(); ++k) tool.piece((*path)[k], false, 0);
  tool.feed(-change, 0);
  if (second > 0) {
    TurnMove& m = r.act(TurnStep::spindle_speed);
    m.speed = second;
  }
  if (reduced > 0) tool.feed_rate(reduced);
  tool.feed(-last, 0);
  if (variant.at(0) == 0 || !context.choices.parting_stays) tool.rapid(lift, 0);
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
