// How long a preset of the zero point holds: until the program takes it back, until its end, or for good, in the datum
// table of the control.
#pragma once

#include "legaliser/frames/frame_state.h"

namespace cnctrans::ir::passes {

/// A preset is in force somewhere where the program takes it back, or selects a work offset, which ends it on targets
/// without a function of its own for that: a target that can't take it back writes a shift.
bool presets_taken_back(const Program& program, const LegaliseContext& context, const FactsOf& facts,
                        const FrameStates& states);
/// The program has presets, and the target alone keeps them behind its end.
bool presets_outlast(const Program& program, const LegaliseContext& context);

/// Says where a preset holds on behind the end of the program on one control only.
class PresetEnds {
 public:
  PresetEnds(const Program& program, const LegaliseContext& context);
  /// The action of the source, if it is a preset. `as_it_is`: the target presets as well.
  void tell(const Statement& s, const Action& a, bool as_it_is) const;
  /// The presets that are left for a target that keeps them.
  void tell_kept(const Program& program) const;

 private:
  void say(const Statement& s, const Action& a, bool stays) const;
  const LegaliseContext& context_;
  bool source_keeps_ = false, target_keeps_ = false;
};

}  // namespace cnctrans::ir::passes
