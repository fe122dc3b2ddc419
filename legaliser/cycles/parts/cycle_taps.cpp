// Taps in the words of another control: the pitch as feed over speed or as a number, the sense behind the cycle as what
// it was before or as a number (equivalences 22.5).
#include <cmath>
#include <utility>

#include "legaliser/cycles/parts/cycle_parts.h"

namespace cnctrans::ir::passes {

namespace {

bool is_tap(const HoleCycle& c) {
  return c.kind == HoleKind::tap || c.kind == HoleKind::tap_floating;
}

std::optional<double> speed_of(const Block& b, const Facts& facts) {
  std::optional<double> speed = facts.spindle;
  for (const auto& a : b.actions) {
    if (const auto* s = std::get_if<SetSpindle>(&a.data); s != nullptr && s->number == facts.master)
      speed = s->value.literal() ? std::optional(s->value.number) : std::nullopt;
  }
  return speed;
}

/// Units of F in one unit of length at the block.
std::optional<double> feed_units(const Block& b, const Facts& facts, const FeedScale& scale) {
  const auto units = setting_in<Units>(b, facts, Setting::units);
  return units == Units::metric ? scale.metric : units == Units::inch ? scale.inch : std::nullopt;
}

/// Pitch that feed and speed in force give, in program units; nullopt: not known. `unit`: see feed_units().
std::optional<double> pitch_by_feed(const Block& b, const Facts& facts, std::optional<double> unit) {
  std::optional<double> feed = facts.feed;
  const auto speed = speed_of(b, facts);
  for (const auto& a : b.actions) {
    if (const auto* f = std::get_if<SetFeed>(&a.data))
      feed = f->value.literal() ? std::optional(f->value.number) : std::nullopt;
  }
  const auto mode = setting_in<FeedMode>(b, facts, Setting::feed_mode);
  if (!unit || !mode || !feed || *feed <= 0) return std::nullopt;
  if (*mode == FeedMode::per_rev) return *feed / *unit;
  if (*mode != FeedMode::per_minute || !speed || *speed <= 0) return std::nullopt;
  return *feed / *speed / *unit;
}

SpindleStep step_of(SpindleState s) {
  return s == SpindleState::ccw ? SpindleStep::ccw : SpindleStep::cw;
}

/// The pitch as F over S, with the F that takes. False: it can't be said.
bool pitch_as_feed(TapForm& f, const Block& b, const Facts& facts, std::optional<double> unit) {
  const Value pitch = std::exchange(f.cycle.pitch, Value{});
  if (pitch.is(0)) return true;
  const auto mode = setting_in<FeedMode>(b, facts, Setting::feed_mode);
  if (!facts.feed || !mode || !unit) return false;
  const Value size = pitch.literal() ? Value(std::fabs(pitch.number)) : Value(call(Function::abs, {pitch.expr}));
  const auto by_feed = pitch_by_feed(b, facts, unit), speed = speed_of(b, facts);
  f.needs.bound = true;
  if (by_feed && size.literal() && std::fabs(size.number - *by_feed) <= 1e-9) return true;
  if (*mode == FeedMode::per_rev)
    f.needs.feed = *unit == 1 ? size : scale(size, *unit);
  else if (*mode == FeedMode::per_minute && speed && *speed > 0)
    f.needs.feed =
        size.literal() ? Value(std::round(size.number * *unit * *speed * 1e6) / 1e6) : scale(size, *unit * *speed);
  return f.needs.feed.has_value();
}

std::string join(std::string first, std::string_view second) {
  return first.empty() ? std::string(second) : std::move(first) + ", " + std::string(second);
}

}  // namespace

std::vector<TapForm> tap_forms(const HoleCycle& c, const Block& b, const Facts& facts,
                               std::optional<SpindleState> sense, const FeedScale& feeds) {
  std::vector<TapForm> forms;
  const auto unit = feed_units(b, facts, feeds);
  if (!is_tap(c) || !sense) return forms;
  const auto by_feed = pitch_by_feed(b, facts, unit);
  if (c.spindle_after == SpindleStep::usual) {
    // The sense in numbers. A spindle that follows the axis is oriented first there.
    TapForm f{c, {}};
    HoleCycle& h = f.cycle;
    h.spindle_after = step_of(*sense);
    h.spindle_after_retract = true;
    if (h.kind == HoleKind::tap) {
      f.needs.bound = h.pitch.is(0);
      if (h.pitch.is(0) && !by_feed) return forms;
      if (h.pitch.is(0)) h.pitch = Value{*by_feed};
      if (*sense == SpindleState::ccw) h.pitch = negate(h.pitch);
      h.spindle_bottom = SpindleStep::none;
      h.orient_first = true;
      if (const auto speed = speed_of(b, facts); speed && !h.has_speed) {
        f.needs.bound = h.has_speed = true;
        h.speed = Value{*speed};
      }
    }
    forms.push_back(std::move(f));
    if (c.kind != HoleKind::tap) return forms;
    // Or only the pitch in the other way.
    TapForm same{c, {}};
    if (c.pitch.is(0)) {
      same.cycle.pitch = Value{*by_feed};
      same.needs.bound = true;
      forms.push_back(std::move(same));
    } else if (pitch_as_feed(same, b, facts, unit)) {
      forms.push_back(std::move(same));
    }
    return forms;
  }
  // The other way round: the sense is what it was before, the pitch is what feed and speed give.
  const auto speed = speed_of(b, facts);
  const bool same_speed = !c.has_speed_out || (c.has_speed && equal(c.speed, c.speed_out));
  const bool speed_holds = !c.has_speed || (c.speed.literal() && speed && std::fabs(c.speed.number - *speed) < 1e-9);
  const bool same_hand =
      c.kind != HoleKind::tap || !c.pitch.literal() || (c.pitch.number > 0) == (*sense == SpindleState::cw);
  const bool reversed = c.spindle_bottom == SpindleStep::usual ||
                        (c.kind == HoleKind::tap && c.spindle_bottom == SpindleStep::none) ||
                        (c.spindle_bottom != step_of(*sense) && c.spindle_bottom != SpindleStep::none &&
                         c.spindle_bottom != SpindleStep::off);
  if (c.spindle_after != step_of(*sense) || !same_speed || !speed_holds || !same_hand || !reversed) return forms;
  TapForm f{c, {}};
  HoleCycle& h = f.cycle;
  h.spindle_after = h.spindle_bottom = SpindleStep::usual;
  h.spindle_after_retract = h.orient_first = h.has_speed = h.has_speed_out = false;
  h.orient_angle = h.speed = h.speed_out = Value{};
  h.rigid = h.kind == HoleKind::tap;
  if (h.rigid) {  // its own word for the pitch; the sense of the spindle is the hand
    forms.push_back(f);
    if (c.pitch.literal()) forms.back().cycle.pitch = Value{std::fabs(c.pitch.number)};
    if (c.has_speed) forms.back().needs.bound = true;
  }
  if (!pitch_as_feed(f, b, facts, unit)) return forms;
  forms.push_back(std::move(f));
  return forms;
}

FeedScale feed_scale(const Program& program, const machine::Profile& source) {
  // Whether F becomes inches with the lengths, the lengths become inches alone, and millimetres alone.
  bool with = false, inch_alone = false, metric_alone = false;
  const auto note = [&](Units units, bool feed_too) {
    with = with || (units == Units::inch && feed_too);
    inch_alone = inch_alone || (units == Units::inch && !feed_too);
    metric_alone = metric_alone || (units == Units::metric && !feed_too);
  };
  note(source.power_on.units, source.power_on.units_feed_too);
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
        const auto* m = std::get_if<ModalSet>(&b->actions[i].data);
        if (m != nullptr && m->setting == Setting::units) note(static_cast<Units>(m->value), m->feed_too);
      }
    });
  }
  FeedScale scale;
  if (with && metric_alone) scale.metric.reset();
  if (!with || !inch_alone) scale.inch = with ? 1 : 25.4;
  return scale;
}

