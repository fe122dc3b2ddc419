// Lists of values: SET() and REP() over arrays and R parameters, single characters of texts (reference 3.5, 5).
#include <algorithm>
#include <utility>

#include "base/saturate.h"
#include "dialects/sinumerik/variables.h"
#include "frontends/sinumerik/state/statements.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

namespace {

/// Elements from `first` to the end of the array; 0 when its size or the place is not known.
std::size_t elements_from(const ir::VarRef& first, const Symbol* symbol, std::size_t& flat) {
  if (symbol == nullptr || first.indices.empty()) return 0;
  std::size_t count = 1;
  flat = 0;
  for (std::size_t i = 0; i < first.indices.size(); ++i) {
    const auto n = ir::constant_value(first.indices[i]);
    const std::size_t size = symbol->sizes[i];
    if (!n || size == 0 || *n < 0 || *n >= static_cast<double>(size)) return 0;
    flat = flat * size + saturate<std::size_t>(*n);
    count *= size;
  }
  return count - flat;
}

/// The variable `offset` elements behind `first`, the last index running fastest. False when that can't be told.
bool behind(const ir::VarRef& first, const Symbol* symbol, std::size_t offset, ir::VarRef& out) {
  out = first;
  const auto plus = [](const ir::ExprPtr& index, std::size_t n) {
    if (n == 0) return index;
    if (const auto constant = ir::constant_value(index)) return ir::number(*constant + static_cast<double>(n));
    return ir::binary(ir::BinaryOp::add, index, ir::number(static_cast<double>(n)));
  };
  if (first.indices.size() <= 1) {
    ir::ExprPtr& index = first.space == space::r ? out.index : out.indices[0];
    index = plus(index, offset);
    return true;
  }
  if (offset == 0) return true;
  std::size_t flat = 0;
  if (elements_from(first, symbol, flat) <= offset) return false;
  flat += offset;
  for (std::size_t i = first.indices.size(); i-- > 0;) {
    out.indices[i] = ir::number(static_cast<double>(flat % symbol->sizes[i]));
    flat /= symbol->sizes[i];
  }
  return true;
}

constexpr std::size_t longest_list = 5000;

}  // namespace

/// `TAB[2]=SET(1,2,3)`, `TAB[2]=(1,2,3)`, `TAB[2]=REP(5)`, `TAB[2]=REP(5,3)`: one assignment an element.
bool StatementLowering::assign_list(const ir::VarRef& target, ir::Type type, const Expr& list, const Symbol* symbol,
                                    WordPos pos, ir::Assign& out) {
  const bool numbered = target.space == space::r && target.name.empty();
  if (!numbered && target.indices.empty()) {
    c_.error("SIN-012", pos, "a list of values goes to an array, from the element that is named");
    return false;
  }
  const bool repeats = list.text == "REP";
  std::size_t count = list.args.size();
  if (repeats) {
    if (list.args.empty()) {
      c_.error("SIN-012", list.pos, "REP() needs the value");
      return false;
    }
    std::size_t flat = 0;
    const std::size_t rest = elements_from(target, symbol, flat);
    count = rest;
    if (list.args.size() > 1) {
      const auto n = ir::constant_value(exprs_.lower_as(list.args[1], ir::Type::integer));
      if (!n || *n < 0)
        return refuse("language.statement", list.args[1].pos, "REP() with a computed count is not carried yet");
      count = saturate<std::size_t>(*n);
      if (rest != 0 && count > rest) {
        c_.error("SIN-017", pos, "the list is longer than the array");
        return false;
      }
    } else if (rest == 0) {
      return refuse("language.statement", pos, "REP() up to the end of an array whose size is not known here");
    }
  }
  if (count > longest_list) return refuse("language.statement", pos, "so long a list is not carried");
  for (std::size_t i = 0; i < count; ++i) {
    ir::Assign::Item item;
    if (!behind(target, symbol, i, item.target)) {
      return refuse("language.statement", pos,
                    "a list over several dimensions needs literal indices and an array of known size");
    }
    const Expr& e = repeats ? list.args[0] : list.args[i];  // a gap writes 0
    const bool character = symbol != nullptr && symbol->character;
    item.value = e.kind == ExprKind::missing ? zero_of(type)
                 : character                 ? exprs_.lower_character(e)
                                             : exprs_.lower_as(e, type);
    if (!item.value) return false;
    item.pos = pos;
    out.items.push_back(std::move(item));
  }
  return true;
}

ir::ExprPtr StatementLowering::zero_of(ir::Type type) {
  if (type == ir::Type::string) return ir::string_literal({});
  return make_expr(ir::Number{0, "0", true}, ir::Type::integer, WordPos{});
}

/// `NAME[5]="X"`: the text with another character at this place; code 0 ends the text there (5).
bool StatementLowering::assign_character(const Expr& target, const Expr& value, WordPos pos, ir::Assign& out) {
  const Symbol* symbol = c_.symbol(target.text);
  ir::VarRef ref;
  ref.space = symbol->space;
  ref.name = target.text;
  for (std::size_t i = 0; i < symbol->dimensions; ++i) {
    ref.indices.push_back(exprs_.lower_as(target.args[i], ir::Type::integer));
    if (!ref.indices.back()) return false;
  }
  const ir::ExprPtr at = exprs_.lower_as(target.args.back(), ir::Type::integer);
  ir::ExprPtr character = exprs_.lower_character(value);
  if (!at || !character) return false;
  if (std::holds_alternative<ir::VarRef>(character->node))  // whose code may be 0
    character = ir::call(ir::Function::character, {ir::call(ir::Function::character_code, {std::move(character)})});
  const ir::ExprPtr whole = ir::variable(ref, ir::Type::string);
  const ir::ExprPtr before = ir::call(ir::Function::substring, {whole, ir::number(0), at});
  const ir::ExprPtr after =
      ir::call(ir::Function::substring, {whole, ir::binary(ir::BinaryOp::add, at, ir::number(1))});
  ir::Assign::Item item;
  item.target = std::move(ref);
  item.value = ir::binary(ir::BinaryOp::concat, before, ir::binary(ir::BinaryOp::concat, std::move(character), after));
  item.pos = pos;
  out.items.push_back(std::move(item));
  return true;
}

}  // namespace cnctrans::sinumerik
