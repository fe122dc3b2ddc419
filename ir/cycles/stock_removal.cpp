// Stock removal against a profile of blocks: passes along an axis, or parallel to the profile.
#include <algorithm>

#include "ir/cycles/blank_points.h"
#include "ir/cycles/contour.h"

namespace cnctrans::ir::cycles::detail {

namespace {

constexpr std::size_t most_levels = 100'000;

/// The heights from `top` down to `bottom`: equal steps, the last takes what is left.
std::vector<double> levels(double top, double bottom, double step) {
  std::vector<double> out;
  for (double p = top - step; p > bottom + tiny && out.size() < most_levels; p = top - step * double(out.size() + 1))
    out.push_back(p);
  out.push_back(bottom);
  return out;
}

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
    for (const double p : levels(a_.p, outline.front().a.p, step_)) {
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
  void step(double s) { step_ = s; }

  /// One valley, from its edges down: along the wall, across, and out again.
  void valley(const Chain& chain, double top, bool inside) {
    const double bottom = lowest(chain);
    const double level = std::max(bottom, top - step_);
    auto parts = below(chain, level);
    if (parts.empty()) {  // the bottom itself
      const auto flat = std::find_if(chain.begin(), chain.end(), [&](const Piece& x) { return x.b.p < level + tiny; });
      auto last = flat;
      for (auto it = flat; it != chain.end(); ++it) {
        if (it->b.p < level + tiny) last = it;
      }
      pass(chain, chain.front().a, flat->b, last->b, top, inside);
      return;
    }
    RolePoint from = chain.front().a;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Chain& deep = parts[k];
      if (k > 0) from = ridge(chain, parts[k - 1].back().b.q, deep.front().a.q);
      pass(chain, from, deep.front().a, {level, deep.back().b.q}, top, inside && k == 0);
      valley(deep, level, true);
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
  /// Down the wall from `from` to `foot`, across to `end`, and out.
  void pass(const Chain& chain, RolePoint from, RolePoint foot, RolePoint end, double top, bool inside) {
    if (inside) {
      rapid({std::max(here().p, from.p), here().q});
      rapid({here().p, from.q});
    } else {
      rapid({a_.p, here().q});
      rapid({a_.p, from.q});
    }
    rapid(from);
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
  static RolePoint ridge(const Chain& chain, double from, double to) {
    RolePoint best = chain.front().a;
    bool found = false;
    for (const auto& x : chain) {
      for (const RolePoint t : {x.a, x.b}) {
        if (t.q > from + tiny || t.q < to - tiny || (found && t.p <= best.p)) continue;
        best = t;
        found = true;
      }
    }
    return best;
  }

  Roles& r_;
  Orientation o_;
  RolePoint a_;
  double step_ = 0, dig_feed_ = 0, across_feed_ = 0, withdrawal_ = 0;
  bool withdraws_ = false;
};

std::vector<ProfileElement> elements_of(const Chain& chain, const Orientation& o) {
  const auto plain = [&o](RolePoint n) {
    const RolePoint r = o.role(n);
    return o.face ? TurnPoint{r.q, r.p} : TurnPoint{r.p, r.q};
  };
  std::vector<ProfileElement> out;
  for (const auto& x : chain) out.push_back({plain(x.a), plain(x.b), x.arc, o.sense(x.ccw), plain(x.c)});
  return out;
}

/// Tells what the cycle leaves, to who asked for it.
void leave(const TurnContext& context, const Orientation& o, const Chain* rough, const Chain* finish) {
  if (context.left == nullptr) return;
  context.left->face = o.face;
  context.left->out = o.sp;
  if (rough != nullptr) context.left->rough = elements_of(*rough, o);
  if (finish != nullptr) context.left->finish = elements_of(*finish, o);
}

/// The allowance: by axis, or constant along the profile when only the one of X is given.
std::optional<Chain> with_allowance(const Chain& part, const Roles& r, bool face, double more, std::string* error) {
  const double x = std::abs(r.number("stock_x")), z = std::abs(r.number("stock_z"));
  if (!r.has("stock_z")) return offset(part, x + more, error);
  return shifted(part, (face ? z : x) + more, face ? x : z);
}

std::optional<Orientation> orientation(const TurnProfile& profile, const TurnContext& context, bool face,
                                       std::string* error) {
  Orientation o;
  o.face = face;
  if (profile.part.empty()) return *error = "the profile of the cycle is empty", std::nullopt;
  const Chain plain = split(chain_of(profile.part, o));
  const RolePoint a = o.in(context.start);
  if (a.p < highest(plain) - tiny) {
    if (a.p > lowest(plain) + tiny)
      return *error = "wrong tool position for the cycle: the tool does not stand outside of the profile", std::nullopt;
    o.sp = -1;
  }
  const RolePoint first = plain.front().a, last = plain.back().b;
  const RolePoint low = o.sp * first.p <= o.sp * last.p ? first : last;
  const RolePoint high = o.sp * first.p <= o.sp * last.p ? last : first;
  const double way = std::abs(low.q - high.q) > tiny ? low.q - high.q : a.q - low.q;
  o.sq = way < 0 ? -1 : 1;
  return o;
}

/// The blank up to the ends of the part: where the two profiles begin or end apart, what lies below the blank's own
/// first (last) point reaches to the straight line between both.
Chain closed_blank(const TurnProfile& profile, const Orientation& o) {
  if (profile.blank.empty()) return {};
  std::vector<ProfileElement> lines = profile.blank;
  const TurnPoint first = lines.front().from, last = lines.back().to;
  TurnPoint head = profile.part.front().from, tail = profile.part.back().to;
  const auto far = [](TurnPoint u, TurnPoint v) { return std::hypot(u.x - v.x, u.z - v.z); };
  if (far(first, tail) + far(last, head) < far(first, head) + far(last, tail)) std::swap(head, tail);
  if (far(head, first) > tiny) lines.insert(lines.begin(), {head, first, false, false, {}});
  if (far(last, tail) > tiny) lines.push_back({last, tail, false, false, {}});
  return split(chain_of(lines, o));
}

/// Back from the end of a pass in one rapid, unless the way would cross the profile.
bool clear_way(const Chain& pass, RolePoint home) {
  const RolePoint end = pass.back().b;
  for (const auto& x : pass) {
    constexpr int parts = 16;
    for (int k = 0; k < parts; ++k) {
      const double p = x.a.p + (x.b.p - x.a.p) * k / parts;
      const RolePoint t = std::abs(x.b.p - x.a.p) < tiny ? x.a : at_height(x, p);
      if (std::abs(home.q - end.q) < tiny) return true;
      const double line = end.p + (home.p - end.p) * (t.q - end.q) / (home.q - end.q);
      if (line < t.p - tiny) return false;
    }
  }
  return true;
}

/// An allowance below zero asks for a finishing pass with rounded corners, given ones above it for sharp corners.
bool sharp_finish(const Roles& r) {
  const double x = r.number("stock_x"), z = r.number("stock_z");
  return x >= 0 && z >= 0 && x + z > 0;
}

bool copies(Roles& r, Remover& work, const Chain& part, bool face, std::string* error) {
  const double total = r.number("total"), step = r.number("step");
  const double stock = face && r.has("stock_z") ? std::abs(r.number("stock_z")) : std::abs(r.number("stock_x"));
  if (r.number("section") != 0) return *error = "roughing in sections is not carried out", false;
  if (work.start().p < highest(part) + total - tiny)
    return *error = "wrong tool position for the cycle: the tool stands within the stock", false;
  if (total > stock + tiny) {
    for (const double left : levels(total, stock, step)) {
      const auto pass = with_allowance(part, r, face, left - stock, error);
      if (!pass) return false;
      work.rapid(pass->front().a);
      work.along(*pass, 0);
      if (!clear_way(*pass, work.start())) work.rapid({work.start().p, work.here().q});
      work.rapid(work.start());
    }
  }
  return true;
}

}  // namespace

bool stock_removal(Roles& r, const TurnContext& context, bool face, bool copy, std::string* error) {
  if (context.profile == nullptr) return *error = "the profile of the cycle is not known", false;
  if (r.number("step") <= 0) return *error = "the pass of the cycle is not greater than zero", false;
  const auto o = orientation(*context.profile, context, face, error);
  if (!o) return false;
  const Chain programmed = split(chain_of(context.profile->part, *o));
  const bool back = programmed.front().a.p > programmed.back().b.p + tiny;
  const Chain part = back ? reversed(programmed) : programmed;
  if (!goes_on(part)) return *error = "a profile that turns back along the pass is not carried out", false;
  Remover work(r, *o);
  const bool finishes = r.number("finish_feed") > 0;
  if (copy) {
    const auto last = with_allowance(part, r, face, 0, error);
    if (!last) return false;
    leave(context, *o, &*last, finishes ? &part : nullptr);
    if (!copies(r, work, part, face, error)) return false;
  } else {
    const auto rough = with_allowance(part, r, face, 0, error);
    if (!rough) return false;
    const Chain target = split(*rough);
    leave(context, *o, &target, finishes ? &part : nullptr);
    double nearest = target.front().a.q;
    for (const auto& x : target) nearest = std::max({nearest, x.a.q, x.b.q});
    if (work.start().q < nearest - tiny || work.start().p < highest(target) - tiny)
      return *error = "wrong tool position for the cycle: the tool stands within the allowance", false;
    if (r.number("section") != 0) return *error = "roughing in sections is not carried out", false;
    std::vector<Valley> valleys;
    const Chain outline = bridged(target, valleys);
    work.passes(outline, closed_blank(*context.profile, *o));
    for (const auto& v : valleys) work.valley(v.chain, v.chain.front().a.p, false);
    if (!valleys.empty()) work.rapid({work.start().p, work.here().q});
    work.rapid(work.start());
    if (const double f = r.number("rough_feed"); f > 0) {
      work.rapid({target.front().a.p, work.start().q});
      work.feed(target.front().a, f);
      work.along(target, f);
      work.home();
    }
  }
  r.sharp(sharp_finish(r));
  if (finishes) work.finish(part, r.number("finish_feed"));
  return true;
}

/// The part in the directions of the passes, from its low end on.
static std::optional<Chain> oriented(const TurnProfile* profile, Orientation& o, std::string* error) {
  if (profile == nullptr || profile->part.empty()) return *error = "the profile of the cycle is empty", std::nullopt;
  o.sq = 1;
  Chain chain = split(chain_of(profile->part, o));
  RolePoint low = chain.front().a, high = chain.back().b;
  if (low.p > high.p) std::swap(low, high);
  if (low.q < high.q) {
    o.sq = -1;
    chain = split(chain_of(profile->part, o));
  }
  if (chain.front().a.p > chain.back().b.p + tiny) chain = reversed(chain);
  if (!goes_on(chain)) return *error = "a profile that turns back along the pass is not carried out", std::nullopt;
  return chain;
}

bool contour_stock(Roles& r, const TurnContext& context, bool face, std::string* error) {
  const int variant = static_cast<int>(std::clamp(r.number("variant"), 0.0, 1e6)), kind = variant % 100;
  if (kind < 1 || kind > 12) return *error = "the kind of machining of the cycle is 1 to 12", false;
  const bool roughs = kind <= 4 || kind >= 9, finishes = kind >= 5, inside = (kind - 1) % 4 >= 2;
  Orientation o;
  o.face = face;
  o.sp = inside && !face ? -1 : 1;
  const auto part = oriented(context.profile, o, error);
  if (!part) return false;
  const double stock_x = std::abs(r.number("stock_x")), stock_z = std::abs(r.number("stock_z"));
  const auto even = offset(*part, std::abs(r.number("stock")), error);
  if (!even) return false;
  const Chain target = split(shifted(*even, face ? stock_z : stock_x, face ? stock_x : stock_z));
  leave(context, o, roughs ? &target : nullptr, finishes ? &*part : nullptr);
  Remover::Style style;
  style.rounds = variant / 100 != 2;
  if (r.number("withdrawal") != 0) style.lift = std::abs(r.number("withdrawal"));
  style.feed = r.number("rough_feed");
  style.chip_length = std::abs(r.number("chip_length"));
  style.chip_dwell = r.number("chip_dwell");
  // The cycle finds its own start: outside of the contour and its allowance, and 1 mm more.
  const double clearance = r.number("clearance", 1);
  double nearest = target.front().a.q;
  for (const auto& x : target) nearest = std::max({nearest, x.a.q, x.b.q});
  const double top = highest(target);
  r.rapid(o.role({top + clearance, nearest + clearance}));
  Remover work(r, o);
  if (roughs) {
    const double most = std::abs(r.number("step"));
    if (most < tiny) return *error = "the pass of the cycle is not greater than zero", false;
    std::vector<Valley> valleys;
    const Chain outline = bridged(target, valleys);
    const double bottom = outline.front().a.p, n = std::ceil((top - bottom) / most - tiny);
    if (n > 100'000) return *error = "the cycle has too many passes", false;
    std::vector<double> heights;
    for (double k = 1; k <= n; ++k) heights.push_back(k == n ? bottom : top - (top - bottom) * k / n);
    work.passes_at(outline, top, heights, {}, style);
    work.feeds(r.number("groove_feed"), style.lift);
    work.step(most);
    for (const auto& v : valleys) work.valley(v.chain, v.chain.front().a.p, false);
    work.home();
  }
  if (finishes) work.finish(*part, r.number("finish_feed"), style.lift);
  return true;
}

/// The blank lies below the part (a bore): on which side of the profile the area between both is. `lines`: the blank,
/// closed toward the ends of the profile.
static bool below_part(const std::vector<ProfileElement>& part, const std::vector<ProfileElement>& lines,
                       const Orientation& o) {
  std::vector<RolePoint> way;
  for (const auto& e : part) way.push_back(o.in(e.from));
  way.push_back(o.in(part.back().to));
  const double run = way.back().q - way.front().q;
  const std::size_t edge = way.size();
  for (std::size_t k = 1; k < lines.size(); ++k) way.push_back(o.in(lines[k].from));
  const RolePoint last = o.in(part.back().to), first = o.in(lines.front().from);
  if (std::hypot(last.p - first.p, last.q - first.q) > tiny)
    std::reverse(way.begin() + static_cast<std::ptrdiff_t>(edge), way.end());
  double area = 0;
  for (std::size_t k = 0; k < way.size(); ++k) {
    const RolePoint a = way[k], b = way[(k + 1) % way.size()];
    area += a.q * b.p - b.q * a.p;
  }
  return area * run < -tiny;
}

bool blank_stock(Roles& r, const TurnContext& context, bool face, std::string* error) {
  const double step = std::abs(r.number(face ? "axial_step" : "step"));
  if (step < tiny) return *error = "the pass of the cycle is not greater than zero", false;
  std::vector<TurnPoint> points;
  for (std::size_t k = 1; k <= most_blank_points && r.has(blank_name('x', k)); ++k)
    points.push_back({r.number(blank_name('x', k)), r.number(blank_name('z', k))});
  if (points.size() < 2) return *error = "the blank of the cycle needs two points", false;
  std::vector<ProfileElement> lines;
  for (std::size_t k = 1; k < points.size(); ++k) lines.push_back({points[k - 1], points[k], false, false, {}});
  Orientation o;
  o.face = face;
  if (context.profile == nullptr || context.profile->part.empty())
    return *error = "the profile of the cycle is empty", false;
  const std::vector<ProfileElement> own = lines;
  // The blank closes toward the ends of the profile.
  TurnPoint head = context.profile->part.front().from, tail = context.profile->part.back().to;
  const auto far = [](TurnPoint u, TurnPoint v) { return std::hypot(u.x - v.x, u.z - v.z); };
  if (far(points.back(), head) + far(points.front(), tail) > far(points.back(), tail) + far(points.front(), head))
    std::swap(head, tail);
  lines.insert(lines.begin(), {tail, points.front(), false, false, {}});
  lines.push_back({points.back(), head, false, false, {}});
  o.sp = below_part(context.profile->part, lines, o) ? -1 : 1;
  const auto part = oriented(context.profile, o, error);
  if (!part) return false;
  const double x = r.number("stock_x"), z = r.number("stock_z");  // signed along the axes
  const Chain target = shifted(*part, o.sp * (face ? z : x), o.sq * (face ? x : z)), blank = chain_of(lines, o);
  std::vector<Valley> left;  // those are for other cycles
  const Chain outline = bridged(target, left);
  leave(context, o, &outline, nullptr);
  Remover work(r, o);
  // What the profile adds beyond the blank's own points is no material: the tool may stand there.
  const double material = highest(chain_of(own, o)), bottom = outline.front().a.p;
  const double top = work.start().p < highest(blank) - tiny ? material : highest(blank);
  if (work.start().p < material - tiny)
    return *error = "wrong tool position for the cycle: the tool stands within the blank", false;
  if (top > bottom + tiny) {
    Remover::Style style;
    work.passes_at(outline, top, levels(top, bottom, step), blank, style);
  }
  work.rapid({work.start().p, work.here().q});
  work.rapid(work.start());
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
