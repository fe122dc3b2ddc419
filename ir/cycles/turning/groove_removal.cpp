// Roughing of one groove of a profile: levels below the place of the call, entered along a line at a given angle.
#include <algorithm>
#include <numbers>

#include "base/noise.h"
#include "ir/cycles/contour.h"

namespace cnctrans::ir::cycles::detail {

namespace {

constexpr double groove_lift = 1;

/// Height of the piece at q; both ends count of one that stands upright.
double height(const Piece& x, double q) {
  if (std::abs(x.a.q - x.b.q) < tiny) return std::max(x.a.p, x.b.p);
  if (!x.arc) return x.a.p + (q - x.a.q) * (x.b.p - x.a.p) / (x.b.q - x.a.q);
  const double r = std::hypot(x.a.p - x.c.p, x.a.q - x.c.q);
  const double root = std::sqrt(std::max(0.0, r * r - (q - x.c.q) * (q - x.c.q)));
  return x.c.p + ((x.a.p + x.b.p) / 2 < x.c.p ? -root : root);
}

class GrooveRemover {
 public:
  GrooveRemover(Roles& r, const Orientation& o, const Chain& target, double limit, RolePoint slope)
      : r_(r), o_(o), target_(target), start_(o.role(r.here())), limit_(limit), slope_(slope) {}

  bool levels(double step, std::string* error) {
    const double bottom = floor();
    RolePoint before = start_;
    for (std::size_t k = 1; before.p > bottom + tiny; ++k) {
      if (k > most_levels) return *error = "the cycle has too many passes", false;
      const double p = std::max(bottom, start_.p - step * static_cast<double>(k));
      const RolePoint entry{p, std::min(on_line(p), free_from(p))};
      const double end = std::max(limit_, wall(entry));
      if (end > entry.q - tiny) break;
      if (k > 1) {
        const double above = std::min(before.p + groove_lift, start_.p);
        rapid({above, here().q});
        rapid({above, std::min(on_line(above), free_from(above))});
      }
      if (!enter(before, entry)) return *error = "the entry line of the cycle runs into the profile", false;
      feed({p, end});
      rapid({p + groove_lift, end + groove_lift});
      before = entry;
    }
    if (before.p > start_.p - tiny) return *error = "below the place of the tool there is nothing to remove", false;
    rapid({start_.p, here().q});
    rapid(start_);
    return true;
  }

 private:
  [[nodiscard]] RolePoint here() const { return o_.role(r_.here()); }
  void rapid(RolePoint n) { r_.rapid(o_.role(n)); }
  void feed(RolePoint n) { r_.feed(o_.role(n)); }

  [[nodiscard]] double on_line(double p) const {
    const double q = start_.q + (p - start_.p) * slope_.q / slope_.p;
    return without_noise(q);
  }
  /// The deepest place between the tool and the limit.
  [[nodiscard]] double floor() const {
    double lowest = start_.p;
    for (const auto& x : target_) {
      if (x.b.q > start_.q - tiny || x.a.q < limit_ + tiny) continue;
      const double from = std::min(x.a.q, start_.q), to = std::max(x.b.q, limit_);
      const bool upright = x.a.q - x.b.q < tiny;
      lowest = std::min(lowest, upright ? std::min(x.a.p, x.b.p) : std::min(height(x, from), height(x, to)));
    }
    return lowest;
  }
  /// From where on the height p is free, coming from the start.
  [[nodiscard]] double free_from(double p) const {
    for (const auto& x : target_) {
      if (x.b.q > start_.q - tiny || (x.a.p > p + tiny && x.b.p > p + tiny)) continue;
      return std::min(start_.q, x.a.p > p + tiny ? at_height(x, p).q : x.a.q);
    }
    return limit_;
  }
  /// Where a pass from the entry meets the profile.
  [[nodiscard]] double wall(RolePoint entry) const {
    for (const auto& x : target_) {
      if (x.b.q > entry.q - tiny || x.b.p < entry.p + tiny) continue;
      return x.a.p > entry.p - tiny ? std::min(x.a.q, entry.q) : at_height(x, entry.p).q;
    }
    return limit_;
  }
  /// Down to the entry, along the line or straight where the profile bounds it.
  bool enter(RolePoint before, RolePoint entry) {
    if (here().q < on_line(here().p) - tiny) feed(before);  // the profile bounded the level before
    const RolePoint from = here();
    for (const auto& x : target_) {
      constexpr int parts = 16;
      for (int k = 0; k <= parts; ++k) {
        const double q = x.a.q + (x.b.q - x.a.q) * k / parts;
        if (q > from.q - tiny || q < entry.q + tiny || from.q - entry.q < tiny) continue;
        const double way = entry.p + (from.p - entry.p) * (q - entry.q) / (from.q - entry.q);
        if (height(x, q) > way + 1e-6) return false;
      }
    }
    feed(entry);
    return true;
  }

  Roles& r_;
  Orientation o_;
  const Chain& target_;
  RolePoint start_;
  double limit_;
  RolePoint slope_;  ///< direction of the entry line
};

}  // namespace

bool groove_stock(Roles& r, const TurnContext& context, bool face, std::string* error) {
  const double step = std::abs(r.number(face ? "axial_step" : "step"));
  if (step < tiny) return *error = "the pass of the cycle is not greater than zero", false;
  if (context.profile == nullptr || leads_nowhere(context.profile->part))
    return *error = "the profile of the cycle is empty", false;
  const double angle = r.number("entry_angle") * std::numbers::pi / 180;
  const double along_z = std::cos(angle), along_x = std::sin(angle);
  const double limit = r.number(face ? "limit_x" : "limit_z");
  Orientation o;
  o.face = face;
  RolePoint slope{face ? along_z : along_x, face ? along_x : along_z};
  o.sp = slope.p < 0 ? 1 : -1;
  o.sq = (face ? context.start.x : context.start.z) >= limit ? 1 : -1;
  slope = o.role(slope);
  if (std::abs(slope.p) < 1e-6 || slope.q > tiny)
    return *error = "the entry line of the cycle does not lead into the groove", false;
  Chain chain = split(chain_of(context.profile->part, o));
  if (chain.front().a.q < chain.back().b.q) chain = reversed(chain);
  if (!goes_on(chain)) return *error = "a profile that turns back along the pass is not carried out", false;
  const double x = r.number("stock_x"), z = r.number("stock_z");  // signed along the axes
  const Chain target = shifted(chain, o.sp * (face ? z : x), o.sq * (face ? x : z));
  return GrooveRemover(r, o, target, o.sq * limit, slope).levels(step, error);
}

}  // namespace cnctrans::ir::cycles::detail
