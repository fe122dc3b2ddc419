// Machine data that the target can't read. What follows from the program's own functions is known on every path and
// becomes a number; what the target reads under another name is written with that name and in its unit.
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "base/saturate.h"
#include "base/text.h"
#include "ir/active_units.h"
#include "ir/analysis/block_coordinate.h"
#include "ir/analysis/call_graph.h"
#include "ir/axis_mask.h"
#include "ir/edit/rewrite.h"
#include "legaliser/analysis/feed_units.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/frames/frame_state.h"
#include "legaliser/frames/shifted_axes.h"
#include "legaliser/motion/path_values.h"
#include "machine/data_at_rest.h"

namespace cnctrans::ir::passes {

namespace {

const SystemRef* datum_in(const ExprPtr& e) {
  return e ? std::get_if<SystemRef>(&e->node) : nullptr;
}

class KnownData {
 public:
  KnownData(Program& program, const LegaliseContext& context)
      : program_(program),
        context_(context),
        calls_(program),
        facts_(program, context),
        frames_(program, facts_, context),
        feed_domain_(context.source_machine.power_on.units_feed_too),
        feed_units_(program, feed_domain_) {
    for (const Routine& r : program.routines) {
      for_each_statement(r.body, [this](const Statement& s) {
        const auto* b = std::get_if<Block>(&s.node);
        for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) hidden_ |= hidden_by(b->actions[i], s);
      });
    }
  }

  void in(const Routine& r) { routine_ = &r; }
  /// The centres that asked for the pole are known now: nothing else may need it.
  [[nodiscard]] bool poles_read() const { return poles_read_; }
  void statement(Statement& s) {
    diameter_switch(s);
    bool used = false;
    each_expression(s, [&](const ExprPtr& e) { walk(e, [&](const ExprPtr& x) { used = used || foreign(x); }); });
    if (used) {
      StatementVisitor visit;
      visit.expression = [&](const ExprPtr& e) {
        return map_expr(e, [&](const ExprPtr& x) { return foreign(x) ? read(s, x) : folded(x); });
      };
      visit_statement(s, visit);
    }
    if (auto* a = std::get_if<Assign>(&s.node)) {
      for (auto& i : a->items) write(i, s);
    }
  }

 private:
  /// Axes on which the machine's place behind it is another by more than the offsets and the shift.
  [[nodiscard]] AxisMask hidden_by(const Action& a, const Statement& s) const {
    const auto* offset = std::get_if<WorkOffset>(&a.data);
    if (offset != nullptr && offset->off) return ~AxisMask{0};
    const auto* gauge = std::get_if<ToolOffset>(&a.data);
    if (gauge == nullptr || gauge->number.is(0)) return 0;
    const auto plane = setting<Plane>(facts_.before(s), Setting::plane);
    const bool along_one = context_.source_machine.kind == machine::Kind::mill && plane;
    return along_one ? axis_bit(plane_axes(*plane).w) : ~AxisMask{0};
  }
  [[nodiscard]] bool sayable(const SystemRef& ref) const {
    return context_.target.system_data && context_.target.system_data(ref);
  }
  [[nodiscard]] bool foreign(const ExprPtr& e) const {
    const auto* ref = datum_in(e);
    return ref != nullptr && !sayable(*ref);
  }

  /// A sum, product or quotient of numbers, one of which was read as a number.
  static ExprPtr folded(const ExprPtr& e) {
    const auto* b = std::get_if<Binary>(&e->node);
    if (b == nullptr || (b->op != BinaryOp::add && b->op != BinaryOp::multiply && b->op != BinaryOp::divide)) return e;
    const auto* left = as_number(b->left);
    const auto* right = as_number(b->right);
    if (left == nullptr || right == nullptr) return e;
    if (b->op == BinaryOp::add) return number(left->value + right->value);
    if (b->op == BinaryOp::multiply) return number(left->value * right->value);
    const double quotient =
        std::round(left->value / right->value * 1e9) / 1e9;  // only one that is no rounder than it was
    return std::fabs(quotient * right->value - left->value) <= 1e-12 * std::fabs(left->value) ? number(quotient) : e;
  }

