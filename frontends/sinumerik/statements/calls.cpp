// Definitions (DEF, PROC, EXTERN) and calls by statement (CALL, EXTCALL, PCALL, MCALL).
#include <algorithm>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/sinumerik/cycles.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/statements/row_parts.h"
#include "ir/declared_limits.h"

namespace cnctrans::sinumerik {

using syntax::Block;
using syntax::Expr;
using syntax::ExprKind;
using syntax::Statement;

std::optional<ir::Type> StatementLowering::type_of(const Expr& type) {
  if (type.text == "INT") return ir::Type::integer;
  if (type.text == "REAL") return ir::Type::real;
  if (type.text == "BOOL") return ir::Type::boolean;
  if (type.text == "STRING" || type.text == "CHAR") return ir::Type::string;
  if (type.text == "AXIS") return ir::Type::axis;
  if (type.text == "FRAME") return ir::Type::frame;
  return std::nullopt;
}

namespace {

constexpr std::size_t longest_initial_list = 100000;

std::string type_text(const Expr& type, const FileContext& c) {
  if (type.args.empty()) return type.text == "CHAR" ? "CHAR" : "";
  return type.text + "[" + std::string(c.slice(type.args[0].pos)) + "]";
}

/// SET(...), (...) or REP(...).
bool is_list(const Expr& e) {
  return e.kind == ExprKind::call && (e.text.empty() || e.text == "SET" || e.text == "REP");
}

/// Elements of an array with literal dimensions; 0 when one is not literal.
std::size_t element_count(const Expr& dimensions) {
  std::size_t n = 1;
  for (const Expr& d : dimensions.args) {
    if (d.kind != ExprKind::number || d.number < 1 || d.number > 65535) return 0;
    n *= saturate<std::size_t>(d.number);
    if (n > longest_initial_list) return 0;
  }
  return n;
}

}  // namespace

ir::ExprPtr StatementLowering::initial_value(const Expr& e, ir::Type type) {
  return defines_characters_ ? exprs_.lower_character(e) : exprs_.lower_as(e, type);
}

bool StatementLowering::initial_values(const Expr& e, ir::Type type, std::size_t elements,
                                       std::vector<ir::ExprPtr>& out) {
  const bool list = e.kind == ExprKind::call && (e.text.empty() || e.text == "SET");
  const bool repeat = e.kind == ExprKind::call && e.text == "REP";
  if (!list && !repeat) {
    out.push_back(initial_value(e, type));
    return out.back() != nullptr;
  }
  if (list) {
    if (elements != 0 && e.args.size() > elements) {
      c_.error("SIN-114", e.pos, "the list has more values than the array has elements");
      return false;
    }
    for (const Expr& value : e.args) {  // a gap is 0
      out.push_back(value.kind == ExprKind::missing ? zero_of(type) : initial_value(value, type));
      if (!out.back()) return false;
    }
    return true;
  }
  if (e.args.empty() || elements == 0)
    return refuse("language.statement", e.pos, "REP() needs a value and an array of known size");
  const ir::ExprPtr value = initial_value(e.args[0], type);
  if (!value) return false;
  std::size_t count = elements;
  if (e.args.size() > 1) {
    if (e.args[1].kind != ExprKind::number)
      return refuse("language.statement", e.pos, "REP() with a computed count is not carried yet");
    count = std::min(elements, saturate<std::size_t>(std::max(e.args[1].number, 0.0)));
  }
  out.assign(count, value);
  return true;
}

bool StatementLowering::definition(const Statement& s, ir::LineInfo& info) {
  if (executable_seen_) {
    c_.warning("SIN-018", s.pos,
               "DEF stands after the first executable block (alarm 14500): it is taken as if it stood before");
  }
  const auto type = type_of(s.args[0]);
  defines_characters_ = s.args[0].text == "CHAR";
  const bool global = std::any_of(s.children.begin(), s.children.end(), [](const Statement& x) {
    return x.keyword == "ATTR" && (x.text == "NCK" || x.text == "CHAN");
  });
  const auto place = type ? space_of(*type, global) : std::nullopt;
  ir::Declare out;
  bool ok = true;
  std::uint32_t behind = 0;  // the variable before: column of what follows it
  for (const Statement& v : s.children) {
    if (v.keyword != "VAR") continue;
    const std::string name = to_upper_ascii(v.text);
    if (v.pos.column == behind) {
      c_.error("SIN-111", v.pos, "a name begins with two letters or underscores, and this one does not",
               "give the variable another name");
      return false;
    }
    behind = v.pos.column + v.pos.length;
    Symbol symbol;
    symbol.dimensions = static_cast<std::uint8_t>(v.args[0].args.size());
    symbol.character = defines_characters_;
    for (std::size_t i = 0; i < symbol.sizes.size() && i < v.args[0].args.size(); ++i) {
      const Expr& d = v.args[0].args[i];
      if (d.kind == ExprKind::number && d.number >= 1 && d.number <= 65535)
        symbol.sizes[i] = saturate<std::uint32_t>(d.number);
    }
    if (place) {
      symbol.type = *type;
      symbol.space = *place;
    }
    if (const Symbol* seen = c_.symbol(name); seen != nullptr && seen->of_machine) c_.symbols.erase(name);
    if (!c_.symbols.emplace(name, symbol).second) {
      c_.error("SIN-022", v.pos, name + " is defined twice (alarm 12170)");
      ok = false;
      continue;
    }
    if (!place) continue;
    ir::Declare::Item item;
    item.name = name;
    for (const Expr& d : v.args[0].args) {
      item.dimensions.push_back(exprs_.lower_as(d, ir::Type::integer));
      ok = ok && item.dimensions.back() != nullptr;
    }
    if (v.args[1].kind != ExprKind::missing) {
      if (!v.args[0].args.empty() && !is_list(v.args[1]))
        return refuse("language.statement", v.pos, "the values of an array are SET(...), (...) or REP(...)");
      ok = initial_values(v.args[1], *type, v.args[0].args.empty() ? 0 : element_count(v.args[0]), item.initial) && ok;
    }
    out.items.push_back(std::move(item));
  }
  if (!place)
    return refuse("language.statement", s.args[0].pos, "variables of type " + s.args[0].text + " are not carried yet");
  if (!ok) return false;
  out.type = *type;
  out.space = *place;
  out.type_text = type_text(s.args[0], c_);
  const auto is = [](std::string_view keyword) {
    return [keyword](const Statement& x) { return x.keyword == keyword; };
  };
  const auto first = std::find_if(s.children.begin(), s.children.end(), is("VAR"));
  if (first != s.children.end() && std::any_of(s.children.begin(), s.children.end(), is("ATTR"))) {
    // NCK REAL PHU 21 LLI 0: the attributes stand before and behind the type
    constexpr std::uint32_t keyword_length = 3;
    const std::uint32_t from = s.pos.column + keyword_length;
    if (first->pos.column > from) out.type_text = trim(c_.slice(WordPos{from, first->pos.column - from}));
    const double start = ir::declared_limits(out.type_text).start();
    for (auto& item : out.items) {  // the value next to zero that the limits allow
      if (start != 0 && item.initial.empty() && item.dimensions.empty()) item.initial.push_back(ir::number(start));
    }
  }
  emit(info, std::move(out));
  return true;
}

bool StatementLowering::proc(const Statement& s, ir::LineInfo& info) {
  if (routine_->has_signature || executable_seen_) {
    c_.error("SIN-018", s.pos, "PROC must be the first statement of its program (alarm 14500)");
    return false;
  }
  bool ok = true;
  // PROC of a main program (.MPF, _MPF) without parameters is only its heading
  const bool main = routine_->kind == ir::RoutineKind::main && s.children.empty();
  if (!main) routine_->kind = ir::RoutineKind::sub;
  // A main program has the name of its file; PROC with another one does not make it the file of that name.
  constexpr std::string_view of_name = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  const std::string& file = routine_->name.text;
  if (!main || file.empty() || file.find_first_not_of(of_name) != std::string::npos)
    routine_->name = routine_name(s.text);
  routine_->has_signature = true;
  routine_->header = info;
  for (const Expr& attribute : s.args) {
    if (attribute.text == "SAVE") {
      routine_->saves_modals = true;
      continue;
    }
    if (!routine_->header_text.empty()) routine_->header_text += ' ';
    routine_->header_text += attribute.text;
  }
  for (const Statement& p : s.children) {
    const auto type = type_of(p.args[0]);
    const auto place = type ? space_of(*type, false) : std::nullopt;
    const std::string name = to_upper_ascii(p.text);
    const std::size_t dimensions = p.args[2].args.size();
    Symbol symbol;
    symbol.dimensions = static_cast<std::uint8_t>(dimensions);
    symbol.character = p.args[0].text == "CHAR";
    ir::Parameter out;
    out.name = name;
    if (dimensions != 0) {  // as it stands in the signature
      out.name += '[';
      for (std::size_t i = 0; i < dimensions; ++i) {
        if (i != 0) out.name += ',';
        if (p.args[2].args[i].kind != ExprKind::missing) out.name += c_.slice(p.args[2].args[i].pos);
      }
      out.name += ']';
    }
    for (std::size_t i = 0; i < symbol.sizes.size() && i < dimensions; ++i) {
      const Expr& d = p.args[2].args[i];
      if (d.kind == ExprKind::number) symbol.sizes[i] = saturate<std::uint32_t>(d.number);
    }
    out.by_reference = p.args[1].kind != ExprKind::missing;
    out.type_text = type_text(p.args[0], c_);
    if (place && *type == ir::Type::frame) {
      ok = refuse("language.statement", p.pos, "parameters of type FRAME are not carried yet");
      symbol.type = *type;
      symbol.space = *place;
    } else if (place) {
      symbol.type = out.type = *type;
      symbol.space = out.variable.space = *place;
    } else {
      ok = refuse("language.statement", p.pos, "parameters of type " + p.args[0].text + " are not carried yet");
    }
    if (dimensions != 0 && !out.by_reference) {
      c_.error("SIN-012", p.pos, "an array is handed over by reference: VAR");
      ok = false;
    }
    out.variable.name = name;
    if (p.args[3].kind != ExprKind::missing && place) {
      out.default_value = exprs_.lower_as(p.args[3], *type);
      ok = ok && out.default_value != nullptr;
    }
    c_.symbols[name] = symbol;
    routine_->parameters.push_back(std::move(out));
  }
  return ok;
}

bool StatementLowering::extern_declaration(const Statement& s, const Block& block, ir::LineInfo& info) {
  std::vector<bool> by_reference;
  for (const Statement& p : s.children) by_reference.push_back(p.args[1].kind != ExprKind::missing);
  externs_[routine_name(s.text).text] = std::move(by_reference);
  ir::Opaque o;
  o.text = code_text(c_.text, block);
  o.harmless = true;
  emit(info, std::move(o));
  return true;
}

/// The text is put in the place of the name from the next line on (8.6).
bool StatementLowering::macro(const Statement& s, const Block& block, ir::LineInfo& info) {
  const std::string name = to_upper_ascii(s.args[0].text);
  if (!c_.macros.emplace(name, std::string(trim(s.text))).second) {
    c_.error("SIN-022", s.args[0].pos, name + " is defined twice");
    return false;
  }
  c_.note("SIN-009", s.pos, "DEFINE is kept as text; the macro " + name + " is written out where it is used");
  add_opaque(block, info, "language.macro", true);
  return true;
}

/// The program that a text names. Also `"L"<<R10`: the number is computed.
bool StatementLowering::program_name(const Expr& e, ir::CallRoutine& call) {
  if (e.kind == ExprKind::string) {
    std::string_view path = e.text;
    if (const std::size_t slash = path.find_last_of("/\\:"); slash != std::string_view::npos) {
      c_.note("SIN-023", e.pos, "the folder of the called program is not looked at: it is searched by its name");
      path = path.substr(slash + 1);
    }
    call.routine = routine_name(path);
    if (!call.routine.empty()) return true;
    c_.error("SIN-017", e.pos, "this is no name of a program");
    return false;
  }
  const ir::ExprPtr computed = e.kind == ExprKind::binary ? nullptr : exprs_.lower(e);
  if (computed && computed->type == ir::Type::string) {
    call.computed = computed;
    return true;
  }
  const bool numbered = e.kind == ExprKind::binary && e.text == "<<" && e.args[0].kind == ExprKind::string &&
                        iequals_ascii(e.args[0].text, "L");
  if (numbered) {
    call.computed = exprs_.lower_as(e.args[1], ir::Type::integer);
    return call.computed != nullptr;
  }
  if (e.kind == ExprKind::binary && e.text == "<<") {
    call.computed = exprs_.lower_as(e, ir::Type::string);
    return call.computed != nullptr;
  }
  return refuse("language.statement", e.pos, "calling a program by a computed name is not carried yet");
}

bool StatementLowering::text_call(const Statement& s, ir::LineInfo& info) {
  if (call_in_real_time(s.pos)) return false;
  ir::CallRoutine call;
  if (s.keyword == "EXTCALL") {
    if (!program_name(s.args[0], call)) return false;
    emit(info, std::move(call));
    return true;
  }
  const bool range = s.args[1].kind != ExprKind::missing;
  if (s.args[0].kind == ExprKind::missing) {
    call.routine = routine_->name;
  } else if (!program_name(s.args[0], call)) {
    return false;
  }
  if (range) {
    call.has_range = true;
    if (!label(s.args[1], call.first) || !label(s.args[2], call.last)) return false;
  }
  if (s.args[3].kind != ExprKind::missing) {
    call.count = exprs_.lower_as(s.args[3], ir::Type::integer);
    if (!call.count) return false;
  }
  emit(info, std::move(call));
  return true;
}

/// RET("LABEL",1,2): goes on at a block of the program so many levels up, or behind it (8.3). The restart of an ISO
/// program is not carried.
bool StatementLowering::return_target(const std::vector<Expr>& args, WordPos pos, ir::Return& out) {
  if (args.empty()) return true;
  const auto given = [&](std::size_t i) { return i < args.size() && args[i].kind != ExprKind::missing; };
  if (args.size() > 4 || (given(3) && !(args[3].kind == ExprKind::number && args[3].number == 0)))
    return refuse("language.statement", pos, "RET with a restart of the main program is not carried yet");
  ir::ExprPtr target = given(0) ? exprs_.lower(args[0]) : ir::string_literal({});
  if (!target) return false;
  if (target->type != ir::Type::string) {
    c_.error("SIN-012", args[0].pos, "RET() takes the target as a text: a label or a block number");
    return false;
  }
  out.values.push_back(std::move(target));
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
    out.values.push_back(given(i) ? exprs_.lower_as(args[i], ir::Type::integer) : ir::number(i == 1 ? 0 : 1));
    if (!out.values.back()) return false;
  }
  return true;
}

