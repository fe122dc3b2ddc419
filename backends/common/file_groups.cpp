#include "backends/common/file_groups.h"

#include <algorithm>

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

}  // namespace

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
