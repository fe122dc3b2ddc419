// CALL LBL QS5, GOTO LBL QS5: the label that a text names.
#pragma once

#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

/// Items get their label where all ways bring the same text. `last`: the others are refused.
void find_text_labels(Lowering& lowering, bool last);

}  // namespace cnctrans::frontends::heidenhain
