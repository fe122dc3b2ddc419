// Text inside HTML and CSV.
#pragma once

#include <string>
#include <string_view>

namespace cnctrans {

/// For HTML, in a text or in a quoted attribute. The text is made UTF-8 (to_utf8).
std::string html_text(std::string_view text);
/// A cell of CSV: in quotes where it must be, line ends as blanks.
std::string csv_cell(std::string_view text);

}  // namespace cnctrans
