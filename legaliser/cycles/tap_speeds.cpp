// Taps that orient and turn the spindle by themselves (a speed of their own, a sense behind them), for targets whose
// taps take the spindle as it runs: speed and sense are said before the tap, and what it leaves behind it.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/cycles/parts/cycle_parts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

struct Around {
  CyclePtr cycle;
  Block before;
  std::optional<Block> after;
  std::optional<double> slower;  ///< rev/min of the way out, which the target drives as the way in
};

SpindleState state_of(SpindleStep s) {
  return s == SpindleStep::ccw ? SpindleState::ccw : s == SpindleStep::cw ? SpindleState::cw : SpindleState::off;
}

/// A tap whose hand is seen and whose speeds, where it has some, are numbers.
bool candidate(const HoleCycle& c) {
  const bool numbers = c.pitch.literal() && c.pitch.number != 0 &&
                       (!c.has_speed || (c.speed.literal() && c.speed.number > 0)) &&
                       (!c.has_speed_out || c.speed_out.literal());
  const bool stops = c.rigid && c.spindle_bottom == SpindleStep::usual && c.spindle_after == SpindleStep::off &&
                     !c.spindle_after_retract;
  const bool by_itself =
      c.orient_first && c.spindle_after != SpindleStep::usual && c.spindle_bottom == SpindleStep::none;
  return c.kind == HoleKind::tap && numbers && (by_itself || stops);
}

/// The target has a tap behind which the spindle stands, as this one leaves it.
bool stands_on(const LegaliseContext& context, const CyclePtr& cycle) {
  const auto* c = cycle ? std::get_if<HoleCycle>(&cycle->node) : nullptr;
  return c != nullptr && c->spindle_after == SpindleStep::off && context.target.native_cycle &&
         context.target.native_cycle(*cycle);
}

std::optional<Around> split(const CyclePtr& cycle, const Facts& facts, std::optional<SpindleState> sense) {
  const auto* c = cycle ? std::get_if<HoleCycle>(&cycle->node) : nullptr;
  if (c == nullptr || !candidate(*c)) return std::nullopt;
  if (c->has_speed_out && !c->has_speed && !facts.spindle) return std::nullopt;  // whether it is another one
  const double in = c->has_speed ? c->speed.number : facts.spindle.value_or(0);
  const double out = c->has_speed_out ? c->speed_out.number : in;
  const bool same_in = !c->has_speed || (facts.spindle && std::fabs(*facts.spindle - in) < 1e-9);
  const SpindleState hand = c->pitch.number < 0 ? SpindleState::ccw : SpindleState::cw;
  const bool goes_on = state_of(c->spindle_after) == hand && c->spindle_after != SpindleStep::none;
  if (same_in && std::fabs(out - in) < 1e-9 && goes_on && sense == hand) return std::nullopt;
  Around a;
  HoleCycle plain = *c;
  plain.spindle_after = plain.spindle_bottom = SpindleStep::usual;
  plain.spindle_after_retract = plain.orient_first = plain.has_speed = plain.has_speed_out = false;
  plain.orient_angle = plain.speed = plain.speed_out = Value{};
  plain.pitch = Value{std::fabs(c->pitch.number)};
  plain.rigid = true;
  auto made = std::make_shared<Cycle>();
  made->node = std::move(plain);
  a.cycle = std::move(made);
  if (!same_in) a.before.actions.push_back(action(SetSpindle{1, c->speed}));
  if (c->orient_first || !same_in || sense != hand) a.before.actions.push_back(action(SpindleRun{1, hand}));
  const bool other_speed = std::fabs(out - in) > 1e-9;
  if (other_speed) a.slower = out;
  if (other_speed || !goes_on) {
    a.after.emplace();
    if (other_speed) a.after->actions.push_back(action(SetSpindle{1, c->speed_out}));
    if (c->spindle_after == SpindleStep::none)  // it stands where the cycle has left it
      a.after->actions.push_back(action(SpindleOrient{1, c->orient_angle}));
    else
      a.after->actions.push_back(action(SpindleRun{1, state_of(c->spindle_after)}));
  }
  return a;
}

