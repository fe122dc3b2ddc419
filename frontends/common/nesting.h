// How deep structured statements may stand inside one another.
#pragma once

#include "frontends/common/structure_builder.h"

namespace cnctrans::frontends {

/// No control takes more than 16; what walks a program goes down with every level.
inline constexpr std::size_t deepest_structure = 200;

inline bool nested_too_deep(const StructureBuilder& structure) {
  return structure.depth() >= deepest_structure;
}

}  // namespace cnctrans::frontends
