#include "frontends/heidenhain/program/copies.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "frontends/heidenhain/program/fresh_labels.h"
#include "frontends/heidenhain/program/tools.h"
#include "frontends/heidenhain/ways/flow.h"

namespace cnctrans::frontends::heidenhain {

namespace {

class Copies {
 public:
  explicit Copies(Lowering& lowering) : lowering_(lowering), flat_(lowering.flat()), labels_(lowering) {}

  /// True: a subprogram was copied, and the ways are others now.
  bool once() {
    const Flow flow(flat_);
    for (std::size_t r = 1; r < flow.roots().size(); ++r) {
      if (copied(flow, r)) return true;
    }
    return false;
  }

 private:
  using Root = Flow::Root;
  /// By the definition in force and by the tool, as far as the text asks for them.
  using Calls = std::map<std::pair<int, int>, std::vector<int>>;
  Item& item(int i) { return flat_.items[static_cast<std::size_t>(i)]; }

  bool copied(const Flow& flow, std::size_t r) {
    const Root& root = flow.roots()[r];
    const auto [by_cycle, by_tool] = asks(flow, root);
    if (root.ends.size() != 1 || root.runs_out || (!by_cycle && !by_tool) || entered_otherwise(flow, r)) return false;
    Calls calls;
    for (int i = 0; i < static_cast<int>(flat_.items.size()); ++i) {
      const Arrival& a = flow.arrivals()[static_cast<std::size_t>(i)];
      if (item(i).kind != ItemKind::call || flow.label(item(i)) != root.start || !a.reached) continue;
      const std::pair key{by_cycle ? a.cycle : Arrival::none, by_tool ? a.tool : Arrival::none};
      if ((by_cycle && key.first < 0) || (by_tool && key.second < 0)) return false;
      calls[key].push_back(i);
    }
    if (calls.size() < 2 || calls.size() > most_copies || (!by_tool && alike(calls))) return false;
    const int last = root.ends.front();
    const std::vector<Item> text(flat_.items.begin() + root.start, flat_.items.begin() + last + 1);
    std::vector<Item> behind;
    for (auto it = std::next(calls.begin()); it != calls.end(); ++it) {
      std::vector<Item> copy = text;
      labels_.rename(copy);
      if (by_tool) own_definitions(copy);
      for (const int c : it->second) {
        item(c).label = copy.front().label;
        item(c).number = copy.front().number;
      }
      behind.insert(behind.end(), std::make_move_iterator(copy.begin()), std::make_move_iterator(copy.end()));
    }
    lowering_.report().start(item(root.start).statement.line.span);
    lowering_.report().note("HEI-031", {},
                            "the subprogram is called under " + std::to_string(calls.size()) +
                                (by_tool ? " tools whose F, S or radius it takes" : " definitions of cycles") +
                                ": it has a copy for each");
    flat_.items.insert(flat_.items.begin() + last + 1, std::make_move_iterator(behind.begin()),
                       std::make_move_iterator(behind.end()));
    return true;
  }
  /// The cycle that a block of its text calls is not known; and the tool whose feed it takes. So are those of a
  /// subprogram that it calls.
  std::pair<bool, bool> asks(const Flow& flow, const Root& root) {
    std::set<int> seen;
    return asks(flow, root, seen);
  }
  std::pair<bool, bool> asks(const Flow& flow, const Root& root, std::set<int>& seen) {
    std::pair<bool, bool> out;
    if (!seen.insert(root.start).second) return out;
    for (int i = root.start; !root.ends.empty() && i <= root.ends.front(); ++i) {
      const Arrival& a = flow.arrivals()[static_cast<std::size_t>(i)];
      const bool cycles = a.reached && a.cycle == Arrival::several, tools = a.reached && a.tool == Arrival::several;
      out.first = out.first || (item(i).call != CycleCall::none && cycles);
      out.second = out.second || (tools && asks_tool(flat_, item(i), a));
      if (item(i).kind != ItemKind::call || (!cycles && !tools)) continue;
      for (const Root& inner : flow.roots()) {
        if (&inner == &flow.roots().front() || inner.start != flow.label(item(i))) continue;
        const auto more = asks(flow, inner, seen);
        out = {out.first || (more.first && cycles), out.second || (more.second && tools)};
      }
    }
    return out;
  }
  /// A definition whose values are those of the tool is another one in each copy.
  void own_definitions(std::vector<Item>& copy) {
    std::map<int, int> own;
    for (Item& i : copy) {
      if (i.kind != ItemKind::cycle) continue;
      if (own.count(i.index) == 0) {
        own[i.index] = static_cast<int>(flat_.cycles.size());
        flat_.cycles.push_back(flat_.cycles[static_cast<std::size_t>(i.index)]);
      }
      i.index = own[i.index];
    }
  }
  /// Another way than its calls leads into the text, or out of it.
  static bool entered_otherwise(const Flow& flow, std::size_t r) {
    const Root& root = flow.roots()[r];
    for (std::size_t other = 0; other < flow.roots().size(); ++other) {
      const auto& reached = flow.roots()[other].reached;
      for (int i = 0; i < static_cast<int>(reached.size()); ++i) {
        const bool inside = i >= root.start && i <= root.ends.front();
        if (reached[static_cast<std::size_t>(i)] && inside != (other == r)) {
          if (other == r || inside) return true;
        }
      }
    }
    return false;
  }
  /// One cycle with other values: these are handed over in its parameters.
  [[nodiscard]] bool alike(const Calls& calls) const {
    const auto& first = flat_.cycles[static_cast<std::size_t>(calls.begin()->first.first)];
    return std::all_of(flat_.cycles.begin(), flat_.cycles.end(), [&first](const CycleDefinition& c) {
      const bool called = c.row != nullptr ? c.row->called : c.old == nullptr || c.old->called;
      return !called || (c.row != nullptr && c.number == first.number);
    });
  }
  Lowering& lowering_;
  Flat& flat_;
  FreshLabels labels_;
};

}  // namespace

void copy_for_cycles(Lowering& lowering) {
  if (lowering.flat().cycles.size() < 2 && lowering.flat().tools.size() < 2) return;
  Copies copies(lowering);
  for (int n = 0; n < most_copies && copies.once(); ++n) {
  }
}

}  // namespace cnctrans::frontends::heidenhain
