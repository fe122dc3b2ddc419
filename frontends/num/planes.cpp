#include "frontends/num/planes.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "ir/dataflow.h"
#include "ir/passes/call_graph.h"

namespace cnctrans::frontends::num {

namespace {

std::optional<ir::Plane> plane_in(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (b == nullptr) return std::nullopt;
  for (const auto& a : b->actions) {
    const auto* set = std::get_if<ir::ModalSet>(&a.data);
    if (set != nullptr && set->setting == ir::Setting::plane) return static_cast<ir::Plane>(set->value);
  }
  return std::nullopt;
}

/// A program that stays in the usual plane needs no second look.
bool other_planes(const ir::Program& program, ir::Plane usual) {
  bool found = false;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body,
                           [&](const ir::Statement& s) { found = found || plane_in(s).value_or(usual) != usual; });
  }
  return found;
}

std::optional<ir::Plane> plane_before(const ir::FactTable& table, const ir::Statement& s) {
  const ir::Facts& before = table.before(s.id);
  const auto plane = before.settings[static_cast<std::size_t>(ir::Setting::plane)];
  if (!before.reachable || !plane) return std::nullopt;
  return static_cast<ir::Plane>(*plane);
}

}  // namespace

std::map<std::uint32_t, ir::Plane> planes_by_flow(ir::Program& program, const ir::ModalState& power_on) {
  if (!other_planes(program, power_on.plane)) return {};
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, power_on);
  std::map<std::uint32_t, ir::Plane> planes;
  bool differs = false;
  for (const auto& r : program.routines) {
    ir::Plane text = power_on.plane;
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      if (const auto plane = plane_before(table, s); plane && !s.line.joined) {
        planes.emplace(s.line.span.line, *plane);
        differs = differs || *plane != text;
      }
      text = plane_in(s).value_or(text);
    });
  }
  if (!differs) planes.clear();
  return planes;
}

void judge_planes(ir::Program& program, const std::vector<std::pair<Span, ir::Plane>>& uses,
                  const ir::ModalState& power_on, Diagnostics& diagnostics) {
  if (uses.empty() || !other_planes(program, power_on.plane)) return;
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, power_on);
  // What other files do is not known here, nor who calls what nothing here calls.
  const ir::passes::CallGraph calls(program);
  const bool outside = std::any_of(calls.sites().begin(), calls.sites().end(), [](const auto& s) { return !s.callee; });
  struct Place {
    const ir::Statement* statement = nullptr;
    bool sure = false;
  };
  std::unordered_map<std::uint32_t, Place> lines;
  for (std::size_t i = 0; i < program.routines.size(); ++i) {
    const bool sure = !outside && (program.routines[i].kind == ir::RoutineKind::main || calls.called(i));
    ir::for_each_statement(program.routines[i].body, [&](const ir::Statement& s) {
      lines.emplace(s.line.span.line, Place{&s, sure});
    });
  }
  for (const auto& [where, taken] : uses) {
    const auto at = lines.find(where.line);
    if (at == lines.end()) continue;
    const auto& [statement, sure] = at->second;
    if (!table.before(statement->id).reachable) continue;
    const auto own = plane_in(*statement);
    const auto plane = own ? own : plane_before(table, *statement);
    if (plane == taken) continue;
    if (!plane && !sure) {
      diagnostics.warning("NUM-080", where,
                          "this block depends on the plane, which another program may have set: the one above in the "
                          "text is taken",
                          "write the plane function (G17, G18, G19) before the block");
      continue;
    }
    diagnostics.error("NUM-080", where,
                      "this block depends on the plane, and the program reaches it with several planes",
                      "write the plane function (G17, G18, G19) before the block");
  }
}

}  // namespace cnctrans::frontends::num
