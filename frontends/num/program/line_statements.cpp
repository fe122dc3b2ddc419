// The statements of one line, in the order the control carries them out: assignments, message, words, jump or call,
// end.
#include <algorithm>
#include <utility>

#include "base/text.h"
#include "dialects/num/limits.h"
#include "dialects/num/variables.h"
#include "frontends/common/nesting.h"
#include "frontends/num/program/lines.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;

void FileReader::block(const Span& span, std::string_view text) {
  Report& report = lower_.report();
  report.start(span);
  const bool contour = lower_.state().turning_profile;
  const syntax::Statement* test = nullptr;
  for (const auto& s : syntax_.statements) {
    if (s.keyword == "TEST") test = &s;
  }
  const std::size_t errors = diagnostics_.error_count();
  const auto refused = [&] {
    if (diagnostics_.error_count() == errors) ++stats_.blocks_read;
    opaque(span, text, report.feature().empty() ? "text.unread" : report.feature(), report.harmless());
  };
  if (!syntax_.statements.empty() && syntax_.words.empty() && structured(syntax_.statements[0])) {
    if (report.refused()) return refused();
    ++stats_.blocks_read;
    return;
  }
  // Words first into a scratch block: a line that is refused leaves one Opaque statement and nothing else.
  const bool good = lower_.words(syntax_, span, text, scratch_, flow_);
  if (contour && lower_.state().turning_profile && good) {
    if (!lower_.blank_point(scratch_)) return refused();
    report.note("NUM-040", {}, "a block of the blank's contour of G64: it is no move, the cycle has the point");
    ++stats_.blocks_read;
    return opaque(span, text, "cycle.turning", true);
  }
  if (!good) return refused();
  if (!assignments()) return refused();
  ++stats_.blocks_read;
  words(test);
}

bool FileReader::assignments() {
  // First all of them are looked at, so that a refused line leaves nothing behind.
  Report& report = lower_.report();
  ir::Assign assign;
  std::vector<const syntax::Statement*> declarations;
  const syntax::Statement* text = nullptr;
  const auto take = [&](const syntax::Statement& s) { lower_.expressions().assignment(s, assign.items); };
  for (const auto& s : syntax_.statements) {
    if (s.keyword == "ASSIGN" && in_var_ && s.args[0].text[0] == '[' && s.args[0].args.empty())
      declarations.push_back(&s);
    else if (s.keyword == "ASSIGN")
      take(s);
    else if (s.keyword == "DECL")
      declarations.push_back(&s);
    else if (s.keyword == "MSG")
      text = &s;
    else if (s.keyword == "TEST") {
      for (const auto& c : s.children) take(c);
    } else {
      report.refuse("NUM-023", s.pos, "`" + s.keyword + "`: not carried yet", {}, "language.statement");
    }
  }
  for (const auto* d : declarations) declare(*d);
  std::vector<ir::FrameWord> shifts = lower_.expressions().take_shifts();
  const bool computed = std::any_of(shifts.begin(), shifts.end(), [](const auto& w) { return !w.value.literal(); });
  if (computed && !assign.items.empty()) {
    report.refuse("NUM-019", assign.items.front().pos,
                  "a computed shift (E6x005) beside other assignments: which comes first can't be kept",
                  "write the shift in a block of its own", "language.system_variable");
  }
  if (report.refused()) return false;
  lower_.note_assigned(assign.items);
  if (!assign.items.empty()) put_node(std::move(assign));
  if (!shifts.empty()) put_shift(std::move(shifts));
  if (text != nullptr) message(*text);
  return true;
}

/// E6x005 is the shift of G59: the named axes get it at once, whether G90 or G91 is in force.
void FileReader::put_shift(std::vector<ir::FrameWord> words) {
  ir::Block block;
  ir::Action& a = block.actions.emplace_back();
  a.pos = words.front().pos;
  const bool alone = syntax_.words.empty() && syntax_.comments.empty() && first_;
  if (alone) a.text = trim(text_.substr(a.pos.column - 1));  // the assignments as they stand
  ir::FrameChange change;
  change.slot = ir::FrameSlot::shift;
  change.kind = ir::FrameKind::translate;
  change.combine = ir::FrameCombine::replace_named;
  change.words = std::move(words);
  a.data = ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(change))};
  put_node(std::move(block));
}

