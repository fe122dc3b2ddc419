// Word blocks: named addresses, and what closes a block once all its words are known.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/text.h"
#include "dialects/sinumerik/feed_words.h"
#include "frontends/sinumerik/state/words.h"
#include "ir/geometry/frame_angles.h"

namespace cnctrans::sinumerik {

using syntax::Word;

void WordLowering::spindle_position(const Word& w, ir::Value value, Attribute attribute) {
  push(ir::SpindleOrient{c_.master_spindle, std::move(value), attribute == Attribute::ic}, Rank::orient,
       ir::Order::before, w.pos);
}

namespace {

/// Words that say one value of the move.
struct ValueOfMove {
  NamedWord use;
  bool ir::MotionExtra::*given;
  ir::Value ir::MotionExtra::*value;
};
using Extra = ir::MotionExtra;
constexpr ValueOfMove values_of_move[] = {
    {NamedWord::opening_angle, &Extra::has_angle, &Extra::opening_angle},
    {NamedWord::turns, &Extra::has_turns, &Extra::turns},
    {NamedWord::polar_radius, &Extra::has_polar_radius, &Extra::polar_radius},
    {NamedWord::polar_angle, &Extra::has_polar_angle, &Extra::polar_angle},
    {NamedWord::line_angle, &Extra::has_line_angle, &Extra::line_angle},
    {NamedWord::thread_start, &Extra::has_start_angle, &Extra::start_angle},
    {NamedWord::fixed_point, &Extra::has_fixed_point, &Extra::fixed_point},
    {NamedWord::probe, &Extra::has_probe_edge, &Extra::probe_edge},
    {NamedWord::probe_to_end, &Extra::has_probe_edge, &Extra::probe_edge},
    {NamedWord::point_weight, &Extra::has_weight, &Extra::weight},
    {NamedWord::spline_degree, &Extra::has_degree, &Extra::degree},
    {NamedWord::interval, &Extra::has_interval, &Extra::interval},
};

}  // namespace

void WordLowering::named(const syntax::Block& block, const Word& w) {
  if (!w.has_value) {
    if (sinumerik::g_function(w.address) != nullptr) return;
    failed_ = true;
    c_.error("SIN-004", w.pos, std::string(w.address) + " has no value");
    return;
  }
  const std::string name = to_upper_ascii(w.address);
  const NamedWordRow* row = named_word(name);
  if (row != nullptr && row->use == NamedWord::joint) {
    push(ir::OpaqueWord{c_.slice(w.pos)}, Rank::setting, ir::Order::before, w.pos);
    return c_.note("SIN-009", w.pos, name + "= is kept as text: it says how the programmed end is reached");
  }
  Attribute attribute = Attribute::none;
  ir::Value value = exprs_.value(block, w, attribute);
  if (row != nullptr) return known_word(row->use, name, w, std::move(value), attribute);
  if (const ir::AxisId axis = c_.machine.axis(name); axis != ir::axis::none) {
    return coordinate(axis, w, std::move(value), attribute);
  }
  failed_ = true;
  c_.error("SIN-003", w.pos,
           "`" + name + "` is no address of this control and no axis of the machine " + c_.machine.profile->name,
           "a variable must be set in a block of its own");
}

void WordLowering::corner(ir::CornerKind kind, bool modal, const std::string& name, ir::Value size, WordPos pos) {
  if (corner_ >= 0 || (size.literal() && size.number < 0)) {
    failed_ = true;
    c_.error("SIN-005", pos,
             corner_ >= 0 ? "two corners in one block" : name + " takes the size of the corner: not below 0");
  }
  corner_ = static_cast<std::int32_t>(out_->actions.size());
  ir::Corner c;
  c.kind = kind;
  c.modal = modal;
  c.value = std::move(size);
  push(std::move(c), Rank::corner, ir::Order::before, pos);
}

void WordLowering::value_of_move(NamedWord use, const Word& w, ir::Value value, Attribute attribute) {
  const auto* row = std::find_if(std::begin(values_of_move), std::end(values_of_move),
                                 [use](const ValueOfMove& v) { return v.use == use; });
  const ir::WordMode mode = attribute == Attribute::ic   ? ir::WordMode::incremental
                            : attribute == Attribute::ac ? ir::WordMode::absolute
                                                         : ir::WordMode::modal;
  if (use == NamedWord::turns && value.literal() && (value.number < 0 || value.number != std::trunc(value.number))) {
    failed_ = true;
    return c_.error("SIN-017", w.pos, "TURN= counts whole turns beside the arc: 0, 1, 2 ...",
                    "a part of a turn is the arc itself");
  }
  if (use == NamedWord::thread_start && c_.thread_start.set(value) && !value.is(0)) lasting_missed(w.pos);
  extra().*row->given = true;
  extra_.*row->value = std::move(value);
  if (use == NamedWord::polar_radius) extra_.polar_mode = mode;
  if (use == NamedWord::polar_angle) extra_.polar_angle_mode = mode;
  extra_.probe_goes_on = extra_.probe_goes_on || use == NamedWord::probe_to_end;
}

void WordLowering::known_word(NamedWord use, const std::string& name, const Word& w, ir::Value value,
                              Attribute attribute) {
  switch (use) {
    case NamedWord::arc_radius:
      out_->motion.radius_given = true;
      out_->motion.radius = std::move(value);
      out_->motion.radius_pos = w.pos;
      return;
    case NamedWord::opening_angle:
    case NamedWord::turns:
    case NamedWord::polar_radius:
    case NamedWord::polar_angle:
    case NamedWord::line_angle:
    case NamedWord::thread_start:
    case NamedWord::fixed_point:
    case NamedWord::probe:
    case NamedWord::probe_to_end:
    case NamedWord::point_weight:
    case NamedWord::spline_degree:
    case NamedWord::interval: return value_of_move(use, w, std::move(value), attribute);
    case NamedWord::round: return corner(ir::CornerKind::round, false, name, std::move(value), w.pos);
    case NamedWord::round_modal: return corner(ir::CornerKind::round, true, name, std::move(value), w.pos);
    case NamedWord::chamfer_leg: return corner(ir::CornerKind::chamfer_leg, false, name, std::move(value), w.pos);
    case NamedWord::chamfer_chord: return corner(ir::CornerKind::chamfer_chord, false, name, std::move(value), w.pos);
    case NamedWord::corner_feed:
      has_corner_feed_ = true;
      corner_feed_ = std::move(value);
      return;
    case NamedWord::corner_feed_modal:  // 0: the feed of the block again
      if (value.is(0)) {
        c_.corner_feed.cancel();
      } else if (c_.corner_feed.set(value)) {
        lasting_missed(w.pos);
      }
      return push(ir::OpaqueWord{c_.slice(w.pos)}, Rank::setting, ir::Order::with, w.pos);
    case NamedWord::orientation: return orientation(w);
    case NamedWord::spindle_limit:
      value = c_.lower_limit(c_.css_limit, c_.speed_limit, value, w.pos);
      return push(ir::SpindleLimit{c_.master_spindle, std::move(value), false}, Rank::limit, ir::Order::before, w.pos);
    case NamedWord::spindle_position: return spindle_position(w, std::move(value), attribute);
    case NamedWord::block_feed:
      return push(ir::SetFeed{std::move(value), false, true}, Rank::feed, ir::Order::before, w.pos);
    case NamedWord::rotation_in_plane:
      has_rpl_ = true;
      rpl_ = std::move(value);
      return;
    case NamedWord::joint: return;
    case NamedWord::timing:
    case NamedWord::compensation:
      push(ir::OpaqueWord{c_.slice(w.pos)}, Rank::setting, ir::Order::with, w.pos);
      return c_.note("SIN-009", w.pos, kept_text(name));
    case NamedWord::tooth_feed: return tooth_feed(w, value);
    case NamedWord::cutting_speed: return cutting_speed(w, value);
    case NamedWord::unsupported: refuse("block.word", w.pos, name + "= is not carried yet"); return;
  }
}

// --- what closes a block ----------------------------------------------------------------------------------------

bool WordLowering::finish() {
  if (corner_ >= 0) finish_corner();
  if (c_.words_of_tool) words_of_tool();
  switch (special_) {
    case Special::none: break;
    case Special::dwell: finish_dwell(); break;
    case Special::frame: finish_frame(); break;
    case Special::pole: finish_pole(); break;
    case Special::inclined: finish_inclined(); break;
    case Special::limit:
      if (out_->motion.coords.empty()) break;
      c_.note("SIN-009", special_pos_, "limits of the working area are kept as text: the programmed path is the same");
      push(ir::OpaqueWord{c_.slice(statement_pos())}, Rank::setting, ir::Order::with, statement_pos());
      out_->motion.coords.clear();
      break;
    case Special::approach:
      out_->motion.kind = static_cast<ir::MotionKind>(special_g_->a);
      out_->motion.keeps_modal = false;
      out_->motion.explicit_code = true;
      out_->motion.code_pos = special_pos_;
      out_->motion.code_text = c_.slice(special_pos_);
      break;
  }
  const bool rotation = special_ == Special::frame && (static_cast<FrameVerb>(special_g_->a) == FrameVerb::rot ||
                                                       static_cast<FrameVerb>(special_g_->a) == FrameVerb::arot);
  if (has_rpl_ && !rotation) {
    failed_ = true;
    c_.error("SIN-003", special_pos_, "RPL= belongs to ROT or AROT");
  }
  c_.real_time.moved = c_.real_time.moved || !out_->motion.coords.empty();
  finish_motion();
  finish_orientation();
  default_offset();
  sort_actions();
  return true;
}

/// A tool change selects edge 1 unless a D was written since its T (14.8, MD20270).
void WordLowering::default_offset() {
  bool changes = false;
  WordPos place;
  for (const auto& a : out_->actions) {
    if (const auto* t = std::get_if<ir::ToolSelect>(&a.data)) {
      c_.offset_chosen = t->name.empty() && t->number.is(0);
      changes = changes || t->changes;
      place = a.pos;
    } else if (std::holds_alternative<ir::ToolChange>(a.data)) {
      changes = true;
      place = a.pos;
    }
  }
  if (changes || !c_.offset_chosen) {
    for (const auto& a : out_->actions)
      c_.offset_chosen = c_.offset_chosen || std::holds_alternative<ir::ToolOffset>(a.data);
  }
  if (!changes || c_.offset_chosen) return;
  c_.offset_chosen = true;
  if (c_.machine.options.default_edge <= 0) {
    return c_.note("SIN-027", place,
                   "no D is written since this tool was selected; most machines select D1 with the tool change",
                   "write the D, or set the option sinumerik.default_edge in the machine profile");
  }
  push(ir::ToolOffset{ir::Value(c_.machine.options.default_edge)}, Rank::offset, ir::Order::before, place, false);
}

void WordLowering::reject_axis_words(std::string_view why) {
  if (out_->motion.coords.empty() && out_->motion.centers.empty()) return;
  failed_ = true;
  const WordPos pos = out_->motion.coords.empty() ? out_->motion.centers.front().pos : out_->motion.coords.front().pos;
  c_.error("SIN-005", pos, std::string(why));
}

void WordLowering::finish_dwell() {
  reject_axis_words("G4 stands in a block without axis words");
  if (!has_dwell_) {
    failed_ = true;
    c_.error("SIN-004", special_pos_, "G4 needs its time: F in seconds or S in revolutions");
    return;
  }
  push(std::move(dwell_), Rank::dwell, ir::Order::before, special_pos_);
  dwell_ = ir::Dwell{};
}

namespace {

/// Rotations given by angles about axes: X, Y, Z only.
bool is_geometry_axis(ir::AxisId axis) {
  return axis <= ir::axis::z;
}

}  // namespace

void WordLowering::finish_rotation(ir::FrameChange& change) {
  auto& coords = out_->motion.coords;
  change.kind = ir::FrameKind::rotate;
  change.has_angle = true;
  if (has_rpl_) {
    change.angle = std::move(rpl_);
    if (!coords.empty())
      refuse("motion.transformation", special_pos_, "RPL= together with axis angles is not carried yet");
    return;
  }
  for (const auto& c : coords) {
    if (is_geometry_axis(c.axis)) continue;
    failed_ = true;
    c_.error("SIN-012", c.pos, "only X, Y and Z can be turned about");
    return;
  }
  if (coords.size() == 1) {
    change.angle = std::move(coords.front().value);
    change.rotation_axis = coords.front().axis;
    return;
  }
  change.has_angle = false;  // about Z, then the new Y, then the new X, in whatever order they are written
  for (auto& c : coords)
    change.words.push_back(ir::FrameWord{c.axis, std::move(c.value), ir::WordScale::radius, c.pos});
}

/// ROTS, AROTS: one angle is that of ROT; two incline a plane.
void WordLowering::finish_solid_angles(ir::FrameChange& change) {
  auto& coords = out_->motion.coords;
  const bool solid = coords.size() == 2 && !has_rpl_;
  if (!solid) return finish_rotation(change);
  change.kind = ir::FrameKind::rotate;
  for (const auto& c : coords) {
    if (!c.value.literal() || !is_geometry_axis(c.axis))
      return refuse("motion.transformation", special_pos_, "solid angles that are computed are not carried yet");
  }
  const auto turns = ir::solid_angles(coords[0].axis, coords[0].value.number, coords[1].axis, coords[1].value.number);
  for (ir::AxisId a = 0; a <= ir::axis::z; ++a)
    change.words.push_back(ir::FrameWord{a, ir::Value(turns[a]), ir::WordScale::radius, coords[0].pos});
}

/// The words of a frame statement as they stand, from the verb to the last of them.
WordPos WordLowering::statement_pos() const {
  std::uint32_t end = special_pos_.column + special_pos_.length;
  for (const auto& c : out_->motion.coords) end = std::max(end, c.pos.column + c.pos.length);
  return WordPos{special_pos_.column, end - special_pos_.column};
}

void WordLowering::finish_frame() {
  const auto verb = static_cast<FrameVerb>(special_g_->a);
  auto& coords = out_->motion.coords;
  if (!out_->motion.centers.empty()) reject_axis_words("arc words can't stand with " + std::string(special_g_->name));
  auto change = std::make_shared<ir::FrameChange>();
  change->slot = ir::FrameSlot::chain;
  const bool additive = verb == FrameVerb::atrans || verb == FrameVerb::arot || verb == FrameVerb::ascale ||
                        verb == FrameVerb::amirror || verb == FrameVerb::arots;
  const bool solid = (verb == FrameVerb::rots || verb == FrameVerb::arots) && coords.size() == 2;
  const WordPos whole = statement_pos();
  const bool empty = coords.empty() && !has_rpl_;
  const bool all = empty && !c_.tool_frame;  // else the frame of the tool stays
  change->combine = additive ? ir::FrameCombine::compose : all ? ir::FrameCombine::clear : ir::FrameCombine::replace;
  c_.framed = !empty || (c_.framed && additive);
  switch (verb) {
    case FrameVerb::rot:
    case FrameVerb::arot:
      change->kind = ir::FrameKind::rotate;
      if (!empty) finish_rotation(*change);
      break;
    case FrameVerb::rots:
    case FrameVerb::arots:
      change->kind = ir::FrameKind::rotate;
      if (!empty) finish_solid_angles(*change);
      break;
    case FrameVerb::g58:
    case FrameVerb::g59:  // the coarse or the fine shift of the named axes alone
      if (empty) {
        failed_ = true;
        c_.error("SIN-004", special_pos_, std::string(special_g_->name) + " needs the axes that it shifts");
      }
      change->combine = ir::FrameCombine::replace_named;
      change->fine = verb == FrameVerb::g59;
      break;
    case FrameVerb::scale:
    case FrameVerb::ascale: change->kind = ir::FrameKind::scale; break;
    case FrameVerb::mirror:
    case FrameVerb::amirror: change->kind = ir::FrameKind::mirror; break;
    default: change->kind = ir::FrameKind::translate; break;
  }
  if (change->kind != ir::FrameKind::rotate) {
    for (auto& c : coords) {
      ir::FrameWord word{c.axis, std::move(c.value), c.scale, c.pos};
      if (change->kind == ir::FrameKind::mirror) word.value = ir::Value(1);  // the value of the word does not count
      if (change->kind == ir::FrameKind::scale) word.scale = ir::WordScale::radius;
      if (c.mode != ir::WordMode::modal) {
        failed_ = true;
        c_.error("SIN-012", c.pos, "AC() and IC() have no meaning here");
      }
      change->words.push_back(std::move(word));
    }
  }
  coords.clear();
  if (empty && additive) {
    c_.note("SIN-009", special_pos_, std::string(special_g_->name) + " without axes changes nothing");
    return push(ir::OpaqueWord{c_.slice(special_pos_)}, Rank::setting, ir::Order::with, special_pos_);
  }
  push(ir::FrameOp{std::move(change)}, Rank::setting, ir::Order::before, solid ? whole : special_pos_);
}

/// Every word that gives the end, the centre or the shape of a move must count: two that say the same are an error of
/// the control (alarms 12080, 14xxx).
void WordLowering::check_words(bool arc) {
  const ir::Motion& m = out_->motion;
  const auto wrong = [&](std::string_view code, WordPos pos, std::string_view text) {
    failed_ = true;
    c_.error(code, pos, std::string(text));
  };
  const WordPos place = !m.coords.empty() ? m.coords.front().pos : m.code_pos;
  if (m.radius_given && !m.centers.empty())
    wrong("SIN-005", m.radius_pos, "an arc takes its radius or its centre, not both");
  if (!has_extra_) return;
  const ir::MotionKind kind = motion_kind();
  const bool straight = kind == ir::MotionKind::rapid || kind == ir::MotionKind::linear;
  const bool polar = extra_.has_polar_radius || extra_.has_polar_angle;
  if (straight && (extra_.has_angle || extra_.has_turns || !extra_.through.empty()))
    wrong("SIN-003", place, "AR=, TURN= and the point on the way belong to arcs; a straight move is in force");
  if (arc && polar && (m.radius_given || !m.centers.empty() || extra_.has_angle))
    wrong("SIN-005", place, "an arc by AP= and RP= has the pole as its centre: no I J K, CR= or AR= beside them");
  if (arc && extra_.has_angle && m.radius_given)
    wrong("SIN-005", m.radius_pos, "an arc takes its radius or its opening angle, not both");
  if (arc && extra_.has_angle && !m.centers.empty()) {
    const ir::AxisId normal = ir::plane_axes(plane_of_centres()).w;
    for (const auto& c : m.coords) {
      if (c.axis <= ir::axis::z && c.axis != normal && m.centers.size() == 2)
        wrong("SIN-005", c.pos, "an arc by its opening angle takes its centre or its end, not both");
    }
  }
  if (arc && !extra_.through.empty()) wrong("SIN-003", place, "the point on the way belongs to CIP");
  if (polar && m.frame != ir::FrameUse::normal)
    wrong("SIN-005", m.frame_pos, "polar words can't stand beside a move in machine coordinates");
}

/// Two centre words name the plane.
ir::Plane WordLowering::plane_of_centres() const {
  bool x = false, y = false;
  for (const auto& c : out_->motion.centers) {
    x = x || c.axis == ir::axis::x;
    y = y || c.axis == ir::axis::y;
  }
  if (x && y) return ir::Plane::xy;
  return x ? ir::Plane::zx : ir::Plane::yz;
}

/// FRC= of the block, else FRCM=, which stays in force for the corners that follow in the text.
void WordLowering::finish_corner() {
  auto& c = std::get<ir::Corner>(out_->actions[static_cast<std::size_t>(corner_)].data);
  if (has_corner_feed_) {
    c.feed = std::make_shared<const ir::Value>(std::move(corner_feed_));
    return;
  }
  switch (c_.corner_feed.ask()) {
    case LastingWord::State::none: return;
    case LastingWord::State::known:
      c.feed = std::make_shared<const ir::Value>(ir::Value(c_.corner_feed.value()));
      return;
    case LastingWord::State::unsure:
      return c_.warning("SIN-043", out_->actions[static_cast<std::size_t>(corner_)].pos,
                        "an FRCM= may hold here whose value the text does not tell; the corner is taken with the feed "
                        "of its block",
                        "write FRC= in this block");
  }
}

/// SF= stays in force (14.3): the threads that follow in the text get it.
void WordLowering::start_angle() {
  if (has_extra_ && extra_.has_start_angle) return;
  switch (c_.thread_start.ask()) {
    case LastingWord::State::none: return;
    case LastingWord::State::known:
      extra().has_start_angle = true;
      extra_.start_angle = ir::Value(c_.thread_start.value());
      return;
    case LastingWord::State::unsure:
      return c_.warning("SIN-043", out_->motion.code_pos,
                        "an SF= may hold here whose value the text does not tell; the thread is started at 0 degrees",
                        "write SF= in this block");
  }
}

/// A word that lasts stands behind blocks that go without, to which the program may come back.
void WordLowering::lasting_missed(WordPos pos) {
  c_.warning("SIN-043", pos,
             std::string(c_.slice(pos)) +
                 " stays in force: a block above without it is taken as if it had none, also where the program comes "
                 "back to it",
             "write the word in every block that needs it");
}

void WordLowering::finish_motion() {
  ir::Motion& m = out_->motion;
  const ir::MotionKind kind = motion_kind();
  if ((kind == ir::MotionKind::thread || kind == ir::MotionKind::thread_variable) && !m.coords.empty()) start_angle();
  const bool arc = kind == ir::MotionKind::arc_cw || kind == ir::MotionKind::arc_ccw;
  if (!m.centers.empty() && !arc) {
    failed_ = true;
    c_.error("SIN-003", m.centers.front().pos, "I, J and K belong to G2, G3 and threads; here neither is in force",
             "write the G function in this block");
  }
  if (m.radius_given && !arc) {
    failed_ = true;
    c_.error("SIN-003", m.radius_pos, "CR= belongs to G2 and G3");
  }
  check_words(arc);
  open_line();
  if (has_extra_) m.extra = std::make_shared<const ir::MotionExtra>(std::move(extra_));
  out_->has_motion = m.explicit_code || m.moves() || m.radius_given || m.frame != ir::FrameUse::normal;
}

}  // namespace cnctrans::sinumerik
