// Turning cycles: G33, G64 and G65 (reference 12.1, 12.3, 12.4); G63 and G66: assumed_cycles.cpp.
#include <cmath>
#include <utility>

#include "frontends/num/state/actions.h"
#include "frontends/num/state/lower.h"
#include "ir/cycles/blank_points.h"

namespace cnctrans::frontends::num {

using slot::e;
using slot::letter;

namespace {

ir::NamedCycle& named(ir::Cycle& cycle) {
  return std::get<ir::NamedCycle>(cycle.node);
}

}  // namespace

/// The word of the axis, taken out of the block's coordinates; nullopt: it has none, or was refused.
std::optional<ir::Value> Lowering::take_absolute(ir::AxisId axis) {
  auto& coords = out_->motion.coords;
  for (auto it = coords.begin(); it != coords.end(); ++it) {
    if (it->axis != axis) continue;
    if (distance_at(it->pos.column) == ir::Distance::incremental) {
      report_.refuse("NUM-026", it->pos, "what the words of a turning cycle count from under G91 is not described",
                     "write G90 before it", "cycle.turning");
    }
    ir::Value v = std::move(it->value);
    coords.erase(it);
    return v;
  }
  return std::nullopt;
}

void Lowering::put_machining(const Word& g, std::shared_ptr<ir::Cycle> cycle) {
  ir::CycleDefine define;
  define.modal = false;
  define.cycle = std::move(cycle);
  act(g, Step::special, std::move(define));
}

void Lowering::turning_cycle(const Word& g) {
  if (marks_.motion || marks_.thread != nullptr || marks_.cycle != nullptr)
    return report_.refuse("NUM-011", g.pos, "a turning cycle beside another motion function");
  if (g.number == 33) return chased_thread(g);
  if (g.number == 63) return reentrant_stock(g);
  if (g.number == 66) return plunged_groove(g);
  stock_removal(g, g.number == 65);
}

/// Non-modal: from the place of the tool to the root of the thread at its end.
void Lowering::chased_thread(const Word& g) {
  auto cycle = std::make_shared<ir::Cycle>();
  cycle->node = ir::NamedCycle{"thread.chased", {}};
  auto& words = named(*cycle).words;
  if (auto x = take_absolute(ir::axis::x)) words.emplace_back("x_end", *std::move(x));
  const std::size_t before = words.size();
  if (auto z = take_absolute(ir::axis::z)) words.emplace_back("z_end", *std::move(z));
  const bool has_end = words.size() != before;
  const auto add = [&](int s, const char* name) {
    const Word* w = use(s);
    if (w != nullptr) words.emplace_back(name, value(*w));
    return w != nullptr;
  };
  const bool pitch = add(letter('K'), "pitch");
  add(e('A'), "cone");
  add(e('B'), "infeed_angle");
  add(letter('R'), "exit");
  const bool depth = add(letter('P'), "depth");
  add(letter('Q'), "finish_stock");
  add(letter('F'), "starts");
  add(letter('S'), "passes");
  if (!pitch || !depth || !has_end)
    return report_.refuse("NUM-004", g.pos, "G33 needs its end Z, the pitch K and the depth P", {}, "cycle.turning");
  put_machining(g, std::move(cycle));
}

/// The block numbers of the finished profile.
bool Lowering::profile_labels(const Word& g, ir::NamedCycle& cycle) {
  const auto refuse = [&](std::string_view why) {
    report_.refuse("NUM-004", g.pos, std::string(text_of(g)) + std::string(why), {}, "cycle.turning");
    return false;
  };
  if (flow_->label_count != 2) return refuse(" needs the two block numbers of the finished profile");
  const Word *first = flow_->labels[0], *last = flow_->labels[1];
  flow_->label_count = 0;
  if (first->is_expression || last->is_expression) return refuse(": the block numbers are fixed numbers");
  const bool back = first->number > last->number;
  if (back) std::swap(first, last);
  cycle.words.emplace_back("first_label", ir::Value(first->number));
  cycle.words.emplace_back("last_label", ir::Value(last->number));
  if (back) cycle.words.emplace_back("reversed", ir::Value(1));
  return true;
}

/// G64: until G80 the blocks are points of the blank. G65: one groove, down from the place of the tool.
void Lowering::stock_removal(const Word& g, bool groove) {
  const std::string code = groove ? "G65" : "G64";
  const auto refuse = [&](std::string_view why) {
    report_.refuse("NUM-004", g.pos, code + std::string(why), {}, "cycle.turning");
  };
  auto cycle = std::make_shared<ir::Cycle>();
  cycle->node = ir::NamedCycle{groove ? "stock.groove" : "stock.blank", {}};
  auto& words = named(*cycle).words;
  if (!profile_labels(g, named(*cycle))) return;
  const Word *p = use(letter('P')), *r = use(letter('R'));
  if ((p != nullptr) == (r != nullptr)) return refuse(" needs one depth of cut: P or R");
  const auto stock = [&] {
    if (const Word* i = use(letter('I'))) words.emplace_back("stock_x", value(*i));
    if (const Word* k = use(letter('K'))) words.emplace_back("stock_z", value(*k));
  };
  if (!groove) stock();
  if (groove) {
    const Word* angle = use(e('A'));
    if (angle == nullptr) return refuse(" needs EA, the angle of the line along which the tool enters");
    words.emplace_back("entry_angle", value(*angle));
    auto limit = take_absolute(p != nullptr ? ir::axis::z : ir::axis::x);
    if (report_.refused()) return;
    if (!limit) return refuse(" needs the end of the groove: Z with P, X with R");
    words.emplace_back(p != nullptr ? "limit_z" : "limit_x", *std::move(limit));
  }
  words.emplace_back(p != nullptr ? "step" : "axial_step", value(p != nullptr ? *p : *r));
  if (groove) stock();
  if (!out_->motion.coords.empty()) {
    return refuse(groove ? " has one limit: Z with P, X with R" : ": the blank stands in the blocks behind it");
  }
  if (!groove) {
    state_.turning_profile = true;
    state_.stock = cycle;
    state_.blank_points = 0;
    state_.blank_x.reset();
    state_.blank_z.reset();
  }
  put_machining(g, std::move(cycle));
}

bool Lowering::blank_point(const ir::Block& block) {
  const auto refuse = [this](std::string_view why) {
    report_.refuse("NUM-004", {}, std::string(why), {}, "cycle.turning");
    return false;
  };
  if (!state_.stock) return refuse("a point of a blank without its G64");
  if (marks_.distance_count == 0) uses(Modal::distance);
  bool plain = block.actions.empty() && block.motion.centers.empty() && !block.motion.extra &&
               block.motion.frame == ir::FrameUse::normal && !block.motion.coords.empty();
  for (const auto& c : block.motion.coords) {
    if (c.axis == ir::axis::x)
      state_.blank_x = c.value;
    else if (c.axis == ir::axis::z)
      state_.blank_z = c.value;
    else
      plain = false;
  }
  if (!plain || state_.distance == ir::Distance::incremental || !state_.blank_x || !state_.blank_z)
    return refuse("a block of the blank of G64 is more or less than a point in X and Z");
  if (++state_.blank_points > ir::cycles::most_blank_points) return refuse("the blank of G64 has too many points");
  auto& words = named(*state_.stock).words;
  words.emplace_back(ir::cycles::blank_name('x', state_.blank_points), *state_.blank_x);
  words.emplace_back(ir::cycles::blank_name('z', state_.blank_points), *state_.blank_z);
  return true;
}

}  // namespace cnctrans::frontends::num
