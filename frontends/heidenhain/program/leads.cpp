#include "frontends/heidenhain/program/leads.h"

#include <algorithm>
#include <utility>

#include "frontends/heidenhain/program/free_contour.h"
#include "frontends/heidenhain/ways/way.h"

namespace cnctrans::frontends::heidenhain {

namespace {

using facts_form = dialects::heidenhain::LeadForm;

bool is_comp(const ir::Action& a) {
  const auto* set = std::get_if<ir::ModalSet>(&a.data);
  return set != nullptr && set->setting == ir::Setting::comp;
}
bool is_feed(const ir::Action& a) {
  const auto* set = std::get_if<ir::ModalSet>(&a.data);
  return std::holds_alternative<ir::SetFeed>(a.data) || (set != nullptr && set->setting == ir::Setting::feed_mode);
}

/// One move of the way.
struct Leg {
  bool rapid = false, arc = false, ccw = false;
  std::optional<Pair> to;           ///< in the plane
  std::optional<ir::Value> height;  ///< along the tool axis
  bool height_incremental = false;
  Pair centre;
  bool feed = false;         ///< the feed of the block counts from here on
  std::optional<bool> comp;  ///< true: the compensation of the block, false: R0
};

class LeadWriter {
 public:
  explicit LeadWriter(Lowering& lowering) : lowering_(lowering), flat_(lowering.flat()), way_(flat_) {}

  void run() {
    std::vector<Item> items = std::move(flat_.items);
    way_.read_ahead_in(items);
    flat_.items.clear();
    for (std::size_t i = 0; i < items.size(); ++i) {
      way_.comes_to(items[i]);
      if (items[i].lead >= 0) {
        write(items, i);
        continue;
      }
      if (items[i].free >= 0) {
        i = free_contour(items, i);
        continue;
      }
      if (items[i].call != CycleCall::none) {
        const auto at =
            items[i].moves ? way_.end_of(std::get<ir::Block>(items[i].statement.node).motion) : way_.point();
        if (at) items[i].place = std::pair(at->u.value(), at->v.value());
      }
      if (items[i].kind == ItemKind::pole) absolute(flat_.poles[static_cast<std::size_t>(items[i].index)]);
      if (items[i].call != CycleCall::none) items[i].height = height_at_call(items[i]);
      put(std::move(items[i]));
    }
  }

 private:
  [[nodiscard]] std::optional<ir::Value> height_at_call(const Item& item) const {
    const auto* own = height_word(std::get<ir::Block>(item.statement.node).motion, way_.plane().w);
    if (own != nullptr) return own->mode == ir::WordMode::incremental ? std::nullopt : std::optional(own->value);
    const auto height = way_.coordinate(way_.plane().w);
    return height ? std::optional(height->value()) : std::nullopt;
  }
  /// CC with an absolute and an incremental word becomes absolute, where the tool's place is known.
  void absolute(Pole& pole) const {
    const auto some = std::count(pole.incremental.begin(), pole.incremental.end(), true);
    if (some == 0 || some == static_cast<std::ptrdiff_t>(pole.words.size())) return;
    for (std::size_t k = 0; k < pole.words.size(); ++k) {
      const auto from = way_.coordinate(pole.words[k].axis);
      if (!pole.incremental[k] || !from) continue;
      pole.words[k].value = (*from + Term(pole.words[k].value)).value();
      pole.incremental[k] = false;
    }
  }
  /// The elements of the free contour that begins with item `i`; `last`: the last item that belongs to them.
  std::vector<FreeElement> elements_from(const std::vector<Item>& items, std::size_t i, std::size_t& last) const {
    std::vector<FreeElement> elements;
    last = i;
    for (std::size_t k = i; k < items.size(); ++k) {
      const auto* b = std::get_if<ir::Block>(&items[k].statement.node);
      const auto* o = std::get_if<ir::Opaque>(&items[k].statement.node);
      const bool beside =
          items[k].kind == ItemKind::plain && ((b != nullptr && !b->has_motion) || (o != nullptr && o->harmless));
      if (items[k].free < 0 && !beside && items[k].kind != ItemKind::pole) break;
      if (items[k].free < 0) continue;
      elements.push_back(flat_.elements[static_cast<std::size_t>(items[k].free)]);
      last = k;
      if (elements.back().closes) break;
    }
    return elements;
  }
  static FreeResult solve(const std::vector<FreeElement>& elements, const Way& from) {
    const auto start = from.point();
    const auto& d = from.direction();
    FreeResult solved;
    if (!start || !start->literal()) {
      solved.error = "where the tool stands before the free contour is not known here";
      return solved;
    }
    std::optional<ir::geometry::Vec> direction;
    if (d && d->literal()) direction = ir::geometry::Vec{d->u.number(), d->v.number()};
    return solve_free_contour(elements, {start->u.number(), start->v.number()}, direction);
  }
  /// The last item that belongs to the free contour, which becomes lines and arcs.
  std::size_t free_contour(std::vector<Item>& items, std::size_t i) {
    std::size_t last = i;
    const auto elements = elements_from(items, i, last);
    const FreeResult solved = solve(elements, way_);
    if (!solved.error.empty()) {
      lowering_.report().start(elements[solved.at].where);
      lowering_.report().keep("HEI-030", {}, solved.error, "motion.geometry", "write it as L and C");
    }
    std::size_t at = 0;
    for (std::size_t k = i; k <= last; ++k) {
      Item item = std::move(items[k]);
      if (item.free >= 0) place(item, elements[at], solved, at), ++at;
      put(std::move(item));
    }
    return last;
  }
  /// The item becomes the line or arc that was found for it.
  void place(Item& item, const FreeElement& e, const FreeResult& solved, std::size_t at) const {
    item.free = -1;
    if (!solved.error.empty()) {
      ir::Opaque o;
      o.text = "FK";
      o.feature = "motion.geometry";
      item.statement.node = std::move(o);
      item.moves = false;
      item.call = CycleCall::none;
      return;
    }
    const auto& found = solved.elements[at];
    const auto plane = way_.plane();
    auto& m = std::get<ir::Block>(item.statement.node).motion;
    m.explicit_code = true;
    m.kind = found.arc ? found.ccw ? ir::MotionKind::arc_ccw : ir::MotionKind::arc_cw
             : e.rapid ? ir::MotionKind::rapid
                       : ir::MotionKind::linear;
    m.coords = {word(plane.u, Term(found.b.u).value()), word(plane.v, Term(found.b.v).value())};
    if (found.arc)
      m.centers = {centre_word(plane.u, Term(found.c.u).value()), centre_word(plane.v, Term(found.c.v).value())};
  }

