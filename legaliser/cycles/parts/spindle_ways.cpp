#include "legaliser/cycles/parts/spindle_ways.h"

#include <algorithm>

namespace cnctrans::ir::passes {

namespace {

bool leaves_the_spindle(const CyclePtr& cycle) {
  const auto* hole = cycle ? std::get_if<HoleCycle>(&cycle->node) : nullptr;
  return hole != nullptr && hole->kind != HoleKind::tap && hole->kind != HoleKind::tap_floating &&
         hole->spindle_before == SpindleStep::usual && hole->spindle_after == SpindleStep::usual;
}

void carry_out(const Action& a, SpindleDomain::State& state) {
  if (std::holds_alternative<MasterSpindle>(a.data)) state = SpindleDomain::unknown_way;
  if (const auto* o = std::get_if<SpindleOrient>(&a.data); o != nullptr && o->number == 1) state = SpindleDomain::off;
  if (const auto* d = std::get_if<CycleDefine>(&a.data); d != nullptr && !leaves_the_spindle(d->cycle))
    state |= SpindleDomain::unknown_way;
  const auto* run = std::get_if<SpindleRun>(&a.data);
  if (run == nullptr || run->number != 1) return;
  state = run->state == SpindleState::off  ? SpindleDomain::off
          : run->state == SpindleState::cw ? SpindleDomain::cw
                                           : SpindleDomain::ccw;
}

}  // namespace

void SpindleDomain::transfer(const Statement& s, State& state) {
  if (const auto* m = std::get_if<ModalCall>(&s.node); m != nullptr && m->cycle && !leaves_the_spindle(m->cycle))
    state |= unknown_way;
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr) return;
  for (const auto& a : b->actions) carry_out(a, state);
}

bool SpindleDomain::touches(const Routine& r) {
  bool found = false;
  for_each_statement(r.body, [&found](const Statement& s) {
    for (const State before : {off, cw}) {
      State state = before;
      transfer(s, state);
      found = found || state != before;
    }
  });
  return found;
}

SpindleDomain::State SpindleWays::where_it_moves(const Statement& s) const {
  const auto* before = states_.before(s);
  if (before == nullptr) return SpindleDomain::unknown_way;
  SpindleDomain::State state = *before;
  if (const auto* b = std::get_if<Block>(&s.node)) {
    for (const auto& a : b->actions) {
      if (a.order != Order::after && !std::holds_alternative<CycleDefine>(a.data)) carry_out(a, state);
    }
  }
  return state;
}

bool SpindleWays::stands(const Statement& s) const {
  return where_it_moves(s) == SpindleDomain::off;
}

bool SpindleWays::turns_on_some_way(const Statement& s) const {
  const SpindleDomain::State state = where_it_moves(s);
  const bool turns = (state & (SpindleDomain::cw | SpindleDomain::ccw)) != 0;
  return (state & SpindleDomain::unknown_way) == 0 && (state & SpindleDomain::off) != 0 && turns;
}

}  // namespace cnctrans::ir::passes
