// The languages of a call's programs, where the command line does not name them.
#pragma once

#include "cli/commands.h"

namespace cnctrans::cli {

/// Reads standard input when a program is called `-`. False, and why is said: it can't be.
bool read_standard_input(Arguments& a);
/// Sets `wanted` (of --from, say) to the language of the programs `first` to `last` where it is empty, and says so.
/// False, and why is said: it can't be told.
bool find_language(const Arguments& a, std::string& wanted, const char* option, std::size_t first, std::size_t last);

}  // namespace cnctrans::cli
