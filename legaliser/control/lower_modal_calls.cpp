// Modal calls of subprograms (equivalences 21.2): where the target has none, runs them at other blocks, or starts them
// otherwise.
#include <algorithm>
#include <map>
#include <set>

#include "ir/analysis/call_graph.h"
#include "ir/analysis/domains/kept_values.h"
#include "ir/analysis/flow_states.h"
#include "ir/edit/rewrite.h"
#include "ir/edit/search.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/control/modal_callees.h"
#include "legaliser/cycles/parts/cycle_parts.h"
#include "legaliser/edit/editor.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {
namespace {

/// On this machine F, S and a bare motion code run a modal subprogram as well.
bool words_run(const machine::Profile& machine) {
  return machine.policies.call_modal_words;
}

class ModalCalls {
 public:
  ModalCalls(Program& program, const LegaliseContext& context, const CallGraph& calls, const FactsOf& facts)
      : program_(program),
        context_(context),
        calls_(calls),
        facts_(facts),
        in_force_(program, ModalCallInForce{}),
        by_main_(called_by_main(program, calls)),
        reads_first_(program, calls, false),
        writes_(program) {
    for (const auto& r : program.routines) {
      for_each_statement(r.body, [this](const Statement& s) {
        const auto* state = in_force_.before(s);
        if (state != nullptr && *state != 0) under_.emplace(s.id, *state);
        const auto* m = std::get_if<ModalCall>(&s.node);
        if (m != nullptr && !m->off && !m->cycle) defined_.emplace(s.id, *m);
        by_calls_ = by_calls_ || (m != nullptr && m->cycle != nullptr);
        some_written_out_ = some_written_out_ || (m != nullptr && !m->off && !m->cycle && !stays_modal(*m));
      });
    }
  }

  void run(Routine& routine) {
    active_.reset();
    on_target_.reset();
    from_ = 0;
    const auto* entry =
        routine.body.empty() || has_modal_call(routine) ? nullptr : in_force_.before(routine.body.front());
    brought_ = entry == nullptr ? 0 : *entry;
    Editor editor(program_, routine, context_);
    editor_ = &editor;
    uses_ = label_uses(program_, routine);
    routine_ = static_cast<std::size_t>(&routine - program_.routines.data());
    on_target_ = brought();
    walk(routine.body);
  }

