#include "legaliser/names/variable_use.h"

#include <algorithm>

#include "legaliser/data/written_data.h"

#include "base/saturate.h"
#include "ir/analysis/call_graph.h"
#include "legaliser/data/given_data.h"

namespace cnctrans::ir::passes {

void VariableUse::note(const VarRef& v, std::size_t routine, const LineInfo& line) {
  if (v.space >= program_.spaces.size()) return;
  const auto& space = program_.spaces[v.space];
  if (space.named()) {
    named[{v.space, v.name}].routines.insert(routine);
    if (space.prefix == level_prefix) levels = true;
    return;
  }
  const auto n = constant_index(v);
  auto& known = numbered[v.space];
  if (n) {
    known.used.insert(*n);
  } else if (!known.computed) {
    known.computed = true;
    known.computed_at = line;
  }
}

VariableUse::VariableUse(const Program& program, const LegaliseContext& context)
    : program_(program), context_(context) {
  for (std::size_t r = 0; r < program_.routines.size(); ++r) {
    for (const auto& p : program_.routines[r].parameters) note(p.variable, r, program_.routines[r].header);
    for_each_statement(program_.routines[r].body, [&](const Statement& s) {
      each_expression(s, [&](const ExprPtr& e) {
        walk(e, [&](const ExprPtr& x) {
          if (const auto* v = as_variable(x)) note(*v, r, s.line);
          if (const auto* sys = std::get_if<SystemRef>(&x->node)) system(*sys);
        });
      });
      each_target(s, [&](const VarRef& v) { note(v, r, s.line); });
      if (const auto* d = std::get_if<Declare>(&s.node)) dimensions(*d, r);
      if (const auto* a = std::get_if<Assign>(&s.node)) {
        for (const auto& i : a->items) {
          if (i.to_system && !left_out(i.system)) system(i.system);
        }
      }
      note_missing(s);
      const auto* c = std::get_if<CallRoutine>(&s.node);
      if (c != nullptr && c->level == CallLevel::new_level) levels = true;
    });
  }
  say_lacking();
}

void VariableUse::dimensions(const Declare& d, std::size_t routine) {
  if (d.space >= program_.spaces.size() || !program_.spaces[d.space].named()) return;
  for (const auto& i : d.items) {
    auto& n = named[{d.space, i.name}];
    n.routines.insert(routine);
    for (const auto& x : i.dimensions) {
      n.dimensions.push_back(saturate<std::int64_t>(constant_value(x).value_or(1)));
    }
  }
}

void VariableUse::system(const SystemRef& ref) {
  if (has_name(ref, context_)) return;
  missing_[std::string(ref.text)].insert(name_of_datum(ref, program_));
}

void VariableUse::note_missing(const Statement& s) {
  for (const auto& [kind, names] : missing_) {
    const std::size_t more = names.size() - 1;
    const std::string what =
        "the target has no counterpart of " + quoted(*names.begin()) +
        (more == 0 ? "" : " and of " + std::to_string(more) + " more that " + quoted(kind) + " asks for here");
    const auto same = [&what](const Lacking& l) { return l.what == what; };
    auto it = std::find_if(lacking_.begin(), lacking_.end(), same);
    if (it == lacking_.end()) it = lacking_.insert(lacking_.end(), {what, s.line.span, 0});
    ++it->blocks;
  }
  missing_.clear();
}

void VariableUse::say_lacking() const {
  for (const auto& l : lacking_) {
    context_.diagnostics.error(
        "TRN-122", l.first,
        l.what + (l.blocks > 1 ? "; " + std::to_string(l.blocks) + " blocks need it" : std::string()),
        "say what stands for it on the target in a file of names (--names, \"data\"), or replace it by a variable or a "
        "fixed value");
  }
}

bool may_be_read_first(const Program& program, const std::pair<SpaceId, std::string>& key) {
  bool declared = false, array = false, given = false;
  Span line;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      if (const auto* d = std::get_if<Declare>(&s.node); d != nullptr && d->space == key.first) {
        for (const auto& item : d->items) {
          if (item.name != key.second) continue;
          declared = true;
          array = !item.dimensions.empty();
          given = given || !item.initial.empty();
          line = s.line.span;
        }
      }
      const auto* a = std::get_if<Assign>(&s.node);
      if (a == nullptr || !declared || s.line.span.file != line.file || s.line.span.line != line.line) return;
      for (const auto& item : a->items) given = given || item.target.name == key.second;
    });
  }
  return declared && !(array && given);
}

}  // namespace cnctrans::ir::passes