  void put(Item item) {
    way_.step(item);
    flat_.items.push_back(std::move(item));
  }
  void write(std::vector<Item>& items, std::size_t i) {
    Item& item = items[i];
    const Lead& lead = flat_.leads[static_cast<std::size_t>(item.lead)];
    lowering_.report().start(lead.where);
    std::vector<Leg> legs;
    const std::string fault = lead.departure ? departure(lead, item, legs) : approach(lead, items, i, legs);
    if (fault.empty()) return emit(lead, item, legs);
    lowering_.report().keep("HEI-028", {}, fault, "motion.geometry", "write it as L and C");
    ir::Opaque o;
    o.text = lead.departure ? "DEP" : "APPR";
    o.feature = "motion.geometry";
    Item kept;
    kept.statement.line = std::move(item.statement.line);
    kept.statement.node = std::move(o);
    put(std::move(kept));
  }

  static const ir::CoordWord* height_word(const ir::Motion& m, ir::AxisId axis) {
    for (const auto& c : m.coords) {
      if (c.axis == axis) return &c;
    }
    return nullptr;
  }
  void add_height(const ir::Motion& m, std::vector<Leg>& legs, bool rapid) const {
    const auto* c = height_word(m, way_.plane().w);
    if (c == nullptr) return;
    Leg leg;
    leg.rapid = rapid;
    leg.height = c->value;
    leg.height_incremental = c->mode == ir::WordMode::incremental;
    legs.push_back(std::move(leg));
  }
  static Leg line(Pair to, bool rapid) {
    Leg leg;
    leg.to = std::move(to);
    leg.rapid = rapid;
    return leg;
  }
  static Leg arc(Pair to, Pair centre, bool ccw) {
    Leg leg;
    leg.arc = true;
    leg.to = std::move(to);
    leg.centre = std::move(centre);
    leg.ccw = ccw;
    return leg;
  }

