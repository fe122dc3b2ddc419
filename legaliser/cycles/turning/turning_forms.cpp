#include "legaliser/cycles/turning/turning_forms.h"

#include <cmath>
#include <string>
#include <utility>

#include "base/noise.h"
#include "base/tiny.h"
#include "legaliser/cycles/parts/cycle_computed.h"

namespace cnctrans::ir::passes {

namespace {

class Forms {
 public:
  Forms(const NamedCycle& cycle, double k, const TurnStart& start, int places)
      : c_(cycle), k_(k), start_(start), grid_(std::pow(10.0, places)) {}
  std::vector<TurnForm> out;

  void all() {
    if (c_.name == "thread.chased") {
      chased_to_counted();
      chased_taper_to_counted();
      chased_to_section();
    } else if (c_.name == "thread.counted") {
      counted_to_chased();
      counted_taper_to_chased();
      counted_to_section();
    } else if (c_.name == "turn.thread") {
      section_to_counted();
      section_to_chased();
    }
  }

 private:
  [[nodiscard]] bool has(std::string_view name) const {
    for (const auto& [w, v] : c_.words) {
      if (w == name) return true;
    }
    return false;
  }
  [[nodiscard]] Value word(std::string_view name, double otherwise = 0) const {
    for (const auto& [w, v] : c_.words) {
      if (w != name) continue;
      if (const auto n = v.literal() ? std::optional(v.number) : constant_value(v.expr)) return Value(*n);
      Value plain = v;
      plain.text = {};
      return plain;
    }
    return Value(otherwise);
  }
  static Value clean(const Value& v) { return v.literal() ? Value(without_noise(v.number)) : v; }
  static void put(TurnForm& f, std::string_view name, const Value& v) {
    f.cycle.words.emplace_back(std::string(name), clean(v));
  }
  static void put_unless_zero(TurnForm& f, std::string_view name, const Value& v) {
    if (!v.is(0)) put(f, name, v);
  }
  static Value positive(const Value& v) { return v.literal() ? Value(std::fabs(v.number)) : v; }
  static Value root(const Value& v) {
    return v.literal() ? Value(std::sqrt(v.number)) : Value(call(Function::sqrt, {v.expr}));
  }
  static Value ratio(const Value& a, const Value& b) { return b.is(1) ? a : quotient(a, b); }
  /// The value on the target's grid, not below it.
  [[nodiscard]] Value rounded_up(const Value& v) const {
    if (!v.literal()) return add(v, Value(1 / grid_));
    return Value(std::ceil(v.number * grid_ - 1e-6) / grid_);
  }
  [[nodiscard]] Value across(const Value& base, const Value& by, double sense) const {
    return sense < 0 ? subtract(base, scale(by, k_)) : add(base, scale(by, k_));
  }
  static bool one_start(const Value& v) { return v.literal() && v.number < 1.5; }

  // --- a number of passes, from the place of the call ---------------------------------------------------------------

  struct Chased {
    double out = 1;
    Value crest, depth, last, passes, pitch, end;
  };
  bool read(Chased& c) const {
    if (!start_.x || !start_.z || !has("x_end") || !word("cone").is(0) || !word("exit").is(0)) return false;
    const Value above = subtract(*start_.x, word("x_end"));
    if (!above.literal() || above.number == 0 || !word("infeed_angle").literal()) return false;
    c.out = above.number < 0 ? -1 : 1;
    c.depth = positive(word("depth"));
    c.last = positive(word("finish_stock"));
    c.passes = word("passes", 1);
    c.pitch = positive(word("pitch"));
    c.end = word("z_end");
    c.crest = across(word("x_end"), c.depth, c.out);
    return c.last.literal();
  }
  /// How far the place of the call is from the crest.
  [[nodiscard]] Value lift(const Chased& c) const {
    const Value above = scale(subtract(*start_.x, word("x_end")), c.out / k_);
    return subtract(above, c.depth);
  }

