#include "frontends/fagor/program/tool_offsets.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "ir/analysis/label_uses.h"
#include "ir/edit/search.h"

namespace cnctrans::fagor {

namespace {

bool is_offset(const ir::Action& a) {
  return std::holds_alternative<ir::ToolOffset>(a.data);
}
bool is_change(const ir::Action& a) {
  return std::holds_alternative<ir::ToolChange>(a.data);
}

/// T with its D and without the M06.
bool begins(const ir::Block& b) {
  const auto* t = ir::action_in<ir::ToolSelect>(b);
  return t != nullptr && !t->changes && ir::action_in<ir::ToolOffset>(b) != nullptr &&
         ir::action_in<ir::ToolChange>(b) == nullptr && ir::action_in<ir::CycleDefine>(b) == nullptr;
}

}  // namespace

WaitingOffset::Step WaitingOffset::behind(const ir::Statement& s, bool led_to) const {
  if (skipped_ || s.line.skip_mask != 0 || led_to) return Step::lost;
  if (std::holds_alternative<ir::Message>(s.node)) return Step::passes;
  if (std::holds_alternative<ir::Assign>(s.node)) return fixed_ ? Step::passes : Step::lost;
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (b == nullptr || ir::action_in<ir::ToolOffset>(*b) != nullptr || ir::action_in<ir::ToolSelect>(*b) != nullptr)
    return Step::lost;
  return ir::action_in<ir::ToolChange>(*b) != nullptr ? Step::arrives : Step::passes;
}

WaitingOffset::Step WaitingOffset::follow(const ir::Statement& s, bool led_to) {
  if (waits_) {
    const Step step = behind(s, led_to);
    waits_ = step == Step::passes;
    return step;
  }
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (b == nullptr || b->actions.empty() || !begins(*b)) return Step::nothing;
  waits_ = true;
  skipped_ = s.line.skip_mask != 0;
  fixed_ = ir::action_in<ir::ToolOffset>(*b)->number.literal();
  return Step::begins;
}

ir::Action WaitingOffset::take(ir::Block& block) {
  const auto at = std::find_if(block.actions.begin(), block.actions.end(), is_offset);
  ir::Action offset = std::move(*at);
  block.actions.erase(at);
  return offset;
}

void WaitingOffset::put(ir::Block& block, ir::Action offset) {
  const auto at = std::find_if(block.actions.begin(), block.actions.end(), is_change);
  offset.order = at->order;
  offset.pos = {};
  offset.text = {};
  block.actions.insert(at + 1, std::move(offset));
}

void offsets_with_change(ir::Program& program, LowerState& state) {
  if (!state.tool_changer()) return;
  if (!ir::any_action(program, is_change)) return;  // T of a machine whose tools are changed by hand
  for (auto& r : program.routines) {
    const auto uses = ir::passes::label_uses(program, r);
    const auto led_to = [&uses](const ir::Statement& s) {
      const auto labels = ir::passes::labels_on(s.line);
      return std::any_of(labels.begin(), labels.end(), [&uses](const ir::LabelRef& l) { return uses.is_target(l); });
    };
    const auto lost = [&state](const ir::Statement& s) {
      const auto& actions = std::get<ir::Block>(s.node).actions;
      state.set_line(s.line.span);
      state.warning("FAG-052", std::find_if(actions.begin(), actions.end(), is_offset)->pos,
                    "on a tool changer the offset beside T waits for the M06; which one it is can't be told here, and "
                    "it is taken at once",
                    "write D in the block with M06");
    };
    WaitingOffset rule;
    ir::Statement* from = nullptr;
    for (auto& s : r.body) {
      auto step = rule.follow(s, led_to(s));
      if (step == WaitingOffset::Step::lost) {
        lost(*from);
        step = rule.follow(s, led_to(s));
      }
      if (step == WaitingOffset::Step::begins) from = &s;
      if (step == WaitingOffset::Step::arrives)
        WaitingOffset::put(std::get<ir::Block>(s.node), WaitingOffset::take(std::get<ir::Block>(from->node)));
    }
    if (rule.waits()) lost(*from);
  }
}

bool may_change_tools(std::string_view text, const machine::Profile& profile) {
  for (std::size_t at = text.find('M'); at != std::string_view::npos; at = text.find('M', at + 1)) {
    const std::size_t digits = text.find_first_not_of(' ', at + 1);
    if (digits == std::string_view::npos) return false;
    std::int32_t code = -1;
    const auto read = std::from_chars(text.data() + digits, text.data() + text.size(), code);
    const auto* m = read.ec == std::errc() ? profile.m_code(code) : nullptr;
    if (m != nullptr && m->meaning == machine::MMeaning::tool_change) return true;
  }
  return false;
}

}  // namespace cnctrans::fagor
