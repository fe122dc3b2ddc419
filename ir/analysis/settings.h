// Modal settings out of the facts of the dataflow.
#pragma once

#include <optional>

#include "ir/analysis/dataflow.h"

namespace cnctrans::ir::passes {

/// The setting when it is known.
template <class Enum>
std::optional<Enum> setting(const Facts& facts, Setting s) {
  const auto value = facts.settings[static_cast<std::size_t>(s)];
  if (!value) return std::nullopt;
  return static_cast<Enum>(*value);
}
/// What the block itself sets, else what holds before it. Settings count for the whole block, except those that are
/// carried out after its motion.
template <class Enum>
std::optional<Enum> setting_in(const Block& block, const Facts& facts, Setting s) {
  std::optional<Enum> value = setting<Enum>(facts, s);
  for (const auto& a : block.actions) {
    if (a.order == Order::after) continue;
    if (const auto* m = std::get_if<ModalSet>(&a.data); m != nullptr && m->setting == s)
      value = static_cast<Enum>(m->value);
  }
  return value;
}
/// The motion function of the block.
inline std::optional<MotionKind> motion_in(const Block& block, const Facts& facts) {
  return block.motion.kind == MotionKind::modal ? facts.motion : std::optional(block.motion.kind);
}

}  // namespace cnctrans::ir::passes
