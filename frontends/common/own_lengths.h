// Lengths that a control adds to a cycle by itself: millimetres, whatever unit the program has chosen.
#pragma once

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::frontends {

/// In mm; 0: the control has none.
struct OwnLengths {
  double reapproach = 0;     ///< above the last peck
  double clearance = 0;      ///< by which the tip is freed from the bore
  double above_surface = 0;  ///< of a pocket
};

/// The reader has written them in the unit of the text above. Where the flow of the program has the other unit they
/// are brought into that; where it has both, the block is refused (TRN-590).
void settle_own_lengths(ir::Program& program, const ir::ModalState& power_on, const OwnLengths& own,
                        Diagnostics& diagnostics);

}  // namespace cnctrans::frontends
