// What the subprogram of a modal call does, with those that it calls.
#pragma once

#include "ir/passes/call_graph.h"
#include "ir/passes/legalise.h"

namespace cnctrans::ir::passes {

/// The routine begins or ends a modal call.
bool has_modal_call(const Routine& r);
/// The called routine, or one below it, does so.
bool changes_modal_calls(const Program& program, const CallGraph& calls, const CallRoutine& call);
/// It, or one below it, defines a cycle.
bool defines_cycle(const Program& program, const CallGraph& calls, const CallRoutine& call);
/// Behind it this feed is in force when it is before it.
bool leaves_feed(const Program& program, const CallGraph& calls, const CallRoutine& call, double feed);
/// Called with arguments here and on the caller's level elsewhere: its parameters may have to be set before each call.
bool shares_level_too(const CallGraph& calls, const CallRoutine& call);

}  // namespace cnctrans::ir::passes