  /// DIAM=1 says what the code says.
  void diameter_switch(Statement& s) const {
    const auto* a = std::get_if<Assign>(&s.node);
    if (a == nullptr || a->items.size() != 1 || !a->items[0].to_system ||
        a->items[0].system.datum != Datum::diameter_on || sayable(a->items[0].system))
      return;
    const auto value = constant_value(a->items[0].value);
    if (!value) return;
    ModalSet set{Setting::diameter, 0, true, {}};
    set.value = static_cast<std::uint8_t>(*value != 0 ? DiameterMode::diameter : DiameterMode::radius);
    Block b;
    b.actions.push_back(Action{set, Order::before, {}, {}});
    s.node = std::move(b);
  }

  ExprPtr read(const Statement& s, const ExprPtr& e) {
    const SystemRef& ref = *datum_in(e);
    if (!context_.source_machine.data.contains(ref.text)) {
      if (const auto value = known(s, ref)) {
        if (e->pos.column != 0) tell(word_span(s.line.span, e->pos), ref, *value);  // else the reader has put it there
        return number(*value);
      }
    }
    if (const auto at = pole(s, ref)) {  // the reader has put it there
      poles_read_ = true;
      return as_expr(*at);
    }
    if (const auto formula = place(s, ref)) {
      context_.diagnostics.note("TRN-132", word_span(s.line.span, e->pos),
                                ref.text + " follows from the words before it here: written as their formula");
      return formula->expr;
    }
    if (ref.datum == Datum::feed && setting<FeedMode>(facts_.before(s), Setting::feed_mode) == FeedMode::per_minute) {
      SystemRef minute = ref;
      minute.datum = Datum::feed_per_minute;
      Expr copy = *e;
      copy.node = minute;
      if (sayable(minute)) return std::make_shared<const Expr>(std::move(copy));
    }
    const auto own = context_.target.data_form ? context_.target.data_form(ref) : std::nullopt;
    if (!own) return in_frame(s, e, ref);
    const ExprPtr named = renamed(e, *own);
    return own->units == 1 ? named : binary(BinaryOp::divide, named, number(own->units));
  }
  void tell(const Span& where, const SystemRef& ref, double value) {
    if (!told_.insert({where.file, where.line, where.column}).second) return;
    // One question for what is in force became one for each code that could be.
    const std::string is = ref.datum == Datum::active_modal ? " is known" : " is " + shortest(value);
    context_.diagnostics.note("TRN-132", where, ref.text + is + " here on every path: written as the number");
  }
  /// The place in the program's coordinates as the target's data give it, where these coordinates are only shifted.
  /// A preset is one of the shifts that the data give.
  ExprPtr in_frame(const Statement& s, const ExprPtr& e, const SystemRef& ref) {
    if (!context_.target.work_position || !stands_there(s, ref)) return e;
    const Facts& facts = facts_.before(s);
    const PlanarFrame frame = frames_.before(s).whole(context_.source_machine, false);
    const bool only_shifts = !frame.foreign && !frame.turns() && !frame.scales() && !frame.mirrors();
    const bool metric = setting<Units>(facts, Setting::units) == Units::metric;
    const auto formula = only_shifts && metric && (hidden_ & axis_bit(ref.axis)) == 0
                             ? context_.target.work_position(ref.axis)
                             : nullptr;
    if (!formula) return e;
    context_.diagnostics.note("TRN-132", word_span(s.line.span, e->pos),
                              ref.text + " is the machine's position less the offsets and the shift: written so");
    return formula;
  }
  /// The place of the tool, or the point of the program that it stands at.
  [[nodiscard]] bool stands_there(const Statement& s, const SystemRef& ref) const {
    if (ref.datum == Datum::work_position) return true;
    const auto* spec = context_.source_machine.axis(ref.axis);
    return ref.datum == Datum::programmed_position && spec != nullptr && !spec->diameter &&
           setting<CompSide>(facts_.before(s), Setting::comp) == CompSide::off;
  }
  static ExprPtr renamed(const ExprPtr& e, const DataForm& own) {
    Expr copy = *e;
    std::get<SystemRef>(copy.node).text = own.text;
    return std::make_shared<const Expr>(std::move(copy));
  }

  /// Data that a source may write while the names of other controls can only be read.
  static bool only_read(const SystemRef& ref) {
    return (ref.datum == Datum::tool_radius && ref.args.empty()) || ref.datum == Datum::cycle_time ||
           ref.datum == Datum::feed_override;
  }

