// Addresses whose index is a variable: S[NUM]=300, FA[AXV]=90, IP[AXV]=10, and positions whose kind is: X=GP(5,KIND)
// (reference 1.2.1, 1.2.3). The block becomes a branch for each spindle, axis or kind.
#include <algorithm>
#include <utility>

#include "base/text.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/statements/row_parts.h"

namespace cnctrans::sinumerik {

using syntax::Block;
using syntax::Expr;
using syntax::ExprKind;
using syntax::Statement;

namespace {

constexpr int spindles = 3;

bool of_spindle(std::string_view address) {
  return address == "S" || address == "SPOS" || address == "SPOSA" || address == "LIMS";
}
bool of_axis(std::string_view address) {
  return address == "FA" || address == "IP";
}

/// The attribute number of a GP() whose number is no literal; null: `e` is none.
Expr* computed_attribute(Expr& e) {
  const bool found = e.kind == ExprKind::call && e.text == "GP" && e.args.size() == 2 &&
                     e.args[1].kind != ExprKind::number && e.args[1].kind != ExprKind::missing;
  return found ? &e.args[1] : nullptr;
}

}  // namespace

/// The part of the block that is to be chosen; null: nothing is.
Expr* StatementLowering::chosen_part(Block& block, ChosenBy& by) const {
  for (Statement& s : block.statements) {
    if (s.keyword != "=") continue;
    by.address = s.args[0].text;
    by.pos = s.pos;
    by.axis = s.args[0].args.empty() ? std::string() : s.args[0].args[0].text;
    by.kind = ChosenBy::Kind::attribute;
    if (Expr* number = computed_attribute(s.args[1]); number != nullptr) return number;
    if (s.args[0].args.size() != 1) continue;
    Expr& index = s.args[0].args[0];
    const Symbol* symbol = c_.symbol(index.text);
    const bool variable = symbol != nullptr && symbol->dimensions == index.args.size();
    by.kind = of_spindle(s.args[0].text) ? ChosenBy::Kind::spindle : ChosenBy::Kind::axis;
    if (of_spindle(s.args[0].text) && index.kind != ExprKind::number) return &index;
    if (of_axis(s.args[0].text) && variable && symbol->type == ir::Type::axis) return &index;
  }
  for (const auto& w : block.words) {
    if (!w.is_expression) continue;
    Expr* number = computed_attribute(block.exprs[static_cast<std::size_t>(w.expr)]);
    if (number == nullptr) continue;
    by.kind = ChosenBy::Kind::attribute;
    by.axis = to_upper_ascii(w.address);
    by.pos = w.pos;
    return number;
  }
  return nullptr;
}

/// What it may be, and the values that choose it.
void StatementLowering::choices_of(const ChosenBy& by, WordPos pos, std::vector<Expr>& choices,
                                   std::vector<ir::ExprPtr>& values) const {
  const auto choice = [&](ExprKind kind, std::string text, double number, ir::ExprPtr value) {
    Expr e;
    e.kind = kind;
    e.text = std::move(text);
    e.number = number;
    e.pos = pos;
    choices.push_back(std::move(e));
    values.push_back(std::move(value));
  };
  const auto number = [&](int n) { choice(ExprKind::number, std::to_string(n), n, ir::number(n)); };
  switch (by.kind) {
    case ChosenBy::Kind::spindle:
      for (int n = 1; n <= spindles; ++n) number(n);
      return;
    case ChosenBy::Kind::axis:
      for (const auto& a : c_.machine.profile->axes) {
        if (by.address == "IP" && a.id > ir::axis::z) continue;
        choice(ExprKind::name, a.name, 0, make_expr(ir::AxisName{a.id}, ir::Type::axis, by.pos));
      }
      return;
    case ChosenBy::Kind::attribute: break;
  }
  constexpr int incremental = 2, shortest = 3, negative = 5, diameters_from = 8, radii_to = 11;
  for (int n = 0; n <= incremental; ++n) number(n);
  const auto* spec = c_.machine.profile->axis(c_.machine.axis(by.axis));
  for (int n = shortest; n <= negative && spec != nullptr && spec->rotary; ++n) number(n);
  for (int n = diameters_from; n <= radii_to && spec != nullptr && spec->diameter; ++n) number(n);
}

/// True when the block has such an address; what it does is added then.
bool StatementLowering::chosen_by_index(const Block& block, const ir::LineInfo& info) {
  ChosenBy by;
  Block one = block;
  Expr* const part = chosen_part(one, by);
  if (part == nullptr) return false;
  const bool axis = by.kind == ChosenBy::Kind::axis;
  const WordPos place = part->pos;
  const ir::ExprPtr index = axis ? exprs_.axis_operand(*part) : exprs_.lower_as(*part, ir::Type::integer);
  if (!index) {
    add_opaque(block, info, feature_, false);
    return true;
  }
  std::vector<Expr> choices;
  std::vector<ir::ExprPtr> values;
  choices_of(by, place, choices, values);
  {  // a block of which something else is not carried stays whole
    *part = choices.front();
    Parts parts;
    ir::Block words;
    const bool read = sort_items(one, parts);
    const bool has_words = !parts.words.words.empty() || !parts.indirect.empty();
    if (!read || (has_words && !words_.lower(parts.words, parts.indirect, words)) || !put_axis_words(parts, words)) {
      add_opaque(block, info, feature_, false);
      return true;
    }
  }
  c_.interrupt_lasting();
  ir::LineInfo outer = info;
  const ir::LineInfo inside = further_line(info);
  ir::LineInfo plain;  // of questions, ELSE and ENDIF: behind a first question that is left out control meets none
  plain.span = info.span;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    ir::Statement branch;
    branch.line = i == 0 ? outer : plain;
    ir::If node;
    node.condition = axis ? ir::binary(ir::BinaryOp::eq, index, values[i])
                          : is_number(index, static_cast<int>(choices[i].number), by.pos);
    branch.node = std::move(node);
    structure_->open(std::move(branch));
    *part = choices[i];
    items(one, inside);
    structure_->else_branch(plain);
  }
  ir::Message alarm;  // as the control: there is no such spindle, axis or kind of position
  alarm.kind = ir::MessageKind::error;
  alarm.number = written_number(65000, by.pos);
  ir::Statement stop;
  stop.line = inside;
  stop.node = std::move(alarm);
  structure_->add(std::move(stop));
  for (std::size_t i = 0; i < choices.size(); ++i) structure_->close(frontends::StructureBuilder::Kind::if_, plain);
  return true;
}

}  // namespace cnctrans::sinumerik
