// Routines that give their caller its modal state back (equivalences 21.1): on a target without that the state is
// written out before each return; what differs from call to call, behind those calls that it counts behind.
#include <algorithm>
#include <map>
#include <set>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/domains/kept_values.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/analysis/feed_units.h"
#include "legaliser/analysis/modal_needs.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

class Restore {
 public:
  Restore(Program& program, const LegaliseContext& context)
      : program_(program),
        context_(context),
        calls_(program),
        facts_(program, context),
        needs_(program, calls_),
        feed_units_(program, FeedUnits(context.source_machine.power_on.units_feed_too)) {}

  void run() {
    for (std::size_t i = 0; i < program_.routines.size(); ++i) {
      if (program_.routines[i].saves_modals) plan(i);
    }
    for (const auto& [index, changes] : at_returns_) routine(index, changes);
    write_behind_calls();
    for (auto& r : program_.routines) r.saves_modals = false;
  }

 private:
  /// What the routine and those that it calls set.
  struct Changes {
    std::set<Setting> settings;
    bool motion = false, offset = false;
    std::size_t callee = 0;  ///< behind a call: of it
  };

  Changes changes_of(std::size_t index) const {
    Changes c;
    for (const auto r : reached_from(calls_, index)) {
      for_each_statement(program_.routines[r].body, [&c](const Statement& s) {
        const auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr) return;
        c.motion = c.motion || (b->has_motion && b->motion.kind != MotionKind::modal && b->motion.keeps_modal);
        for (const auto& a : b->actions) {
          if (const auto* m = std::get_if<ModalSet>(&a.data)) c.settings.insert(m->setting);
          c.offset = c.offset || std::holds_alternative<WorkOffset>(a.data);
        }
      });
    }
    return c;
  }

  /// What of the changes is written where; a fault when nobody can know what to write.
  void plan(std::size_t index) {
    Routine& r = program_.routines[index];
    if (r.body.empty()) return;
    const Facts& entry = facts_.before(r.body.front());
    const Changes changes = changes_of(index);
    Changes at_return;
    std::string missing;
    std::vector<std::pair<ModalGroup, std::string_view>> groups;
    const auto group = [&](const ModalGroup& g, std::string_view what, auto&& put) {
      groups.emplace_back(g, what);
      if (known(g, entry, r.body.front()))
        put(at_return);
      else if (!behind_calls(index, g, put))
        missing += (missing.empty() ? "" : ", ") + std::string(what);
    };
    for (const auto s : changes.settings) {
      group({ModalGroup::Kind::setting, s}, name(s), [s](Changes& c) { c.settings.insert(s); });
    }
    if (changes.motion) {
      group({ModalGroup::Kind::motion}, "motion function", [](Changes& c) { c.motion = true; });
    }
    if (changes.offset) {
      group({ModalGroup::Kind::offset}, "work offset", [](Changes& c) { c.offset = true; });
    }
    tell_passes(index, groups);
    if (missing.empty()) {
      at_returns_.emplace_back(index, at_return);
      return;
    }
    context_.diagnostics.error(
        "TRN-189", r.header.span,
        "the subprogram gives its caller the modal state back (SAVE), and what holds at its calls "
        "is not known or not the same everywhere: " +
            missing,
        "write the state after each call");
  }

  /// Before statement `s`, where `facts` hold.
  bool known(const ModalGroup& g, const Facts& facts, const Statement& s) const {
    switch (g.kind) {
      case ModalGroup::Kind::setting:
        if (g.setting == Setting::units && facts.settings[static_cast<std::size_t>(g.setting)])
          return feed_too(facts, s).has_value();
        return facts.settings[static_cast<std::size_t>(g.setting)].has_value();
      case ModalGroup::Kind::offset: return facts.work_offset.has_value();
      case ModalGroup::Kind::motion: break;
    }
    return facts.motion == MotionKind::rapid || facts.motion == MotionKind::linear;
  }

  /// Whether the unit in force before the statement holds for F too. Millimetres are the same either way, but have to
  /// take F back from inches that did.
  std::optional<bool> feed_too(const Facts& facts, const Statement& s) const {
    if (facts.settings[static_cast<std::size_t>(Setting::units)] == static_cast<std::uint8_t>(Units::metric))
      return any_action(program_, [](const Action& a) {
        const auto* m = std::get_if<ModalSet>(&a.data);
        return m != nullptr && m->setting == Setting::units && m->feed_too;
      });
    const auto* state = feed_units_.before(s);
    return state == nullptr ? std::nullopt : state->value;
  }

  /// The passes of a call with a count: each of them ends the routine, so each gives the state back.
  void tell_passes(std::size_t index, const std::vector<std::pair<ModalGroup, std::string_view>>& groups) {
    for (const auto& site : calls_.sites()) {
      const auto* call = std::get_if<CallRoutine>(&site.statement->node);
      const auto count = call != nullptr && call->count ? constant_value(call->count) : std::optional(1.0);
      if (site.callee != index || (count && *count < 2)) continue;
      std::string text;
      for (const auto& [group, what] : groups) {
        if (needs_.again(site, group)) text += (text.empty() ? "" : ", ") + std::string(what);
      }
      if (text.empty()) continue;
      context_.diagnostics.warning(
          "TRN-612", site.statement->line.span,
          "each pass of this call is taken to begin with the modal state of the call (SAVE): " + text,
          "set it at the head of the subprogram");
    }
  }

  /// What holds where the routine ends, but for what another one below it was not made to give back.
  Facts as_left(std::size_t index, Facts facts) const {
    for (const auto r : reached_from(calls_, index)) {
      const auto open = r == index ? left_open_.end() : left_open_.find(r);
      if (open == left_open_.end()) continue;
      for (const auto s : open->second.settings) facts.settings[static_cast<std::size_t>(s)].reset();
      if (open->second.motion) facts.motion.reset();
      if (open->second.offset) facts.work_offset.reset();
    }
    return facts;
  }

  /// What holds at the end of the routine, whichever way it ends.
  Facts exit_of(std::size_t index) const {
    const Body& body = program_.routines[index].body;
    Facts out;
    bool first = true;
    for_each_statement(body, [&](const Statement& s) {
      const auto* end = std::get_if<End>(&s.node);
      if (!std::holds_alternative<Return>(s.node) && (end == nullptr || !end->returns_from_sub)) return;
      if (first)
        out = facts_.before(s);
      else
        join(out, facts_.before(s));
      first = false;
    });
    const bool falls_out =
        !std::holds_alternative<Return>(body.back().node) && !std::holds_alternative<End>(body.back().node);
    if (first || falls_out) out.forget();
    return out;
  }

  /// Behind each call that the group counts behind it is known: there it is written. False: not everywhere.
  template <class Put>
  bool behind_calls(std::size_t index, const ModalGroup& g, const Put& put) {
    std::vector<std::uint32_t> places;
    bool called = false;
    for (const auto& site : calls_.sites()) {
      if (site.callee != index) continue;
      called = true;
      if (!needs_.behind(site, g)) {
        put(left_open_[index]);
        continue;
      }
      const auto* call = std::get_if<CallRoutine>(&site.statement->node);
      const bool once = call != nullptr && !call->count && !call->has_range && !call->computed;
      const Facts& before = facts_.before(*site.statement);
      if (!once || !known(g, before, *site.statement)) return false;
      places.push_back(site.statement->id);
    }
    for (const auto id : places) {
      behind_[id].callee = index;
      put(behind_[id]);
    }
    return called;
  }

  void write_behind_calls() {
    if (behind_.empty()) return;
    for (auto& r : program_.routines) {
      Editor editor(program_, r, context_);
      rewrite_body(r.body, [&](Statement&& s, Body& out) {
        const auto changes = s.id == 0 ? behind_.end() : behind_.find(s.id);
        if (changes == behind_.end()) {
          out.push_back(std::move(s));
          return;
        }
        Body back;
        LineInfo like;
        like.span = s.line.span;
        like.skip_mask = s.line.skip_mask;
        const std::size_t callee = changes->second.callee;
        written_back(like, changes->second, s, as_left(callee, exit_of(callee)), back);
        Body pieces;
        pieces.push_back(std::move(s));
        for (auto& b : back) pieces.push_back(std::move(b));
        editor.put_group(out, std::move(pieces), 0);
      });
    }
  }

  void routine(std::size_t index, const Changes& changes) {
    Routine& r = program_.routines[index];
    Statement entry;  // where the routine begins
    entry.id = r.body.front().id;
    Editor editor(program_, r, context_);
    rewrite_body(r.body, [&](Statement&& s, Body& out) {
      const auto* end = std::get_if<End>(&s.node);
      const bool back = std::holds_alternative<Return>(s.node) || (end != nullptr && end->returns_from_sub);
      Body pieces;
      if (back) written_back(s.line, changes, entry, as_left(index, facts_.before(s)), pieces);
      const bool of_its_own = !pieces.empty();  // not in the block of a move that the return stands in
      const std::size_t at = out.size();
      editor.put(out, std::move(pieces), std::move(s));
      if (of_its_own) out[at].line.joined = false;
    });
    if (std::holds_alternative<Return>(r.body.back().node) || std::holds_alternative<End>(r.body.back().node)) return;
    Body pieces;
    written_back(r.body.back().line, changes, entry, Facts{}, pieces);
    for (auto& p : pieces) r.body.push_back(std::move(p));
  }

  /// The state before the statement `as` comes back where `now` holds.
  void written_back(const LineInfo& like, const Changes& changes, const Statement& as, const Facts& now,
                    Body& out) const {
    const Facts& entry = facts_.before(as);
    Block b;
    for (const auto s : changes.settings) {
      const auto index = static_cast<std::size_t>(s);
      if (now.settings[index] == entry.settings[index]) continue;
      if (s == Setting::spindle_mode)
        context_.diagnostics.warning("TRN-611", like.span,
                                     "the subprogram gives its caller the spindle mode back (SAVE): the speed that "
                                     "holds then is the one reached "
                                     "last on the target, and the caller's own one in the source",
                                     "write S behind the call");
      ModalSet set;
      set.setting = s;
      set.value = *entry.settings[index];
      set.feed_memory = FeedMemory::per_mode;
      if (s == Setting::units) set.feed_too = feed_too(entry, as).value_or(true);
      b.actions.push_back(action(set));
    }
    if (changes.offset && now.work_offset != entry.work_offset) {
      b.actions.push_back(action(WorkOffset{Value(static_cast<double>(*entry.work_offset)), *entry.work_offset == 0}));
    }
    if (changes.motion && now.motion != entry.motion) {
      b.has_motion = true;
      b.motion.kind = *entry.motion;  // no code of the source, which would run what is called at each block
    }
    if (!b.empty()) out.push_back(made(like, std::move(b)));
  }

  Program& program_;
  const LegaliseContext& context_;
  CallGraph calls_;
  FactsOf facts_;
  ModalNeeds needs_;
  FlowStates<FeedUnits> feed_units_;
  std::vector<std::pair<std::size_t, Changes>> at_returns_;
  std::map<std::size_t, Changes> left_open_;  ///< by routine: what counts for nothing behind some call of it
  std::map<std::uint32_t, Changes> behind_;   ///< by the id of the call
};

}  // namespace

void restore_modals(Program& program, const LegaliseContext& context) {
  const bool saves =
      std::any_of(program.routines.begin(), program.routines.end(), [](const Routine& r) { return r.saves_modals; });
  if (!saves || context.target_machine.policies.call_saves_modals) return;
  // A replay sees a line that a switch leaves out only where it is carried out: the state at the head is asked before.
  for (auto& r : program.routines) {
    if (r.saves_modals && !r.body.empty() && r.body.front().line.skip_mask != 0)
      r.body.insert(r.body.begin(), made(LineInfo{}, Label{}));
  }
  Restore(program, context).run();
}

}  // namespace cnctrans::ir::passes
