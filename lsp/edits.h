// Changes of the text: rename, renumber, quick fixes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsp/workspace.h"

namespace cnctrans::lsp {

struct Edit {
  Range range;
  std::string text;
};
/// The edits, or why there are none.
struct Edits {
  std::vector<Edit> edits;
  std::string refused;
};
Edits rename(Analysis& analysis, const Document& document, const Occurrence& name, const std::string& to);
/// Blanks at the ends of lines go; block numbers, where the program has some, become 10, 20, 30 with all jumps. Refused
/// where the result would not be the same program: it is replayed beside the old one.
Edits format(Analysis& analysis, const Document& document);

struct Fix {
  std::string title;
  std::vector<Edit> edits;
};
/// What may be meant in place of the word at a diagnostic.
std::vector<Fix> fixes(Analysis& analysis, const Document& document, const Diagnostic& diagnostic);

}  // namespace cnctrans::lsp
