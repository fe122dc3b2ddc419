#include "frontends/heidenhain/ways/from_pole.h"

#include <algorithm>

#include "ir/known_number.h"

namespace cnctrans::frontends::heidenhain {

namespace {

const ir::Block* block_of(const Item& item) {
  return std::get_if<ir::Block>(&item.statement.node);
}

/// A full turn, or a move along the tool axis alone, leaves the tool where it is in the plane.
bool stays_in_plane(const ir::Motion& m, const ir::PlaneAxes& plane) {
  return m.frame == ir::FrameUse::normal && !(m.extra && (m.extra->has_polar_radius || m.extra->has_polar_angle)) &&
         std::all_of(m.coords.begin(), m.coords.end(), [&plane](const ir::CoordWord& c) { return c.axis == plane.w; });
}
bool by_polar_words(const ir::Motion& m) {
  return m.extra && m.extra->has_polar_radius && m.extra->has_polar_angle &&
         m.extra->polar_mode != ir::WordMode::incremental && m.extra->polar_angle_mode != ir::WordMode::incremental;
}
bool by_increments(const ir::Motion& m) {
  return m.frame == ir::FrameUse::normal && !m.extra &&
         std::all_of(m.coords.begin(), m.coords.end(),
                     [](const ir::CoordWord& c) { return c.mode == ir::WordMode::incremental; });
}

/// The place of the tool at the CC, whose words are increments from it.
std::optional<FromPole> at_pole(const Pole& pole, const ir::PlaneAxes& plane) {
  FromPole out{ir::Value{0.0}, ir::Value{0.0}};
  for (std::size_t k = 0; k < pole.words.size(); ++k) {
    const auto& w = pole.words[k];
    if (!pole.incremental[k] || (w.axis != plane.u && w.axis != plane.v)) return std::nullopt;
    (w.axis == plane.u ? out.first : out.second) = ir::negate(w.value);
  }
  return out;
}

}  // namespace

std::optional<FromPole> from_pole(const Flat& flat, const Arrival& a) {
  if (a.from < 0 || a.pole < 0 || a.plane == Arrival::several) return std::nullopt;
  const auto plane = ir::plane_axes(static_cast<ir::Plane>(a.plane));
  const Item& item = flat.items[static_cast<std::size_t>(a.from)];
  if (item.kind != ItemKind::pole) {
    const ir::Motion& m = block_of(item)->motion;
    if (by_polar_words(m))
      return FromPole{ir::polar_leg(m.extra->polar_radius, m.extra->polar_angle, ir::Function::cos),
                      ir::polar_leg(m.extra->polar_radius, m.extra->polar_angle, ir::Function::sin)};
  }
  auto out = at_pole(flat.poles[static_cast<std::size_t>(a.pole)], plane);
  if (!out || item.kind == ItemKind::pole) return out;
  for (const auto& c : block_of(item)->motion.coords) {
    if (c.axis == plane.u) out->first = ir::add(out->first, c.value);
    if (c.axis == plane.v) out->second = ir::add(out->second, c.value);
  }
  return out;
}

void follow_from_pole(const Flat& flat, int index, Arrival& a) {
  const Item& item = flat.items[static_cast<std::size_t>(index)];
  if (item.kind == ItemKind::pole) {
    a.from = index;
    a.changed = false;
    return;
  }
  if (!item.writes.empty() || item.kind == ItemKind::program) a.changed = true;
  const ir::Block* b = block_of(item);
  const bool shifts =
      b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), [](const ir::Action& x) {
        return std::holds_alternative<ir::FrameOp>(x.data) || std::holds_alternative<ir::WorkOffset>(x.data);
      });
  const bool may_move = item.kind == ItemKind::program || item.call != CycleCall::none || item.at_pattern ||
                        item.index >= 0 || item.free >= 0 || item.lead >= 0 ||
                        (item.moves && item.statement.line.skip_mask != 0);
  if (may_move || shifts) {
    a.from = Arrival::none;
    return;
  }
  if (!item.moves || b == nullptr || a.plane == Arrival::several) return;
  const auto plane = ir::plane_axes(static_cast<ir::Plane>(a.plane));
  if (stays_in_plane(b->motion, plane)) return;
  const bool from_cc = a.from >= 0 && flat.items[static_cast<std::size_t>(a.from)].kind == ItemKind::pole;
  const bool known = by_polar_words(b->motion) || (from_cc && by_increments(b->motion));
  if (known && by_polar_words(b->motion)) a.changed = false;
  a.from = known ? index : Arrival::none;
}

}  // namespace cnctrans::frontends::heidenhain
