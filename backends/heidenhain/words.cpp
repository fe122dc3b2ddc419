// Actions as words of blocks: settings, tools, feed, speed, stops.
#include "backends/heidenhain/tables.h"
#include "backends/heidenhain/writer.h"
#include "base/text.h"
#include "dialects/heidenhain/limits.h"

namespace cnctrans::backends::heidenhain {

using ir::Setting;

std::string Writer::amount(const ir::Value& value, WordPos pos) {
  if (value.literal()) return number_text(value);
  const auto* minus = std::get_if<ir::Unary>(&value.expr->node);
  const auto& one = minus != nullptr && minus->op == ir::UnaryOp::negate ? minus->operand : value.expr;
  if (!std::holds_alternative<ir::VarRef>(one->node) && !std::holds_alternative<ir::SystemRef>(one->node))
    refuse(no_word, pos, "a word holds a number or one parameter here", "compute it in a parameter before the block");
  return expression_text(value.expr, pos);
}

std::string Writer::signed_amount(const ir::Value& value, WordPos pos) {
  std::string text = amount(value, pos);
  return text.empty() || text.front() == '-' || text.front() == '+' ? text : '+' + text;
}

std::string Writer::word(std::string_view address, const ir::Value& value, WordPos pos) {
  return std::string(address) + signed_amount(value, pos);
}

void Writer::block(const ir::Block& b) {
  moves_ = b.has_motion && b.motion.moves();
  if (moves_ && has_centre_line(b)) centre_line(b.motion);
  corner_.clear();
  const ir::Statement* call = plan_.call_behind(current());
  if (call != nullptr && !refused()) define_cycle(*call, *lone_call(*call));
  if (!refused()) ProgramWriter::block(b);
  if (call != nullptr && !refused()) {
    add(m_word(99), Rank::machine);
    spindle_again(*lone_call(*call));
  }
  moves_ = false;
  if (corner_.empty() || refused()) return;
  next_line();
  add(corner_, Rank::head);
}

bool Writer::own_line(const ir::Action& a, const ir::Block& b) {
  if (std::holds_alternative<ir::ToolChange>(a.data) || std::holds_alternative<ir::ToolSelect>(a.data) ||
      std::holds_alternative<ir::SetSpindle>(a.data) || std::holds_alternative<ir::FrameOp>(a.data) ||
      std::holds_alternative<ir::WorkOffset>(a.data) || std::holds_alternative<ir::Dwell>(a.data) ||
      std::holds_alternative<ir::CycleDefine>(a.data) || std::holds_alternative<ir::Stop>(a.data))
    return true;
  return ProgramWriter::own_line(a, b);
}

// ---- settings ------------------------------------------------------------------------------------------------------

void Writer::modal_set(const ir::Action& a, const ir::ModalSet& m) {
  const ir::Facts* f = facts();
  const bool in_force = f != nullptr && f->reachable && f->settings[static_cast<std::size_t>(m.setting)] == m.value;
  switch (m.setting) {
    case Setting::plane:
    case Setting::distance: return;  // every word says it itself
    case Setting::retract_plane: return;
    case Setting::units:
      if ((m.value == code_value(ir::Units::inch)) != (unit_ == "INCH"))
        refuse(no_word, a.pos, "a program has one unit here, which its first line says",
               "write the whole program in one unit");
      return;
    case Setting::comp:
      if (in_force && m.value == code_value(ir::CompSide::off) && !side_) return;  // a positioning block says R0 anyway
      if (side_ == ir::CompSide::off && m.value != code_value(ir::CompSide::off)) {  // it ends before it begins anew
        next_line();
        add("L R0", Rank::head, a.pos);
        next_line();
      }
      side_ = static_cast<ir::CompSide>(m.value);
      return;
    case Setting::feed_mode:
      if (m.value == code_value(ir::FeedMode::inverse_time)) break;
      if (!in_force) add(m.value == code_value(ir::FeedMode::per_rev) ? "M136" : "M137", Rank::machine, a.pos);
      return;
    case Setting::path_mode:
      if (m.value == code_value(ir::PathMode::continuous)) return;
      break;
    case Setting::spindle_mode:
      if (m.value == code_value(ir::SpindleMode::rpm)) return;
      break;
    case Setting::diameter:
      if (m.value == code_value(ir::DiameterMode::radius)) return;
      break;
    case Setting::length_comp:
    case Setting::feed_override:
      if (m.value == code_value(ir::OnOff::on)) return;
      break;
    case Setting::feed_point:
      if (m.value == code_value(ir::FeedPoint::centre)) return;
      break;
    default: break;
  }
  ProgramWriter::modal_set(a, m);
}

/// F stands in a move; until one comes it waits. A rapid move takes none.
void Writer::set_feed(const ir::Action& a, const ir::SetFeed& f) {
  if (f.zero_is_maximum && f.value.is(0)) return ProgramWriter::set_feed(a, f);
  // F that stands before the word for inches is in millimetres.
  const bool metric = unit_ == "INCH" && setting(ir::Setting::units) == code_value(ir::Units::metric);
  feed_ = amount(metric ? ir::scale(f.value, 1 / 25.4) : f.value, a.pos);
}

void Writer::set_spindle(const ir::Action& a, const ir::SetSpindle& s) {
  if (s.number != 1) return ProgramWriter::set_spindle(a, s);
  if (!tools_.speed_is_said(a)) add("TOOL CALL S" + amount(s.value, a.pos), Rank::head, a.pos);
}

void Writer::spindle_gear(const ir::Action& a, const ir::SpindleGear& s) {
  if (s.number != 1) return ProgramWriter::spindle_gear(a, s);
  if (gear_told_) return;
  gear_told_ = true;
  diagnostics().note("TRN-271", span_of(a.pos),
                     "the control chooses the gear by the speed: gear functions are left out (said once a program)",
                     "check that the spindle reaches its speed");
}

// ---- tools ---------------------------------------------------------------------------------------------------------

std::string Writer::tool_call(const ir::Action& change) {
  const ir::ToolSelect* tool = tools_.tool_of(change);
  if (tool == nullptr) {
    refuse(no_word, change.pos, "which tool this change brings is not known here, and TOOL CALL names it",
           "write T in the block of the change");
    return {};
  }
  std::string text = "TOOL CALL ";
  text += tool->name.empty() ? amount(tool->number, change.pos) : '"' + std::string(tool->name) + '"';
  text += " Z";
  if (const ir::SetSpindle* speed = tools_.speed_of(change)) text += " S" + amount(speed->value, change.pos);
  return text;
}

void Writer::tool_select(const ir::Action& a, const ir::ToolSelect& t) {
  if (t.changes) return add(tool_call(a), Rank::head, a.pos);
  if (tools_.said_with_change(a)) return;
  add("TOOL DEF " + (t.name.empty() ? amount(t.number, a.pos) : '"' + std::string(t.name) + '"'), Rank::head, a.pos);
}

void Writer::tool_change(const ir::Action& a) {
  add(tool_call(a), Rank::head, a.pos);
}

/// The data of a tool come with it; they have no number of their own.
void Writer::tool_offset(const ir::Action& a, const ir::ToolOffset& t) {
  if (t.number.is(0) && tools_.offset_off_matters(a))
    refuse(no_word, a.pos, "the tool's length and radius are always in force here: D0 has no counterpart",
           "take the length into the positions, or call a tool of length 0");
}

// ---- others --------------------------------------------------------------------------------------------------------

void Writer::old_cycle(int number, const std::vector<std::string>& parts) {
  const std::string head = "CYCL DEF " + std::to_string(number) + '.';
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i != 0) next_line();
    std::string text = head + std::to_string(i);
    if (!parts[i].empty()) text += ' ' + parts[i];
    add(std::move(text), Rank::head);
  }
}

void Writer::dwell(const ir::Action& a, const ir::Dwell& d) {
  if (d.revolutions) return ProgramWriter::dwell(a, d);
  const ir::Value seconds = d.scale == 1 ? d.value : ir::scale(d.value, d.scale);
  old_cycle(9, {"DWELL TIME", "DWELL " + amount(seconds, a.pos)});
}

/// STOP leaves the spindle as it is, M0 would stop it.
void Writer::stop(const ir::Action& a, const ir::Stop& s) {
  add(s.optional ? m_word(1) : "STOP", Rank::tail, a.pos);
}

/// Behind the element whose end is the corner.
void Writer::corner(const ir::Action& a, const ir::Corner& c) {
  if (c.modal || c.kind == ir::CornerKind::chamfer_chord) return ProgramWriter::corner(a, c);
  std::string text = (c.kind == ir::CornerKind::round ? "RND R" : "CHF ") + amount(c.value, a.pos);
  if (c.feed) text += " F" + amount(*c.feed, a.pos);
  if (moves_)
    corner_ = std::move(text);
  else
    add(std::move(text), Rank::head, a.pos);
}

}  // namespace cnctrans::backends::heidenhain
