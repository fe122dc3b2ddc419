#include "legaliser/cycles/milling/similar_pocket.h"

#include <cmath>
#include <utility>

#include "base/text.h"
#include "ir/cycles/words.h"
#include "ir/known_number.h"

namespace cnctrans::ir::passes {

namespace {

constexpr double near = 1e-3;  ///< mm or the like: radii that are one

bool nothing(const std::optional<Value>& v) {
  return !v || v->is(0);
}
/// Without its sign where that is seen.
Value unsigned_value(const Value& v) {
  if (v.literal()) return Value(std::fabs(v.number));
  const auto* u = std::get_if<Unary>(&v.expr->node);
  return u != nullptr && u->op == UnaryOp::negate ? Value(u->operand) : without_text(v);
}
Value less(const Value& v, const std::optional<Value>& by) {
  return nothing(by) ? v : subtract(v, *by);
}

/// A pocket in words that every control can be asked for. Sizes are whole ones, unsigned.
struct Pocket {
  bool circle = false;
  Value length, width, radius;
  std::optional<Value> corner;  ///< nothing: that of the tool
  double angle = 0;
  std::optional<Value> u, v;
  Value infeed;
  bool equal_levels = true;
  std::optional<Value> step;
  bool step_said = false;
  std::optional<Value> finish_infeed;
  std::optional<Value> wall_left, floor_left;  ///< stand at the end
  std::optional<Value> wall_cut, floor_cut;    ///< left by roughing, and taken
  std::optional<Value> mill_feed, plunge_feed, finish_feed, finish_plunge_feed;
  bool ccw = true;
  std::string differs;
  Value surface, reference, bottom, retract;
  bool dives = false;  ///< goes into the depth in rapid

  [[nodiscard]] bool round_ends() const {
    if (circle || !corner) return false;
    const auto l = known_number(length), w = known_number(width), r = known_number(*corner);
    return l && w && r && *l > *w && std::fabs(2 * *r - *w) < 1e-9;
  }
};

class Reader {
 public:
  Reader(const PocketSource& source, std::string* why) : s_(source), why_(why) {}

  std::optional<Pocket> read() {
    const auto& shape = s_.cycle.mill.shape;
    if (shape != "pocket.rect" && shape != "pocket.circle") return fail("it is no pocket");
    p_.circle = shape == "pocket.circle";
    if (!levels() || !operation() || !size() || !sense()) return std::nullopt;
    for (const auto* blank : {"blank_length", "blank_width", "blank_depth"}) {
      if (!nothing(word(blank))) return fail("a part of the pocket is there already");
    }
    if (!nothing(word("finish_speed"))) return fail("the finishing has a speed of its own");
    if (const auto each = word("finish_infeed"); !nothing(each)) p_.finish_infeed = unsigned_value(*each);
    p_.u = word("u");
    p_.v = word("v");
    if (!p_.u) p_.u = s_.u;
    if (!p_.v) p_.v = s_.v;
    infeeds();
    feeds();
    return p_;
  }

