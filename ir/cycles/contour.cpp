#include "ir/cycles/contour.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace cnctrans::ir::cycles::detail {

namespace {

bool same(RolePoint a, RolePoint b) {
  return std::abs(a.p - b.p) < tiny && std::abs(a.q - b.q) < tiny;
}
double radius(const Piece& x) {
  return std::hypot(x.a.p - x.c.p, x.a.q - x.c.q);
}
/// Angle of a point seen from the centre, in the sense of the arc from its start: 0 to below a full turn.
double along_arc(const Piece& x, RolePoint t) {
  const auto angle = [&x](RolePoint r) { return std::atan2(r.p - x.c.p, r.q - x.c.q); };
  double d = x.ccw ? angle(t) - angle(x.a) : angle(x.a) - angle(t);
  constexpr double turn = 2 * std::numbers::pi;
  while (d < -tiny) d += turn;
  while (d >= turn - tiny) d -= turn;
  return std::max(d, 0.0);
}
Piece part(const Piece& x, RolePoint a, RolePoint b) {
  Piece out = x;
  out.a = a;
  out.b = b;
  return out;
}
void add(Chain& out, const Piece& x) {
  if (!same(x.a, x.b)) out.push_back(x);
}
/// Direction of travel at the start or end of the piece.
RolePoint direction(const Piece& x, bool at_end) {
  const RolePoint t = at_end ? x.b : x.a;
  if (x.arc) {
    const double s = x.ccw ? 1 : -1, r = radius(x);
    return {s * (t.q - x.c.q) / r, -s * (t.p - x.c.p) / r};
  }
  const double l = std::hypot(x.b.p - x.a.p, x.b.q - x.a.q);
  return {(x.b.p - x.a.p) / l, (x.b.q - x.a.q) / l};
}
/// The way goes toward minus q with the tool above it: on the right of the way.
RolePoint outward(RolePoint d) {
  return {-d.q, d.p};
}

std::optional<Piece> moved_out(const Piece& x, double d) {
  Piece out = x;
  for (const bool end : {false, true}) {
    const RolePoint n = outward(direction(x, end));
    RolePoint& t = end ? out.b : out.a;
    t = {t.p + d * n.p, t.q + d * n.q};
  }
  if (x.arc) {
    // The tool is on the right of the way: outside of an arc that turns left, inside of one that turns right.
    const double r = radius(x) + (x.ccw ? d : -d);
    if (r < tiny) return std::nullopt;
  }
  return out;
}

/// Points common to the two pieces drawn on (lines without end, arcs as circles).
std::vector<RolePoint> meet(const Piece& u, const Piece& v) {
  std::vector<RolePoint> out;
  if (!u.arc && !v.arc) {
    const double up = u.b.p - u.a.p, uq = u.b.q - u.a.q, vp = v.b.p - v.a.p, vq = v.b.q - v.a.q;
    const double det = uq * vp - up * vq;
    if (std::abs(det) < 1e-12) return out;
    const double t = ((v.a.q - u.a.q) * vp - (v.a.p - u.a.p) * vq) / det;
    out.push_back({u.a.p + t * up, u.a.q + t * uq});
    return out;
  }
  if (u.arc && v.arc) {
    const double dp = v.c.p - u.c.p, dq = v.c.q - u.c.q, l = std::hypot(dp, dq), r = radius(u), s = radius(v);
    if (l < tiny || l > r + s + tiny || l < std::abs(r - s) - tiny) return out;
    const double x = (l * l + r * r - s * s) / (2 * l), h = std::sqrt(std::max(0.0, r * r - x * x));
    const RolePoint m{u.c.p + dp * x / l, u.c.q + dq * x / l};
    out.push_back({m.p + h * dq / l, m.q - h * dp / l});
    out.push_back({m.p - h * dq / l, m.q + h * dp / l});
    return out;
  }
  const Piece &line = u.arc ? v : u, &arc = u.arc ? u : v;
  const double dp = line.b.p - line.a.p, dq = line.b.q - line.a.q, l = std::hypot(dp, dq), r = radius(arc);
  const double t = ((arc.c.p - line.a.p) * dp + (arc.c.q - line.a.q) * dq) / (l * l);
  const RolePoint foot{line.a.p + t * dp, line.a.q + t * dq};
  const double far = std::hypot(foot.p - arc.c.p, foot.q - arc.c.q);
  if (far > r + tiny) return out;
  const double h = std::sqrt(std::max(0.0, r * r - far * far)) / l;
  out.push_back({foot.p + h * dp, foot.q + h * dq});
  out.push_back({foot.p - h * dp, foot.q - h * dq});
  return out;
}

std::optional<RolePoint> nearest(const std::vector<RolePoint>& points, RolePoint to) {
  std::optional<RolePoint> best;
  for (const auto& t : points) {
    if (!best || std::hypot(t.p - to.p, t.q - to.q) < std::hypot(best->p - to.p, best->q - to.q)) best = t;
  }
  return best;
}

/// The piece still runs the way it did.
bool keeps_sense(const Piece& before, const Piece& now) {
  if (before.arc) return along_arc(now, now.b) <= along_arc(before, before.b) + std::numbers::pi / 2;
  return (now.b.p - now.a.p) * (before.b.p - before.a.p) + (now.b.q - now.a.q) * (before.b.q - before.a.q) > -tiny;
}

}  // namespace

