// Where the tool and the pole are, as values that the target can compute: a number, or a formula in the program's
// variables. For what is no number in the dataflow because it differs from pass to pass of a loop.
#pragma once

#include <array>
#include <optional>

#include "ir/analysis/flow_states.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/frames/frame_steps.h"

namespace cnctrans::ir::passes {

/// A point of the plane: mm, radius.
struct ValuePoint {
  Value u, v;
};
/// What polar words say: where they lead, about which centre, at which distance from it.
struct PolarEnd {
  ValuePoint to, centre;
  Value radius;
};

/// A domain of FlowStates.
class PathValues {
 public:
  struct State {
    std::array<std::optional<Value>, axis::count_max> at{};  ///< in the work frame; radius
    std::optional<ValuePoint> pole;
  };
  PathValues(const FactsOf& facts, const machine::Profile& machine, const FrameSteps& frames);

  static State start(const Routine& r, bool called);
  void transfer(const Statement& s, State& state) const;
  static bool touches(const Routine& r) { return !r.body.empty(); }
  static void unknown(State& state) { state = {}; }
  static bool join(State& a, const State& b);
  /// Variables may be other ones there.
  static void crosses(const Statement& s, std::optional<std::size_t> callee, State& state);

  /// Of a block whose polar angle counts from the zero direction; `before`: what holds before it.
  [[nodiscard]] std::optional<PolarEnd> polar_end(const Statement& s, const State& before) const;
  /// The places before the statement that are numbers.
  [[nodiscard]] FrameSteps::Place numbers(const Statement& s, const State& before) const;
  /// A number from the dataflow, else the formula.
  [[nodiscard]] std::optional<Value> place(const Statement& s, const State& before, AxisId axis) const;

 private:
  using Place = std::array<std::optional<Value>, axis::count_max>;
  [[nodiscard]] Place places(const Facts& facts, const State& state) const;
  void actions(const Statement& s, State& state) const;
  void set_pole(const PoleSet& p, const Block& b, const Facts& facts, State& state) const;
  [[nodiscard]] std::optional<ValuePoint> centre(const Block& b, const Facts& facts, const State& state) const;
  [[nodiscard]] std::optional<PolarEnd> end(const Block& b, const Facts& facts, const State& state) const;
  [[nodiscard]] std::optional<Value> by_word(AxisId axis, const Block& b, const Facts& facts,
                                             const std::optional<Value>& from) const;
  void block(const Statement& s, const Block& b, State& state) const;

  const FactsOf& facts_;
  const machine::Profile& machine_;
  const FrameSteps& frames_;
  bool plane_resets_ = false, follows_arc_ = false, radius_stays_ = false, pole_stays_ = false;
};

/// Where the tool stands before the statements of a program whose frames name the slots of `machine`.
class PathStates {
 public:
  PathStates(const Program& program, const FactsOf& facts, const machine::Profile& machine,
             const LegaliseContext& context)
      : frames_(program, facts, machine, context),
        values_(facts, context.source_machine, frames_),
        states_(program, values_) {}
  [[nodiscard]] std::optional<Value> place(const Statement& s, AxisId axis) const {
    const auto* state = states_.before(s);
    return state != nullptr ? values_.place(s, *state, axis) : std::nullopt;
  }
  [[nodiscard]] std::optional<ValuePoint> pole(const Statement& s) const {
    const auto* state = states_.before(s);
    return state != nullptr ? state->pole : std::nullopt;
  }
  [[nodiscard]] std::optional<double> number(const Statement& s, AxisId axis) const {
    const auto found = place(s, axis);
    return found && found->literal() ? std::optional(found->number) : std::nullopt;
  }

 private:
  const FrameSteps frames_;
  const PathValues values_;
  const FlowStates<PathValues> states_;
};

/// The polar words of a block as coordinates and, for an arc about the pole, its centre; `fu`, `fv`: radius of one unit
/// of the words of the plane's axes.
void write_end(Block& b, const PolarEnd& end, bool arc, Plane plane, double fu, double fv);

}  // namespace cnctrans::ir::passes
