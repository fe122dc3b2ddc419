#include "frontends/heidenhain/program/fresh_labels.h"

#include <map>
#include <utility>

namespace cnctrans::frontends::heidenhain {

FreshLabels::FreshLabels(Lowering& lowering) : lowering_(lowering) {
  for (const Item& i : lowering.flat().items) taken_.insert(i.label);
}

std::string FreshLabels::free(const Item& label) {
  if (taken_.insert(label.label).second) return label.label;
  std::string name;
  int n = label.number ? 1 : 2;
  do {
    name = (label.number ? "" : label.label + "_") + std::to_string(n++);
  } while (!taken_.insert(name).second);
  return name;
}

void FreshLabels::rename(std::span<Item> copy) {
  std::map<std::pair<std::string, bool>, std::string> names;
  for (Item& i : copy) {
    if (i.kind != ItemKind::label) continue;
    const std::string now = free(i);
    names[{i.label, i.number}] = now;
    i.label = now;
    auto& line = i.statement.line;
    line.labels.clear();
    if (i.number)
      line.number = lowering_.keep(now);
    else
      line.labels.push_back(lowering_.keep(now));
  }
  for (Item& i : copy) {
    const auto name = names.find({i.label, i.number});
    if (name == names.end() || i.kind == ItemKind::label) continue;
    i.label = name->second;
    if (auto* jump = std::get_if<ir::Jump>(&i.statement.node)) jump->target.text = name->second;
    if (auto* repeat = std::get_if<ir::Repeat>(&i.statement.node)) repeat->first.text = name->second;
  }
}

}  // namespace cnctrans::frontends::heidenhain
