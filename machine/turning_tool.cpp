#include "machine/turning_tool.h"

#include <algorithm>

#include "base/text.h"

namespace cnctrans::machine {

void tell_tool(const Profile& profile, std::optional<std::int32_t> number, ir::cycles::TurnContext& out) {
  out.edge_at_plus = profile.option("cycle.groove_edge") == "plus";
  out.usual_relief = profile.option("cycle.relief_edge") != "refused";
  const std::string left = profile.option("cycle.face_groove_left");
  if (left == "larger_x" || left == "smaller_x") out.left_is_larger = left == "larger_x";
  out.choices.part_at_plus = profile.option("cycle.parting_part") != "minus";
  out.choices.parting_by_mode = profile.option("cycle.parting_speed") == "by_mode";
  out.choices.parting_stays = profile.option("cycle.parting_retract") == "by_variant";
  const std::string depth = profile.option("cycle.groove_depth");
  if (depth == "absolute") out.choices.groove_depth = ir::cycles::GrooveDepth::absolute;
  if (depth == "increment") out.choices.groove_depth = ir::cycles::GrooveDepth::increment;
  out.choices.groove_mirrored = profile.option("cycle.groove_position") == "mirrored";
  out.choices.groove_dwell = parse_decimal(profile.option("cycle.groove_dwell")).value_or(0);
  const auto& tools = profile.tools;
  const auto tool = std::find_if(tools.begin(), tools.end(), [&](const auto& t) { return t.number == number; });
  if (tool == tools.end()) return;
  out.nose_width = tool->nose_width;
  out.nose_radius = tool->radius;
  out.edge = tool->nose;
  if (tool->length != tool->length_x) out.longer_in_x = tool->length_x > tool->length;
}

}  // namespace cnctrans::machine
