#include "frontends/heidenhain/program/ways_of_text.h"

#include <algorithm>
#include <string>

#include "frontends/heidenhain/ways/flow.h"

namespace cnctrans::frontends::heidenhain {

namespace {

struct Kind {
  const char* name;
  const char* feature;
};
constexpr std::array<Kind, along_text> kinds{{{"the tilted plane (PLANE, cycle 19)", "motion.transformation"},
                                              {"the contours (cycle 14)", "cycle.milling"},
                                              {"the contour data (cycle 20)", "cycle.milling"},
                                              {"the contour data (cycle 270)", "cycle.milling"},
                                              {"FU before an F", "feed.of_the_tool"},
                                              {"M126", "motion.transformation"}}};

/// An F that no FU stands before in the text, and one does on some way: its unit is said. False: it can't be.
bool say_unit(Item& item, int arrival, bool per_rev) {
  constexpr auto k = static_cast<std::size_t>(AlongText::per_rev);
  if (item.sets[k] != 0 || item.before[k] != 0) return true;  // said anyway
  auto* b = std::get_if<ir::Block>(&item.statement.node);
  if (b == nullptr || arrival == 2 || (arrival == Arrival::several && per_rev)) return false;
  ir::Action unit;
  unit.data = ir::ModalSet{ir::Setting::feed_mode, static_cast<std::uint8_t>(ir::FeedMode::per_minute), true,
                           ir::FeedMemory::shared};
  b->actions.insert(b->actions.begin(), std::move(unit));
  return true;
}

}  // namespace

void give_up(Flat& flat, Item& item, const char* text, std::string_view feature) {
  if (item.kind == ItemKind::cycle) {
    flat.cycles[static_cast<std::size_t>(item.index)].refused = true;
    return;
  }
  ir::Opaque kept;
  kept.text = text;
  kept.feature = feature;
  item.statement.node = std::move(kept);
}

void check_ways_of_text(Lowering& lowering) {
  Flat& flat = lowering.flat();
  std::array<bool, along_text> ever{};
  for (const Item& i : flat.items) {
    for (std::size_t k = 0; k < along_text; ++k) ever[k] = ever[k] || i.sets[k] > 0;
  }
  if (std::none_of(ever.begin(), ever.end(), [](bool b) { return b; })) return;
  const bool per_rev = std::any_of(flat.items.begin(), flat.items.end(), [](const Item& i) {
    return i.sets[static_cast<std::size_t>(AlongText::per_rev)] == 2;
  });
  const Flow flow(flat);
  for (std::size_t n = 0; n < flat.items.size(); ++n) {
    Item& item = flat.items[n];
    const Arrival& a = flow.arrivals()[n];
    for (std::size_t k = 0; k < along_text && a.reached; ++k) {
      if (!ever[k] || !item.relies[k] || a.text[k] == item.before[k]) continue;
      if (static_cast<AlongText>(k) == AlongText::per_rev && say_unit(item, a.text[k], per_rev)) continue;
      lowering.report().start(item.statement.line.span);
      lowering.report().keep(
          "HEI-032", {},
          std::string(kinds[k].name) + (a.text[k] == Arrival::several
                                            ? ": what holds here depends on the way"
                                            : ": a call brings something else than the text above has"),
          kinds[k].feature, "write it in the subprogram, or call it under one alone");
      give_up(flat, item, "depends on the way", kinds[k].feature);
      break;
    }
  }
}

}  // namespace cnctrans::frontends::heidenhain
