// APPR and DEP (reference 6): the ways onto a contour and off it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cnctrans::dialects::heidenhain {

enum class LeadForm : std::uint8_t {
  tangent_line,  ///< LT: along the first or last element
  normal_line,   ///< LN: at right angles to it
  tangent_arc,   ///< CT: an arc that touches it
  line_arc       ///< LCT: a line, and an arc that touches both
};
struct LeadRow {
  std::string_view word;
  LeadForm form;
  bool polar;    ///< the point is given by PR and PA
  bool departs;  ///< stands behind DEP too
};
inline constexpr std::array leads{
    LeadRow{"LT", LeadForm::tangent_line, false, true},  LeadRow{"LN", LeadForm::normal_line, false, true},
    LeadRow{"CT", LeadForm::tangent_arc, false, true},   LeadRow{"LCT", LeadForm::line_arc, false, true},
    LeadRow{"PLT", LeadForm::tangent_line, true, false}, LeadRow{"PLN", LeadForm::normal_line, true, false},
    LeadRow{"PCT", LeadForm::tangent_arc, true, false},  LeadRow{"PLCT", LeadForm::line_arc, true, true},
};
constexpr const LeadRow* find_lead(std::string_view word) {
  for (const auto& row : leads) {
    if (row.word == word) return &row;
  }
  return nullptr;
}

}  // namespace cnctrans::dialects::heidenhain
