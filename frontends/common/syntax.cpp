#include "frontends/common/syntax.h"

#include <fmt/format.h>

#include <iterator>

namespace cnctrans::syntax {

namespace {

using Out = std::back_insert_iterator<std::string>;

void dump_expr(const Expr& e, Out out) {
  switch (e.kind) {
    case ExprKind::number: fmt::format_to(out, "{}", e.text); return;
    case ExprKind::string: fmt::format_to(out, "\"{}\"", e.text); return;
    case ExprKind::missing: fmt::format_to(out, "_"); return;
    case ExprKind::name: fmt::format_to(out, "'{}", e.text); return;
    case ExprKind::variable:
    case ExprKind::unary:
    case ExprKind::binary:
    case ExprKind::call: break;
  }
  fmt::format_to(out, "({}", e.text);
  for (const auto& a : e.args) {
    fmt::format_to(out, " ");
    dump_expr(a, out);
  }
  fmt::format_to(out, ")");
}

void dump_statement(const Statement& s, int depth, Out out) {
  fmt::format_to(out, "{:{}}statement {}", "", depth * 2, s.keyword);
  for (const auto& a : s.args) {
    fmt::format_to(out, " ");
    dump_expr(a, out);
  }
  if (!s.text.empty()) fmt::format_to(out, " text \"{}\"", s.text);
  fmt::format_to(out, " @{}+{}\n", s.pos.column, s.pos.length);
  for (const auto& c : s.children) dump_statement(c, depth + 1, out);
}

}  // namespace

std::string dump(const Block& block) {
  std::string text;
  Out out(text);
  if (block.skip_mask != 0)
    fmt::format_to(out, "skip {:#x} @{}+{}\n", block.skip_mask, block.skip_pos.column, block.skip_pos.length);
  if (!block.number.empty()) {
    fmt::format_to(out, "number {}{} @{}+{}\n", block.number_mark, block.number, block.number_pos.column,
                   block.number_pos.length);
  }
  for (const auto& l : block.labels) fmt::format_to(out, "label {}\n", l);
  for (const auto& w : block.words) {
    fmt::format_to(out, "word {}", w.address);
    if (w.extension >= 0) fmt::format_to(out, "[{}]", w.extension);
    if (w.equals) fmt::format_to(out, "=");
    if (w.is_expression && w.expr >= 0) {
      fmt::format_to(out, " ");
      dump_expr(block.exprs[static_cast<std::size_t>(w.expr)], out);
    } else if (w.has_value) {
      fmt::format_to(out, " {} ({})", w.number_text, w.number);
    }
    fmt::format_to(out, " @{}+{}\n", w.pos.column, w.pos.length);
  }
  for (const auto& s : block.statements) dump_statement(s, 0, out);
  for (const auto& c : block.comments)
    fmt::format_to(out, "comment \"{}\" @{}+{}\n", c.text, c.pos.column, c.pos.length);
  if (block.plain) fmt::format_to(out, "plain\n");
  return text;
}

}  // namespace cnctrans::syntax
