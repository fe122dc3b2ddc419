// Statements that the reader computes: their results are expressions of the values handed over (language reference 9,
// motion reference 15.2 and 19.4). In the language itself they are written as they stood.
#pragma once

#include <string_view>

namespace cnctrans::sinumerik {

inline constexpr std::string_view computed_functions[] = {
    "CALCDAT(", "CTAB(",    "CTABINV(",  "CTABTSV(",  "CTABTEV(",   "CTABTSP(",   "CTABTEP(",
    "CTABSSV(", "CTABSEV(", "CTABTMIN",  "CTABTMAX",  "CTABEXISTS", "CTABPERIOD", "MEAFRAME(",
    "SPI(",     "DELDL",    "ADDFRAME(", "INTERSEC(", "DO $R"};

/// True for the text of an assignment (capitals, without blanks) whose value the reader has computed.
constexpr bool is_computed_text(std::string_view capitals) {
  for (const auto& name : computed_functions) {
    if (capitals.find(name) != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace cnctrans::sinumerik
