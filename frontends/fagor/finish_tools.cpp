#include <algorithm>

#include "frontends/fagor/finish_parts.h"
#include "ir/passes/editor.h"
#include "ir/passes/rewrite.h"
#include "ir/search.h"

namespace cnctrans::fagor {

namespace {

/// T with its D, waiting for the M06.
bool waits(const ir::Block& b) {
  const auto* t = ir::action_in<ir::ToolSelect>(b);
  return t != nullptr && !t->changes && ir::action_in<ir::ToolOffset>(b) != nullptr &&
         ir::action_in<ir::ToolChange>(b) == nullptr && ir::action_in<ir::CycleDefine>(b) == nullptr;
}

/// A jump or a repeated part may begin here.
bool led_to(const ir::Statement& s, const ir::passes::LabelUses& uses) {
  const auto labels = ir::passes::labels_on(s.line);
  return std::any_of(labels.begin(), labels.end(), [&uses](const ir::LabelRef& l) { return uses.is_target(l); });
}

/// The offset is known when it stands there, or when nothing writes a variable on the way.
bool passes_over(const ir::Statement& s, bool fixed, const ir::passes::LabelUses& uses) {
  if (s.line.skip_mask != 0 || led_to(s, uses)) return false;
  if (std::holds_alternative<ir::Message>(s.node)) return true;
  if (std::holds_alternative<ir::Assign>(s.node)) return fixed;
  const auto* b = std::get_if<ir::Block>(&s.node);
  return b != nullptr && ir::action_in<ir::ToolOffset>(*b) == nullptr && ir::action_in<ir::ToolSelect>(*b) == nullptr;
}

/// The block with M06 that the offset of `body[from]` comes with; null: it can't be told.
ir::Block* change_behind(ir::Body& body, std::size_t from, bool fixed, const ir::passes::LabelUses& uses) {
  for (std::size_t i = from + 1; i < body.size(); ++i) {
    auto* b = std::get_if<ir::Block>(&body[i].node);
    const bool change = b != nullptr && ir::action_in<ir::ToolChange>(*b) != nullptr;
    if (change && body[i].line.skip_mask == 0 && !led_to(body[i], uses) &&
        ir::action_in<ir::ToolOffset>(*b) == nullptr && ir::action_in<ir::ToolSelect>(*b) == nullptr)
      return b;
    if (change || !passes_over(body[i], fixed, uses)) return nullptr;
  }
  return nullptr;
}

}  // namespace

void offsets_with_change(ir::Program& program, LowerState& state) {
  if (!state.tool_changer()) return;
  bool changes = false;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&changes](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      changes = changes || (b != nullptr && ir::action_in<ir::ToolChange>(*b) != nullptr);
    });
  }
  if (!changes) return;  // T of a machine whose tools are changed by hand
  const auto is_offset = [](const ir::Action& a) { return std::holds_alternative<ir::ToolOffset>(a.data); };
  const auto is_change = [](const ir::Action& a) { return std::holds_alternative<ir::ToolChange>(a.data); };
  for (auto& r : program.routines) {
    const auto uses = ir::passes::label_uses(program, r);
    for (std::size_t i = 0; i < r.body.size(); ++i) {
      auto* b = std::get_if<ir::Block>(&r.body[i].node);
      if (b == nullptr || !waits(*b)) continue;
      const auto offset = std::find_if(b->actions.begin(), b->actions.end(), is_offset);
      const bool fixed = std::get<ir::ToolOffset>(offset->data).number.literal();
      ir::Block* change = r.body[i].line.skip_mask == 0 ? change_behind(r.body, i, fixed, uses) : nullptr;
      if (change == nullptr) {
        state.set_line(r.body[i].line.span);
        state.warning(
            "FAG-052", offset->pos,
            "on a tool changer the offset beside T waits for the M06; which one it is can't be told here, and it "
            "is taken at once",
            "write D in the block with M06");
        continue;
      }
      const auto at = std::find_if(change->actions.begin(), change->actions.end(), is_change);
      ir::Action moved = *offset;
      moved.order = at->order;
      moved.pos = {};
      moved.text = {};
      b->actions.erase(offset);
      change->actions.insert(at + 1, std::move(moved));
    }
  }
}

}  // namespace cnctrans::fagor
