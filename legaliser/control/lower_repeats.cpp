// Repetitions (equivalences 20.4): ranges in place, blocks with a count, counts of calls.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "ir/edit/whole_numbers.h"
#include "legaliser/analysis/head_constants.h"
#include "legaliser/control/called_labels.h"
#include "legaliser/cycles/parts/cycle_parts.h"
#include "legaliser/edit/editor.h"
#include "legaliser/expressions/expression_lowering.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

class RepeatPass {
 public:
  RepeatPass(Editor& editor, const HeadConstants& constants, bool& limit_told)
      : editor_(editor),
        target_(editor.target()),
        constants_(constants),
        cycles_(uses_cycles(editor.program)),
        limit_told_(limit_told) {}

  void run() {
    order_ranges();
    rewrite_body(editor_.routine.body, [this](Statement&& s, Body& out) {
      if (std::holds_alternative<Repeat>(s.node)) return range(std::move(s), out);
      if (std::holds_alternative<CallRoutine>(s.node)) return call(std::move(s), out);
      if (const auto* b = std::get_if<Block>(&s.node); b != nullptr && b->repeat_given != 0 && !target_.block_repeat) {
        return block(std::move(s), out);
      }
      out.push_back(std::move(s));
    });
  }

 private:
  void refused(Statement& s, std::string_view code, std::string text, std::string hint) {
    refuse(s, editor_.program, editor_.context, code, std::move(text), std::move(hint));
  }

  /// Ranges whose labels may stand in either order: the first in the text goes first.
  void order_ranges() {
    std::map<std::pair<bool, std::string>, std::size_t> places;
    std::size_t n = 0;
    for_each_statement(editor_.routine.body, [&](const Statement& s) {
      ++n;
      for (const auto& l : labels_on(s.line)) {
        places.emplace(std::make_pair(l.is_number, l.text), n);
        ++carriers_[{l.is_number, l.text}];
      }
    });
    for_each_statement(editor_.routine.body, [&](Statement& s) {
      auto* r = std::get_if<Repeat>(&s.node);
      if (r == nullptr || !r->order_free || r->has_program || r->first.computed || r->last.computed) return;
      const auto a = places.find({r->first.is_number, r->first.text}),
                 b = places.find({r->last.is_number, r->last.text});
      if (a != places.end() && b != places.end() && a->second > b->second) std::swap(r->first, r->last);
      r->order_free = false;
    });
  }

  void range(Statement&& s, Body& out) {
    auto& r = std::get<Repeat>(s.node);
    const auto passes = constant_value(r.count);
    if (passes && *passes <= 0) {
      s.node = Label{};
      return out.push_back(std::move(s));
    }
    if (r.has_program && !target_.repeat_other_program) {
      if (target_.call_range) {
        CallRoutine c;
        c.routine = r.program;
        c.has_range = true;
        c.first = r.first;
        c.last = r.last;
        c.count = r.count;
        s.node = std::move(c);
        return call(std::move(s), out);
      } else {
        refused(s, "TRN-195", "a part of another program is repeated: the target can't", "make the part a subprogram");
      }
      out.push_back(std::move(s));
      return;
    }
    if (!target_.repeat_range) {
      refused(s, "TRN-196", "the target can't repeat a part of the program in place", "make the part a subprogram");
      out.push_back(std::move(s));
      return;
    }
    if (target_.repeat_ends_here && editor_.program.dialect != target_.dialect) {
      if (!ends_here(r, out)) {
        refused(s, "TRN-196", "the target repeats only what stands right before the repetition",
                "make the part a subprogram, or repeat it right behind its last block");
        return out.push_back(std::move(s));
      }
      r.last = {};
      return put_counted<Repeat>(std::move(s), out);
    }
    if (!r.has_program && r.last.text.empty() && !r.last.computed && !end_before(r, out)) {
      refused(s, "TRN-197", "the repeated part has no last block that could get a label",
              "put a label on its last block");
    }
    if (std::holds_alternative<Repeat>(s.node)) return put_counted<Repeat>(std::move(s), out);
    out.push_back(std::move(s));
  }

