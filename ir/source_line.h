// The text that a place of a program was read from.
#pragma once

#include <string>

#include "ir/program.h"

namespace cnctrans::ir {

/// The line of the source at the beginning of the span, as it stands there; empty when the program does not hold it.
std::string source_line(const Span& span, const Program& program);

}  // namespace cnctrans::ir
