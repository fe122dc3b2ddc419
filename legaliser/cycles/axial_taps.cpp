// The tapping form of the axial drilling cycle of a lathe is a tap of its own: a rapid to the place above the hole, the
// neutral tap there, the state of the spindle behind it. As plain moves (thread in, reverse, thread out) the axis would
// stand at the bottom while the spindle turns back, which breaks a thread that follows the spindle rigidly.
#include <algorithm>
#include <cmath>

#include "ir/cycles/machining.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

const NamedCycle* axial_drill(const Action& a) {
  const auto* define = std::get_if<CycleDefine>(&a.data);
  const auto* named = define != nullptr && define->cycle ? std::get_if<NamedCycle>(&define->cycle->node) : nullptr;
  const auto* row = named != nullptr ? cycles::find_machining(named->name) : nullptr;
  return row != nullptr && row->kind == cycles::MachiningKind::drill ? named : nullptr;
}

Value word_value(const NamedCycle& cycle, std::string_view name) {
  for (const auto& [n, v] : cycle.words) {
    if (n == name) return v;
  }
  return Value{};
}

struct AxialTap {
  Value x, approach;
  HoleCycle hole;
};

/// nullopt: it drills, or only the run knows whether it taps.
std::optional<AxialTap> axial_tap(const NamedCycle& cycle) {
  const Value depth = word_value(cycle, "depth"), clearance = word_value(cycle, "clearance"),
              surface = word_value(cycle, "z"), kind = word_value(cycle, "factor");
  if (!word_value(cycle, "peck").is(0) || !kind.literal() || !depth.literal() || !clearance.literal() || depth.is(0))
    return std::nullopt;
  AxialTap tap;
  tap.x = word_value(cycle, "x");
  tap.approach = add(surface, Value{std::copysign(std::fabs(clearance.number), depth.number)});
  HoleCycle& h = tap.hole;
  h.kind = kind.is(0) ? HoleKind::tap_floating : HoleKind::tap;
  h.rigid = !kind.is(0);
  h.axis = axis::z;
  const auto level = [](Value v) {
    Level l;
    l.value = std::move(v);
    l.given = true;
    return l;
  };
  h.surface = level(surface);
  h.reference = h.retract = level(tap.approach);
  h.bottom = level(subtract(surface, depth));
  h.dwell_bottom = word_value(cycle, "dwell");
  h.dwell_scale = 0.01;
  return tap;
}

/// The rapid of the approach, both axes at once.
Motion approach_of(const AxialTap& tap) {
  Motion m;
  m.kind = MotionKind::rapid;
  m.explicit_code = true;
  m.keeps_modal = false;
  for (const auto& [id, v] : {std::pair(axis::x, tap.x), std::pair(axis::z, tap.approach)}) {
    CoordWord w;
    w.axis = id;
    w.mode = WordMode::absolute;
    w.value = v;
    m.coords.push_back(std::move(w));
  }
  return m;
}

}  // namespace

void say_axial_taps(Program& program, const LegaliseContext& context) {
  if (context.options.cycles == CycleWriting::explode) return;  // the strokes are what is asked for
  const auto has = [](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    return b != nullptr &&
           std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) { return axial_drill(a) != nullptr; });
  };
  bool found = false;
  for (const auto& r : program.routines)
    for_each_statement(r.body, [&](const Statement& s) { found = found || has(s); });
  if (!found) return;
  const FactsOf facts(program, context);
  edit_blocks(program, context, [&](Editor& editor, Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    const auto at =
        std::find_if(b.actions.begin(), b.actions.end(), [](const Action& a) { return axial_drill(a) != nullptr; });
    const auto tap = at != b.actions.end() ? axial_tap(*axial_drill(*at)) : std::nullopt;
    const auto spindle = facts.before(s).master;
    // A subprogram that runs behind each move would run behind the way to the hole.
    if (!tap || b.has_motion || !spindle || facts.before(s).modal_call_runs()) return out.push_back(std::move(s));
    CycleDefine define;
    define.modal = false;
    define.cycle = std::make_shared<const Cycle>(Cycle{tap->hole});
    Block behind;
    if (tap->hole.rigid) behind.actions.push_back(action(SpindleRun{*spindle, SpindleState::off}));
    b.actions.erase(at);
    const bool comp_off = setting<CompSide>(facts.before(s), Setting::comp) == CompSide::off;
    for (auto& a : take_after(b)) {
      const auto* set = std::get_if<ModalSet>(&a.data);
      if (comp_off && set != nullptr && set->setting == Setting::comp && a.text.empty()) continue;
      a.order = Order::before;
      behind.actions.push_back(std::move(a));
    }
    b.has_motion = true;
    b.motion = approach_of(*tap);
    const LineInfo like = s.line;
    Body pieces;
    pieces.push_back(std::move(s));
    pieces.push_back(make_block(like, action(std::move(define))));
    if (!behind.empty()) pieces.push_back(made(like, std::move(behind)));
    editor.put_group(out, std::move(pieces), 0);
  });
}

}  // namespace cnctrans::ir::passes
