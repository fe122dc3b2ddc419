// Addresses whose index is a variable: S[NUM]=300, FA[AXV]=90, IP[AXV]=10 (reference 1.2.1). The block becomes a branch
// for each spindle or axis that the machine has.
#include <algorithm>
#include <utility>

#include "frontends/sinumerik/lower_statements.h"
#include "frontends/sinumerik/row_parts.h"

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

}  // namespace

/// True when the block has such an address; what it does is added then.
bool StatementLowering::chosen_by_index(const Block& block, const ir::LineInfo& info) {
  const auto chooses = [this](const Statement& s) {
    if (s.keyword != "=" || s.args[0].args.size() != 1) return false;
    const Expr& index = s.args[0].args[0];
    const Symbol* symbol = c_.symbol(index.text);
    const bool variable = symbol != nullptr && symbol->dimensions == index.args.size();
    if (of_spindle(s.args[0].text)) return index.kind != ExprKind::number;
    return of_axis(s.args[0].text) && variable && symbol->type == ir::Type::axis;
  };
  const auto found = std::find_if(block.statements.begin(), block.statements.end(), chooses);
  if (found == block.statements.end()) return false;
  const bool spindle = of_spindle(found->args[0].text);
  const ir::ExprPtr index = spindle ? exprs_.lower_as(found->args[0].args[0], ir::Type::integer)
                                    : exprs_.axis_operand(found->args[0].args[0]);
  if (!index) {
    add_opaque(block, info, feature_, false);
    return true;
  }
  std::vector<Expr> choices;
  std::vector<ir::ExprPtr> values;
  const auto choice = [&](ExprKind kind, std::string text, double number, ir::ExprPtr value) {
    Expr e;
    e.kind = kind;
    e.text = std::move(text);
    e.number = number;
    e.pos = found->args[0].args[0].pos;
    choices.push_back(std::move(e));
    values.push_back(std::move(value));
  };
  if (spindle) {
    for (int n = 1; n <= spindles; ++n) choice(ExprKind::number, std::to_string(n), n, ir::number(n));
  } else {
    for (const auto& a : c_.machine.profile->axes) {
      if (found->args[0].text == "IP" && a.id > ir::axis::z) continue;
      choice(ExprKind::name, a.name, 0, make_expr(ir::AxisName{a.id}, ir::Type::axis, found->pos));
    }
  }
  const auto at = static_cast<std::size_t>(found - block.statements.begin());
  {  // a block of which something else is not carried stays whole
    Block first = block;
    first.statements[at].args[0].args[0] = choices.front();
    Parts parts;
    ir::Block words;
    const bool read = sort_items(first, parts);
    const bool has_words = !parts.words.words.empty() || !parts.indirect.empty();
    if (!read || (has_words && !words_.lower(parts.words, parts.indirect, words)) || !put_axis_words(parts, words)) {
      add_opaque(block, info, feature_, false);
      return true;
    }
  }
  c_.interrupt_lasting();
  ir::LineInfo outer = info;
  ir::LineInfo plain;
  plain.span = info.span;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    ir::Statement branch;
    branch.line = i == 0 ? outer : plain;
    ir::If node;
    node.condition = spindle ? is_number(index, static_cast<int>(choices[i].number), found->pos)
                             : ir::binary(ir::BinaryOp::eq, index, values[i]);
    branch.node = std::move(node);
    structure_->open(std::move(branch));
    Block one = block;
    one.statements[at].args[0].args[0] = choices[i];
    items(one, plain);
    structure_->else_branch(plain);
  }
  ir::Message alarm;  // as the control: there is no such spindle or axis
  alarm.kind = ir::MessageKind::error;
  alarm.number = written_number(65000, found->pos);
  ir::Statement stop;
  stop.line = plain;
  stop.node = std::move(alarm);
  structure_->add(std::move(stop));
  for (std::size_t i = 0; i < choices.size(); ++i) structure_->close(frontends::StructureBuilder::Kind::if_, plain);
  return true;
}

}  // namespace cnctrans::sinumerik
