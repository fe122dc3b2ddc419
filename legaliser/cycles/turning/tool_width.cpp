// The width of the grooving tool that a machining cycle works with.
#include <algorithm>

#include "legaliser/cycles/turning/machining_moves.h"
#include "machine/tool_data.h"

namespace cnctrans::ir::passes {

double TurnCycles::nose_width(const TurnState& state, double unit) const {
  const auto& machine = context_.source_machine;
  const double scale = machine.policies.machine_data_units == machine::MachineDataUnits::modal ? unit : 1;
  for (const std::string& name : machine::tool_data_names(machine.policies.tool_width_data, state.tool, state.offset)) {
    const auto stem = name.find('*') == std::string::npos ? std::string() : name.substr(0, name.find_first_of("[*"));
    const auto of_some_tool = [&stem](const auto& item) { return !stem.empty() && item.first.starts_with(stem); };
    if (std::any_of(written_.begin(), written_.end(), of_some_tool)) return 0;
    if (const auto it = written_.find(name); it != written_.end()) return it->second ? *it->second * scale : 0;
    if (const auto it = machine.data.find(name); it != machine.data.end()) return it->second * scale;
  }
  const auto& tools = machine.tools;
  const auto tool = std::find_if(tools.begin(), tools.end(), [&](const auto& t) { return t.number == state.tool; });
  return tool == tools.end() ? 0 : tool->nose_width;
}

}  // namespace cnctrans::ir::passes
