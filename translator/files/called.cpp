#include "translator/files/called.h"

#include <set>

#include "ir/cycles/milling/mill_contour.h"

namespace cnctrans::translator {

/// Names of routines that statements of `program` call by a fixed name.
void collect_calls(const ir::Program& program, std::vector<ir::RoutineName>& out) {
  for (const auto& routine : program.routines) {
    ir::for_each_statement(routine.body, [&out](const ir::Statement& s) {
      if (const auto* c = std::get_if<ir::CallRoutine>(&s.node)) {
        if (!c->computed) out.push_back(c->routine);
      } else if (const auto* m = std::get_if<ir::ModalCall>(&s.node)) {
        if (!m->off && !m->cycle && !m->call.computed) out.push_back(m->call.routine);
      } else if (const auto* r = std::get_if<ir::Repeat>(&s.node)) {
        if (r->has_program) out.push_back(r->program);
      } else if (const auto* b = std::get_if<ir::Block>(&s.node)) {
        for (const auto& a : b->actions) {
          const auto* d = std::get_if<ir::CycleDefine>(&a.data);
          if (d == nullptr || !d->cycle) continue;
          for (auto& profile : ir::cycles::contour_routines(*d->cycle)) out.push_back(std::move(profile));
        }
      }
    });
  }
}

namespace {

/// Variable references of a library program point into its own spaces; the frontends give every program of a dialect
/// the same standard spaces first, so only the tail of named spaces can differ.
bool same_spaces(const ir::Program& a, const ir::Program& b) {
  if (a.spaces.size() != b.spaces.size()) return false;
  for (std::size_t i = 0; i < a.spaces.size(); ++i) {
    if (a.spaces[i].prefix != b.spaces[i].prefix) return false;
  }
  return true;
}

}  // namespace

void join_libraries(ir::Program& program, Loader& loader, Diagnostics& diagnostics) {
  std::vector<ir::RoutineName> wanted;
  collect_calls(program, wanted);
  std::set<const ir::Program*> joined;
  while (!wanted.empty()) {
    const ir::RoutineName name = wanted.back();
    wanted.pop_back();
    if (program.find(name) != nullptr) continue;
    const ir::Program* found = loader.find(name);
    if (found == nullptr || !joined.insert(found).second) continue;
    if (!same_spaces(program, *found)) {
      const Span where = found->routines.empty() ? Span{} : found->routines.front().header.span;
      diagnostics.error("TRN-090", where,
                        "the called program names other axes or variable spaces than the main program");
      continue;
    }
    collect_calls(*found, wanted);
    for (auto routine : found->routines) {
      if (routine.kind == ir::RoutineKind::main) routine.kind = ir::RoutineKind::sub;
      program.routines.push_back(std::move(routine));
    }
    program.files.insert(program.files.end(), found->files.begin(), found->files.end());
    program.texts->share(found->texts);
  }
  ir::number_statements(program);
}

}  // namespace cnctrans::translator
