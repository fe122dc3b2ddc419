// The number behind a word, where the text settles it.
#pragma once

#include <optional>

#include "ir/value.h"

namespace cnctrans::ir {

/// A literal, or an expression of constants.
inline std::optional<double> known_number(const Value& v) {
  return v.literal() ? std::optional(v.number) : constant_value(v.expr);
}
/// The value without the way its number is written in the source.
inline Value without_text(Value v) {
  v.text = {};
  return v;
}
/// A leg of polar words: wave(angle), a sine or a cosine, times the radius; exact at the quarters.
Value polar_leg(const Value& r, const Value& angle, Function wave);

}  // namespace cnctrans::ir
