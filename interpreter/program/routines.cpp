#include "interpreter/program/routines.h"

namespace cnctrans::interpreter {

Routines::Routines(const ir::Program& program, const Options& options, Variables* variables)
    : program_(program), options_(options), variables_(variables) {
  unit(program);
}

Routines::Unit& Routines::unit(const ir::Program& program) {
  auto& slot = units_[&program];
  if (slot) return *slot;
  slot = std::make_unique<Unit>();
  if (variables_ == nullptr) return *slot;
  slot->spaces = variables_->add_program(program);
  // Named variables that every routine sees get their shape before any expression is compiled.
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* d = std::get_if<ir::Declare>(&s.node);
      if (d == nullptr || d->space >= program.spaces.size() || program.spaces[d->space].scope == ir::Scope::routine)
        return;
      for (const auto& item : d->items) {
        auto& v = variables_->global(item.name);
        if (!v.declared) v.shape(d->type, {});
        v.declared = true;
      }
    });
  }
  return *slot;
}

Flow* Routines::flow(const ir::Program& program, const ir::Routine& routine) {
  auto& u = unit(program);
  auto& slot = u.flows[&routine];
  if (!slot) {
    slot = std::make_unique<Flow>(build_flow(program, routine, options_));
    slot->names.spaces = &u.spaces;
  }
  return slot.get();
}

Flow* Routines::main() {
  if (const auto* r = program_.main()) return flow(program_, *r);
  return program_.routines.empty() ? nullptr : flow(program_, program_.routines.front());
}

Flow* Routines::find(const ir::RoutineName& name, const Flow& caller) {
  if (const auto* r = caller.program->find(name)) return flow(*caller.program, *r);
  if (caller.program != &program_) {
    const auto* r = program_.find(name);
    if (r != nullptr && r->kind == ir::RoutineKind::sub) return flow(program_, *r);
  }
  if (!options_.library) return nullptr;
  const auto* other = options_.library(name);
  if (other == nullptr || other->routines.empty()) return nullptr;
  const auto* r = other->find(name);
  if (r == nullptr) r = other->main();
  return flow(*other, r == nullptr ? other->routines.front() : *r);
}

Flow* Routines::main_of(const ir::Program& program) {
  const auto* r = program.main();
  return r == nullptr ? nullptr : flow(program, *r);
}

std::vector<Flow*> Routines::all_of_main() {
  std::vector<Flow*> all;
  for (const auto& r : program_.routines) all.push_back(flow(program_, r));
  return all;
}

}  // namespace cnctrans::interpreter
