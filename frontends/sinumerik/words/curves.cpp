// Polynomials and splines: PO[X]=(..), X=PO(..), PO(..), SPLINEPATH(), POLYPATH() (motion reference 3, 4).
#include <algorithm>
#include <utility>

#include "base/text.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/state/words.h"
#include "frontends/sinumerik/statements/row_parts.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

namespace {

constexpr std::size_t most_values = 5;  ///< the end and a2 to a5

/// The values of `(4,0.25)`, `IC(10,2)`, `PO(4,0.25)` or of a single one in parentheses.
bool polynomial_values(FileContext& c, ExprLowering& exprs, const Expr& list, WordPos pos, Attribute& attribute,
                       std::vector<ir::Value>& out) {
  attribute = Attribute::none;
  const bool several =
      list.kind == ExprKind::call && (list.text.empty() || list.text == "PO" || list.text == "IC" || list.text == "AC");
  std::vector<const Expr*> parts;
  if (several) {
    if (list.text == "IC") attribute = Attribute::ic;
    if (list.text == "AC") attribute = Attribute::ac;
    for (const Expr& e : list.args) parts.push_back(&e);
  } else {
    parts.push_back(&list);
  }
  if (parts.empty() || parts.size() > most_values || parts.front()->kind == ExprKind::missing) {
    c.error("SIN-012", pos, "a polynomial takes its end and up to four coefficients (a2 to a5)");
    return false;
  }
  const std::uint32_t before = c.errors;
  for (const Expr* e : parts) {
    Attribute inner = Attribute::none;
    out.push_back(e->kind == ExprKind::missing ? ir::Value(0) : exprs.value_of(*e, inner));
    if (inner == Attribute::none) continue;
    if (e != parts.front() || attribute != Attribute::none) {
      c.error("SIN-012", e->pos, "AC() and IC() belong to the end of a polynomial");
    } else {
      attribute = inner;
    }
  }
  return c.errors == before;
}

ir::PolynomialWord polynomial_word(ir::AxisId axis, std::vector<ir::Value>& values, bool after_address, WordPos pos) {
  ir::PolynomialWord w;
  w.axis = axis;
  w.degree = static_cast<std::uint8_t>(values.size());
  w.after_address = after_address;
  w.pos = pos;
  ir::Value* const places[] = {&w.a2, &w.a3, &w.a4, &w.a5};
  for (std::size_t i = 1; i < values.size(); ++i) *places[i - 1] = std::move(values[i]);
  if (axis == ir::axis::none) w.end = std::move(values.front());
  return w;
}

}  // namespace

/// X=PO(10,2)
bool WordLowering::polynomial(const syntax::Block& block, const syntax::Word& w, ir::AxisId axis) {
  if (!w.is_expression) return false;
  const Expr& e = block.exprs[static_cast<std::size_t>(w.expr)];
  if (e.kind != ExprKind::call || e.text != "PO") return false;
  Attribute attribute = Attribute::none;
  std::vector<ir::Value> values;
  if (!polynomial_values(c_, exprs_, e, w.pos, attribute, values)) {
    failed_ = true;
    return true;
  }
  ir::Value end = values.front();
  extra().polynomials.push_back(polynomial_word(axis, values, true, w.pos));
  coordinate(axis, w, std::move(end), attribute);
  return true;
}

