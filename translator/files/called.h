// What a program calls by a fixed name, and the files that have it.
#pragma once

#include <vector>

#include "base/diagnostics.h"
#include "ir/program.h"
#include "translator/files/loader.h"

namespace cnctrans::translator {

/// Names of routines that statements of `program` call by a fixed name, as often as they do.
void collect_calls(const ir::Program& program, std::vector<ir::RoutineName>& out);

/// Takes the routines of every library file that is reached into `program`, so that they are translated with it. A file
/// that names other spaces than the program is an error (TRN-090). The statements are numbered again.
void join_libraries(ir::Program& program, Loader& loader, Diagnostics& diagnostics);

}  // namespace cnctrans::translator