std::optional<CyclePtr> without_dwell(const HoleCycle& c, const Block& b, const Facts& facts,
                                      const LegaliseContext& context, std::optional<double> initial,
                                      std::optional<SpindleState> sense, TapNeeds* needs) {
  const bool tap = c.kind == HoleKind::tap || c.kind == HoleKind::tap_floating;
  if (!tap || needs == nullptr || c.dwell_bottom.is(0)) return std::nullopt;
  auto made = std::make_shared<Cycle>();
  HoleCycle plain = c;
  plain.dwell_bottom = Value{};
  made->node = std::move(plain);
  auto form = native_form(made, b, facts, context, initial, sense, needs);
  if (form) needs->differs = join(needs->differs, "it has no dwell at the bottom of the hole");
  return form;
}

std::optional<CyclePtr> with_pecks_from_elsewhere(const HoleCycle& c, const Block& b, const Facts& facts,
                                                  const LegaliseContext& context, std::optional<double> initial,
                                                  std::optional<SpindleState> sense, TapNeeds* needs) {
  if (!is_tap(c) || needs == nullptr || needs->pecks_from_elsewhere || c.pecks.law == PeckLaw::none)
    return std::nullopt;
  auto made = std::make_shared<Cycle>();
  HoleCycle other = c;
  other.pecks.first_from_surface = !c.pecks.first_from_surface;
  made->node = std::move(other);
  TapNeeds own = *needs;
  own.pecks_from_elsewhere = true;
  auto form = native_form(made, b, facts, context, initial, sense, &own);
  if (!form) return std::nullopt;
  *needs = own;
  const bool one_place = c.reference.given && c.reference.base == LevelBase::from_surface && c.reference.value.is(0);
  if (!one_place) {
    needs->differs = join(needs->differs, c.pecks.first_from_surface
                                              ? "its pecks are counted from the reference plane, not from the surface"
                                              : "its pecks are counted from the surface, not from the reference plane");
  }
  return form;
}

