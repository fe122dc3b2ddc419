// Call frames (equivalences 21.1): what the source says with levels of local parameters, with formal parameters or with
// shared variables is said in the target's way.
#include "legaliser/control/lower_calls.h"

#include <algorithm>

#include "legaliser/edit/editor.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

bool has_numbered_levels(const std::vector<VariableSpace>& spaces) {
  return std::any_of(spaces.begin(), spaces.end(), [](const VariableSpace& s) {
    return std::any_of(s.segments.begin(), s.segments.end(),
                       [](const SpaceSegment& g) { return g.scope == Scope::level; });
  });
}

bool has_named_locals(const std::vector<VariableSpace>& spaces) {
  return std::any_of(spaces.begin(), spaces.end(),
                     [](const VariableSpace& s) { return s.named() && s.scope == Scope::routine; });
}

VarRef frame_variable(Program& program, const std::string& name, const Routine& owner) {
  return VarRef{frame_space(program), name + "@" + routine_tag(owner), nullptr, {}};
}

Body assign_in_parallel(Program& program, const LineInfo& like, std::vector<std::pair<VarRef, ExprPtr>> items) {
  Body out;
  int copies = 0;
  std::erase_if(items, [](const auto& i) {
    const auto* v = as_variable(i.second);
    return v != nullptr && same_variable(*v, i.first);
  });
  while (!items.empty()) {
    const auto free = std::find_if(items.begin(), items.end(), [&](const auto& candidate) {
      return std::none_of(items.begin(), items.end(), [&](const auto& other) {
        return &other != &candidate && reads(other.second, candidate.first);
      });
    });
    if (free != items.end()) {
      out.push_back(make_assign(like, free->first, free->second));
      items.erase(free);
      continue;
    }
    VarRef copy{frame_space(program), "T" + std::to_string(++copies) + "@arguments", nullptr, {}};
    out.push_back(make_assign(like, copy, items.front().second));
    items.front().second = variable(copy);
  }
  return out;
}

void surround(Body& out, Body&& before, Statement&& call, Body&& behind) {
  if (!before.empty()) move_head(call.line, before.front().line);
  for (auto& s : before) out.push_back(std::move(s));
  out.push_back(std::move(call));
  for (auto& s : behind) out.push_back(std::move(s));
}

void declare_at_top(Routine& routine, Type type, SpaceId space, const std::vector<std::string>& names) {
  if (names.empty()) return;
  Declare d;
  d.type = type;
  d.space = space;
  for (const auto& n : names) {  // what two calls keep over themselves has one name
    const bool said = std::any_of(d.items.begin(), d.items.end(), [&n](const auto& item) { return item.name == n; });
    if (!said) d.items.push_back({n, {}, {}});
  }
  Statement s;
  s.node = std::move(d);
  routine.body.insert(below_head(routine.body), std::move(s));
}

namespace {

/// A part of the routine itself that is called is a repetition of it.
void repeat_own_parts(Program& program) {
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      const auto* c = std::get_if<CallRoutine>(&s.node);
      if (c == nullptr || !c->has_range || c->computed || c->tail || !c->arguments.empty() ||
          program.find(c->routine) != &r)
        return;
      Repeat part;
      part.first = c->first;
      part.last = c->last;
      part.count = c->count;
      s.node = std::move(part);
    });
  }
}

/// Some variable of the caller's level, or of a level that a call opens, is read or written.
bool uses_levels(const Program& program) {
  bool found = false;
  const auto look = [&](const VarRef& v) {
    if (v.space >= program.spaces.size() || program.spaces[v.space].named()) return;
    const auto* segment = segment_of(program, v);
    found = found || segment == nullptr || segment->scope == Scope::level;
  };
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      each_expression(s, [&](const ExprPtr& e) {
        walk(e, [&](const ExprPtr& x) {
          if (const auto* v = as_variable(x)) look(*v);
        });
      });
      each_target(s, look);
      const auto* c = std::get_if<CallRoutine>(&s.node);
      const auto* m = std::get_if<ModalCall>(&s.node);
      found = found || (c != nullptr && !c->arguments.empty()) || (m != nullptr && !m->call.arguments.empty());
    });
  }
  return found;
}

}  // namespace

void lower_calls(Program& program, const LegaliseContext& context) {
  if (program.dialect != context.target.dialect && context.target.repeat_range) repeat_own_parts(program);
  number_statements(program);
  const CallGraph calls(program);
  const auto& spaces = context.target.spaces;
  const bool levels = has_numbered_levels(program.spaces) && !has_numbered_levels(spaces);
  const bool named = has_named_locals(program.spaces) && !has_named_locals(spaces);
  if (!levels && !named) return;
  // Without values to keep apart, a control with variables of each call runs it as it stands.
  const bool plain = !named && has_named_locals(spaces) && !uses_levels(program);
  if (const CallSite* ring = plain ? nullptr : calls.recursion()) {
    context.diagnostics.error(
        "TRN-121", ring->statement->line.span,
        "this call leads back into the routine that it stands in; the local values of such calls can't "
        "be kept apart in the target",
        "write the repetition as a loop");
    return;
  }
  if (levels) lower_levels(program, context, calls);
  if (named) {
    const CallGraph again(program);
    lower_named_locals(program, context, again);
  }
}

}  // namespace cnctrans::ir::passes
