#include "legaliser/analysis/modal_needs.h"

#include <algorithm>

namespace cnctrans::ir::passes {

struct ModalNeeds::Search {
  ModalGroup group;
  std::vector<std::pair<std::size_t, std::uint32_t>> open{};
  std::set<std::pair<std::size_t, std::uint32_t>> seen{};
  std::set<std::size_t> left{};
  bool needed = false;
};

namespace {

bool sets_setting(const Block& b, Setting s) {
  return std::any_of(b.actions.begin(), b.actions.end(), [s](const Action& a) {
    const auto* m = std::get_if<ModalSet>(&a.data);
    return m != nullptr && m->setting == s && a.order != Order::after;
  });
}

bool sets_offset(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    return std::holds_alternative<WorkOffset>(a.data) && a.order != Order::after;
  });
}

/// What means different things in different modal states, or is not understood.
bool depends(const Action& a) {
  return std::holds_alternative<CycleDefine>(a.data) || std::holds_alternative<FrameOp>(a.data) ||
         std::holds_alternative<PoleSet>(a.data) || std::holds_alternative<SetFeed>(a.data) ||
         std::holds_alternative<SetSpindle>(a.data) || std::holds_alternative<SpindleRun>(a.data) ||
         std::holds_alternative<Corner>(a.data) || std::holds_alternative<TangentialEnd>(a.data) ||
         std::holds_alternative<OpaqueWord>(a.data) || std::holds_alternative<SplineAxes>(a.data) ||
         std::holds_alternative<SurfaceSet>(a.data);
}

bool runs_cycle(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(),
                     [](const Action& a) { return std::holds_alternative<CycleDefine>(a.data); });
}

bool reads_machine(const Statement& s) {
  bool found = false;
  each_expression(s, [&found](const ExprPtr& e) {
    walk(e, [&found](const ExprPtr& x) { found = found || std::holds_alternative<SystemRef>(x->node); });
  });
  return found;
}

}  // namespace

ModalNeeds::ModalNeeds(const Program& program, const CallGraph& calls) : program_(program), calls_(calls) {}

const ControlFlow& ModalNeeds::flow(std::size_t routine) {
  const auto it = flows_.find(routine);
  if (it != flows_.end()) return it->second;
  return flows_.emplace(routine, control_flow(program_, program_.routines[routine])).first->second;
}

ModalNeeds::Effect ModalNeeds::effect(const Block& b, const ModalGroup& group) {
  // A rapid has no feed, and the speed of a spindle counts in its own mode.
  const bool of_feed = group.kind == ModalGroup::Kind::setting && group.setting == Setting::feed_mode;
  const bool moves = b.has_motion && !(of_feed && b.motion.kind == MotionKind::rapid);
  const bool acts = moves || std::any_of(b.actions.begin(), b.actions.end(), [of_feed](const Action& a) {
                      const bool spindle =
                          std::holds_alternative<SetSpindle>(a.data) || std::holds_alternative<SpindleRun>(a.data);
                      return depends(a) && !(of_feed && spindle);
                    });
  switch (group.kind) {
    case ModalGroup::Kind::setting:
      if (sets_setting(b, group.setting)) return Effect::sets;
      return acts ? Effect::uses : Effect::none;
    case ModalGroup::Kind::offset:
      if (sets_offset(b)) return Effect::sets;
      return acts ? Effect::uses : Effect::none;
    case ModalGroup::Kind::motion: break;
  }
  if (b.has_motion && b.motion.kind == MotionKind::modal) return Effect::uses;
  if (b.has_motion && b.motion.keeps_modal) return Effect::sets;
  return runs_cycle(b) ? Effect::uses : Effect::none;
}

ModalNeeds::Effect ModalNeeds::effect(const Statement& s, const ModalGroup& group) const {
  if (reads_machine(s)) return Effect::uses;
  if (const auto* b = std::get_if<Block>(&s.node)) {
    const Effect e = effect(*b, group);
    return e == Effect::sets && s.line.skip_mask != 0 ? Effect::none : e;
  }
  if (const auto* o = std::get_if<Opaque>(&s.node)) return o->harmless ? Effect::none : Effect::uses;
  if (const auto* m = std::get_if<ModalCall>(&s.node)) return m->off ? Effect::none : Effect::uses;
  if (const auto* r = std::get_if<Repeat>(&s.node)) return r->has_program ? Effect::uses : Effect::none;
  if (const auto* r = std::get_if<Return>(&s.node)) return r->values.empty() ? Effect::none : Effect::uses;
  return Effect::none;
}

void ModalNeeds::behind_statement(std::size_t routine, const Statement& s, Search& search) {
  const auto& successors = flow(routine).successors;
  if (s.id >= successors.size()) return;
  for (const auto next : successors[s.id]) {
    if (next == 0)
      leave(routine, search);
    else
      search.open.emplace_back(routine, next);
  }
}

void ModalNeeds::enter(std::size_t routine, Search& search) {
  const auto& body = program_.routines[routine].body;
  if (body.empty())
    leave(routine, search);
  else
    search.open.emplace_back(routine, body.front().id);
}

/// The end of a routine: its callers go on, unless the state that they had comes back to them.
void ModalNeeds::leave(std::size_t routine, Search& search) {
  const Routine& r = program_.routines[routine];
  if (r.kind == RoutineKind::main || r.saves_modals || !search.left.insert(routine).second) return;
  search.needed = search.needed || !calls_.called(routine);
  for (const auto& site : calls_.sites()) {
    if (site.callee != routine) continue;
    if (std::holds_alternative<CallRoutine>(site.statement->node))
      behind_statement(site.caller, *site.statement, search);
    else
      search.needed = true;
  }
}

void ModalNeeds::step(std::size_t routine, const Statement& s, Search& search) {
  if (const auto* call = std::get_if<CallRoutine>(&s.node)) {
    const auto sites = calls_.sites_of(s);
    if (reads_machine(s) || call->has_range || call->computed || sites.empty() || !sites.front().callee) {
      search.needed = true;
      return;
    }
    enter(*sites.front().callee, search);
    const bool passed = program_.routines[*sites.front().callee].saves_modals || call->count || s.line.skip_mask != 0;
    if (passed) behind_statement(routine, s, search);
    return;
  }
  const Effect e = effect(s, search.group);
  search.needed = search.needed || e == Effect::uses;
  if (e == Effect::none) behind_statement(routine, s, search);
}

bool ModalNeeds::behind(const CallSite& site, const ModalGroup& group) {
  const auto* call = std::get_if<CallRoutine>(&site.statement->node);
  if (call == nullptr || call->has_range || call->computed) return true;
  Search search{group};
  if (call->count && site.callee) enter(*site.callee, search);
  behind_statement(site.caller, *site.statement, search);
  return runs_into_use(search);
}

bool ModalNeeds::behind(std::size_t routine, const Statement& s, const ModalGroup& group) {
  Search search{group};
  behind_statement(routine, s, search);
  return runs_into_use(search);
}

bool ModalNeeds::again(const CallSite& site, const ModalGroup& group) {
  if (!site.callee) return true;
  Search search{group};
  enter(*site.callee, search);
  return runs_into_use(search);
}

bool ModalNeeds::runs_into_use(Search& search) {
  while (!search.needed && !search.open.empty()) {
    const auto [routine, id] = search.open.back();
    search.open.pop_back();
    if (!search.seen.insert({routine, id}).second) continue;
    const auto& statements = flow(routine).statements;
    if (id < statements.size() && statements[id] != nullptr) step(routine, *statements[id], search);
  }
  return search.needed;
}

}  // namespace cnctrans::ir::passes
