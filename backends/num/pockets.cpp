// G45 and G31 in their own words (reference 11.6, 11.5).
#include <algorithm>
#include <array>
#include <utility>

#include "backends/num/style.h"
#include "backends/num/writer.h"
#include "dialects/num/milling.h"

namespace cnctrans::backends::num {

namespace facts = dialects::num;

bool native_pocket(const ir::HoleCycle& c) {
  const auto absolute = [](const ir::Level& l) { return l.given && l.base == ir::LevelBase::absolute; };
  const bool levels = absolute(c.bottom) && absolute(c.retract) && absolute(c.surface) && c.reference.given &&
                      c.reference.base == ir::LevelBase::from_surface && c.reference.value.literal() &&
                      (std::abs(std::abs(c.reference.value.number) - facts::pocket_clearance) < 1e-9 ||
                       std::abs(std::abs(c.reference.value.number) - facts::pocket_clearance / 25.4) < 1e-9);
  const bool circle = c.mill.shape == facts::circle;
  if (c.kind != ir::HoleKind::mill || c.axis != ir::axis::none || !levels ||
      (!circle && c.mill.shape != facts::rectangle))
    return false;
  return std::all_of(c.mill.words.begin(), c.mill.words.end(), [circle](const auto& word) {
    if (word.second.literal() && word.second.number < 0) return false;
    if (circle && word.first == "radius") return true;
    return std::any_of(facts::pocket_words.begin(), facts::pocket_words.end(),
                       [&word](const auto& row) { return row.parameter == word.first; });
  });
}

void Writer::pocket(const ir::Action& a, const ir::HoleCycle& c) {
  const bool thread = c.mill.shape == "thread.chased";
  if (thread && other_habits(a, c.mill.words, facts::thread_habits(own_options_))) return;
  add(a.text.empty() || !same_dialect() ? thread ? "G31" : "G45" : std::string(a.text), Rank::setting, a.pos);
  const auto plane = setting(ir::Setting::plane);
  const ir::AxisId axis = plane ? ir::plane_axes(static_cast<ir::Plane>(*plane)).w : ir::axis::z;
  add(level_word(axis_name(axis), c.bottom, a.pos), Rank::center);
  if (c.retract.base == ir::LevelBase::absolute) add(level_word("ER", c.retract, a.pos), Rank::motion_extra);
  if (c.surface.given) add(level_word("EH", c.surface, a.pos), Rank::motion_extra);
  if (thread) {
    const bool same = c.retract.base == c.reference.base && ir::equal(c.retract.value, c.reference.value);
    if (!same && c.reference.base == ir::LevelBase::absolute)
      add(level_word("EH", c.reference, a.pos), Rank::motion_extra);
    constexpr std::array<std::pair<std::string_view, std::string_view>, 6> rows{
        {{"pitch", "K"}, {"depth", "P"}, {"last_pass", "Q"}, {"starts", "F"}, {"passes", "S"}, {"angle", "EC"}}};
    for (const auto& [parameter, address] : rows) {
      for (const auto& [name, v] : c.mill.words) {
        if (name == parameter) add(word(address, v, a.pos), Rank::motion_extra);
      }
    }
    return;
  }
  for (const auto& row : facts::pocket_words) {
    for (const auto& [name, v] : c.mill.words) {
      const bool radius = name == "radius" && row.parameter == "corner";
      if (radius || name == row.parameter) add(word(row.address, v, a.pos), Rank::motion_extra);
    }
  }
}

}  // namespace cnctrans::backends::num
