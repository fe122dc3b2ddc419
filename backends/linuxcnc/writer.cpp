// Files, subroutines, structures, calls, messages ("O Codes" of the manual).
#include "backends/linuxcnc/writer.h"

#include <algorithm>

#include "backends/common/comments.h"
#include "backends/linuxcnc/tables.h"
#include "base/text.h"
#include "dialects/linuxcnc/limits.h"
#include "ir/edit/labels.h"

namespace cnctrans::backends::linuxcnc {
namespace {

constexpr std::string_view no_statement = "TRN-201";
constexpr int repeat_depth = 8;
constexpr std::string_view spindle_limit_parameter = "#<_spindle_limit>";

template <class Visitor>
void each_action(const ir::Program& program, const Visitor& visit) {
  for (const ir::Routine& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      for (const ir::Action& a : b->actions) visit(a);
    });
  }
}

}  // namespace

Writer::Writer(const ir::Program& source, const WriteOptions& write_options, Diagnostics& sink)
    : ProgramWriter(source, write_options, linuxcnc::style, sink), expressions_(program()) {
  each_action(program(), [this](const ir::Action& a) {
    has_spindle_limit_ = has_spindle_limit_ || std::holds_alternative<ir::SpindleLimit>(a.data);
    const auto* f = std::get_if<ir::FrameOp>(&a.data);
    shifts_ = shifts_ || (f != nullptr && f->change->combine != ir::FrameCombine::clear);
  });
}

// ---- files and subroutines -----------------------------------------------------------------------------------------

std::string Writer::sub_label(const ir::RoutineName& name) const {
  if (name.text.empty()) return 'o' + std::to_string(name.number);
  std::string plain;
  for (const char c : to_upper_ascii(name.text)) {
    if (c >= 'A' && c <= 'Z')
      plain += static_cast<char>(c - 'A' + 'a');
    else
      plain += c >= '0' && c <= '9' ? c : '_';
  }
  return "o<" + plain + '>';
}

std::string Writer::next_label() {
  const auto taken = [this](std::int64_t n) {
    const auto& all = program().routines;
    return std::any_of(all.begin(), all.end(), [n](const ir::Routine& r) { return r.name.number == n; });
  };
  do ++last_label_;
  while (taken(last_label_));
  return 'o' + std::to_string(last_label_);
}

/// Subroutines stand in front of the main program: the control must have met them before their first call.
void Writer::write_program() {
  const std::string stem = options().main_stem.empty() ? "main" : options().main_stem;
  open_file(free_stem(stem, ".ngc") + ".ngc", true);
  const auto& routines = program().routines;
  for (std::size_t i = 0; i < routines.size(); ++i) {
    if (routines[i].kind == ir::RoutineKind::sub) routine_text(i);
  }
  for (std::size_t i = 0; i < routines.size(); ++i) {
    if (routines[i].kind == ir::RoutineKind::main) routine_text(i);
  }
  bool selects = false;
  each_action(program(),
              [&selects](const ir::Action& a) { selects = selects || std::holds_alternative<ir::WorkOffset>(a.data); });
  if (!selects) {
    diagnostics().note("TRN-260", {},
                       "the program selects no work offset; LinuxCNC always has one in force (G54 at the start)",
                       "keep G54 at zero, or select an offset in the source");
  }
}

void Writer::routine_text(std::size_t index) {
  start_routine(index);
  offset_.clear();
  const ir::Routine& r = routine();
  const bool sub = r.kind == ir::RoutineKind::sub;
  if (!r.title.empty()) raw_line(comment(trim(r.title), style().comment, false, nullptr), r.header.span);
  if (sub) raw_line(sub_label(r.name) + " sub", r.header.span);
  for (const auto& c : r.header.comments) {
    if (c.text != r.title) raw_line(comment(c.text, style().comment, false, nullptr), r.header.span);
  }
  if (!sub && has_spindle_limit_) raw_line(std::string(spindle_limit_parameter) + " = 999999");
  body(r.body);
  finish_line();
  if (sub) raw_line(sub_label(r.name) + " endsub");
}

// ---- values --------------------------------------------------------------------------------------------------------

bool Writer::refused_problem(WordPos pos) {
  if (expressions_.take_tolerant() && !tolerance_noted_) {
    tolerance_noted_ = true;
    diagnostics().warning("TRN-261", current().line.span,
                          "LinuxCNC takes values as equal that differ by less than 0.0001 (EQ, NE); reported once for "
                          "the program",
                          "compare with a span of your own where such small differences count");
  }
  WordPos at;
  const std::string problem = expressions_.take_problem(&at);
  if (problem.empty()) return refused();
  refuse("TRN-203", at.column != 0 ? at : pos, problem);
  return true;
}

