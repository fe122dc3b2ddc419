// E parameters that stand for neutral machine data (reference 14.3).
#pragma once

#include <optional>

#include "legaliser/capabilities.h"

namespace cnctrans::backends::num {

/// The E parameter of a datum in its unit, or, with `symbols`, the symbol; nullopt: none, or its number in the table is
/// computed.
std::optional<ir::DataForm> data_form(const ir::SystemRef& ref, bool lathe, bool symbols);
/// OM - PREF - DEC1 - DEC3 - G59 (reference 8.1): where the axis stands in the program's coordinates.
ir::ExprPtr work_position(ir::AxisId axis);
/// `E` and five digits, or one of the symbols of what is in force.
bool is_parameter_name(std::string_view text);

}  // namespace cnctrans::backends::num
