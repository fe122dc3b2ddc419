#include "frontends/num/cycles/cycle_moves.h"

#include <algorithm>
#include <map>

#include "base/text.h"
#include "frontends/num/words/compensation.h"
#include "ir/analysis/dataflow.h"
#include "ir/edit/search.h"

namespace cnctrans::frontends::num {

namespace {

const ir::HoleCycle* modal_cycle_in(const ir::Block& b) {
  const auto* d = ir::action_in<ir::CycleDefine>(b);
  return d != nullptr && d->modal && d->cycle ? std::get_if<ir::HoleCycle>(&d->cycle->node) : nullptr;
}

bool moves_along(const ir::Block& b, ir::AxisId axis) {
  return std::any_of(b.motion.coords.begin(), b.motion.coords.end(),
                     [axis](const ir::CoordWord& c) { return c.axis == axis; });
}

}  // namespace

void judge_cycle_moves(ir::Program& program, const ir::ModalState& power_on, Diagnostics& diagnostics) {
  const auto defines = [](const ir::Action& a) {
    const auto* d = std::get_if<ir::CycleDefine>(&a.data);
    return d != nullptr && d->modal;
  };
  if (!ir::any_action(program, defines)) return;
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, power_on);
  std::map<std::uint32_t, ir::AxisId> axes;  // of the cycle that the statement defines
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      const auto* cycle = b != nullptr ? modal_cycle_in(*b) : nullptr;
      if (cycle == nullptr) return;
      const auto plane = table.before(s.id).settings[static_cast<std::size_t>(ir::Setting::plane)];
      auto own = plane;
      for (const auto& a : b->actions) {
        const auto* m = std::get_if<ir::ModalSet>(&a.data);
        if (m != nullptr && m->setting == ir::Setting::plane) own = m->value;
      }
      if (cycle->axis != ir::axis::none)
        axes[s.id] = cycle->axis;
      else if (own)
        axes[s.id] = ir::plane_axes(static_cast<ir::Plane>(*own)).w;
    });
  }
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b != nullptr && turns_tool(*b)) {
        const ir::Facts& here = table.before(s.id);
        if (ir::action_in<ir::CycleCancel>(*b) == nullptr && here.reachable && here.cycle_active_known &&
            here.cycle_active)
          diagnostics.error("NUM-026", s.line.span, "G16 while a drilling cycle is active", "write G80 before it");
        return;
      }
      if (b == nullptr || !b->has_motion || ir::action_in<ir::CycleDefine>(*b) != nullptr ||
          ir::action_in<ir::CycleCancel>(*b) != nullptr)
        return;
      const ir::Facts& before = table.before(s.id);
      if (!before.reachable || !before.cycle_active_known || !before.cycle_active) return;
      const auto axis = axes.find(before.cycle_from);
      if (b->motion.explicit_code) {
        diagnostics.error("NUM-026", word_span(s.line.span, b->motion.code_pos),
                          "a motion function while a drilling cycle is active", "write G80 before it");
      } else if (axis != axes.end() && moves_along(*b, axis->second)) {
        diagnostics.error("NUM-026", s.line.span, "the depth of a cycle can't be changed while it is active",
                          "write the cycle again");
      }
    });
  }
}

}  // namespace cnctrans::frontends::num
