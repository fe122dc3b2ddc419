// The pages of docs/diagnostics, compiled in: what a code means and what to do about it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/embedded.h"

namespace cnctrans::translator {

extern const EmbeddedText diagnostic_pages[];
extern const std::size_t diagnostic_pages_count;

struct CodePage {
  std::string_view heading;  ///< "FAG-003 — no such G function"
  std::string_view text;     ///< markdown; empty: there is no such code
};
/// Capitals or not.
CodePage code_page(std::string_view code);
/// What the code means in a few words: the title of its page, or the beginning of its first sentence. Empty: no page.
std::string_view code_title(const CodePage& page);
std::vector<std::string> documented_codes();

}  // namespace cnctrans::translator
