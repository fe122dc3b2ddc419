// Word blocks: M functions, by the meaning the machine profile gives them.
#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "frontends/sinumerik/state/words.h"

namespace cnctrans::sinumerik {

using syntax::Word;

void WordLowering::m_word(const syntax::Block& block, const Word& w) {
  Attribute attribute = Attribute::none;
  ir::Value value = exprs_.value(block, w, attribute);
  if (!value.literal()) {
    ir::MachineFunction m;
    m.computed = true;
    m.extension = w.extension;
    m.value = std::move(value);
    return push(std::move(m), Rank::before, ir::Order::before, w.pos);
  }
  if (value.number != std::floor(value.number) || value.number < 0 || value.number > 99999999) {
    failed_ = true;
    c_.error("SIN-017", w.pos, std::string(c_.slice(w.pos)) + " is no M function");
    return;
  }
  m_code(saturate<std::int32_t>(value.number), w);
}

void WordLowering::m_code(std::int32_t code, const Word& w) {
  if (w.extension < 0 && (code == 2 || code == 30 || code == 17)) {
    if (tail_ != Tail::none) {
      failed_ = true;
      c_.error("SIN-005", w.pos, "two M functions end the program in one block");
    }
    tail_ = code == 17 ? Tail::subprogram_end : Tail::program_end;
    tail_pos_ = w.pos;
    return;
  }
  const machine::MCode* m = code < MachineFacts::m_limit ? c_.machine.m_codes[static_cast<std::size_t>(code)] : nullptr;
  constexpr std::int32_t axis_mode = 70;
  if (code == axis_mode && (m == nullptr || m->meaning == machine::MMeaning::none)) {
    // The spindle becomes an axis (reference-language 14.9). The path is as it is written (`after`: its facts stay).
    push(ir::OpaqueWord{c_.slice(w.pos)}, Rank::after, ir::Order::after, w.pos);
    return c_.note("SIN-110", w.pos,
                   std::string(c_.slice(w.pos)) +
                       ": the spindle becomes an axis; the words of this axis are shown as they are written");
  }
  const std::int32_t spindle = w.extension < 0 ? c_.master_spindle : w.extension;
  const bool spindle_code =
      m != nullptr && (m->meaning == machine::MMeaning::spindle_cw || m->meaning == machine::MMeaning::spindle_ccw ||
                       m->meaning == machine::MMeaning::spindle_stop ||
                       m->meaning == machine::MMeaning::spindle_orient || m->meaning == machine::MMeaning::gear);
  if (m != nullptr && spindle >= 1 && spindle <= 31 && (w.extension < 0 || spindle_code)) {
    return machine_meaning(*m, static_cast<std::uint8_t>(spindle), w);
  }
  ir::MachineFunction f;
  f.code = code;
  f.extension = w.extension;
  push(std::move(f), Rank::before, m != nullptr ? m->order : ir::Order::before, w.pos);
}

void WordLowering::machine_meaning(const machine::MCode& m, std::uint8_t spindle, const Word& w) {
  using machine::MMeaning;
  const Rank rank = m.order == ir::Order::after ? Rank::after : m.order == ir::Order::with ? Rank::with : Rank::before;
  const auto coolant = [&](ir::CoolantState s) { push(ir::Coolant{s}, rank, m.order, w.pos); };
  switch (m.meaning) {
    case MMeaning::stop: return push(ir::Stop{false}, Rank::stop, ir::Order::after, w.pos);
    case MMeaning::optional_stop: return push(ir::Stop{true}, Rank::stop, ir::Order::after, w.pos);
    case MMeaning::spindle_cw: return push(ir::SpindleRun{spindle, ir::SpindleState::cw}, rank, m.order, w.pos);
    case MMeaning::spindle_ccw: return push(ir::SpindleRun{spindle, ir::SpindleState::ccw}, rank, m.order, w.pos);
    case MMeaning::spindle_stop: return push(ir::SpindleRun{spindle, ir::SpindleState::off}, rank, m.order, w.pos);
    case MMeaning::spindle_orient:
      return push(ir::SpindleOrient{spindle, ir::Value(static_cast<double>(m.argument))}, Rank::orient, m.order, w.pos);
    case MMeaning::tool_change: return push(ir::ToolChange{}, Rank::change, ir::Order::before, w.pos);
    case MMeaning::coolant_off: return coolant(ir::CoolantState::off);
    case MMeaning::coolant_flood: return coolant(ir::CoolantState::flood);
    case MMeaning::coolant_mist: return coolant(ir::CoolantState::mist);
    case MMeaning::coolant_second: return coolant(ir::CoolantState::second);
    case MMeaning::gear: return push(ir::SpindleGear{spindle, m.argument, m.argument == 0}, rank, m.order, w.pos);
    case MMeaning::program_end:
    case MMeaning::subprogram_end:
      tail_ = m.meaning == MMeaning::program_end ? Tail::program_end : Tail::subprogram_end;
      tail_pos_ = w.pos;
      return;
    case MMeaning::machine_function:
    case MMeaning::none: break;
  }
  ir::MachineFunction f;
  f.code = m.code;
  push(std::move(f), rank, m.order, w.pos);
}

}  // namespace cnctrans::sinumerik
