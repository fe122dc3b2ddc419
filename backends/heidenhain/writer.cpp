// Statements of conversational programs: files, labels, calls, jumps, assignments.
#include "backends/heidenhain/writer.h"

#include <algorithm>

#include "backends/common/comments.h"
#include "backends/heidenhain/tables.h"
#include "base/text.h"
#include "dialects/heidenhain/functions.h"
#include "dialects/heidenhain/limits.h"
#include "ir/edit/outside.h"

namespace cnctrans::backends::heidenhain {

namespace facts = dialects::heidenhain;

namespace {

constexpr std::string_view extension = ".H";

/// Letters, digits, - and _ : what the file system of the control takes.
std::string file_stem(std::string_view text) {
  std::string stem = to_upper_ascii(to_ascii(text, nullptr)).substr(0, facts::program_name_length);
  for (char& c : stem) {
    const bool good = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (!good) c = '_';
  }
  return stem.empty() ? "1" : stem;
}

/// The unit that the program works in; it says it once, before everything.
ir::Units unit_of(const ir::Program& program) {
  std::optional<ir::Units> found;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&found](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr || found) return;
      for (const auto& a : b->actions) {
        const auto* m = std::get_if<ir::ModalSet>(&a.data);
        if (m != nullptr && m->setting == ir::Setting::units) found = static_cast<ir::Units>(m->value);
      }
    });
  }
  return found.value_or(program.unit_hint);
}

std::vector<FileGroup> groups_of(const ir::Program& program, const WriteOptions& options) {
  return file_groups(program, file_order(program, program.dialect == dialect_name), options);
}

}  // namespace

Writer::Writer(const ir::Program& program, const WriteOptions& options, Diagnostics& diagnostics)
    : ProgramWriter(program, options, heidenhain::style, diagnostics),
      printer_(this->program()),
      names_(this->program(), groups_of(this->program(), options), labels()),
      tools_(this->program(), labels()),
      plan_(this->program(), labels()),
      unit_(unit_of(program) == ir::Units::inch ? "INCH" : "MM") {}

// ---- files ---------------------------------------------------------------------------------------------------------

void Writer::write_program() {
  const ir::Routine* main = program().main();
  std::string stem = options().main_stem;
  if (stem.empty() && main != nullptr)
    stem = main->name.text.empty() ? std::to_string(std::max<std::int64_t>(main->name.number, 1)) : main->name.text;
  bool first = true;
  for (const FileGroup& group : groups_of(program(), options())) {
    open_program(first ? free_stem(file_stem(stem), extension) : called_stem(group.routines.front()), first);
    for (const std::size_t i : group.routines) write_routine(i);
    close_program();
    first = false;
  }
}

void Writer::open_program(const std::string& stem, bool main) {
  stem_ = stem;
  open_file(stem + std::string(extension), main, stem);
  raw_line("BEGIN PGM " + stem + ' ' + unit_);
}

void Writer::close_program() {
  raw_line("END PGM " + stem_ + ' ' + unit_);
}

std::string Writer::called_stem(std::size_t routine) const {
  const ir::RoutineName& name = program().routines[routine].name;
  std::string stem = file_stem(name.text.empty() ? std::to_string(name.number) : name.text);
  if (iequals_ascii(stem, file_stem(options().main_stem))) stem = "SUB" + stem;
  return stem;
}

void Writer::write_routine(std::size_t index) {
  start_routine(index);
  forget_waiting();
  defined_.clear();
  const ir::Routine& r = routine();
  const auto note = [this](std::string_view text) {
    raw_line(comment(text, style().comment, same_dialect(), nullptr));
  };
  const bool sub = r.kind == ir::RoutineKind::sub;
  // A subprogram of another file is a program; its END PGM returns.
  const bool first_of_file = sub && r.name == program().routines[index].name && called_stem(index) == stem_;
  if (sub && !first_of_file) raw_line("LBL " + names_.of_routine(index), r.header.span);
  if (!r.title.empty()) note(r.title);
  for (const auto& c : r.header.comments) {
    if (c.text != r.title) note(c.text);
  }
  body(r.body);
  finish_line();
  say_waiting();
  finish_line();
  if (sub && !first_of_file) raw_line("LBL 0");
}

