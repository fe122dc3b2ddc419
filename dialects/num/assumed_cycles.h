// G31, G63 and G66: what the manuals at hand leave open, by options of the machine profile. Reader and writer share it.
#pragma once

#include <string>
#include <string_view>

#include "base/text.h"
#include "dialects/num/options.h"

namespace cnctrans::dialects::num {

/// One number as the cycle's word of that name says it.
struct CycleHabit {
  std::string_view word;
  double value = 0;
  bool given = true;  ///< false: the cycle has no such word
};
struct CycleHabits {
  std::string_view option;    ///< the one that confirms the moves
  bool confirmed = false;     ///< the profile sets it
  CycleHabit first, second;   ///< of every block of the cycle
  std::string_view in_words;  ///< for people: the moves that are assumed
};

template <class Option>
CycleHabits thread_habits(const Option& profile_option) {
  const std::string radial = profile_option(option::chased_radial), back = profile_option(option::chased_back);
  const double axis = radial == "1+" ? 1 : radial == "1-" ? 2 : radial == "2+" ? 3 : radial == "2-" ? 4 : 0;
  return {option::chased_radial,
          !radial.empty(),
          {"radial", axis},
          {"back", back == "middle"     ? 1.0
                   : back == "reversed" ? 2.0
                                        : 0.0},
          "the tool sets the depth of each pass itself (passes as in G33), and comes back with the spindle stopped at "
          "EC, 2 mm aside"};
}

template <class Option>
CycleHabits reentrant_habits(const Option& profile_option) {
  const std::string start = profile_option(option::reentrant);
  return {option::reentrant,
          !start.empty(),
          {"variant", start == "tool" ? 1.0 : 0.0},
          {{}, 0, false},
          "X Z is the corner of a rectangular blank, before which the cycle begins; ER the withdrawal (1 mm), EA the "
          "steepest entry, EF the feed in re-entrant zones"};
}

/// `by_p`: the step is P, radial.
template <class Option>
CycleHabits plunge_habits(const Option& profile_option, bool by_p) {
  const std::string first = profile_option(option::plunged), along = profile_option(option::plunged_axis);
  const double variant = (first == "from_end" ? 1 : 0) + (profile_option(option::plunged_steps) == "whole" ? 10 : 0) +
                         (profile_option(option::plunged_back) == "feed" ? 100 : 0);
  const bool along_z = along == "z" || (along != "x" && by_p);
  return {option::plunged,
          !first.empty(),
          {"variant", variant},
          {"main_axis", along_z ? 1.0 : 0.0},
          "P steps along X and plunges along Z, R the other way round; equal steps from the place of the tool to X Z, "
          "where the second edge ends; back in rapid"};
}

}  // namespace cnctrans::dialects::num