  void chased_to_counted() {
    Chased c;
    if (!read(c)) return;
    const Value away = lift(c);
    if (away.literal() && away.number < tiny) return;
    TurnForm f;
    f.proved = away.literal();  // a lift of zero would mean another one
    f.cycle.name = "thread.counted";
    const bool single = c.passes.literal() && c.passes.number < 1.5;
    put(f, "pitch", c.pitch);
    put(f, "z", *start_.z);
    put(f, "z_end", c.end);
    put(f, "x", c.crest);
    put(f, "x_end", c.crest);
    put(f, "run_in", Value(0.0));
    put(f, "run_out", Value(0.0));
    put(f, "depth", c.depth);
    put(f, "finish_stock", single ? Value(0.0) : c.last);
    put(f, "infeed_angle", positive(word("infeed_angle")));
    put(f, "start_angle", Value(0.0));
    put(f, "passes", single ? Value(1.0) : subtract(c.passes, Value(1.0)));
    put(f, "idle", Value(!single && c.last.is(0) ? 1.0 : 0.0));
    put(f, "variant", Value(c.out > 0 ? 3.0 : 4.0));
    put(f, "starts", word("starts", 1));
    put(f, "withdrawal", away);
    out.push_back(std::move(f));
  }

  void chased_taper_to_counted() {
    for (const auto& [w, v] : c_.words) {
      if (!word(w).literal()) return;
    }
    if (!start_.x || !start_.z || !start_.x->literal() || !start_.z->literal()) return;
    if (word("cone").is(0) || !word("exit").is(0) || !has("x_end") || word("finish_stock").is(0)) return;
    const double cone = word("cone").number, end = word("x_end").number, passes = std::round(word("passes", 1).number);
    if (passes < 2) return;
    const double sense = start_.x->number < end ? -1 : 1, depth = std::fabs(word("depth").number);
    const double slope = std::tan(cone * std::acos(-1.0) / 180) * k_;
    const double last = end + sense * depth * k_, length = std::fabs(word("z_end").number - start_.z->number);
    const double first = last - slope * length;
    const double lift = sense * (start_.x->number - sense * std::fmax(sense * first, sense * last)) / k_;
    if (lift < tiny) return;
    TurnForm f;
    f.cycle.name = "thread.counted";
    put(f, "pitch", positive(word("pitch")));
    put(f, "z", *start_.z);
    put(f, "z_end", word("z_end"));
    const auto places = [](double v) { return Value(std::round(v * 1e6) / 1e6); };
    put(f, "x", places(first));
    put(f, "x_end", places(last));
    put(f, "run_in", Value(0.0));
    put(f, "run_out", Value(0.0));
    put(f, "depth", Value(depth));
    put(f, "finish_stock", positive(word("finish_stock")));
    put(f, "infeed_angle", positive(word("infeed_angle")));
    put(f, "start_angle", Value(0.0));
    put(f, "passes", Value(passes - 1));
    put(f, "idle", Value(0.0));
    put(f, "variant", Value(sense > 0 ? 3.0 : 4.0));
    put(f, "starts", word("starts", 1));
    put(f, "withdrawal", places(lift));
    out.push_back(std::move(f));
  }

  void chased_to_section() {
    Chased c;
    if (!read(c) || !word("infeed_angle").is(0) || !one_start(word("starts", 1))) return;
    TurnForm f;
    f.proved = true;
    f.cycle.name = "turn.thread";
    const bool single = c.passes.literal() && c.passes.number < 1.5;
    put(f, "x", c.crest);
    put(f, "z", *start_.z);
    put(f, "x_end", c.crest);
    put(f, "z_end", c.end);
    put(f, "depth", c.out < 0 ? negate(c.depth) : c.depth);
    put(f, "infeed",
        single ? c.depth : rounded_up(ratio(subtract(c.depth, c.last), root(subtract(c.passes, Value(1.0))))));
    put(f, "clearance", lift(c));
    if (!single) put(f, "finish_stock", c.last);
    put(f, "pitch", c.pitch);
    put(f, "infeed_angle", Value(0.0));
    out.push_back(std::move(f));
  }

  // --- a number of passes, between two points -----------------------------------------------------------------------

