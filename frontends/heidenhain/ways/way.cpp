#include "frontends/heidenhain/ways/way.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ir/geometry/geometry.h"

namespace cnctrans::frontends::heidenhain {

namespace {

constexpr double circle_tolerance = 0.016;  // MP7431

bool is_arc(const ir::Motion& m) {
  return m.kind == ir::MotionKind::arc_cw || m.kind == ir::MotionKind::arc_ccw;
}
const ir::CoordWord* word_of(const ir::Motion& m, ir::AxisId axis) {
  for (const auto& c : m.coords) {
    if (c.axis == axis) return &c;
  }
  return nullptr;
}
bool polar(const ir::Motion& m) {
  return m.extra != nullptr && (m.extra->has_polar_angle || m.extra->has_polar_radius);
}

}  // namespace

std::string label_key(const Item& item) {
  return (item.number ? "N" : "T") + item.label;
}

Way::Way(const Flat& flat) : flat_(flat), ahead_(&flat.items) {
  for (std::size_t at = 0; at < flat.items.size(); ++at) {
    const Item& i = flat.items[at];
    if (i.kind == ItemKind::label) calls_[label_key(i)].first = at;
    if (i.kind != ItemKind::call && i.kind != ItemKind::repeat && i.kind != ItemKind::jump) continue;
    targets_.insert(label_key(i));
    auto& calls = calls_[label_key(i)];
    i.kind == ItemKind::call ? void(++calls.left) : void(calls.jumped = true);
    calls.before = calls.before || i.kind == ItemKind::call || calls.first == 0;
    calls.last = at;
  }
}

void Way::forget() {
  at_.fill(std::nullopt);
  pole_.reset();
  direction_.reset();
}

void Way::note_call(const Item& item) {
  Calls& calls = calls_[label_key(item)];
  --calls.left;
  if (!std::exchange(calls.some, true)) {
    calls.at = at_;
    calls.side = side_;
    calls.rapid = rapid_;
    calls.feed = feed_;
    return;
  }
  for (std::size_t i = 0; i < at_.size(); ++i) {
    auto& a = calls.at[i];
    const bool same = a && at_[i] && a->literal() && at_[i]->literal() && a->number() == at_[i]->number();
    if (!same) a.reset();
  }
  if (calls.side != side_) calls.side.reset();
  if (calls.rapid != rapid_) calls.rapid.reset();
  if (calls.feed != feed_) calls.feed.reset();
}

/// At the label of a subprogram whose calls all stand before it. False: other ways lead here.
bool Way::enter(const Item& label) {
  sub_dead_ = dead_;
  const Calls& calls = calls_[label_key(label)];
  if (!std::exchange(dead_, false) || calls.jumped || !calls.some || calls.left != 0) return false;
  forget();
  at_ = calls.at;
  side_ = calls.side;
  rapid_ = calls.rapid;
  feed_ = calls.feed;
  return true;
}

/// Only what both know; true when that is less.
bool Way::join(const Way& other) {
  bool changed = false;
  const auto both = [&changed](auto& mine, const auto& theirs, const auto& same) {
    if (!mine || (theirs && same(*mine, *theirs))) return;
    mine.reset();
    changed = true;
  };
  const auto equal = [](const auto& a, const auto& b) { return a == b; };
  constexpr double noise = 1e-9;
  const auto term = [](const Term& a, const Term& b) {
    return a.literal() && b.literal() && std::fabs(a.number() - b.number()) < noise;
  };
  const auto pair = [&term](const Pair& a, const Pair& b) { return term(a.u, b.u) && term(a.v, b.v); };
  for (std::size_t i = 0; i < at_.size(); ++i) both(at_[i], other.at_[i], term);
  both(pole_, other.pole_, pair);
  both(direction_, other.direction_, pair);
  both(side_, other.side_, equal);
  both(rapid_, other.rapid_, equal);
  both(feed_, other.feed_, equal);
  return changed;
}

/// Behind an element whose path is not known yet: an approach ends where its words say, and so does DEP LCT.
void Way::leave_open(const Item& item) {
  const Lead* lead = item.lead >= 0 ? &flat_.leads[static_cast<std::size_t>(item.lead)] : nullptr;
  const bool ends = lead != nullptr && (!lead->departure || lead->form == dialects::heidenhain::LeadForm::line_arc);
  if (!ends) forget();
  direction_.reset();
  rapid_.reset();
  side_.reset();
  if (lead != nullptr && lead->departure) side_ = 0;
  if (lead != nullptr && !lead->departure && lead->side != 0) side_ = lead->side;
}

/// At the label of a loop: what each round of it leaves as it was. False: other ways lead here.
bool Way::stay_in_loop(const Item& label) {
  const Calls& loop = calls_[label_key(label)];
  if (dead_ || loop.before || !loop.jumped) return false;
  for (bool changed = true; changed;) {
    changed = false;
    Way round = *this;
    for (std::size_t i = loop.first + 1; i <= loop.last; ++i) {
      const Item& item = (*ahead_)[i];
      round.step(item);
      if (item.lead >= 0 || item.free >= 0) round.leave_open(item);
      const bool leads = item.kind == ItemKind::repeat || item.kind == ItemKind::jump;
      if (leads && label_key(item) == label_key(label)) changed = join(round) || changed;
      if (round.plane_ != plane_) return false;
    }
  }
  return true;
}

std::optional<Pair> Way::point() const {
  const auto p = plane();
  if (!at_[p.u] || !at_[p.v]) return std::nullopt;
  return Pair{*at_[p.u], *at_[p.v]};
}

void Way::comes_to(const Item& item) {
  const std::uint16_t mask = item.statement.line.skip_mask;
  if (const auto before = std::exchange(skip_mask_, mask); before != 0 && before != mask) forget();
}

void Way::step(const Item& item) {
  comes_to(item);
  switch (item.kind) {
    case ItemKind::label:
      if (targets_.count(label_key(item)) == 0) return;
      cycle_ = -1;
      if (enter(item) || stay_in_loop(item)) return;
      forget();
      side_.reset();
      rapid_.reset();
      feed_.reset();
      return;
    case ItemKind::pole: return set_pole(flat_.poles[static_cast<std::size_t>(item.index)]);
    case ItemKind::cycle: cycle_ = item.index; return;
    case ItemKind::jump:
    case ItemKind::repeat: return;
    case ItemKind::sub_end:
    case ItemKind::call:
    case ItemKind::program:
    case ItemKind::end:
      if (item.kind == ItemKind::call) note_call(item);
      if (item.kind == ItemKind::sub_end) dead_ = sub_dead_;
      if (item.kind == ItemKind::end && item.statement.line.skip_mask == 0) dead_ = true;
      forget();
      side_.reset();
      rapid_.reset();
      feed_.reset();
      return;
    case ItemKind::plain: break;
  }
  if (!item.writes.empty()) {
    cycle_ = -1;  // perhaps a parameter of it
    for (auto& a : at_) {
      if (a && !a->literal()) a.reset();
    }
    if (pole_ && !pole_->literal()) pole_.reset();
    if (direction_ && !direction_->literal()) direction_.reset();
  }
  const auto* b = std::get_if<ir::Block>(&item.statement.node);
  if (b == nullptr || item.index >= 0) {
    const auto* o = std::get_if<ir::Opaque>(&item.statement.node);
    if (item.index >= 0 || (o != nullptr && !o->harmless)) forget();
    return;
  }
  for (const auto& a : b->actions) {
    if (const auto* set = std::get_if<ir::ModalSet>(&a.data)) {
      if (set->setting == ir::Setting::plane) plane_ = static_cast<ir::Plane>(set->value);
      if (set->setting == ir::Setting::comp)
        side_ = set->value == static_cast<std::uint8_t>(ir::CompSide::left)    ? 1
                : set->value == static_cast<std::uint8_t>(ir::CompSide::right) ? -1
                                                                               : 0;
    }
    const bool moves_frame = std::holds_alternative<ir::FrameOp>(a.data) ||
                             std::holds_alternative<ir::WorkOffset>(a.data) ||
                             std::holds_alternative<ir::SurfaceSet>(a.data);
    if (moves_frame) forget();
    const auto* f = std::get_if<ir::SetFeed>(&a.data);
    if (f != nullptr && !f->block_only) feed_ = f->value.literal() ? std::optional(f->value.number) : std::nullopt;
  }
  if (b->has_motion) move(item);
  if (item.call != CycleCall::none) call(item);
}

/// A cycle of Q parameters ends on its second clearance; between points the tool stays where it stood, if that is
/// higher.
void Way::call(const Item& item) {
  const auto before = at_[plane().w];
  if (item.at_pattern) forget();
  at_[plane().w].reset();
  const auto* cycle = cycle_ < 0 ? nullptr : &flat_.cycles[static_cast<std::size_t>(cycle_)];
  if (cycle == nullptr || cycle->row == nullptr) return;
  std::array<double, 3> q{};
  for (std::size_t k = 0; k < q.size(); ++k) {
    const auto it = cycle->values.find(std::array<std::int16_t, 3>{200, 203, 204}[k]);
    if (it == cycle->values.end() || it->second.kind != QValue::Kind::value || !it->second.value.literal()) return;
    q[k] = it->second.value.number;
  }
  if (item.shift && !item.shift->literal()) return;
  double end = q[1] + std::max(q[0], q[2]) + (item.shift ? item.shift->number : 0);
  if (item.at_pattern) {
    if (!before || !before->literal()) return;
    end = std::max(end, before->number());
  }
  at_[plane().w] = end;
}

void Way::move(const Item& item) {
  const ir::Motion& m = std::get<ir::Block>(item.statement.node).motion;
  rapid_ = m.kind == ir::MotionKind::rapid;
  if (m.frame != ir::FrameUse::normal) {
    for (const auto& c : m.coords) at_[c.axis].reset();
    direction_.reset();
    return;
  }
  const auto p = plane();
  const auto end = end_of(m);
  std::optional<Pair> to;
  if (is_arc(m)) {
    const auto centre = centre_of(item, end);
    const Pair r = centre && end ? *end - *centre : Pair{};
    if (centre && end && r.some())
      to = m.kind == ir::MotionKind::arc_ccw ? r.left().unit() : (Term(-1) * r.left()).unit();
    direction_ = to;
  } else if (m.kind == ir::MotionKind::arc_tangent) {
    const auto from = point();
    if (from && end && direction_ && (*end - *from).some()) {  // mirrored at the chord
      const Pair c = (*end - *from).unit();
      const Term along = Term(2) * (c.u * direction_->u + c.v * direction_->v);
      to = along * c - *direction_;
    }
    direction_ = to;
  } else {
    const auto way = chord(m);
    if (!way || way->some()) direction_ = way ? std::optional(way->unit()) : std::nullopt;
  }
  for (const auto& c : m.coords) {
    if (c.axis >= at_.size()) continue;
    auto& a = at_[c.axis];
    if (c.mode != ir::WordMode::incremental)
      a = Term(c.value);
    else if (a)
      a = *a + Term(c.value);
  }
  at_[p.u] = end ? std::optional(end->u) : std::nullopt;
  at_[p.v] = end ? std::optional(end->v) : std::nullopt;
  if (end) return;
  for (const ir::AxisId axis : {p.u, p.v}) {  // one of the two may be known
    const auto* c = word_of(m, axis);
    if (!polar(m) && c != nullptr && c->mode != ir::WordMode::incremental) at_[axis] = Term(c->value);
  }
}

std::optional<Pair> Way::end_of(const ir::Motion& m) const {
  const auto p = plane();
  if (polar(m)) {
    const auto from = point();
    const auto& x = *m.extra;
    if (!pole_) return std::nullopt;
    const bool arc = is_arc(m);
    const bool needs = !x.has_polar_radius || !x.has_polar_angle || x.polar_mode == ir::WordMode::incremental ||
                       x.polar_angle_mode == ir::WordMode::incremental;
    Term radius, angle;
    if (needs) {
      if (!from || !from->literal() || !pole_->literal()) return std::nullopt;
      const Pair d = *from - *pole_;
      radius = d.length();
      angle = std::atan2(d.v.number(), d.u.number()) * 180 / std::numbers::pi;
    }
    const bool adds_angle = x.polar_angle_mode == ir::WordMode::incremental;
    if (x.has_polar_radius && !arc)
      radius = x.polar_mode == ir::WordMode::incremental ? radius + Term(x.polar_radius) : Term(x.polar_radius);
    if (x.has_polar_angle) angle = adds_angle ? angle + Term(x.polar_angle) : Term(x.polar_angle);
    return *pole_ + Pair{radius * angle.cosine(), radius * angle.sine()};
  }
  std::array<std::optional<Term>, 2> out;
  for (const bool first : {true, false}) {
    const ir::AxisId axis = first ? p.u : p.v;
    const auto* c = word_of(m, axis);
    auto& o = out[first ? 0 : 1];
    if (c != nullptr && c->mode != ir::WordMode::incremental)
      o = Term(c->value);
    else if (at_[axis])
      o = c == nullptr ? *at_[axis] : *at_[axis] + Term(c->value);
  }
  if (!out[0] || !out[1]) return std::nullopt;
  return Pair{*out[0], *out[1]};
}

/// From the start to the end of a line; increments need no start.
std::optional<Pair> Way::chord(const ir::Motion& m) const {
  const auto p = plane();
  const auto *u = word_of(m, p.u), *v = word_of(m, p.v);
  const auto free = [](const ir::CoordWord* c) { return c == nullptr || c->mode == ir::WordMode::incremental; };
  if (!polar(m) && free(u) && free(v))
    return Pair{u == nullptr ? Term(0) : Term(u->value), v == nullptr ? Term(0) : Term(v->value)};
  const auto from = point(), to = end_of(m);
  if (!from || !to) return std::nullopt;
  return *to - *from;
}

std::optional<Pair> Way::centre_of(const Item& item, const std::optional<Pair>& end) const {
  const ir::Motion& m = std::get<ir::Block>(item.statement.node).motion;
  if (item.by_pole) return pole_;
  if (m.radius_given) {
    const auto from = point();
    if (!from || !end || !from->literal() || !end->literal() || !m.radius.literal()) return std::nullopt;
    const auto c =
        ir::geometry::centre_by_radius({from->u.number(), from->v.number()}, {end->u.number(), end->v.number()},
                                       m.radius.number, m.kind == ir::MotionKind::arc_ccw, circle_tolerance);
    return c ? std::optional(Pair{c->u, c->v}) : std::nullopt;
  }
  if (m.centers.size() != 2) return std::nullopt;
  return Pair{Term(m.centers[0].value), Term(m.centers[1].value)};
}

std::optional<Pair> Way::start_direction(const Item& element) const {
  const ir::Motion& m = std::get<ir::Block>(element.statement.node).motion;
  if (is_arc(m)) {
    const auto from = point();
    const auto centre = centre_of(element, end_of(m));
    if (!from || !centre) return std::nullopt;
    const Pair r = *from - *centre;
    if (!r.some()) return std::nullopt;
    return m.kind == ir::MotionKind::arc_ccw ? r.left().unit() : (Term(-1) * r.left()).unit();
  }
  if (m.kind == ir::MotionKind::arc_tangent) return std::nullopt;
  const auto way = chord(m);
  return way && way->some() ? std::optional(way->unit()) : std::nullopt;
}

void Way::set_pole(const Pole& pole) {
  if (pole.other) return pole_.reset();
  const auto p = plane();
  std::array<std::optional<Term>, 2> out;
  const bool none = pole.words.empty();
  bool all_incremental = !none;
  for (const bool i : pole.incremental) all_incremental = all_incremental && i;
  for (const bool first : {true, false}) {
    const ir::AxisId axis = first ? p.u : p.v;
    auto& o = out[first ? 0 : 1];
    if (none || all_incremental) o = at_[axis];
    if (!none && !all_incremental && pole_) o = first ? pole_->u : pole_->v;
    for (std::size_t k = 0; k < pole.words.size(); ++k) {
      if (pole.words[k].axis != axis) continue;
      const Term value(pole.words[k].value);
      if (!pole.incremental[k])
        o = value;
      else
        o = at_[axis] ? std::optional(*at_[axis] + value) : std::nullopt;
    }
  }
  pole_ = out[0] && out[1] ? std::optional(Pair{*out[0], *out[1]}) : std::nullopt;
}

}  // namespace cnctrans::frontends::heidenhain
