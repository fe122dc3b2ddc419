// A work offset that is written while it is in force counts from its next selection on in the source, and at once on
// the target: where the program moves in between, the writing goes down to the selection; its value is taken where it
// stood.
#include <algorithm>
#include <set>

#include "base/saturate.h"
#include "ir/analysis/flow_states.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

bool is_offset(const Assign::Item& item) {
  return item.to_system && item.system.datum == Datum::work_offset;
}
bool writes_offset(const Statement& s) {
  const auto* a = std::get_if<Assign>(&s.node);
  return a != nullptr && std::any_of(a->items.begin(), a->items.end(), is_offset);
}
bool selects(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && std::any_of(b->actions.begin(), b->actions.end(),
                                     [](const Action& a) { return std::holds_alternative<WorkOffset>(a.data); });
}
bool is_position(const SystemRef& ref) {
  return ref.datum == Datum::programmed_position || ref.datum == Datum::work_position ||
         ref.datum == Datum::active_shift;
}

/// A domain of FlowStates: the writings (ids of their statements) that the next selection is still to bring.
struct Waiting {
  using State = std::set<std::uint32_t>;
  std::set<std::uint32_t> writings;

  [[nodiscard]] static State start(const Routine& /*unused*/, bool /*unused*/) { return {}; }
  void transfer(const Statement& s, State& state) const {
    if (selects(s)) state.clear();
    if (writings.count(s.id) != 0) state.insert(s.id);
  }
  [[nodiscard]] bool touches(const Routine& r) const {
    bool found = false;
    for_each_statement(r.body, [&](const Statement& s) { found = found || selects(s) || writings.count(s.id) != 0; });
    return found;
  }
  static void unknown(State& /*state*/) {}
  static bool join(State& a, const State& b) {
    const std::size_t before = a.size();
    a.insert(b.begin(), b.end());
    return a.size() != before;
  }
};

/// A domain of FlowStates: the program has selected an offset, or switched them off, on every way. Before that each
/// control works with what its power-on has put in force.
struct Chosen {
  using State = bool;
  [[nodiscard]] static State start(const Routine& /*unused*/, bool /*unused*/) { return false; }
  static void transfer(const Statement& s, State& state) { state = state || selects(s); }
  [[nodiscard]] static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) { found = found || selects(s); });
    return found;
  }
  static void unknown(State& /*state*/) {}
  static bool join(State& a, const State& b) {
    const bool changed = a && !b;
    a = a && b;
    return changed;
  }
};

