// What a file of names (--names) says of routines that are not at hand, beside their names.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cnctrans::translator {

struct OutsideRoutine {
  bool keeps_state = false;  ///< modal functions, frames and tool are behind it as they were before it
  /// Variables of the target that the arguments go to: of each letter, or, with an empty letter, by position.
  std::vector<std::pair<std::string, std::string>> arguments;
  bool operator==(const OutsideRoutine&) const = default;
};
using OutsideRoutines = std::map<std::string, OutsideRoutine>;  ///< by NameMap::key

}  // namespace cnctrans::translator
