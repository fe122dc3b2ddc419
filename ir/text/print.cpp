// Printing of lines, statements, routines and the program.
#include "ir/nesting.h"
#include "ir/text/text_printer.h"

namespace cnctrans::ir {
namespace detail {

std::string label_text(std::string_view text) {
  const bool number_like = text.size() > 1 && text[0] == 'N' && all_digits(text.substr(1));
  return is_capital_word(text) && !number_like && text != "N" ? std::string(text) : detail::quoted(text);
}

void Printer::put(std::string_view text) {
  if (!out.empty() && out.back() != ' ' && out.back() != '\n' && out.back() != '(') out += ' ';
  out += text;
}

void Printer::pos(WordPos p) {
  if (!options_.places || p == WordPos{}) return;
  put("@" + std::to_string(p.column) + "+" + std::to_string(p.length));
}
void Printer::place(std::string_view name, WordPos p) {
  if (!options_.places || p == WordPos{}) return;
  put(name);
  pos(p);
}

void Printer::code(bool is_explicit, std::string_view text) {
  if (is_explicit && text.empty()) put("coded");
  if (!is_explicit && !text.empty()) put("implied");
  quoted("code", text);
}

void Printer::pairs(std::string_view, const std::vector<std::pair<std::string, Value>>& list) {
  put("(");
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i != 0) glue(", ");
    value(list[i].first);
    value(list[i].second);
  }
  glue(")");
}

void Printer::label(std::string_view, const LabelRef& l) {
  if (l.is_number) {
    put("N" + (all_digits(l.text) || l.text.empty() ? l.text : detail::quoted(l.text)));
  } else if (!l.text.empty() || !l.computed) {
    put(label_text(l.text));
  } else {
    return opt("at", l.computed);
  }
  opt("computed", l.computed);
}

void Printer::routine_name(std::string_view, const RoutineName& n) {
  if (n.number >= 0) value(n.number);
  if (!n.text.empty()) value(n.text);
  if (n.empty()) put("unnamed");
}

void Printer::setting(const ModalSet& x) {
  const std::string_view text = setting_value_name(x.setting, x.value);
  put(text.empty() ? "#" + std::to_string(x.value) : std::string(text));
}

void Printer::action(const ActionData& data) {
  const auto* m = std::get_if<ModalSet>(&data);
  put(m != nullptr ? enum_name(m->setting) : action_names[data.index()]);
  std::visit([this](const auto& x) { fields(*this, x); }, data);
}

void Printer::cycle(const std::variant<HoleCycle, NamedCycle>& node) {
  put(node.index() == 0 ? "hole" : "named");
  std::visit([this](const auto& x) { fields(*this, x); }, node);
}

void Printer::block(const Block& b) {
  bool first = true;
  const auto separate = [this, &first] {
    if (!first) glue(",");
    first = false;
  };
  bool motion_left = b.has_motion;
  const auto motion = [&] {
    if (!motion_left) return;
    motion_left = false;
    separate();
    fields(*this, b.motion);
  };
  for (const auto& a : b.actions) {
    if (a.order == Order::after) motion();
    separate();
    fields(*this, a);
  }
  motion();
  if (b.repeat_given == 0) return;
  separate();
  put("times");
  value(b.repeat);
}

void Printer::line_prefix(const LineInfo& line) {
  if (line.joined) put("&");
  if (options_.places && line.span != Span{}) {
    const Span& s = line.span;
    put("@" + std::to_string(s.file) + ":" + std::to_string(s.line) + ":" + std::to_string(s.column) + "-" +
        std::to_string(s.end_line) + ":" + std::to_string(s.end_column));
  }
  for (unsigned level = 0; level < 16; ++level) {
    if ((line.skip_mask >> level & 1U) != 0) put("/" + std::to_string(level));
  }
  if (!line.number.empty()) {
    const bool plain = all_digits(line.number);
    if (plain && (line.number_mark == 'N' || line.number_mark == ':')) {
      put(std::string(1, line.number_mark) + std::string(line.number));
    } else {
      put("number");
      value(line.number);
      value(std::string_view(&line.number_mark, 1));
    }
  }
  for (const auto l : line.labels) put(label_text(l) + ":");
}

