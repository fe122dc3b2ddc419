// Roughing of the area between a blank and a profile.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ir/cycles/blank_points.h"
#include "ir/cycles/turning/remover.h"

namespace cnctrans::ir::cycles::detail {

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

namespace {

/// The profile with its allowances within a blank, in the directions of the passes.
struct Task {
  Orientation o;
  Chain target, blank;
  double material = 0;  ///< height of the blank's own points
};

/// `points`: the blank, which closes toward the ends of the profile.
std::optional<Task> task_of(const Roles& r, const TurnContext& context, bool face, const std::vector<TurnPoint>& points,
                            std::string* error) {
  if (context.profile == nullptr || leads_nowhere(context.profile->part))
    return *error = "the profile of the cycle is empty", std::nullopt;
  std::vector<ProfileElement> lines;
  for (std::size_t k = 1; k < points.size(); ++k) lines.push_back({points[k - 1], points[k], false, false, {}});
  Task t;
  t.o.face = face;
  const std::vector<ProfileElement> own = lines;
  TurnPoint head = context.profile->part.front().from, tail = context.profile->part.back().to;
  const auto far = [](TurnPoint u, TurnPoint v) { return std::hypot(u.x - v.x, u.z - v.z); };
  if (far(points.back(), head) + far(points.front(), tail) > far(points.back(), tail) + far(points.front(), head))
    std::swap(head, tail);
  lines.insert(lines.begin(), {tail, points.front(), false, false, {}});
  lines.push_back({points.back(), head, false, false, {}});
  t.o.sp = below_part(context.profile->part, lines, t.o) ? -1 : 1;
  const auto part = oriented(context.profile, t.o, error);
  if (!part) return std::nullopt;
  const double x = r.number("stock_x"), z = r.number("stock_z");  // signed along the axes
  t.target = shifted(*part, t.o.sp * (face ? z : x), t.o.sq * (face ? x : z));
  t.blank = chain_of(lines, t.o);
  t.material = highest(chain_of(own, t.o));
  return t;
}

/// The passes above the outline, from the blank inwards.
bool passes_of(const Task& t, const Chain& outline, Remover& work, double step, const Remover::Style& style,
               std::string* error) {
  // What the profile adds beyond the blank's own points is no material: the tool may stand there.
  const double bottom = outline.front().a.p;
  const double top = work.start().p < highest(t.blank) - tiny ? t.material : highest(t.blank);
  if (work.start().p < t.material - tiny)
    return *error = "wrong tool position for the cycle: the tool stands within the blank", false;
  if (top > bottom + tiny) work.passes_at(outline, top, levels(top, bottom, step), t.blank, style);
  return true;
}

/// The tool comes down no wall of the valley that is steeper than the angle.
bool enters_at(const Chain& valley, double degrees) {
  constexpr int parts = 16;
  const double most = std::abs(degrees) * std::numbers::pi / 180 + 1e-6;
  for (const auto& x : valley) {
    if (x.b.p > x.a.p - tiny) continue;
    RolePoint from = x.a;
    for (int k = 1; k <= parts; ++k) {
      const RolePoint to = k == parts ? x.b : at_height(x, x.a.p + (x.b.p - x.a.p) * k / parts);
      if (std::atan2(from.p - to.p, from.q - to.q) > most) return false;
      from = to;
    }
  }
  return true;
}

}  // namespace

bool blank_stock(Roles& r, const TurnContext& context, bool face, std::string* error) {
  const double step = std::abs(r.number(face ? "axial_step" : "step"));
  if (step < tiny) return *error = "the pass of the cycle is not greater than zero", false;
  std::vector<TurnPoint> points;
  for (std::size_t k = 1; k <= most_blank_points && r.has(blank_name('x', k)); ++k)
    points.push_back({r.number(blank_name('x', k)), r.number(blank_name('z', k))});
  if (points.size() < 2) return *error = "the blank of the cycle needs two points", false;
  const auto task = task_of(r, context, face, points, error);
  if (!task) return false;
  std::vector<Valley> left;  // those are for other cycles
  const Chain outline = bridged(task->target, left);
  leave(context, task->o, &outline, nullptr);
  Remover work(r, task->o);
  if (!passes_of(*task, outline, work, step, {}, error)) return false;
  work.rapid({work.start().p, work.here().q});
  work.rapid(work.start());
  return true;
}

bool reentrant_stock(Roles& r, const TurnContext& context, bool face, std::string* error) {
  const double step = std::abs(r.number(face ? "axial_step" : "step"));
  if (step < tiny) return *error = "the pass of the cycle is not greater than zero", false;
  if (context.profile == nullptr || leads_nowhere(context.profile->part))
    return *error = "the profile of the cycle is empty", false;
  // The blank is the rectangle between its corner and the end of the profile that is farthest from it.
  const TurnPoint corner{r.number("x_2"), r.number("z_2")};
  TurnPoint end = corner;
  for (const auto& e : context.profile->part) {
    for (const TurnPoint t : {e.from, e.to}) {
      if (std::abs(t.x - corner.x) > std::abs(end.x - corner.x)) end.x = t.x;
      if (std::abs(t.z - corner.z) > std::abs(end.z - corner.z)) end.z = t.z;
    }
  }
  if (std::abs(end.x - corner.x) < tiny || std::abs(end.z - corner.z) < tiny)
    return *error = "the corner of the blank lies on the profile: there is nothing to remove", false;
  const auto task = task_of(r, context, face, {{corner.x, end.z}, corner, {end.x, corner.z}}, error);
  if (!task) return false;
  const RolePoint outside = task->o.in(corner);
  for (const auto& e : context.profile->part) {
    for (const RolePoint t : {task->o.in(e.from), task->o.in(e.to)}) {
      if (t.p > outside.p + tiny || t.q > outside.q + tiny)
        return *error = "the profile of the cycle leaves the blank beyond its corner", false;
    }
  }
  Remover::Style style;
  if (r.has("withdrawal")) style.lift = std::abs(r.number("withdrawal"));
  if (r.number("variant") == 0) {
    r.rapid(task->o.role({outside.p + style.lift, outside.q + style.lift}));
  } else if (std::isnan(context.start.x + context.start.z)) {
    return *error = "the place of the tool before it is not known here", false;
  }
  std::vector<Valley> valleys;
  const Chain target = split(task->target), outline = bridged(target, valleys);
  for (const auto& v : valleys) {
    if (r.has("entry_angle") && !enters_at(v.chain, r.number("entry_angle")))
      return *error = "a re-entrant zone whose wall is steeper than the angle of entry is not carried out", false;
  }
  Remover work(r, task->o);
  if (!passes_of(*task, outline, work, step, style, error)) return false;
  work.step(step);
  work.climbs(r.number("groove_feed"));
  work.dig(outline, valleys);
  work.home();
  return true;
}

}  // namespace cnctrans::ir::cycles::detail
