// Machining cycles of a lathe written out move by move.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "ir/cycles/machining.h"
#include "legaliser/analysis/head_constants.h"
#include "legaliser/cycles/parts/cycle_parts.h"
#include "legaliser/cycles/turning/similar_cycles.h"
#include "legaliser/cycles/turning/turning_forms.h"

namespace cnctrans::ir::passes {

/// What the text says of spindle and tool at a block; nullopt: paths may disagree.
struct TurnState {
  std::optional<SpindleState> spindle;
  std::optional<std::int32_t> tool, offset;
  std::optional<Value> x, z;  ///< the last absolute words of the two axes
  bool exact_stop = false;    ///< is surely in force
};

/// Modes as far as they are known before a block and by its own words; nullopt: units, diameters, distance or feed mode
/// are not known.
std::optional<ModalState> modes_at(const Block& b, const Facts& facts, const ModalState& power_on);
/// What words count in.
cycles::TurnUnits turn_units(const ModalState& m);
/// The parameters in mm; false: some are known only when the program runs.
bool machining_numbers(const NamedCycle& cycle, const ModalState& modes, cycles::TurnNumbers& out);

/// The machining cycles of a routine with what has to be known of the program around them, found before any pass takes
/// its statements apart.
class TurnCycles {
 public:
  TurnCycles(const Program& program, const Routine& routine, const LegaliseContext& context, const FeedsBefore& feeds);

  /// The moves as blocks; nullopt with a sentence: they can't be told here. With `values`, numbers that the head of the
  /// program gives to variables count as known, and are listed there ("P1=40, P2=3").
  [[nodiscard]] std::optional<Body> write_out(const NamedCycle& cycle, const Statement& s, const Block& b,
                                              const Facts& facts, std::string* error,
                                              std::string* values = nullptr) const;
  /// The same with words that only the run knows: expressions, and loops over the passes.
  [[nodiscard]] std::optional<Body> write_out_computed(const NamedCycle& cycle, const Statement& s, const Block& b,
                                                       const Facts& facts, Editor& editor, std::string* error) const;
  /// A cycle of the target with the same moves: the comparison of both expansions, or a rule, says so.
  [[nodiscard]] std::optional<TurnForm> native(const NamedCycle& cycle, const Statement& s, const Block& b,
                                               const Facts& facts) const;
  /// A cycle of the target that leaves the same part by other passes, when the options ask for it; nullopt with a
  /// sentence: none. `last_resort`: without being asked for too, unless they forbid the target's cycles.
  [[nodiscard]] std::optional<SimilarForm> similar(const NamedCycle& cycle, const Statement& s, const Block& b,
                                                   const FactsOf& facts, bool last_resort, std::string* why) const;
  /// Ids of the blocks that the profiles of written out cycles stand in.
  [[nodiscard]] const std::set<std::uint32_t>& profile_blocks() const { return profile_blocks_; }

 private:
  struct Site {
    TurnState state;
    std::optional<cycles::TurnProfile> profile;
    std::string fault;   ///< why there is no profile
    Body blocks;         ///< those of the profile
    bool apart = false;  ///< they stand in a row, outside of every structure
  };
  /// Takes a copy of the profile's blocks.
  void keep_profile(const Program& program, const Routine& routine, const NamedCycle& named, Site& site);
  /// The blocks of the profile from the first to the last that says an element of it.
  static Body elements_of(const Site& site, const Block& at_call, const Facts& facts);
  /// `blocks` as the target's cycle is to read them; nullopt with a sentence: it can't.
  [[nodiscard]] std::optional<ProfileUse> use_of(const NamedCycle& named, const Site& site, const Body& blocks,
                                                 const FactsOf& facts, std::optional<double> tail, bool face,
                                                 std::string* why) const;
  /// Width of the tool in mm, the program's `unit` being that many mm; 0: not known.
  [[nodiscard]] double nose_width(const TurnState& state, double unit) const;
  const LegaliseContext& context_;
  const FeedsBefore& feeds_;
  const Program& program_;
  const Routine& routine_;
  HeadConstants constants_;
  std::map<std::string, std::optional<double>> written_;  ///< machine data
  std::map<std::uint32_t, Site> sites_;                   ///< by id
  std::set<std::uint32_t> profile_blocks_;
};

/// Blocks of profiles that nothing runs become comments: on the target no cycle reads them any more. A routine of which
/// nothing else is left, and which nothing runs, is taken out; `uses`: some stand in the program as copies.
void retire_profiles(Program& program, const std::set<std::uint32_t>& blocks, const std::vector<ProfileUse>& uses,
                     const FactsOf& facts);

}  // namespace cnctrans::ir::passes
