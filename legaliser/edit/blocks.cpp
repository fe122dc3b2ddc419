#include "legaliser/edit/blocks.h"

#include <algorithm>

#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

using machine::MMeaning;

Order order_of_meaning(const machine::Profile& machine, MMeaning meaning, Order otherwise, std::int32_t argument = -1) {
  for (const auto& m : machine.m_codes) {
    if (m.meaning == meaning && (argument < 0 || m.argument == argument)) return m.order;
  }
  return otherwise;
}

struct OrderOf {
  const machine::Profile& machine;
  Order operator()(const SpindleRun& s) const {
    const MMeaning meaning = s.state == SpindleState::cw    ? MMeaning::spindle_cw
                             : s.state == SpindleState::ccw ? MMeaning::spindle_ccw
                                                            : MMeaning::spindle_stop;
    return order_of_meaning(machine, meaning, Order::before);
  }
  Order operator()(const SpindleOrient&) const {
    return order_of_meaning(machine, MMeaning::spindle_orient, Order::before);
  }
  Order operator()(const SpindleGear& g) const {
    return order_of_meaning(machine, MMeaning::gear, Order::before, g.automatic ? 0 : g.gear);
  }
  Order operator()(const ToolChange&) const { return order_of_meaning(machine, MMeaning::tool_change, Order::before); }
  Order operator()(const Coolant& c) const {
    const MMeaning meaning = c.state == CoolantState::off     ? MMeaning::coolant_off
                             : c.state == CoolantState::flood ? MMeaning::coolant_flood
                             : c.state == CoolantState::mist  ? MMeaning::coolant_mist
                                                              : MMeaning::coolant_second;
    return order_of_meaning(machine, meaning, Order::before);
  }
  Order operator()(const Stop& s) const {
    return order_of_meaning(machine, s.optional ? MMeaning::optional_stop : MMeaning::stop, Order::after);
  }
  Order operator()(const MachineFunction& m) const {
    const auto* code = m.auxiliary || m.computed ? nullptr : machine.m_code(m.code);
    return code != nullptr ? code->order : Order::before;
  }
  template <class Other>
  Order operator()(const Other&) const {
    return Order::before;
  }
};

}  // namespace

Block straight_move(MotionKind kind, AxisId axis, const Value& to) {
  Block b;
  b.has_motion = true;
  b.motion.kind = kind;
  b.motion.explicit_code = true;
  b.motion.keeps_modal = false;
  CoordWord word;
  word.axis = axis;
  word.mode = WordMode::absolute;
  word.value = to;
  b.motion.coords.push_back(word);
  return b;
}

Action distance_set(Distance mode) {
  return action(ModalSet{Setting::distance, static_cast<std::uint8_t>(mode)});
}

Order target_order(const Action& action, const machine::Profile& target) {
  return std::visit(OrderOf{target}, action.data);
}

bool makes_event(const Action& a) {
  return std::holds_alternative<SpindleRun>(a.data) || std::holds_alternative<SpindleOrient>(a.data) ||
         std::holds_alternative<ToolChange>(a.data) || std::holds_alternative<Coolant>(a.data) ||
         std::holds_alternative<Stop>(a.data) || std::holds_alternative<MachineFunction>(a.data) ||
         std::holds_alternative<SpindleGear>(a.data) || std::holds_alternative<Dwell>(a.data);
}

std::vector<Action> take_after(Block& block) {
  const bool changes = std::any_of(block.actions.begin(), block.actions.end(), [](const Action& a) {
    return a.order == Order::after && std::holds_alternative<ToolChange>(a.data);
  });
  std::vector<Action> late, rest;
  for (auto& a : block.actions) {
    const bool tool = changes && std::holds_alternative<ToolSelect>(a.data);
    if (changes && a.order != Order::after && std::holds_alternative<ToolOffset>(a.data)) late.push_back(a);
    (tool || a.order == Order::after ? late : rest).push_back(std::move(a));
  }
  block.actions = std::move(rest);
  return late;
}

bool own_block(const Action& action, const Capabilities& target) {
  return target.own_block && target.own_block(action);
}

bool has_motion(const Block& block) {
  if (block.has_motion && block.motion.moves()) return true;
  for (const auto& a : block.actions) {
    if (std::holds_alternative<CycleDefine>(a.data)) return true;
  }
  return false;
}

void settle(Statement& statement) {
  const auto* b = std::get_if<Block>(&statement.node);
  if (b != nullptr && b->empty() && b->repeat_given == 0) statement.node = Label{};
}

void edit_blocks(Program& program, const LegaliseContext& context, const BlockEdit& edit) {
  for (auto& routine : program.routines) {
    Editor editor(program, routine, context);
    rewrite_body(routine.body, [&](Statement&& s, Body& out) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) {
        out.push_back(std::move(s));
        return;
      }
      const bool was_empty = b->empty();
      const std::size_t first = out.size();
      edit(editor, std::move(s), out);
      for (std::size_t i = first; i < out.size() && !was_empty; ++i) settle(out[i]);
    });
  }
}

}  // namespace cnctrans::ir::passes
