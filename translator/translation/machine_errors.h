// Data that correct the errors of the one machine that a program was written for.
#pragma once

#include "ir/program.h"
#include "translator/files/registry.h"

namespace cnctrans::translator {

/// What sets such a datum becomes a text, which the writer leaves out with a warning (TRN-220). One that the program
/// reads anywhere stays a datum.
void keep_with_the_machine(ir::Program& program, const Dialect& from);

}  // namespace cnctrans::translator
