// Threads as the target's own cycle: the same lines at full depth, other infeeds.
#include <cmath>
#include <numbers>

#include "base/noise.h"
#include "base/text.h"
#include "base/tiny.h"
#include "legaliser/cycles/parts/cycle_computed.h"
#include "legaliser/cycles/turning/machining_moves.h"
#include "legaliser/cycles/turning/similar_cycles.h"

namespace cnctrans::ir::passes {

namespace {

class ThreadForms {
 public:
  ThreadForms(const SimilarSource& source, std::string* why)
      : s_(source), why_(*why), k_(source.modes.diameter == DiameterMode::radius ? 1 : 2) {}

  std::optional<SimilarForm> find() {
    const bool section = s_.named.name == "turn.thread", counted = s_.named.name == "thread.counted";
    if (!section && !counted) return no("no cycle of the target is known to leave the same thread");
    std::optional<SimilarForm> form;
    if (of_the_target("thread.counted") && section)
      form = section_to_counted();
    else if (of_the_target("turn.thread") && counted)
      form = counted_to_section();
    else if (of_the_target("thread.chased"))
      form = section ? section_to_chased() : counted_to_chased();
    if (!form || !s_.target.native_cycle(Cycle{form->cycle}))
      return no("no cycle of the target is written for its kind");
    return form;
  }

 private:
  std::nullopt_t no(std::string text) {
    if (why_.empty()) why_ = std::move(text);
    return std::nullopt;
  }
  [[nodiscard]] bool of_the_target(const char* name) const {
    NamedCycle c;
    c.name = name;
    return s_.target.native_cycle(Cycle{c});
  }
  [[nodiscard]] bool has(std::string_view name) const {
    for (const auto& [w, v] : s_.named.words) {
      if (w == name) return true;
    }
    return false;
  }
  [[nodiscard]] Value word(std::string_view name, double otherwise = 0) const {
    for (const auto& [w, v] : s_.named.words) {
      if (w != name) continue;
      if (v.literal()) return Value(v.number);
      if (const auto n = constant_value(v.expr)) return Value(*n);
      Value plain = v;
      plain.text = {};
      return plain;
    }
    return Value(otherwise);
  }
  /// By the numbers that the head of the program gives; nullopt: only the run knows.
  [[nodiscard]] std::optional<double> number(std::string_view name, double otherwise = 0) const {
    const Value v = s_.fold(word(name, otherwise));
    return v.literal() ? std::optional(v.number) : constant_value(v.expr);
  }
  static Value clean(const Value& v) { return v.literal() ? Value(without_noise(v.number)) : v; }
  static void put(SimilarForm& f, std::string_view name, const Value& v) {
    f.cycle.words.emplace_back(std::string(name), clean(v));
  }
  /// |v|, of a value whose sign is known.
  static Value positive(const Value& v, double sign) {
    if (v.literal()) return Value(std::fabs(v.number));
    const auto* minus = std::get_if<Unary>(&v.expr->node);
    if (sign < 0 && minus != nullptr && minus->op == UnaryOp::negate) return Value(minus->operand);
    return sign < 0 ? negate(v) : v;
  }
  /// Of a word that counts without its sign on both controls.
  static Value unsigned_word(const Value& v) { return v.literal() ? Value(std::fabs(v.number)) : v; }
  [[nodiscard]] Value across(const Value& base, const Value& by, double sense) const {
    return sense < 0 ? subtract(base, scale(by, k_)) : add(base, scale(by, k_));
  }
  static Value rounded_up(const Value& v) {
    if (v.literal()) return Value(std::ceil(v.number - 1e-9));
    return Value(call(Function::ceil, {v.expr}));
  }
  /// To six places: what remains is nothing on the depth of a thread.
  static double tangent_of(double degrees) {
    return std::round(std::tan(std::fabs(degrees) * std::numbers::pi / 180) * 1e6) / 1e6;
  }
  static Value squared(const Value& v) {
    return v.literal() ? Value(v.number * v.number) : Value(call(Function::square, {v.expr}));
  }
  static Value root(const Value& v) {
    return v.literal() ? Value(std::sqrt(v.number)) : Value(call(Function::sqrt, {v.expr}));
  }

