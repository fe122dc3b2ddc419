#include "translator/proving/said_tools.h"

#include <algorithm>
#include <optional>

#include "base/saturate.h"
#include "ir/cycles/milling/milling.h"
#include "ir/edit/search.h"
#include "ir/known_number.h"

namespace cnctrans::translator {

namespace {

/// The radius that a cycle says of its tool, mm.
std::optional<double> said_radius(const ir::CycleDefine& d) {
  const auto* hole = d.cycle ? std::get_if<ir::HoleCycle>(&d.cycle->node) : nullptr;
  if (hole == nullptr) return std::nullopt;
  for (const auto& [name, v] : hole->mill.words) {
    if (name == ir::cycles::tool_radius_word) return ir::known_number(v);
  }
  return std::nullopt;
}

}  // namespace

machine::Profile with_said_tools(const ir::Program& program, machine::Profile target) {
  std::optional<std::int32_t> tool;
  const auto look = [&](const ir::Action& a) {
    if (const auto* select = std::get_if<ir::ToolSelect>(&a.data)) {
      const auto number = select->name.empty() ? ir::known_number(select->number) : std::nullopt;
      tool = number ? std::optional(saturate<std::int32_t>(*number)) : std::nullopt;
    }
    const auto* d = std::get_if<ir::CycleDefine>(&a.data);
    const auto radius = d != nullptr && tool ? said_radius(*d) : std::nullopt;
    const auto same = [&tool](const machine::Tool& t) { return t.number == *tool; };
    if (!radius || std::any_of(target.tools.begin(), target.tools.end(), same)) return;
    machine::Tool said;
    said.number = *tool;
    said.radius = *radius;
    target.tools.push_back(said);
  };
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&look](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b != nullptr) std::for_each(b->actions.begin(), b->actions.end(), look);
    });
  }
  return target;
}

}  // namespace cnctrans::translator
