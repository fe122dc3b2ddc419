// Which routines of a program share a file of the target.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "backends/common/backend.h"
#include "ir/program.h"

namespace cnctrans::backends {

struct FileGroup {
  std::vector<std::size_t> routines;  ///< indices, in the given order
  std::string stem;                   ///< of the source file; empty for the first group
};

/// The source's order; of another language: subroutines in the order of their first call, then those nobody calls.
/// Indices of routines, as they follow each other in the file.
std::vector<std::size_t> file_order(const ir::Program& program, bool same_language);

/// `order` (indices of routines) by their source files: the main file first. One group with everything unless
/// `options.files_apart`.
std::vector<FileGroup> file_groups(const ir::Program& program, const std::vector<std::size_t>& order,
                                   const WriteOptions& options);

}  // namespace cnctrans::backends
