#include "frontends/num/surfaces.h"

#include <algorithm>
#include <optional>

#include "ir/dataflow.h"

namespace cnctrans::frontends::num {

namespace {

std::optional<ir::Surface> surface_in(const ir::Block& b) {
  for (const auto& a : b.actions) {
    if (const auto* s = std::get_if<ir::SurfaceSet>(&a.data)) return s->surface;
  }
  return std::nullopt;
}

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

template <class Enum>
std::optional<Enum> in_force(const ir::Block& b, const ir::Facts& facts, ir::Setting s) {
  auto value = facts.settings[static_cast<std::size_t>(s)];
  for (const auto& a : b.actions) {
    if (const auto* m = std::get_if<ir::ModalSet>(&a.data); m != nullptr && m->setting == s) value = m->value;
  }
  return value ? std::optional(static_cast<Enum>(*value)) : std::nullopt;
}

}  // namespace

void judge_surfaces(ir::Program& program, const ir::ModalState& power_on, Diagnostics& diagnostics) {
  bool used = false;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&used](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      used = used || (b != nullptr && surface_in(*b).value_or(ir::Surface::none) != ir::Surface::none);
    });
  }
  if (!used) return;
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, power_on);
  for (const auto& r : program.routines) {
    auto by_text = ir::Surface::none;
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      const auto own = surface_in(*b);
      if (own) by_text = *own;
      const ir::Facts& before = table.before(s.id);
      if (!before.reachable) return;
      const auto known = before.settings[static_cast<std::size_t>(ir::Setting::surface)];
      if (!own && says_x_or_y(*b) && known != static_cast<std::uint8_t>(by_text)) {
        diagnostics.error("NUM-050", s.line.span,
                          "X and Y of this block depend on G20, G21 or G22, and which one is in force depends on the "
                          "way to it",
                          "write the function in this block");
      }
      const auto wanted = by_text == ir::Surface::face ? ir::Plane::xy : ir::Plane::yz;
      if (by_text != ir::Surface::none && turns(*b, before) &&
          in_force<ir::Plane>(*b, before, ir::Setting::plane) != wanted) {
        diagnostics.error("NUM-050", s.line.span,
                          "an arc or radius compensation on the face or the cylinder in another plane",
                          by_text == ir::Surface::face ? "write G17 behind G21" : "write G19 behind G22");
      }
    });
  }
}

}  // namespace cnctrans::frontends::num