void tell_standing_tap(const Cycle& cycle, const LineInfo& where, const LegaliseContext& context) {
  const auto* hole = std::get_if<HoleCycle>(&cycle.node);
  if (hole == nullptr || !is_tap(*hole) || hole->spindle_before != SpindleStep::usual || hole->has_speed) return;
  context.diagnostics.warning("TRN-402", where.span,
                              "the spindle stands before this tap: whether the control starts it by itself, and in "
                              "which sense, is not said for every control",
                              "write M3 or M4 before the cycle");
}

bool judge_feedless_tap(const Cycle& cycle, const FeedBefore& feed, std::optional<FeedMode> mode, const LineInfo& where,
                        const Program& program, const LegaliseContext& context) {
  const auto* hole = std::get_if<HoleCycle>(&cycle.node);
  if (hole == nullptr || !is_tap(*hole) || !hole->pitch.is(0) || hole->has_feed || !feed.none) return false;
  const auto& machine = context.source_machine;
  const bool of_power_on = machine.power_on_feed > 0 && mode == machine.power_on.feed_mode;
  if (of_power_on || program.dialect == context.target.dialect) return false;
  context.diagnostics.error("TRN-330", where.span,
                            "the pitch of this tap is its feed over its speed, and no F has been given before it",
                            "write F before the cycle, or the pitch");
  return true;
}

