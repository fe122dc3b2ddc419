// The programmable frame along a routine: a shift of each axis and a rotation in the plane, as far as they are known.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "ir/passes/facts.h"
#include "ir/passes/words.h"

namespace cnctrans::ir::passes {

class FrameState {
 public:
  static constexpr std::size_t axes = axis::first_extra;
  FrameState();
  [[nodiscard]] bool known() const;
  [[nodiscard]] bool foreign() const { return foreign_; }  ///< scale, mirror, rotation about a point or another axis
  [[nodiscard]] const std::optional<Value>& shift(std::size_t a) const { return shift_[a]; }
  [[nodiscard]] double preset(std::size_t a) const { return preset_[a]; }
  [[nodiscard]] bool neutral() const;
  [[nodiscard]] const std::optional<Value>& angle() const { return angle_; }
  [[nodiscard]] bool named(std::size_t a) const { return scale_named_[a]; }
  [[nodiscard]] FrameWord word(std::size_t a) const;
  /// Words of the axes with a shift (the preset included); `drop_zero`: without those that are 0.
  [[nodiscard]] std::vector<FrameWord> shift_words(bool drop_zero) const;
  void apply(const FrameChange& c, const Facts& facts, const Block& b, const machine::Profile& machine);
  /// Nothing is known any more of the axes that can have a shift, and of the rotation when there can be one.
  void forget();
  void forget(const VarRef& v);
  /// Values that are expressions: their variables may mean something else now.
  void forget_expressions();
  /// Bit n: axis n may have a shift; `rotates`: there may be a rotation. What can't be stays at zero.
  void limit(std::uint32_t axes_touched, bool rotates);
  void join(const FrameState& other);
  bool operator==(const FrameState& other) const;

 private:
  void translate(const FrameChange& c, const Facts& facts, const Block& b);
  void rotate(const FrameChange& c);
  void preset(const FrameChange& c, const Facts& facts, const Block& b, const machine::Profile& machine);
  void clear(FrameSlot slot);
  std::array<std::optional<Value>, axes> shift_;
  std::array<double, axes> preset_{};  ///< of the slot outside the shift, in the scale of the words
  std::array<bool, axes> scale_named_{};
  std::optional<Value> angle_;
  bool foreign_ = false;
  std::uint32_t touched_ = ~0U;  ///< no part of the state's value
  bool rotates_ = true;
};

/// States before each statement of a program. Calls are followed: a subprogram starts with what all its callers agree
/// on, and gives back what its ends agree on. Of a subprogram that nothing here calls nothing is known at the start.
class FrameStates {
 public:
  FrameStates(const Program& program, const FactsOf& facts, const LegaliseContext& context);
  [[nodiscard]] FrameState before(const Statement& s) const;

 private:
  struct OfRoutine {
    ControlFlow flow;
    std::optional<FrameState> entry, exit;  ///< none: not reached yet
    bool changes_frames = false;            ///< itself or what it calls
    bool open = false;                      ///< to be followed again
  };
  void look(const LegaliseContext& context);
  void enter(std::size_t routine, FrameState state);
  void follow(std::size_t routine);
  /// State after the statement; none: the callee has not come back yet.
  std::optional<FrameState> after(std::size_t routine, const Statement& s, FrameState state);
  std::optional<FrameState> after_call(std::size_t routine, const CallRoutine& call, FrameState state);
  void forget_written(std::size_t caller, FrameState& state) const;

  const Program& program_;
  const FactsOf& facts_;
  const machine::Profile& machine_;
  FrameState neutral_, unknown_;
  bool modal_calls_change_ = false;  ///< a modal call runs a subprogram that changes the frame
  std::vector<OfRoutine> routines_;
  std::map<std::uint32_t, FrameState> states_;
};

}  // namespace cnctrans::ir::passes
