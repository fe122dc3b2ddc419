#include "frontends/heidenhain/program/plunge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "frontends/heidenhain/ways/flow.h"
#include "frontends/heidenhain/ways/way.h"
#include "ir/known_number.h"

namespace cnctrans::frontends::heidenhain {

namespace {

bool is_feed_word(const ir::Action& a) {
  return std::holds_alternative<ir::SetFeed>(a.data);
}
using Coordinate = std::optional<Term>;
/// Of the way that the block makes along an axis; nullopt: it is not known by numbers.
std::optional<double> along(const ir::Motion& m, ir::AxisId axis, const Coordinate& from, const Coordinate& to) {
  for (const auto& c : m.coords) {
    if (c.axis != axis) continue;
    if (c.mode == ir::WordMode::incremental) return c.value.literal() ? std::optional(c.value.number) : std::nullopt;
    if (!from || !to || !from->literal() || !to->literal()) return std::nullopt;
    return to->number() - from->number();
  }
  return m.extra == nullptr ? std::optional(0.0) : std::nullopt;
}

class PlungeLimit {
 public:
  explicit PlungeLimit(Lowering& lowering) : lowering_(lowering), flat_(lowering.flat()), way_(flat_) {}

  void run() {
    const Flow flow(flat_);
    std::vector<Item> items = std::move(flat_.items);
    way_.read_ahead_in(items);
    flat_.items.clear();
    for (std::size_t i = 0; i < items.size(); ++i) {
      Item& item = items[i];
      const int share = item.plunge >= 0 ? item.plunge : flow.arrivals()[i].plunge;
      way_.comes_to(item);
      const auto plane = way_.plane();
      const Place from{way_.coordinate(plane.u), way_.coordinate(plane.v), way_.coordinate(plane.w)};
      way_.step(item);
      const auto* b = std::get_if<ir::Block>(&item.statement.node);
      const bool moves = b != nullptr && b->has_motion && b->motion.kind != ir::MotionKind::rapid;
      const bool limited = share == Arrival::several || (share >= 0 && flat_.plunges[static_cast<std::size_t>(share)]);
      if (limited && moves) limit(item, plane, from, share);
      flat_.items.push_back(std::move(item));
    }
  }

 private:
  using Place = std::array<Coordinate, 3>;
  void limit(Item& item, const ir::PlaneAxes& plane, const Place& from, int share) {
    auto& block = std::get<ir::Block>(item.statement.node);
    const auto& m = block.motion;
    const bool goes = std::any_of(m.coords.begin(), m.coords.end(), [&](const auto& c) { return c.axis == plane.w; });
    if (!goes) return;
    const auto way = [&](ir::AxisId axis, std::size_t k) { return along(m, axis, from[k], way_.coordinate(axis)); };
    const auto u = way(plane.u, 0), v = way(plane.v, 1), down = way(plane.w, 2);
    if (down && *down >= 0) return;
    const auto f = way_.feed();
    const auto percent = share < 0 ? std::nullopt : ir::known_number(*flat_.plunges[static_cast<std::size_t>(share)]);
    if (!down || !u || !v || !f || !percent || m.kind != ir::MotionKind::linear) {
      lowering_.report().start(item.statement.line.span);
      lowering_.report().warn("HEI-009", {},
                              "M103: how steeply this block goes into the material, or its F, is not known by numbers: "
                              "the whole F counts");
      return;
    }
    const double own = *f * *percent / 100 * std::hypot(*u, *v, *down) / -*down;
    if (own >= *f) return;
    if (std::any_of(block.actions.begin(), block.actions.end(), is_feed_word)) {  // F counts behind the block, too
      Item first;
      first.statement.line = std::move(item.statement.line);
      item.statement.line = {};
      item.statement.line.span = first.statement.line.span;
      item.statement.line.skip_mask = first.statement.line.skip_mask;
      ir::Block words;
      const auto is_other = [](const ir::Action& a) { return !is_feed_word(a); };
      std::copy_if(block.actions.begin(), block.actions.end(), std::back_inserter(words.actions), is_feed_word);
      block.actions.erase(std::stable_partition(block.actions.begin(), block.actions.end(), is_other),
                          block.actions.end());
      first.statement.node = std::move(words);
      flat_.items.push_back(std::move(first));
    }
    ir::SetFeed slow{Term(own).value()};
    slow.block_only = true;
    block.actions.emplace_back().data = std::move(slow);
  }

  Lowering& lowering_;
  Flat& flat_;
  Way way_;
};

}  // namespace

void limit_plunges(Lowering& lowering) {
  if (!lowering.flat().plunges.empty()) PlungeLimit(lowering).run();
}

}  // namespace cnctrans::frontends::heidenhain
