#include "ir/analysis/label_uses.h"

#include "base/text.h"
#include "ir/analysis/value_set.h"

namespace cnctrans::ir::passes {

bool LabelUses::is_target(const LabelRef& l) const {
  return (l.is_number ? computed : computed_name) || targets.count({l.is_number, l.text}) != 0;
}

void each_label_ref(Statement& s, const std::function<void(LabelRef&, bool)>& visit) {
  if (auto* j = std::get_if<Jump>(&s.node)) {
    visit(j->target, false);
  } else if (auto* sw = std::get_if<Switch>(&s.node)) {
    for (auto& c : sw->cases) visit(c.second.target, false);
    for (auto& f : sw->fallback) visit(f.target, false);
  } else if (auto* r = std::get_if<Repeat>(&s.node)) {
    if (r->has_program) return;
    visit(r->first, false);
    if (!r->last.text.empty() || r->last.computed) visit(r->last, true);
  }
}

namespace {

void note_use(const Program& program, LabelUses& uses, const LabelRef& l, bool is_end) {
  if (l.computed) {
    const auto values = possible_values(program, l.computed);
    if (!values) uses.computed = true;
    if (!values && l.computed->type == Type::string) uses.computed_name = true;
    for (const double v : values.value_or(std::vector<double>{}))
      (is_end ? uses.ends : uses.targets).insert({true, shortest(v)});
    return;
  }
  (is_end ? uses.ends : uses.targets).insert({l.is_number, l.text});
}

}  // namespace

LabelUses label_uses(const Program& program, const Routine& routine) {
  LabelUses uses;
  auto& body = const_cast<Body&>(routine.body);  // NOLINT: read only
  for_each_statement(body, [&](Statement& s) {
    each_label_ref(s, [&](LabelRef& l, bool is_end) { note_use(program, uses, l, is_end); });
  });
  for (const auto& other : program.routines) {
    for_each_statement(other.body, [&](const Statement& s) {
      const LabelRef* first = nullptr;
      const LabelRef* last = nullptr;
      const RoutineName* name = nullptr;
      bool any = false;  // the routine is found at run time: it may be this one
      if (const auto* c = std::get_if<CallRoutine>(&s.node); c != nullptr && c->has_range) {
        first = &c->first;
        last = &c->last;
        name = &c->routine;
        any = c->computed != nullptr;
      } else if (const auto* r = std::get_if<Repeat>(&s.node); r != nullptr && r->has_program) {
        first = &r->first;
        last = &r->last;
        name = &r->program;
      }
      if (name == nullptr || (!any && program.find(*name) != &routine)) return;
      note_use(program, uses, *first, false);
      note_use(program, uses, *last, true);
    });
  }
  return uses;
}

}  // namespace cnctrans::ir::passes
