#include "frontends/num/words/surfaces.h"

#include <algorithm>
#include <optional>

#include "frontends/num/state/actions.h"
#include "frontends/num/state/lower.h"
#include "ir/analysis/dataflow.h"
#include "ir/analysis/settings.h"
#include "ir/edit/search.h"

namespace cnctrans::frontends::num {

namespace {

bool says_x_or_y(const ir::Block& b) {
  return b.has_motion && std::any_of(b.motion.coords.begin(), b.motion.coords.end(), [](const ir::CoordWord& w) {
           return w.axis == ir::axis::x || w.axis == ir::axis::y;
         });
}

/// An arc, or the beginning of radius compensation.
bool turns(const ir::Block& b, const ir::Facts& facts) {
  const auto kind = b.motion.kind == ir::MotionKind::modal ? facts.motion : std::optional(b.motion.kind);
  const bool arc = b.has_motion && b.motion.moves() &&
                   (kind == ir::MotionKind::arc_cw || kind == ir::MotionKind::arc_ccw ||
                    kind == ir::MotionKind::arc_through_point || kind == ir::MotionKind::arc_tangent);
  return arc || std::any_of(b.actions.begin(), b.actions.end(), [](const ir::Action& a) {
           const auto* m = std::get_if<ir::ModalSet>(&a.data);
           return m != nullptr && m->setting == ir::Setting::comp && m->value != 0;
         });
}

}  // namespace

void judge_surfaces(ir::Program& program, const ir::ModalState& power_on, Diagnostics& diagnostics) {
  const auto chooses = [](const ir::Action& a) {
    const auto* set = std::get_if<ir::SurfaceSet>(&a.data);
    return set != nullptr && set->surface != ir::Surface::none;
  };
  if (!ir::any_action(program, chooses)) return;
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, power_on);
  for (const auto& r : program.routines) {
    auto by_text = ir::Surface::none;
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      const auto* own = ir::action_in<ir::SurfaceSet>(*b);
      if (own != nullptr) by_text = own->surface;
      const ir::Facts& before = table.before(s.id);
      if (!before.reachable) return;
      const auto known = before.settings[static_cast<std::size_t>(ir::Setting::surface)];
      if (own == nullptr && says_x_or_y(*b) && known != static_cast<std::uint8_t>(by_text)) {
        diagnostics.error("NUM-050", s.line.span,
                          "X and Y of this block depend on G20, G21 or G22, and which one is in force depends on the "
                          "way to it",
                          "write the function in this block");
      }
      const auto wanted = by_text == ir::Surface::face ? ir::Plane::xy : ir::Plane::yz;
      if (by_text != ir::Surface::none && turns(*b, before) &&
          ir::passes::setting_in<ir::Plane>(*b, before, ir::Setting::plane) != wanted) {
        diagnostics.error("NUM-050", s.line.span,
                          "an arc or radius compensation on the face or the cylinder in another plane",
                          by_text == ir::Surface::face ? "write G17 behind G21" : "write G19 behind G22");
      }
    });
  }
}

/// G21: Cartesian X and Y on the face; G22: Y along the cylinder on which X stands; G20: X Z (12.6).
void Lowering::mark_surface(const Word& w, ir::Surface surface) {
  if (surface != ir::Surface::none) {
    report_.warn("NUM-049", w.pos,
                 "`" + std::string(text_of(w)) +
                     (surface == ir::Surface::face
                          ? "`: X on the face is read as a " +
                                std::string(settings_.face_radius ? "radius" : "word of the machine's own kind") +
                                "; the manuals at hand do not say it"
                          : "`: the cylinder is the one on which X stands"),
                 surface == ir::Surface::face ? "the option num.face_x says it" : "");
  }
  state_.surface = surface;
  act(w, Step::setting, ir::SurfaceSet{surface, {}});
}

/// X of the face where it is a radius whatever the machine's X is.
void Lowering::face_words() {
  if (state_.surface != ir::Surface::face || !settings_.face_radius) return;
  auto& m = out_->motion;
  for (auto& c : m.coords) {
    if (c.axis == ir::axis::x) c.scale = ir::WordScale::radius;
  }
  for (auto& c : m.centers) {
    if (c.axis == ir::axis::x) c.scale = ir::WordScale::radius;
  }
}

}  // namespace cnctrans::frontends::num
