#include "backends/common/waiting_offset.h"

#include <algorithm>

#include "ir/edit/search.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::backends {

OffsetStep offset_step(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (b == nullptr || s.line.skip_mask != 0 || b->has_motion || b->repeat_given != 0) return OffsetStep::lost;
  bool change = false;
  for (const ir::Action& a : b->actions) {
    if (std::holds_alternative<ir::ToolOffset>(a.data) || std::holds_alternative<ir::ToolSelect>(a.data) ||
        std::holds_alternative<ir::CycleDefine>(a.data))
      return OffsetStep::lost;
    // A zero point or a pole may be set from where the tool stands, and the length of the tool counts there.
    if (std::holds_alternative<ir::FrameOp>(a.data) || std::holds_alternative<ir::PoleSet>(a.data) ||
        std::holds_alternative<ir::SurfaceSet>(a.data))
      return OffsetStep::lost;
    change = change || std::holds_alternative<ir::ToolChange>(a.data);
  }
  return change ? OffsetStep::arrives : OffsetStep::passes;
}

bool offset_beside_tool(const ir::Block& b) {
  const auto* t = ir::action_in<ir::ToolSelect>(b);
  return t != nullptr && !t->changes && !b.has_motion && ir::action_in<ir::ToolOffset>(b) != nullptr &&
         ir::action_in<ir::ToolChange>(b) == nullptr && ir::action_in<ir::CycleDefine>(b) == nullptr;
}

std::set<const ir::Statement*> offsets_that_wait(const ir::Program& program) {
  std::set<const ir::Statement*> found;
  for (const ir::Routine& r : program.routines) {
    const auto uses = ir::passes::label_uses(program, r);
    const auto led_to = [&uses](const ir::Statement& s) {
      const auto labels = ir::passes::labels_on(s.line);
      return std::any_of(labels.begin(), labels.end(), [&uses](const ir::LabelRef& l) { return uses.is_target(l); });
    };
    const ir::Statement* from = nullptr;
    for (const ir::Statement& s : r.body) {
      const OffsetStep step = led_to(s) ? OffsetStep::lost : offset_step(s);
      if (from != nullptr && step == OffsetStep::arrives) found.insert(from);
      if (step != OffsetStep::passes) from = nullptr;
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b != nullptr && s.line.skip_mask == 0 && offset_beside_tool(*b)) from = &s;
    }
  }
  return found;
}

}  // namespace cnctrans::backends
