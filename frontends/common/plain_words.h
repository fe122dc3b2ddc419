// The words that every control of the house reads alike.
#pragma once

#include "frontends/common/frontend.h"

namespace cnctrans::frontends {

/// X Y Z, I J K, the radius R of an arc, F and N in millimetres or inches with at most `places` digits behind the
/// point. A feed of 0 has meanings of its own; rotary words are looked at one by one, where their sign may be a
/// direction.
inline PlainWords usual_plain_words(std::uint8_t places, std::uint32_t last_block = 99'999'999) {
  PlainWords words;
  const auto rule = [&words](char c) -> FreeNumber& { return words.numbers[static_cast<std::size_t>(c - 'A')]; };
  for (const char c : {'X', 'Y', 'Z', 'I', 'J', 'K'})
    rule(c) = {.free = true, .minus = true, .zero = true, .whole = 5, .places = places};
  rule('R') = {.free = true, .whole = 5, .places = places};
  rule('F') = {.free = true, .whole = 5, .places = places};
  rule('N') = {.free = true, .zero = true, .whole = 8, .most = last_block};
  return words;
}

}  // namespace cnctrans::frontends
