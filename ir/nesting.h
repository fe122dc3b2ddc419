// The bodies inside a statement, for code that walks them itself. Only for the .cpp files of ir/.
#pragma once

#include <array>

#include "ir/statement.h"

namespace cnctrans::ir::detail {

/// In text order; null where there is none.
inline std::array<const Body*, 2> bodies_of(const Statement& s) {
  if (const auto* i = std::get_if<If>(&s.node)) return {&i->then_body, &i->else_body};
  if (const auto* w = std::get_if<While>(&s.node)) return {&w->body, nullptr};
  if (const auto* u = std::get_if<Until>(&s.node)) return {&u->body, nullptr};
  if (const auto* f = std::get_if<For>(&s.node)) return {&f->body, nullptr};
  if (const auto* l = std::get_if<Loop>(&s.node)) return {&l->body, nullptr};
  return {nullptr, nullptr};
}

/// The closing line of a structured statement; null for any other.
inline const LineInfo* end_line_of(const Statement& s) {
  if (const auto* i = std::get_if<If>(&s.node)) return &i->end_line;
  if (const auto* w = std::get_if<While>(&s.node)) return &w->end_line;
  if (const auto* u = std::get_if<Until>(&s.node)) return &u->end_line;
  if (const auto* f = std::get_if<For>(&s.node)) return &f->end_line;
  if (const auto* l = std::get_if<Loop>(&s.node)) return &l->end_line;
  return nullptr;
}

/// Block skip can leave out statement `i` of the body: its line, of which it may be only a part, has a skip level.
inline bool skippable(const Body& b, std::size_t i) {
  while (b[i].line.skip_mask == 0 && b[i].line.joined && i != 0) --i;
  return b[i].line.skip_mask != 0;
}

/// Index of the last statement of the line on which statement `i` of the body stands.
inline std::size_t line_end(const Body& b, std::size_t i) {
  while (i + 1 < b.size() && b[i + 1].line.joined) ++i;
  return i;
}

/// By the count of a call or a repeat; none: once.
inline bool runs_at_least_once(const ExprPtr& count) {
  if (!count) return true;
  const auto value = constant_value(count);
  return value && *value >= 1;
}
inline bool runs_once_at_most(const ExprPtr& count) {
  if (!count) return true;
  const auto value = constant_value(count);
  return value && *value <= 1;
}

}  // namespace cnctrans::ir::detail
