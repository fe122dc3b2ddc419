// Legalisation: rewrites a program until a target can say it, in a fixed order, each pass small and testable alone. A
// pass that cannot keep the meaning reports and leaves an Opaque statement; it never guesses.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "ir/analysis/uncalled.h"
#include "ir/program.h"
#include "legaliser/capabilities.h"
#include "legaliser/name_map.h"
#include "machine/profile.h"

namespace cnctrans::ir {

namespace passes {
class SeenFacts;
}  // namespace passes

enum class CycleWriting : std::uint8_t {
  native,  ///< the target's own where it leaves the same part; where its passes differ, with a warning
  exact,   ///< the target's own where it makes the same moves, else the moves
  explode  ///< the moves
};
struct LegaliseOptions {
  CycleWriting cycles = CycleWriting::native;
  bool raise_structure = false;  ///< jumps become structures where that is provably the same
  bool goes_on = false;          ///< the translation is written although blocks are refused: they are left out
  bool cycle_remarks = true;     ///< above the moves that a cycle becomes stand its words in the source, as a comment
  Uncalled uncalled = Uncalled::unknown;  ///< what is taken to hold where a subprogram that nothing calls begins
  std::string_view only;                  ///< this pass alone; empty: all
};

/// Gets the program behind each pass.
using BehindPass = std::function<void(std::string_view pass, const Program& program)>;

/// What became of a name of the source, for the head comment and the report.
struct Renamed {
  enum class Kind : std::uint8_t { variable, label, routine } kind = Kind::variable;
  std::string from, to;
  std::string routine;  ///< of a label or a local variable; empty: whole program
};
struct LegaliseReport {
  std::vector<Renamed> renamed;
  NameMap names;  ///< numbers that this translation chose or was given
};

struct LegaliseContext {
  const Capabilities& target;
  const machine::Profile& source_machine;
  const machine::Profile& target_machine;
  LegaliseOptions options;
  Diagnostics& diagnostics;
  LegaliseReport* report = nullptr;  ///< may be null
  /// Texts of the block numbers that the source has (their first characters); null: all numbers are the source's.
  const std::set<const char*>* source_numbers = nullptr;
  const NameMap* names = nullptr;  ///< names that are given; may be null
  BehindPass behind_pass = {};     ///< may be empty
  /// What a run of the source has seen, where the program has no other; null: only what its text says.
  const passes::SeenFacts* seen = nullptr;
};

/// Runs all passes in order. False when an error was reported.
bool legalise(Program& program, const LegaliseContext& context);

/// A pass of the table (pipeline/pipeline.h) has this name.
bool is_pass(std::string_view name);
/// Runs one pass of the table.
bool run_pass(std::string_view name, Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir
