// How long a preset of the zero point holds: until the program takes it back, until its end, or for good, in the datum
// table of the control.
#pragma once

#include "ir/passes/frame_state.h"

namespace cnctrans::ir::passes {

/// The target writes presets as shifts: they are taken back in the program, or would hold on there behind its end.
bool presets_as_shifts(const Program& program, const LegaliseContext& context, const FactsOf& facts,
                       const FrameStates& states);

/// Says where a preset holds on behind the end of the program on one control only.
class PresetEnds {
 public:
  PresetEnds(const Program& program, const LegaliseContext& context);
  /// The action of the source, if it is a preset. `as_it_is`: the target presets as well.
  void tell(const Statement& s, const Action& a, bool as_it_is) const;

 private:
  const LegaliseContext& context_;
  bool source_keeps_ = false, target_keeps_ = false;
};

}  // namespace cnctrans::ir::passes
