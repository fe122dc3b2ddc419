// A last look at what was written: the reader of the target takes every block, or the translation is refused.
#pragma once

#include "translator/pipeline.h"

namespace cnctrans::translator {

/// Reads the outputs as the target's control does. Each block that its reader refuses becomes an error at the line of
/// the source that it stands for (TRN-401). Nothing for a target that nothing here reads.
void check_written(TranslateResult& result, const Dialect& to, const machine::Profile& target_profile);

}  // namespace cnctrans::translator
