// Legalisation: rewrites a program until a target can say it, in a fixed order, each pass small and testable alone. A
// pass that cannot keep the meaning reports and leaves an Opaque statement; it never guesses.
#pragma once

#include <cstdint>
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
};

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
};

/// Runs all passes in order. False when an error was reported.
bool legalise(Program& program, const LegaliseContext& context);

/// Names of the passes in order, for `cnctrans ir --passes` and tests; run one by name.
std::vector<std::string_view> pass_names();
bool run_pass(std::string_view name, Program& program, const LegaliseContext& context);

/// The passes that look at one block and the modal state before it only (for streams), in order.
std::vector<std::string_view> block_local_passes();

/// For streams: true when no pass would touch this block (plain motion in forms the target has). Cheap: no allocation.
/// Without the target's machine a block that moves and switches something besides is not plain.
bool plain_legal(const Block& block, const Capabilities& target, const machine::Profile* machine = nullptr);

}  // namespace cnctrans::ir
