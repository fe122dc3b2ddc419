// Statements: assignments, structures, jumps, calls, messages, definitions (reference-language 3, 6-9).
#include "backends/sinumerik/tables.h"
#include "backends/sinumerik/writer.h"
#include "base/saturate.h"
#include "base/text.h"
#include "dialects/sinumerik/computed.h"
#include "ir/geometry/contour.h"

namespace cnctrans::backends::sinumerik {

/// Reports what the expression printer could not say; true when there was something.
bool Writer::refused_problem(WordPos pos) {
  WordPos at;
  const std::string problem = expressions_.take_problem(&at);
  if (problem.empty()) return refused();
  refuse("TRN-203", at.column != 0 ? at : pos, problem);
  return true;
}

/// A list of values or a frame that stands for several assignments, as it was written; empty: there is none.
std::string Writer::list_text(const ir::Assign& a) const {
  if (!same_dialect() || a.items.empty()) return {};
  for (const ir::Assign::Item& item : a.items) {
    if (item.pos.column != a.items.front().pos.column) return {};
  }
  const std::string text = source_word(a.items.front().pos);
  const std::string upper = to_upper_ascii(text);
  if (cnctrans::sinumerik::is_computed_text(upper)) return text;
  if (a.items.size() < 2) return {};
  const ir::Assign::Item& first = a.items.front();
  const std::string name = first.to_system             ? to_upper_ascii(first.system.text)
                           : first.target.name.empty() ? std::string("R")
                                                       : to_upper_ascii(first.target.name);
  const bool list = upper.find("=(") != std::string::npos || upper.find("SET(") != std::string::npos ||
                    upper.find("REP(") != std::string::npos || upper.find("CTRANS(") != std::string::npos ||
                    upper.find("= (") != std::string::npos || upper.find("SET (") != std::string::npos;
  return upper.rfind(name, 0) == 0 && list && upper.back() == ')' ? text : std::string{};
}

void Writer::assign(const ir::Assign& a) {
  if (same_dialect() && !a.items.empty() && list_written_ && stands_already(a.items.front().pos)) return;
  list_written_ = false;
  if (std::string text = list_text(a); !text.empty()) {
    list_written_ = true;
    stands_already(a.items.front().pos);
    return add(std::move(text), Rank::head, a.items.front().pos);
  }
  for (const ir::Assign::Item& item : a.items) {
    if (same_dialect() && item.pos.column != 0 && item.pos.length == 0) continue;  // a part of another statement
    if (std::string part = expressions_.component_assignment(item); !part.empty()) {
      if (refused_problem(item.pos)) return;
      add(std::move(part), Rank::head, item.pos);
      continue;
    }
    if (std::string part = same_dialect() ? expressions_.character_assignment(item) : std::string{}; !part.empty()) {
      if (refused_problem(item.pos)) return;
      add(std::move(part), Rank::head, item.pos);
      continue;
    }
    std::string text = item.to_system ? expressions_.name(item.system) : expressions_.name(item.target);
    const ir::Type type = item.to_system ? ir::Type::real : expressions_.type_of(item.target);
    text += '=';
    text += expressions_.assigned(item.value, type);
    if (refused_problem(item.pos)) return;
    add(std::move(text), Rank::head, item.pos);
  }
}

bool Writer::condition(const ir::ExprPtr& e, std::string& text) {
  text = expressions_.condition(e);
  return !refused_problem();
}

// ---- structures ----------------------------------------------------------------------------------------------------

/// A label may not stand in a block with a control structure (reference-language 7.1).
void Writer::open_structure() {
  next_line();
  if (!same_dialect()) label_line();
}

void Writer::close_structure(const ir::LineInfo& info, const std::string& keyword) {
  if (same_dialect() || info.labels.empty()) return keyword_line(info, keyword);
  const bool past = keyword == "ENDIF";  // the label of a closing line leads past an IF, and to the head of a loop
  if (past) keyword_line(ir::LineInfo{}, keyword);
  begin_line(info);
  label_line();
  if (!past) add(keyword, Rank::head);
  finish_line();
}

void Writer::if_else(const ir::If& i) {
  std::string text;
  if (!condition(i.condition, text)) return refuse_structure({});
  open_structure();
  add("IF " + text, Rank::head);
  nested(i.then_body);
  if (i.has_else || !i.else_body.empty()) {
    close_structure(i.else_line, "ELSE");
    nested(i.else_body);
  }
  close_structure(i.end_line, "ENDIF");
}

void Writer::while_loop(const ir::While& w) {
  std::string text;
  if (!condition(w.condition, text)) return refuse_structure({});
  open_structure();
  add("WHILE " + text, Rank::head);
  nested(w.body);
  close_structure(w.end_line, "ENDWHILE");
}

void Writer::until_loop(const ir::Until& u) {
  std::string text;
  if (!condition(u.condition, text)) return refuse_structure({});
  open_structure();
  add("REPEAT", Rank::head);
  nested(u.body);
  close_structure(u.end_line, "UNTIL " + text);
}

void Writer::for_loop(const ir::For& f) {
  if (f.step) {
    const auto step = ir::constant_value(f.step);
    if (!step || *step != 1) refuse("TRN-201", {}, "a FOR loop of this control counts up by 1 only");
  }
  std::string text = "FOR " + expressions_.name(f.counter) + '=';
  text += expressions_.assigned(f.from, ir::Type::integer);
  text += " TO " + expressions_.assigned(f.to, ir::Type::integer);
  if (refused_problem()) return refuse_structure({});
  open_structure();
  add(std::move(text), Rank::head);
  nested(f.body);
  close_structure(f.end_line, "ENDFOR");
}

void Writer::endless_loop(const ir::Loop& l) {
  open_structure();
  add("LOOP", Rank::head);
  nested(l.body);
  close_structure(l.end_line, "ENDLOOP");
}

/// In the control's own language the text is written where it stood.
void Writer::unread_structure(const ir::Statement& s, const ir::Opaque& text) {
  if (!same_dialect()) return ProgramWriter::unread_structure(s, text);
  const auto rest = [](const ir::Body& body) { return ir::Body(body.begin() + 1, body.end()); };
  next_line();
  if (const auto* u = std::get_if<ir::Until>(&s.node)) {  // the text follows as a statement of its own
    add("REPEAT", Rank::head);
    return nested(u->body);
  }
  add(text.text, Rank::head);
  if (const auto* i = std::get_if<ir::If>(&s.node)) {
    nested(rest(i->then_body));
    if (i->has_else || !i->else_body.empty()) {
      keyword_line(i->else_line, "ELSE");
      nested(i->else_body);
    }
    keyword_line(i->end_line, "ENDIF");
  } else if (const auto* w = std::get_if<ir::While>(&s.node)) {
    nested(rest(w->body));
    keyword_line(w->end_line, "ENDWHILE");
  } else if (const auto* f = std::get_if<ir::For>(&s.node)) {
    nested(rest(f->body));
    keyword_line(f->end_line, "ENDFOR");
  }
}

// ---- jumps ---------------------------------------------------------------------------------------------------------

std::string Writer::target_text(const ir::LabelRef& label) {
  if (label.computed) {
    if (label.computed->type == ir::Type::string) return expressions_.print(label.computed);
    return "\"N\"<<" + expressions_.operand(label.computed, primary_level, false);
  }
  return label.is_number ? number_target(label) : label.text;
}

std::string Writer::goto_text(const ir::Jump& j) {
  std::string_view word;
  switch (j.search) {
    case ir::Search::forward: word = "GOTOF "; break;
    case ir::Search::backward: word = "GOTOB "; break;
    case ir::Search::forward_then_backward: word = j.quiet ? "GOTOC " : "GOTO "; break;
    case ir::Search::to_start:
      if (same_dialect()) return "GOTOS";
      [[fallthrough]];
    case ir::Search::whole_first:
      refuse("TRN-206", {}, "a jump that searches from the program start has no counterpart here");
      return {};
  }
  if (j.quiet && j.search != ir::Search::forward_then_backward) {
    refuse("TRN-206", {}, "a jump that passes over a missing label must search both ways here");
  }
  return std::string(word) + target_text(j.target);
}

void Writer::jump(const ir::Jump& j) {
  std::string text;
  if (j.condition && !condition(j.condition, text)) return;
  if (j.condition) text = "IF " + text + ' ';
  text += goto_text(j);
  if (refused_problem()) return;
  add(std::move(text), Rank::tail);
}

void Writer::switch_jump(const ir::Switch& s) {
  std::string text = "CASE(" + expressions_.assigned(s.value, ir::Type::integer) + ") OF";
  for (const auto& [value, jump] : s.cases) {
    text += ' ' + expressions_.print(value) + ' ' + goto_text(jump);
  }
  for (const ir::Jump& fallback : s.fallback) text += " DEFAULT " + goto_text(fallback);
  if (refused_problem()) return;
  add(std::move(text), Rank::head);
}

void Writer::repeat(const ir::Repeat& r) {
  if (r.has_program) return refuse("TRN-201", {}, "a range of another program can't be repeated in place here");
  const bool one_block = !r.last.text.empty() && r.first.text == r.last.text && r.first.is_number == r.last.is_number;
  const bool to_here = r.last.text.empty() && !r.last.computed;
  std::string text = (one_block ? "REPEATB " : "REPEAT ") + target_text(r.first);
  if (!one_block && !to_here && r.last.text != "ENDLABEL") text += ' ' + target_text(r.last);
  if (r.count) {
    const bool number = ir::constant_value(r.count).has_value();
    text += " P=";
    text += number ? expressions_.print(r.count) : expressions_.assigned(r.count, ir::Type::integer);
  }
  if (refused_problem()) return;
  add(std::move(text), Rank::head);
}

// ---- calls ---------------------------------------------------------------------------------------------------------

std::size_t Writer::routine_of(const ir::RoutineName& name) const {
  const auto& routines = program().routines;
  for (std::size_t i = 0; i < routines.size(); ++i) {
    if (routines[i].name == name) return i;
  }
  return routine_index();
}

std::string Writer::call_text(const ir::CallRoutine& c) {
  if (c.tail || c.optional)
    refuse("TRN-201", {}, "a call that does not come back, or that may fail, has no counterpart here");
  if (c.has_range) {
    const std::size_t in = c.routine.empty() ? routine_index() : routine_of(c.routine);
    const auto border = [&](const ir::LabelRef& l) { return l.is_number ? number_target(in, l) : target_text(l); };
    std::string text = "CALL ";
    if (!c.routine.empty()) text += '"' + sub_name(c.routine) + "\" ";
    return text + "BLOCK " + border(c.first) + " TO " + border(c.last);
  }
  if (c.computed) {
    const auto* rounded = std::get_if<ir::Call>(&c.computed->node);
    const bool number = !same_dialect() && rounded != nullptr && rounded->function == ir::Function::to_string;
    if (number) return "CALL \"L\"<<" + expressions_.operand(rounded->args[0], primary_level, false);
    if (c.computed->type == ir::Type::string) return "CALL " + expressions_.print(c.computed);
    // Reading rounds the number to a whole one; the language does that by itself.
    const bool implied = rounded != nullptr && rounded->args.size() == 1 &&
                         (rounded->function == ir::Function::round || rounded->function == ir::Function::to_integer);
    return "CALL \"L\"<<" + expressions_.operand(implied ? rounded->args[0] : c.computed, primary_level, false);
  }
  std::string text = sub_name(c.routine);
  if (c.arguments.empty() && legal_name(text).empty() && c.routine.number < 0) return "CALL \"" + text + '"';
  if (!c.arguments.empty()) {
    text += '(';
    for (std::size_t i = 0; i < c.arguments.size(); ++i) {
      if (i != 0) text += ',';
      const ir::Argument& a = c.arguments[i];
      if (a.by_reference) {
        text += expressions_.name(a.reference);
      } else if (a.value) {
        text += expressions_.print(a.value);
      }
    }
    text += ')';
  }
  return text;
}

void Writer::call(const ir::CallRoutine& c) {
  std::string text = call_text(c);
  if (c.count) {
    const bool number = ir::constant_value(c.count).has_value();
    text += number ? " P" : " P=";
    text += expressions_.assigned(c.count, ir::Type::integer);
  }
  if (refused_problem()) return;
  add(std::move(text), Rank::tail);
}

void Writer::modal_call(const ir::ModalCall& c) {
  if (c.off) return add("MCALL", Rank::head);
  const std::string text = c.cycle ? cycle_text(*c.cycle, {}) : call_text(c.call);
  if (refused_problem()) return;
  if (c.here) {
    add(text, Rank::head);
    next_line();
  }
  add("MCALL " + text, Rank::head);
}

void Writer::return_from(const ir::Return& r) {
  if (!r.values.empty() && !same_dialect())
    return refuse("TRN-201", {}, "a return with values has no counterpart here");
  add(same_dialect() && !r.text.empty() ? std::string(r.text) : "M17", Rank::tail);
}

void Writer::end_program(const ir::End& e) {
  const bool sub = routine().kind == ir::RoutineKind::sub;
  if (sub && !e.returns_from_sub) {
    return refuse("TRN-201", {}, "the end of the whole program inside a subprogram: here M30 would only return from it",
                  "let the subprogram return and end the main program");
  }
  add(same_dialect() && !e.text.empty() ? std::string(e.text) : "M30", Rank::tail);
}

// ---- messages, definitions -----------------------------------------------------------------------------------------

std::string Writer::text_parts(const std::vector<ir::ExprPtr>& parts) {
  std::string text;
  for (const ir::ExprPtr& p : parts) {
    const bool is_text = p && p->type == ir::Type::string;
    if (!text.empty() || !is_text) text += "<<";
    constexpr int tighter_than_concat = 3;
    text += expressions_.operand(p, tighter_than_concat, true);
  }
  return text;
}

void Writer::message(const ir::Message& m) {
  std::string text;
  if (!m.file_line.empty()) return add(m.file_line, Rank::head);
  switch (m.kind) {
    case ir::MessageKind::clear: text = "MSG()"; break;
    case ir::MessageKind::show: text = "MSG(" + text_parts(m.parts) + ')'; break;
    case ir::MessageKind::error: {
      constexpr std::int64_t first_user_alarm = 65000;
      const auto number = m.number ? ir::constant_value(m.number) : std::optional<double>(0);
      const bool own_number = same_dialect() || (number && *number >= first_user_alarm && *number <= 69999);
      text = "SETAL(";
      if (own_number && m.number) {
        text += expressions_.assigned(m.number, ir::Type::integer);
      } else if (number && *number >= 0 && *number <= 4999) {
        text += std::to_string(first_user_alarm + saturate<std::int32_t>(*number));
      } else {
        refuse("TRN-201", {}, "this error number has no counterpart among the user alarms (65000 to 69999)");
      }
      if (!m.parts.empty()) text += ',' + text_parts(m.parts);
      text += ')';
      break;
    }
  }
  if (refused_problem()) return;
  add(std::move(text), Rank::head);
  if (m.kind != ir::MessageKind::error || same_dialect()) return;
  diagnostics().warning("TRN-215", current().line.span,
                        "the error stops the source's run; here an alarm is shown and M0 follows, and START goes on",
                        "end the program there if nothing must follow");
  for (const char* word : {"STOPRE", "M0"}) {
    next_line();
    add(word, Rank::head);
  }
}

/// A line by ANG= alone needs no further word: the control finds its end with the next block.
void Writer::opaque_word(const ir::Action& a, const ir::OpaqueWord& w) {
  const auto* block = std::get_if<ir::Block>(&current().node);
  const bool by_angle = block != nullptr && block->motion.extra && block->motion.extra->has_line_angle;
  if (same_dialect() && by_angle && w.word == ir::contour::mark::secant) return;
  ProgramWriter::opaque_word(a, w);
}

void Writer::declare(const ir::Declare& d) {
  std::string text = "DEF ";
  const bool own_type = same_dialect() && !d.type_text.empty();
  text += own_type ? d.type_text : std::string(type_word(d.type));
  for (std::size_t i = 0; i < d.items.size(); ++i) {
    const ir::Declare::Item& item = d.items[i];
    text += (i == 0 ? " " : ",") + item.name;
    for (std::size_t k = 0; k < item.dimensions.size(); ++k) {
      text += (k == 0 ? "[" : ",") + expressions_.print(item.dimensions[k]);
    }
    if (!item.dimensions.empty()) text += ']';
    const bool by_limits = own_type && item.initial.size() == 1 && item.initial[0]->pos.column == 0;
    if (item.initial.size() == 1 && item.dimensions.empty() && !by_limits) {
      text += '=' + expressions_.assigned(item.initial[0], d.type);
    } else if (!item.initial.empty() && !by_limits) {
      text += "=SET(";
      for (std::size_t k = 0; k < item.initial.size(); ++k) {
        text += (k == 0 ? "" : ",") + expressions_.assigned(item.initial[k], d.type);
      }
      text += ')';
    }
  }
  if (refused_problem()) return;
  add(std::move(text), Rank::head);
}

}  // namespace cnctrans::backends::sinumerik
