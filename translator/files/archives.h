// Files that hold several programs for transfer, of the dialects that have them.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "translator/files/registry.h"

namespace cnctrans::translator {

/// A path below the archive, and its bytes.
using ArchivePart = std::pair<std::string, std::string>;

/// A file that can only be called, by its name.
bool is_subprogram_file(const Dialect& dialect, std::string_view path);

bool has_archives(const Dialect& dialect);
/// The programs of an archive; empty: the bytes are none.
std::vector<ArchivePart> take_apart(const Dialect& dialect, std::string_view bytes);
std::string put_together(const Dialect& dialect, const std::vector<ArchivePart>& parts);

}  // namespace cnctrans::translator