  struct Counted {
    bool inside = false, linear = false;
    Value from, to, crest, clear, lift, depth, stock, passes, idle;
  };
  bool read(Counted& c) const {
    const Value variant = word("variant");
    if (!variant.literal() || variant.number < 1 || variant.number > 4) return false;
    c.inside = std::fmod(variant.number, 2) == 0;
    c.linear = variant.number < 3;
    c.crest = word("x");
    if (!equal(c.crest, word("x_end")) || !word("size").is(0)) return false;
    const Value run_in = word("run_in"), run_out = word("run_out");
    c.from = word("z");
    c.to = word("z_end");
    const Value way = subtract(c.to, c.from);
    if (!run_in.is(0) || !run_out.is(0)) {
      if (!way.literal()) return false;
      c.from = way.number < 0 ? add(c.from, run_in) : subtract(c.from, run_in);
      c.to = way.number < 0 ? subtract(c.to, run_out) : add(c.to, run_out);
    }
    const Value lift = word("withdrawal");
    if (!lift.literal()) return false;
    c.lift = Value(lift.number != 0 ? std::fabs(lift.number) : 1);
    c.clear = across(c.crest, c.lift, c.inside ? -1 : 1);
    c.depth = positive(word("depth"));
    c.stock = positive(word("finish_stock"));
    c.passes = word("passes");
    c.idle = word("idle");
    return c.stock.literal() && c.idle.literal();
  }

  /// The same on a cone, as numbers: the line through the crests, and the angle that the word has room for.
  void counted_taper_to_chased() {
    for (const auto& [w, v] : c_.words) {
      if (!word(w).literal()) return;
    }
    const double variant = word("variant").number, way = word("z_end").number - word("z").number;
    const double rise = word("x_end").number - word("x").number, angle = word("infeed_angle").number;
    if (way == 0 || rise == 0 || angle < 0 || !word("start_angle").is(0) || !word("idle").is(0)) return;
    if ((variant != 3 && variant != 4) || !word("size").is(0) || word("finish_stock").number <= 0) return;
    const double dir = way < 0 ? -1 : 1, sense = variant == 4 ? -1 : 1;
    const double from = word("z").number - dir * word("run_in").number;
    const double to = word("z_end").number + dir * word("run_out").number;
    const auto crest = [&](double z) { return word("x").number + (z - word("z").number) * rise / way; };
    const double lift = word("withdrawal").is(0) ? 1 : std::fabs(word("withdrawal").number);
    const double depth = std::fabs(word("depth").number);
    TurnForm f;
    f.cycle.name = "thread.chased";
    f.from = {clean(Value(sense * std::fmax(sense * crest(from), sense * crest(to)) + sense * lift * k_)),
              clean(Value(from))};
    put(f, "x_end", Value(crest(to) - sense * depth * k_));
    put(f, "z_end", Value(to));
    put(f, "pitch", positive(word("pitch")));
    const double slope = (crest(to) - crest(from)) / k_ / std::fabs(to - from);
    put(f, "cone", Value(std::round(std::atan(slope) * 180 / std::acos(-1.0) * grid_) / grid_));
    put_unless_zero(f, "infeed_angle", Value(angle));
    put(f, "depth", Value(depth));
    put(f, "finish_stock", word("finish_stock"));
    put(f, "passes", Value(word("passes").number + 1));
    if (!one_start(word("starts"))) put(f, "starts", word("starts"));
    out.push_back(std::move(f));
  }

  void counted_to_chased() {
    Counted c;
    const Value angle = word("infeed_angle");
    if (!read(c) || !angle.literal() || angle.number < 0 || !word("start_angle").is(0)) return;
    if (c.linear && !c.passes.is(1)) return;
    TurnForm f;
    f.proved = true;
    f.cycle.name = "thread.chased";
    f.from = {clean(c.clear), clean(c.from)};
    put(f, "x_end", across(c.crest, c.depth, c.inside ? 1 : -1));
    put(f, "z_end", c.to);
    put(f, "pitch", positive(word("pitch")));
    put_unless_zero(f, "infeed_angle", angle);
    put(f, "depth", c.depth);
    if (c.stock.number > 0 && c.idle.is(0)) {
      put(f, "finish_stock", c.stock);
      put(f, "passes", add(c.passes, Value(1.0)));
    } else if (c.stock.is(0) && c.idle.is(1)) {
      put(f, "passes", add(c.passes, Value(1.0)));
    } else if (c.stock.is(0) && c.idle.is(0)) {
      // The last pass of the section law as the last pass by itself.
      if (!c.passes.is(1)) {
        const Value part = ratio(subtract(c.passes, Value(1.0)), c.passes);
        put(f, "finish_stock", subtract(c.depth, product(c.depth, root(part))));
      }
      put(f, "passes", c.passes);
    } else {
      return;
    }
    if (!one_start(word("starts"))) put(f, "starts", word("starts"));
    out.push_back(std::move(f));
  }

