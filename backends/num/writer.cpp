// Statements of NUM programs: headers, assignments, G79, G77, messages.
#include "backends/num/writer.h"

#include <algorithm>
#include <charconv>

#include "backends/common/comments.h"
#include "backends/num/data_names.h"
#include "backends/num/style.h"
#include "base/text.h"
#include "dialects/num/limits.h"
#include "dialects/num/variables.h"

namespace cnctrans::backends::num {

namespace facts = dialects::num;
constexpr std::string_view no_statement = "TRN-201";

Writer::Writer(const ir::Program& program, const WriteOptions& options, Diagnostics& diagnostics)
    : ProgramWriter(program, options, num::style(), diagnostics),
      own_options_(facts::options_of(profile())),
      printer_(program, expression_style(), NumberFormat{8, 8, program.dialect == "num"}) {}

std::int64_t Writer::main_number() const {
  const ir::Routine* main = program().main();
  if (main != nullptr && main->name.number >= facts::program_min && main->name.number <= facts::program_max)
    if (same_dialect() || !options().is_taken('%' + std::to_string(main->name.number))) return main->name.number;
  std::int64_t n = 0;
  const std::string& stem = options().main_stem;
  std::from_chars(stem.data(), stem.data() + stem.size(), n);
  const auto taken = [this](std::int64_t number) {
    if (options().is_taken('%' + std::to_string(number))) return true;
    for (const auto& r : program().routines) {
      if (r.name.number == number) return true;
    }
    return false;
  };
  if (n < facts::program_min || n > facts::program_max || taken(n)) {
    n = 1;
    while (taken(n)) ++n;
  }
  return n;
}

/// The block switches to constant cutting speed.
bool Writer::begins_css() const {
  const auto* b = std::get_if<ir::Block>(&current().node);
  return b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), [](const ir::Action& a) {
           const auto* m = std::get_if<ir::ModalSet>(&a.data);
           return m != nullptr && m->setting == ir::Setting::spindle_mode &&
                  m->value == code_value(ir::SpindleMode::css);
         });
}

/// G97 behind G96 without a speed: that the present one goes on is said of the source's control only.
void Writer::freezes_speed(const ir::Action& a, const ir::ModalSet& m) {
  if (m.setting != ir::Setting::spindle_mode) return;
  const bool ends = m.value == code_value(ir::SpindleMode::rpm) && css_;
  const bool perhaps = css_ && current().line.skip_mask != 0;
  css_ = perhaps || m.value == code_value(ir::SpindleMode::css);
  const auto* b = std::get_if<ir::Block>(&current().node);
  if (same_dialect() || b == nullptr || !ends) return;
  const bool speed = std::any_of(b->actions.begin(), b->actions.end(),
                                 [](const ir::Action& x) { return std::holds_alternative<ir::SetSpindle>(x.data); });
  if (speed) return;
  diagnostics().warning("TRN-477", span_of(a.pos),
                        "G97 without S: the source goes on at the speed that constant cutting speed has reached; that "
                        "this control does so is not stated",
                        "write the speed with S");
}

void Writer::write_program() {
  const std::string stem = options().main_stem.empty() ? std::to_string(main_number()) : options().main_stem;
  open_file(free_stem(stem, ".xpi") + ".xpi", true, '%' + std::to_string(main_number()));
  const ir::Routine* main = program().main();
  for (const FileGroup& group : file_groups(program(), file_order(program(), same_dialect()), options())) {
    if (!group.stem.empty()) open_called(group, stem);
    for (const std::size_t i : group.routines) {
      const ir::Routine& r = program().routines[i];
      write_routine(i, &r == main ? main_number() : r.name.number);
    }
  }
}

/// The file of called programs: its own name on the same control, else that of its first program.
void Writer::open_called(const FileGroup& group, const std::string& main_stem) {
  const std::string number = std::to_string(program().routines[group.routines.front()].name.number);
  std::string stem = same_dialect() ? group.stem : number;
  if (iequals_ascii(stem, main_stem)) stem = "SUB" + stem;
  open_file(stem + ".xpi", false, '%' + number);
}

