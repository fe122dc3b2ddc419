// Transfer archives: several programs in one file, each behind a header that names it and says which folder it goes to.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cnctrans::frontends::sinumerik {

/// A program of an archive: path as the control's folders are seen from outside ("SHAFT.WPD/SHAFT.MPF"; programs of the
/// common folders stand above them), and its text with its headers.
using ArchivedProgram = std::pair<std::string, std::string>;

/// In the order of the archive; empty: the text has fewer than two headers.
std::vector<ArchivedProgram> take_apart(std::string_view archive);
/// Headers are written where a program has none.
std::string put_together(const std::vector<ArchivedProgram>& programs);

}  // namespace cnctrans::frontends::sinumerik
