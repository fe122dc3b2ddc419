#include "machine/turning_tool.h"

#include <algorithm>

namespace cnctrans::machine {

void tell_tool(const Profile& profile, std::optional<std::int32_t> number, ir::cycles::TurnContext& out) {
  out.edge_at_plus = profile.option("cycle.groove_edge") == "plus";
  out.usual_relief = profile.option("cycle.relief_edge") != "refused";
  const std::string left = profile.option("cycle.face_groove_left");
  if (left == "larger_x" || left == "smaller_x") out.left_is_larger = left == "larger_x";
  const auto& tools = profile.tools;
  const auto tool = std::find_if(tools.begin(), tools.end(), [&](const auto& t) { return t.number == number; });
  if (tool == tools.end()) return;
  out.nose_width = tool->nose_width;
  out.nose_radius = tool->radius;
  out.edge = tool->nose;
  if (tool->length != tool->length_x) out.longer_in_x = tool->length_x > tool->length;
}

}  // namespace cnctrans::machine
