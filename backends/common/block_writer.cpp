// Word blocks: actions and motion as words of one or several target lines.
#include "backends/common/program_writer.h"
#include "base/text.h"

namespace cnctrans::backends {
namespace {

using machine::MMeaning;

bool before_motion(ir::Order o) {
  return o != ir::Order::after;
}

}  // namespace

void ProgramWriter::block(const ir::Block& b) {
  if (b.repeat_given != 0) {
    refuse("TRN-202", {}, "the repetition of a block has no counterpart here");
    return;
  }
  const auto write = [&](bool before) {
    for (const ir::Action& a : b.actions) {
      if (before_motion(a.order) != before || refused()) continue;
      const bool alone = own_line(a, b);
      if (alone) next_line();
      action(a);
      // What comes later than on the target may share its line with what follows: M5 M0.
      if (alone && !refused() && (before || !ProgramWriter::own_line(a, b))) next_line();
    }
  };
  write(true);
  if (refused()) return;
  if (b.has_motion) motion(b.motion);
  write(false);
}

bool ProgramWriter::own_line(const ir::Action& a, const ir::Block& b) {
  if (same_dialect_ && !a.text.empty()) return false;
  if (!b.has_motion || !b.motion.moves()) return false;
  return before_motion(a.order) != before_motion(target_order(a));
}

ir::Order ProgramWriter::target_order(const ir::Action& a) const {
  std::optional<std::int32_t> code;
  if (const auto* s = std::get_if<ir::SpindleRun>(&a.data)) {
    code = s->state == ir::SpindleState::off  ? code_for(MMeaning::spindle_stop, 5)
           : s->state == ir::SpindleState::cw ? code_for(MMeaning::spindle_cw, 3)
                                              : code_for(MMeaning::spindle_ccw, 4);
  } else if (const auto* c = std::get_if<ir::Coolant>(&a.data)) {
    code = c->state == ir::CoolantState::off      ? code_for(MMeaning::coolant_off, 9)
           : c->state == ir::CoolantState::mist   ? code_for(MMeaning::coolant_mist, 7)
           : c->state == ir::CoolantState::second ? code_for(MMeaning::coolant_second, 7)
                                                  : code_for(MMeaning::coolant_flood, 8);
  } else if (const auto* m = std::get_if<ir::MachineFunction>(&a.data)) {
    if (!m->auxiliary && !m->computed) code = m->code;
  } else if (std::holds_alternative<ir::ToolChange>(a.data)) {
    code = code_for(MMeaning::tool_change, 6);
  } else if (const auto* g = std::get_if<ir::SpindleGear>(&a.data)) {
    code = g->automatic ? 40 : 40 + g->gear;
  } else if (std::holds_alternative<ir::Stop>(a.data)) {
    return ir::Order::after;
  }
  if (!code) return ir::Order::before;
  const machine::MCode* m = profile().m_code(*code);
  return m != nullptr ? m->order : ir::Order::before;
}

bool ProgramWriter::spelling_is_whole_word(const ir::Action& a) const {
  return !std::holds_alternative<ir::FrameOp>(a.data) && !std::holds_alternative<ir::PoleSet>(a.data) &&
         !std::holds_alternative<ir::CycleDefine>(a.data) && !std::holds_alternative<ir::Dwell>(a.data);
}

namespace {

/// What only the control that has it can say; empty: nothing of the kind.
std::string_view own_action(const ir::Action& a) {
  if (const auto* f = std::get_if<ir::SetFeed>(&a.data); f != nullptr && f->block_only) return "a feed of one block";
  if (const auto* o = std::get_if<ir::SpindleOrient>(&a.data); o != nullptr && o->incremental)
    return "turning the spindle by an increment";
  const auto* op = std::get_if<ir::FrameOp>(&a.data);
  if (op == nullptr || !op->change) return {};
  const bool chain = op->change->slot == ir::FrameSlot::chain;
  if (chain && op->change->combine == ir::FrameCombine::replace_named) return "the coarse or fine part of a shift";
  return {};
}

}  // namespace

void ProgramWriter::action(const ir::Action& a) {
  if (const std::string_view what = own_action(a); !same_dialect_ && !what.empty())
    return refuse("TRN-202", a.pos, std::string(what) + " has no counterpart here");
  if (const auto* m = std::get_if<ir::ModalSet>(&a.data)) note_setting(m->setting, m->value);
  if (const auto* s = std::get_if<ir::SurfaceSet>(&a.data))
    note_setting(ir::Setting::surface, static_cast<std::uint8_t>(s->surface));
  // A word that means several things is written once in its own language; another one needs a word for each.
  if (same_dialect_ && line_.has_column(a.pos.column)) return;
  if (same_dialect_ && !a.text.empty() && spelling_is_whole_word(a)) {
    const Rank rank = std::holds_alternative<ir::ModalSet>(a.data) ? Rank::setting : Rank::machine;
    add(std::string(a.text), rank, a.pos);
    return;
  }
  struct Visitor {
    ProgramWriter& w;
    const ir::Action& a;
    void operator()(const ir::ModalSet& x) const { w.modal_set(a, x); }
    void operator()(const ir::SetFeed& x) const { w.set_feed(a, x); }
    void operator()(const ir::SetSpindle& x) const { w.set_spindle(a, x); }
    void operator()(const ir::SpindleRun& x) const { w.spindle_run(a, x); }
    void operator()(const ir::SpindleOrient& x) const { w.spindle_orient(a, x); }
    void operator()(const ir::SpindleLimit& x) const { w.spindle_limit(a, x); }
    void operator()(const ir::SpindleGear& x) const { w.spindle_gear(a, x); }
    void operator()(const ir::MasterSpindle& x) const { w.master_spindle(a, x); }
    void operator()(const ir::ToolSelect& x) const { w.tool_select(a, x); }
    void operator()(const ir::ToolChange& /*x*/) const { w.tool_change(a); }
    void operator()(const ir::ToolOffset& x) const { w.tool_offset(a, x); }
    void operator()(const ir::WorkOffset& x) const { w.work_offset(a, x); }
    void operator()(const ir::FrameOp& x) const { w.frame_op(a, x); }
    void operator()(const ir::PoleSet& x) const { w.pole_set(a, x); }
    void operator()(const ir::Dwell& x) const { w.dwell(a, x); }
    void operator()(const ir::ExactStopBlock& /*x*/) const { w.exact_stop(a); }
    void operator()(const ir::Coolant& x) const { w.coolant(a, x); }
    void operator()(const ir::MachineFunction& x) const { w.machine_function(a, x); }
    void operator()(const ir::Stop& x) const { w.stop(a, x); }
    void operator()(const ir::CycleDefine& x) const { w.cycle_define(a, x); }
    void operator()(const ir::CycleCancel& /*x*/) const { w.cycle_cancel(a); }
    void operator()(const ir::Corner& x) const { w.corner(a, x); }
    void operator()(const ir::TangentialEnd& x) const { w.tangential_end(a, x); }
    void operator()(const ir::PreparationStop& /*x*/) const { w.preparation_stop(a); }
    void operator()(const ir::OpaqueWord& x) const { w.opaque_word(a, x); }
    void operator()(const ir::SurfaceSet& x) const { w.surface_set(a, x); }
    void operator()(const ir::SplineAxes& /*x*/) const {
      w.refuse("TRN-202", a.pos, "the choice of the axes of splines has no counterpart here");
    }
  };
  std::visit(Visitor{*this, a}, a.data);
}

// ---- numbers and expressions ---------------------------------------------------------------------------------------

NumberFormat ProgramWriter::number_format() const {
  return NumberFormat{style_.kept_decimals, style_.made_decimals, same_dialect_};
}

std::string ProgramWriter::number_text(const ir::Value& v) {
  std::string text;
  const NumberFormat format = number_format();
  const double change = append_number(text, v.number, v.text, format);
  note_rounding(change, v.text.empty() ? format.made_decimals : format.kept_decimals);
  return text;
}

void ProgramWriter::note_rounding(double change, int decimals) {
  if (change == 0 || rounding_noted_) return;
  rounding_noted_ = true;
  std::string half = "0.";
  half.append(static_cast<std::size_t>(decimals), '0');
  half += '5';
  diagnostics_.warning("TRN-210", current_ != nullptr ? current_->line.span : Span{},
                       "numbers with more than " + std::to_string(decimals) +
                           " decimals are rounded for the target: each changes by at most " + half +
                           " (reported once for the program)");
}

std::string ProgramWriter::expression_text(const ir::ExprPtr& e, WordPos pos) {
  ExpressionPrinter& printer = expressions();
  std::string text = printer.print(e);
  WordPos at;
  const std::string problem = printer.take_problem(&at);
  if (!problem.empty()) refuse("TRN-203", at.column != 0 ? at : pos, problem);
  return text;
}

// ---- M functions ---------------------------------------------------------------------------------------------------

std::string ProgramWriter::m_word(std::int32_t code) const {
  std::string text = "M";
  if (style_.two_digit_m && code < 10) text += '0';
  return text + std::to_string(code);
}

std::int32_t ProgramWriter::code_for(MMeaning meaning, std::int32_t usual) const {
  const machine::MCode* at_usual = profile().m_code(usual);
  if (at_usual == nullptr || at_usual->meaning == meaning) return usual;
  for (const machine::MCode& m : profile().m_codes) {
    if (m.meaning == meaning) return m.code;
  }
  return usual;
}

void ProgramWriter::spindle_run(const ir::Action& a, const ir::SpindleRun& s) {
  if (s.number != words_of_spindle_) return refuse("TRN-202", a.pos, "a second spindle has no counterpart here");
  const std::int32_t code = s.state == ir::SpindleState::cw    ? code_for(MMeaning::spindle_cw, 3)
                            : s.state == ir::SpindleState::ccw ? code_for(MMeaning::spindle_ccw, 4)
                                                               : code_for(MMeaning::spindle_stop, 5);
  add(m_word(code), Rank::machine, a.pos);
}

void ProgramWriter::spindle_gear(const ir::Action& a, const ir::SpindleGear& s) {
  if (s.number != words_of_spindle_)
    return refuse("TRN-202", a.pos, "the gear of a second spindle has no counterpart here");
  add(m_word(s.automatic ? 40 : 40 + s.gear), Rank::machine, a.pos);
}

void ProgramWriter::master_spindle(const ir::Action& a, const ir::MasterSpindle& m) {
  if (m.number != 1) refuse("TRN-202", a.pos, "work with a second spindle has no counterpart here");
}

void ProgramWriter::tool_change(const ir::Action& a) {
  add(m_word(code_for(MMeaning::tool_change, 6)), Rank::machine, a.pos);
}

void ProgramWriter::coolant(const ir::Action& a, const ir::Coolant& c) {
  std::int32_t code = code_for(MMeaning::coolant_off, 9);
  if (c.state == ir::CoolantState::flood) code = code_for(MMeaning::coolant_flood, 8);
  if (c.state == ir::CoolantState::mist) code = code_for(MMeaning::coolant_mist, 7);
  if (c.state == ir::CoolantState::second) code = code_for(MMeaning::coolant_second, 7);
  add(m_word(code), Rank::machine, a.pos);
}

void ProgramWriter::stop(const ir::Action& a, const ir::Stop& s) {
  add(m_word(s.optional ? 1 : 0), Rank::machine, a.pos);
}

void ProgramWriter::machine_function(const ir::Action& a, const ir::MachineFunction& m) {
  if (m.auxiliary || m.computed || m.extension >= 0) {
    return refuse("TRN-202", a.pos, "this machine function has no counterpart here");
  }
  const machine::MCode* there = profile().m_code(m.code);
  if (!same_dialect_ && there != nullptr && there->meaning != MMeaning::machine_function) {
    return refuse("TRN-207", a.pos,
                  m_word(m.code) + " means something else on the target machine" +
                      (there->text.empty() ? std::string() : " (" + there->text + ")"),
                  "say in the machine profiles what the function does");
  }
  if (!same_dialect_ && noted_functions_.insert(m.code).second) {
    diagnostics_.note(
        "TRN-208", span_of(a.pos),
        m_word(m.code) + " is a function of the machine and is written as it is; check that the target machine has it");
  }
  add(m_word(m.code), Rank::machine, a.pos);
}

}  // namespace cnctrans::backends
