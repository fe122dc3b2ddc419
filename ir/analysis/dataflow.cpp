// Modal facts of the whole program: a worklist in text order over the graphs of all routines, with calls followed.
#include "ir/analysis/dataflow.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "ir/analysis/fact_set.h"
#include "ir/analysis/modal_runs.h"
#include "ir/edit/labels.h"
#include "ir/edit/skip_stretches.h"
#include "ir/nesting.h"

namespace cnctrans::ir {
namespace {

using namespace detail;

class Analysis {
 public:
  Analysis(const Program& program, const ModalState& power_on, Uncalled uncalled)
      : program_(program), power_on_(power_on), uncalled_(uncalled) {}

  FactTable run() {
    prepare();
    if (program_.routines.empty()) return FactTable{std::move(facts_)};
    const Routine* main = program_.main();
    if (main != nullptr) start(static_cast<std::size_t>(main - program_.routines.data()), true);
    for (std::size_t i = 0; i < routines_.size(); ++i) {
      const bool at_power_on = uncalled_ == Uncalled::power_on || program_.routines[i].kind == RoutineKind::main;
      if (!routines_[i].entered) start(i, at_power_on);
    }
    return FactTable{std::move(facts_)};
  }

 private:
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

  struct RoutineState {
    std::uint32_t entry = 0;  ///< first statement; 0: empty body
    bool entered = false;
    Facts at_exit;
    FactSet changes;  ///< what it and all it calls can change
    std::vector<std::uint32_t> callers;
  };
  /// A call or range: `first` and `last` statement, 0: all of the routine.
  struct Callee {
    std::size_t routine = nowhere;
    std::uint32_t first = 0, last = 0;
    bool known = false;
    bool computed = false;
    bool may_leave = false;  ///< the range can be left otherwise than behind `last`
  };

  // --- tables -----------------------------------------------------------------------------------------------------

  void prepare() {
    const NamedLabels named = named_labels(program_);
    for (std::size_t i = 0; i < program_.routines.size(); ++i) {
      const Routine& r = program_.routines[i];
      RoutineState& state = routines_.emplace_back();
      if (!r.body.empty()) state.entry = r.body.front().id;
      ControlFlow flow = control_flow(program_, r);
      if (successors_.size() < flow.successors.size()) resize(flow.successors.size());
      for (std::size_t id = 1; id < flow.statements.size(); ++id) {
        if (flow.statements[id] == nullptr) continue;
        statements_[id] = flow.statements[id];
        successors_[id] = std::move(flow.successors[id]);
        routine_of_[id] = i;
      }
      stretches_.push_back(skip_stretches(r, named));
      mark_skipped(r.body);
    }
    for (const auto* s : statements_) {
      if (s != nullptr) note_cycles(*s, cycles_);
      const auto* b = s != nullptr ? std::get_if<Block>(&s->node) : nullptr;
      chooses_spindles_ |= b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
                             return std::holds_alternative<MasterSpindle>(a.data);
                           });
      const auto* m = s != nullptr ? std::get_if<ModalCall>(&s->node) : nullptr;
      if (m == nullptr || m->off || m->cycle) continue;
      const Callee callee = called(m->call);
      if (callee.known) modal_targets_.push_back(callee.routine);
      modal_unknown_ |= !callee.known;
    }
    inside_modal_ = run_modally(program_, modal_targets_);
    framed_ = frame_reach(program_, power_on_);
    probes_ = probes(cycles_);
    find_changes();
  }

  void resize(std::size_t n) {
    successors_.resize(n);
    statements_.resize(n);
    routine_of_.resize(n, nowhere);
    facts_.resize(n);
    dirty_.resize(n);
    skipped_.resize(n);
  }

  void mark_skipped(const Body& body) {
    for (std::size_t i = 0; i < body.size(); ++i) {
      skipped_[body[i].id] = detail::skippable(body, i) && stretches_.back().inside.count(body[i].id) == 0;
      for (const Body* inner : detail::bodies_of(body[i])) {
        if (inner != nullptr) mark_skipped(*inner);
      }
    }
  }