bool StatementLowering::path_call(const Statement& s, ir::LineInfo& info) {
  if (call_in_real_time(s.pos)) return false;
  ir::CallRoutine call;
  const std::size_t slash = s.text.find_last_of('/');
  if (slash != std::string::npos)
    c_.note("SIN-023", s.pos, "the folder of the called program is not looked at: it is searched by its name");
  call.routine = routine_name(trim(slash == std::string::npos ? s.text : std::string_view(s.text).substr(slash + 1)));
  if (!call_arguments(call.routine.text, s.args, call)) return false;
  emit(info, std::move(call));
  return true;
}

bool StatementLowering::modal_call(const Statement& s, ir::LineInfo& info) {
  if (call_in_real_time(s.pos)) return false;
  ir::ModalCall out;
  if (s.text.empty()) {
    out.off = true;
    emit(info, std::move(out));
    return true;
  }
  if (const CycleRow* row = c_.cycle_called(s.text, s.pos); row != nullptr) {
    if (row->family == CycleFamily::pattern) {
      c_.error("SIN-021", s.pos, s.text + " is no cycle that MCALL can run: it gives the positions for one");
      return false;
    }
    if (row->family == CycleFamily::milling) {
      refuse("cycle.milling", s.pos, s.text + " as a modal call is not carried yet: it has a place of its own");
      return false;
    }
    out.cycle = cycle(s.text, s.args, s.pos);
    if (!out.cycle) return false;
  } else {
    out.call.routine = routine_name(s.text);
    if (!call_arguments(s.text, s.args, out.call)) return false;
  }
  emit(info, std::move(out));
  return true;
}

