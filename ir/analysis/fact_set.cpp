#include "ir/analysis/fact_set.h"

#include <algorithm>
#include <cmath>

#include "ir/analysis/settings.h"
#include "ir/cycles/hole.h"
#include "ir/cycles/pattern.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::ir::detail {

bool path_words(const Block& b) {
  if (b.has_motion && b.motion.explicit_code) return true;
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    return std::holds_alternative<SetFeed>(a.data) || std::holds_alternative<SetSpindle>(a.data);
  });
}

bool has_pattern(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    const auto* c = std::get_if<CycleDefine>(&a.data);
    const auto* named = c != nullptr && c->cycle ? std::get_if<NamedCycle>(&c->cycle->node) : nullptr;
    return named != nullptr && !c->modal && c->here && cycles::find_pattern(named->name) != nullptr;
  });
}

bool is_tool_datum(Datum d) {
  return d == Datum::tool_length || d == Datum::tool_radius || d == Datum::tool_wear || d == Datum::tool_nose ||
         d == Datum::tool_nose_width || d == Datum::part_count || d == Datum::cycle_time;
}

std::optional<double> speed_number(const Value& v, const Facts& f) {
  if (v.literal()) return v.number;
  const bool known = f.spindle && passes::setting<SpindleMode>(f, Setting::spindle_mode) == SpindleMode::rpm;
  return constant_value(passes::map_expr(v.expr, [&](const ExprPtr& e) {
    const auto* datum = std::get_if<SystemRef>(&e->node);
    return known && datum != nullptr && datum->datum == Datum::rpm ? number(*f.spindle) : e;
  }));
}

void take_speeds(const HoleCycle& hole, Facts& f, bool runs_now) {
  for (const auto& [given, value] :
       {std::pair(hole.has_speed, &hole.speed), std::pair(hole.has_speed_out, &hole.speed_out)}) {
    if (!given) continue;
    const auto speed = speed_number(*value, f);
    f.spindle = runs_now || f.spindle == speed ? speed : std::nullopt;
  }
}

namespace {

/// One after the other to its end, nothing of it under a switch.
bool goes_straight(const Routine& routine) {
  const Body& body = routine.body;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const auto& node = body[i].node;
    const bool ends = std::holds_alternative<Return>(node) && i + 1 == body.size();
    const bool passes = std::holds_alternative<Block>(node) || std::holds_alternative<Assign>(node) ||
                        std::holds_alternative<Message>(node) || std::holds_alternative<Declare>(node);
    if (body[i].line.skip_mask != 0 || !(ends || passes)) return false;
  }
  return true;
}

}  // namespace

void displace(Facts& behind, const Facts& before, const Routine& routine, const Facts& entry,
              const FrameReach& framed) {
  if (before.cycle_active || !before.cycle_active_known || before.modal_call_runs() || !goes_straight(routine)) return;
  // Carried out from two places that stand in no program.
  constexpr std::array<double, 2> places{70001.25, 90007.75};
  std::array<Facts, 2> ends{entry, entry};
  for (std::size_t t = 0; t < ends.size(); ++t) {
    ends[t].cycle_active = ends[t].cycle_is_hole = false;
    ends[t].cycle_active_known = true;
    ends[t].modal_call = Facts::in_modal_run;
    ends[t].position.fill(places[t]);
    for (const auto& s : routine.body) apply(s, ends[t], framed);
  }
  for (std::size_t i = 0; i < behind.position.size(); ++i) {
    const auto &a = ends[0].position[i], &b = ends[1].position[i];
    constexpr double steps = 1e7;  // in 1 mm: finer is noise of the arithmetic
    if (!a || !b || !before.position[i] || std::fabs((*a - places[0]) - (*b - places[1])) > 1 / steps) continue;
    behind.position[i] = std::round((*before.position[i] + *a - places[0]) * steps) / steps;
  }
}

FactSet given_back(FactSet set, const Facts& before, Facts& f) {
  for (std::size_t i = 0; i < f.position.size(); ++i) {
    if (set[position_bit + i]) f.position[i].reset();
    set[position_bit + i] = false;
  }
  // The kind of feed, of speed or the unit comes back, and another F or S may stand with it.
  const auto changed = [&](Setting x) { return set[static_cast<std::size_t>(x)]; };
  if (changed(Setting::feed_mode) || changed(Setting::units)) f.feed.reset(), set[feed_bit] = false;
  if (changed(Setting::spindle_mode)) f.spindle.reset(), set[spindle_bit] = false;
  for (std::size_t i = 0; i < setting_count; ++i) {
    if (i == static_cast<std::size_t>(Setting::surface)) continue;  // stays as the routine leaves it
    if (set[i]) f.settings[i] = before.settings[i];
    set[i] = false;
  }
  set[motion_bit] = set[work_offset_bit] = false;
  return set;
}

