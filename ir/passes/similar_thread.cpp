// Threads as the target's own cycle: the same lines at full depth, other infeeds.
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "ir/passes/cycle_computed.h"
#include "ir/passes/machining_moves.h"
#include "ir/passes/similar_cycles.h"

namespace cnctrans::ir::passes {

namespace {

constexpr double tiny = 1e-9;

class ThreadForms {
 public:
  ThreadForms(const SimilarSource& source, std::string* why)
      : s_(source), why_(*why), k_(source.modes.diameter == DiameterMode::radius ? 1 : 2) {}

  std::optional<SimilarForm> find() {
    std::optional<SimilarForm> form;
    if (s_.named.name == "turn.thread")
      form = section_to_counted();
    else if (s_.named.name == "thread.counted")
      form = counted_to_section();
    else
      return no("no cycle of the target is known to leave the same thread");
    if (!form || !s_.target.native_cycle(Cycle{form->cycle})) return no("the target has none of its kind");
    return form;
  }

 private:
  std::nullopt_t no(std::string text) {
    if (why_.empty()) why_ = std::move(text);
    return std::nullopt;
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
  static Value clean(const Value& v) { return v.literal() ? Value(std::round(v.number * 1e9) / 1e9 + 0.0) : v; }
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

  std::optional<SimilarForm> section_to_counted() {
    for (const char* other : {"exit", "pitch_change", "repair"}) {
      if (has(other) && number(other) != 0.0)
        return no(std::string("the thread has words that the target lacks: ") + other);
    }
    if (has("measured")) return no("a thread is repaired");
    const auto depth = number("depth"), infeed = number("infeed"), pitch = number("pitch");
    const auto angle = number("infeed_angle", 30), x = number("x"), x_end = number("x_end");
    if (!depth || *depth == 0 || !infeed || *infeed == 0 || !pitch || !angle)
      return no("the senses of its depth, infeed, pitch and angle are known only when the program runs");
    const bool cylinder = (x && x_end && *x == *x_end) || equal(word("x"), word("x_end"));
    if (*pitch > 0 && !cylinder) return no("its pitch counts along the slope");
    const auto entry = number("entry", *angle == 0 ? 0 : *angle > 0 ? 1 : 2);
    if (!entry || *entry < 0 || *entry > 2) return no("the target has no such way of infeed");
    const auto idle = has("finish_stock") ? number("finish_stock") : std::optional(1.0);
    if (!idle) return no("whether it repeats its last pass is known only when the program runs");
    SimilarForm f;
    const Value t = positive(word("depth"), *depth), a = unsigned_word(word("finish_stock"));
    const Value b = positive(word("infeed"), *infeed), rough = subtract(t, a);
    const double tangent = tangent_of(*angle);
    f.cycle.name = "thread.counted";
    put(f, "pitch", positive(word("pitch"), *pitch));
    put(f, "z", word("z"));
    put(f, "z_end", word("z_end"));
    put(f, "x", word("x"));
    put(f, "x_end", word("x_end"));
    put(f, "run_in", *entry == 0 ? Value(0.0) : short_of(scale(t, tangent)));  // the last pass begins at z itself
    put(f, "run_out", Value(0.0));
    put(f, "depth", t);
    put(f, "finish_stock", a);
    const double flank = *entry == 0 ? 0 : *entry == 2 ? -std::fabs(*angle) : std::fabs(*angle);
    put(f, "infeed_angle", Value(flank));
    put(f, "start_angle", word("start_angle"));
    const Value ratio = b.is(1) ? rough : quotient(rough, b);
    const Value passes = rounded_up(*infeed > 0 ? squared(ratio) : ratio);
    if (*entry == 2 && !passes.literal()) return no(flank_of_the_last);
    put(f, "passes", passes);
    put(f, "idle", Value(*idle == 0 ? 1.0 : 0.0));
    put(f, "variant", Value((*infeed > 0 ? 3 : 1) + (*depth < 0 ? 1 : 0)));
    put(f, "starts", has("starts") ? word("starts") : Value(1.0));
    const Value lift = unsigned_word(word("clearance"));
    if (!lift.is(0)) put(f, "withdrawal", lift);
    f.after = {clean(across(word("x"), lift, *depth)), clean(word("z"))};
    f.differs = infeeds(passes) + ", and its way begins a little before the thread for the flank";
    return f;
  }
  /// Infeeds on both flanks in turn.
  static constexpr auto flank_of_the_last =
      "the flank of its last pass depends on a number of passes that only the run knows";

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
    if (*idle > 1 || (*idle == 1 && *stock > tiny)) return no("the target has no idle passes");
    if (!equal(word("x"), word("x_end"))) return no("the thread is a cone");
    const bool inside = std::fmod(*variant, 2) == 0, linear = *variant < 3;
    const Value t = unsigned_word(word("depth")), a = unsigned_word(word("finish_stock")), n = word("passes");
    if (*angle < 0 && !(n.literal() && t.literal() && a.literal())) return no(flank_of_the_last);
    const Value rough = subtract(t, a);
    const double tangent = tangent_of(*angle);
    const Value from = *way < 0 ? add(word("z"), word("run_in")) : subtract(word("z"), word("run_in"));
    const Value to = *way < 0 ? subtract(word("z_end"), word("run_out")) : add(word("z_end"), word("run_out"));
    const Value shift = short_of(scale(t, tangent));
    const Value high = Value(*lift != 0 ? std::fabs(*lift) : 1.0);
    SimilarForm f;
    f.cycle.name = "turn.thread";
    put(f, "x", word("x"));
    put(f, "z", *angle == 0 ? from : *way < 0 ? subtract(from, shift) : add(from, shift));
    put(f, "x_end", word("x"));
    put(f, "z_end", to);
    put(f, "depth", inside ? negate(t) : t);
    const Value each = up_to_grid(n.is(1) ? rough : quotient(rough, linear ? n : root(n)));
    put(f, "infeed", linear ? negate(each) : each);
    put(f, "clearance", high);
    if (*stock > tiny || *idle == 1) put(f, "finish_stock", a);
    put(f, "pitch", unsigned_word(word("pitch")));
    put(f, "infeed_angle", Value(*angle));
    if (!word("start_angle").is(0)) put(f, "start_angle", word("start_angle"));
    if (has("starts") && number("starts") != 1.0 && number("starts") != 0.0) put(f, "starts", word("starts"));
    f.after = {clean(across(word("x"), high, inside ? -1 : 1)), clean(from)};
    f.differs = "the infeeds follow from the depth of the first pass";
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
