// Which offset a tool has, and which axes stand where it brings them.
#include "interpreter/machine/block_machine.h"

namespace cnctrans::interpreter {

void BlockMachine::select_offset() {
  offset_use_ = offset_ == 0 ? OffsetUse::none : OffsetUse::some;
  bare_tool_ = offset_of_machine_ = false;
}

/// `own`: a D stands beside the T.
void BlockMachine::offset_of_selected(bool own) {
  bare_tool_ = !own;
}

/// What the change makes of the offset. `own`: a D stands in its block and counts.
void BlockMachine::offset_of_change(bool own) {
  if (own || (!policy_.table_offset && !policy_.edge_offset)) return;  // the one in force stays
  if (tool_ == 0 && tool_name_.empty()) {                              // out of the spindle: the machine's own rule
    offset_use_ = policy_.edge_offset ? OffsetUse::none : OffsetUse::open;
  } else if (bare_tool_) {
    offset_use_ = OffsetUse::some;
    offset_of_machine_ = true;
  } else if (policy_.edge_offset && offset_use_ == OffsetUse::none) {
    offset_use_ = OffsetUse::open;  // D0 between T and change: machine data say whether it outlasts the change
  }
}

/// The axes that move take the offset in force with them, the others stand as they stood. On a mill the length acts
/// along the tool, and the radius in the plane under compensation; on a lathe both act on all axes.
void BlockMachine::put_offset(Event& e, std::uint32_t moved) const {
  auto& o = e.offset;
  for (auto* of_axes : {&o.known, &o.with, &o.switched_off, &o.unsaid, &o.of_start, &o.selected, &o.elsewhere})
    *of_axes &= ~moved;
  if (e.in_machine) return;  // whether the length counts there differs from function to function
  const bool off = modal_.length_comp == ir::OnOff::off;
  if (offset_use_ == OffsetUse::open) o.of_start |= moved;
  if (offset_use_ == OffsetUse::some && !offset_of_machine_) o.selected |= moved;
  std::uint32_t length = 7, radius = 0;
  if (policy_.mill) {
    const auto plane = ir::plane_axes(modal_.plane);
    const bool usual = modal_.plane == profile_.power_on.plane;  // elsewhere the axis of the length may differ: TRN-523
    length = usual ? 1U << plane.w : 0U;
    if (!usual && !off && offset_use_ == OffsetUse::some) o.elsewhere |= moved;
    radius = e.centre_side == ir::CompSide::off ? 0U : 1U << plane.u | 1U << plane.v;
  }
  const auto put = [&](std::uint32_t axes, OffsetUse use, bool unsaid) {
    if (use == OffsetUse::open) return;
    o.known |= axes & moved;
    if (unsaid) o.unsaid |= axes & moved;
    if (use == OffsetUse::some) o.with |= axes & moved;
  };
  put(length, off ? OffsetUse::none : offset_use_, off ? !length_comp_said_ : offset_of_machine_);
  if (off) o.switched_off |= length & moved;
  put(radius & ~length, offset_use_, offset_of_machine_);
}

}  // namespace cnctrans::interpreter