/// PO[X]=(10,2), PO[]=(2,1)
bool StatementLowering::polynomial_item(const syntax::Statement& s, Parts& parts) {
  const Expr& target = s.args[0];
  if (target.args.size() > 1) {
    c_.error("SIN-012", s.pos, "PO[] takes one axis");
    return false;
  }
  const bool common = target.args.empty() || target.args[0].kind == ExprKind::missing;
  Attribute attribute = Attribute::none;
  std::vector<ir::Value> values;
  ir::AxisId id = ir::axis::none;
  if (!common) {
    const Expr& index = target.args[0];
    for (const char* angle : {"PHI", "PSI", "THT", "XH", "YH", "ZH"}) {
      if (index.text != angle) continue;
      ir::Action a;  // as A3= and its like: positions are those of the tip
      a.data = ir::OpaqueWord{c_.slice(s.pos)};
      a.pos = s.pos;
      a.text = c_.slice(s.pos);
      parts.actions.push_back(std::move(a));
      c_.note("SIN-009", s.pos, "the orientation of the tool is kept as text; positions are those of its tip");
      return true;
    }
    const ir::ExprPtr axis = exprs_.is_undefined(index) ? nullptr : exprs_.axis_operand(index);
    const auto* literal = axis ? std::get_if<ir::AxisName>(&axis->node) : nullptr;
    if (literal == nullptr)
      return refuse("motion.polynomial", s.pos, "the polynomial of an axis in a variable is not carried yet");
    id = literal->axis;
  }
  if (!polynomial_values(c_, exprs_, s.args[1], s.pos, attribute, values)) return false;
  if (attribute != Attribute::none && attribute != Attribute::ac && attribute != Attribute::ic)
    return refuse("motion.polynomial", s.pos, "this way to give the end of a polynomial is not carried yet");
  if (!common) {
    ir::CoordWord coord;
    coord.axis = id;
    coord.value = values.front();
    coord.pos = s.pos;
    if (attribute == Attribute::ac) coord.mode = ir::WordMode::absolute;
    if (attribute == Attribute::ic) coord.mode = ir::WordMode::incremental;
    parts.coords.push_back(std::move(coord));
  }
  parts.polynomials.push_back(polynomial_word(id, values, false, s.pos));
  return true;
}

/// PO(2,1): the denominator, written as a call.
bool StatementLowering::denominator(const std::vector<Expr>& args, WordPos pos, Parts& parts) {
  Expr list;
  list.kind = ExprKind::call;
  list.args = args;
  list.pos = pos;
  Attribute attribute = Attribute::none;
  std::vector<ir::Value> values;
  if (!polynomial_values(c_, exprs_, list, pos, attribute, values)) return false;
  parts.polynomials.push_back(polynomial_word(ir::axis::none, values, true, pos));
  return true;
}

/// SPLINEPATH(1,X,Y,Z): the axes of the splines that follow.
bool StatementLowering::spline_axes(const std::vector<Expr>& args, WordPos pos, Parts& parts) {
  constexpr std::size_t most_axes = 8;
  if (args.size() < 2 || args.size() > most_axes + 1 || args[0].kind != ExprKind::number || args[0].number != 1) {
    c_.error("SIN-012", pos, "SPLINEPATH() takes 1 and the names of one to eight axes");
    return false;
  }
  ir::SplineAxes group;
  for (std::size_t i = 1; i < args.size(); ++i) {
    const auto axis = exprs_.is_undefined(args[i]) ? nullptr : exprs_.axis_operand(args[i]);
    const auto* literal = axis ? std::get_if<ir::AxisName>(&axis->node) : nullptr;
    if (literal == nullptr)
      return refuse("motion.spline", args[i].pos, "SPLINEPATH() is carried for axes of the machine only");
    group.axes.push_back({literal->axis});
  }
  ir::Action a;
  a.data = std::move(group);
  a.pos = pos;
  a.text = c_.slice(pos);
  parts.actions.push_back(std::move(a));
  return true;
}

/// POLYPATH("AXES","VECT"): for which axes polynomials are carried out.
bool StatementLowering::polynomial_path(const std::vector<Expr>& args, WordPos pos, Parts& parts) {
  bool axes = false;
  for (const Expr& e : args) {
    const std::string text = to_upper_ascii(e.text);
    const bool known = e.kind == ExprKind::string && (text == "AXES" || text == "VECT");
    if (!known && !(e.kind == ExprKind::missing && args.size() == 1)) {
      c_.error("SIN-012", pos, "POLYPATH() takes \"AXES\" and \"VECT\"");
      return false;
    }
    axes = axes || text == "AXES";
  }
  ir::Action a;
  const auto on = axes ? ir::OnOff::on : ir::OnOff::off;
  a.data = ir::ModalSet{ir::Setting::polynomial_axes, static_cast<std::uint8_t>(on), true, ir::FeedMemory::shared};
  a.pos = pos;
  a.text = c_.slice(pos);
  parts.actions.push_back(std::move(a));
  return true;
}

}  // namespace cnctrans::sinumerik
