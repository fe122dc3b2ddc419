#include "machine/cycle_context.h"

#include <algorithm>

namespace cnctrans::machine {

void tell_tool(const Profile& profile, std::optional<std::int32_t> number, ir::cycles::TurnContext& out) {
  const Policies& policies = profile.policies;
  out.edge_at_plus = policies.cycle_groove_edge == CycleGrooveEdge::plus;
  out.usual_relief = policies.cycle_relief_edge != CycleReliefEdge::refused;
  const auto left = policies.cycle_face_groove_left;
  if (left != CycleFaceGrooveLeft::unknown) out.left_is_larger = left == CycleFaceGrooveLeft::larger_x;
  out.choices.part_at_plus = policies.cycle_parting_part != CyclePartingPart::minus;
  out.choices.parting_by_mode = policies.cycle_parting_speed == CyclePartingSpeed::by_mode;
  out.choices.parting_stays = policies.cycle_parting_retract == CyclePartingRetract::by_variant;
  out.choices.parting_restores = policies.cycle_parting_after == CyclePartingAfter::restored;
  const auto depth = policies.cycle_groove_depth;
  if (depth == CycleGrooveDepth::absolute) out.choices.groove_depth = ir::cycles::GrooveDepth::absolute;
  if (depth == CycleGrooveDepth::increment) out.choices.groove_depth = ir::cycles::GrooveDepth::increment;
  out.choices.groove_mirrored = policies.cycle_groove_position == CycleGroovePosition::mirrored;
  out.choices.groove_dwell = policies.cycle_groove_dwell;
  const auto& tools = profile.tools;
  const auto tool = std::find_if(tools.begin(), tools.end(), [&](const auto& t) { return t.number == number; });
  if (tool == tools.end()) return;
  out.nose_width = tool->nose_width;
  out.nose_radius = tool->radius;
  out.edge = tool->nose;
  if (tool->length != tool->length_x) out.longer_in_x = tool->length_x > tool->length;
}

void tell_pocket(const Policies& policies, ir::cycles::MillContext& out) {
  out.tolerance = std::clamp(policies.cycle_pocket_tolerance, 1e-5, 0.1);
  out.links_at_depth = policies.cycle_pocket_links == CyclePocketLinks::at_depth;
  out.entry_on_arc = policies.cycle_pocket_entry == CyclePocketEntry::arc;
}

}  // namespace cnctrans::machine
