// Words of NUM blocks: motion, frames, cycles.
#include <algorithm>
#include <array>
#include <cmath>

#include "backends/num/style.h"
#include "backends/num/writer.h"
#include "base/text.h"
#include "dialects/num/limits.h"
#include "dialects/num/options.h"

namespace cnctrans::backends::num {

namespace facts = dialects::num;

namespace {

constexpr std::string_view no_cycle = "TRN-214";

}  // namespace

void Writer::block(const ir::Block& b) {
  cycle_here_ = cancelled_ = false;
  for (const auto& a : b.actions) cancelled_ = cancelled_ || std::holds_alternative<ir::CycleCancel>(a.data);
  for (const auto& a : b.actions) cycle_here_ = cycle_here_ || std::holds_alternative<ir::CycleDefine>(a.data);
  if (same_dialect() && to_plane(b)) return;
  ProgramWriter::block(b);
  const ir::LineInfo& info = current().line;
  const bool blank = info.span.known() && (same_dialect() || trim(source_line(info.span)).empty());
  if (b.empty() && blank) return finish_line();
  // A cycle that runs once: here every cycle is modal and must be ended.
  for (const auto& a : b.actions) {
    const auto* d = std::get_if<ir::CycleDefine>(&a.data);
    if (d == nullptr || d->modal || refused() || same_dialect()) continue;
    if (d->cycle && std::holds_alternative<ir::NamedCycle>(d->cycle->node)) continue;  // G33 ends by itself
    next_line();
    add("G80", Rank::setting);
  }
}

/// A block that goes to another retract plane and drills nothing: ER alone. True: it is written.
bool Writer::to_plane(const ir::Block& b) {
  const auto& coords = b.motion.coords;
  if (!b.has_motion || coords.size() != 1 || b.actions.size() != 1) return false;
  const auto* d = std::get_if<ir::CycleDefine>(&b.actions[0].data);
  if (d == nullptr || d->here || coords[0].pos.column == 0 || coords[0].pos.column != b.actions[0].pos.column)
    return false;
  const std::string text = to_upper_ascii(source_line(current().line.span));
  const std::size_t at = coords[0].pos.column - 1;
  if (at > text.size() || text.compare(at, 2, "ER") != 0) return false;
  for (const std::string_view other : {"EH", "EF", "EP", "ES", "P", "Q"}) {
    if (text.find(other) != std::string::npos) return false;
  }
  add(word("ER", coords[0].value, coords[0].pos), Rank::motion_extra, coords[0].pos);
  return true;
}

/// The source writes this word behind an axis word of its block.
bool Writer::behind_words(WordPos pos) const {
  const auto* b = std::get_if<ir::Block>(&current().node);
  if (b == nullptr || !b->has_motion) return false;
  return std::any_of(b->motion.coords.begin(), b->motion.coords.end(),
                     [pos](const ir::CoordWord& w) { return w.pos.column < pos.column; });
}

// ---- settings and machine functions
// ------------------------------------------------------------------------------------

void Writer::modal_set(const ir::Action& a, const ir::ModalSet& m) {
  freezes_speed(a, m);
  if (same_dialect() && !a.text.empty()) {
    const bool contact = m.setting == ir::Setting::feed_point;  // its word is R
    return add((contact ? "G92 " : "") + std::string(a.text), Rank::setting, a.pos);
  }
  switch (m.setting) {
    case ir::Setting::path_mode:
      if (m.value == code_value(ir::PathMode::continuous)) return;  // what the control does without being told
      break;
    case ir::Setting::diameter: {
      const auto fixed = profile().kind == machine::Kind::lathe ? ir::DiameterMode::diameter : ir::DiameterMode::radius;
      if (m.value == code_value(fixed)) return;  // the machine's fixed mode
      break;
    }
    case ir::Setting::length_comp:
    case ir::Setting::feed_point:
      if (m.value == code_value(ir::OnOff::on) || m.setting == ir::Setting::feed_point) return;
      break;
    case ir::Setting::spindle_mode: {  // what a G94 of the source ends beside
      const ir::Facts* f = facts();
      const auto before = f != nullptr ? f->settings[static_cast<std::size_t>(m.setting)] : std::nullopt;
      const bool rpm = m.value == code_value(ir::SpindleMode::rpm) && before == m.value;
      if (profile().kind == machine::Kind::mill && rpm && !same_dialect() && a.text.empty()) return;
      break;
    }
    default: break;
  }
  // G90 and G91 hold from their place on: a code for the whole block stands before its axis words.
  const bool positional = m.setting == ir::Setting::distance || m.setting == ir::Setting::units;
  if (positional && a.order != ir::Order::after && !same_dialect() && behind_words(a.pos)) {
    ir::Action front = a;
    front.pos = {};
    return ProgramWriter::modal_set(front, m);
  }
  ProgramWriter::modal_set(a, m);
}

void Writer::spindle_orient(const ir::Action& a, const ir::SpindleOrient& s) {
  if (s.number != 1) return refuse(no_word, a.pos, "orienting a second spindle has no counterpart here");
  const std::string code = same_dialect() && !a.text.empty() ? std::string(a.text) : m_word(19);
  add(word("EC", s.angle, a.pos) + ' ' + code, Rank::machine, a.pos);
}

bool Writer::spelling_is_whole_word(const ir::Action& a) const {
  // The S of G92 S is half of its word.
  // ... and so is the M19 of EC M19.
  return !std::holds_alternative<ir::SpindleLimit>(a.data) && !std::holds_alternative<ir::SpindleOrient>(a.data) &&
         ProgramWriter::spelling_is_whole_word(a);
}

void Writer::spindle_limit(const ir::Action& a, const ir::SpindleLimit& s) {
  if (s.number != 1 || s.lower) return refuse(no_word, a.pos, "this spindle limit has no counterpart here");
  tell_limit(a, s);
  if (!line().empty() && !same_dialect()) next_line();
  add("G92", Rank::setting, same_dialect() ? a.pos : WordPos{});
  add(word("S", s.value, a.pos), Rank::spindle, a.pos);
  if (!same_dialect()) next_line();
}

void Writer::dwell(const ir::Action& a, const ir::Dwell& d) {
  if (d.revolutions) return refuse(no_word, a.pos, "a dwell in revolutions has no counterpart here");
  ir::Value seconds = ir::scale(d.value, d.scale);
  if (seconds.literal() && !seconds.is(0) && (seconds.number < facts::dwell_min || seconds.number > facts::dwell_max) &&
      !same_dialect()) {
    return refuse(no_word, a.pos,
                  "a dwell of " + shortest(seconds.number) + " s is outside the control's 0.01 to 99.99 s");
  }
  if (d.scale == 1) seconds = d.value;
  const std::string code = same_dialect() && !a.text.empty() ? std::string(a.text) : "G4";
  add(code, Rank::setting, a.pos);
  add(word("F", seconds, a.pos), Rank::feed);
}

// ---- motion
// --------------------------------------------------------------------------------------------------------------

void Writer::motion(const ir::Motion& m) {
  const bool bare = m.coords.empty() && m.centers.empty() && !m.extra && !m.explicit_code;
  if (same_dialect() && m.kind == ir::MotionKind::linear && bare)  // what G23 leaves in force
    return motion_tracker().wrote(m.kind, true);
  if (m.kind == ir::MotionKind::probe_toward && same_dialect()) {
    ir::Motion line = m;
    line.explicit_code = !m.code_text.empty();
    line.kind = line.explicit_code ? ir::MotionKind::linear : ir::MotionKind::modal;
    line.keeps_modal = true;
    ProgramWriter::motion(line);
    return add("G10", Rank::tail);
  }
  if (m.kind == ir::MotionKind::thread && profile().kind != machine::Kind::lathe)
    return refuse(no_word, m.code_pos, "a thread cut in one move exists on lathes only (G38)");
  const bool may_thread = !same_dialect() && profile().kind == machine::Kind::lathe;
  const ir::Facts* before = may_thread && m.kind == ir::MotionKind::modal && m.moves() ? facts() : nullptr;
  const bool goes_on = before != nullptr && before->reachable && before->motion == ir::MotionKind::thread;
  if (goes_on || (may_thread && m.kind == ir::MotionKind::thread && m.keeps_modal)) {  // G38 holds in its block
    ir::Motion thread = m;
    thread.kind = ir::MotionKind::thread;
    thread.explicit_code = true;
    thread.keeps_modal = false;
    motion(thread);
    return motion_tracker().keeps_on(ir::MotionKind::thread);
  }
  if (!same_dialect() && m.kind == ir::MotionKind::modal && m.moves() &&
      begins_css()) {  // X beside G96 alone moves nothing
    const ir::Facts* f = facts();
    const auto kind = f != nullptr && f->reachable ? f->motion : motion_tracker().text();
    if (!kind) return refuse("TRN-216", {}, "a move beside G96 needs its motion code, which is not known here");
    ir::Motion said = m;
    said.kind = *kind;
    said.explicit_code = true;
    said.keeps_modal = true;
    return motion(said);
  }
  // Positions of a cycle are reached in rapid without a code; one beside the cycle is an error of the control.
  bool in_cycle = cycle_here_;
  if (!in_cycle && !same_dialect()) {
    const ir::Facts* f = facts();
    in_cycle = f != nullptr && f->cycle_active_known && f->cycle_active && !cancelled_;
  }
  const bool rapid = m.kind == ir::MotionKind::rapid || (m.kind == ir::MotionKind::modal && !same_dialect());
  const bool silent = in_cycle && rapid && (!same_dialect() || !m.explicit_code);
  if (!silent) {
    ProgramWriter::motion(m);
    if (machine_frame_in_incremental(m)) add("G91", Rank::center);
    return;
  }
  frame_use(m);
  for (const auto& w : m.coords) coordinate(m, w);
  if (m.extra) motion_extra(m, *m.extra);
}

/// G52 needs G90: the mode in force comes back behind the words.
bool Writer::machine_frame_in_incremental(const ir::Motion& m) {
  return m.frame == ir::FrameUse::machine && !same_dialect() &&
         setting(ir::Setting::distance) == code_value(ir::Distance::incremental);
}

void Writer::frame_use(const ir::Motion& m) {
  if (m.frame == ir::FrameUse::normal) return;
  if (m.frame != ir::FrameUse::machine)
    return refuse(no_word, m.frame_pos,
                  "a move in machine coordinates that keeps the tool length has no counterpart here");
  if (same_dialect()) return add("G52", Rank::frame, m.frame_pos);
  const auto mode = setting(ir::Setting::distance);
  for (const auto& w : m.coords) {
    if (increment(w) || (w.mode == ir::WordMode::modal && !mode))
      return refuse(no_word, w.pos,
                    "an incremental move in machine coordinates has no counterpart here (G52 needs G90)",
                    "write the position in machine coordinates");
  }
  if (!mode) return refuse(no_word, m.frame_pos, "a move in machine coordinates stands where G90 or G91 is not known");
  // It stands before the words it counts for.
  add(machine_frame_in_incremental(m) ? "G90 G52" : "G52", Rank::frame,
      behind_words(m.frame_pos) ? WordPos{} : m.frame_pos);
}

void Writer::coordinate(const ir::Motion& m, const ir::CoordWord& w) {
  if (same_dialect() && w.pos.column != 0) return add(word(axis_name(w.axis), w.value, w.pos), Rank::coordinate, w.pos);
  if (w.scale != ir::WordScale::modal) {
    const bool diameter_machine = profile().kind == machine::Kind::lathe && w.axis == ir::axis::x;
    const bool fits = (w.scale == ir::WordScale::diameter) == diameter_machine;
    if (!fits) return refuse(no_word, w.pos, "a word in radius or diameter by itself has no counterpart here");
  }
  const bool turning_by_sign = w.direction == ir::RotaryDirection::by_sign;
  if (w.direction != ir::RotaryDirection::as_value && !turning_by_sign)
    return refuse(no_word, w.pos, "the direction of this rotary move has no counterpart here");
  if (ir::is_rotary_letter(w.axis) && !turning_by_sign && !increment(w)) {  // an increment has its sign (6.12)
    const std::string& modulo = profile().policies.rotary_signed_axes;
    const bool safe = w.value.literal() && w.value.number >= 0 && w.value.number < 360;
    if (modulo.find(axis_name(w.axis)) != std::string::npos && !safe) {
      return refuse(no_word, w.pos,
                    "on this machine the sign of a rotary position is the direction of travel: the position cannot be "
                    "written as it is",
                    "say in the target profile that the axis does not roll over (num.rotary_modulo)");
    }
  }
  if (w.value.literal() && !(std::fabs(w.value.number) <= facts::linear_max))
    return refuse(no_word, w.pos, "the coordinate is beyond what the control takes");
  if (w.mode != ir::WordMode::modal && !setting(ir::Setting::distance))
    return refuse(no_word, w.pos,
                  "a word that is absolute or incremental by itself stands where G90 or G91 is not known");
  if (turning_by_sign && w.value.is(0) && std::signbit(w.value.number))  // backwards to 0
    return add(std::string(axis_name(w.axis)) + "-0", Rank::coordinate, w.pos);
  if (!switched(m, w)) return add(word(axis_name(w.axis), w.value, w.pos), Rank::coordinate, w.pos);
  // One pair of G90 and G91 in a block: the words between them stand together.
  std::string text;
  for (const auto& c : m.coords) {
    if (!switched(m, c)) continue;
    if (text.empty() && &c != &w) return;  // stands with the first of them
    text += ' ' + word(axis_name(c.axis), c.value, c.pos);
  }
  const bool absolute = w.mode == ir::WordMode::absolute;
  add((absolute ? "G90" : "G91") + text + (absolute ? " G91" : " G90"), Rank::coordinate, w.pos);
}

/// The word is absolute or incremental by itself, other than the mode in force.
bool Writer::switched(const ir::Motion& m, const ir::CoordWord& w) {
  const auto mode = setting(ir::Setting::distance);
  if (w.mode == ir::WordMode::modal || !mode || m.frame != ir::FrameUse::normal) return false;
  const auto wanted = w.mode == ir::WordMode::absolute ? ir::Distance::absolute : ir::Distance::incremental;
  return *mode != code_value(wanted);
}

void Writer::center(const ir::Motion& /*m*/, const ir::CenterWord& w) {
  if (inverse_time_arc(w.pos)) return;
  if (w.axis > ir::axis::z) return refuse(no_word, w.pos, "the centre of an arc on this axis has no counterpart here");
  const bool from_start = own_options_.centre == facts::ArcCentre::incremental;
  const auto mode = setting(ir::Setting::distance);
  bool fits = same_dialect() && w.pos.column != 0;
  switch (w.mode) {
    case ir::CenterMode::follows_distance: fits = fits || !from_start; break;
    case ir::CenterMode::absolute: fits = fits || (!from_start && mode == code_value(ir::Distance::absolute)); break;
    case ir::CenterMode::from_start: fits = fits || from_start || mode == code_value(ir::Distance::incremental); break;
  }
  if (!fits) return refuse(no_word, w.pos, "this form of an arc's centre has no counterpart here");
  constexpr std::string_view letters = "IJK";
  add(word(letters.substr(w.axis, 1), w.value, w.pos), Rank::center, w.pos);
}

/// Reference 7: no arcs under G93.
bool Writer::inverse_time_arc(WordPos pos) {
  if (same_dialect() || setting(ir::Setting::feed_mode) != code_value(ir::FeedMode::inverse_time)) return false;
  refuse(no_word, pos, "an arc with an inverse-time feed has no counterpart here: G93 takes no G2 and G3",
         "write the feed of the arc in mm/min");
  return true;
}

void Writer::radius(const ir::Motion& m) {
  if (inverse_time_arc(m.radius_pos)) return;
  if (m.radius.literal() && m.radius.number < 0)
    return refuse(no_word, m.radius_pos, "an arc over 180 degrees by its radius has no counterpart here");
  ProgramWriter::radius(m);
}

/// EA and EX of a polar end point, K of a thread.
void Writer::straight_extra(const ir::Motion& m, const ir::MotionExtra& e) {
  if (e.has_pitch || (e.has_start_angle && !e.start_angle.is(0)) || !e.lead_change.is(0))
    return refuse(no_word, m.code_pos, "the start angle or changing pitch of a thread has no counterpart here");
  if (e.has_lead) return add(word("K", e.lead, m.code_pos), Rank::motion_extra);
  // The polar form counts from the origin; elsewhere the pole moves.
  if (!e.has_polar_angle || !e.has_polar_radius || !same_dialect())
    return refuse(no_word, m.code_pos, "this polar end point has no counterpart here");
  add(word("EA", e.polar_angle, m.code_pos), Rank::motion_code);
  add(word("EX", e.polar_radius, m.code_pos), Rank::motion_code);
}

void Writer::motion_extra(const ir::Motion& m, const ir::MotionExtra& e) {
  if (same_dialect() && m.kind == ir::MotionKind::arc_through_point) {  // G23
    for (const auto& w : e.through)
      add(word(std::string(1, "IJK"[w.axis % 3]), w.value, w.pos), Rank::motion_extra, w.pos);
    return;
  }
  const bool through = !e.through.empty() || e.has_turns || e.has_angle;
  const bool alone = !through && !e.has_pitch && !e.has_polar_angle && !e.has_polar_radius && !e.has_lead;
  if (alone) {  // a line by its angle, or an element whose end follows from the next one
    if (e.has_line_angle) add(word("EA", e.line_angle, m.code_pos), Rank::motion_code);
    return;
  }
  if (!through && (e.has_polar_angle || e.has_polar_radius || e.has_lead)) return straight_extra(m, e);
  const bool only_pitch = e.has_pitch && !e.has_turns && !e.has_angle && e.through.empty() && !e.has_polar_radius &&
                          !e.has_polar_angle && !e.has_line_angle && !e.has_lead && !e.has_start_angle;
  if (!only_pitch) {
    return ProgramWriter::motion_extra(m, e);
  }
  const auto plane = setting(ir::Setting::plane);
  if (!plane) return refuse(no_word, m.code_pos, "a helix stands where the plane is not known");
  constexpr std::string_view letters = "IJK";
  const ir::AxisId normal = ir::plane_axes(static_cast<ir::Plane>(*plane)).w;
  add(word(letters.substr(normal, 1), e.pitch, m.code_pos), Rank::motion_extra);
}

void Writer::corner(const ir::Action& a, const ir::Corner& c) {
  if (c.modal || c.feed || c.kind == ir::CornerKind::chamfer_chord)
    return refuse(no_word, a.pos, "this corner has no counterpart here");
  add(word(c.kind == ir::CornerKind::round ? "EB" : "EB-", c.value, a.pos), Rank::motion_extra,
      same_dialect() ? a.pos : WordPos{});
}

// ---- cycles
// --------------------------------------------------------------------------------------------------------------

std::string Writer::level_word(std::string_view address, const ir::Level& level, WordPos pos) {
  return word(address, level.value, pos);
}

void Writer::hole_levels(const ir::Action& a, const ir::HoleCycle& c) {
  const auto at_call = [](const ir::Level& l) {
    return l.given && l.base == ir::LevelBase::from_initial && l.value.is(0);
  };
  bool retract_at_call = c.retract.given && at_call(c.retract);
  ir::Level retract = c.retract;
  if (!c.retract.given) {
    const auto plane = setting(ir::Setting::retract_plane);
    if (!plane) return refuse(no_cycle, a.pos, "where the cycle goes back to is not known here");
    retract_at_call = *plane == code_value(ir::RetractPlane::initial);
    if (!retract_at_call) retract = c.reference;
  }
  const bool reference_at_call = at_call(c.reference);
  if (!retract_at_call) add(level_word("ER", retract, a.pos), Rank::motion_extra);
  const bool same = !retract_at_call && ir::equal(retract.value, c.reference.value);
  if (!same_dialect() && c.retract.given && !c.approach_by_retract && !same && !retract_at_call) {
    diagnostics().warning(
        "TRN-243", current().line.span,
        "the height of the tool before this cycle is not known; it goes to the retract plane first here",
        "the hole is the same; check the move to the retract plane");
  }
  if (reference_at_call || same) return;
  if (!later_family(own_options_))
    return refuse(no_cycle, a.pos, "this control has no separate plane where the feed starts (EH)",
                  "use --cycles=explode");
  const bool up = own_options_.peck_withdraw == facts::PeckWithdraw::er;
  if (c.kind == ir::HoleKind::peck_full && !same_dialect() && up != c.pecks.withdraws_to_retract)
    return refuse(no_cycle, a.pos, "between its pecks this cycle withdraws to another height (num.g83_withdraw)",
                  "use --cycles=explode");
  add(level_word("EH", c.reference, a.pos), Rank::motion_extra);
}

void Writer::hole_cycle(const ir::Action& a, const ir::HoleCycle& c) {
  if (c.kind == ir::HoleKind::mill && (same_dialect() || native_pocket(c))) return pocket(a, c);
  if (!native_hole(c))
    return refuse(no_cycle, a.pos, "this cycle is not one of this control's", "use --cycles=explode");
  const bool chips = c.kind == ir::HoleKind::peck_break;
  const ir::Value& dwell = chips ? c.pecks.dwell : c.dwell_bottom;
  const bool dwells = !dwell.is(0);
  const bool peck = chips || c.kind == ir::HoleKind::peck_full;
  const std::string_view code = [&]() -> std::string_view {
    switch (c.kind) {
      case ir::HoleKind::peck_full: return "G83";
      case ir::HoleKind::tap:
      case ir::HoleKind::tap_floating: return "G84";
      case ir::HoleKind::bore_shift: return "G86";
      case ir::HoleKind::bore_manual: return "G88";
      case ir::HoleKind::ream: return dwells ? "G89" : "G85";
      case ir::HoleKind::peck_break: return "G87";
      default: return dwells ? "G82" : "G81";
    }
  }();
  add(same_dialect() && !a.text.empty() ? std::string(a.text) : std::string(code), Rank::setting, a.pos);
  const ir::AxisId axis = [&] {
    if (c.axis != ir::axis::none) return c.axis;
    const auto plane = setting(ir::Setting::plane);
    return plane ? ir::plane_axes(static_cast<ir::Plane>(*plane)).w : ir::axis::z;
  }();
  const auto plane = setting(ir::Setting::plane);
  if (c.axis != ir::axis::none && profile().kind != machine::Kind::lathe && !same_dialect() &&
      (!plane || ir::plane_axes(static_cast<ir::Plane>(*plane)).w != c.axis))
    return refuse(no_cycle, a.pos, "a cycle along another axis than the normal of the plane has no counterpart here",
                  "choose the plane that the axis stands on");
  // Depth and planes are absolute; the positions stand before them and keep the mode in force.
  const auto mode = setting(ir::Setting::distance);
  if (!mode && !same_dialect()) return refuse(no_cycle, a.pos, "a cycle stands where G90 or G91 is not known");
  const bool incremental = mode == code_value(ir::Distance::incremental) && !same_dialect();
  add((incremental ? "G90 " : "") + level_word(axis_name(axis), c.bottom, a.pos), Rank::center);
  hole_levels(a, c);
  if (incremental) add("G91", Rank::motion_extra);
  if (dwells) add(word("EF", c.dwell_scale == 1 ? dwell : ir::scale(dwell, c.dwell_scale), a.pos), Rank::motion_extra);
  if (c.kind == ir::HoleKind::tap) add(word("K", c.pitch, a.pos), Rank::motion_extra);
  if (c.kind == ir::HoleKind::bore_shift && !c.orient_angle.is(0))
    add(word("EC", c.orient_angle, a.pos), Rank::motion_extra);
  if (!peck) return;
  add(word("P", c.pecks.first, a.pos), Rank::motion_extra);
  if (c.pecks.law == ir::PeckLaw::linear) add(word("Q", c.pecks.minimum, a.pos), Rank::motion_extra);
  const bool inch = setting(ir::Setting::units) == code_value(ir::Units::inch);
  const bool usual = c.pecks.reapproach.is(inch ? facts::reapproach / 25.4 : facts::reapproach);
  if (chips ? !c.pecks.reapproach.is(0) : !usual) add(word("EP", c.pecks.reapproach, a.pos), Rank::motion_extra);
}

void Writer::cycle_define(const ir::Action& a, const ir::CycleDefine& c) {
  const auto* hole = c.cycle ? std::get_if<ir::HoleCycle>(&c.cycle->node) : nullptr;
  const auto* named = c.cycle ? std::get_if<ir::NamedCycle>(&c.cycle->node) : nullptr;
  const bool own = named != nullptr && (same_dialect() || named->name == "thread.chased");
  if (own && turning_cycle(a, *named)) return;
  if (hole == nullptr) return ProgramWriter::cycle_define(a, c);
  hole_cycle(a, *hole);
}

void Writer::cycle_cancel(const ir::Action& a) {
  add("G80", Rank::setting, a.pos);
}

}  // namespace cnctrans::backends::num
