// The pitch of threads that join another one, for targets where each block says its own.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Writes the pitch in force into the thread blocks that have none, and leaves the start angle out of threads that join
/// another one, where the target takes it in the first only.
void write_thread_leads(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
