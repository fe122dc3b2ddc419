// What drilling and milling cycles have in common: arguments by name, planes and depth (reference-language 18).
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dialects/sinumerik/cycles.h"
#include "dialects/sinumerik/milling.h"
#include "frontends/sinumerik/state/context.h"
#include "ir/cycle.h"

namespace cnctrans::sinumerik {

/// The arguments of a call by name. An omitted one is 0.
class Arguments {
 public:
  Arguments(const CycleRow& row, std::vector<ir::Value> values, std::vector<bool> given)
      : row_(row), values_(std::move(values)), given_(std::move(given)) {}

  [[nodiscard]] bool given(std::string_view name) const {
    const int i = parameter_index(row_, name);
    return i >= 0 && static_cast<std::size_t>(i) < given_.size() && given_[static_cast<std::size_t>(i)];
  }
  /// The call has a place for it.
  [[nodiscard]] bool knows(std::string_view name) const { return parameter_index(row_, name) >= 0; }
  [[nodiscard]] ir::Value get(std::string_view name) const {
    return given(name) ? values_[static_cast<std::size_t>(parameter_index(row_, name))] : ir::Value(0);
  }
  /// Given, and not the literal 0 (which says the same as nothing).
  [[nodiscard]] bool says(std::string_view name) const { return given(name) && !get(name).is(0); }

 private:
  const CycleRow& row_;
  std::vector<ir::Value> values_;
  std::vector<bool> given_;
};

/// The parameter that comes next names a table of pitches, or the thread in it.
inline bool names_a_table(const CycleRow& row, std::size_t next) {
  return static_cast<int>(next) == parameter_index(row, "PTAB") ||
         static_cast<int>(next) == parameter_index(row, "PTABA");
}

ir::Level level(ir::Value value, ir::LevelBase base);
ir::Value absolute_value(const ir::Value& v);
/// Safety plane and depth. They lie below the retract plane, as they should, unless numbers say otherwise.
void planes(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos);
/// Warns where the planes, as numbers, contradict each other (SIN-070, SIN-071).
void check_planes(const ir::HoleCycle& hole, FileContext& c, WordPos pos);
/// The final depth where DP is an amount: from the reference plane away from the retract plane.
ir::Level depth_by_amount(const Arguments& a);
/// What holds where neither the maker's manual nor the profile says how a cycle works (SIN-120 and on).
void warn_of_assumptions(const std::string& name, FileContext& c, WordPos pos);
/// A contour as a cycle names it: a subprogram, or two labels with a colon between them.
void contour_words(const std::string& text, std::vector<std::pair<std::string, ir::Value>>& words);
/// The contour of a milling cycle that works along one; false: an error has been reported.
bool milling_contour(const MillingCycle& cycle, const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos);
/// Shape and words of a milling cycle (18.3); false: an error has been reported.
bool milling_words(const MillingCycle& cycle, const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos);

}  // namespace cnctrans::sinumerik
