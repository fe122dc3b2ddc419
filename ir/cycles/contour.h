// A profile as a chain of lines and arcs in the directions of a pass: the tool comes from plus q and works toward minus
// q, plus p leads out of the work. Both are mm.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ir/cycles/machining.h"
#include "ir/cycles/turning_moves.h"

namespace cnctrans::ir::cycles::detail {

struct Piece {
  RolePoint a, b;
  bool arc = false, ccw = false;  ///< with q to the right and p upward
  RolePoint c;                    ///< centre
};
using Chain = std::vector<Piece>;

/// Which axis a pass follows, and which way is out and back to the tool.
struct Orientation {
  bool face = false;      ///< passes along X
  double sp = 1, sq = 1;  ///< +1: the normal sense is that of the axis

  [[nodiscard]] RolePoint in(TurnPoint t) const {
    const RolePoint r = face ? RolePoint{t.z, t.x} : RolePoint{t.x, t.z};
    return {sp * r.p, sq * r.q};
  }
  [[nodiscard]] RolePoint role(RolePoint n) const { return {sp * n.p, sq * n.q}; }
  /// The sense of an arc of the plane Z X.
  [[nodiscard]] bool sense(bool ccw) const { return ccw != (face != (sp * sq < 0)); }
};

Chain chain_of(const std::vector<ProfileElement>& elements, const Orientation& o);
/// The same way back.
Chain reversed(Chain chain);
/// No contour, or one whose elements lead nowhere: an arc back to its own start (`G2 R10` alone).
bool leads_nowhere(const std::vector<ProfileElement>& elements);
/// Arcs cut where they change their direction along an axis.
Chain split(const Chain& chain);
Chain shifted(Chain chain, double dp, double dq);
/// The line at the constant distance `d` outside of the chain (the tool's side, left of the way back). nullopt with a
/// sentence: an element is too small for it.
std::optional<Chain> offset(const Chain& chain, double d, std::string* error);
/// Where the piece, cut by split(), has the height p.
RolePoint at_height(const Piece& piece, double p);
double lowest(const Chain& chain);
double highest(const Chain& chain);
/// The part of the chain, cut by split(), between two of its points.
Chain between(const Chain& chain, RolePoint from, RolePoint to);
/// Never turns back toward plus q.
bool goes_on(const Chain& chain);

/// A part of the chain that lies lower than what comes before it.
struct Valley {
  Chain chain;  ///< from the edge down and up to the same height, or to the end of the profile
};
/// The chain with every valley bridged, and the valleys.
Chain bridged(const Chain& chain, std::vector<Valley>& valleys);
/// The parts of the chain below the height, each from and to that height.
std::vector<Chain> below(const Chain& chain, double height);

}  // namespace cnctrans::ir::cycles::detail
