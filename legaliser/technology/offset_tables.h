// Which row of the tool data a D number names (equivalences 15): a row of one table for all tools, or an edge of the
// tool in force.
#pragma once

#include "ir/block.h"
#include "machine/profile.h"

namespace cnctrans::ir::passes {

/// The two machines count their offsets in different ways.
inline bool offset_tables_differ(const machine::Profile& source, const machine::Profile& target) {
  return source.policies.tool_offset != target.policies.tool_offset;
}

/// Offset 0 is no offset anywhere, and row 1 of a table is edge 1 of tool 1 by the usual order of the rows.
class OffsetNumbers {
 public:
  /// The number of the offset says something else on the target, as far as the tools selected so far tell.
  [[nodiscard]] bool differs(const ToolOffset& o) const {
    if (o.number.is(0)) return false;
    return other_tool_ || !o.number.is(1);
  }
  void follow(const ToolSelect& t) { other_tool_ = !t.name.empty() || !t.number.is(1); }

 private:
  bool other_tool_ = true;  ///< the tool selected last is not tool 1, or not known
};

}  // namespace cnctrans::ir::passes
