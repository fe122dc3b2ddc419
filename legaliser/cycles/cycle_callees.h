// What the routines of a program hand to each other of their cycles.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "legaliser/cycles/parts/spindle_ways.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Every call has variables of its own there.
bool local_variable(const Program& program, const VarRef& v);

/// Routines that are called while a cycle is active whose points lie in them: a copy for each cycle.
struct CycleCallees {
  struct Copy {
    std::size_t original = 0;
    CyclePtr source, native;
    bool on_target = false, maybe_on_target = false, single = false;  ///< before the call
    Routine routine;
    bool finished = false;
    std::optional<double> height_after;
    bool on_target_after = false, maybe_on_target_after = false, ended_after = false, left_height = false;
  };
  std::vector<std::unique_ptr<Copy>> copies;
  int made = 0;
  std::optional<SpindleWays> spindle;  ///< of the source
  /// Definitions whose cycle goes on behind the end of their routine, or past its own end on some way, and the target
  /// has none in force there.
  std::set<std::uint32_t> left_off;
  std::set<std::uint32_t> bound_taps;  ///< definitions of taps whose pitch a new F or S would change
  /// Blocks with F or S under a cycle that another routine has defined.
  std::vector<std::pair<Span, std::uint32_t>> feeds;
  std::set<std::size_t> entered;  ///< routines that are called while a cycle of another routine may be in force
  /// Blocks of a routine that are no points, where a modal call runs all the same.
  std::vector<std::pair<std::size_t, Span>> disturbed;
  /// A point of a cycle that another routine may have left in force, and its definition as in Facts::cycle_from.
  struct Point {
    std::size_t routine = 0;  ///< beyond the last one: a copy
    Span where;
    std::uint32_t from = 0;
  };
  std::vector<Point> points;
};
/// What goes wrong with cycles that another routine has defined (TRN-330, TRN-331).
void refuse_foreign_cycles(const CycleCallees& callees, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
