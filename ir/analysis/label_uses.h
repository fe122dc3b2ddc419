// Which labels of a routine are asked for.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <utility>

#include "ir/edit/rewrite.h"

namespace cnctrans::ir::passes {

/// Where a label of a routine is asked for.
struct LabelUses {
  std::set<std::pair<bool, std::string>> targets;  ///< jumps, starts of ranges
  std::set<std::pair<bool, std::string>> ends;     ///< ends of ranges
  bool computed = false;                           ///< some target is found at run time: any number may be one
  bool computed_name = false;                      ///< found by a text: any name may be one as well
  [[nodiscard]] bool is_target(const LabelRef& l) const;
  [[nodiscard]] bool is_end(const LabelRef& l) const { return ends.count({l.is_number, l.text}) != 0; }
};
/// Uses in `routine` itself, and of ranges of it that other routines run.
LabelUses label_uses(const Program& program, const Routine& routine);
/// Calls `visit` for every fixed or computed label reference of the statement.
void each_label_ref(Statement& s, const std::function<void(LabelRef&, bool is_end)>& visit);

}  // namespace cnctrans::ir::passes
