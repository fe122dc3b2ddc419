// The table of passes: what legalisation does, in its order. docs/passes.md is made from it (tools/passes-table).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "legaliser/legalise.h"

namespace cnctrans::ir {

/// What a pass looks at to decide about one block.
enum class PassScope : std::uint8_t {
  block,   ///< the block, and the modal state before it
  program  ///< other blocks, routines, or the program as a whole
};

struct Pass {
  std::string_view name;  ///< that of its function
  void (*run)(Program&, const LegaliseContext&);
  PassScope scope;
  std::string_view summary;  ///< one line, for people
};

std::span<const Pass> pipeline();

}  // namespace cnctrans::ir
