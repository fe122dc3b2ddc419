// Lines under one block-skip level right behind each other: the control carries out all of them or none.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "ir/program.h"

namespace cnctrans::ir {

/// Labels that something of the program leads to.
struct NamedLabels {
  std::set<std::pair<bool, std::string>> jumps;   ///< of jumps: control enters there
  std::set<std::pair<bool, std::string>> ranges;  ///< ends of repeated or called parts
  bool computed = false;                          ///< some are found at run time
};
NamedLabels named_labels(const Program& program);

struct SkipStretches {
  std::unordered_map<std::uint32_t, std::uint32_t> last_of;  ///< id of a first statement -> id of its last one
  std::unordered_set<std::uint32_t> inside;                  ///< the statements that stand in one
};
/// Of more than one statement. What follows the last of them in the flow is what follows when they are left out.
SkipStretches skip_stretches(const Routine& routine, const NamedLabels& named);

}  // namespace cnctrans::ir
