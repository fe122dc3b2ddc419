// What the grooves of a shape of their own share: the shape itself and the insert that cuts it.
//
// Everything is counted from the start corner: u along the pass into the groove, p out of the work. The tool has one
// programmed point, a corner of its insert; where the other corner cuts, the point is one width away from it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "ir/cycles/contour.h"

namespace cnctrans::ir::cycles::detail {

/// Passes not above `step`, at least one.
double groove_passes(double total, double step);

/// The width of the insert is known, and of a groove in the face on which side its start lies.
bool knows_insert(const TurnContext& context, bool face, std::string* error);

/// One side of the groove as its shape says.
struct Flank {
  double angle = 0;             ///< radians, from the infeed
  double outer = 0, inner = 0;  ///< corner elements: a radius, or a chamfer (negative)
};
/// Of a side, counted from its own outer corner: the contour, and where the flat part of the base begins.
struct Side {
  Chain chain;  ///< from the surface down and along the base; q is -u
  double top = 0, flat = 0, middle = 0;
};
/// Depth of the side at u, below the surface.
double depth_at(const Side& s, double u);
/// The corner element at a place between two directions, each unit long; `far`: how far it reaches.
void corner_element(Chain& out, RolePoint at, RolePoint before, RolePoint after, double element, double far);

class Shape {
 public:
  /// `by_width`: a chamfer is given by its width, not by its length.
  Shape(double width, double depth, std::array<Flank, 2> flanks, bool by_width)
      : width_(width), depth_(depth), flanks_(flanks), by_width_(by_width) {}

  /// Width at the surface.
  [[nodiscard]] double across() const;
  /// The side with its allowances; without them also its outer corner element. nullopt: its elements do not fit.
  [[nodiscard]] std::optional<Side> side(std::size_t k, double base_stock, double flank_stock, bool outer) const;

 private:
  double width_, depth_;
  std::array<Flank, 2> flanks_;
  bool by_width_;
};

/// Writes the moves, given from the start corner. `into`: the sense in which the groove lies along the pass.
class Insert {
 public:
  Insert(Roles& r, RolePoint corner, double out, double into, const TurnContext& context, bool face);

  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double radius() const { return radius_; }
  /// The programmed point is not the corner that comes first: the width decides where it lies.
  [[nodiscard]] bool shifted_by_width() const { return far_corner_; }
  /// All feeds from now on; 0: the feed in force.
  void feed_rate(double f) { feed_ = f; }
  /// The point of the tool when the corner of its insert that comes first stands at u.
  [[nodiscard]] RolePoint place(double p, double u) const;
  /// To the first place over the groove: outside along the pass first, inside along the infeed first.
  void approach(double p, double u, bool inside);
  void rapid(double p, double u) { r_.rapid(place(p, u)); }
  void feed(double p, double u) { r_.feed(place(p, u), feed_); }
  /// A piece of the way of the middle of the insert's corner, on the side that comes first.
  void piece(const Piece& x, bool far, double across);
  /// Along a side from above its first point to `end` on the base, with the corner of the insert that cuts there.
  bool along(const Chain& side, double end, bool far, double across, double lift, std::string* error);

 private:
  [[nodiscard]] double u_of(double q, bool far, double across) const;

  Roles& r_;
  RolePoint corner_;
  double out_, into_, width_, radius_, shift_ = 0, feed_ = 0;
  bool far_corner_ = false;
};

/// A groove with what its roughing leaves: the two sides of both, and the cuts that two cycles share.
struct Groove {
  double across = 0, lift = 1, dwell = 0, step = 0;
  double sideways = 0;  ///< largest distance of two plunges
  std::array<Flank, 2> flanks;
  std::array<Side, 2> rough, fine;

  /// false with a sentence: the elements do not fit, or the tool is too wide.
  bool set(const Shape& shape, double base_stock, double flank_stock, double width, std::string* error);
  /// Depth that an insert of this width may go to at u.
  [[nodiscard]] double deep(double u, double width) const;
  /// In equal infeeds from above the surface.
  void plunge(Insert& tool, Roles& r, double u, bool base) const;
  bool rough_flanks(Insert& tool, Roles& r, std::string* error) const;
  bool finish(Insert& tool, double flank_stock, std::string* error) const;
};

}  // namespace cnctrans::ir::cycles::detail