 private:
  bool no(std::string what) {
    *why_ = std::move(what);
    return false;
  }
  std::optional<Pocket> fail(std::string what) {
    no(std::move(what));
    return std::nullopt;
  }
  [[nodiscard]] std::optional<Value> word(std::string_view name) const {
    const Value* v = cycles::find_word(s_.cycle.mill.words, name);
    return v == nullptr ? std::nullopt : std::optional(without_text(*v));
  }
  /// A level as a coordinate.
  [[nodiscard]] std::optional<Value> height(const Level& l) const {
    if (!l.given) return std::nullopt;
    if (l.base == LevelBase::absolute) return without_text(l.value);
    const Level* base = l.base == LevelBase::from_surface     ? &s_.cycle.surface
                        : l.base == LevelBase::from_reference ? &s_.cycle.reference
                                                              : nullptr;
    if (base == nullptr || base == &l || base->base == l.base) return std::nullopt;
    const auto from = height(*base);
    return from ? std::optional(without_text(add(*from, l.value))) : std::nullopt;
  }
  bool levels() {
    const auto reference = height(s_.cycle.reference), bottom = height(s_.cycle.bottom),
               retract = height(s_.cycle.retract);
    const auto surface = s_.cycle.surface.given ? height(s_.cycle.surface) : reference;
    if (!reference || !bottom || !retract || !surface) return no("one of its heights is not known here");
    p_.reference = *reference;
    p_.bottom = *bottom;
    p_.retract = *retract;
    p_.surface = *surface;
    return true;
  }
  bool operation() {
    double kind = 0;
    if (const auto v = word("variant")) {
      const auto n = known_number(*v);
      if (!n) return no("what it machines is computed");
      kind = std::fmod(std::fabs(*n), 10);
      p_.dives = std::fabs(*n) < 10 && kind != 2;
      if (std::fabs(*n) >= 20) return no("it goes into the material on a helix or a ramp");
    } else if (const auto o = word("operation")) {
      const auto n = known_number(*o);
      if (!n) return no("what it machines is computed");
      kind = *n;
    }
    if (kind == 2) return no("it only finishes");
    auto wall = word("wall_stock"), floor = word("floor_stock");
    if (wall) wall = unsigned_value(*wall);
    if (floor) floor = unsigned_value(*floor);
    (kind == 1 ? p_.wall_left : p_.wall_cut) = wall;
    (kind == 1 ? p_.floor_left : p_.floor_cut) = floor;
    if (const auto each = word("wall_pass"); !nothing(each)) p_.wall_cut = unsigned_value(*each);
    if (!nothing(p_.floor_left)) {  // the floor lies higher then
      const auto top = known_number(p_.surface), low = known_number(p_.bottom);
      if (!top || !low) return no("its depth is computed, and its floor keeps an allowance");
      p_.bottom = *top > *low ? add(p_.bottom, *p_.floor_left) : subtract(p_.bottom, *p_.floor_left);
    }
    return true;
  }
  bool size() {
    const auto half = [this](const char* name) -> std::optional<Value> {
      const auto v = word(name);
      if (!v) return std::nullopt;
      return scale(unsigned_value(*v), 2);
    };
    if (p_.circle) {
      const auto r = word("signed_radius") ? word("signed_radius") : word("radius");
      if (!r) return no("it has no size");
      p_.radius = less(unsigned_value(*r), p_.wall_left);
      return true;
    }
    auto length = word("length"), width = word("width");
    if (!length) length = half("half_length");
    if (!width) width = half("half_width");
    if (!length || !width) return no("it has no size");
    const auto both = nothing(p_.wall_left) ? std::nullopt : std::optional(scale(*p_.wall_left, 2));
    p_.length = less(unsigned_value(*length), both);
    p_.width = less(unsigned_value(*width), both);
    if (const auto c = word("corner"); !nothing(c)) p_.corner = less(unsigned_value(*c), p_.wall_left);
    // No corner of the source is smaller than the tool.
    const auto corner = p_.corner ? known_number(*p_.corner) : std::nullopt;
    if (p_.round_ends()) {
      const auto stock = p_.wall_cut ? known_number(*p_.wall_cut) : std::nullopt;
      if (s_.radius && *corner - stock.value_or(0) < *s_.radius - near) return no("the tool is too large for it");
    } else if (corner && s_.radius && *corner <= *s_.radius + near) {
      p_.corner.reset();
    }
    if (const auto a = word("angle")) {
      const auto n = known_number(*a);
      if (!n) return no("its angle is computed");
      p_.angle = *n;
    }
    return true;
  }
  bool sense() {
    for (const auto* name : {"half_length", "signed_radius"}) {
      const auto v = word(name);
      if (!v) continue;
      const auto n = known_number(*v);
      if (!n) return no("its sense is that of a computed size");
      p_.ccw = *n < 0;
      return true;
    }
    const auto v = word("sense");
    const auto n = v ? known_number(*v) : std::optional(0.0);
    if (!n || *n < 0 || *n > 3) return no("its sense is computed");
    if (*n >= 2) {
      p_.ccw = *n == 3;
      return true;
    }
    if (!s_.sense) p_.differs += ", its sense is the one of a spindle that turns clockwise";
    p_.ccw = (*n == 0) != (s_.sense == SpindleState::ccw);
    return true;
  }
  void infeeds() {
    if (const auto each = word("signed_infeed")) {
      p_.infeed = unsigned_value(*each);
      p_.equal_levels = !each->literal() || each->number > 0;
    } else if (const auto all = word("infeed"); !nothing(all)) {
      p_.infeed = unsigned_value(*all);
    }
    if (nothing(p_.infeed)) {  // in one
      const auto top = known_number(p_.surface), low = known_number(p_.bottom);
      p_.infeed = top && low && *top < *low ? subtract(p_.bottom, p_.surface) : subtract(p_.surface, p_.bottom);
    }
    if (const auto step = word("step"); !nothing(step)) p_.step = unsigned_value(*step);
    const auto factor = word("step_factor");
    p_.step_said = p_.step || factor;
    if (p_.step || !s_.radius) return;
    const auto n = factor ? known_number(*factor) : std::optional(0.8);
    if (n && *n > 0) p_.step = Value(std::round(*n * 2 * *s_.radius * 1e6) / 1e6);
  }
  void feeds() {
    const auto given = [this](const char* name) {
      const auto v = word(name);
      return nothing(v) ? std::nullopt : v;
    };
    p_.mill_feed = given("mill_feed");
    p_.finish_feed = given("finish_feed");
    p_.finish_plunge_feed = given("finish_plunge_feed");
    p_.plunge_feed = given("plunge_feed");
    if (p_.plunge_feed) return;
    const auto factor = word("plunge_factor");
    const auto n = factor ? known_number(*factor) : std::optional(1.0);
    const auto& base = p_.mill_feed ? p_.mill_feed : s_.feed;
    if (base && n) p_.plunge_feed = without_text(*n == 1 ? *base : scale(*base, *n));
  }

