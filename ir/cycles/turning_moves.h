// What the expansions of lathe cycles share: the two axes by their role, and the list of moves.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/tiny.h"
#include "ir/cycles/machining.h"

namespace cnctrans::ir::cycles::detail {

inline constexpr double most_thread_passes = 10'000;
inline constexpr std::size_t most_levels = 100'000;  ///< of a removal of stock

inline double sign(double v) {
  return v < 0 ? -1 : 1;
}

/// A point by role: `p` along the infeed, `q` along the pass.
struct RolePoint {
  double p = 0, q = 0;
};

/// Writes moves given by roles. Moves that go nowhere are left out.
class Roles {
 public:
  Roles(const MachiningCycle& cycle, const TurnNumbers& numbers, const TurnContext& context)
      : face_(cycle.face), numbers_(numbers), at_(role(context.start)) {}

  [[nodiscard]] bool has(std::string_view name) const { return numbers_.contains(name); }
  [[nodiscard]] double number(std::string_view name, double otherwise = 0) const {
    const auto it = numbers_.find(name);
    return it == numbers_.end() ? otherwise : it->second;
  }
  [[nodiscard]] RolePoint point(std::string_view x, std::string_view z) const { return role({number(x), number(z)}); }
  [[nodiscard]] const TurnNumbers& numbers() const { return numbers_; }
  [[nodiscard]] RolePoint here() const { return at_; }

  void rapid(RolePoint to) { go(TurnStep::rapid, to); }
  TurnMove* feed(RolePoint to, double f = 0) {
    auto* m = go(TurnStep::feed, to);
    if (m != nullptr) set_feed(*m, f);
    return m;
  }
  void feed_per_minute(RolePoint to, double f = 0) {
    if (auto* m = feed(to, f)) m->per_minute = true;
  }
  void arc(RolePoint to, RolePoint centre, double f = 0) {
    const RolePoint from = at_;
    auto* m = go(TurnStep::arc, to);
    if (m == nullptr) return;
    m->centre = plain(centre);
    const TurnPoint a = plain(from);
    m->ccw = (a.z - m->centre.z) * (m->to.x - m->centre.x) - (a.x - m->centre.x) * (m->to.z - m->centre.z) > 0;
    set_feed(*m, f);
  }
  /// `ccw`: with q to the right and p upward.
  void arc(RolePoint to, RolePoint centre, bool ccw, double f) {
    auto* m = go(TurnStep::arc, to);
    if (m == nullptr) return;
    m->centre = plain(centre);
    m->ccw = ccw != face_;
    set_feed(*m, f);
  }
  TurnMove* thread(RolePoint to) { return go(TurnStep::thread, to); }
  void dwell(double seconds) {
    if (seconds > 0) act(TurnStep::dwell).seconds = seconds;
  }
  TurnMove& act(TurnStep step) {
    TurnMove m;
    m.step = step;
    m.to = plain(at_);
    m.sharp = sharp_ && (step == TurnStep::feed || step == TurnStep::arc);
    moves_.push_back(m);
    return moves_.back();
  }
  /// The moves from now on are cut with sharp corners.
  void sharp(bool on) { sharp_ = on; }
  std::vector<TurnMove> take() { return std::move(moves_); }

 private:
  [[nodiscard]] RolePoint role(TurnPoint t) const { return face_ ? RolePoint{t.z, t.x} : RolePoint{t.x, t.z}; }
  [[nodiscard]] TurnPoint plain(RolePoint r) const { return face_ ? TurnPoint{r.q, r.p} : TurnPoint{r.p, r.q}; }
  static void set_feed(TurnMove& m, double f) {
    m.has_feed = f > 0;
    m.feed = f;
  }
  TurnMove* go(TurnStep step, RolePoint to) {
    if (std::abs(to.p - at_.p) < tiny && std::abs(to.q - at_.q) < tiny) return nullptr;
    at_ = to;
    return &act(step);
  }

  bool face_;
  const TurnNumbers& numbers_;
  RolePoint at_;
  bool sharp_ = false;
  std::vector<TurnMove> moves_;
};

/// A hole from its surface toward minus p (a positive depth).
struct Hole {
  double surface = 0, q = 0, start = 0, depth = 0, peck = 0;
};
bool hole_of(const Roles& r, Hole& hole, std::string* error);
/// Drilling in pecks from the start and back; `per_minute`: the feed is that of a driven tool.
void pecks(Roles& r, const Hole& hole, bool per_minute);

/// Each returns false with a sentence when the cycle makes no sense from here.
bool straight_or_arc(bool arc, Roles& r, std::string* error);
bool thread(Roles& r, std::string* error);
bool groove(Roles& r, double nose_width, std::string* error);
bool shaped_groove(Roles& r, const TurnContext& context, bool face, std::string* error);
bool alternate_groove(Roles& r, const TurnContext& context, bool face, std::string* error);
bool part_off(Roles& r, const TurnContext& context, std::string* error);
/// Of the cycles "shape.thread" and "shape.corner".
std::optional<std::vector<TurnMove>> newer_signature(std::string_view cycle, const TurnNumbers& numbers,
                                                     const TurnContext& context, std::string* error);
bool relief(Roles& r, const TurnContext& context, std::string* error);
/// How far along the thread the pass of depth `h` begins: down the flank that lies behind, with a negative angle inside
/// of the V of the last pass, on its two flanks in turn.
double flank_shift(double degrees, double depth, double h, bool odd);
/// Of the metric coarse thread of a nominal diameter; 0: there is none.
double coarse_pitch(double size);
/// Of a thread by its pitch or its size.
bool thread_pitch(const TurnNumbers& numbers, double& pitch, std::string* error);
bool axial_drill(Roles& r, std::string* error);
bool stock_removal(Roles& r, const TurnContext& context, bool face, bool copy, std::string* error);
/// By the contour alone, and by the contour within a blank.
bool contour_stock(Roles& r, const TurnContext& context, bool face, std::string* error);
bool blank_stock(Roles& r, const TurnContext& context, bool face, std::string* error);
/// From a rectangle down to the contour, then its re-entrant zones.
bool reentrant_stock(Roles& r, const TurnContext& context, bool face, std::string* error);
/// Plunges side by side between the place of the tool and the end point.
bool plunged_groove(Roles& r, double nose_width, bool face, std::string* error);
/// One groove of the profile, down to the limit on the other axis.
bool groove_stock(Roles& r, const TurnContext& context, bool face, std::string* error);
bool counted_thread(Roles& r, std::string* error);
bool chained_thread(Roles& r, std::string* error);
bool chased_thread(Roles& r, std::string* error);
bool live_tool(Roles& r, bool key, std::string* error);

}  // namespace cnctrans::ir::cycles::detail
