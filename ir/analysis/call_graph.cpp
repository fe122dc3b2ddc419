#include "ir/analysis/call_graph.h"

#include <algorithm>
#include <functional>

namespace cnctrans::ir::passes {

CallGraph::CallGraph(const Program& program) : program_(program) {
  for (std::size_t r = 0; r < program.routines.size(); ++r) {
    for_each_statement(program.routines[r].body, [&](const Statement& s) {
      if (const auto* c = std::get_if<CallRoutine>(&s.node)) {
        add(r, s, *c);
      } else if (const auto* m = std::get_if<ModalCall>(&s.node); m != nullptr && !m->off && !m->cycle) {
        add(r, s, m->call);
      } else if (const auto* rep = std::get_if<Repeat>(&s.node); rep != nullptr && rep->has_program) {
        sites_.push_back({r, index_of(rep->program), CallLevel::shared, &s});
      }
    });
  }
  for (std::size_t i = 0; i < sites_.size(); ++i) first_of_.try_emplace(sites_[i].statement, i);
}

std::span<const CallSite> CallGraph::sites_of(const Statement& s) const {
  const auto found = first_of_.find(&s);
  if (found == first_of_.end()) return {};
  std::size_t end = found->second;
  while (end < sites_.size() && sites_[end].statement == &s) ++end;
  return {sites_.data() + found->second, end - found->second};
}

void CallGraph::add(std::size_t caller, const Statement& s, const CallRoutine& call) {
  if (call.computed) {  // any subprogram may be meant
    for (std::size_t i = 0; i < program_.routines.size(); ++i) {
      if (program_.routines[i].kind == RoutineKind::sub) sites_.push_back({caller, i, call.level, &s});
    }
    return;
  }
  sites_.push_back({caller, index_of(call.routine), call.level, &s});
}

std::set<std::size_t> CallGraph::sharing_level(std::size_t routine) const {
  std::set<std::size_t> found{routine};
  for (std::size_t before = 0; before != found.size();) {
    before = found.size();
    for (const auto& site : sites_) {
      if (site.callee && site.level == CallLevel::shared && found.count(site.caller) != 0) found.insert(*site.callee);
    }
  }
  return found;
}

std::optional<std::size_t> CallGraph::index_of(const RoutineName& name) const {
  const Routine* r = program_.find(name);
  if (r == nullptr) return std::nullopt;
  return static_cast<std::size_t>(r - program_.routines.data());
}

bool CallGraph::called_with(std::size_t routine, CallLevel level) const {
  return std::any_of(sites_.begin(), sites_.end(),
                     [&](const CallSite& s) { return s.callee == routine && s.level == level; });
}
bool CallGraph::called(std::size_t routine) const {
  return std::any_of(sites_.begin(), sites_.end(), [&](const CallSite& s) { return s.callee == routine; });
}

const CallSite* CallGraph::recursion() const {
  enum class Mark : std::uint8_t { fresh, open, done };
  std::vector<Mark> marks(program_.routines.size(), Mark::fresh);
  const CallSite* found = nullptr;
  const std::function<void(std::size_t)> visit = [&](std::size_t r) {
    marks[r] = Mark::open;
    for (const auto& s : sites_) {
      if (s.caller != r || !s.callee || found != nullptr) continue;
      if (marks[*s.callee] == Mark::open)
        found = &s;
      else if (marks[*s.callee] == Mark::fresh)
        visit(*s.callee);
    }
    marks[r] = Mark::done;
  };
  for (std::size_t r = 0; r < marks.size() && found == nullptr; ++r) {
    if (marks[r] == Mark::fresh) visit(r);
  }
  return found;
}

ReadFirst::ReadFirst(const Program& program, const CallGraph& calls, bool follows_new_level)
    : program_(program), calls_(calls), follows_new_level_(follows_new_level) {}

namespace {

std::string name_of(const VarRef& v) {
  return std::to_string(v.space) + ":" + v.name;
}
std::string with_index(const VarRef& v) {
  const auto n = v.index ? constant_index(v) : std::nullopt;
  return name_of(v) + "#" + (n ? std::to_string(*n) : "?");
}

}  // namespace

const ReadFirst::OfRoutine& ReadFirst::of(std::size_t routine) {
  const auto [it, fresh] = routines_.try_emplace(routine);
  if (!fresh) return it->second;
  auto& [flow, names] = it->second;
  flow = control_flow(program_, program_.routines[routine]);
  const auto note = [&names = names](const VarRef& v) {
    names.insert(name_of(v));
    names.insert(with_index(v));
  };
  const std::function<void(const ExprPtr&)> notes = [&note](const ExprPtr& e) {
    walk(e, [&note](const ExprPtr& x) {
      if (const auto* v = as_variable(x)) note(*v);
    });
  };
  for_each_statement(program_.routines[routine].body, [&](const Statement& s) {
    each_expression(s, notes);
    each_target(s, note);
    if (const auto* d = std::get_if<Declare>(&s.node)) {
      for (const auto& item : d->items) note(VarRef{d->space, item.name, nullptr, {}});
    }
  });
  return it->second;
}

bool ReadFirst::operator()(std::size_t routine, const VarRef& v) {
  return search(routine, v, v.index && constant_index(v) ? with_index(v) : name_of(v)).reads;
}

bool ReadFirst::statement_reads(const Statement& s, const VarRef& v, bool& written) const {
  if (const auto* a = std::get_if<Assign>(&s.node)) {
    for (const auto& item : a->items) {
      if (reads(item.value, v)) return true;
      if (item.to_system) continue;
      if (same_variable(item.target, v)) written = true;
      if (written) return false;
      if (reads(item.target.index, v)) return true;
      for (const auto& i : item.target.indices) {
        if (reads(i, v)) return true;
      }
    }
    return false;
  }
  if (const auto* d = std::get_if<Declare>(&s.node); d != nullptr && d->space == v.space) {
    written = std::any_of(d->items.begin(), d->items.end(), [&](const Declare::Item& i) {
      return !v.name.empty() && i.name == v.name && !i.initial.empty() && i.dimensions.empty();
    });
  }
  bool found = false;
  each_expression(s, [&](const ExprPtr& e) { found = found || reads(e, v); });
  if (const auto* f = std::get_if<For>(&s.node); f != nullptr && !found && same_variable(f->counter, v)) written = true;
  return found;
}

namespace {
/// The whole of one routine runs, at least once.
bool certain_call(const Statement& s) {
  const auto* c = std::get_if<CallRoutine>(&s.node);
  if (c == nullptr || c->computed || c->has_range) return false;
  const auto count = c->count ? constant_value(c->count) : std::optional(1.0);
  return count && *count >= 1;
}
}  // namespace

ReadFirst::Seen ReadFirst::search(std::size_t routine, const VarRef& v, const std::string& key) {
  auto [it, fresh] = memo_.try_emplace({routine, key});
  if (!fresh) return it->second;
  const auto& [cf, names] = of(routine);
  const bool named = names.count(key) != 0 || names.count(name_of(v) + "#?") != 0;
  Seen found{false, program_.routines[routine].body.empty()};
  std::vector<bool> seen(cf.statements.size(), false);
  std::vector<std::uint32_t> open;
  if (!program_.routines[routine].body.empty()) open.push_back(program_.routines[routine].body.front().id);
  while (!open.empty() && !found.reads) {
    const auto id = open.back();
    open.pop_back();
    if (id >= cf.statements.size() || seen[id] || cf.statements[id] == nullptr) continue;
    seen[id] = true;
    const Statement& s = *cf.statements[id];
    bool written = false;
    found.reads = named && statement_reads(s, v, written);
    for (const auto& site : calls_.sites_of(s)) {
      if (found.reads || !site.callee) continue;
      if (site.level == CallLevel::new_level && !follows_new_level_) continue;
      if (const auto* c = std::get_if<CallRoutine>(&s.node); c != nullptr && c->has_range) {  // entered somewhere
        for_each_statement(program_.routines[*site.callee].body, [&](const Statement& inner) {
          bool own = false;
          found.reads = found.reads || statement_reads(inner, v, own);
        });
        continue;
      }
      const Seen callee = search(*site.callee, v, key);
      found.reads = callee.reads;
      written = written || (certain_call(s) && !callee.passes);
    }
    if (found.reads || (written && s.line.skip_mask == 0)) continue;
    const auto* end = std::get_if<End>(&s.node);
    for (const auto next : cf.successors[id]) {
      if (next != 0)
        open.push_back(next);
      else
        found.passes = found.passes || end == nullptr || end->returns_from_sub;
    }
  }
  return memo_[{routine, key}] = found;
}

namespace {
SpaceId named_space(Program& program, std::string_view prefix, Scope scope) {
  const SpaceId id = program.space(prefix);
  if (id != program.spaces.size()) return id;
  VariableSpace s;
  s.prefix = std::string(prefix);
  s.scope = scope;
  s.starts_at_zero = true;
  program.spaces.push_back(std::move(s));
  return id;
}
}  // namespace

SpaceId frame_space(Program& program) {
  return named_space(program, frame_prefix, Scope::global);
}
SpaceId level_space(Program& program) {
  return named_space(program, level_prefix, Scope::level);
}

const SpaceSegment* segment_of(const Program& program, const VarRef& v) {
  if (v.space >= program.spaces.size() || !v.index) return nullptr;
  const auto n = constant_index(v);
  if (!n) return nullptr;
  for (const auto& s : program.spaces[v.space].segments) {
    if (*n >= s.lo && *n <= s.hi) return &s;
  }
  return nullptr;
}

std::string routine_tag(const Routine& r) {
  if (r.kind == RoutineKind::main) return "0";
  if (r.name.number >= 0) return std::to_string(r.name.number);
  return r.name.text;
}

}  // namespace cnctrans::ir::passes