  const LabelTable& labels(std::size_t routine) {
    return labels_.try_emplace(routine, program_.routines[routine]).first->second;
  }

  std::size_t find_routine(const RoutineName& name) const {
    const Routine* r = program_.find(name);
    return r == nullptr ? nowhere : static_cast<std::size_t>(r - program_.routines.data());
  }

  /// The range that `repeat` names in another routine.
  Callee range_of(std::size_t routine, const Repeat& repeat) {
    Callee c;
    c.routine = routine;
    if (routine == nowhere || repeat.first.computed || repeat.last.computed) return c;
    const auto range = labels(routine).range(repeat, 0);
    if (!range || range->first.part != SitePart::statement || range->second.part != SitePart::statement) return c;
    c.known = true;
    c.first = range->first.statement;
    c.last = range->second.statement;
    // The last line may hold several statements.
    while (c.last + 1 < statements_.size() && statements_[c.last + 1] != nullptr &&
           routine_of_[c.last + 1] == routine && statements_[c.last + 1]->line.joined) {
      ++c.last;
    }
    for (auto id = c.first; id <= c.last; ++id) {
      const auto& node = statements_[id]->node;
      c.may_leave |= std::holds_alternative<Return>(node) || std::holds_alternative<End>(node) ||
                     std::holds_alternative<Jump>(node) || std::holds_alternative<Switch>(node);
    }
    return c;
  }

  Callee called(const CallRoutine& call) {
    Callee c;
    c.computed = call.computed != nullptr;
    if (c.computed) return c;
    c.routine = find_routine(call.routine);
    if (call.has_range) {
      Repeat range;
      range.first = call.first;
      range.last = call.last;
      return range_of(c.routine, range);
    }
    c.known = c.routine != nowhere;
    return c;
  }

  // --- what a routine can change ------------------------------------------------------------------------------------

  using Calls = std::set<std::pair<std::size_t, std::size_t>>;  ///< caller, callee

  /// What a statement of the routine can change by itself; what it calls is noted.
  FactSet changed_beside_calls(const Statement& s, std::size_t routine, Calls& calls) {
    FactSet set, all;
    all.set();
    const auto through = [&](const Callee& c) {
      if (c.known)
        calls.emplace(routine, c.routine);
      else
        set = all;
    };
    if (const auto* c = std::get_if<CallRoutine>(&s.node)) return through(called(*c)), set;
    if (const auto* r = std::get_if<Repeat>(&s.node); r != nullptr && r->has_program)
      return through(range_of(find_routine(r->program), *r)), set;
    set = changed_by(s, probes_, framed_);
    const auto* m = std::get_if<ModalCall>(&s.node);
    if (m != nullptr) set[modal_call_bit] = true;
    if (moves(s) || may_run_modal_call(s)) {
      for (const auto target : modal_targets_) calls.emplace(routine, target);
      if (modal_unknown_) set = all;
    }
    if (m != nullptr && m->here) through(called(m->call));
    return set;
  }