void Writer::write_routine(std::size_t index, std::int64_t number) {
  start_routine(index);
  const ir::Routine& r = routine();
  const bool headless = same_dialect() && !r.header.span.known();
  if (!headless) {
    std::string head = same_dialect() && !r.name.text.empty() ? "%" + r.name.text : "%" + std::to_string(number);
    const std::size_t comments = head.size();
    if (!r.title.empty()) head += ' ' + comment(r.title, style().comment, same_dialect(), nullptr);
    for (const auto& c : r.header.comments) {
      const std::string text = comment(c.text, style().comment, same_dialect(), nullptr);
      if (c.text != r.title) head += ' ' + text;
    }
    raw_line(wrapped(head, comments, style().comment, same_dialect() ? 0 : style().line_length), r.header.span);
  }
  // Declarations in a row stand between VAR and ENDV.
  const auto declares = [&r](std::size_t i) {
    return i < r.body.size() && std::holds_alternative<ir::Declare>(r.body[i].node);
  };
  for (std::size_t i = 0; i < r.body.size(); ++i) {
    if (!declares(i)) continue;
    if (i == 0 || !declares(i - 1)) declares_first_.insert(r.body[i].id);
    if (!declares(i + 1)) declares_last_.insert(r.body[i].id);
  }
  body(r.body);
}

/// Inch words have one place more than metric ones.
std::string Writer::decimals(const ir::Value& value) {
  if (same_dialect() || setting(ir::Setting::units) != code_value(ir::Units::inch)) return number_text(value);
  constexpr std::int32_t places = facts::linear_decimals_inch;
  std::string text;
  const double change = append_number(text, value.number, value.text, NumberFormat{places, places, false});
  if (change != 0 && !inch_rounding_noted_) {
    inch_rounding_noted_ = true;
    diagnostics().warning("TRN-210", current().line.span,
                          "inch words with more than 4 decimals are rounded for the target: each changes by at most "
                          "0.00005 (reported once for the program)",
                          "translate a metric program where that is too much");
  }
  return text;
}

bool Writer::increment(const ir::CoordWord& w) {
  if (w.mode != ir::WordMode::modal) return w.mode == ir::WordMode::incremental;
  return setting(ir::Setting::distance) == code_value(ir::Distance::incremental);
}

std::string Writer::word(std::string_view address, const ir::Value& value, WordPos pos) {
  std::string text(address);
  if (value.literal()) return text + decimals(value);
  const std::string expression = expression_text(value.expr, pos);
  // A word takes a number or one variable with a sign; X L6, X-L6.
  if (expression.empty() || expression.front() == '-' || expression.front() == '[') return text + expression;
  return text + ' ' + expression;
}

// ---- assignments and declarations
// ------------------------------------------------------------------------------------

std::string Writer::target_variable(const ir::VarRef& v) {
  return expression_text(ir::variable(v));
}

namespace {

/// Offsets and lengths are carried in mm and degrees; the E parameter has the number before the division.
ir::ExprPtr in_machine_units(const ir::ExprPtr& value) {
  const auto* b = value ? std::get_if<ir::Binary>(&value->node) : nullptr;
  if (b == nullptr || b->op != ir::BinaryOp::divide) return value;
  const auto* n = std::get_if<ir::Number>(&b->right->node);
  const bool unit = n != nullptr && n->text.empty() && n->value > 1;
  return unit ? b->left : value;
}

}  // namespace

namespace {

/// What the control does by itself: E7x001 after an interruptible block (G10), E6x000 after G92.
bool is_latch(const ir::Assign::Item& item) {
  bool found = false;
  ir::walk(item.value, [&found](const ir::ExprPtr& e) {
    const auto* from = std::get_if<ir::SystemRef>(&e->node);
    found = found || (from != nullptr && from->text.empty() &&
                      (from->datum == ir::Datum::machine_position || from->datum == ir::Datum::active_shift));
  });
  return found;
}

}  // namespace

