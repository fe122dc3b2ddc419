// The programmable frame along a routine, slot by slot, as far as it is known.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "legaliser/analysis/facts.h"
#include "legaliser/analysis/words.h"
#include "legaliser/frames/planar_frame.h"

namespace cnctrans::ir::passes {

/// What a program ever puts into a slot: the rest of it stays neutral whatever is not known.
struct SlotUse {
  std::uint32_t axes = 0;  ///< bit n: axis n may have a shift
  bool turns = false, scales = false, mirrors = false;
};
constexpr std::size_t frame_slots = 6;
using SlotUses = std::array<SlotUse, frame_slots>;

class FrameState {
 public:
  [[nodiscard]] PlanarFrame slot(FrameSlot s) const;
  /// All slots as the machine applies them, outermost first; `preset`: with the slot of the preset.
  [[nodiscard]] PlanarFrame whole(const machine::Profile& machine, bool preset = true) const;
  [[nodiscard]] bool neutral() const;
  void apply(const FrameChange& c, const Facts& facts, const Block& b, const machine::Profile& machine);
  /// A settable offset is selected or off: on some machines the preset goes with it.
  void select(const WorkOffset& w, const machine::Profile& machine);
  /// The work offsets are off, on some way, and the preset with them.
  [[nodiscard]] bool preset_waits() const { return preset_off_ || preset_unsure_; }
  /// The words of the shifts are in another unit, or their X words count otherwise, after this block.
  void follow_units(const Block& b, const Facts& facts, const machine::Profile& machine);
  /// Nothing is known any more of what the program ever changes.
  void forget();
  void forget(const VarRef& v);
  /// Values that are expressions: their variables may mean something else now.
  void forget_expressions();
  [[nodiscard]] bool has_expressions() const;
  /// A slot as another analysis knows it.
  void put(FrameSlot s, const PlanarFrame& frame) { at(s) = frame; }
  void limit(const SlotUses& uses) { uses_ = uses; }
  void join(const FrameState& other);
  bool operator==(const FrameState& other) const {
    return slots_ == other.slots_ && preset_off_ == other.preset_off_ && preset_unsure_ == other.preset_unsure_;
  }

 private:
  PlanarFrame& at(FrameSlot s) { return slots_[static_cast<std::size_t>(s)]; }
  void translate(const FrameChange& c, const Facts& facts, const Block& b);
  void rotate(const FrameChange& c, const Facts& facts, const Block& b, const machine::Profile& machine);
  void stretch(const FrameChange& c, const Facts& facts, const machine::Profile& machine);
  void preset(const FrameChange& c, const Facts& facts, const Block& b, const machine::Profile& machine);
  [[nodiscard]] PlanarFrame inner_of(FrameSlot slot, const machine::Profile& machine) const;
  std::array<PlanarFrame, frame_slots> slots_;
  bool preset_off_ = false;     ///< kept, and out of force
  bool preset_unsure_ = false;  ///< kept, and out of force on some of the ways that lead here
  SlotUses uses_;               ///< no part of the state's value
};

/// States before each statement of a program. Calls are followed: a subprogram starts with what all its callers agree
/// on, and gives back what its ends agree on. Of a subprogram that nothing here calls nothing is known at the start.
class FrameStates {
 public:
  FrameStates(const Program& program, const FactsOf& facts, const LegaliseContext& context);
  [[nodiscard]] const FrameState& before(const Statement& s) const;

 private:
  /// Shared by all statements that it holds for.
  using State = std::shared_ptr<const FrameState>;
  struct OfRoutine {
    ControlFlow flow;
    std::optional<FrameState> entry, exit;  ///< none: not reached yet
    bool changes_frames = false;            ///< itself or what it calls
    bool open = false;                      ///< to be followed again
  };
  [[nodiscard]] SlotUses anything() const;
  void look();
  void enter(std::size_t routine, FrameState state);
  void follow(std::size_t routine);
  /// State after the statement; nullptr: the callee has not come back yet.
  State after(std::size_t routine, const Statement& s, const State& before);
  State after_call(std::size_t routine, const CallRoutine& call, const State& before);
  State without_written(std::size_t caller, const State& before) const;

  const Program& program_;
  const FactsOf& facts_;
  const machine::Profile& machine_;
  FrameState neutral_, unknown_;
  bool modal_calls_change_ = false;  ///< a modal call runs a subprogram that changes the frame
  std::vector<OfRoutine> routines_;
  std::vector<State> states_;  ///< by the number of the statement
};

}  // namespace cnctrans::ir::passes
