// Presets of the zero point while axes are mirrored. In the IR a preset says what the present point is in the
// coordinates in force, mirror included. Where a control sets the origin as if nothing were mirrored, the same word
// names the opposite coordinate: the word changes its sign, and done a second time it is as it was, which is how a
// program is written.
#pragma once

#include <functional>

#include "ir/program.h"

namespace cnctrans::ir::passes {

using TellPreset = std::function<void(const Statement&)>;

/// Changes the words of mirrored axes and tells `done`; `unsure` is told of a preset of an axis that is mirrored on one
/// way and not on another, which stays as it is. Ids are given anew (number_statements) where the program has both.
/// False: it has not.
bool presets_past_mirrors(Program& program, const TellPreset& unsure, const TellPreset& done);

}  // namespace cnctrans::ir::passes
