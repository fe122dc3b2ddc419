// The look at a block in a stream: would some pass touch it? One switch per action, nothing allocated.
#include <algorithm>

#include "legaliser/edit/blocks.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir {

namespace {

bool plain_motion(const Motion& m, const Capabilities& target) {
  if (target.motions.count(m.kind) == 0 || m.extra) return false;
  if (m.frame != FrameUse::normal && target.frame_uses.count(m.frame) == 0) return false;
  for (const auto& c : m.coords) {
    if (!c.value.literal() || c.direction != RotaryDirection::as_value) return false;
    if (c.mode != WordMode::modal && !target.distance_per_word) return false;
    if (c.scale != WordScale::modal) return false;
  }
  for (const auto& c : m.centers) {
    if (!c.value.literal() || target.centers.count(c.mode) == 0) return false;
  }
  if (m.radius_given) {
    if (!m.radius.literal()) return false;
    return m.radius.number < 0 ? target.radius_major : target.radius_minor;
  }
  return true;
}

struct PlainAction {
  const Capabilities& target;
  const machine::Profile* machine;  ///< null: not known
  const Block& block;
  const Action& action;
  bool moving;

  /// The only change between absolute and incremental words of its block, and before them.
  [[nodiscard]] bool one_distance() const {
    std::size_t count = 0;
    for (const auto& a : block.actions) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      count += m != nullptr && m->setting == Setting::distance ? 1U : 0U;
    }
    if (!target.distance_inside_block || !block.has_motion) return count == 1;
    return count == 1 && std::none_of(block.motion.coords.begin(), block.motion.coords.end(),
                                      [this](const CoordWord& c) { return c.pos.column < action.pos.column; });
  }
  [[nodiscard]] bool has_feed() const {
    for (const auto& a : block.actions) {
      if (std::holds_alternative<SetFeed>(a.data)) return true;
    }
    return false;
  }
  /// An event beside a motion: before or after it as on the target machine.
  [[nodiscard]] bool event() const {
    if (!moving) return true;
    if (machine == nullptr) return false;
    return (passes::target_order(action, *machine) == Order::after) == (action.order == Order::after);
  }

  bool operator()(const ModalSet& s) const {
    if (moving && action.order == Order::after) return false;
    switch (s.setting) {
      case Setting::units: return s.feed_too ? target.units_with_feed : target.units_geometry_only;
      case Setting::diameter:
        return target.diameter_switch &&
               (s.value != static_cast<std::uint8_t>(DiameterMode::absolute_only) || target.diameter_absolute_only);
      case Setting::feed_mode:
        if (s.value == static_cast<std::uint8_t>(FeedMode::inverse_time) && !target.inverse_time) return false;
        return s.feed_memory == target.feed_memory || has_feed();
      case Setting::path_mode: return target.exact_stop_modal;
      case Setting::length_comp: return target.length_comp_switch;
      case Setting::retract_plane: return target.retract_plane_switch;
      case Setting::feed_point: return target.feed_point_switch;
      case Setting::feed_override: return target.feed_override_switch;
      case Setting::spline_start:
      case Setting::spline_end:
      case Setting::path_reference:
      case Setting::polynomial_axes:
      case Setting::surface: return false;
      case Setting::distance: return one_distance();
      case Setting::plane:
      case Setting::spindle_mode:
      case Setting::comp:
      case Setting::count_: return true;
    }
    return false;
  }
  bool operator()(const SetFeed& f) const { return f.value.literal() && !(f.zero_is_maximum && f.value.number == 0); }
  bool operator()(const SetSpindle& s) const { return s.value.literal(); }
  bool operator()(const SpindleRun&) const { return event(); }
  bool operator()(const SpindleGear& g) const { return g.number == 1 && !g.automatic && event(); }
  bool operator()(const MasterSpindle&) const { return false; }
  bool operator()(const SpindleLimit& s) const { return s.value.literal() && target.spindle_limit; }
  bool operator()(const Coolant&) const { return event(); }
  bool operator()(const MachineFunction& m) const { return event() && !m.computed && m.value.literal(); }
  bool operator()(const Stop&) const { return true; }
  bool operator()(const ToolOffset& o) const { return o.number.literal(); }
  bool operator()(const WorkOffset& w) const {
    if (w.off) return target.work_offset_off;
    return w.index.literal() && w.index.number <= target.work_offset_rows;
  }
  bool operator()(const ExactStopBlock&) const { return target.exact_stop_block; }
  bool operator()(const CycleCancel&) const { return true; }
  template <class Other>
  bool operator()(const Other&) const {
    return false;
  }
};

}  // namespace

bool plain_legal(const Block& block, const Capabilities& target, const machine::Profile* machine) {
  if (block.repeat_given != 0) return false;
  const bool moving = block.has_motion && block.motion.moves();
  if (block.has_motion && !plain_motion(block.motion, target)) return false;
  std::size_t runs = 0;
  for (const auto& a : block.actions) {
    if (std::holds_alternative<SpindleRun>(a.data) && ++runs > 1) return false;
    if (!std::visit(PlainAction{target, machine, block, a, moving}, a.data)) return false;
    if (target.own_block && (moving || block.actions.size() > 1) && target.own_block(a)) return false;
  }
  return true;
}

}  // namespace cnctrans::ir
