// Codes of a whole file, seen before its blocks are read.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "ir/modal.h"

namespace cnctrans::sinumerik {

/// Which of these words may stand in the file, in one look at its text.
struct CodesSeen {
  bool css = false;              ///< G96, G961, G962
  bool per_rev = false;          ///< G95, G96, G97
  bool other_feed = false;       ///< G93, G94, G961, G971 and their like
  bool inch = false;             ///< G70, G700
  bool metric = false;           ///< G71, G710
  std::array<bool, 3> planes{};  ///< by ir::Plane
  explicit CodesSeen(std::string_view text) {
    for (std::size_t i = text.find_first_of("Gg"); i != std::string_view::npos; i = text.find_first_of("Gg", i + 1)) {
      const std::string_view digits = text.substr(i + 1, 2);
      css = css || digits == "96";
      const bool longer = i + 3 < text.size() && text[i + 3] >= '0' && text[i + 3] <= '9';
      per_rev = per_rev || (!longer && (digits == "95" || digits == "96" || digits == "97"));
      other_feed =
          other_feed || (digits.size() == 2 && digits[0] == '9' && (longer || digits[1] == '3' || digits[1] == '4'));
      inch = inch || digits == "70";
      metric = metric || digits == "71";
      if (digits == "17") planes[static_cast<std::size_t>(ir::Plane::xy)] = true;
      if (digits == "18") planes[static_cast<std::size_t>(ir::Plane::zx)] = true;
      if (digits == "19") planes[static_cast<std::size_t>(ir::Plane::yz)] = true;
    }
  }
};

}  // namespace cnctrans::sinumerik