  void write(Assign::Item& i, const Statement& s) {
    if (!i.to_system) return;
    if (const auto value = constant_value(i.value); value && as_number(i.value) == nullptr) i.value = number(*value);
    if (only_read(i.system)) {
      context_.diagnostics.error("TRN-122", s.line.span, "the target can't write " + quoted(i.system.text),
                                 "change it on the machine, or replace it by a variable");
      return;
    }
  }

  /// The value when every path agrees on it.
  std::optional<double> known(const Statement& s, const SystemRef& ref) const {
    const Facts& facts = facts_.before(s);
    if (!facts.reachable) return std::nullopt;
    switch (ref.datum) {
      case Datum::active_modal: return modal(s, facts, ref);
      case Datum::diameter_on: {
        const auto mode = setting<DiameterMode>(facts, Setting::diameter);
        if (!mode) return std::nullopt;
        return *mode == DiameterMode::radius ? 0 : 1;
      }
      case Datum::active_plane: return plane(facts);
      case Datum::programmed_position: return position(facts, ref.axis);
      case Datum::work_position:  // with radius compensation the tool stands beside the programmed point
        return setting<CompSide>(facts, Setting::comp) == CompSide::off ? position(facts, ref.axis) : std::nullopt;
      case Datum::feed: return facts.feed;
      case Datum::feed_per_minute: return in_mode(facts.feed, facts, Setting::feed_mode, FeedMode::per_minute);
      case Datum::feed_per_rev: return in_mode(facts.feed, facts, Setting::feed_mode, FeedMode::per_rev);
      case Datum::spindle_speed: return facts.spindle;
      case Datum::rpm: return in_mode(facts.spindle, facts, Setting::spindle_mode, SpindleMode::rpm);
      case Datum::cutting_speed: return in_mode(facts.spindle, facts, Setting::spindle_mode, SpindleMode::css);
      case Datum::active_offset: return facts.work_offset ? std::optional<double>(*facts.work_offset) : std::nullopt;
      case Datum::mirrored_axes:
      case Datum::scale_factor:
      case Datum::axis_scale:
      case Datum::rotation_angle: return framed(frames_.before(s), ref);
      case Datum::other:
        if (ref.given) return std::nullopt;
        return ref.args.empty() ? of_run(facts, ref) : written_elsewhere(ref);
      case Datum::call_has_argument: return arguments_given(ref);
      default: return std::nullopt;
    }
  }

  /// One bit an argument, where all calls of the routine at hand give the same ones.
  [[nodiscard]] std::optional<double> arguments_given(const SystemRef& ref) const {
    if (!ref.args.empty() || routine_ == nullptr) return std::nullopt;
    if (routine_->kind == RoutineKind::main) return 0;
    std::optional<double> all;
    for (const auto& site : calls_.sites()) {
      if (!site.callee) {
        const auto* c = std::get_if<CallRoutine>(&site.statement->node);
        if (c == nullptr || c->computed) return std::nullopt;  // it may be this one
        continue;
      }
      if (&program_.routines[*site.callee] != routine_) continue;
      const auto* c = std::get_if<CallRoutine>(&site.statement->node);
      if (c == nullptr || c->level != CallLevel::new_level || c->has_range) return std::nullopt;
      double mask = 0;
      for (const auto& a : c->arguments) {
        if (a.name.size() != 1 || a.name[0] < 'A' || a.name[0] > 'Z' || !a.value) return std::nullopt;
        mask += std::ldexp(1, a.name[0] - 'A');
      }
      if (all && *all != mask) return std::nullopt;
      all = mask;
    }
    return all;
  }

  /// What a run follows by the program alone: the axis across the plane, the number of the program.
  [[nodiscard]] std::optional<double> of_run(const Facts& facts, const SystemRef& ref) const {
    const auto answer = machine::data_of_run(context_.source_machine, ref.text);
    if (!answer) return std::nullopt;
    if (answer->datum == machine::RunDatum::plane_normal) {
      const auto p = setting<Plane>(facts, Setting::plane);
      return p ? std::optional(order(plane_axes(*p).w).value_or(-1) + 1) : std::nullopt;
    }
    const Routine* main = program_.main();
    return answer->datum == machine::RunDatum::program_number && main != nullptr ? main_number(*main) : std::nullopt;
  }

