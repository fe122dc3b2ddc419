// Completion, and the signature of the cycle that is being written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsp/analysis.h"

namespace cnctrans::lsp {

enum class ItemKind : std::uint8_t { word, cycle, variable, label, routine };
struct Item {
  std::string label, detail, documentation, snippet;
  ItemKind kind = ItemKind::word;
};
std::vector<Item> complete(Analysis& analysis, std::string_view line, std::uint32_t column);

struct Signature {
  std::string label, documentation;
  std::vector<WordParameter> parameters;
  std::size_t active = 0;
};
std::optional<Signature> signature(const Analysis& analysis, std::string_view line, std::uint32_t column);
/// The cycle whose definition goes over several lines, this one among them; null: there is none.
const WordInfo* cycle_of_lines(const Analysis& analysis, const Document& document, std::uint32_t line);
/// "CYCLE81(RTP, RFP, SDIS ...)", "G81 Z I [K]".
std::string usage_of(const WordInfo& word);
/// A list of the parameters in Markdown.
std::string parameter_list(const WordInfo& word);

}  // namespace cnctrans::lsp
