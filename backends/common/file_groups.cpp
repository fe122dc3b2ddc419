#include "backends/common/file_groups.h"

#include <algorithm>
#include <set>

#include "ir/edit/outside.h"

namespace cnctrans::backends {

namespace {

FileId file_of(const ir::Routine& r) {
  if (r.header.span.file != 0) return r.header.span.file;
  return r.body.empty() ? r.file : r.body.front().line.span.file;
}

std::string stem_of(const ir::Program& program, FileId file) {
  const auto it = std::find_if(program.files.begin(), program.files.end(),
                               [file](const ir::FileLook& f) { return f.file == file; });
  if (it == program.files.end()) return {};
  const auto slash = it->name.rfind('/');
  const std::string name = slash == std::string::npos ? it->name : it->name.substr(slash + 1);
  const auto dot = name.rfind('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

void collect_called(const ir::Body& body, std::vector<const ir::RoutineName*>& out) {
  ir::for_each_statement(body, [&](const ir::Statement& s) {
    if (const auto* c = std::get_if<ir::CallRoutine>(&s.node)) out.push_back(&c->routine);
    const auto* m = std::get_if<ir::ModalCall>(&s.node);
    if (m != nullptr && !m->off && !m->cycle) out.push_back(&m->call.routine);
    const auto* r = std::get_if<ir::Repeat>(&s.node);
    if (r != nullptr && r->has_program) out.push_back(&r->program);
  });
}

}  // namespace

std::vector<std::size_t> file_order(const ir::Program& program, bool same_language) {
  const auto& routines = program.routines;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < routines.size(); ++i) {
    if (!ir::is_outside(routines[i])) order.push_back(i);
  }
  if (same_language || routines.empty() || routines[0].kind != ir::RoutineKind::main) return order;
  order = {0};
  std::set<std::size_t> seen{0};
  for (std::size_t at = 0; at < order.size(); ++at) {
    std::vector<const ir::RoutineName*> calls;
    collect_called(routines[order[at]].body, calls);
    for (const ir::RoutineName* called : calls) {
      for (std::size_t i = 0; i < routines.size(); ++i) {
        if (routines[i].name == *called && !ir::is_outside(routines[i]) && seen.insert(i).second) order.push_back(i);
      }
    }
  }
  for (std::size_t i = 0; i < routines.size(); ++i) {
    if (!ir::is_outside(routines[i]) && seen.insert(i).second) order.push_back(i);
  }
  return order;
}

std::vector<FileGroup> file_groups(const ir::Program& program, const std::vector<std::size_t>& order,
                                   const WriteOptions& options) {
  std::vector<FileGroup> groups(1);
  std::vector<FileId> files(1);
  const ir::Routine* first = program.main();
  if (first == nullptr && !program.routines.empty()) first = &program.routines.front();
  if (first != nullptr) files[0] = file_of(*first);
  for (const std::size_t i : order) {
    const FileId file = file_of(program.routines[i]);
    std::size_t at = 0;
    if (options.files_apart && file != 0 && file != files[0]) {
      at = static_cast<std::size_t>(std::find(files.begin() + 1, files.end(), file) - files.begin());
      if (at == files.size()) {
        files.push_back(file);
        groups.push_back({{}, stem_of(program, file)});
      }
    }
    groups[at].routines.push_back(i);
  }
  return groups;
}

}  // namespace cnctrans::backends