void FileReader::declare(const syntax::Statement& s) {
  Report& report = lower_.report();
  const syntax::Expr& target = s.args[0];
  if (!in_var_)
    return report.refuse("NUM-023", s.pos, "a symbol alone declares it, which only VAR ... ENDV may do", {},
                         "language.statement");
  ir::Declare::Item item;
  item.name = target.text;
  // Elements are counted from 1: the table has one more, from 0.
  for (const auto& size : target.args) {
    if (size.kind != syntax::ExprKind::number || size.number < 1 || s.args.size() > 1)
      return report.refuse("NUM-023", s.pos, "a table is declared with whole sizes from 1 on, and without a value", {},
                           "language.statement");
    item.dimensions.push_back(ir::number(size.number + 1));
  }
  if (s.args.size() > 1) {
    ir::ExprPtr value = lower_.expressions().lower(s.args[1]);
    if (!value) return;
    item.initial.push_back(std::move(value));
  }
  lower_.expressions().declare(target.text);
  if (report.refused()) return;
  ir::Declare declaration;
  declaration.space = facts::space_symbol;
  declaration.items.push_back(std::move(item));
  put_node(std::move(declaration));
}

void FileReader::message(const syntax::Statement& s) {
  std::string_view text = s.text;
  if (!text.empty() && text[0] >= '0' && text[0] <= '6') {
    if (text[0] != '0') {
      lower_.report().note("NUM-035", s.pos, "a message to another place than the display; kept as text");
      return opaque(span_, text_.substr(s.pos.column - 1, s.pos.length), "language.statement", true);
    }
    text.remove_prefix(1);
  }
  text = trim(text);
  ir::Message m;
  m.kind = text.empty() ? ir::MessageKind::clear : ir::MessageKind::show;
  if (!text.empty()) m.parts.push_back(ir::string_literal(std::string(text)));
  put_node(std::move(m));
}

void FileReader::words(const syntax::Statement* test) {
  if (flow_.macro != 0) return macro_call();
  const bool has_flow = flow_.code != nullptr;
  ir::Statement flow;
  if (has_flow && !lower_.flow_statement(flow_, test, flow)) {
    return opaque(span_, text_, "text.unread", false);
  }
  if (test != nullptr && (!has_flow || flow_.code->code != 79)) {
    lower_.report().refuse("NUM-015", test->pos, "a test belongs to G79", {}, "motion.probe");
    return opaque(span_, text_, "motion.probe", false);
  }
  if (has_flow) {
    split_call(std::move(flow));
  } else if (flow_.m_program >= 0) {
    program_call();
  } else if (!scratch_.empty() || (first_ && !flow_.end)) {
    put_node(std::move(scratch_));
    scratch_ = ir::Block{};
  }
  if (flow_.linear_after) {
    ir::Block linear;
    linear.has_motion = true;
    linear.motion.kind = ir::MotionKind::linear;
    put_node(std::move(linear));
  }
  if (!flow_.preset.empty()) take_over_preset();
  if (flow_.probes && latches_) latch();
  if (flow_.interrupted != nullptr) {
    ir::Statement jump;
    if (!lower_.interruption(flow_, jump)) return;
    ir::Statement s = with_line();
    s.node = std::move(jump.node);
    put(std::move(s));
  }
  if (!flow_.end) return;
  ended_ = true;
  ir::End end;
  end.text = flow_.end_text;
  put_node(std::move(end));
}

/// G92 changes PREF: what it made of the axes goes into the numbers E6x000.
void FileReader::take_over_preset() {
  ir::Assign assign;
  for (const ir::AxisId axis : flow_.preset) lower_.expressions().take_over_preset(axis, assign.items);
  put_node(std::move(assign));
  ir::FrameChange clear;
  clear.slot = ir::FrameSlot::preset;
  clear.kind = ir::FrameKind::translate;
  clear.combine = ir::FrameCombine::clear;
  ir::Block block;
  block.actions.emplace_back().data = ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(clear))};
  put_node(std::move(block));
}

