#include "legaliser/analysis/handed_variables.h"

#include <algorithm>

#include "ir/analysis/domains/kept_values.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::ir::passes {

namespace {

/// What a call hands over for the parameter, where that is a variable.
const VarRef* handed_variable(const CallRoutine& call, std::size_t i) {
  if (i >= call.arguments.size()) return nullptr;
  const Argument& a = call.arguments[i];
  if (a.value) return as_variable(a.value);
  return a.by_reference ? &a.reference : nullptr;
}

bool may_be_same(const VarRef& a, const VarRef& b) {
  if (a.space != b.space || a.name != b.name) return false;
  const auto m = constant_index(a), n = constant_index(b);
  return !m || !n || *m == *n;
}

const CallRoutine* call_at(const CallSite& site) {
  return std::get_if<CallRoutine>(&site.statement->node);
}

}  // namespace

bool is_routine_space(const Program& program, SpaceId space) {
  return space < program.spaces.size() && program.spaces[space].named() &&
         program.spaces[space].scope == Scope::routine && program.spaces[space].prefix.empty();
}

HandedVariables::HandedVariables(const Program& program, const LegaliseContext& context, const CallGraph& calls)
    : program_(program), calls_(calls) {
  const std::size_t n = program.routines.size();
  declared_.resize(n);
  mentions_.resize(n);
  handed_.resize(n);
  for (std::size_t r = 0; r < n; ++r) note_names(r);
  for (std::size_t r = 0; r < n; ++r) look_at(r, context);
}

void HandedVariables::note_names(std::size_t r) {
  const auto mention = [&](const VarRef& v) { mentions_[r].push_back(v); };
  for (const auto& p : program_.routines[r].parameters) declared_[r].insert(p.variable.name);
  for_each_statement(program_.routines[r].body, [&](const Statement& s) {
    if (const auto* d = std::get_if<Declare>(&s.node); d != nullptr && is_routine_space(program_, d->space)) {
      for (const auto& i : d->items) declared_[r].insert(i.name);
    }
    each_expression(s, [&](const ExprPtr& e) {
      walk(e, [&](const ExprPtr& x) {
        if (const auto* v = as_variable(x)) mention(*v);
      });
    });
    each_target(s, mention);
  });
}

/// The call hands over a variable that its subprogram sees under another name too: its own, or that of another
/// parameter. What goes over by copies would then be two variables.
bool HandedVariables::seen_twice(const CallSite& site, std::size_t i) const {
  const auto* call = call_at(site);
  const VarRef* v = call == nullptr ? nullptr : handed_variable(*call, i);
  if (v == nullptr) return false;
  const auto& parameters = program_.routines[*site.callee].parameters;
  for (std::size_t other = 0; other < parameters.size(); ++other) {
    const VarRef* also = other != i && parameters[other].by_reference ? handed_variable(*call, other) : nullptr;
    if (also != nullptr && same_variable(*v, *also)) return true;
  }
  const bool local = is_routine_space(program_, v->space);
  const auto run = reached_from(calls_, *site.callee);
  return std::any_of(run.begin(), run.end(), [&](std::size_t r) {
    if (local && (site.caller != 0 || declared_[r].count(v->name) != 0))
      return false;  // only the main program's is seen
    return std::any_of(mentions_[r].begin(), mentions_[r].end(), [v](const VarRef& m) { return may_be_same(m, *v); });
  });
}

/// All calls of the routine hand over one variable.
bool HandedVariables::one_variable(std::size_t r, std::size_t i, bool array, From& from) const {
  bool found = false;
  for (const auto& site : calls_.sites()) {
    if (site.callee != r) continue;
    const auto* call = call_at(site);
    const VarRef* v = call != nullptr ? handed_variable(*call, i) : nullptr;
    if (v == nullptr || !v->indices.empty()) return false;
    if (array ? v->name.empty() : v->index && !constant_index(*v)) return false;
    const bool shared = !is_routine_space(program_, v->space);  // one variable, whoever hands it over
    if (found && !((shared || from.first == site.caller) && same_variable(from.second, *v))) return false;
    from = {site.caller, *v};
    found = true;
  }
  return found;
}

void HandedVariables::look_at(std::size_t r, const LegaliseContext& context) {
  const Routine& routine = program_.routines[r];
  for (std::size_t i = 0; i < routine.parameters.size(); ++i) {
    const Parameter& p = routine.parameters[i];
    if (!p.by_reference) continue;
    const bool array = p.name.find('[') != std::string::npos;
    const auto& sites = calls_.sites();
    const bool twice = !array && std::any_of(sites.begin(), sites.end(), [&](const CallSite& site) {
      return site.callee == r && seen_twice(site, i);
    });
    if (!array && !twice) continue;
    From from;
    if (one_variable(r, i, array, from)) {
      sources_.insert({from.first, from.second.name});
      handed_[r].emplace(p.variable.name, std::move(from));
    } else if (array) {
      context.diagnostics.error("TRN-461", routine.header.span,
                                "the array parameter " + p.name +
                                    (calls_.called(r) ? ": its calls hand over different arrays, and "
                                                      : ": nothing at hand calls the subprogram, and ") +
                                    "the target has no arrays that a name can stand for",
                                "write a subprogram for each array, or use one array");
    } else {
      context.diagnostics.error(
          "TRN-520", routine.header.span,
          "the parameter " + p.name +
              " stands for a variable that the subprogram also uses by another name, and its "
              "calls hand over different ones: the target has copies only, which would be two variables",
          "use the variable by one name only, or write a subprogram for each");
    }
  }
}

}  // namespace cnctrans::ir::passes
