// Lines -> items: which sentence a line is, program frame, labels, calls.
#include <algorithm>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/heidenhain/limits.h"
#include "dialects/heidenhain/sentences.h"
#include "frontends/heidenhain/state/lowering.h"
#include "ir/edit/rewrite.h"
#include "ir/edit/search.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;
using syntax::Expr;
using syntax::ExprKind;

namespace {

facts::Sentence sentence_of(std::string_view keyword) {
  for (const auto& row : facts::sentences) {
    if (row.words == keyword) return row.sentence;
  }
  return facts::Sentence::none;
}

std::string_view without_quotes(std::string_view text) {
  text = trim(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') return text.substr(1, text.size() - 2);
  return text;
}

}  // namespace

std::string program_name(std::string_view text) {
  text = trim(text);
  if (const auto at = text.find_last_of("\\/:"); at != std::string_view::npos) text.remove_prefix(at + 1);
  constexpr std::size_t extension = 2;
  if (text.size() > extension && iequals_ascii(text.substr(text.size() - extension), ".H"))
    text.remove_suffix(extension);
  return to_upper_ascii(text);
}

Item& Lowering::put(ItemKind kind, ir::StatementNode node) {
  Item& item = flat_.items.emplace_back();
  item.kind = kind;
  if (first_) {
    item.statement.line = line_;
  } else {
    item.statement.line.span = line_.span;
    item.statement.line.skip_mask = line_.skip_mask;
    item.statement.line.joined = true;
  }
  first_ = false;
  item.tool_radius = radius_;
  mark_along(item);
  const auto* block = std::get_if<ir::Block>(&node);
  if (block != nullptr && feed_of_tool_ && ir::action_in<ir::SetFeed>(*block) != nullptr)
    item.tool_feed = std::exchange(feed_of_tool_, false);
  item.statement.node = std::move(node);
  return item;
}

bool Lowering::carried(const syntax::Statement& s, bool harmless, std::string_view feature, std::string message) {
  if (harmless)
    report_.note("HEI-021", s.pos, std::move(message));
  else
    report_.warn("HEI-013", s.pos, std::move(message));
  ir::Opaque o;
  o.text = std::string(trim(text_));
  o.feature = feature;
  o.harmless = harmless;
  put(std::move(o));
  return true;
}

void Lowering::unread(ir::LineInfo line, std::string_view text) {
  flush();
  swallow_ = false;
  line_ = std::move(line);
  first_ = true;
  ir::Opaque o;
  o.text = std::string(trim(text));
  o.feature = "text.unread";
  put(std::move(o));
}

bool Lowering::line(const syntax::Block& block, const Span& where, std::string_view text, ir::LineInfo line) {
  report_.start(where);
  block_ = &block;
  text_ = text;
  const bool goes_on = !block.statements.empty() && block.statements.back().keyword == "~";
  const std::size_t sentences = block.statements.size() - (goes_on ? 1U : 0U);
  const syntax::Statement* s = sentences == 0 ? nullptr : &block.statements.front();
  const bool parameter = s != nullptr && s->keyword == "ASSIGN" && block.number.empty();
  if (waiting_ >= 0 && parameter && cycle_word(*s)) {
    waits_more_ = goes_on;
    flat_.cycles[static_cast<std::size_t>(waiting_)].refused |= report_.refused();
    return !report_.refused();
  }
  if (global_ && parameter) {
    global_word(*s);
    return !report_.refused();
  }
  global_ = false;
  const bool more_figures = pattern_ >= 0 && block.number.empty() && (s == nullptr || s->keyword == "~");
  if (more_figures && !block.words.empty()) {
    if (!figures(flat_.patterns[static_cast<std::size_t>(pattern_)]) || !goes_on) pattern_ = -1;
    return !report_.refused();
  }
  pattern_ = -1;
  const bool part = s != nullptr && s->keyword == "CYCL DEF";
  if (!part) flush();
  if (swallow_ && block.number.empty() && (parameter || s == nullptr)) {
    swallow_ = goes_on || parameter;
    return true;
  }
  swallow_ = false;
  line_ = std::move(line);
  first_ = true;
  out_.clear();
  call_ = CycleCall::none;
  end_text_ = {};
  rapid_ = feed_of_tool_ = false;
  plunge_ = -1;
  angle_.reset();
  angle_incremental_ = false;
  sense_ = 0;
  retract_.reset();
  retract_far_ = untilted_ = from_maker_point_ = false;
  const std::size_t before = flat_.items.size();
  bool good = true;
  if (s != nullptr) {
    good = sentence(*s);
    if (goes_on && waiting_ < 0 && pattern_ < 0) swallow_ = true;
    if (waiting_ >= 0) waits_more_ = goes_on;
  } else if (block.words.empty()) {
    put(ir::Block{});
  } else {
    good = path();
  }
  if (!report_.refused()) return good;
  // A line that is refused leaves one kept text and nothing else.
  flat_.items.resize(before);
  first_ = true;
  ir::Opaque o;
  o.text = std::string(trim(text));
  o.feature = report_.feature().empty() ? "text.unread" : std::string(report_.feature());
  o.harmless = report_.harmless();
  put(std::move(o));
  return false;
}

bool Lowering::sentence(const syntax::Statement& s) {
  using facts::Sentence;
  if (s.keyword == "ASSIGN") return assignment(s);
  if (s.keyword == "FN") return function(s);
  if (s.keyword == "OUTLINE") {
    if (s.text.front() == '(')
      report_.warn("HEI-026", s.pos, "text in brackets is read as a remark", "write it behind `;`");
    line_.comments.insert(line_.comments.begin(), {slice(s.pos), ir::CommentPlace::own_line, s.pos});
    put(ir::Block{});
    return true;
  }
  switch (sentence_of(s.keyword)) {
    case Sentence::begin_program: return begin(s);
    case Sentence::end_program: return finish_program(s);
    case Sentence::blank_form: return carried(s, true, "beside.data", "the blank is drawn only; it is kept as text");
    case Sentence::tool_def: return tool_def(s);
    case Sentence::tool_call: return tool_call(s);
    case Sentence::cycle_def: return cycle_def(s);
    case Sentence::cycle_call: return cycle_call(s);
    case Sentence::label: return label(s);
    case Sentence::call_label: return call_label(s);
    case Sentence::call_program: return call_program(s);
    case Sentence::stop: return stop();
    case Sentence::shift: trans_datum(s); return true;
    case Sentence::probe:
      report_.keep("HEI-013", s.pos, "a probing cycle is kept as text: what it measures is known to the machine only",
                   "motion.probe");
      return false;
    case Sentence::plane: return plane(s);
    case Sentence::declare_string:
      report_.refuse("HEI-013", s.pos, "DECLARE STRING is followed by a parameter QS, `=` and a text");
      return false;
    case Sentence::select_table:
      return carried(s, true, "beside.data",
                     "the table of datum shifts: the rows that are taken from it are not carried");
    case Sentence::approach: return lead(s, false);
    case Sentence::departure: return lead(s, true);
    case Sentence::free_contour: return free_element(s);
    case Sentence::global_def:
      global_ = true;
      each_parameter([this](std::int16_t q, const Word&, const Word& number, bool) {
        if (number.address.empty() && !number.is_expression) globals_[q].push_back(value(number));
      });
      return carried(s, true, "beside.data", "values for the cycles that say PREDEF; the sentence is kept as text");
    case Sentence::pattern: return pattern_def(s);
    case Sentence::select_pattern:
      carried(s, true, "beside.data", "the table of points is in a file of the control: CYCL CALL PAT can't be told");
      flat_.items.back().pattern = Arrival::several;
      return true;
    case Sentence::select_program: return select_program(s);
    case Sentence::call_selected: return call_routine("").calls_selected = true;
    case Sentence::carried:
    case Sentence::none: break;
  }
  report_.keep("HEI-013", s.pos, "`" + s.keyword + "` is kept as text; no run and no translation carries it",
               "language.statement");
  return false;
}

bool Lowering::begin(const syntax::Statement& s) {
  if (part_) {
    if (!line_.comments.empty()) put(ir::Block{});
    return true;
  }
  std::string_view rest = trim(std::string_view(s.text));
  const auto blank = rest.find_last_of(" \t");
  const std::string_view unit = blank == std::string_view::npos ? rest : rest.substr(blank + 1);
  inch_ = iequals_ascii(unit, "INCH");
  const bool known = inch_ || iequals_ascii(unit, "MM");
  if (!known) report_.warn("HEI-014", s.pos, "BEGIN PGM without its unit: millimetres", "write MM or INCH");
  if (known) rest = blank == std::string_view::npos ? std::string_view{} : trim(rest.substr(0, blank));
  if (began_ || !flat_.items.empty()) {
    for (const Item& item : flat_.items) {
      const auto* b = std::get_if<ir::Block>(&item.statement.node);
      const auto* o = std::get_if<ir::Opaque>(&item.statement.node);
      if (!began_ && ((b != nullptr && b->empty()) || (o != nullptr && o->feature == "text.unread"))) continue;
      report_.refuse("HEI-014", s.pos, "BEGIN PGM stands at the start of a file");
      return false;
    }
  }
  began_ = true;
  name_ = to_upper_ascii(rest);
  const auto own = inch_ ? ir::Units::inch : ir::Units::metric;
  if (outer_unit_ == own && !mixed_units_) outer_unit_.reset();
  if (inch_ || outer_unit_) {
    put_unit(own);
  } else if (!line_.comments.empty()) {
    put(ir::Block{});
  }
  return true;
}

void Lowering::put_unit(ir::Units unit) {
  ir::Block b;
  b.actions.emplace_back().data = ir::ModalSet{ir::Setting::units, static_cast<std::uint8_t>(unit), true};
  put(std::move(b));
}

bool Lowering::finish_program(const syntax::Statement&) {
  if (part_) {
    put(ItemKind::sub_end, ir::Block{}).label = "0";
    return true;
  }
  if (outer_unit_) put_unit(*outer_unit_);
  ir::End end;
  end.text = "END PGM";
  end.returns_from_sub = true;
  put(ItemKind::end, std::move(end));
  ended_ = true;
  return true;
}

bool Lowering::label_name(const Expr* text, const Word* word, Item& item) {
  if (text != nullptr) {
    item.label = to_upper_ascii(trim(text->text));
    return true;
  }
  if (word != nullptr && word->is_expression) {
    const Expr& e = block_->exprs[static_cast<std::size_t>(word->expr)];
    if (e.kind == ExprKind::variable && e.text == "QS") {
      const ir::ExprPtr named = expression(e);
      const auto* parameter = named ? ir::passes::as_variable(named) : nullptr;
      if (parameter == nullptr) return false;
      item.label_text = parameter->name;
      return true;
    }
  }
  const double n = word == nullptr ? -1 : word->number;
  const auto number = saturate<std::int64_t>(n);
  if (word == nullptr || word->is_expression || n != static_cast<double>(number) || number < 0 || number > 65535) {
    report_.refuse("HEI-010", word == nullptr ? WordPos{} : word->pos,
                   "a label has a number from 1 to 999, or a name in quotes");
    return false;
  }
  item.label = std::to_string(number);
  item.number = true;
  return true;
}

bool Lowering::label(const syntax::Statement& s) {
  Item probe;
  const bool one = block_->words.size() == 1 && block_->words[0].address.empty() && !block_->words[0].is_expression;
  if (!label_name(s.args.empty() ? nullptr : &s.args[0], one ? block_->words.data() : nullptr, probe)) return false;
  const bool ends = probe.number && probe.label == "0";
  if (ends && line_.skip_mask != 0) {
    report_.refuse("HEI-010", s.pos, "LBL 0 behind a skip mark: where the subprogram ends would go by the switch",
                   "write LBL 0 without the mark");
    return false;
  }
  if (!ends && probe.number) line_.number = program_.keep(probe.label);
  if (!ends && !probe.number) line_.labels.push_back(program_.keep(probe.label));
  ir::StatementNode node = ends ? ir::StatementNode(ir::Block{}) : ir::StatementNode(ir::Label{});
  Item& item = put(ends ? ItemKind::sub_end : ItemKind::label, std::move(node));
  item.label = probe.label;
  item.number = probe.number;
  const auto calls = called_.find((item.number ? "N" : "T") + item.label);
  const std::size_t count = flat_.items.size();
  const ItemKind above = count < 2 ? ItemKind::plain : flat_.items[count - 2].kind;
  const int again = std::exchange(read_as_, -1);
  const int as = again >= 0 || calls == called_.end() ? again : calls->second;
  if (as >= 0 && (above == ItemKind::end || above == ItemKind::sub_end)) hold(held_[static_cast<std::size_t>(as)]);
  return true;
}

/// CALL LBL 5, CALL LBL "NAME", CALL LBL 5 REP 3/3.
bool Lowering::call_label(const syntax::Statement& s) {
  const Word *name = nullptr, *count = nullptr;
  bool repeats = false;
  for (const Word& w : block_->words) {
    if (iequals_ascii(w.address, "REP")) {
      repeats = true;
      if (w.has_value) count = &w;
    } else if (w.address.empty() && w.has_value) {
      if (name == nullptr && s.args.empty() && !repeats)
        name = &w;
      else if (repeats && count == nullptr)
        count = &w;
    } else if (w.address == "/" && repeats) {
      continue;
    } else {
      report_.refuse("HEI-002", w.pos, "`" + std::string(slice(w)) + "` means nothing beside CALL LBL", {},
                     "block.word");
      return false;
    }
  }
  Item probe;
  if (!label_name(s.args.empty() ? nullptr : &s.args[0], name, probe)) return false;
  if (probe.number && probe.label == "0") {
    report_.refuse("HEI-010", s.pos, "LBL 0 ends subprograms, it can't be called");
    return false;
  }
  if (repeats && count == nullptr) {
    report_.refuse("HEI-011", s.pos, "REP has no number");
    return false;
  }
  if (!repeats) {
    ir::CallRoutine call;
    Item& item = put(ItemKind::call, std::move(call));
    item.label = probe.label;
    item.number = probe.number;
    item.label_text = probe.label_text;
    item.held = held();
    if (!item.label.empty()) called_.emplace((item.number ? "N" : "T") + item.label, item.held);
    return true;
  }
  ir::Repeat repeat;
  repeat.first.text = probe.label;
  repeat.first.is_number = probe.number;
  repeat.count = ir::as_expr(value(*count));
  if (report_.refused()) return false;
  Item& item = put(ItemKind::repeat, std::move(repeat));
  item.label_text = probe.label_text;
  item.label = probe.label;
  item.number = probe.number;
  return true;
}

bool Lowering::call_program(const syntax::Statement& s) {
  const std::string name = program_name(s.args.empty() ? without_quotes(s.text) : std::string_view(s.args[0].text));
  if (name.empty()) {
    report_.refuse("HEI-011", s.pos, "CALL PGM has no program");
    return false;
  }
  if (name.size() > 2 && name.substr(name.size() - 2) == ".I") {
    report_.keep("HEI-011", s.pos, "`" + name + "` is a program in DIN/ISO, which is another language",
                 "language.other_mode");
    return false;
  }
  call_routine(name);
  return true;
}

/// The called program may have another unit.
Item& Lowering::call_routine(const std::string& name) {
  ir::CallRoutine call;
  call.routine.text = name;
  call.level = ir::CallLevel::new_level;
  const std::size_t at = flat_.items.size();
  put(ItemKind::program, std::move(call)).held = held();
  if (inch_) put_unit(ir::Units::inch);
  return flat_.items[at];
}

/// SEL PGM "NAME": the program that CALL SELECTED PGM calls.
bool Lowering::select_program(const syntax::Statement& s) {
  const std::string name = program_name(s.args.empty() ? without_quotes(s.text) : std::string_view(s.args[0].text));
  if (name.empty() || name.substr(0, 2) == "QS") {
    report_.keep("HEI-011", s.pos, "SEL PGM is followed by the name of a program; a text in QS is not carried",
                 "language.statement");
    return false;
  }
  auto& all = flat_.programs;
  auto it = std::find(all.begin(), all.end(), name);
  if (it == all.end()) it = all.insert(it, name);
  put(ir::Block{}).selects = static_cast<int>(it - all.begin());
  return true;
}

bool Lowering::stop() {
  for (const Word& w : block_->words) {
    if (!tail(w) || report_.refused()) {
      if (!report_.refused())
        report_.refuse("HEI-002", w.pos, "`" + std::string(slice(w)) + "` means nothing beside STOP", {}, "block.word");
      return false;
    }
  }
  ir::Action& a = out_.actions.emplace_back();
  a.data = ir::Stop{false};
  a.order = ir::Order::after;
  put(std::move(out_));
  if (end_text_.empty()) return true;
  ir::End end;
  end.text = end_text_;
  put(ItemKind::end, std::move(end));
  return true;
}

}  // namespace cnctrans::frontends::heidenhain
