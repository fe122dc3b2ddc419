// Numbers of words and expressions as the target writes them.
#pragma once

#include <string>
#include <string_view>

#include "ir/value.h"

namespace cnctrans::backends {

/// How numbers look. `verbatim`: the text comes from the target's own language and is written as it is.
struct NumberFormat {
  int kept_decimals = 4;  ///< of a text of the source
  int made_decimals = 4;  ///< of a number without text
  bool verbatim = false;
};

/// Optional sign, digits with at most one point, at least one digit: readable by every control.
bool plain_number(std::string_view text);
/// Number of digits after the point.
int decimals_of(std::string_view text);

/// Appends `text` when it can be used as it stands (without '+'), else `number` rounded; never an exponent.
/// Returns the change made by rounding (0: none).
double append_number(std::string& out, double number, std::string_view text, const NumberFormat& format);

}  // namespace cnctrans::backends