namespace {

/// A hole that does not start a spindle that stands.
bool only_bores(const Cycle& cycle) {
  const auto* hole = std::get_if<HoleCycle>(&cycle.node);
  return hole != nullptr && hole->kind != HoleKind::tap && hole->kind != HoleKind::tap_floating &&
         hole->spindle_before == SpindleStep::usual && hole->spindle_after == SpindleStep::usual;
}

bool leaves_it_at_rest(const Cycle& cycle) {
  const auto* hole = std::get_if<HoleCycle>(&cycle.node);
  return hole != nullptr && (hole->spindle_after == SpindleStep::off || hole->spindle_after == SpindleStep::none);
}

/// The program starts its spindle before the first jump or call, in its only sense, and never stops it; or nothing in
/// it ever starts one (a tap would).
std::optional<SpindleState> turns_throughout(const Program& program) {
  std::optional<SpindleState> sense;
  bool one = true, cycles_start = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* m = std::get_if<ModalCall>(&s.node);
      cycles_start = cycles_start || (m != nullptr && m->cycle && !only_bores(*m->cycle));
      one = one && (m == nullptr || !m->cycle || !leaves_it_at_rest(*m->cycle));
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        const auto* d = std::get_if<CycleDefine>(&a.data);
        cycles_start = cycles_start || (d != nullptr && d->cycle && !only_bores(*d->cycle));
        one = one && (d == nullptr || !d->cycle || !leaves_it_at_rest(*d->cycle));
        one = one && !std::holds_alternative<SpindleOrient>(a.data) && !std::holds_alternative<MasterSpindle>(a.data);
        const auto* run = std::get_if<SpindleRun>(&a.data);
        if (run == nullptr) continue;
        one = one && run->number == 1 && run->state != SpindleState::off && (!sense || *sense == run->state);
        sense = run->state;
      }
    });
  }
  const auto* main = program.main();
  if (one && !sense && main != nullptr && !cycles_start) return SpindleState::off;
  if (!one || !sense || main == nullptr) return std::nullopt;
  for (const auto& s : main->body) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr && !ToolHeight::keeps(s)) return std::nullopt;
    for (std::size_t i = 0; b != nullptr && i < b->actions.size() && s.line.skip_mask == 0; ++i) {
      if (std::holds_alternative<SpindleRun>(b->actions[i].data)) return sense;
    }
  }
  return std::nullopt;
}

}  // namespace

SpindleSense::SpindleSense(const Program& program) : always_(turns_throughout(program)) {
  const auto turns_back = [this](const HoleCycle& c) {
    for (const SpindleStep s : {c.spindle_before, c.spindle_after}) only_cw_ = only_cw_ && s != SpindleStep::ccw;
  };
  const auto look = [&](const CyclePtr& cycle) {
    const auto* hole = cycle ? std::get_if<HoleCycle>(&cycle->node) : nullptr;
    if (hole != nullptr) turns_back(*hole);
  };
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      if (const auto* m = std::get_if<ModalCall>(&s.node)) look(m->cycle);
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        if (const auto* run = std::get_if<SpindleRun>(&a.data)) only_cw_ = only_cw_ && run->state != SpindleState::ccw;
        if (const auto* d = std::get_if<CycleDefine>(&a.data)) look(d->cycle);
      }
    });
  }
}

void SpindleSense::forget() {
  state_.reset();
  stands_ = false;
  known_.reset();
}

void SpindleSense::within(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr) return;
  for (const auto& a : b->actions) {
    if (a.order != Order::after) carry_out(a, true);
  }
}

void SpindleSense::follow(const Statement& s, bool straight) {
  if (!straight) forget();
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr) return;
  for (const auto& a : b->actions) carry_out(a, s.line.skip_mask == 0);
}

void SpindleSense::carry_out(const Action& a, bool surely) {
  if (std::holds_alternative<MasterSpindle>(a.data)) known_.reset();
  const auto* run = std::get_if<SpindleRun>(&a.data);
  if (run != nullptr && run->number != 1) run = nullptr;
  if (run != nullptr) {
    stands_ = run->state == SpindleState::off && surely;
    state_ = run->state == SpindleState::ccw ? SpindleState::ccw : SpindleState::cw;
    known_ = run->state;
  }
  const auto* orient = std::get_if<SpindleOrient>(&a.data);
  if (orient != nullptr) known_ = SpindleState::off;
  if (orient != nullptr && orient->number == 1) stands_ = surely;
  if (surely || (run == nullptr && orient == nullptr)) return;
  if (run != nullptr) state_.reset();
  known_.reset();
}

}  // namespace cnctrans::ir::passes