namespace {

/// "[PUSH 2 L5]": what a PUSH of the reader put aside.
bool put_aside(const ir::VarRef& v) {
  return v.name.rfind("[PUSH ", 0) == 0;
}

/// The words of a PUSH or PULL; empty: the assignment is none.
std::string stack_words(const ir::Assign& a) {
  if (a.items.empty() || a.items.front().to_system) return {};
  const auto* from = std::get_if<ir::VarRef>(&a.items.front().value->node);
  const auto* to = std::get_if<ir::VarRef>(&a.items.back().value->node);
  if (from == nullptr || to == nullptr) return {};
  const bool push = put_aside(a.items.front().target);
  if (!push && !put_aside(*from)) return {};
  const auto number = [](const ir::VarRef& v) { return shortest(ir::constant_value(v.index).value_or(0)); };
  return (push ? "PUSH L" + number(*from) + " - L" + number(*to)
               : "PULL L" + number(a.items.front().target) + " - L" + number(a.items.back().target));
}

}  // namespace

void Writer::assign(const ir::Assign& a) {
  if (const std::string words = same_dialect() ? stack_words(a) : std::string{}; !words.empty())
    return add(words, Rank::head, a.items.front().pos);
  // One piece: the order of the assignments is their meaning.
  std::string text;
  for (const auto& item : a.items) {
    std::string target;
    if (same_dialect() && is_latch(item)) continue;
    if (item.to_system) {
      // The sum of PREF, DEC1 and DEC3 follows from them: the parameter before it is what was written.
      if (same_dialect() && item.system.text.empty() && item.system.datum == ir::Datum::work_offset) continue;
      const bool named =
          same_dialect() ? !item.system.text.empty() : is_parameter_name(item.system.text) || item.system.given;
      if (!named) {
        return refuse(no_statement, item.pos,
                      "'" + item.system.text + "' is data of the source machine and is not written here");
      }
      target = item.system.text;
    } else {
      target = target_variable(item.target);
    }
    if (!text.empty()) text += ' ';
    ir::ExprPtr value = item.to_system && same_dialect() ? in_machine_units(item.value) : item.value;
    const auto* whole = std::get_if<ir::Call>(&value->node);
    // E takes whole numbers by itself.
    if (same_dialect() && !item.to_system && target.front() == 'E' && whole != nullptr &&
        whole->function == ir::Function::trunc && whole->args.size() == 1)
      value = whole->args[0];
    text += target + '=' + expression_text(value, item.pos);
  }
  if (!text.empty()) add(text, Rank::head, a.items.front().pos);
}

void Writer::declare(const ir::Declare& d) {
  if (!same_dialect() && !structured(own_options_))
    return refuse(no_statement, {}, "named variables are not declared here");
  for (const auto& item : d.items) {
    std::string text = item.name.empty() || item.name.front() == '[' ? item.name : '[' + item.name + ']';
    if (!item.dimensions.empty()) {
      std::string sizes;
      for (const auto& size : item.dimensions) {
        const auto n = ir::constant_value(size);
        sizes += (sizes.empty() ? "" : ",") + shortest(n ? *n - 1 : 0);
      }
      text.insert(text.size() - 1, "(" + sizes + ")");
    }
    if (!item.initial.empty()) text += '=' + expression_text(item.initial.front());
    if (declares_first_.count(current().id) != 0) {
      add("VAR", Rank::head);
      next_line();
    }
    add(text, Rank::head);
  }
  if (declares_last_.count(current().id) == 0) return;
  next_line();
  add("ENDV", Rank::head);
}

// ---- control flow
// ------------------------------------------------------------------------------------------------------

std::string Writer::condition(const ir::ExprPtr& e) {
  const auto* b = std::get_if<ir::Binary>(&e->node);
  if (b == nullptr || !ir::is_comparison(b->op)) {
    refuse(no_statement, e->pos, "a condition is a comparison of a variable with a number or variable");
    return {};
  }
  return expression_text(e, e->pos);
}

