#include "frontends/heidenhain/program/again.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "frontends/heidenhain/program/fresh_labels.h"
#include "frontends/heidenhain/ways/flow.h"

namespace cnctrans::frontends::heidenhain {

namespace {

/// F says its unit itself where that is needed.
constexpr auto own_word = static_cast<std::size_t>(AlongText::per_rev);

/// What holds at a call: lines above it that are no items may have set it.
std::int16_t at_call(const Item& call, std::size_t k) {
  return call.sets[k] >= 0 ? call.sets[k] : call.before[k];
}

class Reading {
 public:
  Reading(Lowering& lowering, const Again& again)
      : lowering_(lowering), again_(again), flat_(lowering.flat()), labels_(lowering) {}

  /// True: items were added, and the ways are others now.
  bool once() {
    if (flat_.items.empty()) return false;
    const ItemKind last = flat_.items.back().kind;
    if (last != ItemKind::end && last != ItemKind::sub_end) return false;
    const Flow flow(flat_);
    return programs(flow) || subprograms(flow);
  }

 private:
  Item& item(std::size_t i) { return flat_.items[i]; }
  void name_labels(std::size_t from) { labels_.rename(std::span(flat_.items).subspan(from)); }

  // --- called programs -----------------------------------------------------------------------------------------------

  bool programs(const Flow& flow) {
    std::map<std::string, std::vector<std::size_t>> calls;
    bool outside = false;  // a cycle that another program may have defined
    for (std::size_t i = 0; i < flat_.items.size(); ++i) {
      const Arrival& a = flow.arrivals()[i];
      const bool runs = item(i).call != CycleCall::none || item(i).at_pattern ||
                        (item(i).kind == ItemKind::plain && item(i).index >= 0);
      outside = outside || (runs && a.reached && (a.outside || a.cycle == Arrival::none));
      if (item(i).kind == ItemKind::program && !item(i).calls_selected)
        calls[std::get<ir::CallRoutine>(item(i).statement.node).routine.text].push_back(i);
    }
    bool changed = false;
    for (const auto& [name, all] : calls) {
      const auto known = taken_in_.find(name);
      if (known == taken_in_.end()) {
        const Shared& shared = again_.look_into(name);
        const bool takes =
            shared.readable && ((outside && shared.defines) || std::any_of(all.begin(), all.end(), [&](std::size_t i) {
                                  return takes_from(shared, item(i), flow.arrivals()[i]);
                                }));
        for (const std::size_t i : all) item(i).defines_none = shared.known && !shared.defines;
        if (!takes) continue;
      }
      changed = true;
      std::string label = known == taken_in_.end() ? name : known->second;
      if (known == taken_in_.end()) {
        const std::size_t from = flat_.items.size();
        Item first = item(all.front());
        first.label = name;
        again_.read_program(first, name);
        name_labels(from);
        label = taken_in_[name] = item(from).label;
        lowering_.report().start(item(all.front()).statement.line.span);
        lowering_.report().note(
            "HEI-033", {},
            "the program " + name + " and this one share a cycle or the like: it is read as a subprogram of this one");
      }
      for (const std::size_t i : all) {
        item(i).kind = ItemKind::call;
        item(i).label = label;
        item(i).number = false;
      }
    }
    return changed;
  }
  static bool takes_from(const Shared& shared, const Item& call, const Arrival& a) {
    if (!a.reached) return false;
    if (shared.cycle || shared.pattern || (shared.pole && a.pole != Arrival::none)) return true;
    if (shared.moves && a.modal != 0) return true;
    for (std::size_t k = 0; k < along_text; ++k) {
      if (k != own_word && shared.text[k] && at_call(call, k) != 0) return true;
    }
    return false;
  }

  // --- subprograms ---------------------------------------------------------------------------------------------------

  using States = std::array<bool, along_text>;
  /// The states that the text of a subprogram, with those that it calls, relies on and that differ between its calls.
  States differing(const Flow& flow, std::size_t r, std::set<std::size_t>& seen) {
    States out{};
    if (!seen.insert(r).second) return out;
    const Flow::Root& root = flow.roots()[r];
    for (std::size_t i = 0; i < flat_.items.size(); ++i) {
      if (!root.reached[i]) continue;
      const Arrival& a = flow.arrivals()[i];
      for (std::size_t k = 0; k < along_text; ++k)
        out[k] = out[k] || (k != own_word && item(i).relies[k] && a.reached && a.text[k] != item(i).before[k]);
      if (item(i).kind != ItemKind::call) continue;
      for (std::size_t other = 1; other < flow.roots().size(); ++other) {
        if (flow.roots()[other].start != flow.label(item(i))) continue;
        const States inner = differing(flow, other, seen);
        for (std::size_t k = 0; k < along_text; ++k) out[k] = out[k] || inner[k];
      }
    }
    return out;
  }
  bool subprograms(const Flow& flow) {
    for (std::size_t r = 1; r < flow.roots().size(); ++r) {
      std::set<std::size_t> seen;
      const States states = differing(flow, r, seen);
      if (std::any_of(states.begin(), states.end(), [](bool b) { return b; }) && copied(flow, r, states)) return true;
    }
    return false;
  }
  bool copied(const Flow& flow, std::size_t r, const States& states) {
    const Flow::Root& root = flow.roots()[r];
    if (root.ends.empty()) return false;
    const auto first = static_cast<std::size_t>(root.start), last = static_cast<std::size_t>(root.ends.back());
    const auto key_of = [&states](const auto& state) {
      Along key{};
      for (std::size_t k = 0; k < along_text; ++k) key[k] = states[k] ? state(k) : std::int16_t{0};
      return key;
    };
    std::map<Along, std::vector<std::size_t>> calls;
    for (std::size_t i = 0; i < flat_.items.size(); ++i) {
      const Arrival& a = flow.arrivals()[i];
      if (item(i).kind != ItemKind::call || flow.label(item(i)) != root.start || !a.reached) continue;
      for (std::size_t k = 0; k < along_text; ++k) {
        const int here = item(i).sets[k] >= 0 ? item(i).sets[k] : a.text[k];
        if (states[k] && here != at_call(item(i), k)) return false;
      }
      calls[key_of([&](std::size_t k) { return at_call(item(i), k); })].push_back(i);
    }
    const Along own = key_of([&](std::size_t k) { return item(first + 1).before[k]; });
    if (calls.size() < 2 || calls.size() > most_copies || calls.count(own) == 0) return false;
    const Span from = item(first).statement.line.span, to = item(last).statement.line.span;
    lowering_.report().start(from);
    lowering_.report().note("HEI-031", {},
                            "the subprogram is called under " + std::to_string(calls.size()) +
                                " states (tilted plane, contours) by which its lines are read: it has a copy for each");
    for (const auto& [key, all] : calls) {
      if (key == own) continue;
      const std::size_t at = flat_.items.size();
      const Item call = item(all.front());
      again_.read(call, from, to);
      name_labels(at);
      for (const std::size_t i : all) item(i).label = item(at).label;
    }
    return true;
  }

  Lowering& lowering_;
  const Again& again_;
  Flat& flat_;
  FreshLabels labels_;
  std::map<std::string, std::string> taken_in_;  ///< programs that are subprograms now, with their labels
};

}  // namespace

void read_again(Lowering& lowering, const Again& again) {
  Reading reading(lowering, again);
  for (int n = 0; n < most_copies && reading.once(); ++n) {
  }
}

}  // namespace cnctrans::frontends::heidenhain
