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

}  // namespace

std::optional<Unfit> unfit(const ir::Program& given, const machine::Profile& machine, const FoldedText& folded) {
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
  if (!found.whole && found.numbers.empty()) return std::nullopt;
  return found;
}

}  // namespace cnctrans::translator