void Writer::jump(const ir::Jump& j) {
  if (j.target.computed) return refuse(no_statement, {}, "a jump to a computed block number has no counterpart here");
  if (!j.target.is_number)
    return refuse(no_statement, {}, "a jump to a label that is no block number has no counterpart here");
  if (j.condition) {  // the N of a G10 block
    const auto* b = std::get_if<ir::Binary>(&j.condition->node);
    const auto* datum = b != nullptr ? std::get_if<ir::SystemRef>(&b->left->node) : nullptr;
    if (same_dialect() && datum != nullptr && datum->text == facts::interruption_datum)
      return add(number_target(j.target), Rank::tail);
  }
  std::string text = "G79 ";
  if (j.condition) text += condition(j.condition) + ' ';
  add(text + number_target(j.target), Rank::tail);
}

void Writer::repeat(const ir::Repeat& r) {
  if (r.first.computed || r.last.computed)
    return refuse(no_statement, {}, "a range of computed block numbers has no counterpart here");
  if (r.curve_use != ir::CurveUse::none) return curve(r);
  std::string text = "G77 ";
  if (r.has_program) text += "H" + std::to_string(r.program.number) + ' ';
  text += number_target(r.first) + ' ' + number_target(r.last);
  if (r.count) {
    const auto n = ir::constant_value(r.count);
    if (!n || *n != 1) text += ' ' + word("S", n ? ir::Value(*n) : ir::Value(r.count), {});
  }
  add(text, Rank::tail);
}

/// G48 NU1 N10 N30, G49 NU1; G06 NU1 stands in the block before.
void Writer::curve(const ir::Repeat& r) {
  if (!same_dialect()) return refuse(no_statement, {}, "a curve with a number has no counterpart here");
  const std::string number = " NU" + std::to_string(r.curve);
  if (r.curve_use == ir::CurveUse::define)
    add("G48" + number + ' ' + number_target(r.first) + ' ' + number_target(r.last), Rank::tail);
  if (r.curve_use == ir::CurveUse::remove) add("G49" + number, Rank::tail);
}

void Writer::call(const ir::CallRoutine& c) {
  if (c.computed) return refuse(no_statement, {}, "a call of a computed program has no counterpart here");
  if (!c.arguments.empty()) return refuse(no_statement, {}, "a call with arguments has no counterpart here");
  if (c.routine.number < facts::program_min || c.tail)
    return refuse(no_statement, {}, "this call has no counterpart here");
  std::string text = "G77 H" + std::to_string(c.routine.number);
  if (c.has_range) {
    std::size_t routine = routine_index();
    for (std::size_t i = 0; i < program().routines.size(); ++i) {
      if (program().routines[i].name == c.routine) routine = i;
    }
    text += ' ' + number_target(routine, c.first);
    if (c.last.text != c.first.text) text += ' ' + number_target(routine, c.last);
  }
  if (c.count) {
    const auto n = ir::constant_value(c.count);
    if (!n || *n != 1) text += ' ' + word("S", n ? ir::Value(*n) : ir::Value(c.count), {});
  }
  add(text, Rank::tail);
}

void Writer::return_from(const ir::Return& r) {
  // A subprogram ends with its text: the word of other controls is not written. In mid-text it could not be said.
  if (!r.values.empty()) return refuse(no_statement, {}, "a return with values has no counterpart here");
  const ir::Body& text = routine().body;
  if (text.empty() || text.back().id != current().id) {
    refuse(no_statement, {}, "a subprogram returns at its last block only");
  }
}

void Writer::end_program(const ir::End& e) {
  add(same_dialect() && !e.text.empty() ? std::string(e.text) : "M02", Rank::tail);
}

bool Writer::structured_allowed() {
  if (later_family(own_options_)) return true;
  refuse(no_statement, {}, "structured statements are not written here");
  return false;
}

