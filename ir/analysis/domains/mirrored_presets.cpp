#include "ir/analysis/domains/mirrored_presets.h"

#include <cstdint>
#include <memory>
#include <utility>

#include "ir/analysis/flow_states.h"
#include "ir/axis.h"
#include "ir/axis_mask.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::ir::passes {

namespace {

bool is_mirror(const FrameChange& c) {
  return c.slot == FrameSlot::mirror && c.kind == FrameKind::mirror;
}

bool is_preset(const FrameChange& c) {
  return c.slot == FrameSlot::preset && c.combine == FrameCombine::preset;
}

template <class Found>
bool has_change(const Body& body, const Found& found) {
  bool yes = false;
  for_each_statement(body, [&](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    for (const auto& a : b->actions) {
      const auto* f = std::get_if<FrameOp>(&a.data);
      yes = yes || (f != nullptr && f->change && found(*f->change));
    }
  });
  return yes;
}

/// The axes that may be mirrored, and those that may not be.
struct Mirrored {
  AxisMask on = 0, off = ~AxisMask{0};
};

void mirror(const FrameChange& c, Mirrored& state) {
  if (c.combine == FrameCombine::clear || c.combine == FrameCombine::replace) state = {};
  for (const auto& w : c.words) {
    const bool on = !w.value.is(0);
    const bool sure = w.value.literal();
    if (on || !sure) state.on |= axis_bit(w.axis);
    if (on && sure) state.off &= ~axis_bit(w.axis);
    if (!on) {
      state.on &= ~axis_bit(w.axis);
      state.off |= axis_bit(w.axis);
    }
  }
}

Value opposite(const Value& v) {
  const auto* u = v.expr ? std::get_if<Unary>(&v.expr->node) : nullptr;
  return u != nullptr && u->op == UnaryOp::negate ? Value(u->operand) : negate(v);
}

struct Domain {
  using State = Mirrored;
  static State start(const Routine& /*r*/, bool /*called*/) { return {}; }
  static bool touches(const Routine& r) { return has_change(r.body, is_mirror); }
  static void unknown(State& /*s*/) {}
  static void transfer(const Statement& s, State& state) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    for (const auto& a : b->actions) {
      const auto* f = std::get_if<FrameOp>(&a.data);
      if (f != nullptr && f->change && is_mirror(*f->change)) mirror(*f->change, state);
    }
  }
  static bool join(State& a, const State& b) {
    const Mirrored both{a.on | b.on, a.off | b.off};
    const bool changed = both.on != a.on || both.off != a.off;
    a = both;
    return changed;
  }
};

}  // namespace

bool presets_past_mirrors(Program& program, const TellPreset& unsure, const TellPreset& done) {
  bool mirrors = false, presets = false;
  for (const auto& r : program.routines) {
    mirrors = mirrors || has_change(r.body, is_mirror);
    presets = presets || has_change(r.body, is_preset);
  }
  if (!mirrors || !presets) return false;
  number_statements(program);
  const Domain domain;
  const FlowStates<Domain> states(program, domain);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      const Mirrored* before = b != nullptr ? states.before(s) : nullptr;
      if (before == nullptr) return;
      Mirrored now = *before;
      for (auto& a : b->actions) {
        auto* f = std::get_if<FrameOp>(&a.data);
        if (f == nullptr || !f->change) continue;
        if (is_mirror(*f->change)) mirror(*f->change, now);
        if (!is_preset(*f->change)) continue;
        FrameChange changed = *f->change;
        bool any = false;
        for (auto& w : changed.words) {
          if ((now.on & axis_bit(w.axis)) == 0) continue;
          if ((now.off & axis_bit(w.axis)) != 0) return unsure(s);
          w.value = opposite(w.value);
          any = true;
        }
        if (!any) continue;
        f->change = std::make_shared<const FrameChange>(std::move(changed));
        done(s);
      }
    });
  }
  return true;
}

}  // namespace cnctrans::ir::passes
