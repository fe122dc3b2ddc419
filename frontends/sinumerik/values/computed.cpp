// What the reader computes: circles through points (CALCDAT), curve tables (CTABDEF .. CTABEND and their functions),
// frames from measured points (MEAFRAME). The results are expressions of the values handed over (motion reference 8,
// 15.2, 19.4).
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/sinumerik/g_functions.h"
#include "frontends/sinumerik/state/statements.h"
#include "ir/frame_rows.h"

namespace cnctrans::sinumerik {

using syntax::Block;
using syntax::Expr;
using syntax::ExprKind;

namespace {

ir::ExprPtr plus(ir::ExprPtr a, ir::ExprPtr b) {
  return ir::binary(ir::BinaryOp::add, std::move(a), std::move(b));
}
ir::ExprPtr minus(ir::ExprPtr a, ir::ExprPtr b) {
  return ir::binary(ir::BinaryOp::subtract, std::move(a), std::move(b));
}
ir::ExprPtr times(ir::ExprPtr a, ir::ExprPtr b) {
  return ir::binary(ir::BinaryOp::multiply, std::move(a), std::move(b));
}

}  // namespace

/// The element of an array that is named as a whole.
ir::ExprPtr ExprLowering::element(const Expr& array, std::initializer_list<int> indices) {
  const Symbol* symbol = c_.symbol(array.text);
  ir::VarRef ref;
  ref.space = symbol->space;
  ref.name = array.text;
  for (const int i : indices) ref.indices.push_back(ir::number(i));
  return make_expr(std::move(ref), symbol->type, array.pos);
}

/// The value goes to the variable that stands as argument `index`; true as well when there is none.
bool ExprLowering::give_back(const Expr& e, std::size_t index, ir::ExprPtr value) {
  if (index >= e.args.size() || e.args[index].kind == ExprKind::missing) return true;
  if (c_.given_back == nullptr) {
    c_.keep("SIN-007", e.pos, e.text + "() is carried in an assignment to a variable only");
    return false;
  }
  ir::Type type = ir::Type::real;
  auto ref = variable(e.args[index], type);
  if (!ref) return false;
  ir::Assign::Item item;
  item.target = std::move(*ref);
  item.value = convert(std::move(value), type, e.pos);
  if (!item.value) return false;
  c_.given_back->push_back(std::move(item));
  return true;
}

// --- circles ----------------------------------------------------------------------------------------------------

/// OK=CALCDAT(POINTS,3,RESULT): the circle through three points, its middle and radius.
bool StatementLowering::circle_data(const ir::VarRef& target, const Expr& call, WordPos pos, ir::Assign& out) {
  const auto array = [&](std::size_t i, std::uint8_t dimensions) {
    const Symbol* symbol = i < call.args.size() ? c_.symbol(call.args[i].text) : nullptr;
    return symbol != nullptr && symbol->type == ir::Type::real && symbol->dimensions == dimensions &&
           call.args[i].args.empty();
  };
  const bool fits = call.args.size() == 3 && array(0, 2) && array(2, 1);
  if (!fits) {
    c_.error("SIN-012", pos, "CALCDAT() takes an array of points [n,2], their number and an array for the result [3]");
    return false;
  }
  if (call.args[1].kind != ExprKind::number || call.args[1].number != 3)
    return refuse("language.statement", call.args[1].pos, "CALCDAT() of more than three points is not carried yet");
  const Expr& points = call.args[0];
  const Expr& result = call.args[2];
  const auto at = [&](int i, int k) { return exprs_.element(points, {i, k}); };
  const auto from_first = [&](int i, int k) { return minus(at(i, k), at(0, k)); };
  const auto square = [&](int i) {
    return plus(ir::call(ir::Function::square, {from_first(i, 0)}), ir::call(ir::Function::square, {from_first(i, 1)}));
  };
  // Twice the cross product of the two sides (mm2), and the quotient by it without a division by zero: points whose
  // product is smaller than `least` count as standing on a line.
  constexpr double least = 0.001;
  const auto cross =
      times(ir::number(2), minus(times(from_first(1, 0), from_first(2, 1)), times(from_first(1, 1), from_first(2, 0))));
  const auto by_cross = [&](ir::ExprPtr e) {
    return ir::binary(
        ir::BinaryOp::divide, times(std::move(e), cross),
        ir::call(ir::Function::max, {ir::call(ir::Function::square, {cross}), ir::number(least * least)}));
  };
  const auto add = [&](ir::VarRef to, ir::ExprPtr value) {
    ir::Assign::Item item;
    item.target = std::move(to);
    item.value = std::move(value);
    item.pos = pos;
    out.items.push_back(std::move(item));
  };
  const auto place = [&](int k) { return std::get<ir::VarRef>(exprs_.element(result, {k})->node); };
  add(place(0),
      plus(at(0, 0), by_cross(minus(times(from_first(2, 1), square(1)), times(from_first(1, 1), square(2))))));
  add(place(1),
      plus(at(0, 1), by_cross(minus(times(from_first(1, 0), square(2)), times(from_first(2, 0), square(1))))));
  add(place(2), ir::call(ir::Function::sqrt,
                         {plus(ir::call(ir::Function::square, {minus(exprs_.element(result, {0}), at(0, 0))}),
                               ir::call(ir::Function::square, {minus(exprs_.element(result, {1}), at(0, 1))}))}));
  add(target, make_expr(ir::Binary{ir::BinaryOp::gt, ir::call(ir::Function::abs, {cross}), ir::number(least),
                                   ir::Compare::exact},
                        ir::Type::boolean, pos));
  return true;
}

// --- frames -----------------------------------------------------------------------------------------------------

/// MEAFRAME(IDEAL,MEASURED,QUALITY): computed by the run, from the points as they are then.
ir::ExprPtr ExprLowering::measured_frame(const Expr& e) {
  const auto array = [&](std::size_t i) {
    const Symbol* symbol = i < e.args.size() ? c_.symbol(e.args[i].text) : nullptr;
    return symbol != nullptr && symbol->type == ir::Type::real && symbol->dimensions == 2 && e.args[i].args.empty();
  };
  if (e.args.size() != 3 || !array(0) || !array(1)) {
    c_.error("SIN-012", e.pos, "MEAFRAME() takes two arrays REAL [3,3] and a variable for the quality");
    return nullptr;
  }
  ir::SystemRef ref;
  ref.text = e.text;
  ref.datum = ir::Datum::frame_settable;
  ref.args.push_back(ir::number(ir::frame_rows::measured));
  for (const std::size_t list : {std::size_t{0}, std::size_t{1}}) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) ref.args.push_back(element(e.args[list], {i, k}));
    }
  }
  if (!give_back(e, 2, make_expr(ref, ir::Type::real, e.pos))) return nullptr;
  return make_expr(std::move(ref), ir::Type::frame, e.pos);
}

