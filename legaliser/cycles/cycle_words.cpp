// A control reads the words of a cycle once, in the block that defines it. Where the target's cycle is written once
// more behind that place (another plane, F between two calls, G79), or each point is written out, the words must be
// what they were: those that read changed variables are kept in variables of their own at the definition.
#include "legaliser/cycles/cycle_words.h"

#include <algorithm>
#include <utility>

#include "ir/analysis/domains/kept_values.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

constexpr int most_word_rounds = 4;  ///< a kept word may bring another one to light

const CyclePtr* defined_by(const Statement& s) {
  if (const auto* m = std::get_if<ModalCall>(&s.node)) return !m->off && m->cycle ? &m->cycle : nullptr;
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr) return nullptr;
  for (const auto& a : b->actions) {
    if (const auto* d = std::get_if<CycleDefine>(&a.data); d != nullptr && d->modal) return &d->cycle;
  }
  return nullptr;
}

void define_by(Statement& s, CyclePtr cycle) {
  if (auto* m = std::get_if<ModalCall>(&s.node)) {
    m->cycle = std::move(cycle);
    return;
  }
  for (auto& a : std::get<Block>(s.node).actions) {
    if (auto* d = std::get_if<CycleDefine>(&a.data); d != nullptr && d->modal) {
      d->cycle = std::move(cycle);
      return;
    }
  }
}

/// Some word of a modal cycle reads a variable that the program writes.
bool words_may_change(const Program& program) {
  const Writes writes(program);
  if (writes.all().empty()) return false;
  bool found = false;
  for (std::size_t r = 0; r < program.routines.size(); ++r) {
    for_each_statement(program.routines[r].body, [&](const Statement& s) {
      const auto* cycle = defined_by(s);
      if (cycle == nullptr || found) return;
      Cycle copy = **cycle;
      bool changed = false;
      visit_values(
          copy,
          [&](Value& v, const Place&) {
            if (!v.literal())
              found = found || std::any_of(writes.all().begin(), writes.all().end(),
                                           [&](const auto& w) { return writes.touches(w, v.expr, r); });
            return false;
          },
          changed);
    });
  }
  return found;
}

/// One definition: the words that read one of the variables.
class Keeper {
 public:
  Keeper(Editor& editor, const LegaliseContext& context, const std::vector<VarRef>& changed)
      : editor_(editor), context_(context), changed_(changed) {}

  Body keep(Statement& s) {
    Body before;
    const auto* cycle = defined_by(s);
    if (cycle == nullptr) return before;
    auto copy = std::make_shared<Cycle>(**cycle);
    bool any = false;
    visit_values(
        *copy, [&](Value& v, const Place&) { return word(v, s.line, before); }, any);
    if (before.empty()) return before;
    define_by(s, std::move(copy));
    context_.diagnostics.note("TRN-601", s.line.span,
                              "variables that the words of this cycle read change while it is in force: the words are "
                              "kept in " +
                                  names_ + " as they are here");
    return before;
  }

 private:
  bool word(Value& v, const LineInfo& line, Body& before) {
    if (v.literal() ||
        std::none_of(changed_.begin(), changed_.end(), [&v](const VarRef& c) { return reads(v.expr, c); }))
      return false;
    for (const auto& [expr, kept] : kept_) {
      if (!equal(expr, v.expr)) continue;
      v.expr = variable(kept, v.expr->type);
      return true;
    }
    const auto kept = editor_.take(line);
    if (!kept) return false;
    before.push_back(make_assign(line, *kept, v.expr));
    kept_.emplace_back(v.expr, *kept);
    const std::string name = target_name(*kept);
    names_ += (names_.empty() ? "" : ", ") + name;
    if (context_.report != nullptr)
      context_.report->renamed.push_back(
          {Renamed::Kind::variable, "word of the cycle in line " + std::to_string(line.span.line), name, {}});
    v.expr = variable(*kept, v.expr->type);
    return true;
  }
  [[nodiscard]] std::string target_name(const VarRef& v) const {
    if (!v.name.empty()) return v.name;
    const auto n = constant_index(v);
    return editor_.program.spaces[v.space].prefix + (n ? std::to_string(*n) : std::string{});
  }

  Editor& editor_;
  const LegaliseContext& context_;
  const std::vector<VarRef>& changed_;
  std::vector<std::pair<ExprPtr, VarRef>> kept_;
  std::string names_;
};

}  // namespace

void keep_cycle_words(Program& program, const LegaliseContext& context,
                      const std::function<void(Program&, const LegaliseContext&, StaleWords*)>& carry_out) {
  if (!words_may_change(program)) return;
  for (int round = 0; round < most_word_rounds; ++round) {
    number_statements(program);
    Program trial = program;
    Diagnostics said;
    const LegaliseContext quiet{context.target, context.source_machine, context.target_machine, context.options, said,
                                nullptr,        context.source_numbers, context.names};
    StaleWords stale;
    carry_out(trial, quiet, &stale);
    bool changed = false;
    for (auto& r : program.routines) {
      if (stale.found.empty()) return;
      Editor editor(program, r, context);
      rewrite_body(r.body, [&](Statement&& s, Body& to) {
        const auto at = stale.found.find(s.id);
        Body before;
        if (s.id != 0 && at != stale.found.end()) before = Keeper(editor, context, at->second).keep(s);
        if (before.empty()) return to.push_back(std::move(s));
        changed = true;
        editor.put(to, std::move(before), std::move(s));
      });
    }
    if (!changed) return;
  }
}

}  // namespace cnctrans::ir::passes
