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
  void forget();
  void forget(const VarRef& v);
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
};

/// States before each statement of one routine.
class FrameStates {
 public:
  FrameStates(const Program& program, const Routine& routine, const FactsOf& facts, const LegaliseContext& context);
  [[nodiscard]] FrameState before(const Statement& s) const;

 private:
  std::map<std::uint32_t, FrameState> states_;
};

}  // namespace cnctrans::ir::passes