  /// A sentence when the way can't be told.
  std::string approach(const Lead& lead, const std::vector<Item>& items, std::size_t i, std::vector<Leg>& legs) {
    const Item& item = items[i];
    const ir::Motion& m = std::get<ir::Block>(item.statement.node).motion;
    const auto first = way_.end_of(m);
    if (!first) return "where the first point of the contour lies is not known here";
    Way there = way_;
    there.step(item);
    std::optional<Pair> t;
    for (std::size_t k = i + 1; k < items.size(); ++k) {
      const Item& next = items[k];
      const auto* b = std::get_if<ir::Block>(&next.statement.node);
      if (next.lead >= 0) break;
      if (next.free >= 0) {
        std::size_t last = k;
        const FreeResult solved = solve(elements_from(items, k, last), there);
        if (!solved.error.empty()) return solved.error;
        const auto d = solved.elements.front().start_direction();
        t = Pair{Term(d.u), Term(d.v)};
        break;
      }
      const bool element = next.kind == ItemKind::plain && b != nullptr && b->has_motion && next.index < 0;
      if (element) t = there.start_direction(next);
      const bool passes = next.kind == ItemKind::pole || next.kind == ItemKind::label || next.kind == ItemKind::plain;
      if (t || !passes || !next.writes.empty() || (element && !flat_move(there, *b))) break;
      if (next.kind != ItemKind::label) there.step(next);
    }
    if (!t) return "the direction of the first element of the contour is not known here";
    const int side = lead.side == 0 ? -1 : lead.side;
    const Pair n = side > 0 ? t->left() : Term(-1) * t->left();
    const bool line_arc = lead.form == facts_form::line_arc;
    const bool rapid = way_.rapid().value_or(false);
    if (!way_.rapid() && !line_arc) {
      const auto& actions = std::get<ir::Block>(item.statement.node).actions;
      if (std::none_of(actions.begin(), actions.end(), is_feed))
        return "whether the tool comes to the approach in rapid is not known here";
      lowering_.report().warn(
          "HEI-028", {},
          "the block before the approach has FMAX on one way and F on another: the tool goes to the "
          "approach at the F of its block",
          "write the positioning block right before the approach");
    }
    const Term size(lead.size);
    Pair touch;
    Pair centre = *first + size * n;
    bool ccw = side > 0;
    switch (lead.form) {
      case facts_form::tangent_line: touch = *first - size * *t; break;
      case facts_form::normal_line: touch = *first + size * n; break;
      case facts_form::tangent_arc: {
        if (!size.literal()) return "R is a parameter: from which side the arc comes is not known";
        if (size.number() < 0) ccw = !ccw;
        const Term angle(lead.angle);
        touch = centre + (*first - centre).turned(ccw ? Term(0) - angle : angle);
        break;
      }
      case facts_form::line_arc: {
        const auto from = way_.point();
        if (!from) return "where the tool stands before the approach is not known here";
        const auto point = tangent(*from - centre, size, ccw, 1);
        if (!point) return "the tool stands within the circle of the approach";
        touch = centre + *point;
        break;
      }
    }
    const bool all = line_arc || !way_.rapid();  // the feed is that of the block from the start on
    legs.push_back(line(touch, all ? lead.rapid : rapid));
    legs.back().feed = all;
    if (lead.form != facts_form::normal_line) legs.back().comp = true;
    add_height(m, legs, all ? lead.rapid : rapid);
    const bool curved = lead.form == facts_form::tangent_arc || line_arc;
    legs.push_back(curved ? arc(*first, centre, ccw) : line(*first, lead.rapid));
    if (!all) legs.back().feed = true;
    if (lead.form == facts_form::normal_line) legs.back().comp = true;
    return {};
  }
  /// The block moves nothing in the plane.
  static bool flat_move(const Way& way, const ir::Block& b) {
    return std::all_of(b.motion.coords.begin(), b.motion.coords.end(),
                       [&](const auto& c) { return c.axis != way.plane().u && c.axis != way.plane().v; }) &&
           b.motion.extra == nullptr && b.motion.centers.empty();
  }

  std::string departure(const Lead& lead, const Item& item, std::vector<Leg>& legs) {
    const ir::Motion& m = std::get<ir::Block>(item.statement.node).motion;
    const auto last = way_.point();
    const auto& t = way_.direction();
    if (!last || !t) return "where the contour ends, and in which direction, is not known here";
    if (!way_.side()) return "on which side of the contour the tool is, is not known here";
    const int side = *way_.side() == 0 ? -1 : *way_.side();
    const Pair n = side > 0 ? t->left() : Term(-1) * t->left();
    const Term size(lead.size);
    const Pair centre = *last + size * n;
    bool ccw = side > 0;
    switch (lead.form) {
      case facts_form::tangent_line: legs.push_back(line(*last + size * *t, lead.rapid)); break;
      case facts_form::normal_line:
        legs.push_back(line(*last + size * n, lead.rapid));
        legs.back().comp = false;
        break;
      case facts_form::tangent_arc: {
        if (!size.literal()) return "R is a parameter: to which side the arc goes is not known";
        if (size.number() < 0) ccw = !ccw;
        const Term angle(lead.angle);
        legs.push_back(arc(centre + (*last - centre).turned(ccw ? angle : Term(0) - angle), centre, ccw));
        break;
      }
      case facts_form::line_arc: {
        const auto end = way_.end_of(m);
        if (!end) return "where the departure ends is not known here";
        const auto point = tangent(*end - centre, size, ccw, -1);
        if (!point) return "the end of the departure lies within its circle";
        legs.push_back(arc(centre + *point, centre, ccw));
        legs.push_back(line(*end, lead.rapid));
        legs.back().comp = false;
        break;
      }
    }
    legs.front().feed = true;
    add_height(m, legs, lead.rapid);
    return {};
  }
  /// From the centre to where a line from (`sense` 1) or to (-1) the point `d` touches the circle.
  static std::optional<Pair> tangent(const Pair& d, const Term& radius, bool ccw, int sense) {
    const Term square = d.u * d.u + d.v * d.v;
    const bool inside = d.literal() && radius.literal() && square.number() <= radius.number() * radius.number();
    if (inside) return std::nullopt;
    const Term along = radius * radius / square;
    const Term across = radius * (square - radius * radius).root() / square;
    const int turn = (ccw ? 1 : -1) * sense;
    return along * d + (turn > 0 ? across : Term(0) - across) * d.left();
  }