 private:
  void walk(Body& body) {
    Body out;
    out.reserve(body.size());
    for (auto& s : body) {
      each_body(s, [this](Body& inner) { walk(inner); });
      one(std::move(s), out);
    }
    body = std::move(out);
  }
  /// The target's own modal call that every caller of this routine has in force. Its own subprogram runs without it.
  std::optional<ModalCall> brought() const {
    const auto found = defined_.find(brought_);
    if (found == defined_.end() || !stays_modal(found->second)) return std::nullopt;
    ModalCall m = found->second;
    if (m.call.computed || !calls_.index_of(m.call.routine) || is_own(m.call)) return std::nullopt;
    m.here = context_.target.modal_call_here;
    return m;
  }
  bool is_target(const Statement& s) const {
    const auto labels = labels_on(s.line);
    return std::any_of(labels.begin(), labels.end(), [this](const LabelRef& l) { return uses_.is_target(l); });
  }
  /// The modal call that the text has in force here is not the one that every path brings, and that matters.
  bool by_another_way(const Statement& s, const Block& b) const {
    const auto* state = in_force_.before(s);
    if (state == nullptr || *state == from_) return false;
    const bool runs = runs_modal_call(b, facts_.before(s), words_run(context_.source_machine));
    // What acts behind the run of a subprogram that the text does not show would come before it.
    const bool outside = by_main_.count(routine_) != 0;
    const bool other = program_.dialect != context_.target.dialect;
    const bool behind = runs && outside && !on_target_ && context_.target.modal_call && other && acts_behind_motion(b);
    const auto known = [this] {
      return defined_.count(brought_) != 0 ||
             std::all_of(defined_.begin(), defined_.end(), [this](const auto& d) { return is_own(d.second.call); });
    };
    if (from_ == 0 && *state == brought_ && (!outside || known())) return behind;
    const auto* pattern = pattern_in(b);
    if (runs || pattern) return some_written_out_ || behind || (other && goes_at_a_feed(pattern));
    return runs_modal_call(b, facts_.before(s), words_run(context_.target_machine)) && context_.target.modal_call;
  }
  /// A caller of this routine, or another way than that of the text (a loop, a repeat), may bring a modal subprogram.
  bool brought_along(const Statement& s) const {
    const auto* state = in_force_.before(s);
    if (!context_.target.modal_call || state == nullptr || *state == 0 || from_ != 0) return false;
    return std::any_of(defined_.begin(), defined_.end(), [&](const auto& d) {
      const bool this_one = *state == d.first || *state == ModalCallInForce::several;
      return this_one && !never_modal(d.second.call) && !is_own(d.second.call);
    });
  }
  /// This routine is the subprogram of the modal call, or is called by it: it runs without it.
  bool is_own(const CallRoutine& call) const {
    const auto callee = calls_.index_of(call.routine);
    return callee && reached_from(calls_, *callee).count(routine_) != 0;
  }
  /// The target's own modal call takes its place.
  bool stays_modal(const ModalCall& m) const {
    return context_.target.modal_call && !never_modal(m.call) && (m.here || context_.target.modal_call_here == m.here);
  }
  /// The last statement switched the target's call on again, and nothing has run since: it is taken back.
  bool take_back_on(const Statement& next, Body& out) {
    if (wrapped_in_ != &out || out.size() != wrapped_size_ || is_target(next)) return false;
    out.pop_back();
    wrapped_in_ = nullptr;
    return true;
  }

