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

inline CycleHabits thread_habits(const Options& options) {
  const std::string& radial = options.chased_radial;
  const double axis = radial == "1+" ? 1 : radial == "1-" ? 2 : radial == "2+" ? 3 : radial == "2-" ? 4 : 0;
  return {"num.g31",
          !radial.empty(),
          {"radial", axis},
          {"back", static_cast<double>(options.chased_back)},
          "the tool sets the depth of each pass itself (passes as in G33), and comes back with the spindle stopped at "
          "EC, 2 mm aside"};
}

inline CycleHabits reentrant_habits(const Options& options) {
  const std::string& start = options.reentrant;
  return {"num.g63",
          !start.empty(),
          {"variant", start == "tool" ? 1.0 : 0.0},
          {{}, 0, false},
          "X Z is the corner of a rectangular blank, before which the cycle begins; ER the withdrawal (1 mm), EA the "
          "steepest entry, EF the feed in re-entrant zones"};
}

/// `by_p`: the step is P, radial.
inline CycleHabits plunge_habits(const Options& options, bool by_p) {
  const double variant = (options.plunged == "from_end" ? 1 : 0) +
                         (options.plunged_steps == PlungeSteps::whole ? 10 : 0) +
                         (options.plunged_back == PlungeBack::feed ? 100 : 0);
  const bool along_z = options.plunged_axis == PlungeAxis::z || (options.plunged_axis == PlungeAxis::by_step && by_p);
  return {"num.g66",
          !options.plunged.empty(),
          {"variant", variant},
          {"main_axis", along_z ? 1.0 : 0.0},
          "P steps along X and plunges along Z, R the other way round; equal steps from the place of the tool to X Z, "
          "where the second edge ends; back in rapid"};
}

}  // namespace cnctrans::dialects::num
