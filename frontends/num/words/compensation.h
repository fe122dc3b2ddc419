// What stops the control while radius compensation is on, and where it begins (reference 22).
#pragma once

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::frontends::num {

/// The block has G16.
bool turns_tool(const ir::Block& b);
/// NUM-051 at an arc with which compensation begins or ends, at a plane function, M00, M01, G52 and an assignment of
/// L100 to L199 while it is on for certain, and at an arc under G93 (numbers the statements).
void judge_compensation(ir::Program& program, const ir::ModalState& power_on, Diagnostics& diagnostics);

/// The same for a stream: follows the blocks of a straight text.
class CompensationWatch {
 public:
  explicit CompensationWatch(const ir::ModalState& power_on)
      : motion_(power_on.motion), inverse_time_(power_on.feed_mode == ir::FeedMode::inverse_time) {}
  /// judge_compensation() may have something to say about this block.
  bool suspects(const ir::Block& b);

 private:
  ir::MotionKind motion_;
  bool on_ = false, begins_ = false, inverse_time_ = false;
};

}  // namespace cnctrans::frontends::num
