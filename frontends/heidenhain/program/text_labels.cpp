#include "frontends/heidenhain/program/text_labels.h"

#include <algorithm>

#include "base/text.h"
#include "frontends/heidenhain/program/ways_of_text.h"
#include "frontends/heidenhain/ways/flow.h"

namespace cnctrans::frontends::heidenhain {

namespace {

/// The label that the ways bring to the item; empty: no one, or several.
std::string brought(const Flow& flow, const Flat& flat, std::size_t at) {
  const auto& texts = flow.arrivals()[at].texts;
  const auto it = texts.find(flat.items[at].label_text);
  return it == texts.end() || !it->second ? std::string{} : to_upper_ascii(trim(*it->second));
}

void name_label(Item& item, const std::string& label) {
  item.label = item.text_found = label;
  if (auto* repeat = std::get_if<ir::Repeat>(&item.statement.node)) repeat->first.text = label;
  if (auto* jump = std::get_if<ir::Jump>(&item.statement.node)) jump->target.text = label;
}

}  // namespace

void find_text_labels(Lowering& lowering, bool last) {
  Flat& flat = lowering.flat();
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < flat.items.size(); ++i) {
    if (!flat.items[i].label_text.empty()) all.push_back(i);
  }
  if (all.empty()) return;
  for (bool more = true; more;) {  // a label that is found opens further ways
    more = false;
    const Flow flow(flat);
    for (const auto i : all) {
      const std::string label = flat.items[i].label.empty() ? brought(flow, flat, i) : std::string{};
      if (label.empty()) continue;
      name_label(flat.items[i], label);
      more = true;
    }
  }
  if (!last) return;
  const Flow flow(flat);
  for (const auto i : all) {
    Item& item = flat.items[i];
    if (!flow.arrivals()[i].reached || (!item.label.empty() && brought(flow, flat, i) == item.text_found)) continue;
    lowering.report().start(item.statement.line.span);
    lowering.report().keep("HEI-010", {},
                           "which label " + item.label_text + " names depends on the way, or is not known",
                           "language.statement", "write the name of the label");
    give_up(flat, item, "LBL", "language.statement");
    item.kind = ItemKind::plain;
  }
}

}  // namespace cnctrans::frontends::heidenhain
