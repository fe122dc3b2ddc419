// Work with the C axis of the lathe (manual 6.15): G15 with G16 XC is the face, G15 R with G16 ZC the cylinder. C is a
// length there; in the IR it is the coordinate Y of the face, and of the unrolled cylinder.
#include <string>

#include "frontends/fagor/statements/expr.h"
#include "frontends/fagor/words/block.h"

namespace cnctrans::fagor {

namespace {
constexpr std::string_view surface_fault = "FAG-045";
}

/// G15: the spindle is the C axis, whose words are degrees until a plane with it is chosen. G15 R: the cylinder of this
/// radius is unrolled.
void BlockLowerer::c_axis(const GWord& g) {
  const Word* r = corner_radius(*g.word);
  if (r == nullptr) {
    if (state_.surface_by_text == ir::Surface::cylinder)
      state_.error(surface_fault, g.word->pos,
                   "G15 without R while a cylinder is unrolled: what C means from here is not said",
                   "write G18 first, or G15 R");
    result_->opaque = "motion.transformation";
    result_->harmless = true;
    state_.note("FAG-008", g.word->pos, "G15 (the C axis) moves nothing; C is in degrees until G16 XC or G16 ZC");
    return;
  }
  result_->needs_program = true;
  state_.facts.surfaces = true;
  if (state_.surface_by_text == ir::Surface::face) leave_surface();
  const bool again = state_.surface_by_text == ir::Surface::cylinder;
  state_.surface_by_text = ir::Surface::cylinder;
  if (!again) state_.surface_plane_by_text = false;
  ir::SurfaceSet set;
  set.surface = ir::Surface::cylinder;
  set.diameter = ir::scale(value(*r), 2);
  set.diameter.text = {};
  if (set.diameter.literal() && !(set.diameter.number > 0))
    state_.error("FAG-013", r->pos, "the radius of the cylinder must be greater than zero");
  act(std::move(set), g.word);
  if (const std::string_view whole = spelling(*g.word, *r); whole.size() <= 24) out_->actions.back().text = whole;
}

/// G16 XC and G16 ZC. The latter is the plane Y Z seen from behind: its abscissa is Z.
bool BlockLowerer::surface_plane(const GWord& g) {
  if (!state_.lathe() || coord_count_ != 2 || !state_.has_axis(ir::axis::c)) return false;
  const char first = word_letter(*coords_[0]);
  if (word_letter(*coords_[1]) != 'C' || (first != 'X' && first != 'Z')) return false;
  if (first == 'Z' && state_.surface_by_text != ir::Surface::cylinder) return false;  // C in degrees
  result_->needs_program = true;
  const std::string_view whole = spelling(*g.word, *coords_[1]);
  surface_here_ = state_.surface_plane_by_text = true;
  if (first == 'X') {
    state_.facts.surfaces = true;
    state_.surface_by_text = ir::Surface::face;
    act(ir::SurfaceSet{ir::Surface::face, {}}, g.word);
    if (whole.size() <= 8) out_->actions.back().text = whole;
    plane(g, ir::Plane::xy);
  } else {
    plane(g, ir::Plane::yz, true);
  }
  if (whole.size() <= 8) out_->actions.back().text = whole;
  return true;
}

/// Another plane, or the spindle as such (M3, M4, M5): the words are those of the axes again.
void BlockLowerer::leave_surface(ir::Order order) {
  if (state_.surface_by_text == ir::Surface::none) return;
  act(ir::SurfaceSet{}, nullptr, order);
  surface_ends_ = order == ir::Order::after;
  if (surface_ends_) return;
  state_.surface_by_text = ir::Surface::none;
  state_.surface_plane_by_text = false;
}

/// X of the face is a radius, whatever DFORMAT says (6.15.2). True: the word is a length on the surface.
bool BlockLowerer::surface_coordinate(ir::CoordWord& c, const Word& w) {
  if (c.axis == ir::axis::x && state_.surface_by_text == ir::Surface::face) c.scale = ir::WordScale::radius;
  if (c.axis == ir::axis::y) {
    state_.error(surface_fault, w.pos, "a word of the Y axis under work with the C axis is not carried");
    return false;
  }
  if (c.axis != ir::axis::c) return false;
  if (!state_.surface_plane_by_text)
    state_.error(surface_fault, w.pos,
                 "C behind G15 R and before G16 ZC: whether it is a length or an angle is not said",
                 "write G16 ZC behind G15 R");
  if (c.axis == ir::axis::c && machine_coords_ != nullptr)
    state_.error(surface_fault, w.pos,
                 "C in machine coordinates under work on the face or the cylinder is not carried");
  c.axis = ir::axis::y;
  return true;
}

/// I, J, K belong to X, Y, Z and to the axes along them; that of C is K. On the cylinder Z and C have the same letter.
ir::AxisId BlockLowerer::center_axis(const Word& w) {
  const auto axis = static_cast<ir::AxisId>(word_letter(w) - 'I');
  if (state_.surface_by_text == ir::Surface::none) return axis;
  if (axis == ir::axis::y) {
    state_.error(surface_fault, w.pos, "J has no axis under work with the C axis; the letter of C is K");
    return axis;
  }
  if (axis != ir::axis::z) return axis;
  if (state_.surface_by_text == ir::Surface::cylinder)
    state_.error(surface_fault, w.pos, "K is the letter of Z and of C: which of them the centre means is not said",
                 "write the arc by its radius R");
  return ir::axis::y;
}

void BlockLowerer::note_surface() {
  result_->needs_program = true;
  state_.facts.surface_lines.emplace(state_.line().line, state_.surface_by_text);
  if (!surface_ends_) return;
  state_.surface_by_text = ir::Surface::none;
  state_.surface_plane_by_text = false;
}

}  // namespace cnctrans::fagor
