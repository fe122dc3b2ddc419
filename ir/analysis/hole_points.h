// Whether a block is a point of a modal hole cycle. Some controls go there in rapid, whichever motion function is in
// force, and take no motion code beside it.
#pragma once

#include "ir/analysis/dataflow.h"

namespace cnctrans::ir {

enum class HolePoint : std::uint8_t {
  no,
  perhaps,  ///< the cycle is active on some of the ways that lead here
  yes
};
/// `facts`: before the block.
HolePoint hole_point(const Block& b, const Facts& facts);

}  // namespace cnctrans::ir