std::string Writer::value_text(const ir::ExprPtr& e, WordPos pos) {
  std::string text = expressions_.value(e);
  refused_problem(pos);
  return text;
}

std::string Writer::word(std::string_view address, const ir::Value& value, WordPos pos) {
  return std::string(address) + (value.literal() ? number_text(value) : value_text(value.expr, pos));
}

std::optional<std::string> Writer::condition(const ir::ExprPtr& e) {
  std::string text = expressions_.condition(e);
  if (refused_problem()) return std::nullopt;
  return text;
}

/// A parameter that is set in a line counts from the next line on: nothing may share its line.
bool Writer::joins(const ir::Statement& before, const ir::Statement& next) {
  return std::holds_alternative<ir::Block>(before.node) && std::holds_alternative<ir::End>(next.node);
}

void Writer::assign(const ir::Assign& a) {
  for (const ir::Assign::Item& item : a.items) {
    if (item.to_system) {
      return refuse(no_statement, item.pos,
                    "'" + item.system.text + "' is data of the source machine and is not written here");
    }
    next_line();
    const std::string name = expressions_.name(item.target);
    const std::string value = expressions_.value(item.value);
    if (refused_problem(item.pos)) return;
    if (name.size() + value.size() + 3 > dialects::linuxcnc::line_length)
      return refuse(no_statement, item.pos, "the expression does not fit into a line of the target",
                    "assign its parts to variables first");
    add(name + " = " + value, Rank::head, item.pos);
  }
}

// ---- structures ----------------------------------------------------------------------------------------------------

void Writer::if_else(const ir::If& i) {
  const auto text = condition(i.condition);
  if (!text) return refuse_structure({});
  const std::string label = next_label();
  next_line();
  add(label + " if " + *text, Rank::head);
  nested_body(i.then_body);
  if (i.has_else || !i.else_body.empty()) {
    keyword_line(i.else_line, label + " else");
    nested_body(i.else_body);
  }
  keyword_line(i.end_line, label + " endif");
}

void Writer::while_loop(const ir::While& w) {
  const auto text = condition(w.condition);
  if (!text) return refuse_structure({});
  loops_.push_back(next_label());
  next_line();
  add(loops_.back() + " while " + *text, Rank::head);
  nested_body(w.body);
  keyword_line(w.end_line, loops_.back() + " endwhile");
  loops_.pop_back();
}

void Writer::until_loop(const ir::Until& u) {
  const auto text = condition(ir::unary(ir::UnaryOp::logical_not, u.condition));
  if (!text) return refuse_structure({});
  loops_.push_back(next_label());
  next_line();
  add(loops_.back() + " do", Rank::head);
  nested_body(u.body);
  keyword_line(u.end_line, loops_.back() + " while " + *text);
  loops_.pop_back();
}

/// The counter is tested before each pass, against the end as it is then, and goes up (or down) behind it.
void Writer::for_loop(const ir::For& f) {
  const ir::ExprPtr step = f.step ? f.step : ir::number(1);
  const auto known = ir::constant_value(step);
  const ir::ExprPtr counter = ir::variable(f.counter);
  ir::ExprPtr go_on = ir::binary(known && *known < 0 ? ir::BinaryOp::ge : ir::BinaryOp::le, counter, f.to);
  if (!known) {
    const auto both = [&](ir::BinaryOp sign, ir::BinaryOp test) {
      return ir::binary(ir::BinaryOp::logical_and, ir::binary(sign, step, ir::number(0)),
                        ir::binary(test, counter, f.to));
    };
    go_on = ir::binary(ir::BinaryOp::logical_or, both(ir::BinaryOp::ge, ir::BinaryOp::le),
                       both(ir::BinaryOp::lt, ir::BinaryOp::ge));
  }
  const std::string name = expressions_.name(f.counter);
  const std::string from = expressions_.value(f.from);
  const std::string next = expressions_.value(ir::binary(ir::BinaryOp::add, counter, step));
  const auto text = condition(go_on);
  if (!text) return refuse_structure({});
  next_line();
  add(name + " = " + from, Rank::head);
  next_line();
  loops_.push_back(next_label());
  add(loops_.back() + " while " + *text, Rank::head);
  nested_body(f.body);
  raw_line(name + " = " + next, f.end_line.span);
  keyword_line(f.end_line, loops_.back() + " endwhile");
  loops_.pop_back();
}

void Writer::endless_loop(const ir::Loop& l) {
  loops_.push_back(next_label());
  next_line();
  add(loops_.back() + " while [1]", Rank::head);
  nested_body(l.body);
  keyword_line(l.end_line, loops_.back() + " endwhile");
  loops_.pop_back();
}

void Writer::exit_loop() {
  if (loops_.empty()) return refuse(no_statement, {}, "this leaves a loop that is not here");
  add(loops_.back() + " break", Rank::head);
}

