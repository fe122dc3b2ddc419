#include "ir/analysis/block_coordinate.h"

#include <algorithm>

#include "base/saturate.h"
#include "base/text.h"

namespace cnctrans::ir {

namespace {

constexpr double no_word = 100000;

bool is_number(const Program& program, double number) {
  const auto* main = program.main();
  const auto own = main != nullptr ? main_number(*main) : std::nullopt;
  return own && *own == number;
}

}  // namespace

std::optional<double> main_number(const Routine& main) {
  if (main.name.number >= 0) return static_cast<double>(main.name.number);
  const std::string& text = main.name.text;
  const bool digits =
      !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits ? parse_decimal(text) : std::nullopt;
}

std::optional<double> block_coordinate(const Program* at_hand, const ProgramFinder* library, AxisId axis, double block,
                                       double number) {
  const Program* program = at_hand != nullptr && is_number(*at_hand, number) ? at_hand : nullptr;
  if (program == nullptr && library != nullptr && *library)
    program = (*library)(RoutineName{saturate<std::int64_t>(number), {}});
  if (program == nullptr) return std::nullopt;
  const Statement* found = nullptr;
  for (const auto& r : program->routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      if (found != nullptr || s.line.number.empty()) return;
      const auto own = parse_decimal(s.line.number);
      if (own && *own == block) found = &s;
    });
  }
  const auto* b = found != nullptr ? std::get_if<Block>(&found->node) : nullptr;
  if (b == nullptr) return std::nullopt;
  const auto& coords = b->motion.coords;
  const auto word = std::find_if(coords.begin(), coords.end(), [axis](const CoordWord& w) { return w.axis == axis; });
  if (!b->has_motion || word == coords.end()) return no_word;
  if (!word->value.literal()) return std::nullopt;
  return word->value.number;
}

}  // namespace cnctrans::ir
