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

/// Does what is written for the word go by where the axis stands before it?
bool goes_by_place(const ir::CoordWord& w, const ir::Program& program, const FoldTarget& target) {
  const machine::Profile& machine = target.machine;
  if (program.dialect == target.dialect || machine.option("rotary.direction") == "in_word") return false;
  const std::string dialect(target.dialect);
  const bool by_sign =
      machine.option(dialect + ".rotary_modulo").find(ir::fixed_axis_name(w.axis)) != std::string::npos ||
      machine.option(dialect + ".rotary_rollover") == "yes";
  return w.direction != (by_sign ? ir::RotaryDirection::by_sign : ir::RotaryDirection::as_value);
}

/// Letters of rotary words that were left out and are not plain coordinates.
std::uint32_t rotary_letters(const ir::Program& program, const machine::Profile& machine, const FoldTarget& target,
                             const FoldedText& folded) {
  std::uint32_t found = 0;
  for (const ir::AxisId id : {ir::axis::a, ir::axis::b, ir::axis::c}) {
    const std::uint32_t letter = 1U << static_cast<unsigned>(ir::fixed_axis_name(id).front() - 'A');
    if ((folded.letters() & letter) == 0) continue;
    const auto* axis = machine.axis(id);
    bool other = axis == nullptr || !axis->rotary;
    for (const auto& routine : program.routines) {
      ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
        const auto* block = std::get_if<ir::Block>(&s.node);
        if (block == nullptr || !block->has_motion) return;
        for (const auto& w : block->motion.coords) other = other || (w.axis == id && goes_by_place(w, program, target));
      });
    }
    if (other) found |= letter;
  }
  return found;
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
        if (number && !folded.numbers().contains(*number)) found.numbers.insert(*number);
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
  found.whole = found.whole || std::any_of(folded.gaps().begin(), folded.gaps().end(), [&](const Gap& gap) {
                  const auto it = ids.find(gap.first - 1);
                  return it == ids.end() || facts.before(it->second).settings[distance] !=
                                                static_cast<std::uint8_t>(ir::Distance::absolute);
                });
  found.letters = rotary_letters(program, machine, target, folded);
  if (!found.whole && found.numbers.empty() && found.letters == 0) return std::nullopt;
  return found;
}

}  // namespace cnctrans::translator