std::optional<std::size_t> Writer::callee(const ir::CallRoutine& c) const {
  for (std::size_t i = 0; i < program().routines.size(); ++i) {
    const ir::Routine& r = program().routines[i];
    if (r.name == c.routine && r.kind == ir::RoutineKind::sub && !ir::is_outside(r)) return i;
  }
  return std::nullopt;
}

// ---- lines ---------------------------------------------------------------------------------------------------------

std::string Writer::label_text(const ir::LineInfo& info) {
  std::string text;
  const auto add_label = [&](const std::string& name) {
    if (!name.empty()) text += "LBL " + name + '\n';
  };
  if (!info.number.empty()) add_label(names_.of(routine_index(), info.number, true));
  for (const std::string_view l : info.labels) add_label(names_.of(routine_index(), l, false));
  return text;
}

bool Writer::is_join(const ir::LineInfo& info) const {
  if (!info.number.empty() && labels().is_target(routine_index(), info.number)) return true;
  return std::any_of(info.labels.begin(), info.labels.end(),
                     [this](std::string_view l) { return labels().is_target_name(routine_index(), l); });
}

/// What waits for a move is said before control goes elsewhere or comes in from there.
void Writer::before_statement(const ir::Statement& next) {
  const bool leads_on =
      std::holds_alternative<ir::Block>(next.node) || std::holds_alternative<ir::Message>(next.node) ||
      std::holds_alternative<ir::Label>(next.node) || std::holds_alternative<ir::Declare>(next.node) ||
      (std::holds_alternative<ir::Assign>(next.node) && (!feed_ || feed_->find('Q') == std::string::npos));
  const bool alone = !is_join(next.line) && !changes_branch(next);
  if (!alone || std::holds_alternative<ir::CallRoutine>(next.node) || std::holds_alternative<ir::Repeat>(next.node))
    defined_.clear();
  // A parameter in the definition was read when it was made.
  const bool reads = defined_.find("=+Q") != std::string::npos || defined_.find("=-Q") != std::string::npos;
  if (reads && std::holds_alternative<ir::Assign>(next.node)) defined_.clear();
  if (leads_on && alone) return;
  finish_line();
  if (std::holds_alternative<ir::End>(next.node) && alone) feed_.reset();
  say_waiting();
  finish_line();
}

bool Writer::joins(const ir::Statement& before, const ir::Statement& next) {
  return same_dialect() && ProgramWriter::joins(before, next);
}

std::string Writer::take_waiting() {
  if (!feed_ && !side_) return {};
  std::string text = "L";
  if (side_) {
    if (*side_ != ir::CompSide::off) {
      diagnostics().error(no_word, current().line.span,
                          "radius compensation begins here without a move of its own: a straight move must begin it",
                          "write G41 or G42 in the block of the straight move to the contour");
    }
    text += " R0";
  }
  if (feed_) text += " F" + *feed_;
  forget_waiting();
  return text;
}

void Writer::say_waiting() {
  if (const std::string text = take_waiting(); !text.empty()) raw_line_in_branch(text, current().line.span);
}

// ---- statements ----------------------------------------------------------------------------------------------------

void Writer::assign(const ir::Assign& a) {
  for (const auto& item : a.items) {
    if (item.to_system)
      return refuse(no_statement, item.pos,
                    "'" + item.system.text + "' is data of the source machine and is not written here");
    const std::string target = expression_text(ir::variable(item.target), item.pos);
    const auto* unary = std::get_if<ir::Unary>(&item.value->node);
    const bool plain = Expressions::is_plain(item.value) && unary == nullptr;
    const std::string text = plain ? "FN 0: " + target + " = " + condition_operand(item.value)
                                   : target + " = " + expression_text(item.value, item.pos);
    next_line();
    add(text, Rank::head);
  }
}

std::string Writer::condition_operand(const ir::ExprPtr& e) {
  std::string text = printer_.operand_of_fn(e);
  const std::string problem = printer_.take_problem();
  if (!problem.empty()) refuse("TRN-203", e ? e->pos : WordPos{}, problem);
  return text;
}

