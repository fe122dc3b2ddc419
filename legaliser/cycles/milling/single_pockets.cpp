#include "legaliser/cycles/milling/single_pockets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/noise.h"
#include "ir/cycles/words.h"
#include "ir/known_number.h"

namespace cnctrans::ir::passes {

namespace {

constexpr std::array<std::string_view, 6> of_the_circle{"u", "v", "count", "radius", "angle", "angle_step"};
constexpr double most_slots = 360;

/// `other` where it is left out.
std::optional<double> number(const HoleCycle& cycle, std::string_view name, double other) {
  const Value* v = cycles::find_word(cycle.mill.words, name);
  return v != nullptr ? known_number(*v) : std::optional(other);
}
std::optional<SinglePockets> slots(const HoleCycle& cycle, std::string* why) {
  const Value *u = cycles::find_word(cycle.mill.words, "u"), *v = cycles::find_word(cycle.mill.words, "v");
  const auto count = number(cycle, "count", 1), angle = number(cycle, "angle", 0), radius = number(cycle, "radius", 0),
             length = number(cycle, "length", 0), width = number(cycle, "width", 0);
  auto turn = number(cycle, "angle_step", 0);
  if (!u || !v || !count || !angle || !radius || !length || !width || !turn)
    return *why = "a size of the slots, or where they lie, is computed", std::nullopt;
  const double a = std::fabs(*length) / 2, b = std::fabs(*width) / 2;
  if (a <= b || b <= 0 || *count < 1 || *count > most_slots)
    return *why = "the slots have no length, no width or no number", std::nullopt;
  if (*turn == 0) turn = 360 / std::round(*count);
  HoleCycle slot = cycle;
  slot.mill.shape = "pocket.rect";
  std::erase_if(slot.mill.words, [](const auto& w) {
    return std::find(of_the_circle.begin(), of_the_circle.end(), w.first) != of_the_circle.end();
  });
  slot.mill.words.emplace_back("corner", Value(without_noise(b)));
  SinglePockets out;
  for (long k = 0; k < std::lround(*count); ++k) {
    const double degrees = *angle + static_cast<double>(k) * *turn, turned = degrees * std::numbers::pi / 180;
    const auto on_middle_line = [&](double from_centre) {
      return std::pair(without_text(add(*u, Value(without_noise(from_centre * std::cos(turned))))),
                       without_text(add(*v, Value(without_noise(from_centre * std::sin(turned))))));
    };
    const double inner = std::fabs(*radius);
    HoleCycle one = slot;
    auto middle = on_middle_line(inner + a);
    one.mill.words.emplace_back("u", std::move(middle.first));
    one.mill.words.emplace_back("v", std::move(middle.second));
    one.mill.words.emplace_back("angle", Value(without_noise(std::remainder(degrees, 360))));
    out.pockets.push_back(std::move(one));
    out.end = on_middle_line(inner + b);
  }
  return out;
}

}  // namespace

std::optional<SinglePockets> single_pockets(const HoleCycle& cycle, std::string* why) {
  if (cycle.mill.shape.starts_with("pocket.")) return SinglePockets{{cycle}, std::nullopt};
  if (cycle.mill.shape == "slot.radial") return slots(cycle, why);
  return std::nullopt;
}

}  // namespace cnctrans::ir::passes