  /// Infeeds by the section, between two crest points.
  struct Section {
    double depth = 0, infeed = 0, angle = 0, pitch = 0;
    double entry = 0;  ///< 0 radial, 1 down the first flank, 2 on it and in the middle in turn
    bool cylinder = false, repeats = false;
    Value passes;  ///< of roughing
  };
  std::optional<Section> read_section() {
    for (const char* other : {"exit", "pitch_change", "repair"}) {
      if (has(other) && number(other) != 0.0)
        return no(std::string("the thread has words that the target lacks: ") + other);
    }
    if (has("measured")) return no("a thread is repaired");
    const auto depth = number("depth"), infeed = number("infeed"), pitch = number("pitch");
    const auto angle = number("infeed_angle", 30), x = number("x"), x_end = number("x_end");
    if (!depth || *depth == 0 || !infeed || *infeed == 0 || !pitch || !angle)
      return no("the senses of its depth, infeed, pitch and angle are known only when the program runs");
    Section c;
    c.depth = *depth;
    c.infeed = *infeed;
    c.angle = *angle;
    c.pitch = *pitch;
    c.cylinder = (x && x_end && *x == *x_end) || equal(word("x"), word("x_end"));
    if (*pitch > 0 && !c.cylinder) return no("its pitch counts along the slope");
    const auto entry = number("entry", *angle == 0 ? 0 : *angle > 0 ? 1 : 2);
    if (!entry || *entry < 0 || *entry > 2) return no("the target has no such way of infeed");
    c.entry = *angle == 0 ? 0 : *entry;
    const auto idle = has("finish_stock") ? number("finish_stock") : std::optional(1.0);
    if (!idle) return no("whether it repeats its last pass is known only when the program runs");
    c.repeats = *idle == 0;
    const Value rough = subtract(positive(word("depth"), *depth), unsigned_word(word("finish_stock")));
    const Value each = positive(word("infeed"), *infeed), ratio = each.is(1) ? rough : quotient(rough, each);
    c.passes = rounded_up(*infeed > 0 ? squared(ratio) : ratio);
    return c;
  }

  std::optional<SimilarForm> section_to_counted() {
    const auto c = read_section();
    if (!c) return std::nullopt;
    SimilarForm f;
    const Value t = positive(word("depth"), c->depth);
    const Value run_in = c->entry == 1 ? short_of(scale(t, tangent_of(c->angle))) : Value(0.0);
    f.cycle.name = "thread.counted";
    put(f, "pitch", positive(word("pitch"), c->pitch));
    put(f, "z", word("z"));
    put(f, "z_end", word("z_end"));
    put(f, "x", word("x"));
    put(f, "x_end", word("x_end"));
    put(f, "run_in", run_in);  // the last pass begins at z itself
    put(f, "run_out", Value(0.0));
    put(f, "depth", t);
    put(f, "finish_stock", unsigned_word(word("finish_stock")));
    const double flank = c->entry == 0 ? 0 : c->entry == 2 ? -std::fabs(c->angle) : std::fabs(c->angle);
    put(f, "infeed_angle", Value(flank));
    put(f, "start_angle", word("start_angle"));
    put(f, "passes", c->passes);
    put(f, "idle", Value(c->repeats ? 1.0 : 0.0));
    put(f, "variant", Value((c->infeed > 0 ? 3 : 1) + (c->depth < 0 ? 1 : 0)));
    put(f, "starts", has("starts") ? word("starts") : Value(1.0));
    const Value lift = unsigned_word(word("clearance"));
    if (!lift.is(0)) put(f, "withdrawal", lift);
    f.after = {clean(across(word("x"), lift, c->depth)), clean(word("z"))};
    f.differs = infeeds(c->passes);
    if (!run_in.is(0)) f.differs += ", and its way begins a little before the thread for the flank";
    if (c->entry == 2) f.differs += ", on both flanks in turn";
    return f;
  }

