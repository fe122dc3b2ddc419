// The parts of the expansion of milling cycles: a path in a turned frame, and the machining of one shape each.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "ir/cycles/milling/milling.h"

namespace cnctrans::ir::cycles::detail {

inline constexpr double least_mm = 1e-6;   ///< shorter is nothing to mill
inline constexpr double usual_step = 0.8;  ///< of the diameter, where the source names no other factor
inline constexpr double level_lift = 1;    ///< mm above what is cleared already, between two levels
inline constexpr double radians = 3.14159265358979323846 / 180;

/// Digit of a word that holds one decision a digit; place 0 is the last.
inline int digit(double number, int place) {
  const auto n = std::lround(std::abs(number));
  return static_cast<int>(place == 0 ? n % 10 : place == 1 ? n / 10 % 10 : n / 100 % 10);
}

/// How the tool goes to the next level of a pocket.
enum class Plunge : std::uint8_t { rapid, feed, helix, ramp };
Plunge plunge_of(const MillNumbers& mill);

enum class Operation : std::uint8_t { complete, rough, finish };

/// Collects the moves. Coordinates `p`, `q` are those of a frame set by `place`: p along the shape's first axis.
class MillPath {
 public:
  MillPath(const MillNumbers& mill, const HoleNumbers& levels, const MillContext& context)
      : mill_(mill), levels_(levels), context_(context), u_(context.u), v_(context.v), w_(context.w) {}

  [[nodiscard]] double get(std::string_view name, double otherwise = 0) const;
  [[nodiscard]] bool says(std::string_view name) const { return get(name) != 0; }
  [[nodiscard]] double tool_radius() const { return context_.tool_radius; }
  [[nodiscard]] const HoleNumbers& levels() const { return levels_; }
  /// The place of the shape, or where the tool stood before the cycle.
  [[nodiscard]] std::pair<double, double> place() const;
  [[nodiscard]] Operation operation(std::string* error) const;
  /// Travel round the inside of a shape is counter-clockwise. `error`: no such sense.
  [[nodiscard]] bool inside_ccw(std::string* error) const;
  /// Step in the plane; 0 and a sentence: larger than the tool.
  [[nodiscard]] double step(double factor, std::string* error) const;
  /// Bottoms of the levels from `top` to `bottom`, the last is the bottom.
  [[nodiscard]] std::vector<double> depths(double top, double bottom, double infeed, bool equal);
  [[nodiscard]] std::vector<double> depths(double top, double bottom);

  /// `exact` rounded up, at least 1: how many passes, rounds or strokes. A cycle of more than anyone mills is a fault
  /// of its numbers: 1, and too_many() from then on.
  [[nodiscard]] long times(double exact);
  [[nodiscard]] bool too_many() const { return too_many_; }

  [[nodiscard]] Plunge plunge_way() const { return plunge_of(mill_); }

  void frame(double u, double v, double degrees);
  /// Moves the frame's origin along its first axis.
  void frame_along(double p);
  [[nodiscard]] std::pair<double, double> local();
  /// Something was asked that depends on a place that is not known.
  [[nodiscard]] bool lost() const { return lost_; }
  [[nodiscard]] double height() const { return w_; }
  [[nodiscard]] double up() const { return levels_.up; }

  /// To the retract plane where the cycle has one, to (p, q), then to the reference plane.
  void approach(double p, double q);
  void retract();
  void rapid(double p, double q);
  void rapid_to(double w);
  void plunge(double w);  ///< at the feed into the material
  void mill(double p, double q);
  void mill_to(double p, double q, double w);  ///< at the feed of milling
  /// In the open, at a feed of its own; 0: that of milling.
  void link(double p, double q, double w, double feed);
  /// At a pitch, from a spindle angle.
  void thread_to(double w, double pitch, double degrees);
  void spindle(MillStep step, double degrees = 0);
  /// Radius compensation from the next move on: 1 left, -1 right, 0 off.
  void compensate(int side);
  void mill_arc(double p, double q, double cp, double cq, bool ccw);
  void mill_arc_to(double p, double q, double w, double cp, double cq, bool ccw);
  /// The same at the feed of the way onto a thread.
  void lead_arc_to(double p, double q, double w, double cp, double cq, bool ccw);
  /// The same with infeed at the plunge feed.
  void plunge_to(double p, double q, double w);
  void plunge_circle(double cp, double cq, double w, bool ccw);
  void plunge_arc_to(double p, double q, double w, double cp, double cq, bool ccw);
  void mill_circle(double cp, double cq, double w, bool ccw);  ///< with infeed, at the feed of milling
  /// The feed of milling is times `factor` from here on.
  void scale_feed(double factor) { scale_ = factor; }
  /// Feed and speed of finishing from here on.
  void finishing(bool on);

  std::vector<MillMove> take() { return std::move(moves_); }

 private:
  void put(MillStep step, double u, double v, double w, bool into);
  [[nodiscard]] std::pair<double, double> to_plane(double p, double q) const;

  const MillNumbers& mill_;
  const HoleNumbers& levels_;
  const MillContext& context_;
  std::vector<MillMove> moves_;
  double u_, v_, w_;
  double origin_u_ = 0, origin_v_ = 0, cos_ = 1, sin_ = 0;
  double scale_ = 1;
  bool finishing_ = false, lost_ = false, too_many_ = false;
};

/// The way round a rounded rectangle about the frame's origin: `a`, `b` half sizes, `c` radius of the corners; from
/// (a, 0).
void round_rectangle(MillPath& path, double a, double b, double c, bool ccw);

bool pocket(MillPath& path, bool circle, std::string* error);
bool slots(MillPath& path, std::string* error);
bool long_holes(MillPath& path, std::string* error);
bool ring_slots(MillPath& path, std::string* error);
bool face(MillPath& path, std::string* error);
bool boss(MillPath& path, bool circle, std::string* error);
bool helix_bore(MillPath& path, std::string* error);
bool helix_thread(MillPath& path, std::string* error);
bool milled_thread(MillPath& path, std::string* error);
bool chased_thread(MillPath& path, std::string* error);
bool contour_path(MillPath& path, const std::vector<MillContour>* contours, std::string* error);
bool contour_pocket(MillPath& path, const MillContext& context, std::string* error);

}  // namespace cnctrans::ir::cycles::detail
