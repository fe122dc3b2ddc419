// Work offsets that are switched off where nothing counts in them before another one is selected, or before the end:
// for a target that always has one.
#include <algorithm>
#include <set>

#include "ir/analysis/dataflow.h"
#include "ir/edit/search.h"
#include "legaliser/early_passes.h"

namespace cnctrans::ir::passes {

namespace {

bool is_off(const Action& a) {
  const auto* offset = std::get_if<WorkOffset>(&a.data);
  return offset != nullptr && offset->off;
}

enum class Meets : std::uint8_t { nothing, use, another };

/// What the block does from its action `first` on; its motion comes behind them.
Meets block_meets(const Block& b, std::size_t first) {
  for (std::size_t i = first; i < b.actions.size(); ++i) {
    const auto& data = b.actions[i].data;
    if (std::holds_alternative<WorkOffset>(data)) return Meets::another;
    if (std::holds_alternative<CycleDefine>(data) || std::holds_alternative<OpaqueWord>(data)) return Meets::use;
    const auto* frame = std::get_if<FrameOp>(&data);
    if (frame != nullptr && frame->change && frame->change->combine == FrameCombine::preset) return Meets::use;
  }
  return b.has_motion && b.motion.moves() && b.motion.frame == FrameUse::normal ? Meets::use : Meets::nothing;
}

Meets meets(const Statement& s) {
  bool reads = false;
  each_expression(s, [&reads](const ExprPtr& e) {
    walk(e, [&reads](const ExprPtr& x) { reads = reads || std::holds_alternative<SystemRef>(x->node); });
  });
  if (reads || std::holds_alternative<CallRoutine>(s.node) || std::holds_alternative<ModalCall>(s.node) ||
      std::holds_alternative<Repeat>(s.node))
    return Meets::use;
  const auto* kept = std::get_if<Opaque>(&s.node);
  if (kept != nullptr && !kept->harmless) return Meets::use;
  const auto* b = std::get_if<Block>(&s.node);
  const Meets found = b != nullptr ? block_meets(*b, 0) : Meets::nothing;
  return found == Meets::another && s.line.skip_mask != 0 ? Meets::nothing : found;
}

/// On some way something counts in the offset that holds behind the statement.
bool used_behind(const Statement& from, const Routine& routine, const ControlFlow& flow) {
  std::set<std::uint32_t> seen;
  std::vector<std::uint32_t> open(flow.successors[from.id].begin(), flow.successors[from.id].end());
  while (!open.empty()) {
    const std::uint32_t id = open.back();
    open.pop_back();
    if (!seen.insert(id).second) continue;
    if (id == 0) {
      if (routine.kind != RoutineKind::main) return true;  // its callers go on
      continue;
    }
    const Meets found = meets(*flow.statements[id]);
    if (found == Meets::use) return true;
    if (found == Meets::nothing) open.insert(open.end(), flow.successors[id].begin(), flow.successors[id].end());
  }
  return false;
}

}  // namespace

void drop_unused_offsets(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || context.target.work_offset_off || !any_action(program, is_off))
    return;
  number_statements(program);
  for (auto& r : program.routines) {
    const ControlFlow flow = control_flow(program, r);
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      const auto at = std::find_if(b->actions.begin(), b->actions.end(), is_off);
      if (at == b->actions.end()) return;
      const Meets here = block_meets(*b, static_cast<std::size_t>(at - b->actions.begin()) + 1);
      if (here == Meets::use || (here == Meets::nothing && used_behind(s, r, flow))) return;
      b->actions.erase(at);
    });
  }
}

}  // namespace cnctrans::ir::passes
