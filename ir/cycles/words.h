// The words of a cycle, by name.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/cycle.h"

namespace cnctrans::ir::cycles {

/// Null: not given.
inline const Value* find_word(const std::vector<std::pair<std::string, Value>>& words, std::string_view name) {
  const auto it = std::find_if(words.begin(), words.end(), [name](const auto& w) { return w.first == name; });
  return it == words.end() ? nullptr : &it->second;
}
inline const Value* find_word(const NamedCycle& cycle, std::string_view name) {
  return find_word(cycle.words, name);
}
/// The text of a word that holds one; null: it is none.
inline const std::string* text_in(const Value& v) {
  const auto* s = v.expr ? std::get_if<String>(&v.expr->node) : nullptr;
  return s == nullptr ? nullptr : &s->text;
}
/// The row of that name; null: there is none.
template <class Table>
auto find_row(const Table& table, std::string_view name) -> decltype(table.data()) {
  const auto it = std::find_if(table.begin(), table.end(), [name](const auto& row) { return row.name == name; });
  return it == table.end() ? nullptr : &*it;
}
/// Numbers that describe one element of a contour in the words of a milling cycle.
inline constexpr std::size_t numbers_per_element = 8;

}  // namespace cnctrans::ir::cycles
