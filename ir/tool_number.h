// Tools that are called by name.
#pragma once

#include "ir/block.h"

namespace cnctrans::ir {

/// A tool called by its number, or by a name that the tools of the machine have a number for.
inline bool has_number(const ToolSelect& t) {
  return t.name.empty() || !t.number.is(0);
}

}  // namespace cnctrans::ir