// --- messages ---------------------------------------------------------------------------------------------------

void StatementLowering::message_parts(const Expr& e, std::vector<ir::ExprPtr>& out) {
  if (e.kind == ExprKind::binary && e.text == "<<") {
    message_parts(e.args[0], out);
    message_parts(e.args[1], out);
    return;
  }
  if (e.kind == ExprKind::unary && e.text == "<<") return message_parts(e.args[0], out);
  if (auto part = exprs_.lower(e)) out.push_back(std::move(part));
}

bool StatementLowering::message(const std::vector<Expr>& args, WordPos pos, Parts& parts) {
  ir::Message m;
  const std::uint32_t before = c_.errors;
  if (args.empty() || args[0].kind == ExprKind::missing) {
    m.kind = ir::MessageKind::clear;
  } else {
    message_parts(args[0], m.parts);
  }
  if (args.size() > 1) c_.note("SIN-009", pos, "MSG shows its text; the second argument only says when");
  parts.calls.emplace_back(std::move(m));
  return c_.errors == before;
}

bool StatementLowering::alarm(const std::vector<Expr>& args, WordPos pos, Parts& parts) {
  ir::Message m;
  m.kind = ir::MessageKind::error;
  const std::uint32_t before = c_.errors;
  if (args.empty()) {
    c_.error("SIN-012", pos, "SETAL() needs the number of the alarm");
    return false;
  }
  m.number = exprs_.lower_as(args[0], ir::Type::integer);
  if (args.size() > 1) message_parts(args[1], m.parts);
  parts.calls.emplace_back(std::move(m));
  return c_.errors == before;
}

}  // namespace cnctrans::sinumerik
