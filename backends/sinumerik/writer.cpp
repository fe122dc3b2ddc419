// Files, names, routine headers, lines.
#include "backends/sinumerik/writer.h"

#include <algorithm>
#include <set>

#include "backends/common/comments.h"
#include "backends/sinumerik/tables.h"
#include "base/text.h"
#include "dialects/sinumerik/addresses.h"
#include "dialects/sinumerik/asked.h"
#include "dialects/sinumerik/limits.h"
#include "ir/edit/outside.h"
#include "ir/edit/search.h"

namespace cnctrans::backends::sinumerik {
namespace {

namespace dialect = cnctrans::sinumerik;

bool letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
}
bool digit(char c) {
  return c >= '0' && c <= '9';
}

std::string name_of_digits(std::string_view stem) {
  std::string digits;
  for (const char c : stem) {
    if (digit(c)) digits += c;
  }
  return digits.empty() ? std::string{} : "PRG" + digits.substr(0, 20);
}

bool uses_css(const ir::Program& program) {
  return ir::any_action(program, [](const ir::Action& a) {
    const auto* m = std::get_if<ir::ModalSet>(&a.data);
    return m != nullptr && m->setting == ir::Setting::spindle_mode && m->value == code_value(ir::SpindleMode::css);
  });
}

bool chooses_master(const ir::Program& program) {
  return ir::any_action(program, [](const ir::Action& a) { return std::holds_alternative<ir::MasterSpindle>(a.data); });
}

}  // namespace

std::string legal_name(std::string_view stem) {
  std::string name(stem.substr(0, dialect::name_characters));
  for (char& c : name) {
    if (c == ' ' || c == '-' || c == '.') c = '_';
    if (!letter(c) && !digit(c)) return {};
  }
  if (name.size() < 2 || !letter(name[0]) || !letter(name[1])) return {};
  return name;
}

Writer::Writer(const ir::Program& source, const WriteOptions& write_options, Diagnostics& sink)
    : ProgramWriter(source, write_options, sinumerik::style, sink),
      expressions_(program(), source.dialect == sinumerik::style.dialect),
      geometry_(profile()),
      uses_css_(uses_css(program())),
      chooses_master_(chooses_master(program())) {}

std::string Writer::sub_name(const ir::RoutineName& name) const {
  if (!name.text.empty()) return name.text;
  return 'L' + std::to_string(name.number);
}

std::string Writer::main_name() {
  const ir::Routine* main = program().main();
  std::string name = legal_name(options().main_stem);
  if (same_dialect() && name != options().main_stem && main != nullptr && main->has_signature)
    name = main->name.text;  // as PROC has it
  if (name.empty() && main != nullptr) name = legal_name(to_upper_ascii(trim(main->title)));
  if (name.empty() && main != nullptr && !main->name.text.empty()) name = legal_name(main->name.text);
  if (name.empty()) name = name_of_digits(options().main_stem);
  if (name.empty() && main != nullptr && main->name.number >= 0) name = "PRG" + std::to_string(main->name.number);
  if (name.empty()) name = "MAIN";
  if (!options().main_stem.empty() && name != options().main_stem) {
    diagnostics().note("TRN-213", main != nullptr ? main->header.span : Span{},
                       "'" + options().main_stem + "' is no program name of the target; the program is called " + name);
  }
  return name;
}

/// Files of their own; an archive (programs with transfer headers in one file) when one output is wanted or the source
/// was one.
bool Writer::threads_have_angles() const {
  bool found = false;
  for (const auto& r : program().routines) {
    ir::for_each_statement(r.body, [&found](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      found = found || (b != nullptr && b->motion.extra != nullptr && b->motion.extra->has_start_angle);
    });
  }
  return found;
}

void Writer::write_program() {
  angles_ = !same_dialect() && threads_have_angles();
  const auto& routines = program().routines;
  const bool was_archive = same_dialect() && !program().files.empty() && program().files.front().archive;
  const auto here = std::count_if(routines.begin(), routines.end(), [](const auto& r) { return !ir::is_outside(r); });
  const bool archive = was_archive || (options().single_output && here > 1);
  bool first = true;
  for (std::size_t i = 0; i < routines.size(); ++i) {
    const ir::Routine& r = routines[i];
    if (ir::is_outside(r)) continue;
    const bool main = r.kind == ir::RoutineKind::main;
    const std::string extension = main ? "MPF" : "SPF";
    const std::string name = main ? free_stem(main_name(), "." + extension) : sub_name(r.name);
    const bool bundle = archive && here > 1;
    if (!archive || first) open_file(name + '.' + (bundle ? "ARC" : extension), main || first);
    if (archive) {
      const bool own_header = same_dialect() && !r.attributes.empty();
      raw_line('%' + (own_header ? r.attributes : "_N_" + name + '_' + extension), r.header.span);
    }
    first = false;
    routine_text(i, name);
  }
}

