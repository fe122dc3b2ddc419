// Functions whose answer only the machine gives: its files, its variables, its tools (language reference 9.2, 9.6, 14).
// A program reads them like data: ISFILE("/_N_SPF_DIR/_N_RING_SPF") is the datum ISFILE[/_N_SPF_DIR/_N_RING_SPF].
#pragma once

#include <string_view>

namespace cnctrans::sinumerik {

struct AskedFunction {
  std::string_view name;
  unsigned arguments_min, arguments_max;
};
inline constexpr AskedFunction asked_functions[] = {
    {"ISFILE", 1, 1}, {"ISVAR", 1, 1}, {"STRINGIS", 1, 1}, {"GETT", 1, 2}, {"GETDNO", 2, 2}};

/// CAC[B,3]: the third position of axis B in the machine's table.
inline constexpr std::string_view numbered_position_datum = "CAC";

/// CIC[2]: the position of the axis two places on from the present one.
inline constexpr std::string_view stepped_position_datum = "CIC";

constexpr const AskedFunction* asked_function(std::string_view capitals) {
  for (const auto& f : asked_functions) {
    if (f.name == capitals) return &f;
  }
  return nullptr;
}

}  // namespace cnctrans::sinumerik
