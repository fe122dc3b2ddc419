// Random programs of plain blocks in any of the three source languages, for comparing the stream with the whole-program
// path. Each program has some habits (no block numbers, small letters, arcs by radius...) and keeps them, so that the
// same shapes of lines come again and again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cnctrans::test {

struct PlainProgram {
  std::string text;
  bool lathe = false;
};

/// The program of a seed: the same everywhere and always.
PlainProgram plain_program(std::string_view dialect, bool lathe, std::uint32_t seed);

}  // namespace cnctrans::test
