// Patterns of points whose words only the run knows (equivalences 23): a loop over the points.
#include <cmath>

#include "ir/cycles/pattern.h"
#include "legaliser/cycles/parts/cycle_parts.h"

namespace cnctrans::ir::passes {

namespace {

using cycles::PatternKind;

double clean_offset(double x) {
  const double r = std::round(x * 1e10) / 1e10;
  return r == 0 ? 0 : r;
}
double radians(double degrees) {
  return degrees * std::acos(-1.0) / 180;
}

class LoopBuilder {
 public:
  LoopBuilder(const NamedCycle& pattern, const LineInfo& like, const Block& b, const Facts& facts, Editor& editor)
      : pattern_(pattern), facts_(facts), editor_(editor) {
    like_.span = like.span;
    like_.skip_mask = like.skip_mask;
    plane_ = setting_in<Plane>(b, facts, Setting::plane);
  }
  PatternLoop loop;
  std::string error;

  bool build() {
    const auto* row = cycles::find_pattern(pattern_.name);
    if (row == nullptr || !plane_) return fail("the plane is not known here");
    axes_ = plane_axes(*plane_);
    for (const auto& [w, v] : pattern_.words) {
      if (w.starts_with("skip")) return fail("it leaves points out, and which is computed when the program runs");
      if (w == "way" && !v.is(0)) return fail("the tool goes from point to point at a feed of the pattern's own");
    }
    bool done = false;
    switch (row->kind) {
      case PatternKind::line: done = line(); break;
      case PatternKind::row: done = this->row(); break;
      case PatternKind::ring: done = ring(); break;
      case PatternKind::matrix: done = matrix(); break;
      case PatternKind::circle:
      case PatternKind::arc: done = round(row->kind == PatternKind::circle); break;
      default: return fail("its words are computed when the program runs");
    }
    if (!done || !error.empty()) return false;
    // Half a step of room: the number of points may come out of a division.
    loop.again = binary(BinaryOp::gt, as_expr(subtract(count_, k_)), number(0.5));
    return true;
  }

 private:
  bool fail(std::string text) {
    if (error.empty()) error = std::move(text);
    return false;
  }
  [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }
  [[nodiscard]] const Value* find(std::string_view name) const {
    for (const auto& [w, v] : pattern_.words) {
      if (w == name) return &v;
    }
    return nullptr;
  }
  [[nodiscard]] Value word(std::string_view name) const {
    const Value* v = find(name);
    if (v == nullptr) return Value(0.0);
    if (const auto x = v->literal() ? std::optional(v->number) : constant_value(v->expr)) return Value(*x);
    return *v;
  }
  static Value product(const Value& a, const Value& b) {
    if (a.is(0) || b.is(0)) return Value(0.0);
    if (a.literal()) return a.is(1) ? b : scale(b, a.number);
    if (b.literal()) return b.is(1) ? a : scale(a, b.number);
    return Value(binary(BinaryOp::multiply, a.expr, b.expr));
  }
  static Value quotient(const Value& a, const Value& b) {
    if (a.literal() && b.literal()) return Value(a.number / b.number);
    return Value(binary(BinaryOp::divide, as_expr(a), as_expr(b)));
  }
  static Value sum(const Value& a, const Value& b) { return a.is(0) ? b : b.is(0) ? a : add(a, b); }
  static Value difference(const Value& a, const Value& b) { return b.is(0) ? a : subtract(a, b); }
  static Value turned(Function f, const Value& degrees) {
    if (!degrees.literal()) return Value(call(f, {degrees.expr}));
    const double a = radians(degrees.number);
    return Value(clean_offset(f == Function::cos ? std::cos(a) : std::sin(a)));
  }
  std::optional<VarRef> kept(const Value& v) {
    const auto var = editor_.take(like_);
    if (!var) {
      fail("there are no variables left to count its points");
      return std::nullopt;
    }
    loop.taken.push_back(*var);
    loop.setup.push_back(make_assign(like_, *var, as_expr(v)));
    return var;
  }
  /// A name of its own for what has to be computed.
  Value named(const Value& v) {
    if (v.literal() || is_primary(v.expr)) return v;
    const auto var = kept(v);
    return var ? Value(variable(*var)) : v;
  }
  bool count_from(double first, const Value& count) {
    count_ = count;
    const auto k = kept(Value(first));
    if (!k) return false;
    loop.counter = *k;
    k_ = Value(variable(*k));
    return true;
  }
  Block at(const Value& u, const Value& v, WordMode mode) const {
    Block b;
    b.has_motion = true;
    b.motion.kind = MotionKind::rapid;
    b.motion.explicit_code = true;
    b.motion.keeps_modal = false;
    const auto put = [&](AxisId axis, const Value& value) {
      CoordWord w;
      w.axis = axis;
      w.mode = mode;
      w.value = value;
      b.motion.coords.push_back(w);
    };
    if (mode == WordMode::absolute || !u.is(0)) put(axes_.u, u);
    if (mode == WordMode::absolute || !v.is(0)) put(axes_.v, v);
    return b;
  }

