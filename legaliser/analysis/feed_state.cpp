#include "legaliser/analysis/feed_state.h"

#include <algorithm>
#include <cmath>

#include "ir/analysis/flow_states.h"

namespace cnctrans::ir::passes {

namespace {

bool needs_feed(MotionKind k) {
  return k == MotionKind::linear || k == MotionKind::arc_cw || k == MotionKind::arc_ccw ||
         k == MotionKind::arc_through_point || k == MotionKind::arc_tangent || is_curve(k);
}

const ModalSet* set_of(const Action& a, Setting s) {
  const auto* m = std::get_if<ModalSet>(&a.data);
  return m != nullptr && m->setting == s ? m : nullptr;
}

/// A block that the reader could not take: its words may hold an F.
bool unread(const Statement& s) {
  const auto* o = std::get_if<Opaque>(&s.node);
  return o != nullptr && (!o->harmless || o->feature == "text.unread");
}
/// A corner is cut at the feed in force, whatever the motion functions before and behind it.
bool corner_at_feed(const Action& a) {
  const auto* c = std::get_if<Corner>(&a.data);
  return (c != nullptr && !c->modal && c->feed == nullptr && !c->value.is(0)) ||
         std::holds_alternative<TangentialEnd>(a.data);
}

bool feeds_itself(const Cycle& c) {
  const auto* hole = std::get_if<HoleCycle>(&c.node);
  if (hole != nullptr && hole->kind == HoleKind::tap && !hole->pitch.is(0)) return true;
  if (hole != nullptr) return hole->has_feed;
  // The axial drilling cycle of a lathe, and its tap: at the feed in force.
  const auto* named = std::get_if<NamedCycle>(&c.node);
  return named == nullptr || named->name != "turn.drill";
}

}  // namespace

FeedDomain::FeedDomain(const Program& program, const LegaliseContext& context, const FactsOf& facts, bool head_feed)
    : context_(context), facts_(facts), head_feed_(head_feed) {
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [this](const Statement& s) {
      if (const auto* m = std::get_if<ModalCall>(&s.node); m != nullptr && m->cycle)
        cycles_[s.id] = !feeds_itself(*m->cycle);
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        const auto* d = std::get_if<CycleDefine>(&a.data);
        if (d != nullptr && d->modal && d->cycle) cycles_[s.id] = !feeds_itself(*d->cycle);
      }
    });
  }
}

FeedPoint FeedDomain::point(const Block& b, const Facts& facts) const {
  if (!b.has_motion || !b.motion.moves() || b.motion.frame != FrameUse::normal) return FeedPoint::none;
  const bool ends = std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    return std::holds_alternative<CycleCancel>(a.data) || std::holds_alternative<CycleDefine>(a.data);
  });
  if (ends) return FeedPoint::none;
  if (facts.modal_call != 0) return facts.modal_call > 0 ? FeedPoint::point : FeedPoint::perhaps;
  if (cycles_.empty() || (facts.cycle_active_known && !facts.cycle_active)) return FeedPoint::none;
  const auto from = cycles_.find(facts.cycle_from);
  if (facts.cycle_active_known && from != cycles_.end()) return from->second ? FeedPoint::point : FeedPoint::none;
  const bool any = std::any_of(cycles_.begin(), cycles_.end(), [](const auto& c) { return c.second; });
  return any ? FeedPoint::perhaps : FeedPoint::none;
}

FeedState FeedDomain::start(const Routine& r, bool called) const {
  FeedState s;
  const auto mode = static_cast<std::size_t>(context_.source_machine.power_on.feed_mode);
  if (called) s.slots[mode].maybe_power_on = context_.source_machine.power_on_feed > 0;
  if (r.kind != RoutineKind::main || called) return s;  // the caller sees to it
  const double own = context_.source_machine.power_on_feed, other = context_.target_machine.power_on_feed;
  for (auto& slot : s.slots) {
    slot.maybe_none = own <= 0;
    slot.same = own <= 0 && other <= 0;
  }
  if (own > 0) {
    auto& slot = s.slots[mode];
    slot.value = own;
    slot.maybe_power_on = true;
    slot.same = own == other || head_feed_;
  }
  return s;
}