/// Relations joined by AND and OR from left to right.
std::string Writer::structured_condition(const ir::ExprPtr& e) {
  const auto* b = std::get_if<ir::Binary>(&e->node);
  const bool joined = b != nullptr && (b->op == ir::BinaryOp::logical_and || b->op == ir::BinaryOp::logical_or);
  if (!joined) return condition(e);
  const auto* right = std::get_if<ir::Binary>(&b->right->node);
  if (right == nullptr || !ir::is_comparison(right->op)) {
    refuse(no_statement, e->pos, "conditions count from left to right here: this one needs parentheses");
    return {};
  }
  return structured_condition(b->left) + (b->op == ir::BinaryOp::logical_and ? " AND " : " OR ") + condition(b->right);
}

void Writer::if_else(const ir::If& i) {
  if (!structured_allowed()) return;
  add("IF " + structured_condition(i.condition) + " THEN", Rank::head);
  finish_line();
  nested_body(i.then_body);
  if (i.has_else) {
    keyword_line(i.else_line, "ELSE");
    nested_body(i.else_body);
  }
  keyword_line(i.end_line, "ENDI");
}

void Writer::while_loop(const ir::While& w) {
  if (!structured_allowed()) return;
  add("WHILE " + structured_condition(w.condition) + " DO", Rank::head);
  finish_line();
  nested_body(w.body);
  keyword_line(w.end_line, "ENDW");
}

void Writer::until_loop(const ir::Until& u) {
  if (!structured_allowed()) return;
  add("REPEAT", Rank::head);
  finish_line();
  nested_body(u.body);
  keyword_line(u.end_line, "UNTIL " + structured_condition(u.condition));
}

void Writer::for_loop(const ir::For& f) {
  if (!structured_allowed()) return;
  std::string text = "FOR " + target_variable(f.counter) + '=' + expression_text(f.from);
  const auto step = f.step ? ir::constant_value(f.step) : 1.0;
  text += (step && *step < 0 ? " DOWNTO " : " TO ") + expression_text(f.to);
  if (!step) {
    text += " BY " + expression_text(f.step);
  } else if (*step != 1 && *step != -1) {
    text += " BY " + shortest(*step < 0 ? -*step : *step);
  }
  add(text + " DO", Rank::head);
  finish_line();
  nested_body(f.body);
  keyword_line(f.end_line, "ENDF");
}

void Writer::exit_loop() {
  if (structured_allowed()) add("EXIT", Rank::head);
}

// ---- messages
// ------------------------------------------------------------------------------------------------------------

void Writer::message(const ir::Message& m) {
  if (m.kind == ir::MessageKind::clear) return add("$", Rank::head);
  std::string text;
  for (const auto& p : m.parts) {
    const auto* s = std::get_if<ir::String>(&p->node);
    if (s == nullptr) return refuse(no_statement, p->pos, "a value inside a message has no counterpart here");
    text += s->text;
  }
  bool lossy = false;
  std::string shown = same_dialect() ? text : to_upper_ascii(to_ascii(text, &lossy));
  if (shown.size() > facts::message_length && !same_dialect()) {
    diagnostics().warning(
        "TRN-213", current().line.span,
        "the message is cut at " + std::to_string(facts::message_length) + " characters, the most this control shows");
    shown.resize(facts::message_length);
  }
  add("$ " + shown, Rank::head);
  if (m.kind == ir::MessageKind::error) {
    diagnostics().warning(
        "TRN-215", current().line.span,
        "the error stops the source's run; here the message is shown and M00 follows, and START goes on");
    next_line();
    add(m_word(0), Rank::machine);
  }
}

/// M00 stops the spindle as well, M12 the program alone (3.2.1, 3.2.13).
void Writer::stop(const ir::Action& a, const ir::Stop& s) {
  const bool alone = !s.optional && !same_dialect() && profile().policies.stop_spindle == machine::StopSpindle::stops;
  if (!alone) return ProgramWriter::stop(a, s);
  add(m_word(12), Rank::machine, a.pos);
}

bool Writer::joins(const ir::Statement& before, const ir::Statement& next) {
  // Text after $ runs to the end of the line.
  if (std::holds_alternative<ir::Message>(before.node) || std::holds_alternative<ir::Message>(next.node)) return false;
  return ProgramWriter::joins(before, next);
}

}  // namespace cnctrans::backends::num
