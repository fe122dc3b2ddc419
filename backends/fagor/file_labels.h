// Block numbers of a file: the control searches a label from the start of the file, subroutines included (manual 2.6).
#pragma once

#include <optional>
#include <vector>

#include "backends/common/file_groups.h"
#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::backends::fagor {

/// A copy in which no jump can find a block of an earlier routine of its file (`files`: the routines of each file, as
/// they follow each other) that has the same number; nullopt: `program` is so.
/// A number that can't be changed because jumps of its routine are computed is an error TRN-240.
std::optional<ir::Program> with_file_labels(const ir::Program& program, const std::vector<FileGroup>& files,
                                            Diagnostics& diagnostics);

}  // namespace cnctrans::backends::fagor
