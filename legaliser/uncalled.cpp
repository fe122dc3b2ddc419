#include "legaliser/uncalled.h"

#include <set>

#include "ir/analysis/call_graph.h"
#include "ir/text/enum_names.h"

namespace cnctrans::ir::passes {

std::vector<std::size_t> uncalled_routines(const Program& program) {
  const CallGraph calls(program);
  std::set<std::size_t> whole;  // a call of a part leaves the rest to callers that are not at hand
  for (const auto& site : calls.sites()) {
    const auto* c = std::get_if<CallRoutine>(&site.statement->node);
    if (site.callee && !(c != nullptr && c->has_range)) whole.insert(*site.callee);
  }
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < program.routines.size(); ++i) {
    if (program.routines[i].kind == RoutineKind::sub && whole.count(i) == 0) list.push_back(i);
  }
  return list;
}

void tell_assumed_state(const Program& program, const LegaliseContext& context) {
  const ModalState& state = context.source_machine.power_on;
  std::string text = std::string(name(state.motion)) + " motion, " + std::string(name(state.distance)) +
                     " positions, plane " + std::string(name(state.plane)) + ", " + std::string(name(state.units)) +
                     " units, feed " + std::string(name(state.feed_mode));
  if (program.lathe) text += ", X as " + std::string(name(state.diameter));
  for (const auto i : uncalled_routines(program)) {
    const Routine& r = program.routines[i];
    Span where = r.header.span;
    for (auto s = r.body.begin(); s != r.body.end() && !where.known(); ++s) where = s->line.span;
    context.diagnostics.warning(
        "TRN-460", where,
        "nothing at hand calls the subprogram " + routine_tag(r) +
            ", and its translation depends on its caller: it is written for a call in the state of power-on (" + text +
            ", no radius compensation, no frame, no cycle) and right for such a call only",
        "translate it together with the program that calls it (--lib), or set what it needs in its first block");
  }
}

}  // namespace cnctrans::ir::passes