  /// The word of an axis in a block of this program.
  [[nodiscard]] std::optional<double> written_elsewhere(const SystemRef& ref) const {
    if (ref.args.size() != 2) return std::nullopt;
    const auto answer = machine::data_of_run(context_.source_machine, ref.text + "[0]");
    const auto block = constant_value(ref.args[0]), number = constant_value(ref.args[1]);
    if (!answer || answer->datum != machine::RunDatum::block_coordinate || !block || !number) return std::nullopt;
    return block_coordinate(&program_, nullptr, ref.axis, *block, *number);
  }

  /// args: the source's own number, the setting, the value asked for; motion and offset stand behind the settings.
  std::optional<double> modal(const Statement& s, const Facts& facts, const SystemRef& ref) const {
    if (ref.args.size() != 3) return std::nullopt;
    const auto which = constant_value(ref.args[1]), asked = constant_value(ref.args[2]);
    if (!which || !asked) return std::nullopt;
    const auto same = [&asked](auto value) -> std::optional<double> {
      if (!value) return std::nullopt;
      return static_cast<double>(*value) == *asked ? 1 : 0;
    };
    const auto n = static_cast<std::size_t>(*which);
    if (n == setting_count) return same(facts.motion);
    if (n == setting_count + 1) return same(facts.work_offset);
    if (n == units_feed_too_setting) {
      const auto* unit = feed_units_.before(s);
      return unit != nullptr ? same(unit->value) : std::nullopt;
    }
    return n < setting_count ? same(facts.settings[n]) : std::nullopt;
  }

  template <class Mode>
  static std::optional<double> in_mode(std::optional<double> value, const Facts& facts, Setting s, Mode mode) {
    return setting<Mode>(facts, s) == mode ? value : std::nullopt;
  }
  /// What a word of the axis says of 1 mm.
  [[nodiscard]] std::optional<double> said(const Facts& facts, AxisId a) const {
    const auto* spec = context_.source_machine.axis(a);
    if (spec == nullptr || !spec->diameter) return 1;
    const auto mode = setting<DiameterMode>(facts, Setting::diameter);
    return mode ? std::optional(*mode == DiameterMode::radius ? 1.0 : 2.0) : std::nullopt;
  }
  /// As a word of the axis would say it.
  [[nodiscard]] std::optional<double> position(const Facts& facts, AxisId a) const {
    if (context_.source_machine.axis(a) == nullptr || a >= facts.position.size() || !facts.position[a])
      return std::nullopt;
    const auto factor = said(facts, a);
    return factor ? std::optional(*facts.position[a] * *factor) : std::nullopt;
  }

  /// A coordinate of the pole, where every way brings the same.
  std::optional<Value> pole(const Statement& s, const SystemRef& ref) {
    const bool first = ref.datum == Datum::pole_first;
    const Facts& facts = facts_.before(s);
    const auto plane = setting<Plane>(facts, Setting::plane);
    if ((!first && ref.datum != Datum::pole_second) || !plane || setting<Units>(facts, Setting::units) != Units::metric)
      return std::nullopt;
    const auto factor = said(facts, first ? plane_axes(*plane).u : plane_axes(*plane).v);
    const auto at = factor ? path().pole(s) : std::nullopt;
    if (!at) return std::nullopt;
    return scale(first ? at->u : at->v, *factor);
  }

  const PathStates& path() {
    if (!path_) path_.emplace(program_, facts_, context_.source_machine, context_);
    return *path_;
  }

  /// The programmed position as a formula in the program's variables, which this statement leaves alone.
  std::optional<Value> place(const Statement& s, const SystemRef& ref) {
    const auto* spec = context_.source_machine.axis(ref.axis);
    if (ref.datum != Datum::programmed_position || spec == nullptr || spec->diameter) return std::nullopt;
    auto found = path().place(s, ref.axis);
    if (!found || found->literal()) return std::nullopt;
    const auto* a = std::get_if<Assign>(&s.node);
    if (a == nullptr || a->items.size() > 1)
      each_target(s, [&found](const VarRef& v) {
        if (found && reads(found->expr, v)) found.reset();
      });
    return found;
  }

