// Calls of routines that are not at hand: the file of names says what they leave behind and what their arguments
// become, or they are refused, one error for each routine.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/diagnostics.h"
#include "ir/program.h"
#include "translator/files/names_file.h"

namespace cnctrans::translator {

/// The calls of these become text that is not translated. What follows is looked at as if they changed nothing, so that
/// it is not blamed for them. Their places, for each routine.
std::vector<std::vector<Span>> mark_missing_calls(ir::Program& program, const std::vector<ir::RoutineName>& missing);

/// What the file answers of the routines that `program` calls and does not have.
struct Outside {
  ir::RoutineName name;
  const OutsideRoutine* says = nullptr;  ///< null: only its name
  Span first;
  std::size_t calls = 0;
};
/// `has`: the routine is at hand elsewhere. `numbers`: the target calls by number.
std::vector<Outside> outside_calls(const ir::Program& program, const Names& names, bool numbers,
                                   const std::function<bool(const ir::RoutineName&)>& has);
/// The file says enough of a routine to write its calls.
bool answered(const ir::RoutineName& name, const Names& names, bool numbers);

/// The calls in the program that will be written: arguments are assigned before them (else TRN-123); where the state
/// stays, an empty routine stands for each (ir/edit/outside.h).
void settle_outside(ir::Program& work, const std::vector<Outside>& list, Diagnostics& diagnostics);
/// The same in the program that is replayed: nothing is handed over.
void pass_over_outside(ir::Program& program, const std::vector<Outside>& list);
/// The same in the translation that is read back, where the routines have their names of the target.
void pass_over_outside(ir::Program& back, const std::vector<Outside>& list, const Names& names);

}  // namespace cnctrans::translator
