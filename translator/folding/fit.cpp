#include "translator/folding/fit.h"

#include <algorithm>
#include <unordered_map>

#include "base/text.h"
#include "ir/analysis/dataflow.h"
#include "ir/analysis/label_uses.h"
#include "ir/edit/search.h"

namespace cnctrans::translator {

namespace {

/// The number of a block by which it may be asked for: `100`, or `N100`.
std::optional<std::uint64_t> block_number(std::string_view label) {
  if (!label.empty() && label.front() == 'N') label.remove_prefix(1);
  if (label.empty() || label.size() > 18 || label.find_first_not_of("0123456789") != std::string_view::npos)
    return std::nullopt;
  std::uint64_t number = 0;
  for (const char c : label) number = number * 10 + static_cast<std::uint64_t>(c - '0');
  return number;
}

/// What is written for a rotary word goes by its number, by the way there as well, or by more than that.
enum class GoesBy : std::uint8_t { number, way, more };

GoesBy turning(const ir::CoordWord& w, const ir::Program& program, const FoldTarget& target) {
  using ir::RotaryDirection;
  const machine::Profile& machine = target.machine;
  if (program.dialect == target.dialect || machine.policies.rotary_direction == machine::RotaryDirection::in_word)
    return GoesBy::number;
  const bool by_sign = machine.policies.rotary_rollover ||
                       machine.policies.rotary_signed_axes.find(ir::fixed_axis_name(w.axis)) != std::string::npos;
  if (w.direction == (by_sign ? RotaryDirection::by_sign : RotaryDirection::as_value)) return GoesBy::number;
  return w.direction == RotaryDirection::as_value ? GoesBy::way : GoesBy::more;
}

GoesBy turning(ir::AxisId axis, const ir::Program& program, const FoldTarget& target) {
  GoesBy most = GoesBy::number;
  for (const auto& routine : program.routines) {
    ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
      const auto* block = std::get_if<ir::Block>(&s.node);
      if (block == nullptr || !block->has_motion) return;
      for (const auto& w : block->motion.coords) {
        if (w.axis == axis) most = std::max(most, turning(w, program, target));
      }
    });
  }
  return most;
}

}  // namespace

std::optional<Unfit> unfit(const ir::Program& given, const machine::Profile& machine, const FoldTarget& target,
                           const FoldedText& folded) {
  Unfit found;
  ir::Program program = given;
  ir::number_statements(program);
  for (const auto& routine : program.routines) {
    const auto uses = ir::passes::label_uses(program, routine);
    found.whole = found.whole || uses.computed || uses.computed_name;
    for (const auto* labels : {&uses.targets, &uses.ends}) {
      for (const auto& [is_number, text] : *labels) {
        const auto number = block_number(text);
        if (number && folded.may_lose(*number)) found.numbers.insert(*number);
      }
    }
  }
  std::unordered_map<std::uint32_t, std::uint32_t> ids;  // by line
  const FileId file = program.files.empty() ? 0 : program.files.front().file;
  for (const auto& routine : program.routines) {
    ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
      if (s.line.span.file == file) ids.emplace(s.line.span.line, s.id);
    });
  }
  const ir::FactTable facts = ir::analyse(program, machine.power_on);
  constexpr auto distance = static_cast<std::size_t>(ir::Setting::distance);
  for (const Gap& gap : folded.gaps()) {
    const auto it = ids.find(gap.first - 1);
    const auto mode = gap.place.increments ? ir::Distance::incremental : ir::Distance::absolute;
    if (!gap.stands_in &&
        (it == ids.end() || facts.before(it->second).settings[distance] != static_cast<std::uint8_t>(mode)))
      found.runs.insert(gap.run);
  }
  for (const ir::AxisId id : {ir::axis::a, ir::axis::b, ir::axis::c}) {
    const std::uint32_t letter = 1U << static_cast<unsigned>(ir::fixed_axis_name(id).front() - 'A');
    const auto with_it = [letter](const Gap& gap) { return (gap.letters & letter) != 0; };
    if (std::none_of(folded.gaps().begin(), folded.gaps().end(), with_it)) continue;
    const auto* axis = machine.axis(id);
    const auto goes_by = axis != nullptr && axis->rotary ? turning(id, program, target) : GoesBy::more;
    const bool lost = std::any_of(folded.gaps().begin(), folded.gaps().end(), [&](const Gap& gap) {
      const auto it = ids.find(gap.first - 1);
      return with_it(gap) && !gap.stands_in && it != ids.end() && !facts.before(it->second).position[id];
    });
    const bool told = (folded.by_way() & letter) != 0;
    if (goes_by == GoesBy::more || (goes_by == GoesBy::way && told && lost))
      found.letters |= letter;
    else if (goes_by == GoesBy::way && !told)
      found.by_way |= letter;
  }
  if (!found.whole && found.numbers.empty() && found.runs.empty() && (found.letters | found.by_way) == 0)
    return std::nullopt;
  return found;
}

}  // namespace cnctrans::translator
