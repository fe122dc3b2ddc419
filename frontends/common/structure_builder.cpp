#include "frontends/common/structure_builder.h"

#include <algorithm>
#include <utility>

#include "base/text.h"

namespace cnctrans::frontends {

namespace {

StructureBuilder::Kind kind_of(const ir::Statement& s) {
  using Kind = StructureBuilder::Kind;
  if (std::holds_alternative<ir::If>(s.node)) return Kind::if_;
  if (std::holds_alternative<ir::While>(s.node)) return Kind::while_;
  if (std::holds_alternative<ir::Until>(s.node)) return Kind::until;
  if (std::holds_alternative<ir::For>(s.node)) return Kind::for_;
  return Kind::loop;
}

ir::LineInfo& end_line(ir::Statement& s) {
  if (auto* i = std::get_if<ir::If>(&s.node)) return i->end_line;
  if (auto* w = std::get_if<ir::While>(&s.node)) return w->end_line;
  if (auto* u = std::get_if<ir::Until>(&s.node)) return u->end_line;
  if (auto* f = std::get_if<ir::For>(&s.node)) return f->end_line;
  return std::get<ir::Loop>(s.node).end_line;
}

}  // namespace

ir::Body& StructureBuilder::body_of(Open& open) {
  auto& node = open.statement.node;
  if (auto* i = std::get_if<ir::If>(&node)) return open.in_else ? i->else_body : i->then_body;
  if (auto* w = std::get_if<ir::While>(&node)) return w->body;
  if (auto* u = std::get_if<ir::Until>(&node)) return u->body;
  if (auto* f = std::get_if<ir::For>(&node)) return f->body;
  return std::get<ir::Loop>(node).body;
}

ir::Body& StructureBuilder::body() {
  return open_.empty() ? *root_ : body_of(open_.back());
}

void StructureBuilder::add(ir::Statement statement) {
  body().push_back(std::move(statement));
}

void StructureBuilder::open(ir::Statement statement) {
  const Kind kind = kind_of(statement);
  open_.push_back({std::move(statement), kind});
}

bool StructureBuilder::else_branch(ir::LineInfo line) {
  if (open_.empty() || open_.back().kind != Kind::if_ || open_.back().in_else) return false;
  auto& node = std::get<ir::If>(open_.back().statement.node);
  node.has_else = true;
  node.else_line = std::move(line);
  open_.back().in_else = true;
  return true;
}

bool StructureBuilder::close(Kind kind, ir::LineInfo line) {
  if (open_.empty() || open_.back().kind != kind) return false;
  end_line(open_.back().statement) = std::move(line);
  ir::Statement done = std::move(open_.back().statement);
  open_.pop_back();
  add(std::move(done));
  return true;
}

bool StructureBuilder::close_until(ir::ExprPtr condition, ir::LineInfo line) {
  if (open_.empty() || open_.back().kind != Kind::until) return false;
  std::get<ir::Until>(open_.back().statement.node).condition = std::move(condition);
  return close(Kind::until, std::move(line));
}

bool StructureBuilder::in_loop() const {
  return std::any_of(open_.begin(), open_.end(), [](const Open& o) { return o.kind != Kind::if_; });
}

ir::Statement* StructureBuilder::last() {
  auto& b = body();
  return b.empty() ? nullptr : &b.back();
}

namespace {

/// The code of a line as it stands in the source: without skip mark, number, labels and comment.
std::string code_of(const ir::LineInfo& line, const SourceText* source) {
  const std::string_view text = source != nullptr ? source->line_text(line.span.line) : std::string_view{};
  std::size_t from = 0, to = text.size();
  const auto past = [&](std::string_view word, char mark) {
    if (word.empty() || word.data() < text.data() || word.data() > text.data() + text.size()) return;
    from = std::max(from, static_cast<std::size_t>(word.data() - text.data()) + word.size());
    if (mark != 0)
      from = std::max(from, text.find(mark, from) == std::string_view::npos ? from : text.find(mark, from) + 1);
  };
  past(line.number, 0);
  for (const auto label : line.labels) past(label, ':');
  if (from == 0 && line.skip_mask != 0 && text.starts_with('/')) {
    from = text.find_first_not_of("0123456789", 1);
    if (from == std::string_view::npos) from = to;
  }
  for (const auto& c : line.comments) {
    if (c.pos.column > from) to = std::min<std::size_t>(to, c.pos.column - 1);
  }
  return std::string(from < to ? trim(text.substr(from, to - from)) : std::string_view{});
}

ir::Statement unread(ir::LineInfo line, const SourceText* source) {
  ir::Statement s;
  s.node = ir::Opaque{code_of(line, source), "text.unread", false};
  s.line = std::move(line);
  return s;
}

}  // namespace

std::vector<Span> StructureBuilder::finish(const SourceText* source) {
  std::vector<Span> places;
  for (const Open& o : open_) places.push_back(o.statement.line.span);
  std::vector<Open> open = std::move(open_);
  open_.clear();
  for (Open& o : open) {
    add(unread(std::move(o.statement.line), source));
    auto* branches = std::get_if<ir::If>(&o.statement.node);
    for (auto& s : branches != nullptr ? branches->then_body : body_of(o)) add(std::move(s));
    if (branches == nullptr || !branches->has_else) continue;
    add(unread(std::move(branches->else_line), source));
    for (auto& s : branches->else_body) add(std::move(s));
  }
  return places;
}

}  // namespace cnctrans::frontends
