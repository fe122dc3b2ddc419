// The parts that a program puts between its coordinates and the work offset: preset, shift, rotation, mirror, scale,
// and the chain of a control that keeps them in one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "interpreter/values/frame.h"
#include "ir/block.h"

namespace cnctrans::interpreter {

class FrameParts {
 public:
  /// From the outermost part to the innermost one. It has to outlive this object.
  explicit FrameParts(const std::vector<ir::FrameSlot>& order) : order_(order) {}

  [[nodiscard]] bool has(ir::FrameSlot slot) const;
  [[nodiscard]] const Frame& operator[](ir::FrameSlot slot) const { return parts_[index(slot)]; }
  /// Everything in the order of the machine, whether it counts now or not.
  [[nodiscard]] Frame written() const;
  /// What counts now: of all parts, of those outside of `slot`, of those inside of it.
  [[nodiscard]] Frame counted() const;
  [[nodiscard]] Frame outside_of(ir::FrameSlot slot) const;
  [[nodiscard]] Frame inside_of(ir::FrameSlot slot) const;
  [[nodiscard]] bool counts(ir::FrameSlot slot) const { return (suspended_ >> index(slot) & 1U) == 0; }
  /// The part keeps its values and counts, or does not count for now.
  void suspend(ir::FrameSlot slot, bool off);
  /// Of a control whose preset belongs to the work offset: none while no work offset is in force.
  void count_preset(bool counts) { preset_counts_ = counts; }

  /// The chain stands for all parts but the preset.
  void clear(ir::FrameSlot slot);
  /// All parts go, the chain becomes `f`.
  void replace_all(const Frame& f);
  /// `axes`: those that the change names, or all of the machine where the whole part is written.
  using AxisList = std::vector<ir::AxisId>;
  void preset(ir::FrameSlot slot, const Axes& shift, const AxisList& axes);
  /// `fine`: the fine part of the shift is written, the coarse one stays.
  void translate(ir::FrameSlot slot, ir::FrameCombine combine, const Axes& shift, const AxisList& axes, bool fine);
  void rotate(ir::FrameSlot slot, ir::FrameCombine combine, const Frame& turn);
  /// A factor for each of the axes; `times`: what is added multiplies (a mirror is said anew).
  void stretch(ir::FrameSlot slot, ir::FrameCombine combine, const Axes& factors, const AxisList& axes, bool times);

 private:
  static std::size_t index(ir::FrameSlot slot) { return static_cast<std::size_t>(slot); }
  void add_counted(Frame& f, ir::FrameSlot slot) const;
  /// The part that is changed; a chain that is replaced has no fine part.
  Frame& change(ir::FrameSlot slot, ir::FrameCombine combine);

  const std::vector<ir::FrameSlot>& order_;
  std::array<Frame, 6> parts_;
  std::uint8_t suspended_ = 0;  ///< bit n: part n does not count
  bool preset_counts_ = true;
  Axes fine_{};  ///< of the chain's shift; in the part too
};

/// The factor of an axis in a frame without rotation.
double& factor_of(Frame& f, ir::AxisId axis);

}  // namespace cnctrans::interpreter