  /// The part ends with the statement written last.
  bool ends_here(const Repeat& r, const Body& out) const {
    if (r.last.text.empty() && !r.last.computed) return true;
    if (out.empty() || r.last.computed) return false;
    const auto named = [&r](const Statement& s) {
      const auto have = labels_on(s.line);
      return std::any_of(have.begin(), have.end(), [&r](const LabelRef& l) { return same_label(l, r.last); });
    };
    return named(out.back()) && std::none_of(out.begin(), out.end() - 1, named);  // the first one counts
  }

  /// A repetition or a call with its count; several, or a repetition of it, where the count is beyond
  /// the target's.
  template <class Node>
  void put_counted(Statement&& s, Body& out) {
    auto& node = std::get<Node>(s.node);
    auto n = constant_value(node.count);
    const auto most = static_cast<double>(target_.repeat_max);
    constexpr double most_statements = 10;
    if (node.count && !n) {
      const auto known = constants_.count(node.count, editor_.routine, s);
      if (!known && !target_.repeat_count_variable) {
        refused(s, "TRN-196", "how often this is carried out is computed, and the target counts by a number only",
                "write a loop with a jump");
        return out.push_back(std::move(s));
      }
      if (known && *known >= 1 && *known <= most && !target_.repeat_count_variable) node.count = number(*known);
      if (!known) tell_limit(s);
      if (!known || *known < 1) return put_guarded<Node>(std::move(s), out);
      if (*known > most) n = known;
    }
    const bool nested = n && *n > most_statements * most;
    if (!node.count || !n || *n <= most || s.line.joined || (nested && !repeats_repeats())) {
      check_count(s, node.count);
      return out.push_back(std::move(s));
    }
    const LineInfo like = s.line;
    const Node whole = node;
    const auto further = [&](double passes) {
      Node piece = whole;
      piece.count = number(passes);
      return made(like, std::move(piece));
    };
    const double first = nested ? std::fmod(*n - 1, most) + 1 : most;
    node.count = number(first);
    Body pieces{std::move(s)};
    if (nested) {
      pieces.push_back(further(most));
      Repeat of_it;
      of_it.first = of_it.last = label_on(pieces.back());
      of_it.count = number((*n - first) / most - 1);
      put_counted<Repeat>(made(like, std::move(of_it)), pieces);
    } else {
      for (double left = *n - most; left > 0; left -= most) pieces.push_back(further(std::min(left, most)));
    }
    editor_.put_group(out, std::move(pieces), 0);
  }

  /// A repetition can be repeated, wherever it stands.
  [[nodiscard]] bool repeats_repeats() const { return target_.repeat_range && !target_.repeat_ends_here; }

  /// The source may count further than the target.
  void tell_limit(const Statement& s) {
    constexpr std::int64_t usual = 9999;
    if (limit_told_ || target_.repeat_max >= usual || editor_.program.dialect == target_.dialect) return;
    limit_told_ = true;
    editor_.context.diagnostics.warning("TRN-692", s.line.span,
                                        "how often this is carried out is computed, and the target counts to " +
                                            std::to_string(target_.repeat_max) + " only (said once a program)",
                                        "make sure that it is never more, or write a loop");
  }

  /// A count that only the run knows may be 0: the targets' counts begin with 1. Counts are rounded: 0.5 is 1.
  template <class Node>
  void put_guarded(Statement&& s, Body& out) {
    ExprPtr& count = std::get<Node>(s.node).count;
    const bool whole = ir::is_whole(count);
    const LineInfo like = s.line;
    const LabelRef end = editor_.fresh_label();
    Body pieces;
    if (as_variable(count) == nullptr) {  // computed once, for both
      const auto t = editor_.take(like);
      if (t) {
        pieces.push_back(make_assign(like, *t, count));
        count = variable(*t, Type::integer);
      }
    }
    pieces.push_back(make_jump(like, end, binary(BinaryOp::lt, count, number(whole ? 1 : 0.5))));
    pieces.push_back(std::move(s));
    pieces.push_back(make_label(like, end, editor_.program));
    const std::size_t main = pieces.size() - 2;
    editor_.put_group(out, std::move(pieces), main);
  }

