// The part of a page of docs/dialects that a test makes from the tables.
#pragma once

#include <string>

namespace cnctrans {

/// The support matrix of the page (`num.md`) is the one that is `made`; with CNCTRANS_WRITE_DOCS=1 it becomes that.
void expect_support_matrix(const std::string& page, const std::string& made);

}  // namespace cnctrans
