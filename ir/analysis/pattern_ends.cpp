#include "ir/analysis/pattern_ends.h"

#include "ir/cycles/pattern.h"
#include "ir/known_number.h"

namespace cnctrans::ir::detail {

namespace {

const NamedCycle* pattern_of(const Block& b) {
  for (const auto& a : b.actions) {
    const auto* c = std::get_if<CycleDefine>(&a.data);
    const auto* named = c != nullptr && c->cycle ? std::get_if<NamedCycle>(&c->cycle->node) : nullptr;
    if (named != nullptr && cycles::find_pattern(named->name) != nullptr) return named;
  }
  return nullptr;
}

}  // namespace

std::map<AxisId, double> pattern_end(const Block& b, const Facts& before) {
  const auto* named = pattern_of(b);
  const bool holes = before.cycle_active_known && (!before.cycle_active || before.cycle_is_hole);
  const auto radius = static_cast<std::uint8_t>(DiameterMode::radius);
  const auto plane = before.settings[static_cast<std::size_t>(Setting::plane)];
  if (named == nullptr || !plane || b.has_motion || !holes || before.modal_call != 0 || b.repeat_given != 0 ||
      before.settings[static_cast<std::size_t>(Setting::diameter)] != radius)
    return {};
  cycles::PatternNumbers numbers;
  for (const auto& [word, v] : named->words) {
    const auto* p = cycles::find_pattern_parameter(word);
    const auto x = known_number(v);
    if (p == nullptr || !x) return {};
    numbers[p->name] = *x;
  }
  const auto& pattern = *cycles::find_pattern(named->name);
  const auto axes = plane_axes(static_cast<Plane>(*plane));
  const auto u = before.position[axes.u], v = before.position[axes.v];
  const bool counts = pattern.from_tool || pattern.kind == cycles::PatternKind::row;
  if (counts && (!u || !v)) return {};
  std::string error;
  const auto points = cycles::pattern_points(pattern, numbers, u.value_or(0), v.value_or(0), &error);
  if (!points || points->empty()) return {};
  return {{axes.u, points->back().u}, {axes.v, points->back().v}};
}

}  // namespace cnctrans::ir::detail