  [[nodiscard]] std::optional<double> order(AxisId a) const {
    const auto& axes = context_.source_machine.axes;
    const auto at = std::find_if(axes.begin(), axes.end(), [a](const machine::AxisSpec& x) { return x.id == a; });
    return at == axes.end() ? std::nullopt : std::optional<double>(at - axes.begin());
  }
  [[nodiscard]] std::optional<double> plane(const Facts& facts) const {
    const auto p = setting<Plane>(facts, Setting::plane);
    if (!p) return std::nullopt;
    const auto axes = plane_axes(*p);
    const auto u = order(axes.u), v = order(axes.v);
    if (!u || !v) return std::nullopt;
    return 16 * (*u + 1) + *v + 1;
  }

  [[nodiscard]] std::optional<double> framed(const FrameState& state, const SystemRef& ref) const {
    const PlanarFrame& mirror = state.slot(FrameSlot::mirror);
    const PlanarFrame& scale = state.slot(FrameSlot::scale);
    const PlanarFrame& rotation = state.slot(FrameSlot::rotation);
    const auto literal = [](const std::optional<Value>& v) -> std::optional<double> {
      return v && v->literal() ? std::optional(v->number) : std::nullopt;
    };
    if (ref.datum == Datum::rotation_angle) {
      const auto angle = rotation.foreign ? std::nullopt : literal(rotation.angle);
      if (!angle) return std::nullopt;
      const double turn = std::fmod(*angle, 360);
      return turn < 0 ? turn + 360 : turn;
    }
    if (ref.datum == Datum::scale_factor) return scale.foreign ? std::nullopt : literal(scale.factor);
    if (ref.datum == Datum::axis_scale) {
      if (!state.slot(FrameSlot::chain).neutral() || scale.foreign) return std::nullopt;
      return literal(scale.factor);
    }
    if (!mirror.mirror || mirror.foreign) return std::nullopt;
    double bits = 0;
    for (AxisId a = 0; a < PlanarFrame::axes; ++a) {
      if ((*mirror.mirror >> a & 1U) == 0) continue;
      const auto n = order(a);
      if (!n) return std::nullopt;
      bits += std::ldexp(1, saturate<int>(*n));
    }
    return bits;
  }

  const Program& program_;
  const LegaliseContext& context_;
  std::optional<PathStates> path_;  ///< where a position or the pole is asked for
  const CallGraph calls_;
  const Routine* routine_ = nullptr;
  std::set<std::tuple<FileId, std::uint32_t, std::uint32_t>> told_;  ///< places of notes
  bool poles_read_ = false;
  AxisMask hidden_ = 0;  ///< the program counts with gauges of tools along them, or without its offsets
  FactsOf facts_;
  FrameStates frames_;
  FeedUnits feed_domain_;
  FlowStates<FeedUnits> feed_units_;
};

bool needs_pole(const Program& program) {
  bool needed = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&needed](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      needed = needed || (b != nullptr && is_polar(b->motion));
      each_expression(s, [&needed](const ExprPtr& e) {
        walk(e, [&needed](const ExprPtr& x) {
          const auto* ref = datum_in(x);
          needed = needed || (ref != nullptr && (ref->datum == Datum::pole_first || ref->datum == Datum::pole_second));
        });
      });
    });
  }
  return needed;
}

void drop_poles(Program& program) {
  const auto is_pole = [](const Action& a) { return std::holds_alternative<PoleSet>(a.data); };
  const auto idle = [&is_pole](Statement& s) {
    auto* b = std::get_if<Block>(&s.node);
    const bool dropped = b != nullptr && std::erase_if(b->actions, is_pole) != 0;
    return dropped && b->empty() && shows_nothing(s.line);
  };
  for (auto& r : program.routines) std::erase_if(r.body, idle);
}

bool reads_or_writes_data(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      each_expression(s, [&found](const ExprPtr& e) {
        walk(e, [&found](const ExprPtr& x) { found = found || datum_in(x) != nullptr; });
      });
      const auto* a = std::get_if<Assign>(&s.node);
      found = found || (a != nullptr && std::any_of(a->items.begin(), a->items.end(),
                                                    [](const Assign::Item& i) { return i.to_system; }));
    });
  }
  return found;
}

}  // namespace

void write_known_data(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || !reads_or_writes_data(program)) return;
  KnownData pass(program, context);
  for (auto& r : program.routines) {
    pass.in(r);
    for_each_statement(r.body, [&pass](Statement& s) { pass.statement(s); });
  }
  if (pass.poles_read() && !needs_pole(program)) drop_poles(program);
}

}  // namespace cnctrans::ir::passes