void Writer::jump(const ir::Jump& j) {
  if (const std::string text = take_waiting(); !text.empty()) {  // the jump stands in a line behind something else
    add(text, Rank::head);
    next_line();
  }
  if (j.target.computed) return refuse(no_statement, {}, "a jump to a computed label has no counterpart here");
  const std::string label = names_.of(routine_index(), j.target.text, j.target.is_number);
  if (label.empty()) return refuse(no_statement, {}, "the label of this jump stands nowhere");
  const std::string target = " GOTO LBL " + label;
  if (!j.condition) return add("FN 9: IF +0 EQU +0" + target, Rank::tail);
  const auto* b = std::get_if<ir::Binary>(&j.condition->node);
  if (b == nullptr || !ir::is_comparison(b->op))
    return refuse(no_statement, j.condition->pos, "a condition compares a parameter with a number or a parameter here");
  const auto one = [&](ir::BinaryOp op) {
    const auto* row = facts::jump_row(op);
    add("FN " + std::to_string(row->number) + ": IF " + condition_operand(b->left) + ' ' + std::string(row->word) +
            ' ' + condition_operand(b->right) + target,
        Rank::tail);
  };
  if (b->op != ir::BinaryOp::le && b->op != ir::BinaryOp::ge) return one(b->op);
  one(b->op == ir::BinaryOp::le ? ir::BinaryOp::lt : ir::BinaryOp::gt);  // there is no <= and >=
  next_line();
  one(ir::BinaryOp::eq);
}

void Writer::repeat(const ir::Repeat& r) {
  const auto count = ir::constant_value(r.count);
  const std::string label = names_.of(routine_index(), r.first.text, r.first.is_number);
  if (r.first.computed || label.empty() || r.has_program || r.curve_use != ir::CurveUse::none ||
      (r.count && (!count || *count < 1)))
    return refuse(no_statement, {}, "this repetition has no counterpart here");
  if (!r.last.text.empty()) {  // a part that ends with LBL 0
    if (count.value_or(1) != 1 || names_.of(routine_index(), r.last.text, r.last.is_number) != "0")
      return refuse(no_statement, {}, "this repetition has no counterpart here");
    return add("CALL LBL " + label, Rank::tail);
  }
  const std::string times = shortest(count.value_or(1));
  add("CALL LBL " + label + " REP " + times, Rank::tail);
}

void Writer::call(const ir::CallRoutine& c) {
  const auto routine = callee(c);
  if (c.computed || !c.arguments.empty() || c.tail || c.has_range || c.count)
    return refuse(no_statement, {}, "this form of a call has no counterpart here");
  if (routine && names_.in_file_of(routine_index(), *routine))
    return add("CALL LBL " + names_.of_routine(*routine), Rank::tail);
  const std::string name = c.routine.text.empty() ? std::to_string(c.routine.number) : c.routine.text;
  add("CALL PGM " + (routine ? called_stem(*routine) : file_stem(name)), Rank::tail);
}

void Writer::return_from(const ir::Return& r) {
  if (!r.values.empty()) return refuse(no_statement, {}, "a return with values has no counterpart here");
  const ir::Body& text = routine().body;
  if (text.empty() || text.back().id != current().id)
    refuse(no_statement, {}, "a subprogram returns at its last block only");
}

void Writer::end_program(const ir::End& /*e*/) {
  add("M30", Rank::tail);
}

/// The control shows no text of a program: it stays as a remark, where the programmer reads it. An error stops the run.
void Writer::message(const ir::Message& m) {
  if (m.kind == ir::MessageKind::clear) return;
  std::string text;
  for (const auto& p : m.parts) {
    const auto* s = p ? std::get_if<ir::String>(&p->node) : nullptr;
    if (s == nullptr) return refuse(no_statement, {}, "a value inside a message has no counterpart here");
    text += s->text;
  }
  if (m.kind == ir::MessageKind::error)
    return refuse(no_statement, {}, "an error that stops the program with a text of its own has no counterpart here",
                  "write FN 14: ERROR with the number of a text of the control");
  diagnostics().warning("TRN-270", current().line.span,
                        "the control shows no text of a program: '" + text + "' is kept as a remark",
                        "write STOP behind it where the operator has to read it");
  if (!text.empty()) add(comment(text, style().comment, same_dialect(), nullptr), Rank::head);
}

}  // namespace cnctrans::backends::heidenhain
