#include "ir/program.h"

#include <array>

#include "ir/cycle.h"

namespace cnctrans::ir {

std::string_view Program::axis_name(AxisId id) const {
  if (id < axis::first_extra) return fixed_axis_name(id);
  const std::size_t i = id - axis::first_extra;
  return i < axis_names.size() ? std::string_view{axis_names[i]} : std::string_view{};
}

const Routine* Program::main() const {
  for (const auto& r : routines) {
    if (r.kind == RoutineKind::main) return &r;
  }
  return nullptr;
}

const Routine* Program::find(const RoutineName& wanted) const {
  if (!wanted.text.empty()) {
    for (const auto& r : routines) {
      if (r.name.text == wanted.text) return &r;
    }
    return nullptr;
  }
  if (wanted.number < 0) return nullptr;
  for (const auto& r : routines) {
    if (r.name.number == wanted.number) return &r;
  }
  return nullptr;
}

SpaceId Program::space(std::string_view prefix) const {
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    if (spaces[i].prefix == prefix) return static_cast<SpaceId>(i);
  }
  return static_cast<SpaceId>(spaces.size());
}

std::uint32_t number_statements(Program& program) {
  std::uint32_t next = 0;
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&next](Statement& s) { s.id = ++next; });
  }
  return next;
}

namespace {
constexpr std::array<std::string_view, 12> hole_names{"drill",        "peck_full", "peck_break",  "tap",
                                                      "tap_floating", "ream",      "bore",        "bore_stop",
                                                      "bore_shift",   "back_bore", "bore_manual", "mill"};
constexpr std::array<std::string_view, 5> base_names{"absolute", "from_initial", "from_reference", "from_surface",
                                                     "distance_mode"};
constexpr std::array<std::string_view, 7> law_names{"none",      "constant", "count",   "arithmetic",
                                                    "geometric", "linear",   "balanced"};
}  // namespace

std::string_view name(HoleKind k) {
  return hole_names[static_cast<std::size_t>(k)];
}
std::string_view name(LevelBase b) {
  return base_names[static_cast<std::size_t>(b)];
}
std::string_view name(PeckLaw l) {
  return law_names[static_cast<std::size_t>(l)];
}

}  // namespace cnctrans::ir
