// What the frame statements of a block do to the place where the tool stands, as far as the frames are numbers.
#pragma once

#include "legaliser/frames/frame_state.h"

namespace cnctrans::ir::passes {

class FrameSteps {
 public:
  /// `machine`: whose slots the program's frame statements name.
  FrameSteps(const Program& program, const FactsOf& facts, const machine::Profile& machine,
             const LegaliseContext& context);

  using Place = std::array<std::optional<double>, axis::count_max>;
  /// The machine stays where it is, and its place is seen in the new frame.
  [[nodiscard]] Place seen(const Statement& s, const Place& before) const;
  /// The zero point is another one behind the block, or may be.
  [[nodiscard]] bool moves_zero(const Statement& s) const;

 private:
  struct Step {
    PlanarFrame before, after;
  };
  [[nodiscard]] std::optional<Step> step(const Statement& s) const;

  const FactsOf& facts_;
  const machine::Profile& machine_;
  const FrameStates states_;
};

}  // namespace cnctrans::ir::passes