  /// Two of length, step and number give the third: length = step (number - 1).
  bool side(Value& step, Value& count) {
    step = word("step");
    count = word("count");
    const int given = static_cast<int>(has("length")) + static_cast<int>(has("step")) + static_cast<int>(has("count"));
    if (given != 2) return fail("it needs two of its length, step and number of points");
    if (!has("step")) {
      step = quotient(word("length"), subtract(count, Value(1.0)));
    } else if (!has("count")) {
      if (!step.literal() || !word("length").literal())
        return fail("its number of points follows from a length and a step that are computed");
      step = Value(std::copysign(step.number, word("length").number));
      count = Value(std::round(std::fabs(word("length").number / step.number)) + 1);
    }
    return true;
  }
  bool line() {
    Value step, count;
    if (!side(step, count) || !count_from(1, named(count))) return false;
    const Value angle = named(word("angle")), d = named(step);
    const Value c = turned(Function::cos, angle), t = turned(Function::sin, angle);
    const auto pu = facts_.position[axes_.u], pv = facts_.position[axes_.v];
    const Value far = product(k_, d);
    loop.next = pu && pv ? at(sum(Value(*pu), product(far, c)), sum(Value(*pv), product(far, t)), WordMode::absolute)
                         : at(product(d, c), product(d, t), WordMode::incremental);
    return true;
  }
  /// From the end that is nearer to the tool: by the places along the row.
  bool row() {
    const auto pu = facts_.position[axes_.u], pv = facts_.position[axes_.v];
    loop.guessed = !pu || !pv;  // from the zero point
    const Value angle = named(word("angle")), count = named(word("count"));
    const Value c = turned(Function::cos, angle), s = turned(Function::sin, angle);
    const auto place = kept(word("first")), step = kept(word("step"));
    if (!place || !step) return false;
    const Value first(variable(*place)), d(variable(*step));
    const Value last = named(add(first, product(d, subtract(count, Value(1.0)))));
    const Value tool = named(sum(product(subtract(Value(loop.guessed ? 0 : *pu), word("u")), c),
                                 product(subtract(Value(loop.guessed ? 0 : *pv), word("v")), s)));
    const auto far = [&](const Value& l) { return call(Function::abs, {as_expr(subtract(l, tool))}); };
    If back;
    back.condition = binary(BinaryOp::lt, far(last), binary(BinaryOp::subtract, far(first), number(1e-4)));
    back.then_body.push_back(make_assign(like_, *place, as_expr(last)));
    back.then_body.push_back(make_assign(like_, *step, as_expr(negate(d))));
    Body turn;
    turn.push_back(made(like_, std::move(back)));
    lower_structures(editor_, turn);
    for (auto& t : turn) loop.setup.push_back(std::move(t));
    if (!count_from(1, count)) return false;
    const auto point = [&](const Value& l) {
      return at(sum(word("u"), product(l, c)), sum(word("v"), product(l, s)), WordMode::absolute);
    };
    loop.first = point(first);
    loop.next = point(add(first, product(k_, d)));
    return true;
  }
  /// A computed step: 0 means evenly round.
  bool round_when_zero(Value& step, const Value& count) {
    const auto var = kept(step);
    if (!var) return false;
    If none;
    none.condition = binary(BinaryOp::eq, variable(*var), number(0));
    none.then_body.push_back(make_assign(like_, *var, as_expr(quotient(Value(360.0), count))));
    Body turn;
    turn.push_back(made(like_, std::move(none)));
    lower_structures(editor_, turn);
    for (auto& t : turn) loop.setup.push_back(std::move(t));
    step = Value(variable(*var));
    return true;
  }
  bool ring() {
    const Value count = named(word("count")), radius = named(word("radius"));
    Value step = word("angle_step");
    if (step.is(0)) {
      step = named(quotient(Value(360.0), count));
    } else if (!step.literal() && !round_when_zero(step, count)) {
      return false;
    }
    const Value start = named(word("angle"));
    if (!count_from(1, count)) return false;
    const auto point = [&](const Value& angle) {
      return at(sum(word("u"), product(radius, turned(Function::cos, angle))),
                sum(word("v"), product(radius, turned(Function::sin, angle))), WordMode::absolute);
    };
    loop.first = point(start);
    loop.next = point(sum(start, product(k_, step)));
    return true;
  }
  /// Row by row: point number k lies in row k / columns, cut to a whole number.
  bool matrix() {
    const Value columns = named(word("count")), angle = named(word("angle"));
    const Value c = turned(Function::cos, angle), s = turned(Function::sin, angle);
    const Value d = named(word("step")), e = named(word("step2"));
    if (!count_from(1, named(product(columns, word("count2"))))) return false;
    // Half a point of room: the quotient may come out a little too small.
    const Value row(call(Function::trunc, {as_expr(quotient(add(k_, Value(0.5)), columns))}));
    const Value x = product(subtract(k_, product(row, columns)), d), y = product(row, e);
    loop.first = at(word("u"), word("v"), WordMode::absolute);
    loop.next = at(difference(sum(word("u"), product(x, c)), product(y, s)),
                   sum(sum(word("v"), product(x, s)), product(y, c)), WordMode::absolute);
    return true;
  }
  /// From the tool round a centre.
  bool round(bool full) {
    const auto pu = facts_.position[axes_.u], pv = facts_.position[axes_.v];
    const Value cu = word("centre_u"), cv = word("centre_v");
    if (!pu || !pv || !cu.literal() || !cv.literal()) return fail("its centre is known when the program runs");
    if (has("angle_step") == has("count")) return fail("it needs either its angular step or its number");
    const Value total = full ? Value(360.0) : word("total");
    Value step, count;
    if (has("count")) {
      count = named(word("count"));
      step = quotient(total, full ? count : subtract(count, Value(1.0)));
      if (!total.literal() || total.number < 0) return fail("its angle is known when the program runs");
    } else {
      step = named(word("angle_step"));
      const Value ratio = quotient(total, Value(call(Function::abs, {as_expr(step)})));
      if (!total.literal() || total.number < 0) return fail("its angle is known when the program runs");
      count = named(full ? ratio : add(ratio, Value(1.0)));
    }
    const double start = std::atan2(-cv.number, -cu.number) * 180 / std::acos(-1.0);
    const double radius = std::hypot(cu.number, cv.number);
    const Value each = named(step);
    if (!count_from(1, count)) return false;
    const Value angle = sum(Value(clean_offset(start)), product(k_, each));
    loop.next = at(
        sum(Value(clean_offset(*pu + cu.number)), product(Value(clean_offset(radius)), turned(Function::cos, angle))),
        sum(Value(clean_offset(*pv + cv.number)), product(Value(clean_offset(radius)), turned(Function::sin, angle))),
        WordMode::absolute);
    return true;
  }

  const NamedCycle& pattern_;
  const Facts& facts_;
  Editor& editor_;
  LineInfo like_;
  std::optional<Plane> plane_;
  PlaneAxes axes_;
  Value count_, k_;
};

}  // namespace

std::optional<PatternLoop> pattern_loop(const NamedCycle& pattern, const LineInfo& like, const Block& b,
                                        const Facts& facts, Editor& editor, std::string* error) {
  LoopBuilder builder(pattern, like, b, facts, editor);
  if (builder.build()) return std::move(builder.loop);
  for (const auto& v : builder.loop.taken) editor.release(v);
  *error = builder.error;
  return std::nullopt;
}

}  // namespace cnctrans::ir::passes