/// The positions at the end of an interruptible block stay readable (E7x001).
void FileReader::latch() {
  ir::Assign assign;
  for (ir::AxisId axis = 0; axis <= ir::axis::c; ++axis) {
    if ((settings_.axes >> axis & 1U) != 0) assign.items.push_back(lower_.expressions().latched(axis));
  }
  put_node(std::move(assign));
}

/// Gxxx of the machine: its words into L900.. (the names 'A to 'EZ of the macro), then its program %10xxx.
void FileReader::macro_call() {
  ir::Assign words;
  for (auto& [number, value] : flow_.arguments) {
    ir::Assign::Item item;
    item.target.space = facts::space_l;
    item.target.index = ir::number(static_cast<double>(number));
    item.value = ir::as_expr(value);
    item.pos = flow_.macro_pos;
    words.items.push_back(std::move(item));
  }
  if (!words.items.empty()) put_node(std::move(words));
  ir::CallRoutine call;
  call.routine.number = facts::macro_program_base + flow_.macro;
  put_node(std::move(call));
}

/// The block, the program that its M function calls, then what acts after a move.
void FileReader::program_call() {
  ir::Block after;
  std::erase_if(scratch_.actions, [&after](ir::Action& a) {
    if (a.order != ir::Order::after) return false;
    after.actions.push_back(std::move(a));
    return true;
  });
  if (!scratch_.empty()) put_node(std::move(scratch_));
  ir::CallRoutine call;
  call.routine.number = flow_.m_program;
  put_node(std::move(call));
  if (!after.empty()) put_node(std::move(after));
  scratch_ = ir::Block{};
}

/// A jump or call stands where the move would: what acts after a move comes behind it.
void FileReader::split_call(ir::Statement flow) {
  ir::Block before, after;
  for (auto& a : scratch_.actions) (a.order == ir::Order::after ? after : before).actions.push_back(std::move(a));
  if (!after.empty() && flow_.code->kind == facts::GKind::jump) {
    lower_.report().refuse("NUM-013", after.actions[0].pos,
                           "a function that acts after the block can't stand beside a jump",
                           "put it into a block of its own");
    return opaque(span_, text_, "text.unread", false);
  }
  const auto* curve = std::get_if<ir::Repeat>(&flow.node);
  if (curve != nullptr && curve->curve_use == ir::CurveUse::run) {  // G06 NU1, its points run in its motion function
    const WordPos code = flow_.word->pos, number = flow_.curve->pos;
    before.has_motion = true;
    before.motion.kind = ir::MotionKind::spline_cubic;
    before.motion.explicit_code = true;
    before.motion.code_pos = code;
    before.motion.code_text = trim(text_.substr(code.column - 1, number.column + number.length - code.column));
  }
  if (!before.empty()) put_node(std::move(before));
  ir::Statement s = with_line();
  s.node = std::move(flow.node);
  put(std::move(s));
  if (!after.empty()) put_node(std::move(after));
  scratch_ = ir::Block{};
}

template <typename Node>
bool FileReader::open(Node node, WordPos pos) {
  if (nested_too_deep(builder_)) {
    lower_.report().refuse("NUM-022", pos, "structures are nested too deeply: the control takes 15 levels");
    return true;
  }
  ir::Statement st = with_line();
  st.node = std::move(node);
  builder_.open(std::move(st));
  return true;
}

bool FileReader::without(const syntax::Statement& s, std::string_view what) {
  lower_.report().refuse("NUM-022", s.pos, "`" + s.keyword + "` without its " + std::string(what));
  return true;
}

