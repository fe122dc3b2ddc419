// Legalising and writing a program, a second time under assumptions where the first is refused.
#pragma once

#include <vector>

#include "backends/common/backend.h"
#include "base/diagnostics.h"
#include "legaliser/legalise.h"
#include "translator/pipeline.h"

namespace cnctrans::translator {

struct AttemptContext {
  const Dialect& to;
  const machine::Profile& source_machine;
  const machine::Profile& target_machine;
  const TranslateOptions& options;
  bool as_it_stands = false;  ///< no pass: in its own language for its own machine
  bool refused = false;       ///< by an earlier step: nothing will be written
};

struct Attempt {
  std::vector<backends::OutputFile> files;
  ir::LegaliseReport names;
  Diagnostics said;
};

/// The program as it must be for the target, written. Subprograms that nothing at hand calls start with nothing known;
/// where that refuses the program, the state of power-on is taken for granted, with a warning (TRN-460), unless the
/// option `call.uncalled_state` of the source's machine says otherwise. Where a repeated part is refused in its states
/// and not in each of them by itself, it is written again (TRN-710).
Attempt attempt_both(const AttemptContext& context, ir::Program program, const backends::WriteOptions& write);

}  // namespace cnctrans::translator
