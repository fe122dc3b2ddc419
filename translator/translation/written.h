// A last look at what was written: the reader of the target takes every block, or the translation is refused.
#pragma once

#include <vector>

#include "base/diagnostics.h"
#include "ir/program.h"
#include "machine/profile.h"
#include "translator/files/loader.h"
#include "translator/files/registry.h"
#include "translator/pipeline.h"

namespace cnctrans::translator {

/// The outputs as the target's control reads them: read once, for the last look and for the verification.
struct ReadBack {
  Loader loader;            ///< its files are the outputs in their order, from 1 on
  ir::Program program;      ///< all outputs as one program; the first holds the main program
  Diagnostics diagnostics;  ///< of the reader
};

/// Reads the outputs, for a target that can be read (readable.h). `definitions`: the loader of the source where both
/// are of one language and share the names that files of the machine define; else null.
ReadBack read_back(const std::vector<OutputText>& outputs, const Dialect& to, const machine::Profile& target_profile,
                   Loader* definitions);

/// Each block that the reader refused becomes an error of `said` at the line of the source that it stands for
/// (TRN-401).
void check_written(const std::vector<OutputText>& outputs, const ReadBack& back, Diagnostics& said);

}  // namespace cnctrans::translator