  void one(Statement&& s, Body& out) {
    auto* m = std::get_if<ModalCall>(&s.node);
    if (m != nullptr && !m->cycle) return definition(std::move(s), out);
    if (m != nullptr) {  // a cycle in its place
      active_.reset();
      on_target_.reset();
      from_ = 0;
    }
    const auto* call = std::get_if<CallRoutine>(&s.node);
    const bool moves_inside = call != nullptr && may_move(program_, calls_, *call);
    if (moves_inside && active_) inside(s);
    if (moves_inside && !active_ && some_written_out_ && !surely_on(s)) return depends_on_way(std::move(s), out);
    auto* b = std::get_if<Block>(&s.node);
    if (b != nullptr && by_another_way(s, *b)) return depends_on_way(std::move(s), out);
    if (b != nullptr && pattern_in(*b) == nullptr &&
        ((on_target_ ? cycle_beside(*b, true) : action_in<CycleDefine>(*b) != nullptr && brought_along(s)) ||
         ends_call_too(s, *b)))
      return refused(std::move(s), out, "TRN-561",
                     "a canned cycle beside a modal subprogram: the target has one of them at a time",
                     "end the modal subprogram before the cycle");
    if (b != nullptr && b->repeat_given != 0) goes_on_with_locals(s, *b);
    if (b == nullptr || (!active_ && !on_target_)) return out.push_back(std::move(s));
    if (const auto* pattern = pattern_in(*b)) return points(std::move(s), *pattern, out);
    const bool only_moves = b->repeat_given != 0 && b->repeat.is(0);
    if (const Facts& now = facts_.before(s); only_moves && (now.cycle_active || !now.cycle_active_known))
      return refused(std::move(s), out, "TRN-199",
                     "a block that only positions, with a modal subprogram and perhaps a cycle in force: the target "
                     "would run one of them",
                     "end the modal subprogram and the cycle before the block");
    if (only_moves) {
      b->repeat_given = 0;
      b->repeat = Value{};
    }
    const bool in_source = !only_moves && runs_modal_call(*b, facts_.before(s), words_run(context_.source_machine));
    if (active_) return in_source ? written_out(std::move(s), out) : out.push_back(std::move(s));
    const bool in_target =
        runs_modal_call(*b, facts_.before(s), words_run(context_.target_machine)) || cycle_beside(*b, false);
    if (in_source && acts_behind_motion(*b) && program_.dialect != context_.target.dialect)
      return surely_on(s) ? by_itself_with_call(std::move(s), out) : depends_on_way(std::move(s), out);
    if (in_source || !in_target) return out.push_back(std::move(s));
    if (!surely_on(s)) return depends_on_way(std::move(s), out);
    // The target would run the subprogram here.
    if (!fixed_arguments(on_target_->call)) {
      context_.diagnostics.error("TRN-188", s.line.span,
                                 "the target would run the modal subprogram at this block too, and its arguments are "
                                 "computed: it can't be switched off and on again here",
                                 "write the block before the modal call or after its end");
    }
    const LineInfo like = s.line;
    if (!take_back_on(s, out)) {
      Statement off = made(like, off_call());
      move_head(s.line, off.line);
      out.push_back(std::move(off));
    }
    out.push_back(std::move(s));
    out.push_back(made(like, *on_target_));
    wrapped_in_ = &out;
    wrapped_size_ = out.size();
  }
  /// The modal call that the text has in force here is so on every way: it may be ended and begun again about a block.
  bool surely_on(const Statement& s) const {
    const auto* state = in_force_.before(s);
    return state == nullptr || *state == (from_ != 0 ? from_ : brought_);
  }
  void depends_on_way(Statement&& s, Body& out) {
    refused(std::move(s), out, "TRN-393",
            "which subprogram is modal here depends on the path that leads here, and its calls would stand in the text",
            "call the subprogram where it is to run, or end the modal call on every path");
  }
  void refused(Statement&& s, Body& out, const char* code, const std::string& why, const std::string& hint) {
    refuse(s, program_, context_, code, why, hint);
    out.push_back(std::move(s));
  }
  /// The moves of a called subprogram run the modal one as well, and nothing is written there.
  void inside(const Statement& s) const {
    context_.diagnostics.error("TRN-381", s.line.span,
                               "the moves of this subprogram would run the modal one too, which the target calls only "
                               "where it is written",
                               "end the modal call before this one");
  }
  /// The subprogram runs at each point of a pattern. The target's own modal call does so by itself, but for ways at a
  /// feed of their own, behind which the feed of before counts again.
  void points(Statement&& s, const NamedCycle& pattern, Body& out) {
    const LineInfo like = s.line;
    std::string error;
    bool guessed = false;
    auto blocks = pattern_blocks(pattern, like, std::get<Block>(s.node), facts_.before(s), &guessed, &error);
    const bool own_feed = blocks && std::any_of(blocks->begin(), blocks->end(), [](const Statement& p) {
                            return !std::get<Block>(p.node).actions.empty();
                          });
    if (!active_ && !own_feed) return out.push_back(std::move(s));
    const CallRoutine call = active_ ? *active_ : on_target_->call;
    if (guessed) error = "it begins at the end that is nearer to the tool, and where the tool stands is not known here";
    const Facts& now = facts_.before(s);
    const auto feed = now.feed;
    if (blocks && arcs_from_elsewhere(*blocks, program_, calls_, call, facts_)) {
      error = "the tool goes from point to point along arcs, and the modal subprogram leaves it elsewhere";
    }
    if (own_feed && (now.cycle_active || !now.cycle_active_known)) {
      error = "the tool goes from point to point at a feed of the pattern's own, and a cycle may run there as well";
    } else if (own_feed && (!feed || !leaves_feed(program_, calls_, call, *feed))) {
      error = "the tool goes from point to point at a feed of the pattern's own, and the feed behind it is not known";
    } else if (own_feed && !active_ && !fixed_arguments(call)) {
      error = "the arguments of the modal subprogram are computed";
    }
    if (!blocks || !error.empty()) {
      if (error.empty()) error = "its words are computed when the program runs";
      return refused(std::move(s), out, "TRN-330", "a pattern that the target lacks can't be written out: " + error,
                     "give the pattern's words and the place before it as numbers");
    }
    if (leaves_its_point(program_, calls_, call, facts_)) say_all_axes(*blocks, facts_.before(s));
    balance_increments(*blocks, s, std::get<Block>(s.node), facts_.before(s), context_);
    Body pieces;
    if (!active_ && !just_begun(s, out)) pieces.push_back(made(like, off_call()));
    for (auto& p : *blocks) {
      auto& b = std::get<Block>(p.node);
      for (auto& a : b.actions) std::get<SetFeed>(a.data).block_only = false;
      const bool way = !b.actions.empty();
      pieces.push_back(std::move(p));
      if (way) pieces.push_back(make_block(like, action(SetFeed{Value{*feed}})));
      pieces.push_back(made(like, call));
    }
    if (!active_) pieces.push_back(made(like, *on_target_));
    pieces.front().line = like;
    editor_->put_group(out, std::move(pieces), 0);
    if (active_) return;
    wrapped_in_ = &out;
    wrapped_size_ = out.size();
  }
  /// The target's own call would run before what this block becomes behind its motion: the call stands in the text.
  void by_itself_with_call(Statement&& s, Body& out) {
    const LineInfo like = s.line;
    if (!fixed_arguments(on_target_->call) || std::get<Block>(s.node).repeat_given != 0)
      context_.diagnostics.error("TRN-188", like.span,
                                 "the target would run the modal subprogram before what this block does behind its "
                                 "motion, and its arguments are computed: it can't be called here by itself",
                                 "write what comes behind the motion into a block of its own");
    Body pieces;
    if (!just_begun(s, out)) pieces.push_back(made(like, off_call()));
    pieces.push_back(std::move(s));
    pieces.push_back(made(like, on_target_->call));
    pieces.push_back(made(like, *on_target_));
    editor_->put_group(out, std::move(pieces), pieces.size() == 4 ? 1 : 0);
    wrapped_in_ = &out;
    wrapped_size_ = out.size();
  }
  /// The statement before switches the target's call on for nothing: it goes.
  bool just_begun(const Statement& next, Body& out) const {
    if (out.empty() || is_target(next)) return false;
    const auto* on = std::get_if<ModalCall>(&out.back().node);
    const LineInfo& line = out.back().line;
    if (on == nullptr || on->off || on->cycle || on->here || !line.number.empty() || !line.labels.empty() ||
        !line.comments.empty())
      return false;
    out.pop_back();
    return true;
  }
  static ModalCall off_call() {
    ModalCall off;
    off.off = true;
    return off;
  }

