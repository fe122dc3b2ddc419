// Roughing against a chain: passes at given heights, the valleys between them, and what the cycle leaves.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ir/cycles/contour.h"

namespace cnctrans::ir::cycles::detail {

/// The heights from `top` down to `bottom`: equal steps, the last takes what is left.
std::vector<double> levels(double top, double bottom, double step);
/// Tells what the cycle leaves, to who asked for it.
void leave(const TurnContext& context, const Orientation& o, const Chain* rough, const Chain* finish);
/// The part in the directions of the passes, from its low end on.
std::optional<Chain> oriented(const TurnProfile* profile, Orientation& o, std::string* error);

class Remover {
 public:
  Remover(Roles& r, const Orientation& o) : r_(r), o_(o), a_(o.role(r.here())) {
    step_ = r.number("step");
    dig_feed_ = r.number("groove_feed");
    withdraws_ = r.has("withdrawal");
    withdrawal_ = std::abs(r.number("withdrawal"));
  }
  [[nodiscard]] RolePoint start() const { return a_; }

  void passes(const Chain& outline, const Chain& blank) {
    double before = a_.p;
    heights_ = levels(a_.p, outline.front().a.p, step_);
    leaves_steps_ = withdraws_;
    for (const double p : heights_) {
      const double entry = blank.empty() ? a_.q : entry_at(blank, p);
      std::size_t at = 0;
      const double end = first_meeting(outline, p, at);
      if (entry > end + tiny) {
        rapid({p, a_.q});
        rapid({p, entry});
        feed({p, end});
        if (!withdraws_)
          follow(outline, at, before);
        else if (withdrawal_ > 0)
          rapid({p + withdrawal_, end + withdrawal_});
        rapid({here().p, a_.q});
      }
      before = p;
    }
  }

  /// Passes at given heights: along the outline afterwards, then away at 45 degrees.
  struct Style {
    bool rounds = true;
    double lift = 1, feed = 0, chip_length = 0, chip_dwell = 0;
  };
  void passes_at(const Chain& outline, double top, const std::vector<double>& heights, const Chain& blank,
                 const Style& style) {
    double before = top;
    heights_ = heights;
    leaves_steps_ = !style.rounds;
    for (const double p : heights) {
      const double entry = blank.empty() ? a_.q : entry_at(blank, p, 0);
      std::size_t at = 0;
      const double end = first_meeting(outline, p, at);
      if (entry > end + tiny) {
        rapid({p, a_.q});
        rapid({p, entry});
        broken({p, end}, style);
        if (style.rounds) follow(outline, at, before, style.feed);
        rapid({here().p + style.lift, here().q + style.lift});
        rapid({here().p, a_.q});
      }
      before = p;
    }
  }
  void feeds(double valley, double lift) {
    dig_feed_ = across_feed_ = valley;
    withdraws_ = true;
    withdrawal_ = lift;
  }
  /// Out of a valley along its other wall.
  void climbs(double valley) {
    dig_feed_ = across_feed_ = valley;
    withdraws_ = false;
  }
  void step(double s) { step_ = s; }

  /// The valleys that the passes left out, one after the other. Where a pass ended at the contour before the edge of
  /// a valley and did not follow it, stock stands from there to the edge: the way begins where that pass ended.
  void dig(const Chain& outline, const std::vector<Valley>& valleys) {
    for (const auto& v : valleys) {
      const RolePoint edge = v.chain.front().a;
      valley(v.chain, edge.p, false, leaves_steps_ ? between(outline, interruption(outline, edge), edge) : Chain{});
    }
  }

  void along(const Chain& chain, double f) {
    for (const auto& x : chain) piece(x, f);
  }
  void rapid(RolePoint n) { r_.rapid(o_.role(n)); }
  void feed(RolePoint n, double f = 0) { r_.feed(o_.role(n), f); }
  void home() {
    rapid({a_.p, here().q});
    rapid(a_);
  }
  [[nodiscard]] RolePoint here() const { return o_.role(r_.here()); }

  /// The finishing pass with radius compensation, from and back to the place of the call.
  void finish(const Chain& part, double f, double lift = 0) {
    home();
    rapid({part.front().a.p, a_.q});
    const bool left = o_.face == (o_.sp * o_.sq > 0);
    r_.act(left ? TurnStep::comp_left : TurnStep::comp_right);
    feed(part.front().a, f);
    along(part, f);
    r_.act(TurnStep::comp_off);
    if (lift > 0) rapid({here().p + lift, here().q + lift});
    home();
  }

