// Values of words: numbers as they are written, expressions, and what AC, IC, DC and their like say of them.
#include <optional>

#include "dialects/sinumerik/asked.h"
#include "frontends/sinumerik/state/expr.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

/// CAC(3), CDC(3), CACP(3), CACN(3): the third position of the axis in the machine's table, the datum CAC[B,3].
std::optional<ir::Value> ExprLowering::numbered_position(const Expr& e, Attribute& out) {
  const bool steps = e.text == stepped_position_datum;
  if (!steps && e.text != "CAC" && e.text != "CDC" && e.text != "CACP" && e.text != "CACN") return std::nullopt;
  if (e.args.size() != 1) {
    c_.error("SIN-012", e.pos, e.text + "() takes the number of a position");
    return ir::Value{};
  }
  out = steps ? Attribute::acp : attribute(e.text.substr(1));
  ir::SystemRef position;
  position.text = steps ? stepped_position_datum : numbered_position_datum;
  position.args.push_back(lower(e.args[0]));
  if (!position.args.back()) return ir::Value{};
  if (steps) {  // forward or backward through the table
    const auto count = ir::constant_value(position.args.back());
    if (!count) {
      c_.keep("SIN-008", e.pos, "CIC() with a computed number of steps is not carried yet");
      return ir::Value{};
    }
    if (*count <= 0) out = *count < 0 ? Attribute::acn : Attribute::dc;
  }
  if (c_.first_time(position.text)) {
    c_.warning("SIN-015", e.pos,
               e.text +
                   "(): the table of positions is known to the machine only: a run takes the profile's value, or "
                   "stops where it is read",
               "--set \"CAC[axis,number]=VALUE\" gives it");
  }
  return ir::Value(make_expr(std::move(position), ir::Type::real, e.pos));
}

/// The table is that of an axis. A linear axis has one way only.
void ExprLowering::of_axis(ir::Value& value, ir::AxisId axis, Attribute& attribute) const {
  const auto* ref = value.expr ? std::get_if<ir::SystemRef>(&value.expr->node) : nullptr;
  const auto* spec = c_.machine.profile->axis(axis);
  if (ref == nullptr || spec == nullptr || ref->args.size() != 1) return;
  const bool steps = ref->text == stepped_position_datum;
  if (!steps && ref->text != numbered_position_datum) return;
  ir::SystemRef named = *ref;
  if (steps) {
    named.axis = axis;
    if (!spec->rotary) attribute = Attribute::ac;
  } else {
    named.args.insert(named.args.begin(), ir::string_literal(spec->name));
  }
  value = ir::Value(make_expr(std::move(named), ir::Type::real, value.expr->pos));
}

ir::Value ExprLowering::value_of(const Expr& e, Attribute& out) {
  out = Attribute::none;
  const Expr* inner = &e;
  if (e.kind == ExprKind::call) {
    if (auto position = numbered_position(e, out)) return *position;
    out = attribute(e.text);
    if (e.text == "QU" && e.args.size() == 1) {  // quick output: the same value
      out = Attribute::none;
      return value_of(e.args[0], out);
    }
    if (e.text == "GP" && e.args.size() == 2 && e.args[1].kind == ExprKind::number) {  // the attribute by its number
      const Attribute chosen = attribute(e.args[1].number);
      if (chosen != Attribute::unsupported) {
        const ir::Value v = value_of(e.args[0], out);
        out = chosen;
        return v;
      }
    }
    if (out == Attribute::unsupported || e.text.empty()) {
      c_.keep("SIN-008", e.pos,
              "this way to give a position (" + (e.text.empty() ? "a list" : e.text) + ") is not carried yet");
      return ir::Value{};
    }
    if (out != Attribute::none) {
      if (e.args.size() != 1) {
        c_.error("SIN-012", e.pos, e.text + "() takes one value");
        return ir::Value{};
      }
      inner = &e.args[0];
    }
  }
  if (inner->kind == ExprKind::number) return ir::Value(inner->number, c_.slice(inner->pos));
  if (inner->kind == ExprKind::unary && inner->text == "-" && inner->args[0].kind == ExprKind::number &&
      inner->pos.length == inner->args[0].pos.length + 1 &&
      inner->args[0].text.find_first_of("XxHB'") == std::string::npos) {
    return ir::Value(-inner->args[0].number, c_.slice(inner->pos));
  }
  if (inner->kind == ExprKind::unary && inner->text == "+" && inner->args[0].kind == ExprKind::number &&
      inner->pos.length == inner->args[0].pos.length + 1) {
    return ir::Value(inner->args[0].number, c_.slice(inner->pos));
  }
  ir::ExprPtr expr = lower(*inner);
  const Symbol* symbol = inner->kind == ExprKind::name ? c_.symbol(inner->text) : nullptr;
  if (expr && symbol != nullptr && symbol->character) expr = convert(std::move(expr), ir::Type::real, inner->pos);
  if (expr && (expr->type == ir::Type::string || expr->type == ir::Type::axis)) {
    c_.error("SIN-012", inner->pos, "a number is needed here");
    return ir::Value{};
  }
  return ir::Value(std::move(expr));
}

ir::Value ExprLowering::value(const syntax::Block& block, const syntax::Word& word, Attribute& out) {
  out = Attribute::none;
  if (!word.is_expression) return ir::Value(word.number, word.number_text);
  return value_of(block.exprs[static_cast<std::size_t>(word.expr)], out);
}

}  // namespace cnctrans::sinumerik