  /// A block with its call behind it; a repeat count repeats both.
  void written_out(Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    const LineInfo like = s.line;
    Body pieces;
    if (b.repeat_given == 0) {
      pieces.push_back(std::move(s));
      pieces.push_back(made(like, *active_));
      return editor_->put_group(out, std::move(pieces), 0);
    }
    const Value count = b.repeat;
    b.repeat_given = 0;
    b.repeat = Value{};
    constexpr double most_copies = 5;
    if (count.literal() && count.number <= most_copies) {
      const Block copy = b;
      pieces.push_back(std::move(s));
      pieces.push_back(made(like, *active_));
      for (double i = 1; i < count.number; ++i) {
        pieces.push_back(made(like, copy));
        pieces.push_back(made(like, *active_));
      }
      return editor_->put_group(out, std::move(pieces), 0);
    }
    For loop;
    loop.counter = VarRef{frame_space(program_), "N" + std::to_string(++loops_) + "@modal", nullptr, {}};
    loop.from = number(1);
    loop.to = count.literal() ? number(count.number) : count.expr;
    loop.body.push_back(made(like, std::move(b)));
    loop.body.back().line.comments = s.line.comments;
    loop.body.push_back(made(like, *active_));
    s.line.comments.clear();
    s.node = std::move(loop);
    out.push_back(std::move(s));
  }

