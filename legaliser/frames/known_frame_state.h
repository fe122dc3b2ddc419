// Frames as values along a program: frame variables, rows of the table of frames and base frames, as far as their
// parts are numbers.
#pragma once

#include <map>
#include <string>

#include "ir/analysis/flow_states.h"
#include "legaliser/frames/frame_constants.h"
#include "legaliser/frames/frame_state.h"

namespace cnctrans::ir::passes {

struct KnownFrames {
  bool lost = false;                            ///< nothing is known
  std::map<std::string, PlanarFrame> variable;  ///< missing: not known
  std::map<std::int32_t, PlanarFrame> row;      ///< of the table; missing: as at the start
  PlanarFrame shape;                            ///< turn, scale and mirror of the settable frame in force
  FrameState programmed;

  bool operator==(const KnownFrames&) const = default;
};

/// A domain of FlowStates.
class KnownFrameDomain {
 public:
  using State = KnownFrames;
  KnownFrameDomain(const Program& program, const LegaliseContext& context, const FactsOf& facts)
      : program_(program), machine_(context.source_machine), facts_(facts) {}

  [[nodiscard]] State start(const Routine& r, bool called) const;
  void transfer(const Statement& s, State& state) const;
  [[nodiscard]] bool touches(const Routine& r) const;
  void unknown(State& state) const { state.lost = true; }
  bool join(State& a, const State& b) const;

  // Steps of a transfer.
  void assign(const Assign::Item& item, const Statement& s, State& state) const;
  void act(const Action& a, const Statement& s, const Block& b, State& state) const;
  [[nodiscard]] FrameLookup lookup(const State& state) const;
  /// What stands between the settable shift and the tool: base frames, the rest of the settable frame, the programmable
  /// frame. `selected`: a settable frame is in force.
  [[nodiscard]] PlanarFrame inner(const State& state, bool selected) const;
  /// Base frames and the shape of the settable frame do nothing.
  [[nodiscard]] bool plain(const State& state) const;
  /// The name of a variable of frames; empty: it is none, or an index is computed.
  [[nodiscard]] std::string name_of(const VarRef& v) const;

 private:
  [[nodiscard]] PlanarFrame row_of(const State& state, std::int32_t row) const;
  [[nodiscard]] PlanarFrame base(const State& state, std::int32_t from = 0) const;
  void select(const WorkOffset& w, State& state) const;
  void assign_system(const SystemRef& ref, const std::optional<PlanarFrame>& value, const Statement& s,
                     State& state) const;

  const Program& program_;
  const machine::Profile& machine_;
  const FactsOf& facts_;
};

/// A frame with a part that is not known.
PlanarFrame unknown_frame();
/// Row of the table that a datum names; nullopt: computed.
std::optional<std::int32_t> table_row(const SystemRef& ref);
/// The statement writes or reads a frame as a value.
bool speaks_of_frames(const Statement& s, const Program& program);

}  // namespace cnctrans::ir::passes
