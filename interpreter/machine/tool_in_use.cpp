#include "interpreter/machine/tool_in_use.h"

#include <utility>

namespace cnctrans::interpreter {

ToolInUse::ToolInUse(const machine::Profile& profile)
    : of_table_(profile.policies.tool_bare_offset == machine::ToolBareOffset::table),
      of_edge_(profile.policies.tool_bare_offset == machine::ToolBareOffset::edge),
      mill_(profile.kind == machine::Kind::mill),
      usual_plane_(profile.power_on.plane),
      came_with_t_(profile.policies.tool_change == machine::ToolChange::on_select) {}

void ToolInUse::select(std::int32_t number, std::string name, bool with_t) {
  selected_ = number;
  name_ = std::move(name);
  came_with_t_ = with_t;
}

void ToolInUse::select_offset(std::int32_t number) {
  offset_ = number;
  use_ = number == 0 ? OffsetUse::none : OffsetUse::some;
  bare_ = of_machine_ = false;
}

void ToolInUse::offset_of_change(bool own_offset) {
  if (own_offset || (!of_table_ && !of_edge_)) return;  // the one in force stays
  if (selected_ == 0 && name_.empty()) {                // out of the spindle: the machine's own rule
    use_ = of_edge_ ? OffsetUse::none : OffsetUse::open;
  } else if (bare_) {
    use_ = OffsetUse::some;
    of_machine_ = true;
  } else if (of_edge_ && use_ == OffsetUse::none) {
    use_ = OffsetUse::open;  // D0 between T and change: machine data say whether it outlasts the change
  }
}

void ToolInUse::show(Event& e, bool change) {
  if (change) in_spindle_ = selected_;
  e.number = selected_;
  e.state = came_with_t_ ? "with T" : "";
  e.text = name_;
  e.change = change;
}

void ToolInUse::pretend(std::int32_t number, std::int32_t offset) {
  selected_ = in_spindle_ = number;
  offset_ = offset;
}

void ToolInUse::put_offset(Event& e, std::uint32_t moved, const ir::ModalState& modal) const {
  auto& o = e.offset;
  for (auto* of_axes : {&o.known, &o.with, &o.switched_off, &o.unsaid, &o.of_start, &o.selected, &o.elsewhere})
    *of_axes &= ~moved;
  if (e.in_machine) return;  // whether the length counts there differs from function to function
  const bool off = modal.length_comp == ir::OnOff::off;
  if (use_ == OffsetUse::open) o.of_start |= moved;
  if (use_ == OffsetUse::some && !of_machine_) o.selected |= moved;
  std::uint32_t length = 7, radius = 0;
  if (mill_) {
    const auto plane = ir::plane_axes(modal.plane);
    const bool usual = modal.plane == usual_plane_;  // elsewhere the axis of the length may differ: TRN-523
    length = usual ? 1U << plane.w : 0U;
    if (!usual && !off && use_ == OffsetUse::some) o.elsewhere |= moved;
    radius = e.centre_side == ir::CompSide::off ? 0U : 1U << plane.u | 1U << plane.v;
  }
  const auto put = [&](std::uint32_t axes, OffsetUse use, bool unsaid) {
    if (use == OffsetUse::open) return;
    o.known |= axes & moved;
    if (unsaid) o.unsaid |= axes & moved;
    if (use == OffsetUse::some) o.with |= axes & moved;
  };
  put(length, off ? OffsetUse::none : use_, off ? !length_said_ : of_machine_);
  if (off) o.switched_off |= length & moved;
  put(radius & ~length, use_, of_machine_);
}

}  // namespace cnctrans::interpreter
