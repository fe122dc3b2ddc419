// lsp: the language server, and the grammars that are made of its tables.
#include "cli/common.h"
#include "lsp/server.h"

namespace cnctrans::cli {

int language_server(const Arguments& a) {
  if (a.grammar.empty()) return lsp::serve(stdin, stdout);
  const std::string grammar = lsp::text_mate_grammar(a.grammar);
  if (grammar.empty())
    return usage_error(a, "there is no language " + a.grammar + " that is read: see cnctrans dialects");
  write_all(stdout, grammar);
  return ok;
}

}  // namespace cnctrans::cli
