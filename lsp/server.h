// The language server: reads requests from one stream and answers on another until `exit`.
#pragma once

#include <cstdio>
#include <string>

namespace cnctrans::lsp {

/// The exit status of the process: 0 after `shutdown`, 1 without it.
int serve(std::FILE* in, std::FILE* out);
/// The TextMate grammar of a dialect as JSON; empty: there is no such dialect.
std::string text_mate_grammar(const std::string& dialect);

}  // namespace cnctrans::lsp
