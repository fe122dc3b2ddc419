// Letters with marks for controls and comparisons that know the plain alphabet only.
#pragma once

#include <string>
#include <string_view>

namespace cnctrans {

/// Letters with marks become ASCII letters (umlauts with a following E), other characters beyond ASCII become '?'.
/// `text` is UTF-8 or Windows-1252. `lossy` (may be null) is set when a '?' was written.
std::string to_ascii(std::string_view text, bool* lossy);

}  // namespace cnctrans
