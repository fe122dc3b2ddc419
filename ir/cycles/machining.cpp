#include "ir/cycles/machining.h"

#include <algorithm>
#include <array>

#include "ir/cycles/turning_moves.h"

namespace cnctrans::ir::cycles {

namespace {

constexpr std::array parameters = {
    Parameter{"x", Quantity::cross},
    Parameter{"x_end", Quantity::cross},
    Parameter{"z", Quantity::along},
    Parameter{"z_end", Quantity::along},
    Parameter{"measured", Quantity::along},
    Parameter{"measured_x", Quantity::cross},
    Parameter{"centre_x", Quantity::length},
    Parameter{"centre_z", Quantity::length},
    Parameter{"step", Quantity::length},
    Parameter{"withdrawal", Quantity::length},
    Parameter{"stock_x", Quantity::length},
    Parameter{"stock_z", Quantity::length},
    Parameter{"total", Quantity::length},
    Parameter{"section", Quantity::length},
    Parameter{"depth", Quantity::length},
    Parameter{"infeed", Quantity::length},
    Parameter{"minimum_infeed", Quantity::length},
    Parameter{"clearance", Quantity::length},
    Parameter{"finish_stock", Quantity::length},
    Parameter{"pitch", Quantity::length},
    Parameter{"pitch_change", Quantity::length},
    Parameter{"exit", Quantity::length},
    Parameter{"peck", Quantity::length},
    Parameter{"minimum_peck", Quantity::length},
    Parameter{"lift", Quantity::length},
    Parameter{"reapproach", Quantity::length},
    Parameter{"length", Quantity::length},
    Parameter{"rough_feed", Quantity::feed},
    Parameter{"finish_feed", Quantity::feed},
    Parameter{"groove_feed", Quantity::feed},
    Parameter{"mill_feed", Quantity::feed},
    Parameter{"dwell", Quantity::centiseconds},
    Parameter{"infeed_angle", Quantity::plain},
    Parameter{"start_angle", Quantity::plain},
    Parameter{"first_angle", Quantity::plain},
    Parameter{"angle_step", Quantity::plain},
    Parameter{"count", Quantity::plain},
    Parameter{"starts", Quantity::plain},
    Parameter{"entry", Quantity::plain},
    Parameter{"repair", Quantity::plain},
    Parameter{"factor", Quantity::plain},
    Parameter{"main_axis", Quantity::plain},
    Parameter{"first_label", Quantity::plain},
    Parameter{"last_label", Quantity::plain},
    Parameter{"program", Quantity::plain},
    Parameter{"live_speed", Quantity::plain},
};

using Kind = MachiningKind;
constexpr std::array cycles = {
    MachiningCycle{"turn.copy", Kind::copy, false, true, true},
    MachiningCycle{"turn.profile", Kind::profile, false, true, true},
    MachiningCycle{"face.profile", Kind::profile, true, true, true},
    MachiningCycle{"turn.straight", Kind::straight, false, false, false},
    MachiningCycle{"face.straight", Kind::straight, true, false, false},
    MachiningCycle{"turn.arc", Kind::arc, false, false, false},
    MachiningCycle{"face.arc", Kind::arc, true, false, false},
    MachiningCycle{"turn.drill", Kind::drill, true, true, false},
    MachiningCycle{"turn.thread", Kind::thread, false, true, false},
    MachiningCycle{"face.thread", Kind::thread, true, true, false},
    MachiningCycle{"turn.groove", Kind::groove, false, true, false},
    MachiningCycle{"face.groove", Kind::groove, true, true, false},
    MachiningCycle{"face.live_drill", Kind::live_drill, true, true, false},
    MachiningCycle{"side.live_drill", Kind::live_drill, false, true, false},
    MachiningCycle{"side.live_key", Kind::live_key, false, true, false},
    MachiningCycle{"face.live_key", Kind::live_key, true, true, false},
};

template <class Table>
auto find(const Table& table, std::string_view name) -> decltype(table.data()) {
  const auto it = std::find_if(table.begin(), table.end(), [name](const auto& row) { return row.name == name; });
  return it == table.end() ? nullptr : &*it;
}

}  // namespace

const Parameter* find_parameter(std::string_view name) {
  return find(parameters, name);
}
const MachiningCycle* find_machining(std::string_view name) {
  return find(cycles, name);
}

std::optional<std::vector<TurnMove>> expand(const MachiningCycle& cycle, const TurnNumbers& numbers,
                                            const TurnContext& context, std::string* error) {
  error->clear();
  detail::Roles roles(cycle, numbers, context);
  bool done = false;
  switch (cycle.kind) {
    case Kind::straight:
    case Kind::arc: done = detail::straight_or_arc(cycle.kind == Kind::arc, roles, error); break;
    case Kind::drill: done = detail::axial_drill(roles, error); break;
    case Kind::thread: done = detail::thread(roles, error); break;
    case Kind::groove: done = detail::groove(roles, context.nose_width, error); break;
    case Kind::profile:
    case Kind::copy:
    case Kind::live_drill:
    case Kind::live_key:
      *error = "the cycle " + std::string(cycle.name) + " is read and kept, not carried out yet";
      break;
  }
  if (!done) return std::nullopt;
  return roles.take();
}

}  // namespace cnctrans::ir::cycles
