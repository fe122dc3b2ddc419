// Settings of the machine that a program asks for: how it was built and commissioned, the same in every run.
#pragma once

#include <map>
#include <string>

#include "base/diagnostics.h"
#include "ir/program.h"
#include "machine/profile.h"
#include "translator/files/registry.h"

namespace cnctrans::translator {

/// A setting that the program reads and never writes becomes a variable that its head sets, so that conditions keep
/// their form: to what the machine's profile says (a note, TRN-465), or to what a run takes where nobody says it (a
/// warning). Those that `placed` (the data of the map of names) answers are left.
void settings_as_variables(ir::Program& program, const Dialect& from, const machine::Profile& machine,
                           const std::map<std::string, std::string>* placed, Diagnostics& diagnostics);

}  // namespace cnctrans::translator
