#include "ir/cycles/assumed.h"

#include "ir/expr.h"

namespace cnctrans::ir::cycles {

namespace {

std::string option_in(const std::vector<std::pair<std::string, Value>>& words, std::string_view name) {
  for (const auto& [word, v] : words) {
    const auto* text = v.expr ? std::get_if<String>(&v.expr->node) : nullptr;
    if (word == name && text != nullptr) return text->text;
  }
  return {};
}

}  // namespace

std::string assumed_option(const NamedCycle& cycle) {
  return option_in(cycle.words, assumed_word);
}
std::string assumed_option(const HoleCycle& cycle) {
  return option_in(cycle.mill.words, assumed_mill_word);
}

}  // namespace cnctrans::ir::cycles
