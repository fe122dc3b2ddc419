#include "legaliser/analysis/feed_before.h"

#include <algorithm>

#include "ir/analysis/flow_states.h"
#include "ir/cycles/machining.h"
#include "ir/cycles/pattern.h"
#include "legaliser/analysis/feed_state.h"

namespace cnctrans::ir::passes {

namespace {

/// Some machining cycles leave their last feed behind.
bool leaves_feed(const CyclePtr& cycle) {
  const auto* named = cycle ? std::get_if<NamedCycle>(&cycle->node) : nullptr;
  if (named == nullptr || cycles::find_pattern(named->name) != nullptr) return false;
  const auto* row = cycles::find_machining(named->name);
  return row == nullptr || row->ends_modes;
}

bool is_tap(const CyclePtr& cycle) {
  const auto* hole = cycle ? std::get_if<HoleCycle>(&cycle->node) : nullptr;
  const bool tap = hole != nullptr && (hole->kind == HoleKind::tap || hole->kind == HoleKind::tap_floating);
  return tap && !hole->pitch.is(0);
}
bool defines_tap(const Statement& s) {
  if (const auto* m = std::get_if<ModalCall>(&s.node)) return is_tap(m->cycle);
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
           const auto* d = std::get_if<CycleDefine>(&a.data);
           return d != nullptr && d->modal && is_tap(d->cycle);
         });
}

/// What is kept as text may give a feed, unless the path is the same without it.
bool acts_unseen(const Statement& s) {
  const auto* o = std::get_if<Opaque>(&s.node);
  return o != nullptr && !o->harmless;
}

/// A domain of FlowStates: whether some way has given a feed.
class GivenDomain {
 public:
  struct State {
    bool maybe = false;
  };
  [[nodiscard]] static State start(const Routine& r, bool called) { return {called || r.kind != RoutineKind::main}; }
  static bool gives(const Statement& s) { return acts_unseen(s) || says(s); }
  static bool says(const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    return b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
             const auto* d = std::get_if<CycleDefine>(&a.data);
             const auto* f = std::get_if<SetFeed>(&a.data);
             return (f != nullptr && !f->block_only) || (d != nullptr && leaves_feed(d->cycle));
           });
  }
  static void transfer(const Statement& s, State& state) { state.maybe = state.maybe || gives(s); }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) { found = found || gives(s); });
    return found;
  }
  static void unknown(State& state) { state.maybe = true; }
  static bool join(State& a, const State& b) {
    const bool changed = b.maybe && !a.maybe;
    a.maybe = a.maybe || b.maybe;
    return changed;
  }
};

/// A domain of FlowStates: the last F, as long as what it was computed from is what it was.
class WordDomain {
 public:
  struct State {
    std::optional<Value> word;
  };
  [[nodiscard]] static State start(const Routine&, bool) { return {}; }
  static void transfer(const Statement& s, State& state) {
    if (acts_unseen(s)) state.word.reset();
    if (state.word && !state.word->literal()) {
      each_target(s, [&state](const VarRef& v) {
        if (state.word && reads(state.word->expr, v)) state.word.reset();
      });
    }
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    for (const auto& a : b->actions) {
      const auto* f = std::get_if<SetFeed>(&a.data);
      const auto* d = std::get_if<CycleDefine>(&a.data);
      const auto* set = std::get_if<ModalSet>(&a.data);
      const bool mode = set != nullptr && (set->setting == Setting::units || set->setting == Setting::feed_mode);
      if (mode || (d != nullptr && leaves_feed(d->cycle))) state.word.reset();
      if (f == nullptr || f->block_only) continue;
      state.word = s.line.skip_mask == 0 ? std::optional(f->value) : std::nullopt;
      if (state.word) state.word->text = {};
    }
  }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      found = found || GivenDomain::gives(s);
      each_target(s, [&found](const VarRef&) { found = true; });
    });
    return found;
  }
  static void unknown(State& state) { state.word.reset(); }
  static bool join(State& a, const State& b) {
    const bool same = !a.word || (b.word && equal(*a.word, *b.word));
    if (!same) a.word.reset();
    return !same;
  }
};

