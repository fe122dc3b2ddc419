// L, CC and C, CR, CT, CP (reference 5). Every block names its function and says each word absolute or incremental.
#include <algorithm>
#include <cmath>

#include "backends/heidenhain/tables.h"
#include "backends/heidenhain/writer.h"

namespace cnctrans::backends::heidenhain {

namespace {

bool is_circle(ir::MotionKind k) {
  return k == ir::MotionKind::arc_cw || k == ir::MotionKind::arc_ccw;
}

}  // namespace

std::optional<ir::MotionKind> Writer::kind_of(const ir::Motion& m) {
  if (m.kind != ir::MotionKind::modal) return m.kind;
  const ir::Facts* f = facts();
  if (f == nullptr) return motion_tracker().text();
  return f->reachable ? f->motion : std::optional(ir::MotionKind::linear);
}

/// Nothing: whether it counts from the zero point or from where the tool stands depends on the way.
std::optional<bool> Writer::increment(const ir::CoordWord& w) {
  if (w.mode != ir::WordMode::modal) return w.mode == ir::WordMode::incremental;
  const auto mode = setting(ir::Setting::distance);
  if (!mode) return std::nullopt;
  return *mode == code_value(ir::Distance::incremental);
}

void Writer::coordinates(const ir::Motion& m) {
  for (const ir::CoordWord& w : m.coords) {
    if (w.scale == ir::WordScale::diameter)
      return refuse(no_word, w.pos, "a diameter by itself has no counterpart here");
    if (w.direction != ir::RotaryDirection::as_value)
      return refuse(no_word, w.pos, "the direction of this rotary move has no counterpart here");
    if (w.positioning != ir::Positioning::with_path)
      return refuse(no_word, w.pos, "an axis that moves by itself has no counterpart here");
    const auto relative = increment(w);
    if (!relative) {
      const ir::Facts* f = facts();
      if (f == nullptr || f->reachable)
        return refuse(no_word, w.pos, "whether this word is absolute depends on the way that leads here",
                      "write G90 or G91 before it on every path");
    }
    add(word((relative.value_or(false) ? "I" : "") + std::string(axis_name(w.axis)), w.value, w.pos), Rank::coordinate);
  }
}

void Writer::side_word() {
  const ir::Facts* f = facts();
  if (side_) {
    const auto plane = setting(ir::Setting::plane);
    if (*side_ != ir::CompSide::off && plane != code_value(ir::Plane::xy))
      refuse(no_word, {}, "radius compensation acts in the plane across the tool axis here, which is not this one");
    const std::string_view text = *side_ == ir::CompSide::off ? "R0" : *side_ == ir::CompSide::left ? "RL" : "RR";
    side_.reset();
    return add(std::string(text), Rank::motion_extra);
  }
  // Positioning blocks say R0 though it holds already.
  const auto* b = std::get_if<ir::Block>(&current().node);
  const bool rapid = b != nullptr && kind_of(b->motion) == ir::MotionKind::rapid;
  const bool off =
      f != nullptr && f->settings[static_cast<std::size_t>(ir::Setting::comp)] == code_value(ir::CompSide::off);
  if (rapid && off) add("R0", Rank::motion_extra);
}

void Writer::feed_word(bool rapid) {
  if (rapid) return add("FMAX", Rank::feed);
  if (feed_) add('F' + *feed_, Rank::feed);
  feed_.reset();
}

void Writer::motion(const ir::Motion& m) {
  const auto kind = kind_of(m);
  if (m.kind != ir::MotionKind::modal) motion_tracker().wrote(m.kind, true);
  if (!m.moves()) return;
  if (!kind)
    return refuse("TRN-216", m.code_pos, "the motion code in force here is not known, and the target needs one",
                  "write G0, G1, G2 or G3 in this block");
  if (m.frame != ir::FrameUse::normal && m.frame != ir::FrameUse::machine) return frame_use(m);
  switch (*kind) {
    case ir::MotionKind::rapid: return straight(m, true);
    case ir::MotionKind::linear: return straight(m, false);
    case ir::MotionKind::arc_cw: return arc(m, false);
    case ir::MotionKind::arc_ccw: return arc(m, true);
    case ir::MotionKind::arc_tangent:
      if (m.extra || !m.centers.empty()) return motion_extra(m, m.extra ? *m.extra : ir::MotionExtra{});
      add("CT", Rank::motion_code);
      coordinates(m);
      return feed_word(false);
    default:
      return refuse(no_word, m.code_pos, "a motion '" + std::string(ir::name(*kind)) + "' has no counterpart here");
  }
}

void Writer::straight(const ir::Motion& m, bool rapid) {
  if (m.extra) return motion_extra(m, *m.extra);
  add("L", Rank::motion_code);
  coordinates(m);
  side_word();
  feed_word(rapid);
  if (m.frame == ir::FrameUse::machine) add(m_word(91), Rank::machine);
}

// ---- arcs ----------------------------------------------------------------------------------------------------------

bool Writer::has_centre_line(const ir::Block& b) {
  const auto kind = kind_of(b.motion);
  return kind && is_circle(*kind) && !b.motion.centers.empty();
}

/// CC: absolute where the start is known, as a programmer writes it; else from the point where the tool stands.
std::string Writer::centre_word(const ir::Motion& m, ir::AxisId axis) {
  const auto at =
      std::find_if(m.centers.begin(), m.centers.end(), [axis](const ir::CenterWord& w) { return w.axis == axis; });
  const ir::Facts* f = facts();
  const auto start = f != nullptr ? f->position[axis] : std::nullopt;
  const std::string name(axis_name(axis));
  if (at == m.centers.end()) return start ? word(name, ir::Value(*start), {}) : word('I' + name, ir::Value(0.0), {});
  if (at->mode == ir::CenterMode::absolute) return word(name, at->value, at->pos);
  if (start && at->value.literal()) return word(name, ir::Value(*start + at->value.number), at->pos);
  return word('I' + name, at->value, at->pos);
}

void Writer::centre_line(const ir::Motion& m) {
  if (m.frame != ir::FrameUse::normal) return frame_use(m);
  const auto plane = setting(ir::Setting::plane);
  if (plane != code_value(ir::Plane::xy)) return arc(m, true);  // refused there
  const ir::PlaneAxes axes = ir::plane_axes(static_cast<ir::Plane>(*plane));
  for (const ir::CenterWord& w : m.centers) {
    if (w.mode == ir::CenterMode::follows_distance || w.scale == ir::WordScale::diameter ||
        (w.axis != axes.u && w.axis != axes.v))
      return refuse(no_word, w.pos, "this form of an arc's centre has no counterpart here");
  }
  add("CC " + centre_word(m, axes.u) + ' ' + centre_word(m, axes.v), Rank::head);
  next_line();
}

void Writer::arc(const ir::Motion& m, bool ccw) {
  if (m.frame != ir::FrameUse::normal) return frame_use(m);
  if (setting(ir::Setting::plane) != code_value(ir::Plane::xy))
    return refuse(no_word, m.code_pos, "an arc lies in the plane across the tool axis Z here, which is not this one",
                  "turn the part, or write the arc as short lines");
  if (side_ && *side_ != ir::CompSide::off)
    return refuse(no_word, m.code_pos, "radius compensation begins in a straight move here");
  const ir::MotionExtra* e = m.extra.get();
  const bool turns = e != nullptr && e->has_angle && !e->has_turns && !e->has_pitch && e->through.empty() &&
                     !e->has_polar_radius && !e->has_polar_angle;
  if (e != nullptr && !turns) return motion_extra(m, *e);
  const std::string sense = ccw ? "DR+" : "DR-";
  if (turns) {  // a helix: CP IPA+720 IZ-10
    const auto plane = setting(ir::Setting::plane);
    const ir::AxisId normal = ir::plane_axes(static_cast<ir::Plane>(plane.value_or(0))).w;
    const double angle = e->opening_angle.number;
    add("CP", Rank::motion_code);
    add("IPA" + signed_amount(ir::Value(ccw ? angle : -angle), m.code_pos), Rank::coordinate);
    for (const ir::CoordWord& w : m.coords) {
      if (w.axis != normal) continue;
      const ir::Facts* f = facts();
      const auto start = f != nullptr ? f->position[normal] : std::nullopt;
      const std::string name(axis_name(w.axis));
      if (!increment(w).value_or(true)) {
        const bool rise = start && w.value.literal();
        add(rise ? word('I' + name, ir::Value(w.value.number - *start), w.pos) : word(name, w.value, w.pos),
            Rank::coordinate);
      } else {
        add(word('I' + name, w.value, w.pos), Rank::coordinate);
      }
    }
  } else {
    add(m.radius_given ? "CR" : "C", Rank::motion_code);
    coordinates(m);
    if (m.radius_given) add("R" + signed_amount(m.radius, m.radius_pos), Rank::radius);
  }
  add(sense, Rank::motion_extra);
  side_word();
  feed_word(false);
}

}  // namespace cnctrans::backends::heidenhain