void Writer::routine_text(std::size_t index, const std::string& name) {
  start_routine(index);
  without_offset_ = nullptr;
  const ir::Routine& r = routine();
  const bool proc = r.has_signature || !r.parameters.empty();
  const bool title = !r.title.empty() && !same_dialect();
  if (title) raw_line(comment(trim(r.title), style().comment, false, nullptr), r.header.span);
  if (proc) {
    begin_line(r.header);
    add(proc_line(r, name), Rank::head);
    finish_line();
  } else if (!r.header.comments.empty() || r.header.blank_lines_before != 0) {
    begin_line(r.header);
    finish_line();
  }
  if (!same_dialect()) externs(r);
  body(r.body);
  finish_line();
  // A subprogram of another control may end with its text; here it needs its word.
  const auto returns = [](const ir::Statement& s) {
    return s.line.skip_mask == 0 &&
           (std::holds_alternative<ir::Return>(s.node) || std::holds_alternative<ir::End>(s.node));
  };
  const auto remark = [](const ir::Statement& s) {
    const auto* block = std::get_if<ir::Block>(&s.node);
    return block != nullptr && block->empty() && s.line.number.empty() && s.line.labels.empty();
  };
  const auto last = std::find_if_not(r.body.rbegin(), r.body.rend(), remark);
  if (r.kind == ir::RoutineKind::sub && !same_dialect() && (last == r.body.rend() || !returns(*last))) {
    if (without_offset_ != nullptr) offset_line(r.body.back().line.span);
    raw_line("M17");
  }
}

/// A call with parameters of a program in another file needs its signature at the head of the caller's.
void Writer::externs(const ir::Routine& r) {
  std::set<std::string> said;
  ir::for_each_statement(r.body, [&](const ir::Statement& s) {
    const ir::CallRoutine* call = std::get_if<ir::CallRoutine>(&s.node);
    if (const auto* m = std::get_if<ir::ModalCall>(&s.node); m != nullptr && !m->off && !m->cycle) call = &m->call;
    const ir::Routine* callee = call == nullptr || call->computed ? nullptr : program().find(call->routine);
    if (callee == nullptr || callee->parameters.empty()) return;
    std::string line = "EXTERN " + sub_name(callee->name) + '(';
    for (std::size_t i = 0; i < callee->parameters.size(); ++i) {
      const ir::Parameter& p = callee->parameters[i];
      if (i != 0) line += ',';
      if (p.by_reference) line += "VAR ";
      line += type_word(p.type);
    }
    line += ')';
    if (said.insert(line).second) raw_line(line, r.header.span);
  });
}

std::string Writer::proc_line(const ir::Routine& r, const std::string& name) {
  std::string text = "PROC " + name;
  if (!r.parameters.empty()) text += '(';
  for (std::size_t i = 0; i < r.parameters.size(); ++i) {
    const ir::Parameter& p = r.parameters[i];
    if (i != 0) text += ',';
    if (p.by_reference) text += "VAR ";
    text += same_dialect() && !p.type_text.empty() ? p.type_text : std::string(type_word(p.type));
    text += ' ';
    text += p.variable.name.empty() || p.name.find('[') != std::string::npos ? p.name : p.variable.name;
    if (p.default_value) text += '=' + expression_text(p.default_value);
  }
  if (!r.parameters.empty()) text += ')';
  if (r.saves_modals) text += " SAVE";
  if (same_dialect() && !r.header_text.empty()) text += ' ' + r.header_text;
  return text;
}

std::string Writer::label_text(const ir::LineInfo& info) {
  std::string text;
  for (const std::string_view l : info.labels) {
    text += l;
    text += ": ";
  }
  return text;
}

bool Writer::joins(const ir::Statement& before, const ir::Statement& next) {
  if (same_dialect()) return true;
  const bool words = std::holds_alternative<ir::Block>(before.node);
  if (std::holds_alternative<ir::End>(next.node) || std::holds_alternative<ir::Return>(next.node)) {
    return words;
  }
  return std::holds_alternative<ir::Assign>(before.node) && std::holds_alternative<ir::Assign>(next.node);
}

void Writer::nested(const ir::Body& statements) {
  nested_body(statements);
  offset_line(current().line.span);
}

// ---- values --------------------------------------------------------------------------------------------------------

std::string Writer::value_text(const ir::Value& v, WordPos pos) {
  return v.literal() ? number_text(v) : expression_text(v.expr, pos);
}

std::string Writer::word(std::string_view address, const ir::Value& value, WordPos pos) {
  const bool bare = address.size() == 1 && value.literal();
  std::string text(address);
  if (!bare) text += '=';
  return text + value_text(value, pos);
}

std::string Writer::attribute_word(std::string_view address, std::string_view attribute, const ir::Value& v,
                                   WordPos pos) {
  const auto* position = v.expr ? std::get_if<ir::SystemRef>(&v.expr->node) : nullptr;
  if (same_dialect() && position != nullptr && position->text == dialect::numbered_position_datum &&
      position->args.size() == 2)  // CAC, CDC, CACP, CACN
    return std::string(address) + "=C" + std::string(attribute) + '(' + expression_text(position->args[1], pos) + ')';
  if (same_dialect() && position != nullptr && position->text == dialect::stepped_position_datum)
    return std::string(address) + "=CIC(" + expression_text(position->args[0], pos) + ')';
  return std::string(address) + '=' + std::string(attribute) + '(' + value_text(v, pos) + ')';
}

std::string Writer::source_word(WordPos pos) const {
  if (!same_dialect() || pos.column == 0 || pos.length == 0) return {};
  const std::string line = source_line(current().line.span);
  if (pos.column - 1 + pos.length > line.size()) return {};
  return line.substr(pos.column - 1, pos.length);
}

}  // namespace cnctrans::backends::sinumerik
