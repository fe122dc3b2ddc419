// Bytes that no part program has: a line with one is refused before a grammar is asked, so that a file of machine code
// is through at the speed of text.
#pragma once

#include <cstddef>
#include <string_view>

namespace cnctrans::frontends {

/// Place (from 0) of the first control byte, other than a tab, outside of comments and texts; npos when there is none.
/// `to_end`: marks that begin a text to the end of the line. `open`, `close`: marks around a text.
std::size_t find_control_byte(std::string_view line, char to_end, char open, char close);

}  // namespace cnctrans::frontends