class TapSpeeds {
 public:
  TapSpeeds(Program& program, Routine& routine, const LegaliseContext& context, const FactsOf& facts)
      : context_(context),
        facts_(facts),
        editor_(program, routine, context),
        uses_(label_uses(program, routine)),
        sense_(program) {
    if (routine.kind != RoutineKind::main) sense_.forget();
  }

  void run() { walk(editor_.routine.body); }

 private:
  void walk(Body& body) {
    Body out;
    std::optional<Block> behind;  // the modal call in force
    for (std::size_t i = 0; i < body.size(); ++i) {
      each_body(body[i], [this](Body& inner) {
        sense_.forget();
        walk(inner);
      });
      for (const auto& l : labels_on(body[i].line)) {
        if (uses_.is_target(l)) sense_.forget();
      }
      const std::size_t before = out.size();
      one(body, i, behind, out);
      for (std::size_t k = before; k < out.size(); ++k)
        sense_.follow(out[k], std::holds_alternative<Block>(out[k].node) || ToolHeight::keeps(out[k]));
    }
    body = std::move(out);
  }

  static bool cancels(const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    return b != nullptr && b->actions.size() == 1 && std::holds_alternative<CycleCancel>(b->actions.front().data);
  }
  /// A cycle that holds from this block on is taken back in sight, with nothing but points before, which the tool goes
  /// to in rapid.
  bool row_of_points(const Body& body, std::size_t from) const {
    for (std::size_t i = from; i < body.size() && body[i].line.skip_mask == 0; ++i) {
      const auto labels = labels_on(body[i].line);
      const auto* b = std::get_if<Block>(&body[i].node);
      if (b == nullptr || std::any_of(labels.begin(), labels.end(), [&](const auto& l) { return uses_.is_target(l); }))
        return false;
      if (cancels(body[i])) return true;
      if (b->motion.kind != MotionKind::rapid || b->actions.size() != (i == from ? 1 : 0)) return false;
    }
    return false;
  }
  static bool says_speed(const Around& a) {
    return action_in<SetSpindle>(a.before) != nullptr || (a.after && action_in<SetSpindle>(*a.after) != nullptr);
  }
  /// A speed in a block of its own runs the modal cycle or the modal subprogram that is in force, perhaps.
  static bool may_run_again(const Facts& facts) {
    return !facts.cycle_active_known || facts.cycle_active || facts.modal_call_runs();
  }
  void one(Body& body, std::size_t i, std::optional<Block>& behind, Body& out) {
    Statement& s = body[i];
    auto* m = std::get_if<ModalCall>(&s.node);
    auto* b = std::get_if<Block>(&s.node);
    std::optional<Around> around;
    bool over_points = m != nullptr;
    if (m != nullptr && m->cycle && ends_in_sight(body, i) && !stands_on(context_, m->cycle)) {
      around = split(m->cycle, facts_.before(s), sense_.surely());
      if (around) m->cycle = around->cycle;
    }
    for (std::size_t k = 0; b != nullptr && k < b->actions.size(); ++k) {
      auto* d = std::get_if<CycleDefine>(&b->actions[k].data);
      if (d == nullptr || !d->here || (d->modal && !row_of_points(body, i)) || stands_on(context_, d->cycle)) continue;
      over_points = d->modal;
      around = split(d->cycle, facts_.before(s), sense_.surely());
      if (around && !d->modal && says_speed(*around) && may_run_again(facts_.before(s))) around.reset();
      if (around) d->cycle = around->cycle;
    }
    const LineInfo like = s.line;
    if ((m != nullptr || cancels(s)) && behind) {  // the end of the one before
      Body pieces;
      pieces.push_back(std::move(s));
      pieces.push_back(made(like, *std::exchange(behind, std::nullopt)));
      editor_.put_group(out, std::move(pieces), 0);
      return;
    }
    if (!around) return out.push_back(std::move(s));
    if (around->slower) tell(like, *around->slower);
    if (around->after && !over_points && sets_speed(body, i + 1))
      std::erase_if(around->after->actions, [](const Action& a) { return std::holds_alternative<SetSpindle>(a.data); });
    Body pieces;
    const std::size_t own = around->before.actions.empty() ? 0 : 1;
    if (own != 0) pieces.push_back(made(like, std::move(around->before)));
    pieces.push_back(std::move(s));
    if (around->after && !over_points) pieces.push_back(made(like, *std::move(around->after)));
    if (around->after && over_points) behind = std::move(around->after);
    editor_.put_group(out, std::move(pieces), own);
  }
  /// The next statement gives the spindle its speed on every way.
  bool sets_speed(const Body& body, std::size_t i) const {
    const auto* b = i < body.size() ? std::get_if<Block>(&body[i].node) : nullptr;
    return b != nullptr && !b->has_motion && body[i].line.skip_mask == 0 && labels_on(body[i].line).empty() &&
           b->actions.size() == 1 && action_in<SetSpindle>(*b) != nullptr && action_in<SetSpindle>(*b)->number == 1;
  }
  /// Between a modal call and its end stand only points to which the tool goes in rapid, and nothing that turns the
  /// spindle.
  bool ends_in_sight(const Body& body, std::size_t from) const {
    if (facts_.before(body[from]).motion != MotionKind::rapid) return false;
    for (std::size_t i = from + 1; i < body.size(); ++i) {
      const Statement& s = body[i];
      for (const auto& l : labels_on(s.line)) {
        if (uses_.is_target(l)) return false;
      }
      if (const auto* m = std::get_if<ModalCall>(&s.node)) return m->off && s.line.skip_mask == 0;
      if (const auto* call = std::get_if<CallRoutine>(&s.node)) {
        if (!calls_points(*call)) return false;
        continue;
      }
      if (!point(s)) return false;
    }
    return false;
  }
  static bool point(const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return ToolHeight::keeps(s);
    if (b->motion.kind != MotionKind::modal && b->motion.kind != MotionKind::rapid) return false;
    return std::none_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
      return std::holds_alternative<SetSpindle>(a.data) || std::holds_alternative<SpindleRun>(a.data) ||
             std::holds_alternative<SetFeed>(a.data);
    });
  }
  /// A subprogram that has nothing but points, in a row.
  bool calls_points(const CallRoutine& call) const {
    if (call.computed || call.has_range || call.tail || call.optional) return false;
    const auto& all = editor_.program.routines;
    const auto r = std::find_if(all.begin(), all.end(), [&call](const Routine& x) { return x.name == call.routine; });
    if (r == all.end() || r->kind == RoutineKind::main) return false;
    return std::all_of(r->body.begin(), r->body.end(), [](const Statement& s) {
      const auto* m = std::get_if<ModalCall>(&s.node);
      return std::holds_alternative<Return>(s.node) || (m == nullptr && point(s));
    });
  }
  void tell(const LineInfo& where, double out) const {
    context_.diagnostics.warning("TRN-422", where.span,
                                 "the tap leaves its hole at the speed of the way in, not at " + shortest(out) +
                                     " rev/min: the target's tap has one speed",
                                 "the thread is the same; give both ways one speed");
  }
  const LegaliseContext& context_;
  const FactsOf& facts_;
  Editor editor_;
  LabelUses uses_;
  SpindleSense sense_;
};

bool has_candidate(const Program& program) {
  bool found = false;
  const auto look = [&found](const CyclePtr& cycle) {
    const auto* c = cycle ? std::get_if<HoleCycle>(&cycle->node) : nullptr;
    found = found || (c != nullptr && candidate(*c));
  };
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&look](const Statement& s) {
      if (const auto* m = std::get_if<ModalCall>(&s.node)) look(m->cycle);
      const auto* b = std::get_if<Block>(&s.node);
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
        if (const auto* d = std::get_if<CycleDefine>(&b->actions[i].data)) look(d->cycle);
      }
    });
  }
  return found;
}

}  // namespace

void write_tap_speeds(Program& program, const LegaliseContext& context) {
  const bool same = program.dialect == context.target.dialect && !program.dialect.empty();
  if (same || context.options.cycles == CycleWriting::explode || !has_candidate(program)) return;
  const FactsOf facts(program, context);
  for (auto& r : program.routines) TapSpeeds(program, r, context, facts).run();
}

}  // namespace cnctrans::ir::passes
