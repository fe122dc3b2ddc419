// Word blocks ("G-Codes", "M-Codes", "Order of Execution" of the manual).
#include <algorithm>
#include <cmath>

#include "backends/linuxcnc/tables.h"
#include "backends/linuxcnc/writer.h"
#include "dialects/linuxcnc/limits.h"

namespace cnctrans::backends::linuxcnc {
namespace {

namespace facts = dialects::linuxcnc;
constexpr std::string_view no_word = "TRN-202";

bool is_css(const ir::Action& a) {
  const auto* m = std::get_if<ir::ModalSet>(&a.data);
  return m != nullptr && m->setting == Setting::spindle_mode && m->value == code_value(ir::SpindleMode::css);
}

}  // namespace

void Writer::block(const ir::Block& b) {
  block_css_ = block_spindle_ = false;
  for (const ir::Action& a : b.actions) {
    block_css_ = block_css_ || is_css(a);
    block_spindle_ = block_spindle_ || std::holds_alternative<ir::SetSpindle>(a.data);
  }
  // A parameter line and the offset of the tool would come too late, or break the line, where they stand.
  const auto first = [](const ir::Action& a) {
    return a.order != ir::Order::after &&
           (std::holds_alternative<ir::SpindleLimit>(a.data) || std::holds_alternative<ir::ToolOffset>(a.data) ||
            std::holds_alternative<ir::ToolSelect>(a.data) || std::holds_alternative<ir::ToolChange>(a.data));
  };
  ir::Block ordered = b;
  std::stable_partition(ordered.actions.begin(), ordered.actions.end(), first);
  ProgramWriter::block(ordered);
}

bool Writer::own_line(const ir::Action& a, const ir::Block& b) {
  const auto* m = std::get_if<ir::ModalSet>(&a.data);
  const bool early = m != nullptr && (m->setting == Setting::units || m->setting == Setting::diameter);
  if (early || std::holds_alternative<ir::FrameOp>(a.data) || std::holds_alternative<ir::Dwell>(a.data) ||
      std::holds_alternative<ir::SpindleLimit>(a.data) || std::holds_alternative<ir::SpindleOrient>(a.data))
    return true;
  if (const auto* w = std::get_if<ir::WorkOffset>(&a.data); w != nullptr && w->off) return true;
  return ProgramWriter::own_line(a, b);
}

// ---- settings ------------------------------------------------------------------------------------------------------

void Writer::modal_set(const ir::Action& a, const ir::ModalSet& m) {
  switch (m.setting) {
    case Setting::spindle_mode:
      if (m.value == code_value(ir::SpindleMode::rpm)) return add("G97", Rank::setting, a.pos);
      if (!block_spindle_)
        return refuse(no_word, a.pos, "constant cutting speed stands here without its speed",
                      "write S in the block that switches it on");
      return add(has_spindle_limit_ ? "G96 D#<_spindle_limit>" : "G96", Rank::setting, a.pos);
    case Setting::comp: return comp(a, static_cast<ir::CompSide>(m.value));
    case Setting::units:
      if (!m.feed_too) return refuse(no_word, a.pos, "a unit that does not hold for F has no counterpart here");
      break;
    case Setting::retract_plane:
    case Setting::length_comp: return;  // cycles are written out; the length counts with its offset
    case Setting::feed_point:
      if (m.value == code_value(ir::FeedPoint::centre)) return;
      break;
    default: break;
  }
  ProgramWriter::modal_set(a, m);
}

/// Compensation that is on already may not be switched on again; its radius is that of the offset in force.
void Writer::comp(const ir::Action& a, ir::CompSide side) {
  if (side == ir::CompSide::off) return add("G40", Rank::setting, a.pos);
  next_line();  // the offset of the same line would be taken after it
  const ir::Facts* f = facts();
  const auto before = f != nullptr ? f->settings[static_cast<std::size_t>(Setting::comp)] : std::nullopt;
  if (before == code_value(side)) return;
  if (before != code_value(ir::CompSide::off))
    return refuse(no_word, a.pos, "radius compensation that changes its side without G40 has no counterpart here");
  std::string text = side == ir::CompSide::left ? "G41" : "G42";
  if (!offset_.empty() && offset_ != "0") text += " D" + offset_;
  add(std::move(text), Rank::setting, a.pos);
}

void Writer::work_offset(const ir::Action& a, const ir::WorkOffset& w) {
  constexpr std::string_view codes[] = {"G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"};
  if (w.off && shifts_)
    return refuse(no_word, a.pos, "offsets off in a program that shifts its origin has no counterpart here",
                  "take the shift back in the source instead");
  if (w.off) {  // a row of zeros
    std::string zero = "G10 L2 P" + std::to_string(facts::zero_offset_row);
    for (const auto& axis : profile().axes) zero += ' ' + axis.name + '0';
    add(zero + " R0", Rank::setting, a.pos);
    next_line();
    return add(std::string(codes[facts::zero_offset_row - 1]), Rank::setting, a.pos);
  }
  const double row = w.index.number;
  if (!w.index.literal() || row != std::floor(row) || row < 1 || row >= facts::zero_offset_row)
    return refuse(no_word, a.pos, "the work offset must be a number from 1 to 8 here");
  add(std::string(codes[static_cast<std::size_t>(row) - 1]), Rank::setting, a.pos);
}

/// G52 replaces the shift of the axes that it names.
void Writer::frame_op(const ir::Action& a, const ir::FrameOp& f) {
  const ir::FrameChange& c = *f.change;
  const bool clear = c.combine == ir::FrameCombine::clear;
  const bool fits = c.slot == ir::FrameSlot::shift && !c.by_distance_mode &&
                    (clear || c.combine == ir::FrameCombine::replace || c.combine == ir::FrameCombine::replace_named);
  if (!fits) return refuse(no_word, a.pos, "this shift, rotation, scale or mirror has no counterpart here");
  std::string text = "G52";
  if (clear || c.combine == ir::FrameCombine::replace) {
    for (const auto& axis : profile().axes) {
      bool named = false;
      for (const ir::FrameWord& w : c.words) named = named || (!clear && w.axis == axis.id);
      if (!named) text += ' ' + axis.name + '0';
    }
  }
  for (const ir::FrameWord& w : c.words) {
    if (clear) break;
    const machine::AxisSpec* axis = profile().axis(w.axis);
    if (w.scale != ir::WordScale::modal && axis != nullptr && axis->diameter) {
      const bool diameter = setting(Setting::diameter) == code_value(ir::DiameterMode::diameter);
      if (diameter != (w.scale == ir::WordScale::diameter))
        return refuse(no_word, w.pos, "a shift that is not in the diameter mode in force has no counterpart here");
    }
    text += ' ' + word(axis_name(w.axis), w.value, w.pos);
  }
  add(std::move(text), Rank::setting, a.pos);
}

void Writer::dwell(const ir::Action& a, const ir::Dwell& d) {
  if (d.revolutions) return refuse(no_word, a.pos, "a dwell in revolutions has no counterpart here");
  add("G4 " + word("P", d.scale == 1 ? d.value : ir::scale(d.value, d.scale), a.pos), Rank::setting, a.pos);
}

/// Cycles are written out as moves: none is ever active.
void Writer::cycle_cancel(const ir::Action& /*a*/) {}

// ---- feed, spindle, tool, M ----------------------------------------------------------------------------------------

void Writer::set_feed(const ir::Action& a, const ir::SetFeed& f) {
  if (f.value.literal() && f.value.number < 0) return refuse(no_word, a.pos, "a feed below 0 has no counterpart here");
  ProgramWriter::set_feed(a, f);
}

void Writer::set_spindle(const ir::Action& a, const ir::SetSpindle& s) {
  if (s.value.literal() && s.value.number < 0)
    return refuse(no_word, a.pos, "a spindle speed below 0 has no counterpart here");
  ProgramWriter::set_spindle(a, s);
}

void Writer::spindle_orient(const ir::Action& a, const ir::SpindleOrient& s) {
  if (s.number != 1) return refuse(no_word, a.pos, "a second spindle has no counterpart here");
  if (!s.angle.literal())  // R takes 0 to 360; MOD is never negative here
    return add("M19 R[[" + expression_text(s.angle.expr, a.pos) + "] MOD 360]", Rank::machine, a.pos);
  const double turned = std::fmod(s.angle.number, 360.0);
  const bool inside = s.angle.number >= 0 && s.angle.number <= 360;
  add("M19 " + word("R", inside ? s.angle : ir::Value(turned < 0 ? turned + 360 : turned), a.pos), Rank::machine,
      a.pos);
}

/// The limit belongs to G96 here: it is kept in a parameter until then.
void Writer::spindle_limit(const ir::Action& a, const ir::SpindleLimit& s) {
  if (s.number != 1 || s.lower) return refuse(no_word, a.pos, "this spindle speed limit has no counterpart here");
  const bool off = setting(Setting::spindle_mode) == code_value(ir::SpindleMode::rpm);
  if (!off && !block_css_)
    return refuse(no_word, a.pos, "a spindle speed limit that changes while the cutting speed is constant",
                  "write the limit before the constant cutting speed");
  std::string text = word("", s.value, a.pos);
  add("#<_spindle_limit> = " + text, Rank::head);
}

void Writer::spindle_gear(const ir::Action& a, const ir::SpindleGear& s) {
  diagnostics().warning("TRN-263", span_of(a.pos),
                        (s.automatic ? std::string("M40") : 'M' + std::to_string(40 + s.gear)) +
                            " is a gear range, which LinuxCNC does not have: left out",
                        "check that the spindle reaches its speed");
}

void Writer::tool_offset(const ir::Action& a, const ir::ToolOffset& t) {
  if (const auto side = setting(Setting::comp); side != code_value(ir::CompSide::off)) {
    return refuse(no_word, a.pos, "a tool offset that changes under radius compensation has no counterpart here",
                  "switch the compensation off before it");
  }
  if (t.number.is(0)) {
    offset_ = "0";
    return add("G49", Rank::offset, a.pos);
  }
  const std::string number = word("", t.number, a.pos);
  offset_ = number;
  add("G43 H" + number, Rank::offset, a.pos);
}

void Writer::machine_function(const ir::Action& a, const ir::MachineFunction& m) {
  const bool user = m.code >= facts::user_m_min && m.code <= facts::user_m_max;
  if (!user && !m.auxiliary && !m.computed)
    return refuse(no_word, a.pos, m_word(m.code) + " is a function of the source machine: LinuxCNC takes M100 to M199",
                  "say in the machine profile what it does, or leave it out with --unsupported=comment");
  ProgramWriter::machine_function(a, m);
}

// ---- motion --------------------------------------------------------------------------------------------------------

void Writer::motion(const ir::Motion& m) {
  if (m.kind == ir::MotionKind::thread && m.coords.size() != 1)
    return refuse(no_word, m.code_pos, "a thread along two axes has no counterpart here (K counts along the path)");
  const bool probes = m.kind == ir::MotionKind::probe_toward || m.kind == ir::MotionKind::probe_away;
  const ir::Facts* f = probes ? facts() : nullptr;
  if (f != nullptr && f->settings[static_cast<std::size_t>(Setting::feed_mode)] != code_value(ir::FeedMode::per_minute))
    return refuse(no_word, m.code_pos, "a probing move while F counts per revolution has no counterpart here",
                  "write G94 and its F before it");
  ProgramWriter::motion(m);
}

void Writer::frame_use(const ir::Motion& m) {
  if (m.frame == ir::FrameUse::normal) return;
  if (m.frame != ir::FrameUse::machine || setting(Setting::distance) != code_value(ir::Distance::absolute))
    return refuse(no_word, m.frame_pos, "this move in machine coordinates has no counterpart here (G53 needs G90)");
  add("G53", Rank::frame, m.frame_pos);
}

void Writer::coordinate(const ir::Motion& /*m*/, const ir::CoordWord& w) {
  const machine::AxisSpec* axis = profile().axis(w.axis);
  if (axis == nullptr)
    return refuse(no_word, w.pos, "the target machine has no axis " + std::string(axis_name(w.axis)));
  if (w.mode != ir::WordMode::modal) {
    const auto wanted = w.mode == ir::WordMode::absolute ? ir::Distance::absolute : ir::Distance::incremental;
    if (setting(Setting::distance) != code_value(wanted))
      return refuse(no_word, w.pos, "a word that is absolute or incremental by itself has no counterpart here");
  }
  if (w.scale != ir::WordScale::modal && axis->diameter) {
    const auto wanted = w.scale == ir::WordScale::radius ? ir::DiameterMode::radius : ir::DiameterMode::diameter;
    if (setting(Setting::diameter) != code_value(wanted))
      return refuse(no_word, w.pos, "a word that is radius or diameter by itself has no counterpart here");
  }
  if (w.direction != ir::RotaryDirection::as_value)
    return refuse(no_word, w.pos, "the direction of this rotary move has no counterpart here");
  add(word(axis_name(w.axis), w.value, w.pos), Rank::coordinate, w.pos);
}

void Writer::motion_extra(const ir::Motion& m, const ir::MotionExtra& e) {
  const bool other = e.has_pitch || e.has_angle || !e.through.empty() || e.has_polar_radius || e.has_polar_angle ||
                     e.has_line_angle || (e.has_start_angle && !e.start_angle.is(0)) || !e.lead_change.is(0);
  if (other) return ProgramWriter::motion_extra(m, e);
  if (e.has_turns) {  // P1 is an arc of less than a turn
    add(word("P", ir::add(e.turns, ir::Value(1)), m.code_pos), Rank::motion_extra);
  }
  if (e.has_lead) add(word("K", e.lead, m.code_pos), Rank::motion_extra);
}

}  // namespace cnctrans::backends::linuxcnc
