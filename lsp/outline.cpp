#include "lsp/outline.h"

#include <algorithm>

#include "ir/edit/lines.h"
#include "ir/edit/search.h"
#include "lsp/describe.h"

namespace cnctrans::lsp {

namespace {

std::uint32_t last_line(const ir::Body& body, std::uint32_t least) {
  std::uint32_t last = least;
  ir::passes::each_line(body, [&last](const ir::LineInfo& line) {
    last = std::max({last, line.span.line, line.span.end_line});
  });
  return last;
}

std::string message_text(const ir::Message& m) {
  std::string text;
  for (const auto& part : m.parts) {
    if (const auto* s = part ? std::get_if<ir::String>(&part->node) : nullptr) text += s->text;
  }
  return to_utf8(text);
}

std::vector<Symbol> children_of(const ir::Routine& r, Analysis& analysis) {
  std::vector<Symbol> out;
  ir::for_each_statement(r.body, [&](const ir::Statement& s) {
    const std::uint32_t line = s.line.span.line;
    if (line == 0 || s.line.span.file != analysis.file()) return;
    for (const auto label : s.line.labels) out.push_back({std::string(label), "", SymbolKind::label, line, line, {}});
    if (const auto* m = std::get_if<ir::Message>(&s.node); m != nullptr && m->kind == ir::MessageKind::show) {
      if (const std::string text = message_text(*m); !text.empty())
        out.push_back({text, "message", SymbolKind::message, line, line, {}});
    }
    const auto* b = std::get_if<ir::Block>(&s.node);
    const auto* tool = b == nullptr ? nullptr : ir::action_in<ir::ToolSelect>(*b);
    if (tool == nullptr) return;
    const DescribeContext context{analysis.program(), {}, analysis.source()->line_text(line), false};
    const std::string name = tool->name.empty() ? value_text(tool->number, context) : to_utf8(tool->name);
    out.push_back({"T" + name, "tool", SymbolKind::tool, line, line, {}});
  });
  return out;
}

}  // namespace

std::vector<Symbol> outline(Analysis& analysis) {
  std::vector<Symbol> out;
  for (const auto& r : analysis.program().routines) {
    if (r.file != 0 && r.file != analysis.file()) continue;
    Symbol s;
    s.name = shown_name(r.name);
    if (s.name.empty()) s.name = analysis.source()->stem();
    s.detail =
        (r.kind == ir::RoutineKind::main ? "program" : "subprogram") + (r.title.empty() ? "" : ", " + to_utf8(r.title));
    s.first =
        r.header.span.known() ? r.header.span.line : (r.body.empty() ? 1 : std::max(1U, r.body.front().line.span.line));
    s.last = last_line(r.body, s.first);
    s.children = children_of(r, analysis);
    out.push_back(std::move(s));
  }
  return out;
}

std::vector<Fold> folds(Analysis& analysis) {
  std::vector<Fold> out;
  const auto add = [&out](std::uint32_t first, std::uint32_t last, bool comment) {
    if (first != 0 && last > first) out.push_back({first, last, comment});
  };
  std::uint32_t comments = 0, before = 0;  // a run of lines that are comments only
  for (const auto& r : analysis.program().routines) {
    if (r.header.span.known()) add(r.header.span.line, last_line(r.body, r.header.span.line), false);
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const std::uint32_t line = s.line.span.line;
      std::visit(
          [&](const auto& node) {
            if constexpr (requires { node.end_line; }) {
              if (node.end_line.span.known()) add(line, node.end_line.span.line, false);
            }
          },
          static_cast<const ir::StatementNode::variant&>(s.node));
      const auto* b = std::get_if<ir::Block>(&s.node);
      const bool comment = b != nullptr && b->empty() && !s.line.comments.empty();
      if (comment && comments == 0) comments = line;
      if (!comment && comments != 0) {
        add(comments, before, true);
        comments = 0;
      }
      before = line;
    });
  }
  if (comments != 0) add(comments, before, true);
  return out;
}

}  // namespace cnctrans::lsp