  /// The runs of a repeated block go on with the local parameters as the last run left them: that can't be said by
  /// calls that each start from the arguments.
  void goes_on_with_locals(const Statement& s, const Block& b) {
    const auto* state = in_force_.before(s);
    if (state == nullptr || (b.repeat.literal() && b.repeat.number < 2) ||
        !runs_modal_call(b, facts_.before(s), words_run(context_.source_machine)) ||
        std::none_of(defined_.begin(), defined_.end(), [&](const auto& d) {
          return (d.first == *state || *state == ModalCallInForce::several) &&
                 reads_own_locals(program_, calls_, reads_first_, d.second.call);
        }))
      return;
    context_.diagnostics.error("TRN-187", s.line.span,
                               "the repetitions of this block run the modal subprogram with the local parameters that "
                               "the run before left; in the target each run starts from the arguments",
                               "write the repetitions as calls with their own arguments");
  }
  void definition(Statement&& s, Body& out) {
    ModalCall m = std::get<ModalCall>(s.node);
    from_ = m.off ? 0 : s.id;
    if (m.off) {
      if (!active_) {
        if (m.here && cycle_stays(s, out)) return on_target_.reset();
        on_target_.reset();
        if (take_back_on(s, out)) return leave_line(std::move(s), out);
        out.push_back(std::move(s));
        return;
      }
      active_.reset();
      leave_line(std::move(s), out);
      return;
    }
    if (program_.dialect != context_.target.dialect && changes_modal_calls(program_, calls_, m.call))
      return refused(
          std::move(s), out, "TRN-393",
          "the modal subprogram begins or ends a modal call itself: what is modal behind it depends on its runs",
          "end the modal call where it was begun");
    const bool modal = context_.target.modal_call && !never_modal(m.call);
    const LineInfo like = s.line;
    if (take_back_on(s, out)) on_target_.reset();
    end_cycle(s, modal && context_.target.modal_call_here == m.here, out);
    if (modal && context_.target.modal_call_here == m.here) {
      active_.reset();
      on_target_ = m;
      out.push_back(std::move(s));
      return;
    }
    // Another subprogram may still be modal on the target: the motions of this run would run it.
    const auto* before = in_force_.before(s);
    const bool ends_other = m.here && context_.target.modal_call && (on_target_ || (before != nullptr && *before != 0));
    if (ends_other) {
      Statement off = made(like, off_call());
      move_head(s.line, off.line);
      out.push_back(std::move(off));
    }
    on_target_.reset();
    if (modal && m.here) {  // run once, then modal
      s.node = m.call;
      out.push_back(std::move(s));
      m.here = false;
      active_.reset();
      on_target_ = m;
      out.push_back(made(like, std::move(m)));
      return;
    }
    keep_arguments(m.call, s, out);
    active_ = m.call;
    if (m.here) {
      s.node = m.call;
      out.push_back(std::move(s));
    } else {
      leave_line(std::move(s), out);
    }
  }
  /// The arguments are taken once, where the call becomes modal; written out it would compute them at each block.
  void keep_arguments(CallRoutine& call, Statement& s, Body& out) {
    const auto callee = call.computed ? std::nullopt : calls_.index_of(call.routine);
    const std::set<std::size_t> run = callee ? reached_from(calls_, *callee) : std::set<std::size_t>();
    const auto changes = [&](const ExprPtr& value) {
      if (Writes::reads_machine(value)) return true;
      return std::any_of(writes_.all().begin(), writes_.all().end(), [&](const Writes::Write& w) {
        const auto under = under_.find(w.at);
        const bool meanwhile =
            under != under_.end() && (under->second == s.id || under->second == ModalCallInForce::several);
        return (meanwhile || run.count(w.routine) != 0) && writes_.touches(w, value, routine_);
      });
    };
    Body before;
    for (auto& a : call.arguments) {
      if (a.by_reference || !a.value || a.value->type == Type::string || constant_value(a.value) || !changes(a.value))
        continue;
      a.value = kept(program_, s.line, a.value, "modal", kept_, before);
    }
    if (!before.empty()) move_head(s.line, before.front().line);
    for (auto& b : before) out.push_back(std::move(b));
  }
  /// The end of a modal subprogram that leaves a canned cycle in force, on a target where one word ends both.
  bool cycle_stays(Statement& s, Body& out) {
    const Facts& facts = facts_.before(s);
    if (!context_.target.modal_cycle_by_call || (facts.cycle_active_known && !facts.cycle_active)) return false;
    const auto* state = in_force_.before(s);
    if (on_target_ || state == nullptr || *state != 0) {
      refused(std::move(s), out, "TRN-561",
              "the end of a modal subprogram, behind which a canned cycle may go on: the target ends both",
              "write G80, or end the modal subprogram before the cycle is defined");
      return true;
    }
    leave_line(std::move(s), out);
    return true;
  }
  /// A modal subprogram ends a modal cycle; written out it leaves no word that would.
  void end_cycle(Statement& s, bool stays_modal, Body& out) const {
    const Facts& facts = facts_.before(s);
    if (stays_modal || (facts.cycle_active_known && !facts.cycle_active)) return;
    Statement off = by_calls_ ? made(s.line, off_call()) : make_block(s.line, action(CycleCancel{}));
    move_head(s.line, off.line);
    out.push_back(std::move(off));
  }
  /// A cycle of this block: a modal one would take the place of the target's modal call, one of the block alone may
  /// become moves, which would run the modal subprogram.
  bool cycle_beside(const Block& b, bool modal) const {
    const auto* define = action_in<CycleDefine>(b);
    return define != nullptr && define->modal == modal && calls_are_cycles_;
  }
  /// The end of a cycle, where the target's word for it ends the modal subprogram of some way as well.
  bool ends_call_too(const Statement& s, const Block& b) const {
    const Facts& facts = facts_.before(s);
    return calls_are_cycles_ && action_in<CycleCancel>(b) != nullptr && (on_target_ || brought_along(s)) &&
           (facts.cycle_active || !facts.cycle_active_known);
  }
  bool never_modal(const CallRoutine& call) const {
    return (calls_are_cycles_ && defines_cycle(program_, calls_, call)) || shares_level_too(calls_, call);
  }