  const PocketSource& s_;
  std::string* why_;
  Pocket p_;
};

/// Says a pocket in one of the ways in which controls say it.
class Teller {
 public:
  Teller(const PocketSource& source, const Pocket& pocket) : s_(source), p_(pocket) {}
  std::string why;

  /// Half sizes whose sign is the sense, at the place of the tool, finished on every level; the corners are the tool's.
  std::optional<PocketForm> by_half_sizes() {
    if (!start(false) || !square() || !corners_of_the_tool()) return std::nullopt;
    const double sign = p_.ccw ? -1 : 1;
    const auto half = [](const Value& v, double by) { return scale(v, by / 2); };
    if (p_.circle) {
      put("signed_radius", sign > 0 ? p_.radius : negate(p_.radius));
    } else {
      put("half_length", half(turned() ? p_.width : p_.length, sign));
      put("half_width", half(turned() ? p_.length : p_.width, 1));
    }
    put("signed_infeed", p_.equal_levels ? p_.infeed : negate(p_.infeed));
    if (p_.step) put("step", *p_.step);
    if (!nothing(p_.wall_cut)) {
      put("wall_pass", *p_.wall_cut);
      if (p_.finish_feed) put("finish_feed", *p_.finish_feed);
      out_.differs += ", the wall is finished on every level";
    }
    if (!nothing(p_.floor_cut)) out_.differs += ", nothing is left at the floor for finishing";
    if (p_.plunge_feed) put("plunge_feed", *p_.plunge_feed);
    put("step_factor", Value(0.75));
    put("plunge_factor", Value(0.5));
    c_.reference = absolute(p_.reference);
    const Value gap = subtract(p_.reference, p_.surface);
    if (!nothing(gap)) {
      const auto n = known_number(gap);
      c_.surface = absolute(n && *n < 0 ? gap : negate(gap));
      c_.surface.base = LevelBase::from_reference;
    }
    out_.feed = p_.mill_feed;
    return done();
  }

  /// Whole sizes at the place of the tool, climb milling; the allowances are taken at last.
  std::optional<PocketForm> by_whole_sizes() {
    if (!start(false) || !square()) return std::nullopt;
    if (p_.corner && !s_.radius && !nothing(p_.wall_left))
      out_.differs +=
          ", a tool with a greater radius than that of the corners is refused there (leave their radius out)";
    const bool climb = p_.ccw != (s_.sense == SpindleState::ccw);
    if (!climb)
      out_.differs += s_.mirrors ? ", it is climb milling (conventional in the source; the other way round on both "
                                   "where the frame is mirrored)"
                                 : ", it is climb milling (conventional in the source)";
    if (p_.circle) {
      put("radius", p_.radius);
    } else {
      put("length", turned() ? p_.width : p_.length);
      put("width", turned() ? p_.length : p_.width);
      if (p_.corner) put("corner", *p_.corner);
    }
    put("infeed", p_.infeed);
    if (p_.step) put("step", *p_.step);
    if (!nothing(p_.floor_cut)) put("floor_stock", *p_.floor_cut);
    if (!nothing(p_.wall_cut)) put("wall_stock", *p_.wall_cut);
    if (p_.plunge_feed) put("plunge_feed", *p_.plunge_feed);
    if (p_.mill_feed) put("mill_feed", *p_.mill_feed);
    const bool finishes = !nothing(p_.floor_cut) || !nothing(p_.wall_cut);
    if (finishes && p_.finish_plunge_feed) put("finish_plunge_feed", *p_.finish_plunge_feed);
    if (finishes && p_.finish_feed) put("finish_feed", *p_.finish_feed);
    c_.surface = absolute(p_.surface);
    const auto top = known_number(p_.surface), low = known_number(p_.bottom);
    c_.reference = absolute(Value(top && low && *top < *low ? -s_.clearance : s_.clearance));
    c_.reference.base = LevelBase::from_surface;
    return done();
  }

