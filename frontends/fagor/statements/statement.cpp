#include "frontends/fagor/statements/statement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/fagor/limits.h"
#include "dialects/fagor/words.h"
#include "frontends/fagor/statements/expr.h"
#include "frontends/fagor/statements/files.h"
#include "ir/check/missing_features.h"

namespace cnctrans::fagor {

namespace {

namespace facts = dialects::fagor;
using syntax::Expr;
using syntax::ExprKind;
using Node = ir::StatementNode;

constexpr std::array<std::string_view, 4> screen_variables = {"DW", "DWH", "DWB", "SK"};

template <class List>
bool holds(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string without_zeros(std::string_view digits) {
  const std::size_t first = digits.find_first_not_of('0');
  return std::string(first == std::string_view::npos ? "0" : digits.substr(first));
}
bool whole(double n, double limit) {
  return n >= 0 && n <= limit && n == std::floor(n);
}

/// A program has its number as a name: no subroutine of that number is meant (error 1064 where there is none).
ir::RoutineName program_name(double number) {
  return {-1, std::to_string(saturate<std::int64_t>(number))};
}

class StatementLowerer {
 public:
  StatementLowerer(const syntax::Block& block, std::string_view text, LowerState& state)
      : block_(block), text_(text), state_(state) {}

  Node lower(const syntax::Statement& s);

 private:
  Node assign(const syntax::Statement& s);
  Node condition(const syntax::Statement& s);
  Node jump(const syntax::Statement& s);
  Node repeat(const syntax::Statement& s);
  Node call(const syntax::Statement& s);
  Node execute(const syntax::Statement& s);
  Node message(const syntax::Statement& s);
  Node error(const syntax::Statement& s);
  Node file(const syntax::Statement& s);
  Node kept(const syntax::Statement& s, std::string_view feature, bool harmless);
  Node malformed(const syntax::Statement& s, std::string what);
  ir::LabelRef label(const Expr& e);
  void routine(const Expr& e, ir::CallRoutine& call);
  ir::Body body_of(const syntax::Statement& action);

  const syntax::Block& block_;
  std::string_view text_;
  LowerState& state_;
};

Node StatementLowerer::kept(const syntax::Statement& s, std::string_view feature, bool harmless) {
  if (harmless) {
    state_.note("FAG-023", s.pos, "the statement " + s.keyword + " has no effect on the path; it is kept as text");
  } else {
    // The name of an unknown statement is all the letters it begins with.
    const auto end = s.text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz");
    const std::string name =
        s.keyword.empty() || end == 0 || !s.text.starts_with(s.keyword.front()) ? s.keyword : s.text.substr(0, end);
    const auto* missing = ir::find_missing_feature(feature);
    const bool beside = missing != nullptr && missing->beside_path;
    state_.warning("FAG-022", s.pos, "the statement " + (s.text.empty() ? s.keyword : name) + " is kept as text",
                   std::string(beside ? "a run goes on without it" : "a run stops here") +
                       "; only a program for this control can be written with it");
  }
  return ir::Opaque{std::string(text_), std::string(feature), harmless};
}

Node StatementLowerer::malformed(const syntax::Statement& s, std::string what) {
  state_.error("FAG-024", s.pos, std::move(what));
  return ir::Opaque{std::string(text_), "text.unread", false};
}

Node StatementLowerer::assign(const syntax::Statement& s) {
  bool screen = true, input = false;
  for (std::size_t i = 0; i + 1 < s.args.size(); i += 2) {
    screen = screen && holds(screen_variables, s.args[i].text);
    input = input || s.args[i].text == "IB" || s.args[i + 1].kind == ExprKind::string;
  }
  syntax::Statement named = s;
  if (screen || input) named.keyword = s.args[0].text;
  if (screen) return kept(named, "language.statement", true);
  if (input) return kept(named, "beside.data", false);  // what is read later is asked of --set
  if (s.args.size() / 2 > static_cast<std::size_t>(facts::max_assignments)) {
    state_.warning("FAG-024", s.pos, "the control takes 26 assignments in a block");
  }
  ir::Assign a;
  for (std::size_t i = 0; i + 1 < s.args.size(); i += 2) {
    ir::Assign::Item item;
    const bool target = lower_target(s.args[i], state_, item);
    item.value = lower_expr(s.args[i + 1], state_);
    if (target) a.items.push_back(std::move(item));
  }
  if (a.items.size() * 2 != s.args.size()) return ir::Opaque{std::string(text_), "language.system_variable", false};
  return a;
}

ir::Body StatementLowerer::body_of(const syntax::Statement& action) {
  ir::Statement st;
  st.line.span = word_span(state_.line(), action.pos);
  st.line.joined = true;
  st.node = lower(action);
  ir::Body body;
  body.push_back(std::move(st));
  return body;
}

Node StatementLowerer::condition(const syntax::Statement& s) {
  ir::If node;
  node.one_line = true;
  node.condition = lower_expr(s.args.at(0), state_);
  if (node.condition->type != ir::Type::boolean)
    state_.warning("FAG-053", s.args.at(0).pos,
                   "the condition is no relation (EQ, NE, GT, GE, LT, LE): the manual gives it no meaning",
                   "it is read as met by every value but 0; write NE 0 behind it");
  node.then_body = body_of(s.children.at(0));
  if (s.children.size() > 1) {
    node.has_else = true;
    node.else_body = body_of(s.children[1]);
  }
  return node;
}

ir::LabelRef StatementLowerer::label(const Expr& e) {
  ir::LabelRef l;
  if (e.kind != ExprKind::number) {
    l.computed = lower_expr(e, state_);
    return l;
  }
  if (!whole(e.number, static_cast<double>(facts::max_label))) {
    state_.error("FAG-015", e.pos, "a label is a whole number from 0 to 99999999");
  }
  l.text = without_zeros(e.text);
  l.is_number = true;
  return l;
}

Node StatementLowerer::jump(const syntax::Statement& s) {
  ir::Jump j;
  j.target = label(s.args.at(0));
  j.search = ir::Search::whole_first;
  return j;
}

Node StatementLowerer::repeat(const syntax::Statement& s) {
  ir::Repeat r;
  r.first = label(s.args.at(0));
  r.last = label(s.args.at(1));
  r.search = ir::Search::whole_first;
  if (s.args.size() > 2) {
    r.has_program = true;
    if (s.args[2].kind != ExprKind::number) return kept(s, "language.statement", false);
    r.program = program_name(s.args[2].number);
  }
  for (const auto& w : block_.words) {
    if (!w.has_value || (w.expr < 0 && !whole(w.number, static_cast<double>(facts::max_repeat)))) {
      state_.error("FAG-016", w.pos, "a repeat count is a whole number from 0 to 9999, or a parameter");
    }
    r.count = ir::as_expr(lower_value(w, block_, state_));
  }
  return r;
}

void StatementLowerer::routine(const Expr& e, ir::CallRoutine& call) {
  if (e.kind != ExprKind::number) {
    call.computed = lower_expr(e, state_);
    return;
  }
  if (!whole(e.number, static_cast<double>(facts::max_oem_subroutine)))
    state_.error("FAG-013", e.pos, "a subroutine has a number from 0 to 9999");
  call.routine.number = saturate<std::int64_t>(e.number);
}

/// CALL and LL share the caller's local parameters; PCALL and MCALL open a level.
Node StatementLowerer::call(const syntax::Statement& s) {
  ir::CallRoutine call;
  routine(s.args.at(0), call);
  const bool level = s.keyword == "PCALL" || s.keyword == "MCALL";
  if (level) call.level = ir::CallLevel::new_level;
  for (std::size_t i = 1; i + 1 < s.args.size(); i += 2) {
    const char letter = parameter_letter(s.args[i]);
    if (letter == 0) return malformed(s, "an argument of " + s.keyword + " is a local parameter: A to Z or P0 to P25");
    if (s.args[i + 1].kind == ExprKind::missing)
      return malformed(s, std::string("the argument ") + letter + " has no value");
    ir::Argument a;
    a.name = std::string(1, letter);
    a.value = lower_expr(s.args[i + 1], state_);
    call.arguments.push_back(std::move(a));
  }
  if (s.keyword != "MCALL") return call;
  ir::ModalCall modal;
  modal.here = true;
  modal.call = std::move(call);
  return modal;
}

/// EXEC and MEXEC of a program in the memory: it runs as a subroutine does and comes back behind its end (12.8).
Node StatementLowerer::execute(const syntax::Statement& s) {
  constexpr double most = 999999;
  if (s.args.size() != 1) return kept(s, facts::keeps, false);  // from a disk or a computer
  const Expr& e = s.args[0];
  ir::CallRoutine call;
  if (e.kind != ExprKind::number) {
    call.computed = ir::call(ir::Function::to_string, {lower_expr(e, state_)});
  } else {
    if (!whole(e.number, most)) state_.error("FAG-013", e.pos, "a program has a number from 0 to 999999");
    call.routine = program_name(e.number);
  }
  if (s.keyword == "EXEC") return call;
  state_.facts.modal_programs.insert(state_.line().line);
  ir::ModalCall modal;
  modal.here = true;
  modal.call = std::move(call);
  return modal;
}

Node StatementLowerer::message(const syntax::Statement& s) {
  if (s.args.size() != 1 || s.args[0].kind != ExprKind::string) return malformed(s, "MSG needs one text in quotes");
  if (s.args[0].text.size() > static_cast<std::size_t>(facts::max_message)) {
    state_.warning("FAG-034", s.args[0].pos, "the control shows at most 59 characters of a message");
  }
  ir::Message m;
  m.kind = trim(s.args[0].text).empty() ? ir::MessageKind::clear : ir::MessageKind::show;
  m.parts = message_parts(s.args[0].text, state_);
  return m;
}

Node StatementLowerer::error(const syntax::Statement& s) {
  ir::Message m;
  m.kind = ir::MessageKind::error;
  for (const auto& a : s.args) {
    if (a.kind == ExprKind::string)
      m.parts = message_parts(a.text, state_);
    else
      m.number = lower_expr(a, state_);
  }
  if (s.args.empty() || s.args.size() > 2) return malformed(s, "ERROR needs a number, a text or both");
  return m;
}

/// The statement is kept as it was written, without brackets, for its own language.
Node StatementLowerer::file(const syntax::Statement& s) {
  const std::size_t first = text_.find_first_not_of(" \t", 1) + s.pos.column - block_.statements.front().pos.column;
  std::string source(trim(text_.substr(std::min(first, text_.size()), s.pos.length)));
  auto m = s.keyword == "OPEN" ? lower_open(s, std::move(source), state_) : lower_write(s, std::move(source), state_);
  if (m) return std::move(*m);
  return ir::Opaque{std::string(text_), "text.unread", false};
}

Node StatementLowerer::lower(const syntax::Statement& s) {
  const std::string& k = s.keyword;
  if (k == "=") return assign(s);
  if (k == "IF") return condition(s);
  if (k == "GOTO") return jump(s);
  if (k == "RPT") return repeat(s);
  if (k == "CALL" || k == "LL" || k == "PCALL" || k == "MCALL") return call(s);
  if (k == "EXEC" || k == "MEXEC") return execute(s);
  if (k == "OPEN" || k == "WRITE") return file(s);
  if (k == "MSG") return message(s);
  if (k == "ERREUR") {
    state_.note("FAG-039", s.pos, "ERREUR is how the French manual prints ERROR; the control knows ERROR only");
    return error(s);
  }
  if (k == "ERROR") return error(s);
  if (k == "RET") {
    if (!state_.in_subroutine()) return malformed(s, "RET stands outside a subroutine");
    return ir::Return{{}, "RET"};
  }
  if (k == "MDOFF") {
    ir::ModalCall off;
    off.off = off.here = true;  // the modal subroutine only (12.5): a canned cycle stays in force
    return off;
  }
  const auto* info = facts::find_statement(k);
  return kept(s, info != nullptr ? info->feature : facts::keeps,
              info != nullptr && info->carried == facts::Carried::no_path);
}

}  // namespace

std::vector<ir::ExprPtr> message_parts(std::string_view text, LowerState& state) {
  std::vector<ir::ExprPtr> parts;
  std::string plain;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t digits = i + 2;
    while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9') ++digits;
    if (text[i] != '?' || i + 2 >= text.size() || (text[i + 1] != 'P' && text[i + 1] != 'p') || digits == i + 2 ||
        digits > i + 7) {
      plain += text[i++];
      continue;
    }
    const double n = parse_decimal(text.substr(i + 2, digits - i - 2)).value_or(0);
    if (!facts::valid_parameter(saturate<std::int64_t>(n)))
      state.error("FAG-018", {}, "the parameter in " + std::string(text.substr(i, digits - i)) + " does not exist");
    if (!plain.empty()) parts.push_back(ir::string_literal(std::move(plain)));
    plain.clear();
    parts.push_back(ir::numbered(parameter_space, saturate<std::int64_t>(n)));
    i = digits;
  }
  if (!plain.empty() || parts.empty()) parts.push_back(ir::string_literal(std::move(plain)));
  return parts;
}

std::int64_t subroutine_number(const syntax::Statement& s, LowerState& state) {
  const Expr& e = s.args.at(0);
  if (e.kind == ExprKind::number && whole(e.number, static_cast<double>(facts::max_oem_subroutine)))
    return saturate<std::int64_t>(e.number);
  state.error("FAG-013", e.pos, "a subroutine has a fixed number from 0 to 9999");
  return -1;
}

namespace {

/// What is known of the parameters behind the assignments.
void remember(const ir::Assign& a, bool skipped, LowerState& state) {
  for (const auto& i : a.items) {
    if (i.to_system) continue;
    const auto n = ir::constant_value(i.target.index);
    if (!n) {
      state.forget_constants();
      continue;
    }
    const auto value = ir::constant_value(i.value);
    state.assigned(saturate<std::int64_t>(*n), value && !skipped ? &*value : nullptr);
  }
}

}  // namespace

void lower_statement(const syntax::Block& block, std::string_view text, LowerState& state, ir::Statement& out) {
  const syntax::Statement& s = block.statements.front();
  const bool beside = s.keyword == "=" || s.keyword == "MSG" || s.keyword == "OPEN" || s.keyword == "WRITE";
  if (!beside) state.forget_constants();
  if (!beside && s.keyword != "GOTO") state.comp_sure = state.plane_changed = false;
  if (s.keyword == "MCALL" || s.keyword == "MEXEC") state.no_constants();
  if (!block.words.empty() && s.keyword != "RPT") {
    state.error("FAG-016", block.words.front().pos, "a repeat count after a ( ) statement is for RPT only");
  }
  out.node = StatementLowerer(block, text, state).lower(s);
  if (const auto* a = std::get_if<ir::Assign>(&out.node)) remember(*a, out.line.skip_mask != 0, state);
}

void lower_g_call(const syntax::Block& block, const syntax::Word& code, LowerState& state, ir::Statement& out) {
  state.forget_constants();
  ir::CallRoutine call;
  call.routine.number = saturate<std::int64_t>(code.number);
  for (const auto& w : block.words) {
    if (&w == &code) continue;
    const char c = word_letter(w);
    const bool named = c == 'P' && w.extension >= 0;
    if ((named && w.extension > 25) || (c == 'P' && !w.equals) || c == 'G') {
      state.error("FAG-024", w.pos, std::string(word_text(w)) + " is no argument of " + std::string(word_text(code)),
                  "arguments are local parameters: A5, P3=2");
      continue;
    }
    ir::Argument a;
    a.name = std::string(1, named ? facts::parameter_letter(w.extension) : c);
    a.value = ir::as_expr(lower_value(w, block, state));
    call.arguments.push_back(std::move(a));
  }
  if (!call.arguments.empty()) call.level = ir::CallLevel::new_level;
  out.node = std::move(call);
}

}  // namespace cnctrans::fagor