  Program& program_;
  const LegaliseContext& context_;
  const CallGraph& calls_;
  const FactsOf& facts_;
  const bool calls_are_cycles_ = context_.target.modal_cycle_by_call && program_.dialect != context_.target.dialect;
  const FlowStates<ModalCallInForce> in_force_;
  const std::set<std::size_t> by_main_;
  ReadFirst reads_first_;
  const Writes writes_;
  std::map<std::uint32_t, ModalCall> defined_;    ///< modal calls of subprograms, by ids
  std::map<std::uint32_t, std::uint32_t> under_;  ///< what is in force before a statement, by ids
  std::size_t routine_ = 0;                       ///< that is rewritten
  int kept_ = 0;
  Editor* editor_ = nullptr;
  LabelUses uses_;
  std::optional<CallRoutine> active_;   ///< written out after each block
  std::optional<ModalCall> on_target_;  ///< the target's own one is in force
  const Body* wrapped_in_ = nullptr;    ///< where the target's call was last switched on again
  std::size_t wrapped_size_ = 0;
  bool by_calls_ = false;          ///< the program has cycles that are modal by call
  bool some_written_out_ = false;  ///< some modal call becomes calls behind each block
  std::uint32_t brought_ = 0;      ///< what the callers of this routine have in force, which has none of its own
  std::uint32_t from_ = 0;         ///< id of the definition that the text has in force; 0: none
  int loops_ = 0;
};

}  // namespace

void lower_modal_calls(Program& program, const LegaliseContext& context) {
  if (!starts_modal_calls(program)) return;
  const FactsOf facts(program, context);
  const CallGraph calls(program);
  ModalCalls pass(program, context, calls, facts);
  for (auto& r : program.routines) pass.run(r);
}

}  // namespace cnctrans::ir::passes
