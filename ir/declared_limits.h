// What the text of a declared type says beside the type: the length of a text, the limits of a number.
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>

namespace cnctrans::ir {

/// `low` and `high` are in the units of the variable, both ends allowed.
struct DeclaredLimits {
  std::size_t length = std::numeric_limits<std::size_t>::max();  ///< characters of a text
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  /// What a variable without an initial value starts with: the value next to zero that is allowed.
  [[nodiscard]] double start() const { return low > 0 ? low : high < 0 ? high : 0; }
};

/// Reads Declare::type_text and Parameter::type_text: "STRING[20]", "REAL LLI 0 ULI 10" (language reference 3.3). What
/// is not a length or a limit is passed over; a limit that is not a plain number is none.
DeclaredLimits declared_limits(std::string_view type_text);

}  // namespace cnctrans::ir
