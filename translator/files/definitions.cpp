#include "translator/files/definitions.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/text.h"
#include "ir/analysis/call_graph.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::translator {

namespace fs = std::filesystem;

namespace {

bool defines(const Dialect& dialect, const fs::path& file) {
  const std::string name = to_upper_ascii(file.filename().string());
  return std::any_of(dialect.definition_extensions.begin(), dialect.definition_extensions.end(),
                     [&](std::string_view extension) {
                       const std::string end = to_upper_ascii(extension);
                       return name.ends_with('.' + end) || name.ends_with('_' + end);
                     });
}

using Used = std::set<std::pair<ir::SpaceId, std::string>>;

Used used_names(const ir::Program& program) {
  Used used;
  const auto note = [&](const ir::VarRef& v) {
    if (!v.name.empty()) used.emplace(v.space, v.name);
  };
  for (const auto& routine : program.routines) {
    ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
      ir::passes::each_expression(s, [&](const ir::ExprPtr& e) {
        ir::walk(e, [&](const ir::ExprPtr& x) {
          if (const auto* v = ir::passes::as_variable(x)) note(*v);
        });
      });
      ir::passes::each_target(s, note);
    });
  }
  return used;
}

/// Calls `use(statement, definition)` for each definition of a name of the machine.
template <class Use>
void each_definition(const std::vector<const ir::Program*>& definitions, const Use& use) {
  for (const ir::Program* of_machine : definitions) {
    for (const auto& routine : of_machine->routines) {
      ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
        const auto* d = std::get_if<ir::Declare>(&s.node);
        if (d != nullptr && d->space < of_machine->spaces.size() &&
            of_machine->spaces[d->space].scope == ir::Scope::global)
          use(s, *d);
      });
    }
  }
}

std::string value_text(const ir::Declare& d, const ir::Declare::Item& item) {
  if (!item.dimensions.empty()) return "the values of its definition";
  const auto* n = item.initial.empty() || !item.initial[0] ? nullptr : std::get_if<ir::Number>(&item.initial[0]->node);
  if (d.type == ir::Type::string) return "the text of its definition";
  if (item.initial.empty()) return "0, the value of a definition that gives none";
  return n == nullptr ? "the value of its definition"
                      : (n->text.empty() ? shortest(n->value) : n->text) + ", the value of its definition";
}

}  // namespace

std::vector<std::string> definition_files(const Dialect& dialect, const std::vector<std::string>& libraries) {
  std::vector<std::string> files;
  if (dialect.definition_extensions.empty()) return files;
  std::error_code ignored;
  for (const auto& library : libraries) {
    if (fs::is_regular_file(library, ignored)) {
      if (defines(dialect, library)) files.push_back(library);
      continue;
    }
    const std::size_t from = files.size();
    for (const auto& entry : fs::directory_iterator(library, ignored)) {
      if (entry.is_regular_file(ignored) && defines(dialect, entry.path())) files.push_back(entry.path().string());
    }
    std::sort(files.begin() + static_cast<std::ptrdiff_t>(from), files.end());
  }
  return files;
}

void declare_names(ir::Program& program, const std::vector<const ir::Program*>& definitions, bool all,
                   Diagnostics& diagnostics) {
  if (definitions.empty() || program.routines.empty()) return;
  const auto main = std::find_if(program.routines.begin(), program.routines.end(),
                                 [](const ir::Routine& r) { return r.kind == ir::RoutineKind::main; });
  ir::Routine& first = main != program.routines.end() ? *main : program.routines.front();
  const auto index = static_cast<std::size_t>(&first - program.routines.data());
  ir::number_statements(program);
  const Used used = used_names(program);
  const ir::passes::CallGraph calls(program);
  ir::passes::ReadFirst reads(program, calls, true);
  ir::Body head;
  each_definition(definitions, [&](const ir::Statement& s, const ir::Declare& d) {
    ir::Declare here = d;
    std::erase_if(here.items, [&](const ir::Declare::Item& i) { return !all && used.count({d.space, i.name}) == 0; });
    if (here.items.empty()) return;
    for (auto& item : here.items) {
      const bool in_use = used.count({d.space, item.name}) != 0;
      const bool starts = in_use && reads(index, ir::VarRef{d.space, item.name, nullptr, {}});
      if (starts) {
        diagnostics.warning("TRN-463", s.line.span,
                            item.name + " is read before the program writes it: it starts with " + value_text(d, item) +
                                "; the control keeps the value that an earlier program has left",
                            "--set " + item.name + "=VALUE gives a run another one");
      } else if (in_use) {
        item.initial.clear();
      }
    }
    ir::Statement made;
    made.line.span = s.line.span;
    made.node = std::move(here);
    head.push_back(std::move(made));
  });
  if (head.empty()) return;
  for (const ir::Program* of_machine : definitions) program.texts->share(of_machine->texts);
  first.body.insert(first.body.begin(), std::make_move_iterator(head.begin()), std::make_move_iterator(head.end()));
  ir::number_statements(program);
}

}  // namespace cnctrans::translator