bool FeedDomain::touches(const Routine& r) {
  bool found = false;
  for_each_statement(r.body, [&found](const Statement& s) {
    found = found || unread(s);
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    for (const auto& a : b->actions) {
      found = found || std::holds_alternative<SetFeed>(a.data) || set_of(a, Setting::feed_mode) != nullptr ||
              set_of(a, Setting::units) != nullptr;
    }
  });
  return found;
}

void FeedDomain::unknown(FeedState& state) {
  for (auto& s : state.slots) {
    s.value.reset();
    s.maybe_power_on = false;
    s.maybe_none = false;
    s.maybe_given = true;
  }
}

bool FeedDomain::join(FeedState& a, const FeedState& b) {
  const FeedState old = a;
  for (std::size_t i = 0; i < a.slots.size(); ++i) {
    auto& x = a.slots[i];
    const auto& y = b.slots[i];
    if (x.value != y.value) x.value.reset();
    x.maybe_none = x.maybe_none || y.maybe_none;
    x.maybe_given = x.maybe_given || y.maybe_given;
    x.maybe_power_on = x.maybe_power_on || y.maybe_power_on;
    x.same = x.same && y.same;
  }
  return a.slots != old.slots;
}

void FeedDomain::change_mode(const ModalSet& set, std::optional<std::uint8_t> before, FeedState& state) const {
  if (set.value >= state.slots.size() || before == set.value) return;
  const FeedMemory own = set.feed_memory, other = context_.target.feed_memory;
  auto& to = state.slots[set.value];
  if (!before || *before >= state.slots.size()) {  // the mode may stay as it is
    to.value.reset();
    to.maybe_none = to.maybe_none || own == FeedMemory::cleared;
    to.same = to.same && own == other;
    return;
  }
  const FeedState::Slot from = state.slots[*before];
  const bool target_kept = to.same;
  if (own == FeedMemory::shared) to = from;
  if (own == FeedMemory::cleared) to = FeedState::Slot{std::nullopt, true, false, false, true};
  if (own == other)
    to.same = own == FeedMemory::shared ? from.same : (own == FeedMemory::per_mode ? target_kept : true);
  else
    to.same = to.maybe_none && !to.value && other == FeedMemory::cleared;
}

void FeedDomain::settle(const Block& b, const Facts& facts, FeedState& state) const {
  auto mode = setting<std::uint8_t>(facts, Setting::feed_mode);
  auto units = setting<std::uint8_t>(facts, Setting::units);
  for (const auto& a : b.actions) {
    if (const auto* u = set_of(a, Setting::units)) {  // the same feed said in another unit
      const double factor = u->value == static_cast<std::uint8_t>(Units::inch) ? 1 / 25.4 : 25.4;
      for (std::size_t i = 0; i < state.slots.size(); ++i) {
        auto& value = state.slots[i].value;
        if (!value || units == u->value || i == static_cast<std::size_t>(FeedMode::inverse_time)) continue;
        if (units && u->feed_too)
          value = std::round(*value * factor * 1e9) / 1e9;
        else
          value.reset();
      }
      units = u->value;
    } else if (const auto* m = set_of(a, Setting::feed_mode)) {
      change_mode(*m, mode, state);
      mode = m->value;
    } else if (const auto* f = std::get_if<SetFeed>(&a.data); f != nullptr && !f->block_only) {
      std::optional<double> value;
      if (f->value.literal() && !(f->zero_is_maximum && f->value.number == 0)) value = f->value.number;
      for (std::size_t i = 0; i < state.slots.size(); ++i) {
        if (mode == i)
          state.slots[i] = FeedState::Slot{value, false, true, false, true};
        else if (!mode)
          state.slots[i].value.reset(), state.slots[i].maybe_none = false;
      }
    }
  }
}

