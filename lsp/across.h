// The other programs that a name of a document may stand in: documents that are open, and files beside it and in the
// libraries.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lsp/workspace.h"

namespace cnctrans::lsp {

/// A program with the same name in it. A file that is not open is read for the question and owned by the answer.
struct Other {
  std::string uri;
  const Document* document = nullptr;
  Analysis* analysis = nullptr;
  std::unique_ptr<Document> own_document;
  std::unique_ptr<Analysis> own_analysis;
};

/// Programs of the same language where `name` stands, which is known in all programs. Of a variable only those that
/// have a subprogram in common with the document: the same number elsewhere is another thing.
std::vector<Other> others_with(Workspace& workspace, const std::string& uri, Analysis& analysis,
                               const Occurrence& name);

}  // namespace cnctrans::lsp
