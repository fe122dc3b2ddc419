// The motion of a block: end point, centre, radius, polar words, thread.
#include <cmath>
#include <memory>
#include <string>

#include "dialects/fagor/limits.h"
#include "frontends/fagor/statements/expr.h"
#include "frontends/fagor/words/block.h"
#include "frontends/fagor/words/letters.h"

namespace cnctrans::fagor {

namespace facts = dialects::fagor;

ir::MotionExtra& BlockLowerer::extra() {
  has_extra_ = true;
  return extra_;
}

void BlockLowerer::coordinates(ir::Motion& m) {
  for (std::size_t i = 0; i < coord_count_; ++i) {
    const Word& w = *coords_[i];
    const ir::AxisId axis = info_of(word_letter(w)).axis;
    const bool surface = state_.surface_by_text != ir::Surface::none;
    if (!state_.has_axis(axis)) {
      state_.error("FAG-009", w.pos, std::string("the machine has no axis ") + word_letter(w),
                   "choose a machine profile that has it");
      continue;
    }
    if (!(std::fabs(w.number) <= facts::max_coordinate_mm)) {
      state_.error("FAG-013", w.pos, "the coordinate " + std::string(word_text(w)) + " is beyond 99999.9999");
      continue;
    }
    ir::CoordWord& c = m.coords.emplace_back();
    c.axis = axis;
    if (w.expr < 0) {
      c.value.number = w.number;
      c.value.text = w.number_text;
    } else {
      c.value = value(w);
    }
    c.pos = w.pos;
    if (surface && surface_coordinate(c, w)) continue;
    if (ir::is_rotary_letter(axis)) {
      state_.facts.turned_by_axes = true;
      if (state_.facts.scaled && !state_.facts.scaled_rotary) {
        state_.facts.scaled_rotary = true;
        state_.warning("FAG-101", w.pos,
                       "the manual lets G72 S multiply every coordinate (7.6.1); degrees are taken as they are written",
                       "write G72 with the letters of the linear axes, or G72 S1 before the rotary axis turns");
      }
      rotary(c, w);
    }
  }
}

/// Absolute words of a rollover axis: the sign is the sense of turning and the value the target (3.7).
void BlockLowerer::rotary(ir::CoordWord& c, const Word& w) {
  if (state_.rollover()) {
    c.direction = ir::RotaryDirection::by_sign;
  } else if (!state_.facts.rotary) {
    state_.facts.rotary = true;
    state_.warning("FAG-035", w.pos,
                   std::string("the words of the rotary axis ") + word_letter(w) + " are read as plain coordinates",
                   "on a rollover axis the sign of an absolute word is its direction: set the option "
                   "fagor.rotary_rollover to yes");
  }
}

/// I J K: the centre from the start of the arc, absolute with G6, the point on the way with G9. The letter of an axis
/// outside the plane is the pitch of a helix.
void BlockLowerer::centers(ir::Motion& m) {
  for (const char c : {'I', 'J', 'K'}) {
    const Word* w = take(c);
    if (!w) continue;
    const auto axis = center_axis(*w);
    ir::CenterWord center;
    center.axis = axis;
    center.value = value(*w);
    center.pos = w->pos;
    if (axis == ir::plane_axes(state_.plane_now()).w) {
      (void)state_.plane_by_text();
      result_->needs_program = true;
      extra().has_pitch = true;
      if (w->expr < 0 && w->number < 0)
        state_.error("FAG-046", w->pos, "the pitch of a helix is never negative [54]",
                     "the end along the tool axis gives its sense");
      extra().pitch = std::move(center.value);
      continue;
    }
    const bool face = state_.surface_by_text == ir::Surface::face && axis == ir::axis::x;
    if (three_points_) {
      center.mode = ir::CenterMode::follows_distance;
      center.scale = face ? ir::WordScale::radius : ir::WordScale::modal;
      extra().through.push_back(std::move(center));
      continue;
    }
    if (absolute_centre_) {
      center.mode = ir::CenterMode::absolute;
      center.scale = face ? ir::WordScale::radius : ir::WordScale::modal;
    }
    m.centers.push_back(std::move(center));
  }
}

/// A coordinate of the plane is given; one outside the plane goes along with polar words (6.5).
bool BlockLowerer::in_plane(const ir::Motion& m) {
  if (m.coords.empty()) return false;
  const ir::PlaneAxes plane = ir::plane_axes(state_.plane_by_text());
  for (const auto& c : m.coords) {
    if (c.axis == plane.u || c.axis == plane.v) return true;
  }
  return false;
}

/// R: radius of an arc when the block has coordinates, else polar radius. Q: polar angle; with a coordinate of the
/// plane the angle of a straight line; of a thread the start angle.
void BlockLowerer::radius_and_polar(ir::Motion& m) {
  const bool straight = m.kind == ir::MotionKind::rapid || m.kind == ir::MotionKind::linear;
  const bool arc = m.kind == ir::MotionKind::arc_cw || m.kind == ir::MotionKind::arc_ccw;
  const Word* r = radii_taken_ < radius_count_ ? radii_[radius_count_ == 2 && radii_taken_ == 1 ? 1 : 0] : nullptr;
  const Word* q = cuts_thread(m) ? nullptr : take('Q');
  if (!r && !q) return;
  if (r) ++radii_taken_;
  if (r && !q && !straight && !m.coords.empty()) {
    m.radius_given = true;
    m.radius = value(*r);
    m.radius_pos = r->pos;
    return;
  }
  result_->needs_program = true;
  if (state_.turned()) {
    state_.error("FAG-026", (q ? q : r)->pos,
                 "polar words and angles in a plane with its axes exchanged (G16 XZ, YX, ZY) are not carried",
                 "write the end point");
    return;
  }
  if (q && !r && !arc && m.centers.empty() && in_plane(m)) {
    extra().has_line_angle = true;
    extra().line_angle = value(*q);
    return;
  }
  if (r) {
    extra().has_polar_radius = true;
    extra().polar_radius = value(*r);
  }
  if (q) {
    extra().has_polar_angle = true;
    extra().polar_angle = value(*q);
  }
}

/// G33 and G34 stay in force over blocks without a motion code.
bool BlockLowerer::cuts_thread(const ir::Motion& m) const {
  const auto kind = m.kind == ir::MotionKind::modal ? state_.motion_by_text : m.kind;
  return kind == ir::MotionKind::thread || kind == ir::MotionKind::thread_variable;
}

void BlockLowerer::thread(ir::Motion& m) {
  const bool variable = m.kind == ir::MotionKind::thread_variable;
  const bool thread = variable || m.kind == ir::MotionKind::thread;
  const Word* lead = thread || m.kind == ir::MotionKind::modal ? take('L') : nullptr;
  if (thread && !lead && !m.coords.empty()) {
    state_.error("FAG-014", motion_code_->word->pos, "the thread has no pitch L");
    return;
  }
  if (!lead && cuts_thread(m)) {  // the pitch stays; Q is the angle of the spindle here too (10.12)
    if (const Word* q = take('Q')) {
      extra().has_start_angle = true;
      extra().start_angle = value(*q);
    }
  }
  if (!lead) return;
  if (!thread && state_.motion_by_text != ir::MotionKind::thread &&
      state_.motion_by_text != ir::MotionKind::thread_variable) {
    state_.error("FAG-004", lead->pos, "a pitch L has no meaning without G33 or G34");
    return;
  }
  extra().has_lead = true;
  extra().lead = value(*lead);
  if (variable || (!thread && state_.motion_by_text == ir::MotionKind::thread_variable))
    extra().lead_change = value_of('K');
  if (const Word* q = take('Q')) {
    extra().has_start_angle = true;
    extra().start_angle = value(*q);
  }
  if (m.coords.size() > 1) {
    state_.warning("FAG-029", lead->pos,
                   "the manual does not say along which axis the pitch of a taper thread is measured",
                   "it is taken along the longer axis; check the first part");
  }
}

void BlockLowerer::motion() {
  const bool coords = coord_count_ != 0 && !coords_taken_;
  const bool words = coords || radii_taken_ < radius_count_ || (unused_ & (center_letters | bit('Q'))) != 0;
  if (absolute_centre_ && (unused_ & center_letters) == 0)
    state_.error("FAG-014", absolute_centre_->pos, "G6 needs the centre I, J or K");
  if (!words && !motion_code_ && !tangent_arc_ && !three_points_ && !home_ && !straight_) return;
  ir::Motion& m = out_->motion;
  out_->has_motion = true;
  const Word* code = motion_code_    ? motion_code_->word
                     : tangent_arc_  ? tangent_arc_
                     : three_points_ ? three_points_
                     : straight_     ? straight_->word
                                     : home_;
  if (code) {
    m.explicit_code = true;
    m.code_pos = code->pos;
    m.code_text = word_text(*code);
  }
  if (motion_code_) m.kind = state_.motion_by_text = motion_code_->row->motion;
  if (motion_code_ && state_.turned() && (m.kind == ir::MotionKind::arc_cw || m.kind == ir::MotionKind::arc_ccw)) {
    m.kind = state_.motion_by_text =
        m.kind == ir::MotionKind::arc_cw ? ir::MotionKind::arc_ccw : ir::MotionKind::arc_cw;
    m.code_text = {};
  }
  if (straight_) {  // leaves G01 in force
    if (coord_count_ == 0) state_.error("FAG-014", code->pos, std::string(word_text(*code)) + " needs a coordinate");
    if (straight_->row->motion == ir::MotionKind::to_stop && coord_count_ > 1)
      state_.error("FAG-006", code->pos, "G52 moves one axis only [200]", "split the block");
    m.kind = straight_->row->motion;
    state_.motion_by_text = ir::MotionKind::linear;
    result_->needs_program = true;
  }
  if (tangent_arc_ || three_points_ || home_) {
    if (motion_code_ || straight_) state_.error("FAG-006", code->pos, "two kinds of motion in one block");
    m.kind = home_          ? ir::MotionKind::reference_point
             : tangent_arc_ ? ir::MotionKind::arc_tangent
                            : ir::MotionKind::arc_through_point;
    m.keeps_modal = false;
  }
  if (cycle_ && !motion_code_ && state_.motion_by_text != ir::MotionKind::rapid) {  // to the hole in rapid (25.3)
    m.kind = ir::MotionKind::rapid;
    m.keeps_modal = false;
  }
  if (machine_coords_) {
    m.frame = ir::FrameUse::machine;
    m.frame_pos = machine_coords_->pos;
  }
  if (coords) coordinates(m);
  if ((unused_ & motion_letters) == 0 && radius_count_ == 0 && !has_extra_ && m.kind != ir::MotionKind::thread &&
      m.kind != ir::MotionKind::thread_variable && !three_points_)
    return;
  thread(m);
  if ((unused_ & center_letters) != 0) {
    if (m.kind == ir::MotionKind::rapid || m.kind == ir::MotionKind::linear) {
      state_.error("FAG-004", code ? code->pos : WordPos{}, "I, J and K have no meaning in a straight move");
    }
    centers(m);
  }
  radius_and_polar(m);
  if (three_points_ && extra_.through.empty())
    state_.error("FAG-014", three_points_->pos, "G9 needs the point on the way I, J or K");
  if (has_extra_) m.extra = std::make_shared<const ir::MotionExtra>(extra_);
}

}  // namespace cnctrans::fagor
