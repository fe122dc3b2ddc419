// Machine data that the map of names (--names) places on the target: what stands for an input, a PLC mark or a key of
// the source is known to the shop alone.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Machine data that the map of names places on the target get the names that it gives them.
void name_given_data(Program& program, const LegaliseContext& context);
/// Stands for the routine of such a datum in the report.
inline constexpr std::string_view given_data_mark = "=";
/// Those of the source that a translation has placed, as --set names them.
std::vector<std::string> given_data(const LegaliseReport& report);

/// As --set names it: "PLCM[12]", "KEY".
std::string name_of_datum(const SystemRef& ref, const Program& program);

/// The target can name the datum, or the map of names has named it.
bool has_name(const SystemRef& ref, const LegaliseContext& context);

/// What the map gives a datum under one of its names ("PLCM12", "PLCM[12]", "PLCM[*]"); nullopt: nothing.
std::optional<std::string> name_given_to(const SystemRef& ref, const Program& program, const NameMap& names);

}  // namespace cnctrans::ir::passes
