// Machine data that a program writes.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "ir/program.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// "NOSEW[4]"; an index that is computed is `*`.
std::string datum_name(const SystemRef& ref);

/// Every datum the program writes, with the one number it writes; nullopt: not one fixed number, or a length (option
/// machine_data.lengths) that may count in inches.
std::map<std::string, std::optional<double>> written_data(const Program& program, const machine::Profile& source);

/// Data whose only use is a cycle of the source: the width of a grooving tool.
bool left_out(const SystemRef& ref);
/// Takes out what writes them where the target lacks them (TRN-453). For after the cycles are written out.
void leave_out_data(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
