// Stock removal against a profile of blocks: passes along an axis, or parallel to the profile.
#include <algorithm>

#include "ir/cycles/turning/remover.h"

namespace cnctrans::ir::cycles::detail {

namespace {

std::vector<ProfileElement> elements_of(const Chain& chain, const Orientation& o) {
  const auto plain = [&o](RolePoint n) {
    const RolePoint r = o.role(n);
    return o.face ? TurnPoint{r.q, r.p} : TurnPoint{r.p, r.q};
  };
  std::vector<ProfileElement> out;
  for (const auto& x : chain) out.push_back({plain(x.a), plain(x.b), x.arc, o.sense(x.ccw), plain(x.c)});
  return out;
}

/// The allowance: by axis, or constant along the profile when only the one of X is given.
std::optional<Chain> with_allowance(const Chain& part, const Roles& r, bool face, double more, std::string* error) {
  const double x = std::abs(r.number("stock_x")), z = std::abs(r.number("stock_z"));
  if (!r.has("stock_z")) {
    auto out = offset(part, x + more, error);
    if (out && out->empty()) return *error = "nothing is left of the profile with its allowance", std::nullopt;
    return out;
  }
  return shifted(part, (face ? z : x) + more, face ? x : z);
}

std::optional<Orientation> orientation(const TurnProfile& profile, const TurnContext& context, bool face,
                                       std::string* error) {
  Orientation o;
  o.face = face;
  if (leads_nowhere(profile.part)) return *error = "the profile of the cycle is empty", std::nullopt;
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

std::vector<double> levels(double top, double bottom, double step) {
  std::vector<double> out;
  for (double p = top - step; p > bottom + tiny && out.size() < most_levels; p = top - step * double(out.size() + 1))
    out.push_back(p);
  out.push_back(bottom);
  return out;
}

void leave(const TurnContext& context, const Orientation& o, const Chain* rough, const Chain* finish) {
  if (context.left == nullptr) return;
  context.left->face = o.face;
  context.left->out = o.sp;
  if (rough != nullptr) context.left->rough = elements_of(*rough, o);
  if (finish != nullptr) context.left->finish = elements_of(*finish, o);
}

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
    work.dig(outline, valleys);
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

std::optional<Chain> oriented(const TurnProfile* profile, Orientation& o, std::string* error) {
  if (profile == nullptr || leads_nowhere(profile->part))
    return *error = "the profile of the cycle is empty", std::nullopt;
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
    work.dig(outline, valleys);
    work.home();
  }
  if (finishes) work.finish(*part, r.number("finish_feed"), style.lift);
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
