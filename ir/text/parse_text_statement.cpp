// Reading of lines and statements of the textual IR.
#include <utility>

#include "ir/text/text_reader.h"

namespace cnctrans::ir::detail {
namespace {

constexpr int body_depth_limit = 150;

LineInfo& last_line(Statement& s) {
  if (auto* i = std::get_if<If>(&s.node)) return i->end_line;
  if (auto* w = std::get_if<While>(&s.node)) return w->end_line;
  if (auto* u = std::get_if<Until>(&s.node)) return u->end_line;
  if (auto* f = std::get_if<For>(&s.node)) return f->end_line;
  if (auto* l = std::get_if<Loop>(&s.node)) return l->end_line;
  return s.line;
}

template <std::size_t i = 0, class... Kinds>
void emplace_by_index(std::variant<Kinds...>& v, std::size_t index) {
  if constexpr (i < sizeof...(Kinds)) {
    if (index == i) {
      v.template emplace<i>();
    } else {
      emplace_by_index<i + 1>(v, index);
    }
  }
}

template <std::size_t n>
std::size_t index_of(const NameList<n>& names, std::string_view word) {
  std::size_t i = 0;
  while (i < n && names[i] != word) ++i;
  return i;
}

bool number_word(std::string_view w) {
  return w.size() > 1 && w[0] == 'N' && all_digits(w.substr(1));
}

}  // namespace

// --- the front and the end of a line ----------------------------------------------------------------------------

void Reader::span(Span& s) {
  const auto part = [this](std::uint32_t& x, std::string_view before) {
    if (!before.empty()) expect(before);
    read(x);
  };
  part(s.file, "");
  part(s.line, ":");
  part(s.column, ":");
  part(s.end_line, "-");
  part(s.end_column, ":");
}

void Reader::block_number(LineInfo& line) {
  const std::string_view w = peek_word();
  if (number_word(w)) {
    line.number = program_.keep(std::string(w.substr(1)));
    take_word();
  } else if (peek_raw() == ':' && is_digit(peek_raw(1))) {
    line.number_mark = ':';
    ++at_;
    const std::size_t start = at_;
    while (is_digit(peek_raw())) ++at_;
    line.number = program_.keep(std::string(text_.substr(start, at_ - start)));
  } else if (accept_word("number")) {
    std::string mark;
    read(line.number);
    read(mark);
    if (mark.size() == 1) line.number_mark = mark[0];
  }
}

void Reader::labels(LineInfo& line) {
  while (ok()) {
    skip_blanks();
    const std::size_t start = at_;
    std::string_view name;
    if (peek_raw() == '"') {
      read(name);
    } else if (const auto w = take_word(); !w.empty()) {
      name = w;
    }
    if (ok() && at_ != start && peek_raw() == ':') {
      ++at_;
      line.labels.push_back(name.empty() ? name : program_.keep(std::string(name)));
    } else {
      at_ = start;
      return;
    }
  }
}

void Reader::line_prefix(LineInfo& line) {
  const auto column = static_cast<std::uint32_t>(at_ - line_start_ + 1);
  line.joined = accept("&");
  if (accept("@")) {
    span(line.span);
  } else if (!has_places_) {
    const auto length = text_.substr(at_).find('\n');
    const auto end = static_cast<std::uint32_t>((length == std::string_view::npos ? text_.size() - at_ : length));
    line.span = {file_, line_, column, line_, column + end};
  }
  while (peek() == '/' && is_digit(peek_raw(1))) {
    ++at_;
    std::uint32_t level = 0;
    read(level);
    if (level > 15) return fail("skip levels are 0 to 15");
    line.skip_mask = static_cast<std::uint16_t>(line.skip_mask | 1U << level);
  }
  block_number(line);
  labels(line);
}

void Reader::comments(LineInfo& line) {
  while (accept(";")) {
    auto& c = line.comments.emplace_back();
    bare("place", c.place, CommentPlace::end_of_line);
    read(c.text);
    pos(c.pos);
  }
}

// --- bodies -----------------------------------------------------------------------------------------------------

/// After a fault in the opening line its body is read all the same, when there is one.
bool Reader::open_body(LineInfo& line) {
  if (!expect("{")) {
    const std::string_view rest = text_.substr(at_, text_.find('\n', at_) - at_);
    const auto last = rest.find_last_not_of(" \t\r");
    if (last == std::string_view::npos || rest[last] != '{') return false;
  }
  finish_line(&line);
  return true;
}

void Reader::read_body(Body& b, LineInfo& closing) {
  ++depth_;
  while (true) {
    LineInfo line;
    line.blank_lines_before = blank_lines();
    if (at_end()) {
      fail("'}' is missing at the end of the text");
      break;
    }
    line_prefix(line);
    if (accept("}")) {
      closing = std::move(line);
      break;
    }
    b.push_back(read_statement(std::move(line)));
  }
  --depth_;
}

Statement Reader::read_statement(LineInfo&& line) {
  const std::size_t start = at_;
  const std::uint32_t first_line = line_;
  Statement s;
  s.line = std::move(line);
  const std::size_t kind = index_of(statement_names, peek_word());
  if (kind == statement_names.size()) {
    fail("unknown statement");
  } else if (depth_ > body_depth_limit) {
    fail("bodies are nested too deeply");
  } else {
    take_word();
    emplace_by_index(s.node, kind);
    opening_ = &s.line;
    std::visit([this](auto& x) { fields(*this, x); }, s.node);
  }
  const bool one_line = line_ == first_line;
  if (one_line && ok()) comments(last_line(s));
  const std::size_t end = text_.find('\n', at_);
  if (!finish_line(one_line ? nullptr : &last_line(s)) && one_line) {
    s.node = Opaque{std::string(text_.substr(start, end == std::string_view::npos ? end : end - start)), "text.unread",
                    false};
  }
  return s;
}

void Reader::body(std::string_view, Body& b, LineInfo& end_line) {
  if (open_body(*opening_)) read_body(b, end_line);
}

void Reader::then_else(If& x) {
  if (!open_body(*opening_)) return;
  read_body(x.then_body, x.end_line);
  if (!accept_word("else")) return;
  x.has_else = true;
  x.else_line = std::exchange(x.end_line, LineInfo{});
  if (open_body(x.else_line)) read_body(x.else_body, x.end_line);
}

// --- statements and actions with a form of their own ----------------------------------------------------------------

void Reader::label(std::string_view, LabelRef& l) {
  const char c = peek();
  const std::string_view w = peek_word();
  if (number_word(w) || w == "N") {
    take_word();
    l.is_number = true;
    l.text = w.substr(1);
    if (w.size() == 1 && peek_raw() == '"') read(l.text);
  } else if (c == '"') {
    read(l.text);
  } else if (is_capital_word(w)) {
    l.text = take_word();
  } else {
    word("at");
    return read(l.computed);
  }
  opt("computed", l.computed);
}

void Reader::setting(ModalSet& x) {
  if (accept("#")) return read(x.value);
  const auto value = setting_value(x.setting, peek_word());
  if (!value) return fail("unknown value of " + std::string(name(x.setting)));
  x.value = *value;
  take_word();
}

void Reader::action(ActionData& data) {
  const std::string_view w = peek_word();
  if (const auto setting = setting_by_name(w)) {
    data = ModalSet{*setting};
  } else if (const std::size_t kind = index_of(action_names, w); kind != 0 && kind < action_names.size()) {
    emplace_by_index(data, kind);
  } else {
    return fail("unknown action");
  }
  take_word();
  std::visit([this](auto& x) { fields(*this, x); }, data);
}

void Reader::cycle(std::variant<HoleCycle, NamedCycle>& node) {
  if (accept_word("hole")) {
    node = HoleCycle{};
  } else if (accept_word("named")) {
    node = NamedCycle{};
  } else {
    return fail("'hole' or 'named' is expected");
  }
  std::visit([this](auto& x) { fields(*this, x); }, node);
}

bool Reader::motion_or_action(Block& b) {
  if (accept_word("times")) {
    b.repeat_given = 1;
    read(b.repeat);
  } else if (motion_kind_by_name(peek_word())) {
    if (b.has_motion) fail("a block has only one motion");
    b.has_motion = true;
    fields(*this, b.motion);
  } else {
    fields(*this, b.actions.emplace_back());
  }
  return ok();
}

void Reader::block(Block& b) {
  const char c = peek();
  if (c == ';' || c == '\n' || c == '\0') return;
  while (motion_or_action(b) && accept(",")) {
  }
}

void Reader::assignments(std::string_view, std::vector<Assign::Item>& items) {
  const char c = peek();
  if (c == ';' || c == '\n' || c == '\0') return;
  do {
    auto& it = items.emplace_back();
    if (peek_word() == "sys" || peek_word() == "given") {
      const ExprPtr target = operand();
      const auto* system = target ? std::get_if<SystemRef>(&target->node) : nullptr;
      if (system != nullptr) it.system = *system;
      it.to_system = system != nullptr;
    } else {
      read(it.target);
    }
    expect("=");
    read(it.value);
    pos(it.pos);
  } while (accept(","));
}

void Reader::arguments(std::string_view, std::vector<Argument>& list) {
  if (!accept("(") || accept(")")) return;
  do {
    auto& a = list.emplace_back();
    if (peek() == '"') {
      const std::size_t start = at_;
      read(a.name);
      if (!accept("=")) {  // no name: a value that is a text
        a.name.clear();
        at_ = start;
      }
    }
    a.by_reference = accept_word("ref");
    if (a.by_reference) {
      read(a.reference);
      opt("value", a.value);
    } else {
      read(a.value);
    }
  } while (accept(","));
  expect(")");
}

void Reader::declared(std::string_view, std::vector<Declare::Item>& items) {
  while (peek() == '"') {
    auto& it = items.emplace_back();
    read(it.name);
    if (accept_adjacent('[')) index_list("]", it.dimensions);
    if (accept("=")) exprs("initial", it.initial);
    if (!accept(",")) return;
  }
}

void Reader::cases(std::string_view, std::vector<std::pair<ExprPtr, Jump>>& list) {
  while (accept_word("case")) {
    auto& c = list.emplace_back();
    read(c.first);
    word("jump");
    read(c.second);
  }
}

}  // namespace cnctrans::ir::detail
