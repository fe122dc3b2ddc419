#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

void know_polar_turns(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
