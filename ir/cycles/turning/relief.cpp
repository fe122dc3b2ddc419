// Undercuts at a shoulder: DIN 509 E and F, thread undercuts DIN 76 A to D. One cut along the contour.
#include <algorithm>
#include <array>
#include <numbers>

#include "base/saturate.h"
#include "ir/cycles/contour.h"
#include "ir/cycles/turning/relief_tables.h"

namespace cnctrans::ir::cycles::detail {

namespace {

double in_radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// The contour of an undercut: p 0 on the finished surface, q 0 on the face.
struct Relief {
  Chain chain;
  double entry = 0;  ///< slope of the first line, radians
};

void line(Chain& out, RolePoint to) {
  const RolePoint from = out.back().b;
  if (std::hypot(to.p - from.p, to.q - from.q) > tiny) out.push_back({from, to, false, false, {}});
}
/// The tool goes into the material here, so hollows are the only corners: their arcs turn right.
void hollow(Chain& out, RolePoint to, RolePoint centre) {
  out.push_back({out.back().b, to, true, false, centre});
}

Relief shoulder(const ShoulderRelief& d, bool face) {
  Relief r;
  r.entry = in_radians(shoulder_slope);
  const double wall = face ? -d.face : 0;
  r.chain.push_back({{0, d.length}, {-d.depth, d.length - d.depth / std::tan(r.entry)}, false, false, {}});
  line(r.chain, {-d.depth, wall + d.radius});
  const RolePoint c{-d.depth + d.radius, wall + d.radius};
  if (!face) {
    hollow(r.chain, {c.p, wall}, c);
    return r;
  }
  const double tilt = in_radians(face_slope);
  const RolePoint leaves{c.p + d.radius * std::sin(tilt), c.q - d.radius * std::cos(tilt)};
  hollow(r.chain, leaves, c);
  line(r.chain, {leaves.p - leaves.q / std::tan(tilt), 0});
  return r;
}

/// `height`: of the thread's inner diameter in a bore, above the nominal one.
Relief thread_end(const ThreadRelief& d, double length, double depth, double height) {
  Relief r;
  r.entry = in_radians(thread_slope);
  const double trim = d.radius * std::tan(r.entry / 2), foot = length - (height + depth) / std::tan(r.entry);
  const RolePoint before{-depth + trim * std::sin(r.entry), foot + trim * std::cos(r.entry)};
  r.chain.push_back({{height, length}, before, false, false, {}});
  hollow(r.chain, {-depth, foot - trim}, {-depth + d.radius, foot - trim});
  line(r.chain, {-depth, d.radius});
  hollow(r.chain, {-depth + d.radius, 0}, {-depth + d.radius, d.radius});
  if (-depth + d.radius < height) line(r.chain, {height, 0});
  return r;
}

/// Quadrant of the tool's tip: said by the cycle as a quadrant, as a position, or by the tool.
int quadrant(const Roles& r, const TurnContext& context, char form, std::string* error) {
  constexpr std::array by_position{4, 3, 1, 2};  // outside +Z, outside -Z, inside +Z, inside -Z
  const int position = saturate<int>(r.number("position", -1)), said = saturate<int>(r.number("quadrant"));
  if (r.has("position")) {
    if (position >= 0 && position < 4) return by_position[static_cast<std::size_t>(position)];
    *error = "the position of the undercut is 0 to 3";
    return 0;
  }
  const int edge = said != 0 ? said : context.edge;
  if (edge >= 1 && edge <= 4) return edge;
  if (edge == 0 && context.usual_relief) return form == 'C' || form == 'D' ? 2 : 3;
  *error = "the side of the undercut follows from the edge of the tool: \"nose\" (1 to 4) of the tool in the profile";
  return 0;
}

std::optional<Relief> relief_of(const Roles& r, double diameter, char form, bool inside, std::string* error) {
  if (form == 'E' || form == 'F') {
    // The newer call chooses the size by a number; without it that of 0 is meant, which is also the one of these
    // diameters.
    if (r.has("position") && (diameter <= 18 || diameter > 80))
      return *error = "an undercut whose size does not follow from its diameter is not carried out", std::nullopt;
    if (diameter < 3 - tiny) return *error = "the diameter of the undercut is below 3 mm", std::nullopt;
    const auto row = std::find_if(shoulder_reliefs.begin(), shoulder_reliefs.end(),
                                  [&](const auto& d) { return diameter <= d.up_to + tiny; });
    return shoulder(*row, form == 'F');
  }
  if (r.has("position"))
    return *error = "a thread undercut whose pitch is chosen by number is not carried out", std::nullopt;
  const double pitch = coarse_pitch(diameter);
  const auto row = std::find_if(thread_reliefs.begin(), thread_reliefs.end(),
                                [&](const auto& d) { return std::abs(d.pitch - pitch) < tiny; });
  if (form < 'A' || form > 'D') return *error = "the form of the undercut is A, B, C, D, E or F", std::nullopt;
  if (row == thread_reliefs.end())
    return *error = "no metric coarse thread has the diameter of the undercut", std::nullopt;
  if (inside != (form > 'B')) return *error = "forms A and B are undercuts outside, C and D in a bore", std::nullopt;
  const double length = form == 'A' ? row->a : form == 'B' ? row->b : form == 'C' ? row->c : row->d;
  constexpr double core = 0.541266;  // DIN 13: (D - D1) / 2 in pitches
  return inside ? thread_end(*row, length, row->more / 2, core * pitch) : thread_end(*row, length, row->less / 2, 0);
}

}  // namespace

bool relief(Roles& r, const TurnContext& context, std::string* error) {
  const char form = static_cast<char>(std::clamp(r.number("form"), 0.0, 127.0));
  const int edge = quadrant(r, context, form, error);
  if (edge == 0) return false;
  Orientation o;
  o.sp = edge <= 2 ? -1 : 1;
  o.sq = edge == 2 || edge == 3 ? 1 : -1;
  const double radius = r.has("nominal") ? r.number("nominal") / 2 : r.number("x");
  const auto shape = relief_of(r, 2 * radius, form, edge <= 2, error);
  if (!shape) return false;
  const double clearance = r.number("clearance") != 0 ? std::abs(r.number("clearance")) : 1,
               f = r.number("finish_feed");
  const Chain chain = shifted(shape->chain, o.sp * radius, o.sq * r.number("z"));
  // In along the slope drawn out, away at 45 degrees.
  const RolePoint first = chain.front().a, last = chain.back().b;
  const RolePoint start{first.p + clearance, first.q + clearance / std::tan(shape->entry)};
  r.rapid(o.role(start));
  r.act(o.sp * o.sq < 0 ? TurnStep::comp_left : TurnStep::comp_right);
  r.feed(o.role(first), f);
  for (const auto& x : chain) {
    if (x.arc)
      r.arc(o.role(x.b), o.role(x.c), x.ccw != (o.sp * o.sq < 0), f);
    else
      r.feed(o.role(x.b), f);
  }
  r.act(TurnStep::comp_off);
  r.rapid(o.role({last.p + clearance, last.q + clearance}));
  r.rapid(o.role(start));
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
