// Cycles of newer signatures that do what an older cycle does: their words are turned into those of that one.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/saturate.h"
#include "ir/cycles/turning_moves.h"

namespace cnctrans::ir::cycles::detail {

namespace {

double word(const TurnNumbers& numbers, std::string_view name, double otherwise = 0) {
  const auto it = numbers.find(name);
  return it == numbers.end() ? otherwise : it->second;
}
/// Digit of a word that holds one decision a digit, from the right.
int digit_of(const TurnNumbers& numbers, std::string_view name, int place) {
  auto v = saturate<std::int64_t>(std::abs(word(numbers, name)));
  for (; place > 0; --place) v /= 10;
  return static_cast<int>(v % 10);
}

using Moves = std::optional<std::vector<TurnMove>>;

/// A thread between two points by a number of passes: units 1 to 4 as the older variant, hundreds 1 one flank, 2
/// alternating, ten thousands 2 by the first infeed, hundred thousands 3 roughing and finishing.
std::optional<TurnNumbers> older_words(const TurnNumbers& n, std::string* error) {
  const auto d = [&](int place) { return digit_of(n, "variant", place); };
  const double angle = word(n, "infeed_angle"), starts = std::max(1.0, std::round(word(n, "starts")));
  if (d(1) != 0 || d(2) > 2 || d(3) != 0 || d(4) > 1 || (d(5) != 0 && d(5) != 3) || (d(2) == 1 && angle < 0))
    return *error = "this way of cutting a thread is not carried out", std::nullopt;
  if (starts > 1 && (d(6) != 0 || word(n, "change_depth") != 0))
    return *error = "a thread of several starts with a depth of change is not carried out", std::nullopt;
  if (word(n, "pitch_unit") > 1)
    return *error = "a pitch in other units than mm a turn is not carried out", std::nullopt;
  if (word(n, "first_start") > 1) return *error = "a single start of a thread is not carried out", std::nullopt;
  const double along = word(n, "flank_infeed"), depth = std::abs(word(n, "depth"));
  if (along != 0 && std::abs(std::abs(along) - depth * std::tan(std::abs(angle) * std::numbers::pi / 180)) > 0.01)
    return *error = "an infeed along the flank other than that of its angle is not carried out", std::nullopt;
  TurnNumbers m = n;
  m["x"] = word(n, "nominal") / 2;
  m["x_end"] = word(n, "nominal_end", word(n, "nominal")) / 2;
  m["variant"] = d(0);
  m["infeed_angle"] = d(2) == 2 ? -std::abs(angle) : angle;
  return m;
}

Moves thread_of_digits(const TurnNumbers& n, const TurnContext& context, std::string* error) {
  const auto m = older_words(n, error);
  if (!m) return std::nullopt;
  Roles r(MachiningCycle{"thread.counted", MachiningKind::thread, false, false, false}, *m, context);
  if (!counted_thread(r, error)) return std::nullopt;
  return r.take();
}

/// A rectangular corner: from its outer point to its inner one. Units: 1 along Z, 2 along X; tens: 1 roughing, 2
/// finishing, 3 both.
Moves corner(const TurnNumbers& n, const TurnContext& context, std::string* error) {
  const bool face = digit_of(n, "variant", 0) == 2;
  const int what = digit_of(n, "variant", 1), position = saturate<int>(word(n, "position"));
  if (digit_of(n, "variant", 0) < 1 || digit_of(n, "variant", 0) > 2 || what < 1 || what > 3 || word(n, "variant") > 99)
    return *error = "this way of removing a corner is not carried out", std::nullopt;
  const TurnPoint from{word(n, "nominal") / 2, word(n, "z")}, to{word(n, "nominal_end") / 2, word(n, "z_end")};
  const double sx = sign(from.x - to.x), sz = sign(from.z - to.z);
  if (std::abs(from.x - to.x) < tiny || std::abs(from.z - to.z) < tiny)
    return *error = "the corner of the cycle has no size", std::nullopt;
  if (position < 0 || position > 3 || (position < 2) != (sx > 0) || (position % 2 == 1) != (sz > 0))
    return *error = "the position of the corner does not fit to its points", std::nullopt;
  if (face && sz < 0) return *error = "cuts along X from the back are not carried out", std::nullopt;
  const bool roughs = what != 2, finishes = what != 1;
  TurnNumbers m = n;
  m["variant"] = (sx > 0 ? 1 : 3) + (face ? 1 : 0) + (what == 1 ? 0 : what == 2 ? 4 : 8);
  m["withdrawal"] = m["clearance"] = word(n, "clearance") != 0 ? std::abs(word(n, "clearance")) : 1;
  m["finish_feed"] = word(n, "rough_feed");
  if (!roughs) m["stock_x"] = m["stock_z"] = 0;
  // The allowances move the inner lines only: the corner ends where it is said to.
  const double dx = roughs && !finishes ? std::abs(word(n, "stock_x")) : 0;
  const double dz = roughs && !finishes ? std::abs(word(n, "stock_z")) : 0;
  if (dx > std::abs(from.x - to.x) - tiny || dz > std::abs(from.z - to.z) - tiny)
    return *error = "the allowance is not smaller than the corner", std::nullopt;
  const TurnPoint edge{from.x - sx * dx, from.z - sz * dz};
  TurnProfile profile;
  profile.part.push_back({{to.x, edge.z}, to, false, false, {}});
  profile.part.push_back({to, {edge.x, to.z}, false, false, {}});
  TurnContext c = context;
  c.profile = &profile;
  Roles r(MachiningCycle{"stock.contour", MachiningKind::profile, face, false, false}, m, c);
  if (!contour_stock(r, c, face, error)) return std::nullopt;
  return r.take();
}

constexpr std::array counted_words = {
    "pitch",        "z",           "z_end",  "x",    "x_end",   "run_in", "run_out",   "depth", "finish_stock",
    "infeed_angle", "start_angle", "passes", "idle", "variant", "starts", "withdrawal"};

}  // namespace

Moves newer_signature(std::string_view cycle, const TurnNumbers& numbers, const TurnContext& context,
                      std::string* error) {
  return cycle == "shape.thread" ? thread_of_digits(numbers, context, error) : corner(numbers, context, error);
}

}  // namespace cnctrans::ir::cycles::detail

namespace cnctrans::ir::cycles {

std::optional<TurnNumbers> counted_thread_of(std::string_view cycle, const TurnNumbers& numbers) {
  std::string error;
  std::optional<TurnNumbers> all = numbers;
  if (cycle == "shape.thread") all = detail::older_words(numbers, &error);
  if (!all || (cycle != "shape.thread" && cycle != "thread.counted")) return std::nullopt;
  if (!detail::thread_pitch(*all, (*all)["pitch"], &error)) return std::nullopt;
  TurnNumbers out;
  for (const char* name : detail::counted_words) {
    const auto it = all->find(name);
    if (it != all->end()) out[name] = it->second;
  }
  return out;
}

}  // namespace cnctrans::ir::cycles
