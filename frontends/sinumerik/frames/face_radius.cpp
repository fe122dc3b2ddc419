#include "frontends/sinumerik/frames/face_radius.h"

#include <algorithm>
#include <memory>

#include "ir/analysis/dataflow.h"
#include "ir/edit/search.h"

namespace cnctrans::frontends::sinumerik {

namespace {

bool open(ir::AxisId axis, ir::WordScale scale) {
  return axis == ir::axis::x && scale == ir::WordScale::modal;
}

bool open_words(const ir::Block& b) {
  const auto word = [](const auto& w) { return open(w.axis, w.scale); };
  return b.has_motion && (std::any_of(b.motion.coords.begin(), b.motion.coords.end(), word) ||
                          std::any_of(b.motion.centers.begin(), b.motion.centers.end(), word));
}

void to_radius(ir::Block& b) {
  const auto set = [](auto& w) {
    if (open(w.axis, w.scale)) w.scale = ir::WordScale::radius;
  };
  if (b.has_motion) {
    std::for_each(b.motion.coords.begin(), b.motion.coords.end(), set);
    std::for_each(b.motion.centers.begin(), b.motion.centers.end(), set);
  }
  for (auto& a : b.actions) {
    auto* f = std::get_if<ir::FrameOp>(&a.data);
    if (f == nullptr || !f->change || f->change->kind != ir::FrameKind::translate) continue;
    auto copy = std::make_shared<ir::FrameChange>(*f->change);
    std::for_each(copy->words.begin(), copy->words.end(), set);
    f->change = std::move(copy);
  }
}

}  // namespace

void face_radius(ir::Program& program, const machine::Profile& profile, Diagnostics& diagnostics) {
  const auto* x_axis = profile.axis(ir::axis::x);
  if (x_axis == nullptr || !x_axis->diameter) return;
  bool used = false, in_order = true;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      const auto* set = b != nullptr ? ir::action_in<ir::SurfaceSet>(*b) : nullptr;
      used = used || (set != nullptr && set->surface == ir::Surface::face);
      in_order = in_order && (b != nullptr || std::holds_alternative<ir::Assign>(s.node));
    });
  }
  if (!used) return;
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, profile.power_on);
  for (auto& r : program.routines) {
    auto by_text = ir::Surface::none;
    ir::for_each_statement(r.body, [&](ir::Statement& s) {
      auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      const ir::Surface text = by_text;
      if (const auto* set = ir::action_in<ir::SurfaceSet>(*b)) by_text = set->surface;
      const ir::Facts& before = table.before(s.id);
      if (!before.reachable) return;
      auto surface = before.settings[static_cast<std::size_t>(ir::Setting::surface)];
      if (!surface && in_order) surface = static_cast<std::uint8_t>(text);  // behind words that are not understood
      const auto mode = before.settings[static_cast<std::size_t>(ir::Setting::diameter)];
      if (surface == static_cast<std::uint8_t>(ir::Surface::face)) return to_radius(*b);
      if (!surface && open_words(*b) && mode != static_cast<std::uint8_t>(ir::DiameterMode::radius)) {
        diagnostics.error("SIN-041", s.line.span,
                          "whether X is a radius (TRANSMIT) or follows DIAMON depends on the path that leads here",
                          "write DIAMOF, or TRANSMIT and TRAFOOF on every path");
      }
    });
  }
}

}  // namespace cnctrans::frontends::sinumerik
