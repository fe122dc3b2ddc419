// Names that a machine defines for all its programs, where no file at hand defines them and the program gives them
// values.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "ir/program.h"
#include "translator/files/registry.h"

namespace cnctrans::translator {

/// The space of global numbers under names; nullopt: the language has none.
std::optional<ir::SpaceId> global_numbers(const ir::Program& program);
/// Index of the routine whose head a run comes to first: the main program, else the first one.
std::size_t head_routine(const ir::Program& program);
/// The map of names places this datum, or an element of it: "DATUM", "DATUM[3]".
bool answered(const std::string& name, const std::map<std::string, std::string>* placed);
/// They become global variables of the program (a warning each, TRN-464), an array with the size that its written
/// indices need. Left as they are: names that are only read, or only set without an index or `_` (axes, macros), arrays
/// with a computed index, and those that `placed` (the data of the map of names) answers.
void define_given_names(ir::Program& program, const Dialect& from, const std::map<std::string, std::string>* placed,
                        Diagnostics& diagnostics);

}  // namespace cnctrans::translator
