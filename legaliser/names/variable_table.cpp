#include "legaliser/names/variable_table.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "ir/edit/rewrite.h"

namespace cnctrans::ir::passes {

void put_variable_table(Program& program, const std::vector<std::string>& entries,
                        const std::vector<VarRef>& zero_first) {
  constexpr std::size_t longest = 60;
  auto main = std::find_if(program.routines.begin(), program.routines.end(),
                           [](const Routine& r) { return r.kind == RoutineKind::main; });
  if (main == program.routines.end()) return;
  Body head;
  std::string line;
  for (const auto& e : entries) {
    if (!line.empty() && line.size() + e.size() > longest) {
      head.push_back(make_comment(line, program));
      line.clear();
    }
    line += (line.empty() ? "" : " ") + e;
  }
  if (!line.empty()) head.push_back(make_comment(line, program));
  const LineInfo nowhere;
  for (const auto& v : zero_first) head.push_back(make_assign(nowhere, v, number(0)));
  main->body.insert(below_head(main->body), std::make_move_iterator(head.begin()), std::make_move_iterator(head.end()));
}

}  // namespace cnctrans::ir::passes
