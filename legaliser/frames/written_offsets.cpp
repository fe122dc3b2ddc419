// Work offsets that the program writes: on one control the new value counts at once, on another from the next time that
// the offset is selected.
#include <algorithm>

#include "base/saturate.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

/// The row that the statement writes; -1: the one in force; none: it writes no offset. `several`: more than one row.
std::optional<std::int32_t> written_row(const Statement& s, bool& several) {
  const auto* a = std::get_if<Assign>(&s.node);
  std::optional<std::int32_t> row;
  for (std::size_t i = 0; a != nullptr && i < a->items.size(); ++i) {
    const auto& item = a->items[i];
    if (!item.to_system || item.system.datum != Datum::work_offset) continue;
    const auto n = item.system.args.empty() ? std::optional(-1.0) : constant_value(item.system.args[0]);
    const std::int32_t here = n ? saturate<std::int32_t>(*n) : -2;
    several = several || (row && *row != here) || here == -2;
    row = here;
  }
  return row;
}

/// The next statement writes the same row, and nothing leads to it or reads the machine before.
bool goes_on(const Statement& next, std::int32_t row, const LabelUses& uses) {
  bool several = false;
  const auto there = written_row(next, several);
  if (!there || *there != row || several || next.line.skip_mask != 0) return false;
  if (!next.line.number.empty() && (uses.computed || uses.is_target({std::string(next.line.number), true, nullptr}) ||
                                    uses.is_end({std::string(next.line.number), true, nullptr})))
    return false;
  bool reads_machine = false;
  for (const auto& item : std::get<Assign>(next.node).items) {
    walk(item.value, [&](const ExprPtr& e) {
      const auto* ref = std::get_if<SystemRef>(&e->node);
      reads_machine = reads_machine || (ref != nullptr && ref->datum != Datum::work_offset);
    });
  }
  return !reads_machine;
}

class Pass {
 public:
  Pass(Program& program, const LegaliseContext& context)
      : program_(program), context_(context), facts_(program, context) {}

  void routine(Routine& r) {
    Editor editor(program_, r, context_);
    uses_ = label_uses(program_, r);
    body(editor, r.body);
  }

 private:
  void body(Editor& editor, Body& list) {
    Body out;
    for (std::size_t i = 0; i < list.size(); ++i) {
      Statement& s = list[i];
      nested(editor, s);
      bool several = false;
      const auto row = written_row(s, several);
      if (!row || (i + 1 < list.size() && goes_on(list[i + 1], *row, uses_) && !several && s.line.skip_mask == 0)) {
        out.push_back(std::move(s));
        continue;
      }
      const Facts facts = facts_.before(s);
      const LineInfo like = s.line;
      Body pieces;
      pieces.push_back(std::move(s));
      if (!facts.work_offset || several) {
        context_.diagnostics.error("TRN-185", like.span,
                                   "a work offset is written and counts at once in the source, from its next selection "
                                   "on in the target: which one is in force here is not known",
                                   "select the offset in the same part of the program, before it is written");
      } else if (*facts.work_offset != 0 && (*row == -1 || *row == *facts.work_offset)) {
        pieces.push_back(make_block(like, action(WorkOffset{Value(double(*facts.work_offset)), false})));
      }
      editor.put_group(out, std::move(pieces), 0);
    }
    list = std::move(out);
  }

  void nested(Editor& editor, Statement& s) {
    if (auto* i = std::get_if<If>(&s.node)) {
      body(editor, i->then_body);
      body(editor, i->else_body);
    } else if (auto* w = std::get_if<While>(&s.node)) {
      body(editor, w->body);
    } else if (auto* u = std::get_if<Until>(&s.node)) {
      body(editor, u->body);
    } else if (auto* f = std::get_if<For>(&s.node)) {
      body(editor, f->body);
    } else if (auto* l = std::get_if<Loop>(&s.node)) {
      body(editor, l->body);
    }
  }

  Program& program_;
  const LegaliseContext& context_;
  FactsOf facts_;
  LabelUses uses_;
};

}  // namespace

void select_written_offsets(Program& program, const LegaliseContext& context) {
  const auto at_once = [](const machine::Profile& m) {
    return m.policies.work_offset_write == machine::WorkOffsetWrite::at_once;
  };
  const bool from_once = at_once(context.source_machine), to_once = at_once(context.target_machine);
  if (to_once && !from_once) return hold_written_offsets(program, context);
  if (to_once || !from_once) return;
  Pass pass(program, context);
  for (auto& r : program.routines) pass.routine(r);
}

}  // namespace cnctrans::ir::passes
