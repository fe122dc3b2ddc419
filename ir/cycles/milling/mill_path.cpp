// The path of a milling cycle: frame, levels, feeds.
#include <cmath>

#include "ir/cycles/milling/mill_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

bool same(double a, double b) {
  return std::abs(a - b) < 1e-9;
}

}  // namespace

Plunge plunge_of(const MillNumbers& mill) {
  const auto it = mill.words.find("variant");
  if (it == mill.words.end()) return Plunge::feed;
  switch (digit(it->second, 1)) {
    case 0: return Plunge::rapid;
    case 2: return Plunge::helix;
    case 3: return Plunge::ramp;
    default: return Plunge::feed;
  }
}

double MillPath::get(std::string_view name, double otherwise) const {
  const auto it = mill_.words.find(name);
  return it == mill_.words.end() ? otherwise : it->second;
}

std::pair<double, double> MillPath::place() const {
  return {get("u", context_.u), get("v", context_.v)};
}

Operation MillPath::operation(std::string* error) const {
  if (mill_.words.contains("variant")) {
    const int kind = digit(get("variant"), 0);
    if (kind != 1 && kind != 2) *error = "the variant of the machining is neither roughing (1) nor finishing (2)";
    return kind == 2 ? Operation::finish : Operation::rough;
  }
  const double kind = get("operation");
  if (kind != 0 && kind != 1 && kind != 2) *error = "the machining is 0 (complete), 1 (roughing) or 2 (finishing)";
  return kind == 1 ? Operation::rough : kind == 2 ? Operation::finish : Operation::complete;
}

bool MillPath::inside_ccw(std::string* error) const {
  const double way = get("half_length", get("signed_radius"));
  if (way != 0) return way < 0;
  const double sense = get("sense");
  if (sense == 2) return false;
  if (sense == 3) return true;
  if (sense != 0 && sense != 1)
    *error = "the sense of milling is 0 (climb), 1 (conventional), 2 (clockwise) or 3 (counter-clockwise)";
  return (sense == 0) != context_.spindle_ccw;
}

double MillPath::step(double factor, std::string* error) const {
  const double diameter = 2 * context_.tool_radius;
  const double given = std::abs(get("step"));
  if (given > diameter + least_mm) *error = "the step in the plane is larger than the diameter of the tool";
  return given > 0 ? given : get("step_factor", factor) * diameter;
}

long MillPath::times(double exact) {
  constexpr double most_passes = 100'000;
  constexpr std::size_t most_moves = 1'000'000;
  if (std::isnan(exact) || exact > most_passes || moves_.size() > most_moves) too_many_ = true;
  return too_many_ ? 1 : static_cast<long>(std::max(1.0, std::ceil(exact - 1e-9)));
}

std::vector<double> MillPath::depths(double top, double bottom, double infeed, bool equal) {
  const double total = std::abs(top - bottom);
  std::vector<double> out;
  if (total < least_mm) return out;
  if (infeed <= 0) infeed = total;
  const auto n = times(total / infeed);
  for (long k = 1; k < n; ++k) {
    const double part =
        equal ? total * static_cast<double>(k) / static_cast<double>(n) : infeed * static_cast<double>(k);
    out.push_back(top - levels_.up * part);
  }
  out.push_back(bottom);
  return out;
}

std::vector<double> MillPath::depths(double top, double bottom) {
  const double given = get("signed_infeed");
  if (given != 0) return depths(top, bottom, std::abs(given), given > 0);
  return depths(top, bottom, std::abs(get("infeed")), true);
}

void MillPath::frame(double u, double v, double degrees) {
  origin_u_ = u;
  origin_v_ = v;
  const double quarters = degrees / 90;
  if (same(quarters, std::round(quarters))) {  // no dust of pi
    constexpr double cosines[] = {1, 0, -1, 0};
    const auto k = static_cast<std::size_t>(((std::llround(quarters) % 4) + 4) % 4);
    cos_ = cosines[k];
    sin_ = cosines[(k + 3) % 4];
    return;
  }
  cos_ = std::cos(degrees * radians);
  sin_ = std::sin(degrees * radians);
}

void MillPath::frame_along(double p) {
  const auto [u, v] = to_plane(p, 0);
  origin_u_ = u;
  origin_v_ = v;
}

std::pair<double, double> MillPath::to_plane(double p, double q) const {
  return {origin_u_ + p * cos_ - q * sin_, origin_v_ + p * sin_ + q * cos_};
}
std::pair<double, double> MillPath::local() {
  const double u = u_ - origin_u_, v = v_ - origin_v_;
  lost_ = lost_ || std::isnan(u) || std::isnan(v);
  return {u * cos_ + v * sin_, v * cos_ - u * sin_};
}

void MillPath::put(MillStep step, double u, double v, double w, bool into) {
  if (step != MillStep::arc && same(u, u_) && same(v, v_) && same(w, w_)) return;
  MillMove m;
  m.step = step;
  m.u = u_ = u;
  m.v = v_ = v;
  m.w = w_ = w;
  if (step != MillStep::rapid) {
    const double milling = std::abs(get("mill_feed"));
    double feed = into ? std::abs(get("plunge_feed")) : milling;
    if (finishing_ && !into && get("finish_feed") > 0) feed = get("finish_feed");
    if (finishing_ && into && get("finish_plunge_feed") > 0) feed = get("finish_plunge_feed");
    if (into && feed == 0) {
      feed = milling;
      m.feed_factor = get("plunge_factor", 1);
    }
    if (!into) feed *= scale_;
    if (!into && feed == 0) m.feed_factor = scale_;
    m.has_feed = feed > 0;
    m.feed = feed;
  }
  moves_.push_back(m);
}