bool FileReader::for_loop(const syntax::Statement& s) {
  Report& report = lower_.report();
  ir::For node;
  const syntax::Expr& counter = s.args.at(0);
  syntax::Statement assign;
  assign.args = {counter, s.args.at(1)};
  std::vector<ir::Assign::Item> items;
  if (!lower_.expressions().assignment(assign, items) || items.size() != 1 || items[0].to_system) {
    if (!report.refused()) report.refuse("NUM-023", counter.pos, "machine data as a counter", {}, "language.statement");
    return true;
  }
  node.counter = std::move(items[0].target);
  node.from = std::move(items[0].value);
  node.to = lower_.expressions().lower(s.args.at(2));
  ir::ExprPtr step =
      s.args.at(3).kind == syntax::ExprKind::missing ? nullptr : lower_.expressions().lower(s.args.at(3));
  if (s.text == "DOWNTO") step = step ? ir::unary(ir::UnaryOp::negate, std::move(step)) : ir::number(-1);
  node.step = std::move(step);
  return report.refused() || open(std::move(node), s.pos);
}

bool FileReader::structured(const syntax::Statement& s) {
  using Kind = StructureBuilder::Kind;
  Report& report = lower_.report();
  const auto wrong = [&](std::string_view what) { return without(s, what); };
  const auto condition = [&] { return lower_.expressions().lower(s.args.at(0)); };
  if (s.keyword == "IF") {
    ir::If node;
    node.condition = condition();
    return report.refused() || open(std::move(node), s.pos);
  }
  if (s.keyword == "WHILE") {
    ir::While node;
    node.condition = condition();
    return report.refused() || open(std::move(node), s.pos);
  }
  if (s.keyword == "REPEAT") return open(ir::Until{}, s.pos);
  if (s.keyword == "FOR") return for_loop(s);
  if (s.keyword == "ELSE") return builder_.else_branch(line_) || wrong("IF");
  if (s.keyword == "ENDI") return builder_.close(Kind::if_, line_) || wrong("IF");
  if (s.keyword == "ENDW") return builder_.close(Kind::while_, line_) || wrong("WHILE");
  if (s.keyword == "ENDF") return builder_.close(Kind::for_, line_) || wrong("FOR");
  if (s.keyword == "UNTIL") {
    ir::ExprPtr c = condition();
    return report.refused() || builder_.close_until(std::move(c), line_) || wrong("REPEAT");
  }
  if (s.keyword == "EXIT") {
    if (!builder_.in_loop()) return wrong("loop");
    put_node(ir::Exit{});
    return true;
  }
  return carried(s);
}

/// Statements that are read and do nothing to the path, and those that are only kept.
bool FileReader::carried(const syntax::Statement& s) {
  Report& report = lower_.report();
  if (s.keyword == "THEN" || s.keyword == "DO" || s.keyword == "VAR" || s.keyword == "ENDV") {
    if (s.keyword == "VAR") in_var_ = true;
    if (s.keyword == "ENDV") {
      if (!in_var_) return without(s, "VAR");
      in_var_ = false;
    }
    if (!line_.number.empty() || !line_.comments.empty()) put_node(ir::Block{});
    return true;
  }
  if (s.keyword == "CARRIED" && iequals_ascii(s.text.substr(0, 6), "DELETE")) {
    report.carry("NUM-034", s.pos, "`" + s.text + "` frees symbols; it does not change the path and is kept as text",
                 "language.statement");
    return true;
  }
  if (s.keyword == "CARRIED" &&
      (iequals_ascii(s.text.substr(0, 4), "PUSH") || iequals_ascii(s.text.substr(0, 4), "PULL")))
    return stack(s);
  if (s.keyword == "CARRIED") {
    report.keep("NUM-023", s.pos, "`" + s.text + "`: the functions on tables are not carried", "language.statement");
    return true;
  }
  if (s.keyword == "EQUIV" || s.keyword == "INPUT") {
    report.keep("NUM-023", s.pos,
                s.keyword == "EQUIV" ? "another name for an address is not carried yet"
                                     : "a value typed in by the operator is not carried",
                "language.statement");
    return true;
  }
  return false;
}

}  // namespace cnctrans::frontends::num