  /// Only called routines matter, and most programs have few or none: a straight program is not looked through.
  void find_changes() {
    std::vector<bool> wanted(routines_.size());
    for (const auto* s : statements_) {
      if (s == nullptr) continue;
      std::size_t callee = nowhere;
      if (const auto* c = std::get_if<CallRoutine>(&s->node)) callee = find_routine(c->routine);
      if (const auto* m = std::get_if<ModalCall>(&s->node)) callee = find_routine(m->call.routine);
      if (const auto* r = std::get_if<Repeat>(&s->node)) callee = find_routine(r->program);
      if (callee != nowhere) wanted[callee] = true;
    }
    if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) return;
    Calls calls;
    for (std::uint32_t id = 1; id < statements_.size(); ++id) {
      if (statements_[id] == nullptr || !wanted[routine_of_[id]]) continue;
      FactSet& changes = routines_[routine_of_[id]].changes;
      if (!changes.all()) changes |= changed_beside_calls(*statements_[id], routine_of_[id], calls);
    }
    for (bool grown = true; grown;) {
      grown = false;
      for (const auto& [caller, callee] : calls) {
        const FactSet more = routines_[caller].changes | routines_[callee].changes;
        grown |= more != routines_[caller].changes;
        routines_[caller].changes = more;
      }
    }
  }

  // --- the worklist -------------------------------------------------------------------------------------------------

  void start(std::size_t routine, bool at_power_on) {
    Facts f;
    if (at_power_on) {
      f = facts_at(power_on_);
    } else {
      f.forget();
      if (chooses_spindles_) f.master.reset();
      f.reachable = true;
      f.modal_call = 0;  // a subprogram by itself: nothing says that its caller has one in force
    }
    current_ = dirty_.size();
    enter(routine, f);
    while (first_dirty_ < dirty_.size()) {
      for (current_ = std::exchange(first_dirty_, dirty_.size()); current_ < dirty_.size(); ++current_) {
        if (!dirty_[current_]) continue;
        dirty_[current_] = false;
        if (facts_[current_].reachable) process(static_cast<std::uint32_t>(current_));
      }
    }
  }

  void mark(std::uint32_t id) {
    dirty_[id] = true;
    if (id <= current_) first_dirty_ = std::min<std::size_t>(first_dirty_, id);  // else this sweep comes to it
  }
  void mark_all(const std::vector<std::uint32_t>& ids) {
    for (const auto id : ids) mark(id);
  }
  void flow_to(std::uint32_t id, const Facts& f) {
    if (join(facts_[id], f)) mark(id);
  }

  void enter(std::size_t routine, const Facts& f) {
    RoutineState& r = routines_[routine];
    r.entered = true;
    if (r.entry == 0) return leave(routine, f);
    if (join(facts_[r.entry], f)) mark(r.entry), mark_all(r.callers);
  }

  void leave(std::size_t routine, const Facts& f) {
    RoutineState& r = routines_[routine];
    if (join(r.at_exit, f)) mark_all(r.callers);
  }

  /// A stretch under one switch is left out as a whole.
  void leave_out(std::uint32_t id) {
    const auto& stretches = stretches_[routine_of_[id]].last_of;
    const auto last = stretches.find(id);
    if (last == stretches.end()) return;
    for (const auto to : successors_[last->second]) {
      if (to != 0)
        flow_to(to, facts_[id]);
      else
        leave(routine_of_[id], facts_[id]);
    }
  }

  void process(std::uint32_t id) {
    leave_out(id);
    const Statement& s = *statements_[id];
    Facts out = facts_[id];
    if (!carry_out(s, out)) out.reachable = false;
    if (skipped_[id]) {
      Facts both = facts_[id];
      join(both, out);
      out = both;
    }
    if (!out.reachable) return;
    if (const auto range = range_ends_.find(id); range != range_ends_.end() && join(range->second.facts, out))
      mark_all(range->second.callers);
    const auto* end = std::get_if<End>(&s.node);
    for (const auto to : successors_[id]) {
      if (to != 0) {
        flow_to(to, out);
      } else if (end == nullptr || end->returns_from_sub || skipped_[id]) {
        leave(routine_of_[id], out);
      }
    }
  }

  /// Calls followed, everything else by apply(). False: nothing comes after it (yet).
  bool carry_out(const Statement& s, Facts& f) {
    if (const auto* c = std::get_if<CallRoutine>(&s.node)) {
      return call(s.id, called(*c), c->count, f) && !c->tail;
    }
    if (const auto* r = std::get_if<Repeat>(&s.node); r != nullptr && r->has_program) {
      return call(s.id, range_of(find_routine(r->program), *r), r->count, f);
    }
    if (const auto* m = std::get_if<ModalCall>(&s.node)) return modal_call(s, *m, f);
    if (const auto* r = std::get_if<Return>(&s.node); r != nullptr && !r->values.empty()) return goes_back_elsewhere(f);
    if (!f.modal_call_runs() || !(moves(s) || may_run_modal_call(s))) {
      apply(s, f, framed_);
      return true;
    }
    const auto* b = std::get_if<Block>(&s.node);
    const bool counted = b != nullptr && b->repeat_given != 0;  // no time, or more than once
    if (!counted && moves(s) && !inside_modal_[routine_of_[s.id]]) return block_with_modal_call(s, f);
    Facts without = f;
    without.modal_call = Facts::in_modal_run;
    apply(s, without, framed_);
    without.modal_call = f.modal_call;
    f.reachable = block_with_modal_call(s, f);
    join(f, without);
    return true;
  }

  bool call(std::uint32_t id, const Callee& callee, const ExprPtr& count, Facts& f) {
    const Facts before = f;
    if (!callee.known) {
      f.forget();
      if (callee.computed) enter_all(before);
      if (callee.routine != nowhere) enter_anywhere(callee.routine, f);
      return true;
    }
    Facts entry = before;
    if (entry.modal_call_runs()) entry.modal_call = -1;  // whether it goes on in the callee is the machine's affair
    const Facts at_exit = outcome(id, callee, entry);
    if (!at_exit.reachable) return false;
    if (!runs_once_at_most(count)) {
      Facts again = at_exit;
      if (callee.first == 0) {
        if (program_.routines[callee.routine].saves_modals) {  // each pass gives the modal state back
          again = before;
          take(again, at_exit, kept_changes(callee.routine, before, again));
          if (again.modal_call_runs()) again.modal_call = -1;
        }
        enter(callee.routine, again);
      } else {
        flow_to(callee.first, again);
      }
    }
    take(f, at_exit, kept_changes(callee.routine, before, f));
    const auto* block = std::get_if<Block>(&statements_[id]->node);  // under a modal call, perhaps with a count
    const bool once = !count && (block == nullptr || block->repeat_given == 0);
    const std::uint32_t start = callee.first == 0 && once ? routines_[callee.routine].entry : 0;
    if (start != 0) displace(f, before, program_.routines[callee.routine], facts_[start], framed_);
    if (!runs_at_least_once(count)) join(f, before);
    return true;
  }

  static void listen(std::vector<std::uint32_t>& callers, std::uint32_t id) {
    if (std::find(callers.begin(), callers.end(), id) == callers.end()) callers.push_back(id);
  }

  /// The facts at the end of the callee; they grow while the analysis goes on, and `id` is visited again then.
  Facts outcome(std::uint32_t id, const Callee& callee, const Facts& entry) {
    RoutineState& routine = routines_[callee.routine];
    if (callee.first == 0) {
      listen(routine.callers, id);
      enter(callee.routine, entry);
      return routine.at_exit;
    }
    const bool is_new = range_ends_.count(callee.last) == 0;
    RangeEnd& end = range_ends_[callee.last];
    listen(end.callers, id);
    if (is_new) mark(callee.last);
    routine.entered = true;
    flow_to(callee.first, entry);
    if (!callee.may_leave) return end.facts;
    listen(routine.callers, id);
    Facts both = end.facts;
    join(both, routine.at_exit);
    return both;
  }

  /// The changes of the callee that stay.
  FactSet kept_changes(std::size_t routine, const Facts& before, Facts& f) const {
    const FactSet& set = routines_[routine].changes;
    return program_.routines[routine].saves_modals ? given_back(set, before, f) : set;
  }

  void enter_anywhere(std::size_t routine, const Facts& f) {
    routines_[routine].entered = true;
    for (std::uint32_t id = 1; id < statements_.size(); ++id) {
      if (statements_[id] != nullptr && routine_of_[id] == routine) flow_to(id, f);
    }
  }

  /// A return to a label of one of the callers.
  bool goes_back_elsewhere(Facts& f) {
    f.forget();
    for (std::size_t i = 0; i < routines_.size(); ++i) enter_anywhere(i, f);
    return true;
  }

  void enter_all(const Facts& f) {
    Facts entry = f;
    if (entry.modal_call_runs()) entry.modal_call = -1;
    for (std::size_t i = 0; i < routines_.size(); ++i) enter(i, entry);
  }

  bool modal_call(const Statement& s, const ModalCall& m, Facts& f) {
    const Facts before = f;
    if (m.here && m.cycle) f.forget();  // a cycle that runs at once
    apply(s, f, framed_);
    if (m.off || m.cycle) return true;
    take(f, before, ~FactSet(1ULL << cycle_bit | 1ULL << modal_call_bit));
    const Callee callee = called(m.call);
    f.modal_call = callee.known && callee.first == 0 ? static_cast<std::int32_t>(callee.routine) + 1 : -1;
    return !m.here || run_modal(s.id, callee, f);
  }

  /// One run of the modal subprogram, which may end the modal call or make another one.
  bool run_modal(std::uint32_t id, const Callee& callee, Facts& f) {
    const std::int32_t active = std::exchange(f.modal_call, Facts::in_modal_run);
    if (!call(id, callee, nullptr, f)) return false;
    const bool may_change = !callee.known || routines_[callee.routine].changes[modal_call_bit];
    if (f.modal_call == Facts::in_modal_run) f.modal_call = may_change ? -1 : active;
    return true;
  }

  bool block_with_modal_call(const Statement& s, Facts& f) {
    const std::int32_t active = std::exchange(f.modal_call, Facts::in_modal_run);
    apply(s, f, framed_);  // it runs at each point of a pattern
    f.modal_call = std::max(active, 0);
    const auto* b = std::get_if<Block>(&s.node);
    const bool once = b != nullptr && b->repeat_given == 0 && !has_pattern(*b);
    const auto run = [&](std::size_t target, Facts& facts) {
      if (!run_modal(s.id, {target, 0, 0, true}, facts)) return false;
      if (once) return true;
      const bool another = routines_[target].changes[modal_call_bit];  // another one may run at the next point
      if (another) facts.forget();
      Facts again = facts;  // to the next point, and once more
      again.modal_call = Facts::in_modal_run;
      apply(s, again, framed_);
      for (const auto next : modal_targets_) {
        if (another || next == target) enter(next, again);
      }
      return true;
    };
    if (active >= 0) return run(static_cast<std::size_t>(active) - 1, f);
    Facts behind = f;  // none runs, or one of them
    for (const auto target : modal_targets_) {
      Facts one = f;
      if (run(target, one)) join(behind, one);
    }
    f = behind;
    if (modal_unknown_) f.forget();
    f.modal_call = -1;
    return true;
  }

  struct RangeEnd {
    Facts facts;  ///< after the last statement
    std::vector<std::uint32_t> callers;
  };

  const Program& program_;
  const ModalState& power_on_;
  Uncalled uncalled_;
  std::vector<RoutineState> routines_;
  std::vector<const Statement*> statements_;
  std::vector<std::vector<std::uint32_t>> successors_;
  std::vector<std::size_t> routine_of_;
  std::vector<Facts> facts_;
  std::vector<bool> dirty_;
  std::vector<bool> skipped_;             ///< it is left out by itself
  std::vector<SkipStretches> stretches_;  ///< of each routine
  std::size_t first_dirty_ = 0;
  std::size_t current_ = 0;
  std::unordered_map<std::size_t, LabelTable> labels_;
  std::unordered_map<std::uint32_t, RangeEnd> range_ends_;
  std::vector<std::size_t> modal_targets_;
  std::vector<bool> inside_modal_;  ///< by routine: within its run no modal subprogram is started
  CyclesUsed cycles_;
  std::array<Facts, 4> probes_;
  FrameReach framed_;
  bool modal_unknown_ = false;
  bool chooses_spindles_ = false;  ///< some block has a MasterSpindle
};

}  // namespace

FactTable analyse(const Program& program, const ModalState& power_on, Uncalled uncalled) {
  return Analysis(program, power_on, uncalled).run();
}

}  // namespace cnctrans::ir
