#include "ir/analysis/cycle_ends.h"

#include <optional>

#include "ir/analysis/dataflow.h"
#include "ir/cycle.h"
#include "ir/edit/search.h"

namespace cnctrans::ir {

namespace {

bool defines_hole(const Block& b) {
  for (const auto& a : b.actions) {
    const auto* d = std::get_if<CycleDefine>(&a.data);
    if (d != nullptr && d->modal && d->cycle && std::holds_alternative<HoleCycle>(d->cycle->node)) return true;
  }
  return false;
}

/// The plane function of the block; none: there is no such function.
std::optional<std::uint8_t> plane_of(const Block& b) {
  std::optional<std::uint8_t> plane;
  for (const auto& a : b.actions) {
    const auto* set = std::get_if<ModalSet>(&a.data);
    if (set != nullptr && set->setting == Setting::plane) plane = set->value;
  }
  return plane;
}

bool any_hole(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && defines_hole(*b));
    });
  }
  return found;
}

}  // namespace

std::vector<const Statement*> end_cycles_with_plane(Program& program, const ModalState& power_on) {
  std::vector<const Statement*> open;
  if (!any_hole(program)) return open;
  number_statements(program);
  const FactTable table = analyse(program, power_on);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || defines_hole(*b) || action_in<CycleCancel>(*b) != nullptr) return;
      const Facts& before = table.before(s.id);
      const bool maybe = before.cycle_active || before.cycle_from == Facts::several_cycles;
      if (!before.reachable || !maybe) return;
      const auto plane = plane_of(*b);
      const auto known = before.settings[static_cast<std::size_t>(Setting::plane)];
      const bool home = b->has_motion && b->motion.kind == MotionKind::reference_point;
      if (!home && plane && !known) open.push_back(&s);
      if (!home && (!plane || !known || *known == *plane)) return;
      Action end;
      end.data = CycleCancel{};
      b->actions.insert(b->actions.begin(), std::move(end));
    });
  }
  return open;
}

}  // namespace cnctrans::ir