  void emit(const Lead& lead, Item& item, const std::vector<Leg>& legs) {
    auto& source = std::get<ir::Block>(item.statement.node);
    const auto plane = way_.plane();
    const bool was_compensated = way_.side() != 0;
    bool off = false;
    for (std::size_t k = 0; k < legs.size(); ++k) {
      const Leg& leg = legs[k];
      Item one;
      one.statement.line = item.statement.line;
      if (k != 0) {
        one.statement.line = {};
        one.statement.line.span = item.statement.line.span;
        one.statement.line.skip_mask = item.statement.line.skip_mask;
      }
      one.moves = true;
      one.leads_on = !lead.departure && k + 1 < legs.size();
      ir::Block b;
      for (const auto& a : source.actions) {
        const bool last = a.order == ir::Order::after;
        const bool here = is_comp(a)   ? !lead.departure && leg.comp.value_or(false)
                          : is_feed(a) ? leg.feed
                          : last       ? k + 1 == legs.size()
                                       : k == 0;
        if (here) b.actions.push_back(a);
      }
      if (leg.comp == std::optional(false)) {
        b.actions.emplace_back().data = comp_off();
        off = true;
      }
      b.has_motion = true;
      b.motion.explicit_code = true;
      b.motion.kind = leg.arc     ? leg.ccw ? ir::MotionKind::arc_ccw : ir::MotionKind::arc_cw
                      : leg.rapid ? ir::MotionKind::rapid
                                  : ir::MotionKind::linear;
      if (leg.to) {
        b.motion.coords.push_back(word(plane.u, leg.to->u.value()));
        b.motion.coords.push_back(word(plane.v, leg.to->v.value()));
      }
      if (leg.height) {
        b.motion.coords.push_back(word(plane.w, *leg.height));
        if (leg.height_incremental) b.motion.coords.back().mode = ir::WordMode::incremental;
      }
      if (leg.arc) {
        b.motion.centers.push_back(centre_word(plane.u, leg.centre.u.value()));
        b.motion.centers.push_back(centre_word(plane.v, leg.centre.v.value()));
      }
      one.statement.node = std::move(b);
      if (k + 1 == legs.size()) one.call = item.call;
      put(std::move(one));
    }
    if (!lead.departure || off || !was_compensated) return;
    Item end;
    end.statement.line.span = item.statement.line.span;
    end.statement.line.skip_mask = item.statement.line.skip_mask;
    ir::Block b;
    b.actions.emplace_back().data = comp_off();
    end.statement.node = std::move(b);
    put(std::move(end));
  }
  static ir::ModalSet comp_off() {
    return ir::ModalSet{ir::Setting::comp, static_cast<std::uint8_t>(ir::CompSide::off)};
  }
  static ir::CoordWord word(ir::AxisId axis, ir::Value v) {
    ir::CoordWord c;
    c.axis = axis;
    c.mode = ir::WordMode::modal;
    c.value = std::move(v);
    return c;
  }
  static ir::CenterWord centre_word(ir::AxisId axis, ir::Value v) {
    ir::CenterWord c;
    c.axis = axis;
    c.mode = ir::CenterMode::absolute;
    c.value = std::move(v);
    return c;
  }

  Lowering& lowering_;
  Flat& flat_;
  Way way_;
};

}  // namespace

void write_leads(Lowering& lowering) {
  const auto& flat = lowering.flat();
  const bool needed =
      !flat.leads.empty() || !flat.elements.empty() ||
      std::any_of(flat.items.begin(), flat.items.end(), [](const Item& i) { return i.at_pattern || i.shift; }) ||
      std::any_of(flat.cycles.begin(), flat.cycles.end(), [](const auto& c) { return !c.labels.empty(); }) ||
      std::any_of(flat.poles.begin(), flat.poles.end(),
                  [](const Pole& p) { return p.words.size() > 1 && p.incremental[0] != p.incremental[1]; });
  if (needed) LeadWriter(lowering).run();
}

}  // namespace cnctrans::frontends::heidenhain
