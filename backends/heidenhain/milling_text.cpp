// Milling cycles of the IR in the Q parameters of the control's own (reference 16).
#include <array>
#include <cmath>
#include <string_view>

#include "backends/heidenhain/cycles.h"

namespace cnctrans::backends::heidenhain {

using ir::Value;

namespace {

struct MillRow {
  std::string_view parameter;
  std::int16_t q;       ///< 0: it has none
  double factor = 1;    ///< Q is so many times the parameter
  bool needed = false;  ///< what stands for it where it is left out is not the control's way
};
struct MillCycle {
  std::string_view shape;
  std::int16_t number;
  std::array<MillRow, 14> rows;
};
/// Of several for one shape the first that has all its words.
constexpr std::array mill_cycles{
    MillCycle{"pocket.rect",
              253,
              {{{"operation", 215},
                {"length", 218, 1, true},
                {"width", 219, 1, true},
                {"corner", 219, 2, true},  // the ends are round
                {"wall_stock", 368},
                {"angle", 374},
                {"mill_feed", 207, 1, true},
                {"sense", 351, 1, true},
                {"infeed", 202},
                {"floor_stock", 369},
                {"plunge_feed", 206, 1, true},
                {"finish_infeed", 338},
                {"finish_feed", 385}}}},
    MillCycle{"pocket.rect",
              251,
              {{{"operation", 215},
                {"length", 218, 1, true},
                {"width", 219, 1, true},
                {"corner", 220},
                {"wall_stock", 368},
                {"angle", 224},
                {"mill_feed", 207, 1, true},
                {"sense", 351},
                {"infeed", 202},
                {"floor_stock", 369},
                {"plunge_feed", 206, 1, true},
                {"finish_infeed", 338},
                {"step_factor", 370, 2, true},
                {"finish_feed", 385}}}},
    MillCycle{"pocket.circle",
              252,
              {{{"operation", 215},
                {"radius", 223, 2, true},
                {"wall_stock", 368},
                {"mill_feed", 207, 1, true},
                {"sense", 351},
                {"infeed", 202},
                {"floor_stock", 369},
                {"plunge_feed", 206, 1, true},
                {"finish_infeed", 338},
                {"step_factor", 370, 2, true},
                {"finish_feed", 385}}}},
    MillCycle{"bore.helix",
              208,
              {{{"diameter", 335, 1, true},
                {"pitch", 334, 1, true},
                {"mill_feed", 206, 1, true},
                {"plunge_feed", 206, 1, true},
                {"sense", 351}}}},
    MillCycle{"thread.helix",
              262,
              {{{"diameter", 335, 1, true},
                {"pitch", 239, 1, true},
                {"per_step", 355},
                {"mill_feed", 207, 1, true},
                {"plunge_feed", 253, 1, true},
                {"lead_feed", 512},
                {"sense", 351}}}},
};
constexpr double largest_overlap = 1.414;

const MillRow* find_row(const MillCycle& cycle, std::string_view parameter) {
  for (const auto& row : cycle.rows) {
    if (row.q != 0 && row.parameter == parameter) return &row;
  }
  return nullptr;
}

/// 0: it can't say the words.
int mill_text(const MillCycle& cycle, const ir::HoleCycle& c, std::map<std::int16_t, Value>& values) {
  int needed = 0;
  for (const auto& row : cycle.rows) needed += row.needed ? 1 : 0;
  bool outside = false;
  for (const auto& [name, v] : c.mill.words) {
    if (name == "external") {
      outside = !v.is(0);
      continue;
    }
    const MillRow* row = find_row(cycle, name);
    if (row == nullptr) {
      if (v.is(0)) continue;
      return 0;
    }
    if (row->needed && (name == "sense" || !(v.literal() && v.number == 0))) --needed;
    Value q = row->factor == 1 ? v : ir::scale(v, row->factor);
    if (name == "sense") {
      if (!v.is(0) && !v.is(1)) return 0;
      q = Value(v.is(0) ? 1 : -1);
    }
    if (name == "step_factor" && (!q.literal() || q.number > largest_overlap + 1e-9)) return 0;
    const auto said = values.find(row->q);
    if (said != values.end() && !ir::equal(said->second, q)) return 0;
    values[row->q] = std::move(q);
  }
  if (needed != 0) return 0;
  if (find_row(cycle, "sense") != nullptr) values.emplace(351, Value(1));
  return outside ? 267 : cycle.number;
}

}  // namespace

int mill_text(const ir::HoleCycle& c, std::map<std::int16_t, Value>& values) {
  for (const auto& cycle : mill_cycles) {
    if (cycle.shape != c.mill.shape) continue;
    auto own = values;
    const int number = mill_text(cycle, c, own);
    if (number == 0) continue;
    values = std::move(own);
    return number;
  }
  return 0;
}

}  // namespace cnctrans::backends::heidenhain