FactSet differing(const Facts& a, const Facts& b) {
  FactSet set;
  for (std::size_t i = 0; i < setting_count; ++i) set[i] = a.settings[i] != b.settings[i];
  for (std::size_t i = 0; i < a.position.size(); ++i) set[position_bit + i] = a.position[i] != b.position[i];
  set[motion_bit] = a.motion != b.motion;
  set[work_offset_bit] = a.work_offset != b.work_offset;
  set[feed_bit] = a.feed != b.feed;
  set[spindle_bit] = a.spindle != b.spindle;
  set[cycle_bit] = a.cycle_active != b.cycle_active || a.cycle_active_known != b.cycle_active_known ||
                   a.cycle_is_hole != b.cycle_is_hole || a.cycle_from != b.cycle_from;
  set[modal_call_bit] = a.modal_call != b.modal_call;
  set[master_bit] = a.master != b.master;
  return set;
}

void take(Facts& facts, const Facts& from, const FactSet& set) {
  for (std::size_t i = 0; i < setting_count; ++i) {
    if (set[i]) facts.settings[i] = from.settings[i];
  }
  for (std::size_t i = 0; i < facts.position.size(); ++i) {
    if (set[position_bit + i]) facts.position[i] = from.position[i];
  }
  if (set[motion_bit]) facts.motion = from.motion;
  if (set[work_offset_bit]) facts.work_offset = from.work_offset;
  if (set[feed_bit]) facts.feed = from.feed;
  if (set[spindle_bit]) facts.spindle = from.spindle;
  if (set[cycle_bit]) {
    facts.cycle_active = from.cycle_active;
    facts.cycle_active_known = from.cycle_active_known;
    facts.cycle_is_hole = from.cycle_is_hole;
    facts.cycle_from = from.cycle_from;
  }
  if (set[modal_call_bit]) facts.modal_call = from.modal_call;
  if (set[master_bit]) facts.master = from.master;
}

Facts facts_at(const ModalState& power_on) {
  Facts f;
  f.reachable = true;
  for (std::size_t i = 0; i < setting_count; ++i) f.settings[i] = power_on.get(static_cast<Setting>(i));
  f.motion = power_on.motion;
  f.work_offset = power_on.work_offset;
  return f;
}

void note_cycles(const Statement& s, CyclesUsed& cycles) {
  const auto note = [&cycles](const CyclePtr& cycle) {
    const auto* hole = cycle ? std::get_if<HoleCycle>(&cycle->node) : nullptr;
    cycles.any = true;
    cycles.other_than_holes |= hole == nullptr || !cycles::ends_over_its_place(*hole);
  };
  if (const auto* m = std::get_if<ModalCall>(&s.node); m != nullptr && m->cycle) note(m->cycle);
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr) return;
  for (const auto& a : b->actions) {
    if (const auto* c = std::get_if<CycleDefine>(&a.data); c != nullptr && c->modal) note(c->cycle);
  }
}

std::array<Facts, 4> probes(const CyclesUsed& cycles) {
  std::array<Facts, 4> all;
  for (unsigned n = 0; n < all.size(); ++n) {
    Facts& f = all[n];
    f.reachable = true;
    f.settings.fill(static_cast<std::uint8_t>(n % 3));
    f.position.fill(7777.125 + n);
    f.motion = n % 2 == 0 ? MotionKind::linear : MotionKind::rapid;
    f.work_offset = -5 - static_cast<std::int32_t>(n);
    f.feed = 7777.125 + n;
    f.spindle = 7777.125 + n;
    f.master = n == 0 ? std::optional<std::uint8_t>(100) : std::nullopt;
    f.cycle_active = cycles.any && n < 3;
    f.cycle_is_hole = f.cycle_active && !cycles.other_than_holes;
    f.cycle_from = f.cycle_active ? Facts::several_cycles - 1 - n : 0;
  }
  return all;
}