 private:
  /// One valley, from its edge down: along the wall, across, and out again. `lead`: the way to its edge that is to be
  /// cut.
  void valley(const Chain& chain, double top, bool inside, const Chain& lead = {}) {
    const double bottom = lowest(chain);
    const double level = std::max(bottom, top - step_);
    auto parts = below(chain, level);
    if (parts.empty()) {  // the bottom itself
      const auto flat = std::find_if(chain.begin(), chain.end(), [&](const Piece& x) { return x.b.p < level + tiny; });
      auto last = flat;
      for (auto it = flat; it != chain.end(); ++it) {
        if (it->b.p < level + tiny) last = it;
      }
      pass(chain, lead, chain.front().a, flat->b, last->b, top, inside);
      return;
    }
    RolePoint from = chain.front().a;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Chain& deep = parts[k];
      if (k > 0) from = parts[k - 1].back().b;  // where the pass before was interrupted: over the ridge from there
      pass(chain, k > 0 ? Chain{} : lead, from, deep.front().a, {level, deep.back().b.q}, top, inside && k == 0);
      valley(deep, level, true);
    }
  }

  /// Where the last pass that ended before the edge met the outline; the edge itself when a pass went along it.
  [[nodiscard]] RolePoint interruption(const Chain& outline, RolePoint edge) const {
    RolePoint at = edge;
    double nearest = -std::numeric_limits<double>::infinity();
    for (const double p : heights_) {
      if (std::abs(p - edge.p) < tiny) return edge;
      if (p > edge.p || p <= nearest) continue;
      std::size_t piece = 0;
      nearest = p;
      at = {p, first_meeting(outline, p, piece)};
    }
    return at;
  }
  void piece(const Piece& x, double f) {
    if (x.arc)
      r_.arc(o_.role(x.b), o_.role(x.c), x.ccw != (o_.sp * o_.sq < 0), f);
    else
      feed(x.b, f);
  }
  /// q where a pass at this height meets the outline, and in which piece; beyond its highest point: its end.
  static double first_meeting(const Chain& outline, double p, std::size_t& at) {
    for (at = 0; at < outline.size(); ++at) {
      if (outline[at].b.p > p + tiny) return outline[at].a.p > p - tiny ? outline[at].a.q : at_height(outline[at], p).q;
    }
    return outline.back().b.q;
  }
  /// Where the pass comes into the blank, and a little before.
  [[nodiscard]] double entry_at(const Chain& blank, double p, double gap = 1) const {
    double q = lowest_q(blank);
    for (const auto& x : blank) {
      const double low = std::min(x.a.p, x.b.p), high = std::max(x.a.p, x.b.p);
      if (p > high + tiny || p < low - tiny) continue;
      q = std::max(q, high - low < tiny ? std::max(x.a.q, x.b.q) : at_height(x, p).q);
    }
    return p > highest(blank) - tiny ? lowest_q(blank) : std::min(a_.q, q + gap);
  }
  static double lowest_q(const Chain& chain) {
    double q = chain.front().a.q;
    for (const auto& x : chain) q = std::min({q, x.a.q, x.b.q});
    return q;
  }
  /// Along the outline from the end of the pass up to the height.
  void follow(const Chain& outline, std::size_t at, double height, double f = 0) {
    for (; at < outline.size(); ++at) {
      Piece x = outline[at];
      const bool reaches = x.b.p > height - tiny;
      if (x.b.p > height + tiny) x.b = at_height(x, height);
      piece(x, f);
      if (reaches) return;
    }
    feed({height, here().q}, f);
  }
  /// At feed, with a dwell after every stretch where chips are to break.
  void broken(RolePoint to, const Style& style) {
    while (style.chip_length > tiny && here().q - style.chip_length > to.q + tiny) {
      feed({to.p, here().q - style.chip_length}, style.feed);
      r_.dwell(style.chip_dwell);
    }
    feed(to, style.feed);
  }
  /// Along `lead` to `from`, down the wall to `foot`, across to `end`, and out.
  void pass(const Chain& chain, const Chain& lead, RolePoint from, RolePoint foot, RolePoint end, double top,
            bool inside) {
    const RolePoint begin = lead.empty() ? from : lead.front().a;
    rapid({inside ? std::max(here().p, begin.p) : a_.p, here().q});
    rapid({here().p, begin.q});
    rapid(begin);
    along(lead, across_feed_);
    along(between(chain, from, foot), dig_feed_);
    feed(end, across_feed_);
    if (withdraws_) {
      if (withdrawal_ > 0) rapid({end.p + withdrawal_, end.q + withdrawal_});
      return;
    }
    if (chain.back().b.p < end.p - tiny) return feed({top, end.q});  // the profile ends down there
    for (Piece x : between(chain, end, chain.back().b)) {            // up the other wall
      if (x.b.p < x.a.p - tiny || x.a.p > top - tiny) return;
      if (x.b.p > top + tiny) x.b = at_height(x, top);
      piece(x, 0);
    }
  }
  Roles& r_;
  Orientation o_;
  RolePoint a_;
  double step_ = 0, dig_feed_ = 0, across_feed_ = 0, withdrawal_ = 0;
  bool withdraws_ = false, leaves_steps_ = false;  ///< a pass that withdraws leaves a step of stock on the contour
  std::vector<double> heights_;                    ///< of the passes that were made
};

}  // namespace cnctrans::ir::cycles::detail
