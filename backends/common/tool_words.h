// What a block says about tools.
#pragma once

#include <variant>

#include "ir/block.h"

namespace cnctrans::backends {

/// A tool and its offset, without the change.
inline bool tool_and_offset_only(const ir::Block& b) {
  bool tool = false, offset = false;
  for (const ir::Action& a : b.actions) {
    if (std::holds_alternative<ir::ToolChange>(a.data)) return false;
    const auto* t = std::get_if<ir::ToolSelect>(&a.data);
    tool = tool || (t != nullptr && !t->changes);
    offset = offset || std::holds_alternative<ir::ToolOffset>(a.data);
  }
  return tool && offset;
}

}  // namespace cnctrans::backends
