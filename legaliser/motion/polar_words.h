// Polar words as coordinates: parts of the pass of the poles.
#pragma once

#include <array>
#include <cstdint>
#include <set>

#include "ir/cycles/hole.h"
#include "ir/program.h"
#include "legaliser/analysis/words.h"

namespace cnctrans::ir::passes {

/// A point of the plane in mm, radius: abscissa u, ordinate v.
struct Point2 {
  double u = 0, v = 0;
  bool operator==(const Point2&) const = default;
};

/// `x` without the last bits of sines and cosines.
double clean(double x);

/// The point at radius `r` (mm) and angle `q` (degrees) about `pole`.
Point2 around(Point2 pole, double r, double q);

/// One coordinate of it as an expression of words: wave(q) * r + from, divided by `factor` (mm of one unit of the
/// word).
Value around(const Value& r, const Value& q, Function wave, double from, double factor);

/// A polar word of this mode counts from the pole, not from the point before.
inline bool polar_absolute(WordMode mode, std::optional<Distance> distance) {
  return mode == WordMode::absolute || (mode == WordMode::modal && distance == Distance::absolute);
}
/// Both polar words of the block do.
inline bool polar_absolute(const MotionExtra& x, std::optional<Distance> distance) {
  return polar_absolute(x.polar_mode, distance) && polar_absolute(x.polar_angle_mode, distance);
}

/// A polar word of the block has a mode of its own.
inline bool modes_of_words(const MotionExtra& x) {
  return x.polar_mode != WordMode::modal || x.polar_angle_mode != WordMode::modal;
}
/// How the polar words of a block count.
struct PolarModes {
  bool radius_modal = false, angle_modal = false;  ///< the word is there, and the mode in force decides
  bool adds_radius = false, adds_angle = false;    ///< the word is there, and is an increment
};
PolarModes polar_modes(const MotionExtra& x, std::optional<Distance> distance);
/// Polar words of a mode of their own that is in force anyway lose it.
void drop_modes_in_force(Block& b, const Facts& facts);

/// The polar words of the motion get a radius.
void say_polar_radius(Motion& m, const Value& radius);
/// The block says the radius by itself, whatever was before.
bool says_radius(const Block& b, const Facts& facts);

/// Polar words without a radius.
inline bool angle_alone(const Block& b) {
  return b.has_motion && b.motion.extra && b.motion.extra->has_polar_angle && !b.motion.extra->has_polar_radius;
}

/// The place that a pole function gives: from `base` where it is relative to the point before, or to the pole before.
std::optional<Point2> place_of(const PoleSet& p, Plane plane, std::optional<Point2> base, std::optional<Point2> pole,
                               const Block& b, const Facts& facts, const machine::Profile& machine);

/// An arc, or a line, whose end stands in polar words.
bool is_polar_arc(const Block& b, const Facts& facts);
/// Its end alone is said by polar words: a line, or an arc that leaves the element before it in its direction.
bool is_polar_line(const Block& b, const Facts& facts);
/// Every motion function of the program is a straight line's.
bool has_lines_only(const Program& program);
/// In such a program a motion function that the ways to the block leave open is one, too.
inline bool polar_line(const Block& b, const Facts& facts, bool lines_only) {
  if (is_polar_line(b, facts)) return true;
  const auto& x = b.motion.extra;
  return lines_only && b.has_motion && x && !motion_in(b, facts) && (x->has_polar_angle || x->has_polar_radius);
}

/// The centre that the words of an arc give; nullopt: not known.
std::optional<Point2> centre_of(const Block& b, const Facts& facts, Point2 start, Plane plane,
                                std::optional<Distance> distance, const machine::Profile& machine);

/// A part of a circle by a step of the angle that is a number, about this pole, whether it names the centre or not.
bool is_part_about(Point2 pole, const Block& b, const Facts& facts, const machine::Profile& machine);

/// The points of an arc in its plane.
struct ArcPoints {
  Point2 start, end, centre;
};
/// The point to which polar words have led, where the dataflow does not know it: by axis, so that it holds on in
/// another plane.
class LedPoint {
 public:
  void set(const PlaneAxes& axes, Point2 to);
  [[nodiscard]] std::optional<Point2> at(const PlaneAxes& axes, const Facts& facts) const;
  /// Where the tool stands by another analysis, if nothing else knows it.
  void stands(const std::array<std::optional<double>, axis::count_max>& at) { stands_ = at; }
  /// Nothing else does: passes behind this one will not know it either.
  [[nodiscard]] bool only_stands(const PlaneAxes& axes, const Facts& facts) const {
    const auto known = [&](AxisId axis) { return at_[axis] || facts.position[axis]; };
    return !known(axes.u) || !known(axes.v);
  }
  /// A change of the unit.
  void scale(double factor);
  /// Over a block without polar words.
  void follow(const Block& b, const Facts& facts, const machine::Profile& machine);

 private:
  std::array<std::optional<double>, 3> at_{};  ///< X, Y, Z
  std::array<std::optional<double>, axis::count_max> stands_{};
};
/// The block moves in the plane.
bool touches_plane(const Block& b, const PlaneAxes& axes);
/// A hole along the normal of the plane leaves the tool over its point.
inline bool leaves_point(const CycleDefine& d) {
  const auto* hole = d.cycle ? std::get_if<HoleCycle>(&d.cycle->node) : nullptr;
  return hole != nullptr && hole->axis == axis::none && cycles::ends_over_its_place(*hole);
}
/// The full turns of a helix as its travel per turn; nothing happens where the travel along `normal` or the sense is
/// not known.
void turns_to_pitch(MotionExtra& x, const Block& b, const Facts& facts, AxisId normal, const ArcPoints& arc,
                    const machine::Profile& machine);

/// The zero point moves: a pole may stay behind.
bool moves_zero(const Action& a);

/// The pole as words of the plane's axes; `fu`, `fv`: radius of one unit of them.
std::shared_ptr<const FrameChange> pole_words(Plane plane, Point2 at, double fu, double fv);

/// Frames, or a cycle, take the tool to a point that polar words do not know.
bool loses_point(const Block& b);
/// Blocks (by id) before, with and behind a tangential entry or exit, or a helix by its pitch, where the target has no
/// such thing: their points must be numbers.
std::set<std::uint32_t> beside_lacking(const Program& program, const Capabilities& target);
/// Some moves may run a subprogram.
bool has_modal_calls(const Program& program);
/// The program has polar words or sets a pole.
bool uses_polar(const Program& program);

}  // namespace cnctrans::ir::passes
