// CC: centre of arcs and pole, in the plane of the tool and in those along its axis.
#include <algorithm>

#include "frontends/heidenhain/state/lowering.h"
#include "ir/known_number.h"

namespace cnctrans::frontends::heidenhain {

namespace {

/// The plane of two absolute words of which one is the tool axis.
std::optional<ir::Plane> plane_along_tool(const Pole& pole, ir::AxisId tool) {
  if (pole.words.size() != 2 || pole.incremental[0] || pole.incremental[1]) return std::nullopt;
  const ir::AxisId a = pole.words[0].axis, b = pole.words[1].axis;
  if (a == b || (a != tool && b != tool)) return std::nullopt;
  for (const auto plane : {ir::Plane::xy, ir::Plane::zx, ir::Plane::yz}) {
    const ir::AxisId across = ir::plane_axes(plane).w;
    if (across != a && across != b) return plane;
  }
  return std::nullopt;
}

}  // namespace

/// LP about a CC in Z and X, or Y and Z: its angle counts from Z, or from Y (the first axis of that plane).
bool Lowering::polar_in_other_plane(bool straight, bool counts) {
  if (other_pole_ < 0 || !counts) return true;
  const Pole& pole = flat_.poles[static_cast<std::size_t>(other_pole_)];
  const auto axes = ir::plane_axes(*pole.other);
  ir::Motion& m = out_.motion;
  const auto& x = m.extra;
  const bool whole = x && x->has_polar_radius && x->has_polar_angle && x->polar_mode != ir::WordMode::incremental &&
                     x->polar_angle_mode != ir::WordMode::incremental;
  if (!straight || !whole) {
    report_.keep("HEI-008", {},
                 "about a CC along the tool axis LP with PR and PA is carried, arcs and steps of the angle are not",
                 "motion.geometry", "write the points with L");
    return false;
  }
  for (const bool first : {true, false}) {
    ir::CoordWord c;
    c.axis = first ? axes.u : axes.v;
    c.mode = ir::WordMode::absolute;
    const auto wave = first ? ir::Function::cos : ir::Function::sin;
    c.value = ir::add(pole.words[pole.words[0].axis == c.axis ? 0 : 1].value,
                      ir::polar_leg(x->polar_radius, x->polar_angle, wave));
    m.coords.push_back(std::move(c));
  }
  m.extra = nullptr;
  return true;
}

/// CC: centre of arcs and pole.
bool Lowering::pole() {
  Pole pole;
  for (std::size_t i = 1; i < block_->words.size(); ++i) {
    const Word& w = block_->words[i];
    if (remark(w)) break;
    const bool incremental = is_incremental(w.address);
    const ir::AxisId axis = axis_of(incremental ? w.address.substr(1) : w.address);
    if (axis == ir::axis::none || axis > ir::axis::z || !w.has_value) {
      report_.refuse("HEI-002", w.pos, "`" + std::string(slice(w)) + "` means nothing beside CC", {}, "block.word");
      return false;
    }
    ir::FrameWord f;
    f.axis = axis;
    f.value = value(w);
    f.pos = w.pos;
    pole.words.push_back(std::move(f));
    pole.incremental.push_back(incremental);
  }
  if (report_.refused()) return false;
  const ir::AxisId tool = ir::plane_axes(plane_of(tool_axis_)).w;
  if (tool_called_) pole.other = plane_along_tool(pole, tool);
  const bool along = std::any_of(pole.words.begin(), pole.words.end(), [&](const auto& w) { return w.axis == tool; });
  if (tool_called_ && along && !pole.other) {
    report_.keep("HEI-008", {}, "a CC along the tool axis is carried with two absolute words", "motion.geometry",
                 "write the points with L");
    return false;
  }
  flat_.poles.push_back(std::move(pole));
  Item& item = put(ItemKind::pole, ir::Block{});
  item.index = static_cast<int>(flat_.poles.size()) - 1;
  other_pole_ = flat_.poles.back().other ? item.index : -1;
  return true;
}

}  // namespace cnctrans::frontends::heidenhain
