#include "backends/heidenhain/call_plan.h"

#include <algorithm>

#include "dialects/heidenhain/limits.h"

namespace cnctrans::backends::heidenhain {

namespace {

/// M functions of the block, and what stands behind its move.
bool has_room(const ir::Block& b) {
  std::size_t functions = 0;
  for (const auto& a : b.actions) {
    if (std::holds_alternative<ir::Corner>(a.data) || a.order == ir::Order::after) return false;
    functions += std::holds_alternative<ir::SpindleRun>(a.data) || std::holds_alternative<ir::Coolant>(a.data) ||
                         std::holds_alternative<ir::MachineFunction>(a.data)
                     ? 1U
                     : 0U;
  }
  return functions < dialects::heidenhain::m_functions;
}

template <class Data>
const Data* lone_action(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (b == nullptr || b->has_motion || b->actions.size() != 1) return nullptr;
  return std::get_if<Data>(&b->actions.front().data);
}

}  // namespace

const ir::CycleDefine* lone_call(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (b == nullptr || b->has_motion || b->actions.size() != 1) return nullptr;
  const auto* d = std::get_if<ir::CycleDefine>(&b->actions.front().data);
  return d != nullptr && d->cycle && !d->modal && d->here ? d : nullptr;
}

CallPlan::CallPlan(const ir::Program& program, const LabelUse& use) {
  for (std::size_t r = 0; r < program.routines.size(); ++r) {
    const ir::Body& body = program.routines[r].body;
    for (std::size_t i = 0; i + 1 < body.size(); ++i) {
      const auto* frame = lone_action<ir::FrameOp>(body[i]);
      const auto* offset = lone_action<ir::WorkOffset>(body[i + 1]);
      if (frame != nullptr && offset != nullptr && !offset->off && frame->change->slot == ir::FrameSlot::shift &&
          frame->change->combine == ir::FrameCombine::clear && body[i + 1].line.skip_mask == body[i].line.skip_mask)
        taken_back_.insert(body[i].id);
      const auto* b = std::get_if<ir::Block>(&body[i].node);
      const ir::LineInfo& next = body[i + 1].line;
      if (b == nullptr || !b->has_motion || !b->motion.moves() || b->motion.frame != ir::FrameUse::normal ||
          !has_room(*b) || lone_call(body[i + 1]) == nullptr || next.skip_mask != body[i].line.skip_mask)
        continue;
      const bool target = (!next.number.empty() && use.is_target(r, next.number)) ||
                          std::any_of(next.labels.begin(), next.labels.end(),
                                      [&](std::string_view l) { return use.is_target_name(r, l); });
      const auto* hole = std::get_if<ir::HoleCycle>(&lone_call(body[i + 1])->cycle->node);
      const bool own_speed = hole != nullptr && hole->has_speed;  // it is said between the move and the call
      if (target || own_speed || !next.comments.empty()) continue;
      calls_[body[i].id] = &body[i + 1];
      called_.insert(body[i + 1].id);
    }
  }
}

const ir::Statement* CallPlan::call_behind(const ir::Statement& move) const {
  const auto at = calls_.find(move.id);
  return at != calls_.end() ? at->second : nullptr;
}

}  // namespace cnctrans::backends::heidenhain
