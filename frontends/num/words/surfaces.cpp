#include "frontends/num/words/surfaces.h"

#include <algorithm>
#include <optional>

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

}  // namespace cnctrans::frontends::num
