// The programmable frame in one canonical form, with numbers or expressions: T(shift) . R(angle) . k . M
// (equivalences 17.1).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "ir/block.h"

namespace cnctrans::ir::passes {

/// Length words of a shift are in the unit that its statement stood in. What is not known here is empty.
struct PlanarFrame {
  static constexpr std::size_t axes = axis::first_extra;

  std::array<std::optional<Value>, axes> shift;
  std::array<WordScale, axes> shift_scale{};  ///< radius or diameter words
  std::optional<Value> angle;                 ///< degrees in `plane`
  Plane plane = Plane::xy;                    ///< of a rotation; without one of no meaning
  std::optional<Value> factor;                ///< uniform scale
  std::optional<std::uint32_t> mirror;        ///< bit n: axis n is mirrored
  bool foreign = false;                       ///< something else is in it: a scale of single axes, a rotation in space
  static constexpr std::uint32_t linear = 7;  ///< bits of X, Y, Z
  std::uint32_t scaled = linear;              ///< axes of `factor`; others than all of them: foreign
  bool by_axes = false;                       ///< foreign for nothing but `scaled`: a target may have it

  PlanarFrame();  ///< neutral
  [[nodiscard]] bool known() const;
  /// Without the remark on `scaled`, for who looks at it.
  [[nodiscard]] PlanarFrame with_axes() const;
  [[nodiscard]] bool neutral() const;
  [[nodiscard]] bool has_expressions() const;  ///< a value that goes by variables
  [[nodiscard]] bool has_shift() const;        ///< an axis whose shift is not known to be 0
  [[nodiscard]] bool turns() const { return !(angle && angle->is(0)); }
  [[nodiscard]] bool scales() const { return !(factor && factor->is(1)); }
  [[nodiscard]] bool mirrors() const { return mirror != 0U; }
  [[nodiscard]] FrameWord word(std::size_t axis) const;
  /// Words of the axes whose shift is known; `drop_zero`: without those that are 0.
  [[nodiscard]] std::vector<FrameWord> shift_words(bool drop_zero) const;
  /// Calls `visit` for every value that can be unknown.
  void each_value(const std::function<void(std::optional<Value>&)>& visit);
  void join(const PlanarFrame& other);
  bool operator==(const PlanarFrame& other) const;
};

bool same_shift(const PlanarFrame& a, const PlanarFrame& b);
bool same_turn(const PlanarFrame& a, const PlanarFrame& b);
bool same_factor(const PlanarFrame& a, const PlanarFrame& b);
bool same_mirror(const PlanarFrame& a, const PlanarFrame& b);

/// `outer` after `inner`: (outer . inner)(p) = outer(inner(p)), reduced to the canonical form.
PlanarFrame compose(const PlanarFrame& outer, const PlanarFrame& inner);
/// A rotation about a point of the plane (shift words u, v of `centre`).
PlanarFrame rotation_about(const PlanarFrame& centre, const Value& angle, Plane plane);

/// The frame as the values of the slots of a machine that applies them in `order`, outermost first; empty when it has
/// no place for one of them. Each slot of the result holds its own part only.
std::optional<PlanarFrame> in_slots(const PlanarFrame& frame, const std::vector<FrameSlot>& order);

}  // namespace cnctrans::ir::passes