void Writer::jump(const ir::Jump& /*j*/) {
  refuse("TRN-262", {}, "LinuxCNC has no jumps", "use IF, WHILE and subroutines in the source");
}

namespace {

bool contains(const ir::Body& body, std::uint32_t id) {
  return std::any_of(body.begin(), body.end(), [id](const ir::Statement& s) { return s.id == id; });
}
/// The body that holds both statements side by side.
const ir::Body* body_with(const ir::Routine& routine, std::uint32_t first, std::uint32_t last) {
  const ir::Body* found = contains(routine.body, first) && contains(routine.body, last) ? &routine.body : nullptr;
  const auto look = [&](const ir::Body& b) {
    if (contains(b, first) && contains(b, last)) found = &b;
  };
  ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
    if (const auto* i = std::get_if<ir::If>(&s.node)) {
      look(i->then_body);
      look(i->else_body);
    } else if (const auto* w = std::get_if<ir::While>(&s.node)) {
      look(w->body);
    } else if (const auto* u = std::get_if<ir::Until>(&s.node)) {
      look(u->body);
    } else if (const auto* f = std::get_if<ir::For>(&s.node)) {
      look(f->body);
    } else if (const auto* l = std::get_if<ir::Loop>(&s.node)) {
      look(l->body);
    }
  });
  return found;
}

}  // namespace

/// The blocks of the range, written again in a loop of their own.
void Writer::repeat(const ir::Repeat& r) {
  const ir::LabelTable labels(routine());
  const auto range = r.has_program || r.last.text.empty() || r.first.computed || r.last.computed
                         ? std::nullopt
                         : labels.range(r, labels.order(current().id));
  const bool whole = range && range->first.part == ir::SitePart::statement;
  const ir::Body* from = whole ? body_with(routine(), range->first.statement, range->second.statement) : nullptr;
  if (from == nullptr) return refuse(no_statement, {}, "this repeated part has no counterpart here");
  ir::Body& again = kept_.emplace_back();
  bool inside = false;
  for (const ir::Statement& s : *from) {
    inside = inside || s.id == range->first.statement;
    if (s.id == current().id) inside = false;
    if (inside) again.push_back(s);
    if (s.id == range->second.statement) break;
  }
  for (ir::Statement& s : again) s.line.comments.clear();
  const std::string count = r.count ? expressions_.condition(r.count) : "[1]";
  if (refused_problem()) return;
  if (repeating_ >= repeat_depth) return refuse(no_statement, {}, "repeated parts that repeat one another");
  const std::string label = next_label();
  next_line();
  add(label + " repeat " + count, Rank::head);
  ++repeating_;
  nested_body(again);
  --repeating_;
  raw_line(label + " endrepeat");
}

// ---- calls, ends, messages -----------------------------------------------------------------------------------------

void Writer::call(const ir::CallRoutine& c) {
  if (c.computed || c.tail || c.optional || c.has_range || !c.arguments.empty() || program().find(c.routine) == nullptr)
    return refuse(no_statement, {}, "this call has no counterpart here");
  const std::string text = sub_label(program().find(c.routine)->name) + " call";  // L70 and 70 are one program
  if (!c.count) return add(text, Rank::tail);
  const std::string count = expressions_.condition(c.count);
  if (refused_problem()) return;
  const std::string label = next_label();
  next_line();
  add(label + " repeat " + count, Rank::head);
  next_line();
  add(text, Rank::head);
  next_line();
  add(label + " endrepeat", Rank::head);
}

void Writer::return_from(const ir::Return& r) {
  if (!r.values.empty()) return refuse(no_statement, {}, "a return with values has no counterpart here");
  if (routine().kind != ir::RoutineKind::sub) return add("M2", Rank::tail);
  const bool last = !routine().body.empty() && &routine().body.back() == &current();
  if (!last) add(sub_label(routine().name) + " return", Rank::head);
}

void Writer::end_program(const ir::End& e) {
  if (e.returns_from_sub && routine().kind == ir::RoutineKind::sub) return return_from({});
  add("M2", Rank::tail);
}

void Writer::message(const ir::Message& m) {
  if (m.kind == ir::MessageKind::error)
    return refuse(no_statement, {}, "a message that ends the program with an error has no counterpart here");
  std::string text;
  for (const ir::ExprPtr& p : m.parts) {
    const auto* s = p ? std::get_if<ir::String>(&p->node) : nullptr;
    if (s == nullptr) return refuse(no_statement, {}, "a value inside a message has no counterpart here");
    text += s->text;
  }
  std::replace(text.begin(), text.end(), '(', '[');
  std::replace(text.begin(), text.end(), ')', ']');
  next_line();
  add("(MSG, " + text + ')', Rank::head);
  next_line();
}

}  // namespace cnctrans::backends::linuxcnc