Chain chain_of(const std::vector<ProfileElement>& elements, const Orientation& o) {
  Chain out;
  for (const auto& e : elements) add(out, {o.in(e.from), o.in(e.to), e.arc, o.sense(e.ccw), o.in(e.centre)});
  return out;
}

Chain reversed(Chain chain) {
  std::reverse(chain.begin(), chain.end());
  for (auto& x : chain) {
    std::swap(x.a, x.b);
    x.ccw = !x.ccw;
  }
  return chain;
}

bool leads_nowhere(const std::vector<ProfileElement>& elements) {
  return std::all_of(elements.begin(), elements.end(), [](const ProfileElement& e) {
    return std::abs(e.from.x - e.to.x) < tiny && std::abs(e.from.z - e.to.z) < tiny;
  });
}

Chain split(const Chain& chain) {
  Chain out;
  for (const auto& x : chain) {
    if (!x.arc) {
      add(out, x);
      continue;
    }
    const double r = radius(x), sweep = along_arc(x, x.b);
    std::vector<std::pair<double, RolePoint>> stops;
    for (const RolePoint t :
         std::array<RolePoint, 4>{{{x.c.p + r, x.c.q}, {x.c.p - r, x.c.q}, {x.c.p, x.c.q + r}, {x.c.p, x.c.q - r}}}) {
      const double s = along_arc(x, t);
      if (s > 1e-7 && s < sweep - 1e-7) stops.emplace_back(s, t);
    }
    std::sort(stops.begin(), stops.end(), [](const auto& u, const auto& v) { return u.first < v.first; });
    RolePoint from = x.a;
    for (const auto& [s, t] : stops) {
      add(out, part(x, from, t));
      from = t;
    }
    add(out, part(x, from, x.b));
  }
  return out;
}

Chain shifted(Chain chain, double dp, double dq) {
  for (auto& x : chain) {
    for (RolePoint* t : {&x.a, &x.b, &x.c}) *t = {t->p + dp, t->q + dq};
  }
  return chain;
}

std::optional<Chain> offset(const Chain& chain, double d, std::string* error) {
  if (d < tiny) return chain;
  Chain out, kept;  // kept: the pieces of `chain` that are still there
  for (const auto& x : chain) {
    const auto moved = moved_out(x, d);
    if (!moved) continue;  // a hollow smaller than the distance disappears
    if (out.empty()) {
      out.push_back(*moved);
      kept.push_back(x);
      continue;
    }
    Piece& last = out.back();
    Piece next = *moved;
    if (same(last.b, next.a)) {
      out.push_back(next);
      kept.push_back(x);
      continue;
    }
    const RolePoint corner = x.a, u = direction(kept.back(), true), v = direction(x, false);
    const bool adjacent = same(kept.back().b, x.a);
    const bool bulges = u.q * v.p - u.p * v.q > 0;  // the way turns away from the tool
    if (adjacent && bulges) {
      Piece round{last.b, next.a, true, true, corner};
      out.push_back(round);
      out.push_back(next);
      kept.push_back(x);
      kept.push_back(x);
      continue;
    }
    const auto t = nearest(meet(last, next), adjacent ? corner : next.a);
    if (!t) return *error = "the finishing allowance does not fit into the profile", std::nullopt;
    Piece shorter = last;
    shorter.b = *t;
    next.a = *t;
    if (!keeps_sense(last, shorter) || !keeps_sense(*moved, next))
      return *error = "the finishing allowance does not fit into the profile", std::nullopt;
    last = shorter;
    out.push_back(next);
    kept.push_back(x);
  }
  Chain clean;
  for (const auto& x : out) add(clean, x);
  return clean;
}