  /// From the place of the call to the root (equivalences 25.5): a last pass by itself, one start angle.
  struct Chased {
    Value crest, from, to, depth, stock, lift, passes, pitch;
    double angle = 0;
    bool inside = false;
    std::optional<Value> back{};  ///< along Z, where the source's cycle leaves the tool; nothing: `from`
  };
  /// The cycle ends at the place of its call: behind it the tool goes to `z`, where the source's ends.
  void end_at(SimilarForm& f, const Value& z) const {
    f.after = {};
    if (!equal(*f.before.z, z)) f.after = {f.before.x, z};
    const bool there = s_.start.x && s_.start.z && equal(*s_.start.x, *f.before.x) && equal(*s_.start.z, *f.before.z);
    if (there) f.before = {};
  }
  SimilarForm chased(const Chased& c, std::optional<double> way) const {
    const double out = c.inside ? -1 : 1;
    Value begin = c.from;
    if (c.angle != 0) {  // the last pass begins at `from` itself
      const Value shift = short_of(scale(c.depth, tangent_of(c.angle)));
      begin = way.value_or(-1) < 0 ? add(c.from, shift) : subtract(c.from, shift);
    }
    SimilarForm f;
    f.cycle.name = "thread.chased";
    f.before = {clean(across(c.crest, c.lift, out)), clean(begin)};
    put(f, "x_end", across(c.crest, c.depth, -out));
    put(f, "z_end", c.to);
    put(f, "pitch", c.pitch);
    if (c.angle != 0) put(f, "infeed_angle", Value(std::fabs(c.angle)));
    put(f, "depth", c.depth);
    if (!c.stock.is(0)) put(f, "finish_stock", c.stock);
    put(f, "passes", add(c.passes, Value(1.0)));
    const auto starts = number("starts");
    if (starts != 1.0 && starts != 0.0) put(f, "starts", word("starts"));
    end_at(f, clean(c.back.value_or(c.from)));
    f.differs = infeeds(add(c.passes, Value(1.0)));
    if (c.angle != 0) f.differs += ", and its way begins a little before the thread for the flank";
    return f;
  }
  std::optional<SimilarForm> section_to_chased() {
    const auto s = read_section();
    if (!s) return std::nullopt;
    if (!s->cylinder) return no("the thread is a cone");
    if (number("start_angle") != 0.0) return no("the target's cycle has no start angle");
    const auto way = sense_of_z();
    if (s->entry != 0 && !way) return no("the direction of the thread is known only when the program runs");
    const Value lift = unsigned_word(word("clearance"));
    if (lift.is(0)) return no("it stays on the crest between its passes");
    const Chased c{word("x"),
                   word("z"),
                   word("z_end"),
                   positive(word("depth"), s->depth),
                   unsigned_word(word("finish_stock")),
                   lift,
                   s->passes,
                   positive(word("pitch"), s->pitch),
                   s->entry == 0 ? 0 : s->angle,
                   s->depth < 0};
    auto f = chased(c, way);
    if (s->entry == 2) f.differs += ", down one flank";
    return f;
  }
  std::optional<SimilarForm> counted_to_chased() {
    const auto variant = number("variant"), idle = number("idle"), lift = number("withdrawal");
    const auto angle = number("infeed_angle"), way = sense_of_z(), size = number("size");
    if (!variant || *variant < 1 || *variant > 4 || !idle || size != 0.0 || !lift || !angle || !way)
      return no("its kind, angle, idle passes or direction are known only when the program runs");
    if (!equal(word("x"), word("x_end"))) return no("the thread is a cone");
    if (number("start_angle") != 0.0) return no("the target's cycle has no start angle");
    Chased c{word("x"),
             begin_of(*way),
             end_of(*way),
             unsigned_word(word("depth")),
             unsigned_word(word("finish_stock")),
             Value(*lift != 0 ? std::fabs(*lift) : 1.0),
             word("passes"),
             unsigned_word(word("pitch")),
             *angle,
             std::fmod(*variant, 2) == 0};
    c.back = c.from;
    if (*angle > 0) {  // the source's last pass begins as far along the thread
      const Value shift = short_of(scale(c.depth, tangent_of(*angle)));
      c.from = *way < 0 ? subtract(c.from, shift) : add(c.from, shift);
    }
    auto f = chased(c, way);
    if (*angle < 0) f.differs += ", down one flank";
    f.differs += left_out(*idle - (c.stock.is(0) ? 1 : 0));
    return f;
  }
  /// Idle passes that the target's cycle does not make.
  static std::string left_out(double passes) {
    if (passes < 0.5) return {};
    return passes < 1.5 ? ", without the idle pass at last" : ", without " + shortest(passes) + " of the idle passes";
  }
  [[nodiscard]] Value begin_of(double way) const {
    return way < 0 ? add(word("z"), word("run_in")) : subtract(word("z"), word("run_in"));
  }
  [[nodiscard]] Value end_of(double way) const {
    return way < 0 ? subtract(word("z_end"), word("run_out")) : add(word("z_end"), word("run_out"));
  }

