// Modal state of the neutral machine: the settings that stay until changed. The IR keeps them as state (a subprogram
// may be run under several of them); every setting has one meaning here, whatever a control makes of it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "ir/axis.h"

namespace cnctrans::ir {

enum class Plane : std::uint8_t { xy, zx, yz };  ///< abscissa, ordinate: X Y / Z X / Y Z
enum class Distance : std::uint8_t { absolute, incremental };
enum class Units : std::uint8_t { metric, inch };
/// What the words of a diameter axis mean: radius, diameter, or diameter for absolute words and radius for increments.
enum class DiameterMode : std::uint8_t { radius, diameter, absolute_only };
enum class FeedMode : std::uint8_t { per_minute, per_rev, inverse_time };
enum class PathMode : std::uint8_t { continuous, exact_stop };
enum class SpindleMode : std::uint8_t { rpm, css };  ///< css: constant cutting speed in m/min
enum class CompSide : std::uint8_t { off, left, right };
enum class RetractPlane : std::uint8_t { initial, reference };  ///< where a modal hole cycle returns to between holes
enum class FeedPoint : std::uint8_t { centre, contact };
enum class OnOff : std::uint8_t { off, on };
/// How a spline begins or ends: by its outermost three points, with curvature zero, along the neighbouring block.
enum class SplineEnd : std::uint8_t { free, natural, tangent };
/// What axes beside the curve follow: its length, or its parameter.
enum class PathReference : std::uint8_t { arc_length, parameter };

/// What the coordinates mean on a part that the C axis turns: a face has Cartesian X and Y about the axis of turning
/// and Z; a cylinder X (radius), Y along the unrolled circumference, and Z. `tool`: a transformation whose axes only
/// the machine knows; positions are as programmed, increments count in the frame in force, like on a face or a
/// cylinder.
enum class Surface : std::uint8_t { none, face, cylinder, tool };
/// The C axis follows the coordinates.
constexpr bool turns_part(Surface s) {
  return s == Surface::face || s == Surface::cylinder;
}

/// The motion function in force. `modal` in a block: the one in force before (no code written).
enum class MotionKind : std::uint8_t {
  modal,
  rapid,
  linear,
  arc_cw,
  arc_ccw,
  thread,
  thread_variable,
  arc_through_point,
  arc_tangent,
  spline_akima,  ///< through the end points of the blocks, slopes by Akima
  spline_b,      ///< the end points of the blocks are its control points
  spline_cubic,  ///< through the end points of the blocks, curvature continuous
  polynomial,
  probe_toward,
  probe_away,
  to_stop,
  reference_point,
  fixed_point,
  tap_rigid,      ///< the position of the spindle follows the axis; the lead's sign is the hand
  tap_rigid_out,  ///< back out: the spindle turns the other way round
  tap_floating    ///< at feed F; a chuck takes up the difference
};

/// Settings that a `ModalSet` action can name; the value is one of the enumerators of the type in brackets.
enum class Setting : std::uint8_t {
  plane,            ///< [Plane]
  distance,         ///< [Distance]
  units,            ///< [Units]; flag `feed_too`: F words change unit as well
  diameter,         ///< [DiameterMode]
  feed_mode,        ///< [FeedMode]; `FeedMemory` in the flags says what becomes of F
  path_mode,        ///< [PathMode]
  spindle_mode,     ///< [SpindleMode]
  comp,             ///< [CompSide] tool radius compensation
  length_comp,      ///< [OnOff] tool length compensation (controls that switch it)
  retract_plane,    ///< [RetractPlane]
  feed_point,       ///< [FeedPoint]
  feed_override,    ///< [OnOff] override enabled
  spline_start,     ///< [SplineEnd]
  spline_end,       ///< [SplineEnd]
  path_reference,   ///< [PathReference]
  polynomial_axes,  ///< [OnOff] off: polynomials are not carried out, only their ends
  surface,          ///< [Surface]; set by a SurfaceSet
  count_
};
inline constexpr std::size_t setting_count = static_cast<std::size_t>(Setting::count_);

/// What happens to F when the feed mode changes.
enum class FeedMemory : std::uint8_t { shared, per_mode, cleared };

/// Modal state with every field known: the interpreter's, and a machine's power-on state.
struct ModalState {
  Plane plane = Plane::xy;
  Distance distance = Distance::absolute;
  Units units = Units::metric;
  bool units_feed_too = true;
  DiameterMode diameter = DiameterMode::radius;
  FeedMode feed_mode = FeedMode::per_minute;
  PathMode path_mode = PathMode::continuous;
  SpindleMode spindle_mode = SpindleMode::rpm;
  CompSide comp = CompSide::off;
  OnOff length_comp = OnOff::on;
  RetractPlane retract_plane = RetractPlane::initial;
  FeedPoint feed_point = FeedPoint::centre;
  OnOff feed_override = OnOff::on;
  SplineEnd spline_start = SplineEnd::natural, spline_end = SplineEnd::natural;
  PathReference path_reference = PathReference::arc_length;
  OnOff polynomial_axes = OnOff::on;
  Surface surface = Surface::none;
  MotionKind motion = MotionKind::rapid;
  std::int32_t work_offset = 0;  ///< 0: none (machine zero); 1.. : table rows (1 = first settable offset)

  [[nodiscard]] std::uint8_t get(Setting s) const;
  void set(Setting s, std::uint8_t value);
  bool operator==(const ModalState&) const = default;
};

inline constexpr bool is_spline(MotionKind k) {
  return k == MotionKind::spline_akima || k == MotionKind::spline_b || k == MotionKind::spline_cubic;
}
/// Curves by points or coefficients.
inline constexpr bool is_curve(MotionKind k) {
  return is_spline(k) || k == MotionKind::polynomial;
}

/// Abscissa, ordinate and normal of a plane.
struct PlaneAxes {
  AxisId u, v, w;
};
inline constexpr PlaneAxes plane_axes(Plane p) {
  switch (p) {
    case Plane::zx: return {axis::z, axis::x, axis::y};
    case Plane::yz: return {axis::y, axis::z, axis::x};
    case Plane::xy: break;
  }
  return {axis::x, axis::y, axis::z};
}

std::string_view name(Plane p);
std::string_view name(Distance d);
std::string_view name(Units u);
std::string_view name(DiameterMode d);
std::string_view name(FeedMode m);
std::string_view name(PathMode m);
std::string_view name(SpindleMode m);
std::string_view name(CompSide s);
std::string_view name(RetractPlane r);
std::string_view name(Surface s);
std::string_view name(MotionKind k);
std::string_view name(Setting s);
/// Name of `value` of setting `s` ("absolute"); and back.
std::string_view setting_value_name(Setting s, std::uint8_t value);
std::optional<std::uint8_t> setting_value(Setting s, std::string_view name);
std::optional<Setting> setting_by_name(std::string_view name);
std::optional<MotionKind> motion_kind_by_name(std::string_view name);

}  // namespace cnctrans::ir
