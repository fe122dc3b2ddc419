// Labels of the blocks that another program calls (equivalences 20.4).
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// The target names the two ends of a called part by texts in variables, and calls it once (CALL .. BLOCK .. TO ..).
bool names_parts_by_texts(const Capabilities& target);

/// Called parts of other programs get variables of texts for their two labels. A label that is known neither as a block
/// of the called program nor as a text is refused.
void name_called_labels(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
