#include "frontends/heidenhain/program/cycle_feeds.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "ir/analysis/dataflow.h"

namespace cnctrans::frontends::heidenhain {

namespace {

template <class T>
const T* action_of(const ir::Block& b) {
  for (const auto& a : b.actions) {
    if (const auto* found = std::get_if<T>(&a.data)) return found;
  }
  return nullptr;
}

/// The cycle of the block that runs with a feed of its own, which is that of its way out too. Boring that frees the tip
/// goes out in rapid where it names no feed: that feed stays.
const ir::HoleCycle* cycle_with_feed(const ir::Block& b) {
  const auto* define = action_of<ir::CycleDefine>(b);
  const auto* hole = define == nullptr ? nullptr : std::get_if<ir::HoleCycle>(&define->cycle->node);
  if (hole == nullptr || hole->kind == ir::HoleKind::mill || !hole->has_feed || !hole->feed.literal()) return nullptr;
  if (!hole->has_feed_out) return hole;
  return hole->kind != ir::HoleKind::bore_shift && ir::equal(hole->feed, hole->feed_out) ? hole : nullptr;
}

void without_feed(ir::Block& b) {
  for (auto& a : b.actions) {
    auto* define = std::get_if<ir::CycleDefine>(&a.data);
    if (define == nullptr) continue;
    auto hole = std::get<ir::HoleCycle>(define->cycle->node);
    hole.has_feed = hole.has_feed_out = false;
    hole.feed = hole.feed_out = ir::Value{};
    define->cycle = std::make_shared<const ir::Cycle>(ir::Cycle{std::move(hole)});
  }
}

bool has_cycle_with_feed(const ir::Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&found](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      found = found || (b != nullptr && cycle_with_feed(*b) != nullptr);
    });
  }
  return found;
}

bool gives_feed(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  return (b != nullptr && action_of<ir::SetFeed>(*b) != nullptr) || std::holds_alternative<ir::CallRoutine>(s.node);
}
/// No F stands in the file, and it calls no other one.
bool has_no_feed(const ir::Program& program) {
  bool none = true;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* call = std::get_if<ir::CallRoutine>(&s.node);
      none = none && (call != nullptr ? program.find(call->routine) != nullptr : !gives_feed(s));
    });
  }
  return none;
}
bool returns(const ir::Routine& r) {
  return std::any_of(r.body.begin(), r.body.end(), [](const ir::Statement& s) {
    const auto* end = std::get_if<ir::End>(&s.node);
    return end != nullptr && end->returns_from_sub;
  });
}
bool leads_back(const ir::Statement& s) {
  return std::holds_alternative<ir::Repeat>(s.node) || std::holds_alternative<ir::Jump>(s.node);
}

/// Nothing of the block runs at feed.
bool rapid_only(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (b == nullptr || !s.line.labels.empty() || !s.line.number.empty() || s.line.skip_mask != 0) return false;
  if (action_of<ir::CycleDefine>(*b) != nullptr || action_of<ir::ModalSet>(*b) != nullptr) return false;
  return !b->has_motion || b->motion.kind == ir::MotionKind::rapid;
}

}  // namespace

bool feeds_before_cycles(ir::Program& program, const ir::ModalState& power_on, bool alone) {
  if (!has_cycle_with_feed(program)) return false;
  bool left_to_a_caller = false;
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, power_on);
  const bool nowhere = (alone || !returns(program.routines[0])) && has_no_feed(program);
  for (auto& r : program.routines) {
    // No F so far on any way to a block of a program that nobody calls: none has to come back.
    const bool straight = std::none_of(r.body.begin(), r.body.end(), leads_back);
    const bool ends = !returns(r);
    const bool first = r.kind == ir::RoutineKind::main && (ends || alone) &&
                       (straight || std::none_of(r.body.begin(), r.body.end(), gives_feed));
    bool none = nowhere || first;
    ir::Body out;
    bool left = false;  // a cycle has left its own F in force
    double in_force = 0;
    std::optional<double> back;  // the one that it has displaced
    const auto feed = [&](const ir::Statement& like, double v) {
      ir::Statement s;
      s.line.span = like.line.span;
      ir::Block b;
      b.actions.emplace_back().data = ir::SetFeed{ir::Value(v)};
      s.node = std::move(b);
      out.push_back(std::move(s));
    };
    for (auto& s : r.body) {
      none = nowhere || (none && !gives_feed(s));
      auto* b = std::get_if<ir::Block>(&s.node);
      const auto* hole = b == nullptr ? nullptr : cycle_with_feed(*b);
      const auto known = back ? back : table.before(s.id).feed;
      const bool can = hole != nullptr && s.line.skip_mask == 0 && (known || none) &&
                       action_of<ir::SetFeed>(*b) == nullptr &&
                       (!b->has_motion || b->motion.kind == ir::MotionKind::rapid);
      if (can) {
        const double own = hole->feed.number;
        if (left ? in_force != own : known.value_or(own + 1) != own) feed(s, own);
        if (known) back = known;
        left_to_a_caller = left_to_a_caller || (!known && !ends);
        left = true;
        in_force = own;
        without_feed(*b);
      } else if (left && (!rapid_only(s) || gives_feed(s))) {
        const bool own = b != nullptr && action_of<ir::SetFeed>(*b) != nullptr && s.line.number.empty() &&
                         s.line.labels.empty() && s.line.skip_mask == 0;
        const bool needed = back.value_or(in_force) != in_force && !own && !std::holds_alternative<ir::End>(s.node);
        if (needed) feed(s, *back);
        left = false;
        back.reset();
      }
      out.push_back(std::move(s));
    }
    if (left && back.value_or(in_force) != in_force) feed(out.back(), *back);
    r.body = std::move(out);
  }
  return left_to_a_caller;
}

}  // namespace cnctrans::frontends::heidenhain
