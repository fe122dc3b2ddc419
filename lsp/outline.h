// Outline and folding of a program.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lsp/analysis.h"

namespace cnctrans::lsp {

enum class SymbolKind : std::uint8_t { routine, label, tool, message };
struct Symbol {
  std::string name, detail;
  SymbolKind kind = SymbolKind::routine;
  std::uint32_t first = 1, last = 1;  ///< lines
  std::vector<Symbol> children;
};
std::vector<Symbol> outline(Analysis& analysis);

struct Fold {
  std::uint32_t first = 1, last = 1;
  bool comment = false;
};
std::vector<Fold> folds(Analysis& analysis);

}  // namespace cnctrans::lsp