bool FeedDomain::cuts(const Block& b, const Facts& facts) {
  bool cycle = false;
  for (const auto& a : b.actions) {
    const auto* d = std::get_if<CycleDefine>(&a.data);
    cycle = cycle || (d != nullptr && d->here && d->cycle && !feeds_itself(*d->cycle));
  }
  if (cycle) return true;
  if (!b.has_motion || !b.motion.moves()) return false;
  const auto kind = motion_in(b, facts);
  return !kind || needs_feed(*kind) || std::any_of(b.actions.begin(), b.actions.end(), corner_at_feed);
}

void FeedDomain::transfer(const Statement& s, FeedState& state) const {
  if (unread(s)) {
    unknown(state);
    for (auto& slot : state.slots) slot.same = true;  // the target gets the same words, or the line is refused
  }
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr) return;
  const Facts& facts = facts_.before(s);
  settle(*b, facts, state);
  if (!cuts(*b, facts)) return after_point(*b, facts, state);
  // After the cut both controls have the same feed: the pass sees to it, or reports.
  const auto mode = setting_in<std::uint8_t>(*b, facts, Setting::feed_mode);
  for (std::size_t i = 0; i < state.slots.size(); ++i) {
    if (mode && *mode != i) continue;
    state.slots[i].same = true;
    state.slots[i].maybe_none = false;  // said once
  }
  // Inverse time is a matter of each block.
  if (mode == static_cast<std::uint8_t>(FeedMode::inverse_time)) state.slots[*mode].same = false;
}

/// Behind a point both controls have the same feed where it is known: the pass has said it.
void FeedDomain::after_point(const Block& b, const Facts& facts, FeedState& state) const {
  const auto kind = point(b, facts);
  const auto mode = setting_in<std::uint8_t>(b, facts, Setting::feed_mode);
  if (kind == FeedPoint::none || !mode || *mode >= state.slots.size()) return;
  auto& slot = state.slots[*mode];
  if (*mode != static_cast<std::uint8_t>(FeedMode::inverse_time) && slot.value) slot.same = true;
}

bool reads_feed(const Statement& s) {
  bool found = false;
  each_expression(s, [&found](const ExprPtr& e) {
    walk(e, [&found](const ExprPtr& x) {
      const auto* ref = x ? std::get_if<SystemRef>(&x->node) : nullptr;
      found = found || (ref != nullptr && (ref->datum == Datum::feed || ref->datum == Datum::feed_per_minute ||
                                           ref->datum == Datum::feed_per_rev));
    });
  });
  return found;
}

bool uses_power_on_feed(const Program& program, const LegaliseContext& context, const FactsOf& facts) {
  if (context.source_machine.power_on_feed <= 0) return false;
  const FeedDomain domain(program, context, facts, false);
  const FlowStates<FeedDomain> states(program, domain);
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      const bool reads = reads_feed(s);
      const auto* before = b != nullptr || reads ? states.before(s) : nullptr;
      if (before == nullptr) return;
      const Facts& f = facts.before(s);
      FeedState now = *before;
      auto mode = setting<std::uint8_t>(f, Setting::feed_mode);
      if (!reads) {
        const auto point = domain.point(*b, f);  // behind a call every move may be one of a modal subprogram
        const bool runs = point == FeedPoint::point || (point == FeedPoint::perhaps && f.modal_call == 0);
        if (!FeedDomain::cuts(*b, f) && !runs) return;
        domain.settle(*b, f, now);
        mode = setting_in<std::uint8_t>(*b, f, Setting::feed_mode);
      }
      for (std::size_t i = 0; i < now.slots.size(); ++i) {
        if (!mode || *mode == i) found = found || now.slots[i].maybe_power_on;
      }
    });
  }
  return found;
}

}  // namespace cnctrans::ir::passes
