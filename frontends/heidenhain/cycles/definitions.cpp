// CYCL DEF and CYCL CALL (reference 14): the definition with its parameters, what takes effect at once, calls.
#include <cmath>
#include <functional>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/heidenhain/limits.h"
#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;
using facts::OldKind;
using syntax::Expr;
using syntax::ExprKind;

/// `CYCL DEF 200 DRILLING`, `CYCL DEF 7.1 X+60`.
bool Lowering::cycle_def(const syntax::Statement& s) {
  const Word* which = block_->words.empty() ? nullptr : block_->words.data();
  if (which == nullptr || !which->address.empty() || !which->has_value || which->is_expression) {
    flush();
    report_.refuse("HEI-016", s.pos, "CYCL DEF has no number");
    return false;
  }
  std::string_view digits = which->number_text;
  if (digits.empty()) digits = slice(*which);
  const auto point = digits.find_first_of(".,");
  const auto number = saturate<std::int64_t>(parse_decimal(digits.substr(0, point)).value_or(0));
  const bool numbered = point != std::string_view::npos && point + 1 < digits.size();
  const int part = numbered ? saturate<int>(parse_decimal(digits.substr(point + 1)).value_or(0)) : 0;
  if (numbered && part != 0) return old_part(s, number, part);
  flush();
  const auto* old = numbered ? facts::find_old_cycle(number) : nullptr;
  const auto* row = numbered ? nullptr : facts::find_cycle(number);
  if (old == nullptr && row == nullptr) {
    report_.warn("HEI-016", which->pos,
                 "cycle " + std::to_string(number) + " is read, but no run and no translation carries it");
  }
  CycleDefinition& cycle = flat_.cycles.emplace_back();
  cycle.where = line_.span;
  cycle.row = row;
  cycle.old = old;
  cycle.number = number;
  waiting_ = static_cast<int>(flat_.cycles.size()) - 1;
  waiting_line_ = line_;
  // Comments of a definition are the editor's texts.
  std::erase_if(waiting_line_.comments, [](const auto&) { return true; });
  if (row == nullptr) return true;
  each_parameter([&](std::int16_t q, const Word& name, const Word& amount, bool bare) {
    if (facts::find_parameter(*row, q) == nullptr) return;
    QValue v;
    v.where = word_span(report_.line(), name.pos);
    if (!bare) v.value = value(amount);
    const bool named = !amount.address.empty();
    if (named && !feed_name(to_upper_ascii(amount.address), bare ? nullptr : &v.value, amount.pos, v)) return;
    cycle.values[q] = std::move(v);
  });
  return !report_.refused();
}

/// `CYCL DEF 200 Q200=2 Q206=FAUTO Q201=-5`: parameters in the line of the number. `bare`: a name without a number.
void Lowering::each_parameter(
    const std::function<void(std::int16_t q, const Word& name, const Word& number, bool bare)>& take) {
  const auto& words = block_->words;
  for (std::size_t i = 1; i + 2 < words.size(); ++i) {
    const Word &name = words[i], &number = words[i + 2];
    const bool named = !number.address.empty() && number.address != "=";
    const bool pair = name.is_expression &&  // the number of the cycle or a word of its name may stand before it
                      words[i + 1].address == "=" && (named || number.has_value);
    const Expr* variable = pair ? &block_->exprs[static_cast<std::size_t>(name.expr)] : nullptr;
    if (variable == nullptr || variable->kind != ExprKind::variable || variable->text != "Q") continue;
    // `FAUTO Q201=-5`: the next parameter is read as the value of the name.
    const bool next = named && number.is_expression && i + 3 < words.size() && words[i + 3].address == "=";
    take(saturate<std::int16_t>(variable->args.at(0).number), name, number, next || !number.has_value);
    i += next ? 1 : 2;
  }
}