void MillPath::approach(double p, double q) {
  if (levels_.has_retract) rapid_to(levels_.retract);
  rapid(p, q);
  rapid_to(levels_.reference);
}
void MillPath::retract() {
  rapid_to(retract_level(levels_, context_.plane));
}
void MillPath::rapid(double p, double q) {
  const auto [u, v] = to_plane(p, q);
  put(MillStep::rapid, u, v, w_, false);
}
void MillPath::rapid_to(double w) {
  put(MillStep::rapid, u_, v_, w, false);
}
void MillPath::plunge(double w) {
  put(MillStep::feed, u_, v_, w, true);
}
void MillPath::mill(double p, double q) {
  const auto [u, v] = to_plane(p, q);
  put(MillStep::feed, u, v, w_, false);
}
void MillPath::plunge_to(double p, double q, double w) {
  const auto [u, v] = to_plane(p, q);
  put(MillStep::feed, u, v, w, true);
}
void MillPath::mill_to(double p, double q, double w) {
  const auto [u, v] = to_plane(p, q);
  put(MillStep::feed, u, v, w, false);
}
void MillPath::link(double p, double q, double w, double feed) {
  const auto before = moves_.size();
  mill_to(p, q, w);
  if (feed <= 0 || moves_.size() == before) return;
  moves_.back().has_feed = true;
  moves_.back().feed = feed;
  moves_.back().feed_factor = 1;
}
void MillPath::compensate(int side) {
  MillMove m;
  m.step = side == 0 ? MillStep::comp_off : side > 0 ? MillStep::comp_left : MillStep::comp_right;
  m.u = u_;
  m.v = v_;
  m.w = w_;
  moves_.push_back(m);
}
void MillPath::mill_arc(double p, double q, double cp, double cq, bool ccw) {
  mill_arc_to(p, q, w_, cp, cq, ccw);
}
void MillPath::mill_arc_to(double p, double q, double w, double cp, double cq, bool ccw) {
  const auto [u, v] = to_plane(p, q);
  const auto [cu, cv] = to_plane(cp, cq);
  put(MillStep::arc, u, v, w, false);
  moves_.back().cu = cu;
  moves_.back().cv = cv;
  moves_.back().ccw = ccw;
}
void MillPath::lead_arc_to(double p, double q, double w, double cp, double cq, bool ccw) {
  mill_arc_to(p, q, w, cp, cq, ccw);
  if (get("lead_feed") <= 0) return;
  moves_.back().has_feed = true;
  moves_.back().feed = get("lead_feed");
  moves_.back().feed_factor = 1;
}
void MillPath::plunge_arc_to(double p, double q, double w, double cp, double cq, bool ccw) {
  const auto [u, v] = to_plane(p, q);
  const auto [cu, cv] = to_plane(cp, cq);
  put(MillStep::arc, u, v, w, true);
  moves_.back().cu = cu;
  moves_.back().cv = cv;
  moves_.back().ccw = ccw;
}
void MillPath::plunge_circle(double cp, double cq, double w, bool ccw) {
  const auto [cu, cv] = to_plane(cp, cq);
  put(MillStep::arc, u_, v_, w, true);
  moves_.back().cu = cu;
  moves_.back().cv = cv;
  moves_.back().ccw = ccw;
}

void MillPath::mill_circle(double cp, double cq, double w, bool ccw) {
  const auto [cu, cv] = to_plane(cp, cq);
  put(MillStep::arc, u_, v_, w, false);
  moves_.back().cu = cu;
  moves_.back().cv = cv;
  moves_.back().ccw = ccw;
}

void MillPath::finishing(bool on) {
  if (finishing_ == on) return;
  finishing_ = on;
  if (get("finish_speed") <= 0) return;
  MillMove m;
  m.step = on ? MillStep::speed : MillStep::restore_speed;
  m.amount = get("finish_speed");
  m.u = u_;
  m.v = v_;
  m.w = w_;
  moves_.push_back(m);
}

void round_rectangle(MillPath& path, double a, double b, double c, bool ccw) {
  const double h = ccw ? 1 : -1;
  c = std::min({c, a, b});
  if (c < least_mm) c = 0;
  if (c > 0 && a - c < least_mm && b - c < least_mm) {
    path.mill_arc(a, 0, 0, 0, ccw);
    return;
  }
  const auto corner = [&](double p, double q, double cp, double cq) {
    if (c > 0) path.mill_arc(p, h * q, cp, h * cq, ccw);
  };
  path.mill(a, h * (b - c));
  corner(a - c, b, a - c, b - c);
  path.mill(c - a, h * b);
  corner(-a, b - c, c - a, b - c);
  path.mill(-a, h * (c - b));
  corner(c - a, -b, c - a, c - b);
  path.mill(a - c, -h * b);
  corner(a, c - b, a - c, c - b);
  path.mill(a, 0);
}

}  // namespace cnctrans::ir::cycles::detail