  /// To the places that the target writes.
  [[nodiscard]] Value short_of(const Value& v) const {
    if (!v.literal()) return v;
    const double grid = std::pow(10.0, s_.target.word_decimals);
    return Value(std::round(v.number * grid) / grid);
  }
  static std::string infeeds(const Value& passes) {
    if (!passes.literal()) return "the infeeds follow from a number of passes";
    return shortest(passes.number) + " infeeds by the target's law, the last one at the same depth";
  }

  std::optional<SimilarForm> counted_to_section() {
    const auto variant = number("variant"), idle = number("idle"), size = number("size"), lift = number("withdrawal");
    const auto angle = number("infeed_angle"), stock = number("finish_stock"), way = sense_of_z();
    if (!variant || *variant < 1 || *variant > 4 || !idle || size != 0.0 || !lift || !angle || !stock || !way)
      return no("its kind, angle, idle passes or direction are known only when the program runs");
    if (!equal(word("x"), word("x_end"))) return no("the thread is a cone");
    const bool inside = std::fmod(*variant, 2) == 0, linear = *variant < 3;
    const Value t = unsigned_word(word("depth")), a = unsigned_word(word("finish_stock")), n = word("passes");
    const Value rough = subtract(t, a), from = begin_of(*way);
    const Value shift = *angle > 0 ? short_of(scale(t, tangent_of(*angle))) : Value(0.0);
    const Value high = Value(*lift != 0 ? std::fabs(*lift) : 1.0);
    SimilarForm f;
    f.cycle.name = "turn.thread";
    put(f, "x", word("x"));
    put(f, "z", shift.is(0) ? from : *way < 0 ? subtract(from, shift) : add(from, shift));
    put(f, "x_end", word("x"));
    put(f, "z_end", end_of(*way));
    put(f, "depth", inside ? negate(t) : t);
    const Value each = up_to_grid(n.is(1) ? rough : quotient(rough, linear ? n : root(n)));
    put(f, "infeed", linear ? negate(each) : each);
    put(f, "clearance", high);
    if (*stock > tiny || *idle >= 1) put(f, "finish_stock", a);
    put(f, "pitch", unsigned_word(word("pitch")));
    put(f, "infeed_angle", Value(*angle));
    if (!word("start_angle").is(0)) put(f, "start_angle", word("start_angle"));
    if (has("starts") && number("starts") != 1.0 && number("starts") != 0.0) put(f, "starts", word("starts"));
    f.after = {clean(across(word("x"), high, inside ? -1 : 1)), clean(from)};
    f.differs = "the infeeds follow from the depth of the first pass";
    if (*angle < 0) f.differs += ", in the middle and on one flank in turn";
    f.differs += left_out(*idle - (*stock > tiny ? 0 : 1));
    return f;
  }
  [[nodiscard]] Value up_to_grid(const Value& v) const {
    const double grid = std::pow(10.0, s_.target.word_decimals);
    if (!v.literal()) return add(v, Value(1 / grid));
    return Value(std::ceil(v.number * grid - 1e-6) / grid);
  }
  [[nodiscard]] std::optional<double> sense_of_z() const {
    const auto a = number("z"), b = number("z_end");
    if (!a || !b || *a == *b) return std::nullopt;
    return *b < *a ? -1 : 1;
  }

  const SimilarSource& s_;
  std::string& why_;
  double k_;
};

}  // namespace

std::optional<SimilarForm> similar_thread(const SimilarSource& source, std::string* why) {
  return ThreadForms(source, why).find();
}

}  // namespace cnctrans::ir::passes