// --- curve tables -----------------------------------------------------------------------------------------------

/// A block from CTABDEF to CTABEND. `name`: of the statement that is all of it, capitals; else empty.
void StatementLowering::table_block(const Block& block, std::string_view name) {
  if (name == "CTABDEF") {
    const auto& args = block.statements.front().args;
    const bool fits = args.size() >= 4 && args[2].kind == ExprKind::number && args[3].kind == ExprKind::number;
    c_.table = nullptr;
    if (!fits) {  // which one it is can't be told
      for (auto& [number, table] : c_.tables) table.known = false;
      return;
    }
    const auto number = saturate<std::int32_t>(args[2].number);
    CurveTable made;
    made.follower = c_.machine.axis(args[0].text);
    made.leader = c_.machine.axis(args[1].text);
    made.period = saturate<std::int32_t>(args[3].number);
    // A second table of the number, or one inside of a structure: which of them holds is not sure.
    made.known = made.follower != ir::axis::none && made.leader != ir::axis::none && !c_.tables.contains(number) &&
                 structure_->depth() == 0;
    c_.table = &(c_.tables[number] = std::move(made));
    return;
  }
  if (c_.table == nullptr) return;
  CurveTable& t = *c_.table;
  if (name == "CTABEND") {
    const auto& p = t.points;
    t.known = t.known && p.size() > 1;
    for (std::size_t i = 1; i < p.size(); ++i) t.known = t.known && p[i].first > p[i - 1].first;
    c_.table = nullptr;
    return;
  }
  std::pair<double, double> point = t.points.empty() ? std::pair{0.0, 0.0} : t.points.back();
  bool leads = false;
  t.known = t.known && block.statements.empty() && block.skip_mask == 0 && block.labels.empty();
  for (const auto& w : block.words) {
    const ir::AxisId axis = c_.machine.axis(to_upper_ascii(w.address));
    const bool plain = w.has_value && !w.is_expression && w.extension < 0;
    if (plain && axis == t.leader) {
      point.first = w.number;
      leads = true;
    } else if (plain && axis == t.follower) {
      point.second = w.number;
    } else if (const bool g = w.address == "G" || w.address == "g";
               !plain || (!g && w.address != "F" && w.address != "f") ||
               (g && w.number != 0 && w.number != 1 && w.number != 90)) {
      t.known = false;  // an arc, an increment, a spline, a computed point
    }
  }
  if (leads) t.points.push_back(point);
  t.known = t.known && (leads || block.words.empty());
}

