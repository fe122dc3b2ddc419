#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "ir/edit/rewrite.h"
#include "legaliser/frames/axis_scales.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// The programmed shift along straight text, in numbers, and where the axes stood before it changed.
struct Shifted {
  std::array<std::optional<double>, axis::count_max> shift{}, at{}, moved{};
  bool turned = true;  ///< a rotation, or something else than a shift, may be in force
  void clear_all() {
    shift.fill(std::nullopt);
    at.fill(std::nullopt);
    moved.fill(std::nullopt);
    turned = true;
  }
  void start() {
    clear_all();
    shift.fill(0);
    moved.fill(0);
    turned = false;
  }
};

/// The head of the translation selects the work offset that the source's machine has in force at the start.
inline bool head_selects_offset(const LegaliseContext& context) {
  const auto offset = context.source_machine.power_on.work_offset;
  return offset != context.target_machine.power_on.work_offset && offset > 0 &&
         offset <= context.target.work_offset_rows;
}

/// It may be more than a shift.
inline bool turns(const FrameChange& c) {
  return c.kind != FrameKind::translate || c.slot == FrameSlot::rotation || c.slot == FrameSlot::scale ||
         c.slot == FrameSlot::mirror;
}
/// A shift that takes the place of the whole chain: it ends a rotation, scale or mirror.
inline bool replaces_chain(const FrameChange& c) {
  return c.kind == FrameKind::translate && c.combine == FrameCombine::replace && c.slot == FrameSlot::chain;
}
inline bool is_polar(const Motion& m) {
  return m.extra && (m.extra->has_polar_angle || m.extra->has_polar_radius);
}

/// A word that the pass over arcs has put beside others for an axis that stays where it stands: an increment of 0.
inline bool holds_still(const CoordWord& c) {
  return c.mode == WordMode::incremental && c.pos.column == 0 && c.value.is(0);
}

/// Axes that have not moved since the last change of the frame (or since the start, in a frame that the head selects)
/// on some way, as bits: a domain of FlowStates. The bits from first_plane_bit on say which planes may be in force
/// (polar words move both axes of the plane), those from first_turned_bit on which axes have not moved since a
/// rotation, scale or mirror began or ended; in_turn: one may be in force.
struct UnmovedAxes {
  using State = std::uint64_t;
  static constexpr State one = 1;
  static constexpr unsigned first_plane_bit = axis::count_max, first_turned_bit = first_plane_bit + 3;
  static constexpr State plane_bits = 7 * (one << first_plane_bit), axes_waiting = (one << axis::count_max) - 1;
  static constexpr State axes_turned = ((one << axis::first_extra) - 1) << first_turned_bit;
  static constexpr State in_turn = one << 63U;
  static constexpr State axis_bits = axes_waiting | axes_turned;
  /// Only the axes of a frame have one.
  static State turned_bit(AxisId a) { return a < axis::first_extra ? one << (first_turned_bit + a) : 0; }
  static std::uint32_t turned_axes(State state) {
    return static_cast<std::uint32_t>((state & axes_turned) >> first_turned_bit);
  }
  UnmovedAxes(Plane at_power_on, bool in_another_frame)
      : power_on(plane_bit(at_power_on) | (in_another_frame ? axes_waiting : 0)) {}
  State power_on;
  static State plane_bit(Plane plane) { return one << (first_plane_bit + static_cast<unsigned>(plane)); }
  [[nodiscard]] State start(const Routine& r, bool called) const {
    return r.kind == RoutineKind::main && !called ? power_on : plane_bits | in_turn;
  }
  static void transfer(const Statement& s, State& state) {
    if (const auto* assign = std::get_if<Assign>(&s.node)) {
      for (const auto& i : assign->items) {
        if (const auto a = axis_of_component(i)) state |= one << *a;
      }
    }
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    for (const auto& a : b->actions) {
      const auto* f = std::get_if<FrameOp>(&a.data);
      if (f != nullptr || std::holds_alternative<WorkOffset>(a.data)) state |= axes_waiting;
      if (f != nullptr && f->change) follow_turn(*f->change, state);
      const auto* m = std::get_if<ModalSet>(&a.data);
      if (m != nullptr && m->setting == Setting::plane)
        state = (state & ~plane_bits) | one << (first_plane_bit + m->value);
    }
    if (!b->has_motion) return;
    for (const auto& c : b->motion.coords) {
      if (!holds_still(c)) state &= ~(one << c.axis | turned_bit(c.axis));
    }
    if (is_polar(b->motion)) state &= ~polar_axes(state);
  }
  static void follow_turn(const FrameChange& c, State& state) {
    const bool begins = turns(c), clears = c.combine == FrameCombine::clear, replaces = replaces_chain(c);
    if (begins || clears || (replaces && (state & in_turn) != 0)) state |= axes_turned;
    if (begins) state |= in_turn;
    if (!begins && (clears || replaces)) state &= ~in_turn;
  }
  /// Axes that polar words move whichever of the planes is in force.
  static State polar_axes(State state) {
    State moved = axes_waiting;
    for (const auto plane : {Plane::xy, Plane::zx, Plane::yz}) {
      const PlaneAxes axes = plane_axes(plane);
      if ((state >> (first_plane_bit + static_cast<unsigned>(plane)) & one) != 0)
        moved &= one << axes.u | one << axes.v;
    }
    return moved | (moved << first_turned_bit & axes_turned);
  }
  [[nodiscard]] static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      if (!std::holds_alternative<Block>(s.node) && !std::holds_alternative<Assign>(s.node)) return;
      State none = 0, all = plane_bits | axis_bits | in_turn;
      transfer(s, none);
      transfer(s, all);
      found = found || none != 0 || all != (plane_bits | axis_bits | in_turn);  // planes, frames, moves
    });
    return found;
  }
  /// Changes of frames alone make an axis wait for its first move.
  [[nodiscard]] static bool adds(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      State none = 0;
      transfer(s, none);
      found = found || (none & axis_bits) != 0;
    });
    return found;
  }
  static void only_kept(State& back, State before) { back &= before | ~axis_bits; }
  static void unknown(State& /*state*/) {}
  static bool join(State& a, State b) {
    const State before = a;
    a |= b;
    return a != before;
  }
};

}  // namespace cnctrans::ir::passes
