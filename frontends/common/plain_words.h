// The words that every control of the house reads alike.
#pragma once

#include "frontends/common/frontend.h"

namespace cnctrans::frontends {

/// X Y Z, I J K, the radius R of an arc, F and N in millimetres or inches with at most `places` digits behind the
/// point, rotary words below a full turn, of which the sign may be a direction. A feed of 0 has meanings of its own.
inline PlainWords usual_plain_words(std::uint8_t places, std::uint32_t last_block = 99'999'999) {
  PlainWords words;
  const auto rule = [&words](char c) -> FreeNumber& { return words.numbers[static_cast<std::size_t>(c - 'A')]; };
  for (const char c : {'X', 'Y', 'Z', 'I', 'J', 'K'})
    rule(c) = {.free = true, .minus = true, .zero = true, .whole = 5, .places = places};
  for (const char c : {'A', 'B', 'C'}) {
    rule(c) = {.free = true, .minus = true, .zero = true, .sign_told = true, .whole = 3, .places = places, .most = 359};
  }
  rule('R') = {.free = true, .whole = 5, .places = places};
  rule('F') = {.free = true, .whole = 5, .places = places};
  rule('N') = {.free = true, .zero = true, .whole = 8, .most = last_block};
  words.increments = "G91";
  words.places = "G90";
  return words;
}

}  // namespace cnctrans::frontends