  /// Whole sizes at the place of the tool, with a sense; the allowances are taken at last in the same call, and the
  /// step is a factor of the tool's diameter.
  std::optional<PocketForm> by_one_call() {
    if (!start(false, true)) return std::nullopt;
    const auto feed = p_.mill_feed ? p_.mill_feed : s_.feed;
    const auto plunge = p_.plunge_feed ? p_.plunge_feed : feed;
    if (!feed) return why = "the feed in force is not known here", std::nullopt;
    if (p_.circle) {
      put("radius", p_.radius);
    } else {
      put("length", p_.length);
      put("width", p_.width);
      if (p_.corner) put("corner", slot() ? scale(p_.width, 0.5) : *p_.corner);
      if (p_.angle != 0) put("angle", Value(p_.angle));
    }
    put("infeed", p_.infeed);
    if (!slot() && !put_step()) return std::nullopt;
    const bool finishes = !nothing(p_.floor_cut) || !nothing(p_.wall_cut);
    if (!nothing(p_.wall_cut)) put("wall_stock", *p_.wall_cut);
    if (!nothing(p_.floor_cut)) put("floor_stock", *p_.floor_cut);
    put("operation", Value(finishes ? 0 : 1));
    put("sense", Value(p_.ccw != (s_.sense == SpindleState::ccw) ? 0 : 1));
    put("mill_feed", *feed);
    put("plunge_feed", *plunge);
    if (finishes && p_.finish_feed) put("finish_feed", *p_.finish_feed);
    if (finishes && p_.finish_infeed) put("finish_infeed", *p_.finish_infeed);
    c_.surface = absolute(p_.surface);
    c_.reference = absolute(p_.reference);
    return done();
  }

  /// Whole sizes at a place of its own; roughing and finishing are two calls.
  std::optional<PocketForm> by_calls() {
    if (!start(true)) return std::nullopt;
    if (!p_.u || !p_.v) return why = "the place of the pocket is not known here", std::nullopt;
    const auto feed = p_.mill_feed ? p_.mill_feed : s_.feed;
    if (!feed || !p_.plunge_feed) return why = "the feed in force is not known here", std::nullopt;
    if (p_.circle) {
      put("radius", p_.radius);
    } else {
      put("length", p_.length);
      put("width", p_.width);
      if (p_.corner)
        put("corner", *p_.corner);
      else if (s_.radius)
        put("corner", Value(*s_.radius));
      else
        out_.differs += ", the corners are left to the cycle (no radius: that of the tool)";
    }
    put("u", *p_.u);
    put("v", *p_.v);
    if (!p_.circle && p_.angle != 0) put("angle", Value(p_.angle));
    put("infeed", p_.infeed);
    if (!p_.equal_levels) out_.differs += ", the levels are equal";
    if (p_.step) put("step", *p_.step);
    const bool finishes = !nothing(p_.floor_cut) || !nothing(p_.wall_cut);
    if (!nothing(p_.wall_cut)) put("wall_stock", *p_.wall_cut);
    if (!nothing(p_.floor_cut)) put("floor_stock", *p_.floor_cut);
    put("sense", Value(p_.ccw ? 3 : 2));
    HoleCycle finish = c_;
    put("mill_feed", *feed);
    put("plunge_feed", *p_.plunge_feed);
    put("variant", Value(11));
    c_.surface = absolute(p_.surface);
    c_.reference = absolute(p_.reference);
    auto form = done();
    if (!finishes) return form;
    const HoleCycle levels = c_;
    c_ = std::move(finish);
    put("mill_feed", p_.finish_feed ? *p_.finish_feed : *feed);
    put("plunge_feed", p_.finish_plunge_feed ? *p_.finish_plunge_feed : *p_.plunge_feed);
    put("variant", Value(12));
    c_.surface = levels.surface;
    c_.reference = levels.reference;
    c_.bottom = levels.bottom;
    c_.retract = levels.retract;
    form->cycles.push_back(c_);
    form->differs += ", the finishing is a call of its own";
    return form;
  }