/// `Q201=-15` behind a definition. False: it is no parameter of the cycle.
bool Lowering::cycle_word(const syntax::Statement& s) {
  CycleDefinition& cycle = flat_.cycles[static_cast<std::size_t>(waiting_)];
  const Expr& target_of = s.args[0];
  if (cycle.row == nullptr && cycle.old == nullptr) return true;  // of a cycle that is not carried
  if (cycle.row == nullptr || target_of.text != "Q") return false;
  const auto q = saturate<std::int16_t>(target_of.args.at(0).number);
  const bool known = facts::find_parameter(*cycle.row, q) != nullptr;
  if (!known && !waits_more_) return false;
  if (cycle.values.count(q) != 0 && !waits_more_) return false;
  if (!known) {
    report_.warn("HEI-016", s.pos,
                 "Q" + std::to_string(q) + " is no parameter of cycle " + std::to_string(cycle.number) +
                     " that is carried; it is left out");
    return true;
  }
  QValue v;
  v.where = word_span(report_.line(), s.pos);
  const Expr& e = s.args[1];
  const bool named = e.kind == ExprKind::name || (e.kind == ExprKind::call && e.args.size() == 1);
  const ir::Value amount = e.kind == ExprKind::call && named ? ir::Value(expression(e.args[0])) : ir::Value{};
  const bool feed = named && feed_name(e.text, e.kind == ExprKind::call ? &amount : nullptr, s.pos, v);
  if (report_.refused()) return true;
  if (!feed) {
    const ir::ExprPtr value = expression(e);
    if (!value) return true;
    const auto constant = ir::constant_value(value);
    v.value = constant ? ir::Value(*constant) : ir::Value(value);
  }
  cycle.values[q] = std::move(v);
  return true;
}

/// FMAX, FAUTO, FU, FZ and PREDEF in place of a number. False: it is none of them.
bool Lowering::feed_name(std::string_view name, const ir::Value* amount, WordPos pos, QValue& v) {
  using Kind = QValue::Kind;
  const auto is = [&](std::string_view a) { return iequals_ascii(name, a); };
  if (amount == nullptr && (is("FMAX") || is("MAX"))) {
    v.kind = Kind::rapid;
    v.value = ir::Value(facts::rapid_stand_in);
    return true;
  }
  if (amount == nullptr && (is("FAUTO") || is("AUTO"))) {
    if (!tool_feed_)
      report_.refuse("HEI-005", pos, "FAUTO takes the feed of TOOL CALL, and the one above has none");
    else
      v.value = *tool_feed_;
    v.of_tool_feed = true;
    return true;
  }
  if (is("PREDEF")) {
    v.kind = Kind::linked;
    return true;
  }
  if (is("FZ")) {
    v.kind = Kind::per_tooth;
    return true;
  }
  if (!is("FU") || amount == nullptr) return name.substr(0, 2) == "FU" && (v.kind = Kind::per_rev, true);
  const auto feed = ir::constant_value(ir::as_expr(*amount));
  v.kind = Kind::per_rev;  // by the speed of TOOL CALL, where that is a number
  if (!feed || !speed_ || !speed_->literal() || per_rev_) return true;
  v.kind = Kind::value;
  v.of_speed = *feed;
  v.value = ir::Value(*feed * speed_->number);
  return true;
}

void Lowering::global_word(const syntax::Statement& s) {
  const ir::ExprPtr value = expression(s.args[1]);
  const auto constant = ir::constant_value(value);
  const bool good = s.args[0].text == "Q" && constant.has_value();
  if (!good && !report_.refused()) report_.warn("HEI-016", s.pos, "GLOBAL DEF takes parameters Q with numbers");
  if (good) globals_[saturate<std::int16_t>(s.args[0].args.at(0).number)].emplace_back(*constant);
}

bool Lowering::old_part(const syntax::Statement& s, std::int64_t number, int part) {
  CycleDefinition* cycle = waiting_ < 0 ? nullptr : &flat_.cycles[static_cast<std::size_t>(waiting_)];
  if (cycle == nullptr || cycle->row != nullptr || cycle->number != number) {
    flush();
    report_.keep("HEI-016", s.pos,
                 "part " + std::to_string(part) + " of cycle " + std::to_string(number) + " stands without part 0",
                 "cycle.hole");
    return false;
  }
  OldPartValue& out = cycle->parts[part];
  const auto& words = block_->words;
  if (words.size() > 1) out.text = trim(text_.substr(words[1].pos.column - 1));
  for (std::size_t i = 1; i < words.size(); ++i) {
    const Word& w = words[i];
    OldPartValue::Letter letter;
    letter.address = to_upper_ascii(w.address);
    letter.has_value = w.has_value;
    if (w.has_value) letter.value = value(w);
    letter.negative = !w.has_value && w.number_text == "-";
    out.letters.push_back(std::move(letter));
  }
  return !report_.refused();
}

