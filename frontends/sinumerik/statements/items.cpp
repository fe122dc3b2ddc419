// Rows of items: assignments, words, calls and ends that share a block.
#include <algorithm>
#include <memory>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/sinumerik/addresses.h"
#include "dialects/sinumerik/beside.h"
#include "dialects/sinumerik/cycles.h"
#include "dialects/sinumerik/feed_words.h"
#include "dialects/sinumerik/limits.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/statements/row_parts.h"

namespace cnctrans::sinumerik {

using syntax::Block;
using syntax::Expr;
using syntax::ExprKind;
using syntax::Word;

ir::RoutineName routine_name(std::string_view text) {
  ir::RoutineName out;
  out.text = to_upper_ascii(text);
  if (out.text.rfind("_N_", 0) == 0) out.text.erase(0, 3);
  constexpr std::size_t suffix = 4;
  if (out.text.size() > suffix) {
    const std::string_view end = std::string_view(out.text).substr(out.text.size() - suffix);
    if (end == "_SPF" || end == "_MPF" || end == ".SPF" || end == ".MPF") out.text.resize(out.text.size() - suffix);
  }
  const bool numbered = out.text.size() > 1 && out.text.size() <= 8 && out.text[0] == 'L' &&
                        out.text.find_first_not_of("0123456789", 1) == std::string::npos;
  if (numbered) out.number = std::stoll(out.text.substr(1));
  return out;
}

bool StatementLowering::refuse(std::string_view feature, WordPos pos, std::string message, std::string hint) {
  feature_ = feature;
  c_.keep("SIN-008", pos, std::move(message), std::move(hint));
  return false;
}

void StatementLowering::emit(ir::LineInfo& info, ir::StatementNode node) {
  ir::Statement s;
  s.line = info;
  s.node = std::move(node);
  structure_->add(std::move(s));
  // What follows in the same source line has no number, label or comment of its own.
  info.number = {};
  info.labels.clear();
  info.comments.clear();
  info.joined = true;
  info.blank_lines_before = 0;
}

ir::LineInfo StatementLowering::further_line(const ir::LineInfo& info) {
  ir::LineInfo line;
  line.span = info.span;
  line.skip_mask = info.skip_mask;
  return line;
}

// --- assignments ------------------------------------------------------------------------------------------------

namespace {

/// AX1, AX2 and so on: the machine's own name of an axis, which the program's list of axes need not have.
bool machine_axis_name(const ir::Expr& e) {
  const auto* s = std::get_if<ir::SystemRef>(&e.node);
  return s != nullptr && s->datum == ir::Datum::other && s->args.empty() && s->text.size() > 2 &&
         s->text.starts_with("AX") && s->text.find_first_not_of("0123456789", 2) == std::string::npos;
}

}  // namespace

bool StatementLowering::assign_system(const Expr& target, const Expr& value, WordPos pos, Parts& parts) {
  const std::uint32_t before = c_.errors;
  ir::Assign::Item item;
  item.system = exprs_.system(target);
  item.to_system = true;
  item.pos = pos;
  if (c_.errors != before) return false;
  const bool tool_data = target.text.rfind("$TC_", 0) == 0;
  const std::string_view beside_path = beside_datum(target.text);
  // While every base frame is neutral, a mask changes nothing.
  const bool mask = (target.text == "$P_CHBFRMASK" || target.text == "$P_NCBFRMASK") && !c_.said.contains("$P_BFRAME");
  if (mask) c_.said.emplace("$P_CHBFRMASK");
  const bool storage = mask || target.text == "$AC_MARKER" || target.text == "$AC_PARAM" ||
                       item.system.datum == ir::Datum::part_count || !beside_path.empty();
  note_carrier(target, value);
  if (tool_data && c_.first_time("$TC_"))
    c_.note("SIN-009", pos, "tool data are kept: they do not change the programmed path");
  if (item.system.datum != ir::Datum::work_offset && item.system.datum != ir::Datum::work_offset_fine && !tool_data &&
      !storage) {
    return refuse("language.system_variable", pos,
                  "writing " + target.text + " is not carried yet: it could change what the machine does");
  }
  item.value = exprs_.lower(value);
  if (!item.value) return false;
  const bool number = item.value->type != ir::Type::string && item.value->type != ir::Type::axis;
  const bool named = std::any_of(item.system.args.begin(), item.system.args.end(),
                                 [](const ir::ExprPtr& a) { return a->type == ir::Type::string; });
  if (!beside_path.empty() && (!number || named || machine_axis_name(*item.value))) {
    put_beside(beside_path, pos, parts);
    return true;
  }
  if (!beside_path.empty()) tell_beside(pos, std::string(c_.slice(pos)), beside_path);
  if (tool_data && (item.value->type == ir::Type::string || item.value->type == ir::Type::axis)) {
    ir::Action a;  // the name of a tool, an axis of a tool carrier
    a.pos = pos;
    a.text = c_.slice(pos);
    a.data = ir::OpaqueWord{a.text};
    a.order = ir::Order::with;
    parts.actions.push_back(std::move(a));
    return true;
  }
  item.value = exprs_.lower_as(value, ir::Type::real);
  if (!item.value) return false;
  parts.assign.items.push_back(std::move(item));
  return true;
}

/// MX, MX1, XA2: what machine builders call axes.
bool StatementLowering::reads_like_axis(std::string_view name) {
  constexpr std::string_view letters = "XYZABCUVWQ";
  if (name.empty() || name.size() > 4) return false;
  const std::string_view rest = name[0] == 'M' ? name.substr(1) : name;
  const bool letter = !rest.empty() && letters.find(rest[0]) != std::string_view::npos;
  return letter && rest.find_first_not_of("0123456789", 1) == std::string_view::npos &&
         (name[0] == 'M' || rest.size() > 1);
}

/// A name that is not defined here gets a value: from there on it is known.
bool StatementLowering::assign_undefined(const Expr& target, const Expr& value, WordPos pos, Parts& parts) {
  if (value.kind == ExprKind::call && attribute(value.text) != Attribute::none) {
    return refuse("machine.axis", pos,
                  target.text + " is an axis that the machine " + c_.machine.profile->name + " does not have");
  }
  if (reads_like_axis(target.text)) {
    return refuse(
        "machine.axis", pos,
        target.text + " reads like an axis, and the machine " + c_.machine.profile->name + " has none of this name",
        "add the axis to the profile, or define the variable with DEF; the block is kept as text");
  }
  const std::uint32_t before = c_.errors;
  ir::Assign::Item item;
  item.system = exprs_.undefined(target);
  item.to_system = true;
  item.pos = pos;
  item.value = exprs_.lower(value);
  if (!item.value || c_.errors != before) return false;
  if (item.value->type == ir::Type::string || item.value->type == ir::Type::axis) {
    return refuse("language.system_variable", pos,
                  "a text or an axis for " + target.text + ", which is not defined here, is not carried yet");
  }
  parts.assign.items.push_back(std::move(item));
  return true;
}

bool StatementLowering::assign(const Expr& target, const Expr& value, WordPos pos, Parts& parts) {
  if (target.text.size() > 1 && target.text[0] == '$') {
    if (const auto done = assign_frame(target, value, pos, parts.assign, parts.actions)) return *done;
    const bool r_cell = target.text[1] == 'R' && target.text.find_first_not_of("0123456789", 2) == std::string::npos;
    if (!r_cell) return assign_system(target, value, pos, parts);
    Expr cell = target;  // $R10, $R[10]
    cell.text = "R";
    if (target.text.size() > 2) {
      Expr index;
      index.kind = ExprKind::number;
      index.text = target.text.substr(2);
      index.number = std::stod(index.text);
      index.pos = target.pos;
      cell.args.assign(1, std::move(index));
    }
    return assign(cell, value, pos, parts);
  }
  if (const auto done = assign_frame(target, value, pos, parts.assign, parts.actions)) return *done;
  if (value.kind == ExprKind::call && value.text == "ADDFRAME") return add_frame(target, value, pos, parts);
  const Symbol* symbol = c_.symbol(target.text);
  if (symbol != nullptr && symbol->type == ir::Type::string && target.args.size() == symbol->dimensions + 1U)
    return assign_character(target, value, pos, parts.assign);
  const bool list = value.kind == ExprKind::call && (value.text == "SET" || value.text == "REP" || value.text.empty());
  if (exprs_.is_undefined(target) && !list) return assign_undefined(target, value, pos, parts);
  ir::Type type = ir::Type::real;
  auto ref = exprs_.variable(target, type);
  if (!ref) return false;
  if (value.text == "DELDL") {  // sum offsets act beside the path; 0: done
    tell_beside(pos, std::string(c_.slice(pos)), "beside.compensation");
    ir::Assign::Item done;
    done.target = std::move(*ref);
    done.value = ir::number(0);
    done.pos = pos;
    parts.assign.items.push_back(std::move(done));
    return true;
  }
  if (list) return assign_list(*ref, type, value, c_.symbol(target.text), pos, parts.assign);
  if (value.kind == ExprKind::call && value.text == "CALCDAT") return circle_data(*ref, value, pos, parts.assign);
  if (value.kind == ExprKind::call && value.text == "INTERSEC") return crossing(*ref, value, pos, parts.assign);
  ir::Assign::Item item;
  item.target = std::move(*ref);
  GivenBack given(c_, parts.assign, pos);
  item.value = symbol != nullptr && symbol->character ? exprs_.lower_character(value) : exprs_.lower_as(value, type);
  item.pos = pos;
  if (!item.value) return false;
  parts.assign.items.push_back(std::move(item));
  return true;
}

bool StatementLowering::sort_assignment(const syntax::Statement& s, Parts& parts) {
  const Expr& target = s.args[0];
  const Expr& value = s.args[1];
  const bool one_index = target.args.size() == 1;
  if (target.text == "R" || target.text[0] == '$' || c_.symbol(target.text) != nullptr)
    return assign(target, value, s.pos, parts);
  if (target.text == "PO") return polynomial_item(s, parts);
  if (target.text == "G" && one_index) return indirect_g(s, parts);
  if (target.text == "SPOS" || target.text == "SPOSA" || target.text == "LIMS" || target.text == "S")
    return spindle_item(s, parts);
  if (target.text == "POS" || target.text == "POSA" || target.text == "FA" || target.text == "AX" ||
      target.text == "IP")
    return axis_item(s, parts);
  if ((target.text == "MEASA" || target.text == "MEAWA") && one_index) return probe_item(s, parts);
  if (is_timing_of_axis(target.text)) {
    parts.act(ir::OpaqueWord{c_.slice(s.pos)}, s.pos, c_.slice(s.pos)).order = ir::Order::with;
    c_.note("SIN-009", s.pos, kept_text(target.text, "[]"));
    return true;
  }
  if (is_reserved(target.text)) return refuse("block.word", s.pos, target.text + "[...]= is not carried yet");
  return assign(target, value, s.pos, parts);
}

// --- words that are no addresses --------------------------------------------------------------------------------

bool StatementLowering::sort_word(const Block& block, const Word& w, Parts& parts) {
  std::string name = to_upper_ascii(w.address);
  const auto expression = [&]() -> Expr {
    if (w.is_expression) return block.exprs[static_cast<std::size_t>(w.expr)];
    Expr e;  // a plain number, perhaps with a sign
    e.kind = ExprKind::number;
    e.text = w.number_text;
    e.number = w.number;
    e.pos = WordPos{w.pos.column + w.pos.length - static_cast<std::uint32_t>(w.number_text.size()),
                    static_cast<std::uint32_t>(w.number_text.size())};
    return e;
  };
  Expr target{ExprKind::name, name, 0, {}, w.pos};
  if (w.equals && name == "R" && w.extension >= 0) {
    target.kind = ExprKind::variable;
    Expr index;
    index.kind = ExprKind::number;
    index.number = w.extension;
    index.text = std::to_string(w.extension);
    index.pos = w.pos;
    target.args.push_back(std::move(index));
    return assign(target, expression(), w.pos, parts);
  }
  if (w.equals && w.extension < 0 &&
      (c_.symbol(name) != nullptr ||
       (name.size() > 1 && !is_reserved(name) && c_.machine.axis(name) == ir::axis::none))) {
    if (c_.symbol(name) != nullptr && c_.machine.axis(name) != ir::axis::none)
      c_.warning("SIN-144", w.pos,
                 name + " is a variable here, and the name of an axis: the word sets the variable and moves nothing",
                 "give the variable another name");
    return assign(target, expression(), w.pos, parts);
  }
  const std::string whole = w.extension >= 0 ? name + std::to_string(w.extension) : name;
  if (w.equals && w.extension >= 0 && c_.symbol(whole) != nullptr) {  // a variable called F1
    target.text = whole;
    return assign(target, expression(), w.pos, parts);
  }
  if (w.has_value && c_.symbol(whole) == nullptr && is_predefined(whole))
    return refuse(procedure_missing_feature(whole), w.pos, whole + " is not carried yet");
  if (name == "P" && w.has_value && w.extension < 0) {
    parts.has_count = true;
    parts.count = exprs_.lower_as(expression(), ir::Type::integer);
    parts.count_pos = w.pos;
    return parts.count != nullptr;
  }
  if (name == "L" && w.has_value && !w.equals &&
      w.number_text.find_first_not_of("0123456789") == std::string_view::npos) {
    name += w.number_text;
    return sort_call(std::move(name), {}, w.pos, parts);
  }
  if (!w.has_value && name.size() > 1 && g_function(name) == nullptr) {
    if (c_.symbol(name) != nullptr || named_word(name) != nullptr) {
      c_.error("SIN-004", w.pos, name + " has no value");
      return false;
    }
    return sort_call(std::move(name), {}, w.pos, parts);
  }
  parts.words.words.push_back(w);
  return true;
}

// --- calls ------------------------------------------------------------------------------------------------------

bool StatementLowering::predefined(Procedure use, const std::string& name, const std::vector<Expr>& args, WordPos pos,
                                   Parts& parts) {
  switch (use) {
    case Procedure::message: return message(args, pos, parts);
    case Procedure::set_alarm: return alarm(args, pos, parts);
    case Procedure::stop_preparation: {
      if (c_.real_time.moved && !c_.real_time.locked) c_.real_time = {};
      ir::Action a;
      a.data = ir::PreparationStop{};
      a.pos = pos;
      a.text = c_.slice(pos);
      parts.actions.push_back(std::move(a));
      return true;
    }
    case Procedure::repeat_return: {
      ir::Return back{{}, c_.slice(pos)};
      if (!return_target(args, pos, back)) return false;
      parts.calls.emplace_back(std::move(back));
      return true;
    }
    case Procedure::program_start: return program_start(pos, parts);
    case Procedure::master_spindle: return master_spindle(args, pos, parts);
    case Procedure::axis_setting: return axis_setting(name, args, pos, parts);
    case Procedure::screen:
    case Procedure::timing: return without_effect(name, pos, parts);
    case Procedure::transformation: return transformation(name, args, pos, parts);
    case Procedure::coordination: {
      ir::Action a;
      a.data = ir::OpaqueWord{c_.slice(pos)};
      a.pos = pos;
      a.text = c_.slice(pos);
      parts.actions.push_back(std::move(a));
      c_.warning(
          "SIN-042", pos,
          name + " acts on other channels, interrupts or axes: a run passes over it, and no other control gets it");
      return true;
    }
    case Procedure::spline_axes: return spline_axes(args, pos, parts);
    case Procedure::polynomial_path: return polynomial_path(args, pos, parts);
    case Procedure::geometry_axes: return exchange_geometry_axes(pos, parts);
    case Procedure::preset: return preset(name, args, pos, parts);
    case Procedure::none:
    case Procedure::unsupported: break;
  }
  return refuse(procedure_missing_feature(name), pos, name + " is not carried yet");
}

bool StatementLowering::call_arguments(const std::string& name, const std::vector<Expr>& args, ir::CallRoutine& call) {
  const auto external = externs_.find(name);
  for (std::size_t i = 0; i < args.size(); ++i) {
    ir::Argument a;
    if (args[i].kind != ExprKind::missing) {
      ir::Type type = ir::Type::real;
      if (auto array = exprs_.whole_array(args[i], type)) {
        a.reference = *array;
        a.by_reference = true;
        a.value = make_expr(std::move(*array), type, args[i].pos);
        call.arguments.push_back(std::move(a));
        continue;
      }
      a.value = exprs_.lower(args[i]);
      if (!a.value) return false;
      a.by_reference = external != externs_.end() && i < external->second.size() && external->second[i];
      if (const auto* v = std::get_if<ir::VarRef>(&a.value->node)) a.reference = *v;
      const auto* datum = std::get_if<ir::SystemRef>(&a.value->node);
      if (a.by_reference && datum != nullptr) {
        return refuse("language.system_variable", args[i].pos,
                      name + " wants a variable of the program here, and " + datum->text + " is not defined in it");
      }
      if (a.by_reference && !std::holds_alternative<ir::VarRef>(a.value->node)) {
        c_.error("SIN-012", args[i].pos, name + " wants a variable here (VAR parameter)");
        return false;
      }
    }
    call.arguments.push_back(std::move(a));
  }
  return true;
}

bool StatementLowering::sort_call(std::string name, const std::vector<Expr>& args, WordPos pos, Parts& parts) {
  if (const Procedure use = procedure(name); use != Procedure::none) return predefined(use, name, args, pos, parts);
  const CycleRow* row = c_.cycle_called(name, pos);
  const bool own_program = row == nullptr && sinumerik::cycle(name) != nullptr;
  // Without arguments, or with the data record "0", it ends the swivelled plane (18.5).
  const bool bare = std::all_of(args.begin(), args.end(), [](const Expr& e) { return e.kind == ExprKind::missing; });
  const bool ends = bare || (args.size() > 1 && args[1].kind == ExprKind::string && args[1].text == "0");
  if (row != nullptr && name == "CYCLE800") return ends ? swivel_end(pos, parts) : swivel(args, pos, parts);
  if (!own_program && moves_nothing(name, args, pos)) return without_effect(name, pos, parts);
  if (name == "PO") return denominator(args, pos, parts);
  if (row != nullptr) {
    ir::CyclePtr made = cycle(name, args, pos);
    if (!made) return false;
    ir::Action a;
    a.data = ir::CycleDefine{std::move(made), false, true, ir::CycleTrigger::path_motion};
    a.pos = pos;
    a.text = c_.slice(pos);
    parts.actions.push_back(std::move(a));
    return true;
  }
  if (c_.symbol(name) != nullptr || (!own_program && is_reserved(name))) {
    return refuse("language.statement", pos, name + " can't be called, or is not carried yet");
  }
  if (call_in_real_time(pos)) return false;
  ir::CallRoutine call;
  call.routine = routine_name(name);
  c_.interrupt_lasting();
  c_.plane.reset();
  c_.css.reset();
  c_.units_called = true;
  if (!call_arguments(name, args, call)) return false;
  parts.calls.emplace_back(std::move(call));
  return true;
}

// --- the row ----------------------------------------------------------------------------------------------------

bool StatementLowering::sort_items(const Block& block, Parts& parts) {
  parts.words.exprs = block.exprs;
  bool ok = true;
  std::size_t w = 0;
  std::size_t s = 0;
  while (w < block.words.size() || s < block.statements.size()) {
    const bool word_next = s == block.statements.size() ||
                           (w < block.words.size() && block.words[w].pos.column < block.statements[s].pos.column);
    if (word_next) {
      const Word& word = block.words[w++];
      ok = (beside_word(word, parts) || sort_word(block, word, parts)) && ok;
      continue;
    }
    const syntax::Statement& next = block.statements[s++];
    if (beside_statement(next, parts)) continue;
    ok = (next.keyword == "=" ? sort_assignment(next, parts) : sort_call(next.text, next.args, next.pos, parts)) && ok;
  }
  return ok;
}

bool StatementLowering::items(const Block& block, ir::LineInfo info) {
  if (interrupt_routine(block, info) || return_move(block, info) || run_element(block, info) ||
      chosen_by_index(block, info) || split_block(block, info)) {
    return true;
  }
  Parts parts;
  bool ok = sort_items(block, parts);
  ir::Block words;
  const bool has_words = !parts.words.words.empty() || !parts.indirect.empty();
  if (ok && has_words) {
    ok = words_.lower(parts.words, parts.indirect, words);
    if (!ok && !words_.feature().empty()) feature_ = words_.feature();
  }
  ok = ok && put_axis_words(parts, words);
  const Tail tail = has_words ? words_.tail() : Tail::none;
  const bool own_words = std::all_of(parts.assign.items.begin(), parts.assign.items.end(), [](const auto& item) {
    return item.to_system && item.system.datum == ir::Datum::axis_feed;  // FA[X]= is a word as well
  });
  if (ok && !own_words && !words.motion.coords.empty()) {
    if (parts.assign.items.front().to_system) {
      c_.keep("SIN-011", parts.assign.items.front().pos,
              parts.assign.items.front().system.text + " shares a block with axis words: an axis that the machine " +
                  c_.machine.profile->name + " does not have");
    } else {
      c_.error("SIN-011", words.motion.coords.front().pos,
               "an assignment can't share a block with axis words (alarm 12080)",
               "write the assignment in the block before");
    }
    ok = false;
  }
  if (ok && parts.has_count) {
    auto* call = parts.calls.size() == 1 ? std::get_if<ir::CallRoutine>(&parts.calls[0]) : nullptr;
    if (call == nullptr) {
      c_.error("SIN-003", parts.count_pos, "P says how often a subprogram runs; here none is called");
      ok = false;
    } else {
      call->count = std::move(parts.count);
    }
  }
  if (ok && parts.calls.size() > 1) {
    c_.error("SIN-005", WordPos{}, "only one call may stand in a block");
    ok = false;
  }
  if (!ok) {
    add_opaque(block, std::move(info), feature_, false);
    return false;
  }
  for (auto& a : parts.actions) words.actions.push_back(std::move(a));
  if (!parts.assign.items.empty()) emit(info, std::move(parts.assign));
  const bool nothing_else = parts.calls.empty() && parts.beside_text.empty() && tail == Tail::none;
  if (!words.empty() || (nothing_else && !info.joined)) emit(info, std::move(words));
  turn_with_table(block, info);
  if (!parts.beside_text.empty()) {
    ir::Opaque o;
    o.text = std::move(parts.beside_text);
    o.feature = parts.beside_feature;
    emit(info, std::move(o));
  }
  for (auto& call : parts.calls) emit(info, std::move(call));
  if (tail == Tail::program_end) emit(info, ir::End{c_.slice(words_.tail_pos()), true});
  if (tail == Tail::subprogram_end) emit(info, ir::Return{{}, c_.slice(words_.tail_pos())});
  return true;
}

}  // namespace cnctrans::sinumerik
