// Actions in real time that only set R parameters, once and without a condition (language reference 12.1, 3.2): they
// act with the next move. Their value is there at once for a program that does not look before the control has waited.
#include <charconv>
#include <utility>

#include "base/text.h"
#include "frontends/sinumerik/state/statements.h"

namespace cnctrans::sinumerik {

namespace {

struct Cell {
  std::int32_t number = 0;
  double value = 0;
};

bool take(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}
template <class Number>
bool take_number(std::string_view& text, Number& out) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (fault != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

/// `WHEN TRUE DO $R10=5 $R[11]=6`: what is set, as long as nothing else stands there; else nothing.
std::vector<Cell> cells_of(std::string_view statement) {
  std::string plain;
  for (const char c : to_upper_ascii(statement)) {
    if (c != ' ' && c != '\t') plain += c;
  }
  std::string_view text = plain;
  const bool when = take(text, "WHENEVER") || take(text, "WHEN") || take(text, "FROM");
  if (when && !take(text, "TRUE") && !take(text, "(TRUE)")) return {};
  if (!take(text, "DO")) return {};
  std::vector<Cell> out;
  while (!text.empty()) {
    Cell cell;
    if (!take(text, "$R")) return {};
    const bool bracket = take(text, "[");
    if (!take_number(text, cell.number) || cell.number < 0 || (bracket && !take(text, "]")) || !take(text, "="))
      return {};
    take(text, "+");
    if (!take_number(text, cell.value)) return {};
    if (!text.empty() && text.front() != '$') return {};
    out.push_back(cell);
  }
  return out;
}

}  // namespace

/// True when the statement was such an action, and is carried.
bool StatementLowering::sets_at_once(const syntax::Statement& s, ir::LineInfo& info) {
  const bool straight = routine_->kind == ir::RoutineKind::main && !routine_->has_signature && labels_.empty() &&
                        structure_->depth() == 0;
  const std::vector<Cell> cells = straight ? cells_of(s.text) : std::vector<Cell>{};
  if (cells.empty()) return false;
  ir::Assign assign;
  for (const Cell& cell : cells) {
    ir::Assign::Item item;
    item.target.space = space::r;
    item.target.index = ir::number(cell.number);
    item.value = ir::number(cell.value);
    item.pos = s.pos;
    if (cell.number >= c_.machine.r_count) c_.beyond_r_parameters(s.pos);
    assign.items.push_back(std::move(item));
    c_.real_time.cells.insert(cell.number);
  }
  c_.real_time.moved = false;
  c_.note("SIN-135", s.pos,
          "this action sets its R parameters with the next move: they have their values from here on, and a block that "
          "names them before a move and STOPRE is not carried");
  emit(info, std::move(assign));
  return true;
}

bool StatementLowering::call_in_real_time(WordPos pos) {
  if (c_.real_time.cells.empty()) return false;
  return !refuse("language.synchronised", pos,
                 "a call while an action in real time may still set an R parameter is not carried",
                 "write STOPRE behind the move that the action belongs to");
}

/// False: what the R parameter holds here depends on how far the control has read ahead.
bool ExprLowering::settled(const ir::VarRef& ref, const syntax::Expr& index) {
  const auto number = ir::constant_value(ref.index);
  if (number && !c_.real_time.cells.contains(static_cast<std::int32_t>(*number))) return true;
  c_.keep("SIN-136", index.pos,
          "what this R parameter holds here depends on how far the control has read ahead: an action in real time sets "
          "it with a move",
          "write STOPRE behind that move");
  return false;
}

}  // namespace cnctrans::sinumerik
