// Names that the machine defines for every program: the files that define them, and their place in a program.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "ir/program.h"
#include "translator/files/registry.h"

namespace cnctrans::translator {

/// Paths of the definition files in the libraries, in the order of their names. A library may be such a file itself.
std::vector<std::string> definition_files(const Dialect& dialect, const std::vector<std::string>& libraries);

/// Puts the definitions of the names that the program uses at the head of its main program (of its first routine when
/// it has none), with the value that one starts with where the program reads it before it writes it: a warning
/// (TRN-463), since the machine keeps the value of an earlier program. `all`: also names that only called programs of
/// other files may use. The statements are numbered again.
void declare_names(ir::Program& program, const std::vector<const ir::Program*>& definitions, bool all,
                   Diagnostics& diagnostics);

}  // namespace cnctrans::translator
