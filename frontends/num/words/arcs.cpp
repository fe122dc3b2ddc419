// Arcs by centre, radius or three points (reference 6.3, 6.4).
#include <utility>

#include "dialects/num/variables.h"
#include "frontends/num/state/actions.h"
#include "frontends/num/state/slots.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;
using namespace slot;

void Lowering::resolve_arc(bool explicit_code) {
  auto& m = out_->motion;
  std::size_t given = 0;
  for (const char c : {'I', 'J', 'K'}) given += has(letter(c)) ? 1U : 0U;
  const Word* radius = has(letter('R')) ? use(letter('R')) : nullptr;
  // Two centre words are the centre whatever the plane is; of three, or beside a radius, one is the pitch.
  const bool by_plane = given == 1 || given == 3 || (given != 0 && radius != nullptr);
  const PlaneLetters p = centre_letters(by_plane ? plane() : state_.plane);
  const std::array<char, 3> order{p.u, p.v, p.w};
  const bool pitch = has(letter(p.w)) && (radius != nullptr || given == 3);
  const std::size_t centres = given - (pitch ? 1U : 0U);
  ir::contour::Marks contour;
  if ((present_ & geometry_slots & ~used_) != 0 && !contour_end(contour)) return;
  const bool follows = contour.end != ir::contour::ElementEnd::given;
  const bool open = follows || state_.contour_open || !state_.known;
  const WordPos where = m.explicit_code ? m.code_pos : block_->words.front().pos;
  if (radius != nullptr) {
    if (centres != 0 && !open)
      return report_.refuse("NUM-011", radius->pos, "an arc has a centre or a radius, not both");
    if (!radius->is_expression && radius->number <= 0)
      return report_.refuse("NUM-011", radius->pos, "the radius of an arc must be above 0");
    m.radius_given = true;
    m.radius = value(*radius);
    m.radius_pos = radius->pos;
  }
  if (centres == 1) {
    return report_.refuse("NUM-011", where, "the centre of the arc is incomplete: both coordinates must be written",
                          "a missing one would be 0, not the present position");
  }
  if (contour.any()) m.extra = std::make_shared<const ir::MotionExtra>();
  if (centres == 0 && radius == nullptr) {
    if ((follows || !m.coords.empty()) && (explicit_code || state_.known))
      report_.refuse("NUM-011", where, "the arc has neither centre nor radius");
    return;
  }
  for (const char c : order) {
    if (!has(letter(c)) || (pitch && c == p.w)) continue;
    const Word* w = use(letter(c));
    auto& centre = m.centers.emplace_back();
    centre.axis = centre_axis(c);
    centre.mode = settings_.centre_absolute ? ir::CenterMode::follows_distance : ir::CenterMode::from_start;
    centre.scale = ir::WordScale::modal;
    centre.value = axis_value(*w, centre.axis);
    centre.pos = w->pos;
    const bool own_mode =
        marks_.distance_count > 1 || (marks_.distance_after && marks_.distances[0]->pos.column < w->pos.column);
    if (settings_.centre_absolute && own_mode) {
      if (const auto mode = own_distance(w->pos.column))
        centre.mode = *mode == ir::Distance::incremental ? ir::CenterMode::from_start : ir::CenterMode::absolute;
    }
  }
  if (pitch) {
    const Word* w = use(letter(p.w));
    if (!w->is_expression && w->number <= 0)
      return report_.refuse("NUM-011", w->pos, "the pitch of a helix must be above 0");
    if (contour.any())
      return report_.refuse("NUM-043", w->pos, "a helix in a contour whose points follow from the next element", {},
                            "motion.geometry");
    ir::MotionExtra extra;
    extra.has_pitch = true;
    extra.pitch = value(*w);
    m.extra = std::make_shared<const ir::MotionExtra>(std::move(extra));
  }
}

void Lowering::through_points() {
  auto& m = out_->motion;
  const Word& g = *marks_.three_points;
  ir::MotionExtra extra;
  for (const char c : {'I', 'J', 'K'}) {
    const Word* w = use(letter(c));
    if (w == nullptr) continue;
    ir::CenterWord point;
    point.axis = centre_axis(c);
    point.mode = ir::CenterMode::follows_distance;
    point.scale = ir::WordScale::modal;
    point.value = axis_value(*w, point.axis);
    point.pos = w->pos;
    extra.through.push_back(std::move(point));
  }
  if (marks_.motion || extra.through.size() != 2 || m.coords.size() < 2) {
    return report_.refuse("NUM-011", g.pos,
                          "G23 needs an end point and a point on the arc, and no other motion function");
  }
  m.kind = ir::MotionKind::arc_through_point;
  m.explicit_code = true;
  m.keeps_modal = false;
  m.code_pos = g.pos;
  m.code_text = text_of(g);
  m.extra = std::make_shared<const ir::MotionExtra>(std::move(extra));
  out_->has_motion = true;
  flow_->linear_after = true;
  state_.motion = ir::MotionKind::linear;
}

}  // namespace cnctrans::frontends::num