  /// The part ends just before the statement: the block there gets a label.
  bool end_before(Repeat& r, Body& out) {
    if (out.empty()) return false;
    Statement& last = out.back();
    const auto have = labels_on(last.line);
    const auto fitting = std::find_if(have.begin(), have.end(), [this](const LabelRef& l) {
      return l.is_number ? !target_.repeat_needs_identifiers : target_.identifier_labels;
    });
    if (fitting != have.end()) {
      r.last = *fitting;
      return true;
    }
    const LabelRef fresh = editor_.fresh_label();
    if (last.line.joined || !last.line.number.empty())
      out.push_back(make_label(last.line, fresh, editor_.program));
    else
      set_label(last.line, fresh, editor_.program);
    r.last = fresh;
    return true;
  }

  void check_count(const Statement& s, const ExprPtr& count) {
    const auto n = constant_value(count);
    if (count && n && *n > static_cast<double>(target_.repeat_max)) {
      editor_.context.diagnostics.error("TRN-198", s.line.span,
                                        "the target repeats at most " + std::to_string(target_.repeat_max) + " times",
                                        "use a loop");
    }
  }

  /// `count` calls: a label on the call and a repetition of it, or a counting loop.
  void call(Statement&& s, Body& out) {
    auto& c = std::get<CallRoutine>(s.node);
    if (c.has_range && !target_.call_range) {
      if (!target_.repeat_other_program) {
        refused(s, "TRN-195", "a part of another program is called: the target can't", "make the part a subprogram");
      } else {
        Repeat r;
        r.first = c.first;
        r.last = c.last;
        r.count = c.count;
        r.has_program = true;
        r.program = c.routine;
        s.node = std::move(r);
      }
      out.push_back(std::move(s));
      return;
    }
    const bool once = c.has_range && names_parts_by_texts(target_) && editor_.program.dialect != target_.dialect;
    if (!c.count || (target_.call_count && !once)) {
      return put_counted<CallRoutine>(std::move(s), out);
    }
    const ExprPtr count = std::exchange(c.count, nullptr);
    const auto n = constant_value(count);
    const LineInfo like = s.line;
    if (n && *n <= 0) {
      s.node = Label{};
      out.push_back(std::move(s));
      return;
    }
    if (n && target_.repeat_range && !s.line.joined) {
      const LabelRef label = label_on(s);
      out.push_back(std::move(s));
      if (*n < 2) return;
      Repeat r;
      r.first = label;
      if (!target_.repeat_ends_here) r.last = label;
      r.count = number(*n - 1);
      out.push_back(made(like, std::move(r)));
      return;
    }
    counted(std::move(s), count, out);
  }

  LabelRef label_on(Statement& s) {
    for (const auto& l : labels_on(s.line)) {
      const bool fits = l.is_number ? !target_.repeat_needs_identifiers : target_.identifier_labels;
      if (fits && carriers_[{l.is_number, l.text}] == 1) return l;
    }
    const LabelRef fresh = editor_.fresh_label();
    set_label(s.line, fresh, editor_.program);
    return fresh;
  }

  /// t = n; again: IF t <= 0 GOTO end; statement; t = t - 1; GOTO again; end: (t < 0.5 where n may have a fraction,
  /// which the control rounds)
  void counted(Statement&& s, const ExprPtr& count, Body& out) {
    const auto t = editor_.take(s.line);  // stays taken: the loop runs over it
    if (!t) {
      out.push_back(std::move(s));
      return;
    }
    const LineInfo like = s.line;
    const LabelRef again = editor_.fresh_label(), end = editor_.fresh_label();
    Body pieces;
    pieces.push_back(make_assign(like, *t, count));
    const ExprPtr none_left = ir::is_whole(count) ? binary(BinaryOp::le, variable(*t), number(0))
                                                  : binary(BinaryOp::lt, variable(*t), number(0.5));
    Statement test = make_jump(like, end, none_left);
    set_label(test.line, again, editor_.program);
    pieces.push_back(std::move(test));
    pieces.push_back(std::move(s));
    pieces.push_back(make_assign(like, *t, binary(BinaryOp::subtract, variable(*t), number(1))));
    pieces.push_back(make_jump(like, again));
    pieces.push_back(make_label(like, end, editor_.program));
    editor_.put_group(out, std::move(pieces), 2);
  }