namespace {

/// Straight lines between the points of a table; outside of them its ends go on (no period) or it begins again.
class TableFunction {
 public:
  explicit TableFunction(const CurveTable& t) : t_(t), p_(t.points) {}

  [[nodiscard]] double inside(double lead) const {
    if (t_.period == 0) return std::clamp(lead, first().first, last().first);
    const double span = last().first - first().first;
    return lead - std::floor((lead - first().first) / span) * span;
  }
  /// The line that holds `lead`; of two at their common point the later one.
  [[nodiscard]] std::size_t segment(double lead) const {
    std::size_t i = 0;
    while (i + 2 < p_.size() && lead >= p_[i + 1].first) ++i;
    return i;
  }
  [[nodiscard]] double slope(std::size_t i) const {
    return (p_[i + 1].second - p_[i].second) / (p_[i + 1].first - p_[i].first);
  }
  [[nodiscard]] bool outside(double lead) const {
    return t_.period == 0 && (lead < first().first || lead > last().first);
  }
  [[nodiscard]] double value(double lead) const {
    const double x = inside(lead);
    const std::size_t i = segment(x);
    return p_[i].second + slope(i) * (x - p_[i].first);
  }
  [[nodiscard]] double extreme(double from, double to, bool largest) const {
    double out = value(from);
    const auto take = [&](double y) { out = largest ? std::max(out, y) : std::min(out, y); };
    take(value(to));
    for (const auto& [x, y] : p_) {
      if (x >= from && x <= to) take(y);
    }
    return out;
  }
  /// The leader nearest to `near` whose follower is `y`; nullopt: there is none.
  [[nodiscard]] std::optional<double> inverse(double y, double near) const {
    std::optional<double> best;
    for (std::size_t i = 0; i + 1 < p_.size(); ++i) {
      const double a = p_[i].second, b = p_[i + 1].second;
      if (y < std::min(a, b) || y > std::max(a, b)) continue;
      const double x = a == b ? std::clamp(near, p_[i].first, p_[i + 1].first)
                              : p_[i].first + (y - a) / (b - a) * (p_[i + 1].first - p_[i].first);
      if (!best || std::abs(x - near) < std::abs(*best - near)) best = x;
    }
    return best;
  }
  [[nodiscard]] const std::pair<double, double>& first() const { return p_.front(); }
  [[nodiscard]] const std::pair<double, double>& last() const { return p_.back(); }

  /// The leader inside of the table.
  [[nodiscard]] ir::ExprPtr inside(const ir::ExprPtr& lead) const {
    if (t_.period == 0) return lead;
    const double span = last().first - first().first;
    const auto turns =
        ir::call(ir::Function::floor,
                 {ir::binary(ir::BinaryOp::divide, minus(lead, ir::number(first().first)), ir::number(span))});
    return minus(lead, times(turns, ir::number(span)));
  }
  /// The first value and what each line adds up to the leader.
  [[nodiscard]] ir::ExprPtr value(const ir::ExprPtr& lead) const {
    const auto x = inside(lead);
    ir::ExprPtr sum = ir::number(first().second);
    for (std::size_t i = 0; i + 1 < p_.size(); ++i) {
      if (slope(i) == 0) continue;
      const auto part = ir::call(ir::Function::bound, {ir::number(p_[i].first), ir::number(p_[i + 1].first), x});
      sum = plus(std::move(sum), times(ir::number(slope(i)), minus(part, ir::number(p_[i].first))));
    }
    return sum;
  }