void Printer::open_line(const LineInfo& line) {
  out.append(line.blank_lines_before, '\n');
  out.append(static_cast<std::size_t>(depth_) * 2, ' ');
  line_prefix(line);
}

void Printer::close_line(const LineInfo& line) {
  for (const auto& c : line.comments) {
    put(";");
    bare("place", c.place, CommentPlace::end_of_line);
    value(c.text);
    pos(c.pos);
  }
  out += '\n';
}

void Printer::body(std::string_view, const Body& b, const LineInfo& end_line) {
  put("{");
  close_line(*opening_);
  statements(b);
  open_line(end_line);
  put("}");
}

void Printer::then_else(const If& x) {
  put("{");
  close_line(*opening_);
  statements(x.then_body);
  if (x.has_else || !x.else_body.empty()) {
    open_line(x.else_line);
    put("} else {");
    close_line(x.else_line);
    statements(x.else_body);
  }
  open_line(x.end_line);
  put("}");
}

void Printer::assignments(std::string_view, const std::vector<Assign::Item>& items) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto& it = items[i];
    if (i != 0) glue(",");
    if (it.to_system) {
      Expr e;
      e.node = it.system;
      expression(std::make_shared<const Expr>(std::move(e)), true);
    } else {
      value(it.target);
    }
    put("=");
    value(it.value);
    pos(it.pos);
  }
}

void Printer::arguments(std::string_view, const std::vector<Argument>& list) {
  if (list.empty()) return;
  put("(");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& a = list[i];
    if (i != 0) glue(", ");
    if (!a.name.empty()) {
      value(a.name);
      put("=");
    }
    if (a.by_reference) {
      put("ref");
      value(a.reference);
      opt("value", a.value);
    } else {
      value(a.value);
    }
  }
  glue(")");
}

void Printer::declared(std::string_view, const std::vector<Declare::Item>& items) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i != 0) glue(",");
    value(items[i].name);
    if (!items[i].dimensions.empty()) glue("[" + list_text(items[i].dimensions) + "]");
    if (items[i].initial.empty()) continue;
    put("=");
    exprs("initial", items[i].initial);
  }
}

void Printer::cases(std::string_view, const std::vector<std::pair<ExprPtr, Jump>>& list) {
  for (const auto& [value_of_case, jump] : list) {
    put("case");
    value(value_of_case);
    put("jump");
    value(jump);
  }
}

void Printer::statements(const Body& body) {
  ++depth_;
  for (const auto& s : body) statement(s);
  --depth_;
}

void Printer::statement(const Statement& s) {
  open_line(s.line);
  put(statement_names[s.node.index()]);
  opening_ = &s.line;
  std::visit([this](const auto& x) { fields(*this, x); }, s.node);
  const LineInfo* end = end_line_of(s);
  close_line(end != nullptr ? *end : s.line);
}

void Printer::routine(const Routine& r) {
  open_line(r.header);
  put("routine");
  fields(*this, r);
  put("{");
  close_line(r.header);
  statements(r.body);
  out += "}\n";
}

void Printer::program() {
  put("program");
  fields(*this, program_);
  if (options_.places) put("places");
  out += '\n';
  for (const auto& n : program_.axis_names) {
    put("axis");
    value(n);
    out += '\n';
  }
  for (std::size_t i = 0; i < program_.spaces.size(); ++i) {
    put("space");
    put(handles_[i]);
    fields(*this, program_.spaces[i]);
    out += '\n';
  }
  for (const auto& f : program_.files) {
    put("file");
    fields(*this, f);
    out += '\n';
  }
  for (const auto& r : program_.routines) routine(r);
}

}  // namespace detail

std::string to_text(const Program& program, const PrintOptions& options) {
  detail::Printer printer(program, options);
  printer.program();
  return std::move(printer.out);
}

std::string to_text(const Statement& statement, const Program& program) {
  detail::Printer printer(program, {});
  printer.statement(statement);
  return std::move(printer.out);
}

}  // namespace cnctrans::ir