  /// t = n; again: block; t = t - 1; IF t is 1 or more GOTO again
  void looped(Statement&& s, const ExprPtr& count, Body& out) {
    const auto t = editor_.take(s.line);  // stays taken: the loop runs over it
    if (!t) {
      out.push_back(std::move(s));
      return;
    }
    const LineInfo like = s.line;
    const LabelRef again = editor_.fresh_label();
    Body pieces;
    pieces.push_back(make_assign(like, *t, count));
    move_head(s.line, pieces.front().line);
    s.line.joined = false;
    set_label(s.line, again, editor_.program);
    pieces.push_back(std::move(s));
    pieces.push_back(make_assign(like, *t, binary(BinaryOp::subtract, variable(*t), number(1))));
    pieces.push_back(make_jump(like, again, binary(BinaryOp::ge, variable(*t), number(0.5))));
    editor_.put_group(out, std::move(pieces), 0);
  }

  static bool defines_cycle(const Block& b) {
    return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
      const auto* d = std::get_if<CycleDefine>(&a.data);
      return d != nullptr && d->modal;
    });
  }

  void block(Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    if (b.repeat.is(0) && cycles_) return out.push_back(std::move(s));  // the cycles pass sees it
    const Value repeat = b.repeat;
    b.repeat_given = 0;
    b.repeat = Value{};
    const LineInfo place = s.line;
    if (defines_cycle(b) && !repeat.is(0)) {  // once: the further passes are points of it
      Block further = b;
      std::erase_if(further.actions, [](const Action& a) { return std::holds_alternative<CycleDefine>(a.data); });
      further.repeat_given = 1;
      further.repeat =
          repeat.literal() ? Value(repeat.number - 1) : Value(binary(BinaryOp::subtract, repeat.expr, number(1)));
      out.push_back(std::move(s));
      if (!further.repeat.is(0)) block(made(place, std::move(further)), out);
      return;
    }
    if (!repeat.literal()) return looped(std::move(s), repeat.expr, out);  // not 0: see branch_block_counts
    const double n = repeat.number;
    if (n == 0) {  // the move without the cycle that it would run
      refused(s, "TRN-199", "a block that only positions and leaves the active cycle out: the target has none",
              "cancel the cycle before the block");
      out.push_back(std::move(s));
      return;
    }
    // Each point about a pole follows from the one before: in a loop it would be no number.
    const bool polar = b.motion.extra && (b.motion.extra->has_polar_angle || b.motion.extra->has_polar_radius);
    const double most_copies = polar ? 72 : 5;
    if (n > most_copies) return looped(std::move(s), number(n), out);
    const LineInfo like = s.line;
    const Block copy = b;
    Body pieces;
    pieces.push_back(std::move(s));
    for (double i = 1; i < n; ++i) pieces.push_back(made(like, copy));
    editor_.put_group(out, std::move(pieces), 0);
  }

  Editor& editor_;
  const Capabilities& target_;
  const HeadConstants& constants_;
  const bool cycles_;  ///< the program has canned cycles: the cycles pass sees to their blocks
  bool& limit_told_;
  std::map<std::pair<bool, std::string>, int> carriers_;  ///< lines that carry a label
};

}  // namespace

void lower_repeats(Program& program, const LegaliseContext& context) {
  const HeadConstants constants(program);
  bool limit_told = false;
  for (auto& r : program.routines) {
    Editor editor(program, r, context);
    RepeatPass(editor, constants, limit_told).run();
  }
}

}  // namespace cnctrans::ir::passes