class HeldOffsets {
 public:
  HeldOffsets(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void run() {
    find_writings();
    if (domain_.writings.empty()) return;
    find_held();
    if (held_.empty()) return;
    for (auto& r : program_.routines) {
      Editor editor(program_, r, context_);
      uses_ = label_uses(program_, r);
      body(editor, r.body);
    }
  }

 private:
  /// Those of a row that is, or may be, in force.
  void find_writings() {
    const FactsOf facts(program_, context_);
    const Chosen domain;
    const FlowStates<Chosen> chosen(program_, domain);
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        if (!writes_offset(s)) return;
        auto in_force = facts.before(s).work_offset;
        const bool* by_program = chosen.before(s);
        if (in_force == 0 && by_program != nullptr && !*by_program)
          in_force = context_.target_machine.power_on.work_offset;
        for (const auto& item : std::get<Assign>(s.node).items) {
          if (!is_offset(item)) continue;
          const auto row = item.system.args.empty() ? std::nullopt : constant_value(item.system.args[0]);
          const bool other = in_force && row && saturate<std::int32_t>(*row) != *in_force;
          if (!other && in_force != 0) domain_.writings.insert(s.id);
        }
      });
    }
  }

  /// Those that a move, or the place of the tool as the program reads it, comes before the selection of.
  void find_held() {
    const FlowStates<Waiting> states(program_, domain_);
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        const auto* waiting = states.before(s);
        if (waiting == nullptr || waiting->empty() || !feels(s)) return;
        for (const auto id : *waiting) held_.insert(id);
      });
    }
  }
  static bool feels(const Statement& s) {
    bool reads = false;
    each_expression(s, [&reads](const ExprPtr& e) {
      walk(e, [&reads](const ExprPtr& x) {
        const auto* ref = std::get_if<SystemRef>(&x->node);
        reads = reads || (ref != nullptr && is_position(*ref));
      });
    });
    if (reads) return true;
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr || selects(s)) return false;
    return (b->has_motion && b->motion.moves()) ||
           std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
             return std::holds_alternative<CycleDefine>(a.data) || std::holds_alternative<OpaqueWord>(a.data);
           });
  }

  void body(Editor& editor, Body& list) {
    for (auto& s : list) each_body(s, [&](Body& inner) { body(editor, inner); });
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (held_.erase(list[i].id) == 0) continue;
      auto to = selection(list, i);
      if (to) to = before_later_writing(list, i, *to);
      if (to && hold(editor, list, i, *to)) --i;  // the next one stands here now
      if (!to) refused(list[i]);
    }
  }

  /// What is written behind it and stays in its place, moving nothing from there on, stays behind it.
  [[nodiscard]] std::size_t before_later_writing(const Body& list, std::size_t from, std::size_t to) const {
    for (std::size_t i = from + 1; i < to; ++i) {
      if (list[i].id != 0 && writes_offset(list[i]) && held_.count(list[i].id) == 0) return i;
    }
    return to;
  }

  /// The selection behind the writing, or the end of the program, that every way from it passes, none other leading
  /// there; none: there is no such.
  std::optional<std::size_t> selection(const Body& list, std::size_t from) const {
    const std::uint16_t skip = list[from].line.skip_mask;
    for (const auto& l : labels_on(list[from].line)) {
      if (uses_.is_end(l)) return std::nullopt;
    }
    for (std::size_t i = from + 1; i < list.size(); ++i) {
      const Statement& s = list[i];
      for (const auto& l : labels_on(s.line)) {
        if (uses_.is_target(l) || uses_.is_end(l)) return std::nullopt;
      }
      const auto* end = std::get_if<End>(&s.node);
      if (selects(s) || (end != nullptr && !end->returns_from_sub))
        return s.line.skip_mask == 0 ? std::optional(i) : std::nullopt;
      const bool straight = std::holds_alternative<Block>(s.node) || std::holds_alternative<Assign>(s.node) ||
                            std::holds_alternative<Label>(s.node) || std::holds_alternative<Message>(s.node);
      if (!straight || (writes_offset(s) && s.line.skip_mask != skip) || reads_offset(s)) return std::nullopt;
    }
    return std::nullopt;
  }
  static bool reads_offset(const Statement& s) {
    bool reads = false;
    each_expression(s, [&reads](const ExprPtr& e) {
      walk(e, [&reads](const ExprPtr& x) {
        const auto* ref = std::get_if<SystemRef>(&x->node);
        reads = reads || (ref != nullptr && ref->datum == Datum::work_offset);
      });
    });
    return reads;
  }

  /// True: nothing is left where it stood.
  bool hold(Editor& editor, Body& list, std::size_t from, std::size_t to) {
    Statement& s = list[from];
    Assign late;
    auto& items = std::get<Assign>(s.node).items;
    for (std::size_t k = 0; k < items.size();) {
      if (!is_offset(items[k])) {
        ++k;
        continue;
      }
      late.items.push_back(items[k]);
      Assign::Item& item = late.items.back();
      if (constant_value(item.value)) {
        items.erase(items.begin() + static_cast<std::ptrdiff_t>(k));
        continue;
      }
      const auto kept = editor.take(s.line);  // stays taken: it is read further down
      if (!kept) return false;
      items[k].to_system = false;
      items[k].system = {};
      items[k].target = *kept;
      item.value = variable(*kept, item.value->type);
      ++k;
    }
    Statement written = made(s.line, std::move(late));
    written.line.skip_mask = s.line.skip_mask;
    if (items.empty()) s.node = Label{};
    list[to].line.joined = false;
    move_head(list[to].line, written.line);
    list.insert(list.begin() + static_cast<std::ptrdiff_t>(to), std::move(written));
    return drop_empty(list, from);
  }
  static bool drop_empty(Body& list, std::size_t at) {
    const LineInfo& line = list[at].line;
    if (!std::holds_alternative<Label>(list[at].node) || !line.number.empty() || !line.labels.empty() ||
        !line.comments.empty() || (at + 1 < list.size() && list[at + 1].line.joined))
      return false;
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(at));
    return true;
  }

  void refused(const Statement& s) const {
    context_.diagnostics.error("TRN-530", s.line.span,
                               "a work offset is written while it is in force: it counts from its next selection on in "
                               "the source and at once in the target, and a move stands before that selection",
                               "select the offset right behind the writing, or switch it off before it");
  }

  Program& program_;
  const LegaliseContext& context_;
  Waiting domain_;
  std::set<std::uint32_t> held_;
  LabelUses uses_;
};

}  // namespace

void hold_written_offsets(Program& program, const LegaliseContext& context) {
  number_statements(program);
  HeldOffsets(program, context).run();
}

}  // namespace cnctrans::ir::passes
