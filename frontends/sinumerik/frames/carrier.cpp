// Orientable tool carriers and tables: TCARR chooses the data, PAROT turns the coordinates with the table (motion
// reference 7.7, 12.5).
#include <array>
#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/sinumerik/frames.h"
#include "frontends/sinumerik/state/statements.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

namespace {

constexpr double degree = 3.14159265358979323846 / 180;
constexpr int first_vector = 7, second_vector = 10, first_angle = 13, second_angle = 14, kind_of_carrier = 23;

using Matrix = std::array<std::array<double, 3>, 3>;

/// The turn about a direction, right-handed; a direction of no length turns nothing.
Matrix turn_about(std::array<double, 3> v, double angle) {
  Matrix m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const double length = std::hypot(v[0], v[1], v[2]);
  if (length == 0 || angle == 0) return m;
  for (double& x : v) x /= length;
  const double c = std::cos(angle * degree), s = std::sin(angle * degree);
  const Matrix skew{{{0, -v[2], v[1]}, {v[2], 0, -v[0]}, {-v[1], v[0], 0}}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) m[i][k] = m[i][k] * c + v[i] * v[k] * (1 - c) + skew[i][k] * s;
  }
  return m;
}

}  // namespace

std::optional<double> FileContext::carrier_datum(int number) const {
  const std::int32_t which = carrier.chosen.value_or(0);
  if (const auto own = carrier.data.find(which); own != carrier.data.end()) {
    if (const auto it = own->second.find(number); it != own->second.end()) return it->second;
  }
  const auto& data = machine.profile->data;
  const auto it = data.find("$TC_CARR" + std::to_string(number) + "[" + std::to_string(which) + "]");
  return it != data.end() ? std::optional(it->second) : std::nullopt;
}

/// Angles about X, Y and Z (Z first, then the new Y, the new X) by which the table of the chosen carrier is turned;
/// none, and `why`, where that is not known.
std::optional<std::array<double, 3>> FileContext::table_turn(std::string& why) const {
  const auto kind = carrier_datum(kind_of_carrier);
  if (!kind || carrier.unsure) {
    why = "the data of the tool carrier are not known here";
    return std::nullopt;
  }
  const auto value = [this](int n) { return carrier_datum(n).value_or(0); };
  const auto letter = static_cast<char>(saturate<int>(*kind) & 0x5F);  // any case
  const double first = letter == 'P' ? value(first_angle) : 0, second = letter == 'T' ? 0 : value(second_angle);
  if (letter != 'T' && letter != 'P' && letter != 'M') {
    why = "$TC_CARR23 of the tool carrier is none of T, P and M";
    return std::nullopt;
  }
  if (first == 0 && second == 0) return std::array<double, 3>{};
  const TableTurn sense = machine.options.table_turn;
  if (sense == TableTurn::unknown) {
    why = "which way the table turns with the angles of its carrier is not described";
    return std::nullopt;
  }
  const double sign = sense == TableTurn::with_angle ? 1 : -1;
  const auto vector = [&](int n) { return std::array<double, 3>{value(n), value(n + 1), value(n + 2)}; };
  const Matrix a = turn_about(vector(first_vector), sign * first);
  const Matrix b = turn_about(vector(second_vector), sign * second);
  Matrix r{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t j = 0; j < 3; ++j) r[i][k] += a[i][j] * b[j][k];
    }
  }
  const auto clean = [](double angle) {
    constexpr double fine = 1e10;
    return std::round(angle / degree * fine) / fine;
  };
  return std::array<double, 3>{clean(std::atan2(r[2][1], r[2][2])),
                               clean(-std::asin(std::fmin(1, std::fmax(-1, r[2][0])))),
                               clean(std::atan2(r[1][0], r[0][0]))};
}

/// $TC_CARR13[1]=30: data of a carrier, in the order of the text.
void StatementLowering::note_carrier(const Expr& target, const Expr& value) {
  constexpr std::string_view name = "$TC_CARR";
  if (!target.text.starts_with(name)) return;
  const std::string digits = target.text.substr(name.size());
  const bool plain = target.args.size() == 1 && target.args[0].kind == ExprKind::number && !digits.empty() &&
                     digits.size() < 3 && digits.find_first_not_of("0123456789") == std::string::npos &&
                     labels_.empty() && structure_->depth() == 0;
  const bool letter = value.kind == ExprKind::string && value.text.size() == 1;
  const auto number = plain && !letter && value.kind != ExprKind::string ? exprs_.lower(value) : nullptr;
  const auto known = letter ? std::optional<double>(value.text[0]) : number ? ir::constant_value(number) : std::nullopt;
  if (!plain || (!known && value.kind != ExprKind::string)) {
    c_.carrier.unsure = true;
    return;
  }
  const auto which = saturate<std::int32_t>(target.args[0].number);
  if (which == 0) c_.carrier.data.clear();  // all carriers are deleted
  if (known) c_.carrier.data[which][std::stoi(digits)] = *known;
}

/// The frame that PAROT and PAROTOF of the block set, behind their text.
void StatementLowering::turn_with_table(const syntax::Block& block, const ir::LineInfo& info) {
  const syntax::Word* word = nullptr;
  for (const auto& w : block.words) {
    const std::string name = to_upper_ascii(w.address);
    if (!w.has_value && (name == "PAROT" || name == "PAROTOF")) word = &w;
  }
  if (word == nullptr) return;
  const bool ends = to_upper_ascii(word->address) == "PAROTOF";
  std::string why;
  std::optional<std::array<double, 3>> angles{std::array<double, 3>{}};
  if (!ends && c_.carrier.chosen.value_or(0) != 0) angles = c_.table_turn(why);
  const bool turns = angles && *angles != std::array<double, 3>{};
  if (!turns && !c_.carrier.turned) return;
  c_.carrier.turned = true;
  c_.framed = true;
  c_.said.emplace("$P_BFRAME");
  ir::Call turn;
  turn.function = turns ? ir::Function::frame_turn : ir::Function::frame_shift;
  for (ir::AxisId axis = ir::axis::x; turns && axis <= ir::axis::z; ++axis) {
    if ((*angles)[axis] == 0) continue;
    turn.args.push_back(make_expr(ir::AxisName{axis}, ir::Type::axis, word->pos));
    turn.args.push_back(ir::number((*angles)[axis]));
  }
  ir::Assign assign;
  ir::Assign::Item item;
  item.to_system = true;
  item.system.text = "$P_PARTFRAME";
  item.system.datum = ir::Datum::frame_settable;
  item.system.args.push_back(ir::number(ir::frame_rows::active_base));
  item.value = make_expr(std::move(turn), ir::Type::frame, word->pos);
  item.pos = WordPos{word->pos.column, 0};  // of the word, which has its own text
  assign.items.push_back(std::move(item));
  ir::LineInfo own = further_line(info);
  emit(own, std::move(assign));
}

}  // namespace cnctrans::sinumerik
