// Where labels, subprograms and variables stand in a text.
#pragma once

#include <string>
#include <vector>

#include "base/source.h"
#include "ir/program.h"
#include "lsp/words/words.h"

namespace cnctrans::lsp {

enum class NameKind : std::uint8_t { label, routine, variable };
struct Occurrence {
  NameKind kind = NameKind::label;
  std::string key;    ///< the same for the same thing in a program
  std::string shown;  ///< "P100", "N250", "L5"
  int routine = -1;   ///< index of the one it belongs to; -1: it is known in all of them
  Span span;
  bool defines = false;   ///< the label's line, the subprogram's head, the declaration
  bool writes = false;    ///< of a variable
  bool numbered = false;  ///< its name is a number behind a fixed prefix
};
/// In the order of the text.
std::vector<Occurrence> find_names(const ir::Program& program, FileId file, const SourceText& source,
                                   const Language& language);
bool same_name(const Occurrence& a, const Occurrence& b);
/// A jump or a call finds its target at run time: which labels it needs nobody can tell.
bool has_computed_labels(const ir::Program& program);
/// An index of a numbered variable is worked out at run time: which one it is nobody can tell.
bool has_computed_variables(const ir::Program& program);
/// A routine's name as people write it.
std::string shown_name(const ir::RoutineName& name);

}  // namespace cnctrans::lsp