FactSet changed_by(const Statement& s, const std::array<Facts, 4>& states, const FrameReach& framed) {
  FactSet set;
  for (const Facts& before : states) {
    Facts after = before;
    apply(s, after, framed);
    set |= differing(before, after);
  }
  return set;
}

namespace {

/// The two axes that a rotation about a named one turns; nullopt: it is no such rotation.
std::optional<std::uint32_t> turned_by(const FrameChange& c) {
  constexpr std::uint32_t space = 1U << axis::x | 1U << axis::y | 1U << axis::z;
  if (c.kind != FrameKind::rotate || !c.has_angle || c.rotation_axis > axis::z) return std::nullopt;
  return space & ~(1U << c.rotation_axis);
}

bool turns_spindle(const CyclePtr& cycle) {
  const auto* hole = cycle ? std::get_if<HoleCycle>(&cycle->node) : nullptr;
  return hole != nullptr && (hole->has_speed || hole->has_speed_out);
}

/// Something may write the offsets while the program runs: the program itself, or a routine that is not at hand.
bool rows_change(const Program& program) {
  bool found = false;
  const auto unknown = [&](const CallRoutine& c) { return c.computed || program.find(c.routine) == nullptr; };
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      if (const auto* c = std::get_if<CallRoutine>(&s.node)) found = found || unknown(*c);
      if (const auto* m = std::get_if<ModalCall>(&s.node)) found = found || (!m->off && !m->cycle && unknown(m->call));
      if (const auto* p = std::get_if<Repeat>(&s.node)) found = found || (p->has_program && !program.find(p->program));
      if (const auto* a = std::get_if<Assign>(&s.node)) {
        for (const auto& item : a->items) found = found || (item.to_system && !is_tool_datum(item.system.datum));
      }
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& action : b->actions) {
        const auto* f = std::get_if<FrameOp>(&action.data);
        found = found || (f != nullptr && (!f->change || f->change->combine == FrameCombine::preset));
      }
    });
  }
  return found;
}

}  // namespace

FrameReach frame_reach(const Program& program, const ModalState& power_on) {
  constexpr std::uint32_t all = ~0U;
  std::uint32_t axes = 0, planes = 0, turned = 0;
  bool turns = false, cycles_turn = false;
  const auto in_plane = [](Plane p) {
    const auto a = plane_axes(p);
    return 1U << a.u | 1U << a.v;
  };
  const auto note = [&](const FrameChange& c) {
    if (c.combine == FrameCombine::preset) return;  // says where the tool is
    if (c.combine == FrameCombine::clear) return;   // takes back what other statements have set
    if (c.kind == FrameKind::rotate && c.rotation_axis == axis::none && c.has_angle) {
      turns = true;
    } else if (const auto across = turned_by(c)) {
      turned |= *across;
    } else if (c.kind == FrameKind::rotate) {
      turned = all;
    } else if (c.kind == FrameKind::scale && c.uniform_scale) {
      axes = all;
    } else {
      for (const auto& w : c.words) axes |= w.axis < axis::count_max ? 1U << w.axis : 0U;
    }
  };
  planes |= in_plane(power_on.plane);
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      if (const auto* assign = std::get_if<Assign>(&s.node)) {
        for (const auto& item : assign->items) {
          if (item.to_system && item.value && item.value->type == Type::frame) turned = all;
        }
      }
      if (const auto* m = std::get_if<ModalCall>(&s.node)) cycles_turn = cycles_turn || turns_spindle(m->cycle);
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        if (const auto* c = std::get_if<CycleDefine>(&a.data))
          cycles_turn = cycles_turn || (c->modal && turns_spindle(c->cycle));
        if (const auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change) note(*f->change);
        if (const auto* m = std::get_if<ModalSet>(&a.data); m != nullptr && m->setting == Setting::plane)
          planes |= in_plane(static_cast<Plane>(m->value));
      }
    });
  }
  if (turns) turned |= planes;
  return {axes | turned, power_on.work_offset != 0, rows_change(program), turned, cycles_turn};
}

}  // namespace cnctrans::ir::detail

namespace cnctrans::ir {

const Facts& FactTable::before(std::uint32_t id) const {
  static const Facts nothing = [] {
    Facts f;
    f.forget();
    return f;
  }();
  return id < facts.size() && facts[id].reachable ? facts[id] : nothing;
}

}  // namespace cnctrans::ir