 private:
  const CurveTable& t_;
  const std::vector<std::pair<double, double>>& p_;
};

struct TableFunctionRow {
  std::string_view name;
  std::size_t table, slope;  ///< places of the table's number and of the variable for the slope; 9: none
};
constexpr std::size_t no_slope = 9;
constexpr TableFunctionRow table_functions[] = {
    {"CTAB", 1, 2},
    {"CTABINV", 2, 3},
    {"CTABTSV", 0, 1},
    {"CTABTEV", 0, 1},
    {"CTABTSP", 0, 1},
    {"CTABTEP", 0, 1},
    {"CTABSSV", 1, 2},
    {"CTABSEV", 1, 2},
    {"CTABTMIN", 0, no_slope},
    {"CTABTMAX", 0, no_slope},
    {"CTABEXISTS", 0, no_slope},
    {"CTABPERIOD", 0, no_slope},
};

}  // namespace

/// CTAB and its like over a table that the program defines before, of straight lines between written points.
ir::ExprPtr ExprLowering::table_function(const Expr& e) {
  const auto unknown = [&](const std::string& why) {
    c_.keep("SIN-007", e.pos, e.text + "() is not carried here: " + why);
    return nullptr;
  };
  const auto* row = std::find_if(std::begin(table_functions), std::end(table_functions),
                                 [&](const auto& r) { return r.name == e.text; });
  if (row == std::end(table_functions)) return unknown("its value is known to the machine only");
  if (e.args.size() <= row->table) {
    c_.error("SIN-012", e.pos, e.text + "() needs the number of the table");
    return nullptr;
  }
  const Expr& number = e.args[row->table];
  const auto found =
      number.kind == ExprKind::number ? c_.tables.find(saturate<std::int32_t>(number.number)) : c_.tables.end();
  if (found == c_.tables.end() || c_.table != nullptr)
    return unknown("the program defines no table of this number before");
  const CurveTable& t = found->second;
  if (!t.known || t.period == 2)
    return unknown("its table is not made of straight lines between written points, or there are several");
  const TableFunction f(t);
  const auto literal = [&](double value) {
    ir::Number n;
    n.value = value;
    n.text = c_.slice(e.pos);
    return make_expr(std::move(n), ir::Type::real, e.pos);
  };
  std::vector<std::optional<double>> values;
  std::vector<ir::ExprPtr> args;
  for (std::size_t i = 0; i < e.args.size(); ++i) {
    const bool read = i != row->slope && e.args[i].kind != ExprKind::missing;
    args.push_back(read ? lower(e.args[i]) : nullptr);
    if (read && !args.back()) return nullptr;
    values.push_back(read ? ir::constant_value(args.back()) : std::nullopt);
  }
  const auto slope_at = [&](double lead) { return f.outside(lead) ? 0.0 : f.slope(f.segment(f.inside(lead))); };
  const auto result = [&](double value, double lead) -> ir::ExprPtr {
    if (row->slope != no_slope && !give_back(e, row->slope, ir::number(slope_at(lead)))) return nullptr;
    return literal(value);
  };
  if (e.text == "CTABEXISTS") return literal(1);
  if (e.text == "CTABPERIOD") return literal(t.period);
  if (e.text == "CTABTSV") return result(f.first().second, f.first().first);
  if (e.text == "CTABTEV") return result(f.last().second, f.last().first);
  if (e.text == "CTABTSP") return result(f.first().first, f.first().first);
  if (e.text == "CTABTEP") return result(f.last().first, f.last().first);
  if (e.text == "CTABTMIN" || e.text == "CTABTMAX") {
    const bool part = e.args.size() > 2;
    if (part && (!values[1] || !values[2])) return unknown("the ends of its interval are not written");
    return literal(
        f.extreme(part ? *values[1] : f.first().first, part ? *values[2] : f.last().first, e.text == "CTABTMAX"));
  }
  if (!values[0] && e.text == "CTAB") {
    const bool slope = e.args.size() > row->slope && e.args[row->slope].kind != ExprKind::missing;
    if (slope) return unknown("the slope at a computed place of the table");
    return ir::at(f.value(args[0]), e.pos);
  }
  if (!values[0] || (e.text == "CTABINV" && !values[1])) return unknown("its values are not written");
  const double lead = *values[0];
  if (e.text == "CTAB") return result(f.value(lead), lead);
  if (e.text == "CTABINV") {
    const auto at = f.inverse(*values[0], *values[1]);
    return at ? result(*at, *at) : unknown("the table has no such value of the axis that follows");
  }
  const std::size_t i = f.segment(f.inside(lead));
  const double start = t.points[i].second, end = t.points[i + 1].second;
  return result(e.text == "CTABSSV" ? start : end, lead);
}

}  // namespace cnctrans::sinumerik