RolePoint at_height(const Piece& x, double p) {
  if (!x.arc) return {p, x.a.q + (p - x.a.p) * (x.b.q - x.a.q) / (x.b.p - x.a.p)};
  const double r = radius(x), root = std::sqrt(std::max(0.0, r * r - (p - x.c.p) * (p - x.c.p)));
  return {p, x.c.q + ((x.a.q + x.b.q) / 2 < x.c.q ? -root : root)};
}

Chain between(const Chain& chain, RolePoint from, RolePoint to) {
  const auto holds = [](const Piece& x, RolePoint t) {
    constexpr double near = 1e-7;
    return t.q < std::max(x.a.q, x.b.q) + near && t.q > std::min(x.a.q, x.b.q) - near &&
           t.p < std::max(x.a.p, x.b.p) + near && t.p > std::min(x.a.p, x.b.p) - near;
  };
  Chain out;
  bool on = false;
  for (const auto& x : chain) {
    const bool begins = !on && holds(x, from);
    on = on || begins;
    if (!on) continue;
    const RolePoint start = begins ? from : x.a;
    const bool ends = holds(x, to) && !(begins && same(from, x.b) && !same(from, to));
    add(out, part(x, start, ends ? to : x.b));
    if (ends) break;
  }
  return out;
}

double lowest(const Chain& chain) {
  double p = chain.front().a.p;
  for (const auto& x : chain) p = std::min({p, x.a.p, x.b.p});
  return p;
}
double highest(const Chain& chain) {
  double p = chain.front().a.p;
  for (const auto& x : chain) p = std::max({p, x.a.p, x.b.p});
  return p;
}
bool goes_on(const Chain& chain) {
  return std::none_of(chain.begin(), chain.end(), [](const Piece& x) { return x.b.q > x.a.q + 1e-7; });
}

Chain bridged(const Chain& chain, std::vector<Valley>& valleys) {
  Chain out;
  std::optional<RolePoint> edge;  // of the valley that is open
  Chain inside;
  for (const auto& x : chain) {
    if (!edge && x.b.p > x.a.p - tiny) {
      out.push_back(x);
      continue;
    }
    if (!edge) edge = x.a;
    if (x.b.p < edge->p + tiny) {
      inside.push_back(x);
      if (x.b.p < edge->p - tiny) continue;
    } else {
      const RolePoint t = at_height(x, edge->p);
      add(inside, part(x, x.a, t));
    }
    const RolePoint back = inside.back().b;
    if (!same(*edge, back)) out.push_back({*edge, back, false, false, {}});
    valleys.push_back({inside});
    inside.clear();
    edge.reset();
    if (x.b.p > back.p + tiny) out.push_back(part(x, back, x.b));
  }
  if (edge) {
    const RolePoint end = inside.back().b;
    out.push_back({*edge, {edge->p, end.q}, false, false, {}});
    valleys.push_back({inside});
  }
  return out;
}

std::vector<Chain> below(const Chain& chain, double height) {
  std::vector<Chain> out;
  Chain now;
  const auto close = [&] {
    if (!now.empty()) out.push_back(std::move(now));
    now.clear();
  };
  for (const auto& x : chain) {
    const bool a = x.a.p < height - tiny, b = x.b.p < height - tiny;
    if (a && b) {
      now.push_back(x);
    } else if (a) {
      add(now, part(x, x.a, x.b.p > height + tiny ? at_height(x, height) : x.b));
      close();
    } else if (b) {
      close();
      add(now, part(x, x.a.p > height + tiny ? at_height(x, height) : x.a, x.b));
    } else {
      close();
    }
  }
  close();
  return out;
}

}  // namespace cnctrans::ir::cycles::detail
