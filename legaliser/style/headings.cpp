// Comments between two routines are the heading of the second one; they go below its header where that is the custom.
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

bool only_comments(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  const bool nothing = (b != nullptr && b->empty() && b->repeat_given == 0) || std::holds_alternative<Label>(s.node);
  return nothing && s.line.number.empty() && s.line.labels.empty();
}

bool ends_routine(const Statement& s) {
  return std::holds_alternative<End>(s.node) || std::holds_alternative<Return>(s.node);
}

}  // namespace

void move_headings(Program& program, const LegaliseContext& context) {
  if (!context.target.heading_below_header) return;
  for (std::size_t i = 1; i < program.routines.size(); ++i) {
    Body& before = program.routines[i - 1].body;
    Body& body = program.routines[i].body;
    const Span header = program.routines[i].header.span;
    auto first = before.end();
    while (first != before.begin() && only_comments(*std::prev(first))) --first;
    if (first == before.end() || first == before.begin() || !ends_routine(*std::prev(first))) continue;
    if (!header.known() || header.file != first->line.span.file) continue;
    while (first != before.end() && first->line.comments.empty()) ++first;  // blank lines between the two
    if (first == before.end()) continue;
    first->line.blank_lines_before = 0;
    body.insert(body.begin(), std::make_move_iterator(first), std::make_move_iterator(before.end()));
    before.erase(first, before.end());
  }
}

}  // namespace cnctrans::ir::passes
