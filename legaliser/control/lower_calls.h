// The two halves of the call-frame pass, and what they share.
#pragma once

#include <utility>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

bool has_numbered_levels(const std::vector<VariableSpace>& spaces);
bool has_named_locals(const std::vector<VariableSpace>& spaces);

/// Local parameters by level become named variables of a routine with formal parameters, or global variables.
void lower_levels(Program& program, const LegaliseContext& context, const CallGraph& calls);
/// Named variables of a routine and its formal parameters become local parameters by letter, or global variables.
void lower_named_locals(Program& program, const LegaliseContext& context, const CallGraph& calls);

/// Assignments that together do what happens at once: none reads a target that an earlier one has written.
Body assign_in_parallel(Program& program, const LineInfo& like, std::vector<std::pair<VarRef, ExprPtr>> items);
/// Puts `before` in front of the call and `behind` after it; labels stay with the first piece.
void surround(Body& out, Body&& before, Statement&& call, Body&& behind);
VarRef frame_variable(Program& program, const std::string& name, const Routine& owner);
/// `DEF REAL a, b` at the top of the routine.
void declare_at_top(Routine& routine, Type type, SpaceId space, const std::vector<std::string>& names);

}  // namespace cnctrans::ir::passes
