// Messages on controls with smaller character sets and shorter lines.
#pragma once

#include <string_view>

namespace cnctrans::verifier {

/// The same letters and digits. The translation's may end early, behind so many as every control shows, and may have a
/// '?' for a value that the control can't show inside of a text.
bool same_message(std::string_view source, std::string_view target);

}  // namespace cnctrans::verifier
