// The requests about a document: parameters and answers as JSON texts.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lsp/workspace.h"

namespace cnctrans::lsp {

/// What the server can do, for `initialize`.
std::string capabilities();
/// An answer, or the message of an error.
struct Answer {
  std::string result = "null";
  std::string error;
  std::string shown;  ///< for the user, beside the answer
};
/// nullopt: there is no such request.
std::optional<Answer> answer(std::string_view method, const std::string& parameters, Workspace& workspace);
/// The diagnostics of a document, as the parameters of a notification.
std::string published_diagnostics(Workspace& workspace, const std::string& uri);
/// workspace/executeCommand.
Answer execute(const std::string& parameters, Workspace& workspace);

}  // namespace cnctrans::lsp