/// A domain of FlowStates: the F of millimetres per minute on a control that keeps one F for each feed mode.
class MinuteDomain {
 public:
  struct State {
    std::optional<std::uint8_t> mode;
    std::optional<double> feed;
  };
  explicit MinuteDomain(FeedMode power_on) : power_on_(static_cast<std::uint8_t>(power_on)) {}
  [[nodiscard]] State start(const Routine& r, bool called) const {
    if (called || r.kind != RoutineKind::main) return {};
    return {power_on_, std::nullopt};
  }
  static void transfer(const Statement& s, State& state) {
    if (acts_unseen(s)) state = {};
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    const bool sure = s.line.skip_mask == 0;
    for (const auto& a : b->actions) {
      const auto* set = std::get_if<ModalSet>(&a.data);
      if (set == nullptr) continue;
      if (set->setting == Setting::units) state.feed.reset();
      if (set->setting != Setting::feed_mode) continue;
      if (set->feed_memory != FeedMemory::per_mode) state.feed.reset();
      state.mode = sure || state.mode == set->value ? std::optional(set->value) : std::nullopt;
    }
    const bool other = state.mode && *state.mode != static_cast<std::uint8_t>(FeedMode::per_minute);
    for (const auto& a : b->actions) {
      const auto* f = std::get_if<SetFeed>(&a.data);
      const auto* d = std::get_if<CycleDefine>(&a.data);
      if (other) continue;
      if (d != nullptr && leaves_feed(d->cycle)) state.feed.reset();
      if (f == nullptr || f->block_only) continue;
      state.feed.reset();
      if (state.mode && sure) state.feed = f->value.literal() ? f->value.number : constant_value(f->value.expr);
    }
  }
  static bool touches(const Routine& r) { return WordDomain::touches(r) || FeedDomain::touches(r); }
  static void unknown(State& state) { state = {}; }
  static bool join(State& a, const State& b) {
    const bool mode = a.mode && a.mode != b.mode, feed = a.feed && a.feed != b.feed;
    if (mode) a.mode.reset();
    if (feed) a.feed.reset();
    return mode || feed;
  }

 private:
  std::uint8_t power_on_;
};

}  // namespace

struct FeedsBefore::Analysis {
  Analysis(const Program& program, double at_power_on, FeedMode mode_at_power_on)
      : states(program, domain),
        words(program, word_domain),
        minute_domain(mode_at_power_on),
        minutes(program, minute_domain) {
    const CallGraph calls(program);
    for (const auto& site : calls.sites()) given = given || !site.callee;
    given = given || std::none_of(program.routines.begin(), program.routines.end(),
                                  [](const Routine& r) { return r.kind == RoutineKind::main; });
    for (const auto& r : program.routines) {
      for_each_statement(r.body, [this](const Statement& s) {
        given = given || GivenDomain::says(s);
        if (defines_tap(s)) taps.insert(s.id);
      });
    }
    if ((given || !taps.empty()) && at_power_on > 0) power_on = at_power_on;
  }
  GivenDomain domain;
  FlowStates<GivenDomain> states;
  WordDomain word_domain;
  FlowStates<WordDomain> words;
  MinuteDomain minute_domain;
  FlowStates<MinuteDomain> minutes;
  std::set<std::uint32_t> taps;
  bool given = false;              ///< F stands in the program, or may in what it calls or is called by
  std::optional<double> power_on;  ///< a feed to go back to, in a program that has F, or may get one as a tap's pitch
};

FeedsBefore::FeedsBefore(const Program& program, const LegaliseContext& context)
    : analysis_(std::make_unique<Analysis>(program, context.source_machine.power_on_feed,
                                           context.source_machine.power_on.feed_mode)) {}
FeedsBefore::~FeedsBefore() = default;

const std::set<std::uint32_t>& FeedsBefore::taps() const {
  return analysis_->taps;
}

FeedBefore FeedsBefore::at(const Statement& s, const Block& b, const Facts& facts) const {
  FeedBefore feed{facts.feed, false, {}, {}};
  if (const auto* minute = analysis_->minutes.before(s); minute != nullptr) feed.per_minute = minute->feed;
  bool own = false;
  for (const auto& a : b.actions) {
    const auto* f = std::get_if<SetFeed>(&a.data);
    if (f == nullptr || f->block_only || a.order == Order::after) continue;
    own = true;
    feed.value = f->value.literal() ? std::optional(f->value.number) : constant_value(f->value.expr);
    feed.computed = f->value;
    feed.computed->text = {};
  }
  if (const auto* state = own || feed.value ? nullptr : analysis_->words.before(s); state != nullptr)
    feed.computed = state->word;
  const bool metric = setting_in<Units>(b, facts, Setting::units) == Units::metric;
  if (!own && !analysis_->given) return {metric ? analysis_->power_on : std::nullopt, true, {}, {}};
  const auto* state = own || feed.value ? nullptr : analysis_->states.before(s);
  if (state == nullptr || state->maybe) return feed;
  if (metric) feed.value = analysis_->power_on;
  feed.none = !analysis_->power_on;
  return feed;
}

}  // namespace cnctrans::ir::passes
