#include "backends/fagor/writer.h"

#include <algorithm>
#include <cmath>

#include "backends/common/comments.h"
#include "backends/common/waiting_offset.h"
#include "backends/fagor/file_labels.h"
#include "backends/fagor/tables.h"
#include "base/text.h"
#include "dialects/fagor/limits.h"
#include "ir/edit/file_line.h"
#include "ir/edit/search.h"

namespace cnctrans::backends::fagor {
namespace {

namespace facts = dialects::fagor;

bool is_trivia(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  return b != nullptr && b->empty() && s.line.number.empty() && s.line.labels.empty();
}

/// The last statement that does something; null: none.
const ir::Statement* last_statement(const ir::Body& body) {
  for (auto s = body.rbegin(); s != body.rend(); ++s) {
    if (!is_trivia(*s)) return &*s;
  }
  return nullptr;
}

bool leaves(const ir::Statement* s) {
  if (s == nullptr || s->line.skip_mask != 0) return false;
  const auto* j = std::get_if<ir::Jump>(&s->node);
  return std::holds_alternative<ir::End>(s->node) || (j != nullptr && !j->condition);
}

}  // namespace

Writer::Writer(const ir::Program& program, const WriteOptions& options, const Style& style, Diagnostics& diagnostics)
    : ProgramWriter(program, options, style, diagnostics),
      lathe_(options.profile->kind == machine::Kind::lathe),
      printer_(this->program(), lathe_, number_format()) {
  has_surfaces_ = lathe_ && ir::any_action(program, [](const ir::Action& a) {
                    return std::holds_alternative<ir::SurfaceSet>(a.data);
                  });
  has_cycles_ = !same_dialect() && ir::any_action(program, [](const ir::Action& a) {
    return std::holds_alternative<ir::CycleDefine>(a.data);
  });
  has_tool_changes_ = !same_dialect() && ir::any_action(program, [](const ir::Action& a) {
    return std::holds_alternative<ir::ToolChange>(a.data);
  });
  if (has_tool_changes_) waiting_ = offsets_that_wait(this->program());
}

// ---- file frame ----------------------------------------------------------------------------------------------------

void Writer::write_program() {
  const std::string wanted = file_name(program(), options(), lathe_);
  const std::string name = free_file_name(wanted, options());
  if (name != wanted) note_taken(wanted, name);
  open_file(name, true);
  if (program().routines.empty()) return;
  const ir::Routine& first = program().routines[0];
  const bool has_main = first.kind == ir::RoutineKind::main;
  const std::vector<FileGroup> groups = file_groups(program(), file_order(program(), same_dialect()), options());
  const std::vector<std::size_t>& order = groups.front().routines;
  const auto local = [&](std::size_t i) {
    return same_dialect() && program().routines[i].locality == ir::Locality::file_local;
  };
  const std::string raw(trim(source_line(first.header.span)));
  const bool raw_header = same_dialect() && !raw.empty() && raw.front() == '%';
  const bool only_start_mark = raw_header && !first.header_text.empty() && raw == first.header_text;
  if (!only_start_mark) {
    const std::string header = raw_header ? raw : header_line(program(), options());
    if (!header.empty()) raw_line(header, first.header.span);
  }
  for (const std::size_t i : order) {
    if (local(i)) write_routine(i);
  }
  if (same_dialect() && !first.header_text.empty()) raw_line(first.header_text, first.header.span);
  if (has_main) write_main(0);
  for (const std::size_t i : order) {
    if ((i != 0 || !has_main) && !local(i)) write_routine(i);
  }
  finish_line();
  const auto& files = program().files;
  if (same_dialect() && !files.empty() && files[0].trailer == "%") raw_line("%");
  for (std::size_t i = 1; i < groups.size(); ++i) write_called(groups[i], name);
}

/// A file of subroutines: its own name and header on the same control, else those of its first subroutine.
void Writer::write_called(const FileGroup& group, const std::string& main_file) {
  const ir::Routine& first = program().routines[group.routines.front()];
  const Span at = first.header.span.known() || first.body.empty() ? first.header.span : first.body.front().line.span;
  std::string name = called_file_name(first, same_dialect() ? group.stem : std::string{}, lathe_);
  if (name == main_file || options().mains.contains(name))
    name = called_file_name(first, "1" + name.substr(1, name.find('.') - 1), lathe_);
  open_file(name, false);
  const std::string raw(trim(source_line({at.file, 1, 1, 1, 1})));
  if (!same_dialect()) {
    raw_line(called_header_line(first), first.header.span);
  } else if (raw.starts_with('%')) {
    raw_line(raw);
  }
  for (const std::size_t i : group.routines) write_routine(i);
  finish_line();
}

void Writer::write_main(std::size_t index) {
  start_routine(index);
  const ir::Body& statements = routine().body;
  body(statements);
  finish_line();
  if (!same_dialect() && !leaves(last_statement(statements))) raw_line("M30");
}

/// `(SUB n)` ... `(RET)`. Comments that stand before the line of SUB in the source are written before it.
void Writer::write_routine(std::size_t index) {
  start_routine(index);
  const ir::Routine& r = routine();
  std::size_t before = 0;
  const bool placed = same_dialect() && r.header.span.known();
  while (placed && before < r.body.size() && is_trivia(r.body[before]) &&
         r.body[before].line.span.line < r.header.span.line) {
    ++before;
  }
  const auto split = r.body.begin() + static_cast<std::ptrdiff_t>(before);
  // The line written last is finished while its statement is still there.
  if (before != 0) {
    const ir::Body front(r.body.begin(), split);
    body(front);
    finish_line();
  }
  ir::LineInfo line = r.header;
  const bool local = same_dialect() && r.locality == ir::Locality::file_local;
  const std::string name = r.title.empty() ? r.name.text : r.title;
  const bool named = !same_dialect() && !name.empty() && line.comments.empty();
  if (named) line.comments.push_back({name, ir::CommentPlace::end_of_line, {}});
  begin_line(line);
  if (r.name.number < 0) {
    refuse("TRN-241", {}, "the subroutine '" + name + "' has no number",
           "subroutines of the target have a number from 0 to 9999");
  }
  add((local ? "(LSUB " : "(SUB ") + std::to_string(r.name.number) + ')', Rank::head);
  finish_line();
  if (before != 0) {
    const ir::Body rest(split, r.body.end());
    body(rest);
    finish_line();
  } else {
    body(r.body);
  }
  finish_line();
  const ir::Statement* last = last_statement(r.body);
  const bool returns = last != nullptr && std::holds_alternative<ir::Return>(last->node);
  if (!returns || last->line.skip_mask != 0) raw_line("(RET)");
}

// ---- statements ----------------------------------------------------------------------------------------------------

/// What the block before has done holds only when a branch on a switch neither begins nor ends behind it.
void Writer::before_statement(const ir::Statement& next) {
  if (changes_branch(next)) after_offset_ = false;
}

/// Words share a line with words only; ( ) statements stand alone.
bool Writer::joins(const ir::Statement& before, const ir::Statement& next) {
  if (!std::holds_alternative<ir::Block>(before.node)) return false;
  if (std::holds_alternative<ir::End>(next.node)) return true;
  return same_dialect() && std::holds_alternative<ir::Block>(next.node);
}

void Writer::statement_line(const std::string& text) {
  after_offset_ = false;
  add('(' + text + ')', Rank::head);
}

void Writer::text_problem(std::string what) {
  refuse("TRN-203", {}, std::move(what));
}

std::string Writer::assignments(const ir::Assign& a, std::size_t from, std::size_t to) {
  std::string text;
  for (std::size_t i = from; i < to; ++i) {
    const auto& item = a.items[i];
    ir::Expr target;
    if (item.to_system) {
      target.node = item.system;
    } else {
      target.node = item.target;
    }
    target.pos = item.pos;
    if (i != from) text += ", ";
    text += expression_text(std::make_shared<const ir::Expr>(std::move(target)), item.pos);
    text += '=' + expression_text(item.value, item.pos);
  }
  return text;
}

/// Local parameters keep the letters of the source.
void Writer::keep_letters() {
  if (same_dialect()) printer_.set_source(source_line(current().line.span));
}

void Writer::assign(const ir::Assign& a) {
  keep_letters();
  constexpr auto most = static_cast<std::size_t>(facts::max_assignments);
  for (std::size_t from = 0; from < a.items.size(); from += most) {
    next_line();
    statement_line(assignments(a, from, std::min(a.items.size(), from + most)));
  }
}

std::string Writer::jump_text(const ir::Jump& j) {
  if (j.search != ir::Search::whole_first || j.quiet) {
    refuse("TRN-206", {},
           "a jump that searches its label in one direction, or goes on without it, has no counterpart here");
  }
  if (!j.target.computed) {
    if (!j.target.is_number) text_problem("the jump target '" + j.target.text + "' is no block number");
    return "GOTO " + number_target(j.target);
  }
  const std::string parameter = printer_.parameter(j.target.computed);
  if (!parameter.empty() && parameter.front() != '-') return "GOTO N" + parameter;
  return "GOTO N(" + expression_text(j.target.computed) + ')';
}

void Writer::jump(const ir::Jump& j) {
  keep_letters();
  const std::string text = jump_text(j);
  if (!j.condition) return statement_line(text);
  const std::string condition = printer_.condition(j.condition);
  WordPos at;
  if (const std::string problem = printer_.take_problem(&at); !problem.empty()) refuse("TRN-203", at, problem);
  statement_line("IF " + condition + ' ' + text);
}

/// One action of an IF: assignments or one statement, never ISO words.
std::string Writer::action_text(const ir::Body& statements) {
  std::string text;
  for (const ir::Statement& s : statements) {
    std::string one;
    if (const auto* a = std::get_if<ir::Assign>(&s.node)) {
      one = assignments(*a, 0, a->items.size());
    } else if (statements.size() > 1) {
      text_problem("an action of IF is one statement, or assignments only");
    } else if (const auto* j = std::get_if<ir::Jump>(&s.node); j != nullptr && !j->condition) {
      one = jump_text(*j);
    } else if (const auto* c = std::get_if<ir::CallRoutine>(&s.node)) {
      one = call_text({}, *c);
    } else if (const auto* m = std::get_if<ir::Message>(&s.node)) {
      one = message_text(*m);
    } else if (const auto* r = std::get_if<ir::Repeat>(&s.node); r != nullptr && !r->count) {
      one = range_text(*r);
    } else if (const auto* t = std::get_if<ir::ModalCall>(&s.node); t != nullptr && (t->off || t->here)) {
      one = t->off ? "MDOFF" : call_text("MCALL", t->call);
    } else if (std::holds_alternative<ir::Return>(s.node) && same_dialect()) {
      one = "RET";
    } else {
      text_problem("this can't be the action of an IF");
    }
    text += (text.empty() ? "" : ", ") + one;
  }
  return text;
}

/// An IF whose action is kept as text is kept whole.
void Writer::unread_structure(const ir::Statement& s, const ir::Opaque& text) {
  const auto* i = std::get_if<ir::If>(&s.node);
  if (!same_dialect() || i == nullptr || !i->one_line) return ProgramWriter::unread_structure(s, text);
  opaque(text);
}

void Writer::if_else(const ir::If& i) {
  for (const auto* statements : {&i.then_body, &i.else_body}) {
    for (const ir::Statement& s : *statements) {
      const auto* o = std::get_if<ir::Opaque>(&s.node);
      if (o != nullptr && i.one_line) return opaque(*o);  // its text is the whole statement
    }
  }
  if (!i.one_line || i.then_body.empty()) return ProgramWriter::if_else(i);
  keep_letters();
  std::string text = "IF " + printer_.condition(i.condition) + ' ' + action_text(i.then_body);
  if (const std::string problem = printer_.take_problem(); !problem.empty()) text_problem(problem);
  if (!i.else_body.empty()) text += " ELSE " + action_text(i.else_body);
  statement_line(text);
  finish_line();
  nested_body({});  // a call inside may have changed every setting: nothing is known any more
}

namespace {
/// A program is named by its number; empty: this is none.
std::string number_of_program(const ir::RoutineName& name) {
  if (name.number >= 0) return std::to_string(name.number);
  return name.text.find_first_not_of("0123456789") == std::string::npos ? name.text : std::string{};
}
}  // namespace

std::string Writer::range_text(const ir::Repeat& r) {
  if (r.search != ir::Search::whole_first || r.first.computed || r.last.computed || r.last.text.empty()) {
    text_problem("this way to name a repeated range of blocks has no counterpart here");
    return {};
  }
  if (!r.first.is_number || !r.last.is_number) text_problem("the ends of a repeated range must be block numbers here");
  std::string text = "RPT ";
  if (r.has_program) {
    if (!same_dialect()) text_problem("repeating blocks of another program has no counterpart here");
    const std::string number = number_of_program(r.program);
    if (number.empty()) text_problem("the program of the repeated range has no number");
    text += 'N' + r.first.text + ",N" + r.last.text + ",P" + number;
  } else {
    text += number_target(r.first);
    text += ',' + number_target(r.last);
  }
  return text;
}

void Writer::repeat(const ir::Repeat& r) {
  statement_line(range_text(r));
  if (!r.count) return;
  if (const auto* n = std::get_if<ir::Number>(&r.count->node)) {
    const bool whole =
        n->value >= 0 && n->value <= static_cast<double>(facts::max_repeat) && n->value == std::floor(n->value);
    if (!whole) return refuse("TRN-203", {}, "a repeat count is a whole number from 0 to 9999");
    if (n->value != 1 || same_dialect()) add('N' + shortest(n->value), Rank::tail);
    return;
  }
  const std::string parameter = printer_.parameter(r.count);
  if (parameter.empty()) return refuse("TRN-203", {}, "a repeat count is a number or a parameter here");
  add('N' + parameter, Rank::tail);
}

std::string Writer::argument_text(const ir::Argument& a) {
  if (a.name.size() != 1 || a.name[0] < 'A' || a.name[0] > 'Z' || a.by_reference) {
    text_problem("the argument '" + a.name + "' has no letter: arguments are local parameters A to Z here");
    return {};
  }
  const std::string value = expression_text(a.value, a.value->pos);
  const bool constant = plain_number(value);
  return a.name + (constant ? "" : "=") + value;
}

/// `EXEC P12`: the source ran a program and not a subroutine (12.8), and that program is not written with this one.
bool Writer::runs_program(const ir::CallRoutine& c, std::string_view keyword) const {
  const bool plain = c.arguments.empty() && c.level == ir::CallLevel::shared;
  if (!same_dialect() || !plain || (!c.computed && program().find(c.routine) != nullptr)) return false;
  const std::string source = to_upper_ascii(source_line(current().line.span));
  const auto at = source.find(keyword);
  return at != std::string::npos && (at == 0 || std::isalpha(static_cast<unsigned char>(source[at - 1])) == 0);
}

/// `keyword` empty: CALL, or PCALL when the callee has a level of its own.
std::string Writer::call_text(std::string_view keyword, const ir::CallRoutine& c) {
  const std::string_view whole = keyword.empty() ? "EXEC" : "MEXEC";
  if (runs_program(c, whole)) {
    const auto* number = c.computed ? std::get_if<ir::Call>(&c.computed->node) : nullptr;
    const bool named = number != nullptr && number->function == ir::Function::to_string;
    return std::string(whole) + " P" +
           (c.computed ? '(' + expression_text(named ? number->args[0] : c.computed) + ')'
                       : number_of_program(c.routine));
  }
  const bool level = c.level == ir::CallLevel::new_level;
  std::string text(!keyword.empty() ? keyword : level ? "PCALL" : "CALL");
  text += ' ';
  if (c.computed) {
    const std::string parameter = printer_.parameter(c.computed);
    text += !parameter.empty() && parameter.front() != '-' ? parameter : '(' + expression_text(c.computed) + ')';
  } else if (c.routine.number >= 0) {
    text += std::to_string(c.routine.number);
  } else {
    text_problem("the called subroutine '" + c.routine.text + "' has no number");
  }
  const auto* count = c.count ? std::get_if<ir::Number>(&c.count->node) : nullptr;
  if (c.count && (count == nullptr || count->value != 1)) text_problem("a call with a count has no counterpart here");
  if (c.has_range) text_problem("a call of some blocks of a program has no counterpart here");
  if (c.tail || c.optional) text_problem("this kind of call has no counterpart here");
  if (!level && !c.arguments.empty()) text_problem("arguments need local parameters of the subroutine's own");
  for (const ir::Argument& a : c.arguments) {
    if (a.value) text += ", " + argument_text(a);
  }
  return text;
}

/// `G180 A5`: the source wrote the call as a G function (18.2).
bool Writer::written_as_g_call(const ir::CallRoutine& c) const {
  const facts::GCode* code =
      c.computed
          ? nullptr
          : facts::find_g(static_cast<int>(std::clamp<std::int64_t>(c.routine.number, -1, facts::max_g_code)), lathe_);
  if (!same_dialect() || code == nullptr || code->use != facts::Use::call) return false;
  const std::string source = source_line(current().line.span);
  return !source.empty() && source.find('(') == std::string::npos;
}

void Writer::g_call(const ir::CallRoutine& c) {
  add('G' + std::to_string(c.routine.number), Rank::setting);
  for (const ir::Argument& a : c.arguments) {
    if (a.value) add(argument_text(a), Rank::coordinate);
  }
}

void Writer::call(const ir::CallRoutine& c) {
  keep_letters();
  if (written_as_g_call(c)) return g_call(c);
  statement_line(call_text({}, c));
}

void Writer::modal_call(const ir::ModalCall& c) {
  if (c.off) return statement_line("MDOFF");
  if (c.cycle || !c.here) {
    return refuse("TRN-201", {}, "a modal call that does not run at its own block has no counterpart here",
                  "call the subroutine after each motion");
  }
  statement_line(call_text("MCALL", c.call));
}

void Writer::return_from(const ir::Return& r) {
  if (!r.values.empty() || routine().kind == ir::RoutineKind::main) return ProgramWriter::return_from(r);
  statement_line("RET");
}

void Writer::end_program(const ir::End& e) {
  if (e.returns_from_sub && routine().kind != ir::RoutineKind::main)
    return same_dialect() ? statement_line("RET") : ProgramWriter::end_program(e);
  add(same_dialect() && !e.text.empty() ? std::string(e.text) : "M30", Rank::tail);
}

/// Numbers of user alarms elsewhere start at 65000: the same number counted from 0 (equivalences 3.2).
std::string Writer::error_number(const ir::ExprPtr& number) {
  constexpr double first_user_alarm = 65000, last_user_alarm = 69999;
  const auto value = ir::constant_value(number);
  const bool alarm = !same_dialect() && value && *value >= first_user_alarm && *value <= last_user_alarm;
  return expression_text(alarm ? ir::number(*value - first_user_alarm) : number);
}

std::string Writer::message_text(const ir::Message& m) {
  if (!m.file_line.empty()) return m.file_line;
  std::string text;
  bool changed = false;
  for (const ir::ExprPtr& part : m.parts) {
    if (!part) continue;
    if (const auto* s = std::get_if<ir::String>(&part->node)) {
      std::string piece = same_dialect() ? s->text : to_ascii(s->text, &changed);
      for (std::size_t i = 0; i < piece.size(); ++i) {
        char& c = piece[i];
        const bool value = c == '?' && i + 1 < piece.size() && (piece[i + 1] == 'P' || piece[i + 1] == 'p');
        if (c == '"') c = '\'';
        if (same_dialect() || (c != '$' && !value)) continue;
        changed = true;
        c = ' ';
      }
      text += piece;
    } else if (const std::string p = printer_.parameter(part); !p.empty() && p.front() != '-') {
      text += '?' + p;
    } else if (const auto v = ir::constant_value(part)) {
      text += shortest(*v);
    } else {
      text_problem("a message shows parameters only");
    }
  }
  if (changed) {
    diagnostics().warning("TRN-213", current().line.span,
                          "characters of this message do not exist on the target and are replaced");
  }
  if (m.kind == ir::MessageKind::clear && text.empty()) text = " ";
  if (!same_dialect() && text.size() > static_cast<std::size_t>(facts::max_message)) {
    diagnostics().warning("TRN-213", current().line.span,
                          "the message is cut to the 59 characters that the target shows");
    text.resize(static_cast<std::size_t>(facts::max_message));
  }
  if (m.kind != ir::MessageKind::error) return "MSG \"" + text + '"';
  std::string out = "ERROR ";
  if (m.number) out += error_number(m.number);
  if (m.number && !m.parts.empty()) out += ", ";
  if (!m.parts.empty()) out += '"' + text + '"';
  return out;
}

void Writer::message(const ir::Message& m) {
  statement_line(message_text(m));
}

}  // namespace cnctrans::backends::fagor
