// A draft: a translation with holes, for a person to finish. What has to be decided stands at its head.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backends/common/backend.h"
#include "ir/program.h"
#include "legaliser/legalise.h"
#include "translator/pipeline.h"

namespace cnctrans::translator {

/// How the names of such variables begin.
inline constexpr std::string_view placeholder_mark = "TODO_";

/// Machine data that nobody places on the target and that the program reads become variables that a person sets: its
/// conditions and loops keep their form. One error and one thing to do for each.
std::vector<ToDo> put_placeholders(ir::Program& work, const ir::LegaliseContext& context);

/// What is kept as text leaves everything as it was: nothing will be written, and what follows is looked at as if it
/// were mended.
void pass_over_unread(ir::Program& work);
/// What has to be decided: the errors by their cause, and what the writer left out besides. `calls`: for each missing
/// routine the places of its calls.
std::vector<ToDo> to_do_of(std::vector<ToDo> placeholders, const Diagnostics& read, const Diagnostics& written,
                           const std::vector<std::vector<Span>>& calls, const std::vector<Span>& left_out);

/// For the writer: the number of each line that is left out, and whether the machine has to stop before it.
backends::ToDoLines to_do_lines(const std::vector<ToDo>& list, const ir::Program& work);

/// The list as remarks at the head of the main program.
void put_to_do(ir::Program& work, const std::vector<ToDo>& list, std::size_t lines, const std::string& source);

/// PART.MPF as PART.draft.MPF.
std::string draft_name(const std::string& name);

/// Lines of the source, each once.
std::vector<Span> lines_of(std::vector<Span> places);

}  // namespace cnctrans::translator
