// Arguments that the source takes once, at the call, and that a target would compute again: kept in variables where
// what they are computed from may change meanwhile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

#include "ir/analysis/call_graph.h"

namespace cnctrans::ir::passes {

/// The routine and all that it calls, as far as they are at hand.
std::set<std::size_t> reached_from(const CallGraph& calls, std::size_t routine);

/// What the statements of a program write, and where.
class Writes {
 public:
  struct Write {
    std::size_t routine = 0;
    std::uint32_t at = 0;  ///< id of the statement
    VarRef variable;
  };
  explicit Writes(const Program& program);
  [[nodiscard]] const std::vector<Write>& all() const { return list_; }
  /// A statement of these routines may change what `value`, as `reader` computes it, is computed from. Data of the
  /// machine may always change.
  [[nodiscard]] bool may_change(const ExprPtr& value, std::size_t reader, const std::set<std::size_t>& routines) const;
  /// The write may change what `value` is computed from.
  [[nodiscard]] bool touches(const Write& w, const ExprPtr& value, std::size_t reader) const;
  /// It reads data of the machine (positions, times).
  [[nodiscard]] static bool reads_machine(const ExprPtr& value);

 private:
  const Program& program_;
  std::vector<Write> list_;
};

/// Gives the value a variable of its own ("K3@`what`"); `before` gets the assignment.
ExprPtr kept(Program& program, const LineInfo& like, const ExprPtr& value, std::string_view what, int& count,
             Body& before);

}  // namespace cnctrans::ir::passes
