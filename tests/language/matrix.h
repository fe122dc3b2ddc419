// The part of a page of docs/dialects that a test makes from the tables.
#pragma once

#include <string>
#include <string_view>

namespace cnctrans {

/// The support matrix of the page (`num.md`) is the one that is `made`; with CNCTRANS_WRITE_DOCS=1 it becomes that.
void expect_support_matrix(const std::string& page, const std::string& made);
/// The options of a machine profile whose names begin so ("num."), as a table.
std::string option_table(std::string_view begin);

}  // namespace cnctrans