/// The definition is complete.
void Lowering::flush() {
  if (waiting_ < 0) return;
  const int index = std::exchange(waiting_, -1);
  waits_more_ = false;
  CycleDefinition& cycle = flat_.cycles[static_cast<std::size_t>(index)];
  const ir::LineInfo kept_line = std::exchange(line_, waiting_line_);
  const bool kept_first = std::exchange(first_, true);
  const Span here = report_.line();
  report_.start(cycle.where);
  if (cycle.row != nullptr) {
    std::string missing;
    for (const auto& p : cycle.row->parameters) {
      if (p.number == 0 || cycle.values.count(p.number) != 0) continue;
      QValue v;
      v.value = ir::Value(p.fallback);
      v.where = cycle.where;
      if (p.needed) missing += (missing.empty() ? "Q" : ", Q") + std::to_string(p.number);
      cycle.values[p.number] = std::move(v);
    }
    if (!missing.empty() && !cycle.refused)
      report_.refuse("HEI-016", {}, "cycle " + std::to_string(cycle.number) + " has no " + missing);
  }
  const bool called = cycle.row != nullptr ? cycle.row->called : cycle.old == nullptr || cycle.old->called;
  if (report_.refused() || cycle.refused) {
    cycle.refused = true;
    ir::Opaque o;
    o.text = "CYCL DEF " + std::to_string(cycle.number);
    o.feature = "cycle.hole";
    Item& item = put(std::move(o));
    if (called) {
      item.kind = ItemKind::cycle;
      item.index = index;
    }
  } else if (called) {
    if (cycle.row != nullptr && cycle.row->contours != facts::Contours::none) {
      cycle.labels = contour_labels_;
      relies(AlongText::contours);
      const bool train = cycle.row->name == "path";
      const int data = train ? train_data_ : cycle.row->contours == facts::Contours::areas ? contour_data_ : -1;
      if (data >= 0) {
        for (const auto& [q, v] : flat_.cycles[static_cast<std::size_t>(data)].values) cycle.values.emplace(q, v);
      }
      relies(train ? AlongText::train : AlongText::data);
      if (!train) train_data_ = -1, sets(AlongText::train);
    }
    put(ItemKind::cycle, ir::Block{}).index = index;
  } else {
    effect(cycle);
    if (report_.refused()) {
      ir::Opaque o;
      o.text = "CYCL DEF " + std::to_string(cycle.number);
      o.feature = std::string(report_.feature());
      o.harmless = report_.harmless();
      put(std::move(o));
    }
  }
  line_ = kept_line;
  first_ = kept_first;
  report_.start(here);
}

/// CYCL CALL, CYCL CALL POS X Y Z FMAX, CYCL CALL M3.
bool Lowering::cycle_call(const syntax::Statement& s) {
  bool positions = false, at_pattern = false;
  std::optional<ir::Value> height;
  for (const Word& w : block_->words) {
    if (iequals_ascii(w.address, "POS")) {
      positions = true;
    } else if (iequals_ascii(w.address, "PAT")) {
      at_pattern = true;
    } else if (const ir::AxisId axis = axis_of(w.address); positions && axis != ir::axis::none && w.has_value) {
      if (axis == static_cast<ir::AxisId>(tool_axis_))
        height = value(w);
      else
        axis_word(w, axis, false);
    } else if (!tail(w)) {
      report_.refuse("HEI-002", w.pos, "`" + std::string(slice(w)) + "` means nothing beside CYCL CALL", {},
                     "block.word");
    }
    if (report_.refused()) return false;
  }
  if (positions) {
    if (!height || out_.motion.coords.size() != 2) {
      report_.refuse("HEI-017", s.pos, "CYCL CALL POS needs all three coordinates");
      return false;
    }
    out_.motion.kind = rapid_ ? ir::MotionKind::rapid : ir::MotionKind::linear;
    out_.motion.explicit_code = true;
    out_.has_motion = true;
  }
  const bool moves = out_.has_motion;
  if (at_pattern) {  // its feed or FMAX is that of the ways between the points
    out_.motion.kind = rapid_ ? ir::MotionKind::rapid : ir::MotionKind::linear;
    out_.motion.explicit_code = true;
  }
  Item& item = put(std::move(out_));
  item.moves = moves;
  item.at_pattern = at_pattern;
  item.call = positions ? CycleCall::ends : CycleCall::once;
  item.shift = std::move(height);
  return true;
}

}  // namespace cnctrans::frontends::heidenhain
