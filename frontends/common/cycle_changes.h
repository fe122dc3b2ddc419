// Blocks that change single words of the hole cycle in force. The reader joins such a block with the cycle above it in
// the text; the flow of the program decides whether that was right.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::frontends {

enum class ChangeFault : std::uint8_t {
  outside,  ///< a program of another file may have set the cycle in force
  another,  ///< another cycle than the one above is in force, or which one depends on the way
  stale     ///< a word that the block leaves alone reads a variable that has changed since the cycle was defined
};
struct ChangeFinding {
  const ir::Statement* statement = nullptr;
  ChangeFault fault = ChangeFault::another;
};

/// The changes of `program` whose joining was wrong, in text order (numbers the statements). `is_change`: the action,
/// which defines a modal hole cycle, changes one. `joined`: line of a change -> line of the cycle that it was joined
/// with; not named: the one above it in its routine.
std::vector<ChangeFinding> judge_changes(ir::Program& program, const ir::ModalState& power_on,
                                         const std::function<bool(const ir::Action&)>& is_change,
                                         const std::map<std::uint32_t, std::uint32_t>& joined = {});

/// The findings as errors of one code; `outside` is a warning.
void report_changes(const std::vector<ChangeFinding>& findings, std::string_view code, Diagnostics& diagnostics);

}  // namespace cnctrans::frontends
