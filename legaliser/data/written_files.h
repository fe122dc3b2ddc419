// Lines that a program writes into a program of the control.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// For a target that names the file in every line (machine option file.lines): the file opened last is named, and what
/// opening does to it is said by itself. The other targets refuse such statements.
void name_written_files(Program& program, const LegaliseContext& context);

/// The variable that takes the outcome of such a statement on the target.
inline constexpr std::string_view file_outcome = "_WERR";

}  // namespace cnctrans::ir::passes