 private:
  static Level absolute(Value v) {
    Level l;
    l.value = without_text(std::move(v));
    l.given = true;
    return l;
  }
  void put(const char* name, Value v) { c_.mill.words.emplace_back(name, without_text(std::move(v))); }
  bool start(bool own_place, bool finish_levels = false) {
    c_ = HoleCycle{};
    c_.kind = HoleKind::mill;
    c_.mill.shape = p_.circle ? "pocket.circle" : "pocket.rect";
    out_ = PocketForm{};
    out_.differs = "levels, rounds and the ways between them are those of the target's cycle" + p_.differs;
    if (p_.finish_infeed && !finish_levels) out_.differs += ", the wall is finished in one cut or level by level";
    if (p_.dives && !own_place) out_.differs += ", it goes into the depth at feed (in rapid in the source)";
    if (!own_place && (!p_.u || !p_.v)) return true;
    if (own_place) return true;
    const auto there = [](const std::optional<Value>& a, const std::optional<Value>& b) {
      return a && b && equal(*a, *b);
    };
    if (there(p_.u, s_.u) && there(p_.v, s_.v)) return true;
    out_.u = p_.u;
    out_.v = p_.v;
    return true;
  }
  /// The source leaves the step in the plane to its cycle.
  [[nodiscard]] bool slot() const { return p_.round_ends() && !p_.step_said; }
  /// As a factor of the tool's diameter.
  bool put_step() {
    double factor = 0.5;
    constexpr double widest = 1.4;  // of the radius: beyond it the source leaves material where its rounds turn
    const auto step = p_.step ? known_number(*p_.step) : std::nullopt;
    if (step && s_.radius && *step > widest * *s_.radius)
      return why = "the step in the plane is wider than the target's cycle makes it", false;
    if (step && s_.radius && *step > 0)
      factor = *step / (2 * *s_.radius);
    else
      out_.differs += ", the step in the plane is the radius of the tool";
    put("step_factor", Value(factor));
    return true;
  }
  [[nodiscard]] bool turned() const { return std::lround(p_.angle / 90) % 2 != 0; }
  bool square() {
    if (p_.circle || std::fabs(std::remainder(p_.angle, 90)) < 1e-9) return true;
    why = "the pocket lies at an angle";
    return false;
  }
  bool corners_of_the_tool() {
    if (p_.circle || !p_.corner) return true;
    const auto corner = known_number(*p_.corner);
    if (slot() && !s_.radius) return why = "the ends of the slot would get the radius of the tool", false;
    if (!s_.radius || !corner) {
      out_.differs += ", the corners get the radius of the tool" +
                      (corner ? ": the same part only with a tool of radius " + shortest(*corner) : std::string());
      return true;
    }
    if (std::fabs(*corner - *s_.radius) <= near) return true;
    why = "its corners have the radius " + shortest(*corner) + ", those of the target's cycle that of the tool, " +
          shortest(*s_.radius);
    return false;
  }
  std::optional<PocketForm> done() {
    c_.bottom = absolute(p_.bottom);
    c_.retract = absolute(p_.retract);
    out_.retract = p_.retract;
    out_.cycles.push_back(c_);
    return out_;
  }

  const PocketSource& s_;
  const Pocket& p_;
  HoleCycle c_;
  PocketForm out_;
};

}  // namespace

std::optional<PocketForm> similar_pocket(const PocketSource& source, const std::function<bool(const Cycle&)>& native,
                                         std::string* why) {
  why->clear();
  const auto pocket = Reader(source, why).read();
  if (!pocket) return std::nullopt;
  for (const auto form : {&Teller::by_half_sizes, &Teller::by_whole_sizes, &Teller::by_calls, &Teller::by_one_call}) {
    Teller teller(source, *pocket);
    auto said = (teller.*form)();
    if (!said) {
      if (why->empty()) *why = teller.why;
      continue;
    }
    bool all = true;
    for (const auto& c : said->cycles) all = all && native(Cycle{c});
    if (all) return said;
  }
  if (why->empty()) *why = "the target has no cycle of its own for it";
  return std::nullopt;
}

}  // namespace cnctrans::ir::passes
