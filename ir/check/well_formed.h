// The parts of check_well_formed. Only for the .cpp files of ir/.
#pragma once

#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::ir::detail {

/// Where faults go: they are reported on the line that is being looked at.
struct Report {
  const Program& program;
  Diagnostics& diagnostics;
  Span line;

  void error(std::string_view code, std::string message) const {
    diagnostics.error(code, line, std::move(message), "a reader or a pass of this program has a defect");
  }
};

/// An expression that must be there, and everything in it.
void check_expression(const ExprPtr& e, const Report& report);
void check_variable(const VarRef& v, const Report& report);
void check_axis(AxisId id, const Report& report);

}  // namespace cnctrans::ir::detail
