// Parameters by reference that can't be copied in and out: arrays, and variables that the subprogram also sees by
// another name. They stand for the caller's variable itself where all calls hand over one.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

/// A space of named variables, one set for each run of a routine.
bool is_routine_space(const Program& program, SpaceId space);

class HandedVariables {
 public:
  /// Where the calls hand over different variables: an error (TRN-461, TRN-520) at the head of the routine.
  HandedVariables(const Program& program, const LegaliseContext& context, const CallGraph& calls);

  using From = std::pair<std::size_t, VarRef>;  ///< the routine that hands it over, and its variable
  [[nodiscard]] const std::map<std::string, From>& of(std::size_t routine) const { return handed_[routine]; }
  /// The routine's variable is what some parameter stands for.
  [[nodiscard]] bool hands_on(std::size_t routine, const std::string& variable) const {
    return sources_.count({routine, variable}) != 0;
  }

 private:
  void look_at(std::size_t r, const LegaliseContext& context);
  [[nodiscard]] bool seen_twice(const CallSite& site, std::size_t i) const;
  [[nodiscard]] bool one_variable(std::size_t r, std::size_t i, bool array, From& from) const;
  void note_names(std::size_t r);

  const Program& program_;
  const CallGraph& calls_;
  std::vector<std::set<std::string>> declared_;
  std::vector<std::vector<VarRef>> mentions_;  ///< every variable that a routine reads or writes
  std::vector<std::map<std::string, From>> handed_;
  std::set<std::pair<std::size_t, std::string>> sources_;
};

}  // namespace cnctrans::ir::passes