  void counted_to_section() {
    Counted c;
    if (!read(c) || !word("infeed_angle").is(0) || !one_start(word("starts"))) return;
    if (c.stock.number > 0 ? !c.idle.is(0) : c.idle.number > 1) return;
    TurnForm f;
    f.proved = true;
    f.cycle.name = "turn.thread";
    const Value rough = subtract(c.depth, c.stock);
    put(f, "x", c.crest);
    put(f, "z", c.from);
    put(f, "x_end", c.crest);
    put(f, "z_end", c.to);
    put(f, "depth", c.inside ? negate(c.depth) : c.depth);
    put(f, "infeed", c.linear ? negate(rounded_up(ratio(rough, c.passes))) : rounded_up(ratio(rough, root(c.passes))));
    put(f, "clearance", c.lift);
    if (c.stock.number > 0 || c.idle.is(1)) put(f, "finish_stock", c.stock);
    put(f, "pitch", positive(word("pitch")));
    put(f, "infeed_angle", Value(0.0));
    put_unless_zero(f, "start_angle", word("start_angle"));
    out.push_back(std::move(f));
  }

  // --- infeeds by the section ---------------------------------------------------------------------------------------

  struct Section {
    Value depth, rough, stock;
    double passes = 0;
    bool inside = false, linear = false;
  };
  /// Only as numbers: whether the last infeed comes out even is a matter of them.
  bool read(Section& s) const {
    for (const auto& [w, v] : c_.words) {
      if (!word(w).literal()) return false;
    }
    const double depth = word("depth").number, b = word("infeed").number;
    s.inside = depth < 0;
    s.depth = Value(std::fabs(depth));
    s.stock = positive(word("finish_stock"));
    s.rough = Value(s.depth.number - s.stock.number);
    if (b == 0 || s.rough.number < tiny || !equal(word("x"), word("x_end"))) return false;
    s.linear = b < 0;
    const double n = s.rough.number / std::fabs(b);
    s.passes = std::round(s.linear ? n : n * n);
    return s.passes >= 1;
  }
  [[nodiscard]] Value safe(const Section& s) const {
    return across(word("x"), positive(word("clearance")), s.inside ? -1 : 1);
  }

  void section_to_counted() {
    Section s;
    if (!read(s) || word("clearance").is(0)) return;
    TurnForm f;
    f.cycle.name = "thread.counted";
    put(f, "pitch", positive(word("pitch")));
    put(f, "z", word("z"));
    put(f, "z_end", word("z_end"));
    put(f, "x", word("x"));
    put(f, "x_end", word("x"));
    put(f, "run_in", Value(0.0));
    put(f, "run_out", Value(0.0));
    put(f, "depth", s.depth);
    put(f, "finish_stock", s.stock);
    put(f, "infeed_angle", Value(0.0));
    put(f, "start_angle", word("start_angle"));
    put(f, "passes", Value(s.passes));
    put(f, "idle", Value(has("finish_stock") && s.stock.is(0) ? 1.0 : 0.0));
    put(f, "variant", Value((s.linear ? 1 : 3) + (s.inside ? 1 : 0)));
    put(f, "starts", Value(std::fmax(1, std::round(word("starts").number))));
    put(f, "withdrawal", positive(word("clearance")));
    out.push_back(std::move(f));
  }

  void section_to_chased() {
    Section s;
    if (!read(s) || !word("start_angle").is(0) || (s.linear && s.passes > 1)) return;
    TurnForm f;
    f.cycle.name = "thread.chased";
    f.from = {clean(safe(s)), clean(word("z"))};
    put(f, "x_end", across(word("x"), s.depth, s.inside ? 1 : -1));
    put(f, "z_end", word("z_end"));
    put(f, "pitch", positive(word("pitch")));
    put(f, "depth", s.depth);
    const bool last = has("finish_stock");
    const double n = s.passes;
    if (last)
      put_unless_zero(f, "finish_stock", s.stock);
    else if (n > 1)
      put(f, "finish_stock", Value(s.depth.number * (1 - std::sqrt((n - 1) / n))));
    put(f, "passes", Value(last ? n + 1 : n));
    out.push_back(std::move(f));
  }

  const NamedCycle& c_;
  double k_;
  const TurnStart& start_;
  double grid_;
};

}  // namespace

std::vector<TurnForm> turning_forms(const NamedCycle& cycle, double k, const TurnStart& start, int places) {
  Forms forms(cycle, k, start, places);
  forms.all();
  return std::move(forms.out);
}

}  // namespace cnctrans::ir::passes
