// Motion, corners and cycles (manual ch. 6, 10, 25.2).
#include <algorithm>
#include <cmath>

#include "backends/fagor/tables.h"
#include "backends/fagor/writer.h"
#include "base/text.h"
#include "dialects/fagor/cycles.h"
#include "dialects/fagor/limits.h"
#include "dialects/fagor/patterns.h"
#include "dialects/fagor/pockets.h"
#include "ir/edit/search.h"

namespace cnctrans::backends::fagor {
namespace {

using dialects::fagor::Use;

constexpr std::string_view no_cycle = "TRN-214";

constexpr const char* plain_axis =
    "the direction of this rotary move is lost: the axis of the target is no rollover axis";
constexpr const char* rollover_hint = "on a rollover axis set the option fagor.rotary_rollover of the target to yes";

const ir::CycleDefine* cycle_of(const ir::Block* b) {
  if (b == nullptr) return nullptr;
  for (const ir::Action& a : b->actions) {
    if (const auto* c = std::get_if<ir::CycleDefine>(&a.data)) return c;
  }
  return nullptr;
}

bool is_straight(ir::MotionKind k) {
  return k == ir::MotionKind::rapid || k == ir::MotionKind::linear;
}

}  // namespace

bool Writer::absolute_center(const ir::CenterWord& c) {
  if (c.mode != ir::CenterMode::follows_distance) return c.mode == ir::CenterMode::absolute;
  const auto distance = known<ir::Distance>(ir::Setting::distance);
  if (!distance)
    refuse(no_word, c.pos, "whether the centre of this arc is absolute depends on the path that leads here");
  return distance == ir::Distance::absolute;
}

/// The sign of an absolute rotary word is its direction (3.7).
bool Writer::rollover() const {
  return profile().policies.rotary_rollover;
}

/// On a rollover axis a plain word is a place and its sign a direction, and whether the axis is one nobody knows here.
void Writer::tell_rotary(const ir::CoordWord& w) {
  const bool plain = same_dialect() || !ir::is_rotary_letter(w.axis) || rotary_told_ ||
                     known<ir::Distance>(ir::Setting::distance) == ir::Distance::incremental ||
                     known<ir::Surface>(ir::Setting::surface).value_or(ir::Surface::none) != ir::Surface::none;
  if (plain) return;
  rotary_told_ = true;
  say_rotary(axis_name(w.axis), span_of(w.pos), diagnostics());
}

bool Writer::curve_in_force() {
  const auto text = motion_tracker().text();
  const auto kind = text || facts() == nullptr ? text : facts()->motion;
  return kind && !is_straight(*kind);
}

/// An arc has both end coordinates of its plane, or an angle about its centre (29.1, error 43). False: refused.
bool Writer::arc_ends(const ir::Motion& m) {
  const bool arc = m.kind == ir::MotionKind::arc_cw || m.kind == ir::MotionKind::arc_ccw ||
                   (m.kind == ir::MotionKind::modal && (m.radius_given || !m.centers.empty()));
  if (!arc || (m.extra && (m.extra->has_polar_angle || m.extra->has_polar_radius))) return true;
  const auto plane = known<ir::Plane>(ir::Setting::plane);
  const ir::PlaneAxes axes = ir::plane_axes(plane.value_or(plane_by_text_));
  const auto given = std::count_if(m.coords.begin(), m.coords.end(),
                                   [&axes](const ir::CoordWord& c) { return c.axis == axes.u || c.axis == axes.v; });
  const bool surface = std::any_of(m.coords.begin(), m.coords.end(), [](const ir::CoordWord& c) {
    return ir::is_rotary_letter(c.axis);
  });  // face, cylinder
  if (given != 1 || surface) return true;
  if (plane) {
    refuse("TRN-314", m.code_pos,
           "the target wants both end coordinates of an arc, and the point before is not known here",
           "write both end coordinates");
  } else {
    refuse("TRN-312", m.code_pos,
           "the target wants both end coordinates of an arc, and its plane depends on the path that leads here",
           "write the plane before this block on every path");
  }
  return false;
}

/// A cycle's block reaches its point in rapid without a motion code of its own (25.3).
void Writer::motion(const ir::Motion& m) {
  ir::Motion copy;
  const ir::Motion* use = &m;
  const auto own = [&]() -> ir::Motion& {
    if (use != &copy) copy = m;
    use = &copy;
    return copy;
  };
  const auto by_axis = [](const auto& a, const auto& b) { return a.axis < b.axis; };
  if (!same_dialect() && !std::is_sorted(m.coords.begin(), m.coords.end(), by_axis)) {
    std::stable_sort(own().coords.begin(), own().coords.end(), by_axis);
  }
  if (!same_dialect() && !std::is_sorted(m.centers.begin(), m.centers.end(), by_axis)) {
    std::stable_sort(own().centers.begin(), own().centers.end(), by_axis);
  }
  const bool point_of_cycle = cycle_of(block_) != nullptr && m.kind == ir::MotionKind::rapid && !m.explicit_code;
  if (point_of_cycle) {
    const auto text = motion_tracker().text();
    if (!text || is_straight(*text)) own().kind = ir::MotionKind::modal;
  }
  // So does every point under a cycle; the arc or the thread that was in force before it stays out of the text, and a
  // G1 that a label makes doubtful is not said again. A block that ends the cycle is no point of it.
  const bool ends = block_ != nullptr && ir::action_in<ir::CycleCancel>(*block_) != nullptr;
  const ir::Facts* f = has_cycles_ && !ends && m.kind == ir::MotionKind::modal && m.moves() ? facts() : nullptr;
  if (f != nullptr && f->cycle_active_known && f->cycle_active && f->motion != ir::MotionKind::rapid &&
      (!f->motion || !is_straight(*f->motion) || motion_tracker().text() != f->motion)) {
    own().kind = ir::MotionKind::rapid;
    own().keeps_modal = false;
  }
  if (!m.centers.empty()) {
    const bool absolute = absolute_center(m.centers.front());
    for (const ir::CenterWord& c : m.centers) {
      if (absolute_center(c) != absolute)
        return refuse(no_word, c.pos, "a centre that is absolute on one axis only has no counterpart here");
    }
    if (absolute && !refused()) add(std::string(g(Use::absolute_centre)), Rank::frame);
  }
  if (!same_dialect() && !arc_ends(*use)) return;
  if (same_dialect()) motion_tracker().start_routine();  // the source's own codes: nothing can be out of step
  ProgramWriter::motion(*use);
}

/// G53: machine coordinates without length and radius compensation, in the block (8.2).
void Writer::frame_use(const ir::Motion& m) {
  if (m.frame == ir::FrameUse::normal) return;
  bool no_length = m.frame == ir::FrameUse::machine;
  if (m.frame == ir::FrameUse::machine_with_length && block_ != nullptr) {
    for (const ir::Action& a : block_->actions) {
      const auto* d = std::get_if<ir::ToolOffset>(&a.data);
      no_length = no_length || (d != nullptr && d->number.is(0));
    }
  }
  if (!no_length) {
    return refuse(no_word, m.frame_pos,
                  m.frame == ir::FrameUse::no_programmable
                      ? "a block that leaves out the programmed shift has no counterpart here"
                      : "machine coordinates with the tool length have no counterpart here: G53 ignores the length",
                  "select offset 0 in this block");
  }
  add(std::string(g(Use::machine_coordinates)), Rank::frame, m.frame_pos);
}

void Writer::coordinate(const ir::Motion& m, const ir::CoordWord& w) {
  if (m.kind == ir::MotionKind::reference_point && !same_dialect()) {  // names of axes only (4.2)
    return add(std::string(axis_name(w.axis)), Rank::coordinate, w.pos);
  }
  const bool machine = m.frame != ir::FrameUse::normal;
  if (machine && w.mode == ir::WordMode::incremental)
    return refuse(no_word, w.pos, "an incremental move in machine coordinates has no counterpart here");
  if (w.mode != ir::WordMode::modal && !machine) {
    const auto distance = known<ir::Distance>(ir::Setting::distance);
    const bool absolute = w.mode == ir::WordMode::absolute;
    if (!distance || (*distance == ir::Distance::absolute) != absolute) {
      return refuse(no_word, w.pos, "a word that is absolute or incremental by itself has no counterpart here");
    }
  }
  auto value = scaled(w.axis, w.scale, w.value);
  if (!value) return refuse(no_word, w.pos, "whether this word is a radius or a diameter is not known here");
  const bool machine_units = machine && !same_dialect() && !ir::is_rotary_letter(w.axis) &&
                             profile().policies.machine_move_units == machine::MachineMoveUnits::machine;
  if (machine_units) {
    const auto units = known<ir::Units>(ir::Setting::units);
    if (!units)
      return refuse(no_word, w.pos,
                    "the unit in force is not known here, and machine coordinates have the machine's own");
    if (*units == ir::Units::inch) {
      if (!value->literal())
        return refuse(no_word, w.pos,
                      "machine coordinates are in the machine's own unit, a parameter in inches can't be used");
      value = ir::Value(value->number * 25.4);
    }
  }
  switch (w.direction) {
    case ir::RotaryDirection::as_value: tell_rotary(w); break;
    case ir::RotaryDirection::by_sign:
      if (const auto place = counted_place(w)) {
        value = ir::Value(*place);
        tell_counted(w);
        break;
      }
      if (!rollover() && !same_dialect() && known<ir::Distance>(ir::Setting::distance) != ir::Distance::incremental)
        return refuse(no_word, w.pos, plain_axis, rollover_hint);
      break;
    case ir::RotaryDirection::positive:
    case ir::RotaryDirection::negative: {
      if (!value->literal())
        return refuse(no_word, w.pos, "the direction of this rotary move is the sign of a number here");
      if (const auto place = counted_place(w)) {
        value = ir::Value(*place);
        tell_counted(w);
        break;
      }
      if (!rollover()) return refuse(no_word, w.pos, plain_axis, rollover_hint);
      const double turn = std::fmod(std::fmod(value->number, 360) + 360, 360);
      const bool backward = w.direction == ir::RotaryDirection::negative;
      if (backward && turn == 0)
        return refuse(no_word, w.pos, "the direction of a rotary move to 0 can't be said here");
      value = ir::Value(backward ? -turn : turn);
      break;
    }
    case ir::RotaryDirection::shortest:
      return refuse(no_word, w.pos, "a rotary move the shortest way has no counterpart here");
  }
  if (value->literal() && !(std::fabs(value->number) <= dialects::fagor::max_coordinate_mm))
    return refuse(no_word, w.pos, "the coordinate is beyond 99999.9999, which is all that the control takes");
  add(word(axis_name(w.axis), *value, w.pos), Rank::coordinate, w.pos);
}

/// From the start: always radius. Absolute (G6): as the end point (6.4).
void Writer::center(const ir::Motion& /*m*/, const ir::CenterWord& w) {
  const std::string_view letter = center_letter(w.axis);
  if (letter.empty()) return refuse(no_word, w.pos, "the centre of an arc on this axis has no counterpart here");
  std::optional<ir::Value> value = w.value;
  if (absolute_center(w)) {
    value = scaled(w.axis, w.scale, w.value);
  } else if (w.scale != ir::WordScale::radius) {
    const machine::AxisSpec* spec = profile().axis(w.axis);
    const auto mode = known<ir::DiameterMode>(ir::Setting::diameter);
    const bool diameter = w.scale == ir::WordScale::diameter || mode != ir::DiameterMode::radius;
    if (spec != nullptr && spec->diameter && diameter) {
      const bool sure = w.scale == ir::WordScale::diameter || mode == ir::DiameterMode::diameter;
      value = sure && w.value.literal() ? std::optional(ir::Value(w.value.number / 2)) : std::nullopt;
    }
  }
  if (!value) return refuse(no_word, w.pos, "whether this centre is a radius or a diameter is not known here");
  add(word(letter, *value, w.pos), Rank::center, w.pos);
}

void Writer::motion_extra(const ir::Motion& m, const ir::MotionExtra& e) {
  if (e.has_turns || e.has_angle)
    return refuse(no_word, m.code_pos, "an arc by its opening angle or with full turns has no counterpart here");
  if (e.polar_mode != ir::WordMode::modal || e.polar_angle_mode != ir::WordMode::modal)
    return refuse(no_word, m.code_pos,
                  "polar words that are absolute or incremental by themselves have no counterpart here");
  // Polar words stand before the Cartesian ones (25.1).
  // In an arc R is the arc's radius: about the pole the angle alone says the end (10.3).
  const auto kind = m.kind != ir::MotionKind::modal || facts() == nullptr ? m.kind : facts()->motion.value_or(m.kind);
  const bool arc = kind == ir::MotionKind::arc_cw || kind == ir::MotionKind::arc_ccw;
  const bool thread = kind == ir::MotionKind::thread || kind == ir::MotionKind::thread_variable;
  if (thread && (e.has_polar_radius || e.has_polar_angle || e.has_line_angle))
    return refuse(no_word, m.code_pos, "Q is the start angle of a thread here: its end has to be given by its axes");
  if (e.has_polar_radius && (!arc || same_dialect())) add(word("R", e.polar_radius, m.code_pos), Rank::motion_code);
  if (e.has_polar_angle) add(word("Q", e.polar_angle, m.code_pos), Rank::motion_code);
  if (e.has_line_angle) add(word("Q", e.line_angle, m.code_pos), Rank::motion_code);
  if (e.has_pitch) {
    const auto plane = known<ir::Plane>(ir::Setting::plane);
    if (!plane) return refuse(no_word, m.code_pos, "the plane of this helix is not known here");
    add(word(center_letter(ir::plane_axes(*plane).w), e.pitch, m.code_pos), Rank::motion_extra);
  }
  for (const ir::CenterWord& c : e.through) {
    const auto distance = known<ir::Distance>(ir::Setting::distance);
    const bool as_end = c.mode == ir::CenterMode::follows_distance ||
                        (distance && (c.mode == ir::CenterMode::absolute) == (*distance == ir::Distance::absolute));
    const auto value = scaled(c.axis, c.scale, c.value);
    if (!as_end || !value) return refuse(no_word, c.pos, "this form of the point on an arc has no counterpart here");
    add(word(center_letter(c.axis), *value, c.pos), Rank::center, c.pos);
  }
  if (!e.has_lead) return;
  const auto runs = [this](const ir::CoordWord& w) { return !stands_still(w); };
  if (!same_dialect() && std::count_if(m.coords.begin(), m.coords.end(), runs) > 1) {
    diagnostics().warning("TRN-242", span_of(m.code_pos),
                          "the manual of the target does not say along which axis the pitch of a taper thread is "
                          "measured; it is written as it is",
                          "check the first part");
  }
  add(word("L", e.lead, m.code_pos), Rank::motion_extra);
  if (e.has_start_angle) add(word("Q", e.start_angle, m.code_pos), Rank::motion_extra);
  if (m.kind == ir::MotionKind::thread_variable) add(word("K", e.lead_change, m.code_pos), Rank::motion_extra);
}

// ---- corners -------------------------------------------------------------------------------------------------------

/// `G36 R5`: the first R after the code is the corner's (10.8).
void Writer::corner(const ir::Action& a, const ir::Corner& c) {
  if (c.modal || c.feed || c.kind == ir::CornerKind::chamfer_chord) return ProgramWriter::corner(a, c);
  const std::string code(g(c.kind == ir::CornerKind::round ? Use::round : Use::chamfer));
  add(code + ' ' + word("R", c.value, a.pos), Rank::motion_code, a.pos);
}

void Writer::tangential_end(const ir::Action& a, const ir::TangentialEnd& t) {
  const std::string code(g(t.end == ir::TangentEnd::entry ? Use::tangent_entry : Use::tangent_exit));
  add(code + ' ' + word("R", t.radius, a.pos), Rank::motion_code, a.pos);
}

// ---- cycles --------------------------------------------------------------------------------------------------------

void Writer::cycle_cancel(const ir::Action& a) {
  const std::string_view code = g(Use::cycle_cancel);
  if (!code.empty()) add(std::string(code), Rank::setting, a.pos);  // the lathe model has no modal cycles
}

/// " G98" or " G99" as the cycle needs it; a program of this language says it itself.
std::string Writer::cycle_retract(const ir::Action& a, const CycleWords& w) {
  if (w.retract_given) {
    const auto plane = w.retract_is_reference ? ir::RetractPlane::reference : ir::RetractPlane::initial;
    return ' ' + std::string(modal_code(style(), ir::Setting::retract_plane, code_value(plane)));
  }
  if (same_dialect()) return {};
  const bool written = std::any_of(block_->actions.begin(), block_->actions.end(), [](const ir::Action& x) {
    const auto* m = std::get_if<ir::ModalSet>(&x.data);
    return m != nullptr && m->setting == ir::Setting::retract_plane;
  });
  if (written) return {};
  const auto plane = setting(ir::Setting::retract_plane);
  if (!plane) {
    refuse(no_cycle, a.pos, "where this cycle retracts to depends on the path that leads here");
    return {};
  }
  return ' ' + std::string(modal_code(style(), ir::Setting::retract_plane, *plane));
}

/// The control retracts to the height at which the cycle was defined (G98): the tool has to stand there before.
void Writer::cycle_approach(const CycleWords& w) {
  const auto plane = known<ir::Plane>(ir::Setting::plane).value_or(ir::Plane::xy);
  const ir::AxisId axis = ir::plane_axes(plane).w;
  const ir::Facts* f = facts();
  const auto height = f != nullptr ? f->position[axis] : std::nullopt;
  if (!w.retract_given || w.retract_is_reference) {
    const bool refused =
        w.has_reference && profile().policies.cycle_below_reference == machine::CycleBelowReference::refused;
    if (height || !refused || same_dialect()) return;
    diagnostics().warning(
        "TRN-243", current().line.span,
        "the height of the tool before this cycle is not known; where it stands between the reference plane "
        "and the depth, the control stops",
        "go to the reference plane or above it before the cycle");
    return;
  }
  if (height && w.retract.is(*height)) return;
  const bool surely_above = height && w.retract.literal() && *height > w.retract.number;
  if (!surely_above) {
    diagnostics().warning(
        "TRN-243", current().line.span,
        "the height of the tool before this cycle is not known; a move to its retract plane is put before it",
        "the hole is the same; check the move to the retract plane");
  }
  ir::Motion up;
  up.kind = ir::MotionKind::rapid;
  up.explicit_code = true;
  up.keeps_modal = false;
  ir::CoordWord z;
  z.axis = axis;
  z.value = w.retract;
  up.coords.push_back(z);
  ProgramWriter::motion(up);
  further_line({});
}

/// A cycle of the lathe (ch. 9) or a pattern of the mill (25.4) in the letters of its own, in the order of its words.
bool Writer::machining_cycle(const ir::Action& a, const ir::CycleDefine& c) {
  const auto* named = std::get_if<ir::NamedCycle>(&c.cycle->node);
  const auto* row = named == nullptr ? nullptr
                    : lathe_         ? dialects::fagor::find_cycle(named->name)
                                     : dialects::fagor::find_pattern(named->name);
  if (row == nullptr && named != nullptr && !lathe_) row = dialects::fagor::find_pocket(named->name);
  if (row == nullptr) return false;
  std::string text = same_dialect() && !a.text.empty() ? std::string(a.text) : "G" + std::to_string(row->code);
  for (const auto& [parameter, v] : named->words) {
    const auto* letter = std::find_if(row->letters.begin(), row->letters.end(),
                                      [&p = parameter](const auto& l) { return l.parameter == p; });
    if (letter == row->letters.end()) {
      refuse(no_cycle, a.pos, "this cycle has no word for its " + parameter + " there");
      return true;
    }
    text += ' ' + word(std::string(1, letter->letter), v, a.pos);
  }
  add(std::move(text), Rank::motion_code, a.pos);
  return true;
}

/// G79 with the words that differ from those of the cycle in force.
void Writer::cycle_change(const ir::Action& a, const ir::HoleCycle& change) {
  const auto plane = same_dialect() ? plane_by_text_ : known<ir::Plane>(ir::Setting::plane);
  if (!last_hole_ || !plane) return refuse(no_cycle, a.pos, "which cycle is changed here depends on the path");
  ir::HoleCycle whole = change;
  if (!change.reference.given) whole.reference = last_hole_->reference;
  if (!change.bottom.given) whole.bottom = last_hole_->bottom;
  whole.keeps_initial = false;
  const auto now = cycle_words(ir::Cycle{whole}), before = cycle_words(ir::Cycle{*last_hole_});
  if (!now || !before) return refuse(no_cycle, a.pos, "this change of a cycle has no counterpart here");
  last_hole_ = whole;
  const auto letter_of = [](const CycleWords& w, char letter) -> const ir::Value* {
    for (const auto& [l, v] : w.more) {
      if (l == letter) return &v;
    }
    return nullptr;
  };
  const bool depth = change.bottom.given && (!now->count || !ir::equal(now->depth, before->depth));
  const bool count = now->count && before->count && !ir::equal(*now->count, *before->count);
  const bool dwell = now->dwell && (!before->dwell || !ir::equal(*now->dwell, *before->dwell));
  add("G79", Rank::frame, a.pos);
  if (change.reference.given) add(word(axis_name(ir::plane_axes(*plane).w), now->reference, a.pos), Rank::center);
  const bool nothing = !change.reference.given && !depth && !count && !dwell;
  std::vector<std::pair<char, ir::Value>> ended;  // words that say nothing any more
  for (const auto& [letter, v] : before->more) {
    if (letter_of(*now, letter) == nullptr && (letter == 'D' || letter == 'R'))
      ended.emplace_back(letter, ir::Value(letter == 'R' && before->code == "G69" ? 1 : 0));
  }
  bool other = !ended.empty();
  for (const auto& [letter, v] : now->more) {
    const auto* old = letter_of(*before, letter);
    other = other || old == nullptr || !ir::equal(*old, v);
  }
  if (depth || (nothing && !other && !now->dwell)) add(word("I", now->depth, a.pos), Rank::radius);
  for (const auto& [letter, v] : now->more) {
    const auto* old = letter_of(*before, letter);
    if (old == nullptr || !ir::equal(*old, v)) add(word(std::string(1, letter), v, a.pos), Rank::motion_extra);
  }
  for (const auto& [letter, v] : ended) add(word(std::string(1, letter), v, a.pos), Rank::motion_extra);
  if (dwell || (nothing && !other && now->dwell)) add(word("K", *now->dwell, a.pos), Rank::motion_extra);
  if (count) add(word("J", *now->count, a.pos), Rank::motion_extra);
}

void Writer::cycle_define(const ir::Action& a, const ir::CycleDefine& c) {
  if (machining_cycle(a, c)) return;
  if (const auto* hole = std::get_if<ir::HoleCycle>(&c.cycle->node)) {
    if (hole->keeps_initial) return cycle_change(a, *hole);
    last_hole_ = *hole;
  }
  // Another axis than the plane's own was chosen by G15, which stands in the text.
  ir::Cycle along_normal = *c.cycle;
  ir::AxisId chosen = ir::axis::none;
  if (auto* h = std::get_if<ir::HoleCycle>(&along_normal.node); h != nullptr && same_dialect())
    std::swap(chosen, h->axis);
  const auto words = lathe_ ? std::nullopt : cycle_words(along_normal);
  if (!words) return ProgramWriter::cycle_define(a, c);
  const auto& hole = std::get<ir::HoleCycle>(c.cycle->node);
  if (!c.here || (c.modal && c.trigger != ir::CycleTrigger::plane_axis_word)) {
    return refuse(no_cycle, a.pos, "a modal cycle runs at its own block and at every later point of the plane there");
  }
  const auto distance = known<ir::Distance>(ir::Setting::distance);
  if (const auto problem = level_problem(hole, distance); !problem.empty())
    return refuse(no_cycle, a.pos, std::string(problem));
  auto plane = known<ir::Plane>(ir::Setting::plane);
  if (!plane && same_dialect()) plane = plane_by_text_;  // as the reader took it
  if (!plane) return refuse(no_cycle, a.pos, "the plane of this cycle is not known here");
  const bool has_gap =
      std::any_of(words->more.begin(), words->more.end(), [](const auto& m) { return m.first == 'C'; });
  const bool peck = words->code == "G83" || (words->code == "G69" && !has_gap);
  if (peck && !same_dialect()) {
    const auto units = known<ir::Units>(ir::Setting::units);
    if (!hole.pecks.reapproach.is(units == ir::Units::inch ? 1 / 25.4 : 1)) {
      return refuse(no_cycle, a.pos,
                    "the control feeds again 1 mm above the last depth; this cycle has another distance");
    }
  }
  if (words->retract_given && !words->retract_is_reference && block_->has_motion && block_->motion.moves())
    further_line(a.pos);
  cycle_approach(*words);
  // No cycle is called while an arc or a thread is in force (29.1, error 28); the hole is reached in rapid.
  const bool own_code = block_->has_motion && block_->motion.kind != ir::MotionKind::modal;
  if (!same_dialect() && !own_code && curve_in_force()) {
    add(std::string(motion_code(style(), ir::MotionKind::rapid)), Rank::motion_code);
    motion_tracker().wrote(ir::MotionKind::rapid, false);
  }
  const bool spelled = same_dialect() && !a.text.empty();
  const std::string code(spelled ? a.text : words->code);
  add(code + cycle_retract(a, *words), Rank::frame, a.pos);
  const ir::AxisId along = chosen != ir::axis::none ? chosen : ir::plane_axes(*plane).w;
  if (words->has_reference) add(word(axis_name(along), words->reference, a.pos), Rank::center);
  add(word("I", words->depth, a.pos), Rank::radius);
  const auto further = [&](bool before_dwell) {  // in the order of the alphabet, as the manual prints them
    for (const auto& [letter, v] : words->more) {
      if ((letter < 'K' || words->printed_order) == before_dwell)
        add(word(std::string(1, letter), v, a.pos), Rank::motion_extra);
    }
  };
  further(true);
  if (words->dwell) {
    ir::Value k = *words->dwell;
    if (words->dwell_scale != 0.01) {
      if (!k.literal())
        return refuse("TRN-203", a.pos,
                      "the dwell of a cycle is a number or a parameter in hundredths of a second here");
      k = ir::Value(std::round(k.number * words->dwell_scale * 100));
    }
    add(word("K", k, a.pos), Rank::motion_extra);
  }
  if (words->count) add(word("J", *words->count, a.pos), Rank::motion_extra);
  further(false);
  if (c.modal) return;
  further_line(a.pos);
  add(std::string(g(Use::cycle_cancel)), Rank::setting);
}

}  // namespace cnctrans::backends::fagor
