#include "frontends/heidenhain/program/cycle_calls.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/text.h"
#include "dialects/heidenhain/variables.h"
#include "frontends/heidenhain/cycles/builder.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;

namespace {

/// What the control does besides in the block; on other controls it is a block of its own.
ir::Statement behind(const ir::Statement& to, ir::StatementNode node) {
  ir::Statement s;
  s.line.span = to.line.span;
  s.line.skip_mask = to.line.skip_mask;
  s.node = std::move(node);
  return s;
}

ir::CoordWord coordinate(ir::AxisId axis, ir::Value v) {
  ir::CoordWord c;
  c.axis = axis;
  c.mode = ir::WordMode::absolute;
  c.value = std::move(v);
  return c;
}
ir::Block move(ir::MotionKind kind, std::vector<ir::CoordWord> words) {
  ir::Block b;
  b.has_motion = true;
  b.motion.kind = kind;
  b.motion.explicit_code = true;
  b.motion.coords = std::move(words);
  return b;
}
ir::PlaneAxes plane_at(const Arrival& a) {
  return ir::plane_axes(a.plane == Arrival::several ? ir::Plane::xy : static_cast<ir::Plane>(a.plane));
}
ir::Opaque not_carried(std::string text, std::string_view feature, bool harmless = false) {
  ir::Opaque o;
  o.text = std::move(text);
  o.feature = feature;
  o.harmless = harmless;
  return o;
}

}  // namespace

void CycleCalls::prepare() {
  link_globals();
  find_stored();
}

bool CycleCalls::differs(std::int16_t q) const {
  const QValue* first = nullptr;
  for (const auto& c : flat_.cycles) {
    const auto it = c.values.find(q);
    if (c.row == nullptr || !c.row->called || it == c.values.end()) continue;
    if (first != nullptr && !ir::equal(first->value, it->second.value)) return true;
    first = &it->second;
  }
  return false;
}
/// PREDEF is the value of GLOBAL DEF, where the file has one only.
void CycleCalls::link_globals() {
  for (auto& c : flat_.cycles) {
    for (auto& [q, v] : c.values) {
      const auto it = lowering_.globals().find(q);
      if (v.kind != QValue::Kind::linked || it == lowering_.globals().end()) continue;
      const auto& all = it->second;
      if (!std::all_of(all.begin(), all.end(), [&all](const auto& one) { return ir::equal(one, all.front()); }))
        continue;
      v.kind = QValue::Kind::value;
      v.value = all.front();
    }
  }
}
/// Parameters whose Q the program itself uses, or that are computed: the definition sets them.
void CycleCalls::find_stored() {
  for (std::size_t i = 0; i < flat_.items.size(); ++i) {
    several_ = several_ || (flat_.items[i].call != CycleCall::none && arrival(i).cycle == Arrival::several);
  }
  for (const auto& c : flat_.cycles) {
    for (const auto& [q, v] : c.values) {
      const bool used = lowering_.own_reads().count(q) != 0 || lowering_.own_writes().count(q) != 0;
      if (used || !v.value.literal() || (several_ && differs(q))) stored_.insert(q);
    }
  }
}
void CycleCalls::definition(const Item& item, Statements& out) const {
  const CycleDefinition& cycle = flat_.cycles[static_cast<std::size_t>(item.index)];
  if (cycle.refused) return out.push_back(item.statement);
  ir::Assign assign;
  for (const auto& [q, v] : cycle.values) {
    if (stored_.count(q) == 0) continue;
    ir::Assign::Item one;
    one.target.space = facts::space_q;
    one.target.index = ir::number(q);
    one.value = ir::as_expr(v.value);
    assign.items.push_back(std::move(one));
  }
  if (assign.items.empty()) return;
  ir::Statement s = item.statement;
  s.node = std::move(assign);
  out.push_back(std::move(s));
}
ir::Value CycleCalls::parameter(const CycleDefinition& cycle, std::int16_t q, const Arrival& a) const {
  const auto it = cycle.values.find(q);
  if (it == cycle.values.end()) return ir::Value(0);
  const bool any = a.cycle == Arrival::several;
  const bool written = (a.rewritten || a.outside || any) && lowering_.own_writes().count(q) != 0;
  const bool variable = written || !it->second.value.literal() || (any && differs(q));
  return variable ? ir::Value(ir::numbered(facts::space_q, q)) : it->second.value;
}
/// The definition in force; null and a fault: which one that is can't be told.
const CycleDefinition* CycleCalls::in_force(const Item& item, const Arrival& a) {
  Report& report = lowering_.report();
  report.start(item.statement.line.span);
  if (!a.reached) return nullptr;
  if (a.cycle == Arrival::none) {
    report.refuse("HEI-017", {},
                  "a cycle is called, and no CYCL DEF stands before it in this file or in one at hand that calls it",
                  "define it in this file, or give the program that calls this one");
    return nullptr;
  }
  if (a.outside && !std::exchange(outside_told_, true)) {
    report.warn("HEI-017", {},
                "a program of another file runs between the definition of the cycle and its call: it is taken to "
                "define no other one (said once a file)");
  }
  const auto said = [&report](const CycleDefinition& c) -> const CycleDefinition* {
    if (!c.refused) return &c;
    report.lose("cycle.hole");
    return nullptr;
  };
  if (a.cycle != Arrival::several) return said(flat_.cycles[static_cast<std::size_t>(a.cycle)]);
  const CycleDefinition* first = nullptr;
  for (const auto& c : flat_.cycles) {
    if (c.refused) return said(c);
    if (c.row != nullptr ? !c.row->called : c.old != nullptr && !c.old->called) continue;
    if ((first != nullptr && (first->number != c.number || c.row == nullptr)) || c.row == nullptr) {
      report.refuse("HEI-017", {}, "which cycle is called here depends on the way to this block",
                    "define the cycle right before its call");
      return nullptr;
    }
    first = &c;
  }
  return first;
}
/// Nothing: it was refused, or does nothing (depth 0).
CycleCalls::Machining CycleCalls::machining(const Item& item, const Arrival& a, const std::optional<ir::Value>& shift,
                                            const CycleDefinition* overlay) {
  Machining out;
  const CycleDefinition* cycle = in_force(item, a);
  if (cycle == nullptr) return out;
  Report& report = lowering_.report();
  if (cycle->old != nullptr && cycle->old->kind == facts::OldKind::program) {
    const auto part = cycle->parts.find(1);
    std::string_view text = part == cycle->parts.end() ? std::string_view{} : std::string_view(part->second.text);
    constexpr std::string_view word = "PGM";
    if (iequals_ascii(text.substr(0, word.size()), word)) text.remove_prefix(word.size());
    out.program = program_name(text);
    if (overlay != nullptr || (shift && !shift->is(0)) || out.program.empty()) {
      out.program.clear();
      report.keep("HEI-018", {}, "cycle 12 (a program as a cycle) is not carried here", "cycle.pattern");
    }
    return out;
  }
  if (overlay == nullptr && a.overlay == Arrival::several && differs_from_patterns(*cycle)) {
    report.refuse("HEI-017", {},
                  "whether cycle 220 or 221 has left other parameters (Q200, Q203, Q204) for this cycle depends on the "
                  "way to this block",
                  "define the cycle again behind the pattern");
    return out;
  }
  // What both have, the later one has set.
  const CycleDefinition* over = overlay;
  if (over == nullptr && a.overlay >= 0) over = &flat_.cycles[static_cast<std::size_t>(a.overlay)];
  CycleContext context;
  context.shift = shift;
  context.inch = lowering_.inch();
  context.height = item.height;
  context.moves = &out.moves;
  constexpr double inch = 25.4;
  context.tool_radii = &lowering_.tool_radii();
  if (item.tool_radius) context.tool_radius = *item.tool_radius * (lowering_.inch() ? inch : 1);
  context.speed_after = &out.speed_after;
  context.value = [&](std::int16_t q) {
    const bool shared = over != nullptr && over->values.count(q) != 0 && lowering_.own_writes().count(q) == 0;
    if (!shared) return parameter(*cycle, q, a);
    const bool low = overlay != nullptr && q == 204 && over->values.at(301).value.is(0);
    return low ? ir::Value(0) : over->values.at(q).value;  // from point to point on the clearance
  };
  out.cycle = build_cycle(*cycle, context, report);
  for (context.area = 1; out.cycle != nullptr && context.area < cycle->areas.size(); ++context.area)
    out.more.push_back(build_cycle(*cycle, context, report));
  out.goes_back = cycle->row != nullptr && cycle->row->contours == facts::Contours::areas;
  return out;
}

bool CycleCalls::differs_from_patterns(const CycleDefinition& cycle) const {
  for (const auto& c : flat_.cycles) {
    if (c.row == nullptr || c.row->kind != facts::CycleKind::pattern) continue;
    for (const auto& [q, v] : c.values) {
      const auto mine = cycle.values.find(q);
      if (mine != cycle.values.end() && !ir::equal(mine->second.value, v.value)) return true;
    }
  }
  return false;
}
/// One step of a cycle that is told by what it does.
ir::Block CycleCalls::step_block(const CycleMove& step, const ir::PlaneAxes& plane) const {
  using Kind = CycleMove::Kind;
  ir::Block b;
  if (step.kind == Kind::spindle) {
    using ir::SpindleState;
    b.actions.emplace_back().data = ir::SetSpindle{1, ir::Value(step.amount)};
    b.actions.emplace_back().data = ir::SpindleRun{1, step.code == 3   ? SpindleState::cw
                                                      : step.code == 4 ? SpindleState::ccw
                                                                       : SpindleState::off};
    return b;
  }
  if (step.kind == Kind::spindle_stop) {
    b.actions.emplace_back().data = ir::SpindleRun{1, ir::SpindleState::off};
    return b;
  }
  if (step.kind == Kind::thread) {
    b = move(ir::MotionKind::tap_rigid, {coordinate(plane.w, *step.w)});
    b.motion.coords.back().mode = ir::WordMode::incremental;
    auto extra = std::make_shared<ir::MotionExtra>();
    extra->has_lead = true;
    extra->lead = step.lead;
    extra->lead_axis = plane.w;
    b.motion.extra = std::move(extra);
    return b;
  }
  if (step.kind == Kind::function) {
    b.actions.push_back(lowering_.function_action(step.amount));
    return b;
  }
  if (step.kind == Kind::dwell) {
    ir::Dwell dwell;
    dwell.value = ir::Value(step.amount);
    b.actions.emplace_back().data = std::move(dwell);
    return b;
  }
  if (step.kind == Kind::cycle) {
    ir::CycleDefine define;
    define.cycle = step.cycle;
    define.modal = false;
    b.actions.emplace_back().data = std::move(define);
    return b;
  }
  const bool arc = step.kind == Kind::arc_cw || step.kind == Kind::arc_ccw, rapid = step.kind == Kind::rapid;
  b = move(rapid                       ? ir::MotionKind::rapid
           : step.kind == Kind::arc_cw ? ir::MotionKind::arc_cw
           : arc                       ? ir::MotionKind::arc_ccw
                                       : ir::MotionKind::linear,
           {});
  auto& words = b.motion.coords;
  if (step.plane) {
    for (const bool first : {true, false}) {
      const ir::Value& v = first ? step.plane->u : step.plane->v;
      if (!step.plane->absolute && v.is(0) && !arc) continue;
      const auto& other = first ? step.plane->u_axis : step.plane->v_axis;
      words.push_back(coordinate(other.value_or(first ? plane.u : plane.v), v));
      if (!step.plane->absolute) words.back().mode = ir::WordMode::incremental;
    }
    for (const bool first : {true, false}) {
      if (!arc) break;
      ir::CenterWord c;
      c.axis = first ? plane.u : plane.v;
      c.mode = ir::CenterMode::from_start;
      c.value = first ? step.plane->cu : step.plane->cv;
      b.motion.centers.push_back(std::move(c));
    }
  }
  if (step.w) words.push_back(coordinate(plane.w, *step.w));
  ir::SetFeed feed{ir::Value(step.amount)};
  feed.block_only = true;
  if (!rapid) b.actions.emplace_back().data = std::move(feed);
  return b;
}

/// Where the tool stands, behind the last statement.
void CycleCalls::put(const Machining& m, const ir::PlaneAxes& plane, Statements& out) const {
  const ir::Statement first = out.back();
  if (!m.program.empty()) {
    ir::CallRoutine routine;
    routine.routine.text = m.program;
    routine.level = ir::CallLevel::new_level;
    out.push_back(behind(first, std::move(routine)));
  }
  std::vector<ir::CyclePtr> cycles = m.more;
  if (m.cycle != nullptr) cycles.insert(cycles.begin(), m.cycle);
  for (const auto& cycle : cycles) {
    ir::CycleDefine define;
    define.cycle = cycle;
    define.modal = false;
    ir::Block run;
    run.actions.emplace_back().data = std::move(define);
    out.push_back(behind(first, std::move(run)));
  }
  if (m.speed_after) {
    ir::Block speed;
    speed.actions.emplace_back().data = ir::SetSpindle{1, *m.speed_after};
    out.push_back(behind(first, std::move(speed)));
  }
  for (const CycleMove& step : m.moves) out.push_back(behind(first, step_block(step, plane)));
}

/// CYCL CALL POS: a tool below the surface goes up to the clearance first, then in the plane.
void CycleCalls::above_first(const Item& item, const Machining& m, const ir::PlaneAxes& plane, Statements& out) {
  const auto* hole = m.cycle == nullptr ? nullptr : std::get_if<ir::HoleCycle>(&m.cycle->node);
  const auto number = [](const ir::Level& l) { return l.given && l.value.literal(); };
  const bool known = hole != nullptr && number(hole->surface) && hole->surface.base == ir::LevelBase::absolute &&
                     number(hole->reference) && hole->reference.base == ir::LevelBase::from_surface && item.height &&
                     item.height->literal();
  if (!known) {
    lowering_.report().warn("HEI-019", {},
                            "the tool is taken to stand above the surface: it goes in the plane first, then along its "
                            "axis",
                            "from below the control goes up first; go along the tool axis to a number before the call");
    return;
  }
  const double surface = hole->surface.value.number;
  if (item.height->number >= surface) return;
  ir::Statement up = behind(out.back(), move(ir::MotionKind::rapid,
                                             {coordinate(plane.w, ir::Value(surface + hole->reference.value.number))}));
  std::swap(up.line, out.back().line);
  out.insert(out.end() - 1, std::move(up));
}

void CycleCalls::call(std::size_t i, Statements& out) {
  Item& item = flat_.items[i];
  const Machining m = machining(item, arrival(i), item.shift, nullptr);
  auto* block = std::get_if<ir::Block>(&item.statement.node);
  const bool alone = block != nullptr && block->empty();
  const bool refused = !m.any() && lowering_.report().refused();
  const std::string_view feature = lowering_.report().feature();
  out.push_back(std::move(item.statement));
  if (refused) {
    out.push_back(behind(out.back(), not_carried("CYCL CALL", feature)));
    return;
  }
  if (!m.any()) return;  // depth 0, or never reached
  const auto plane = plane_at(arrival(i));
  if (item.shift) above_first(item, m, plane, out);
  const std::size_t at = out.size();
  put(m, plane, out);
  if (m.goes_back && item.place) {
    ir::Statement back = behind(out.back(), move(ir::MotionKind::rapid, {coordinate(plane.u, item.place->first),
                                                                         coordinate(plane.v, item.place->second)}));
    out.push_back(std::move(back));
  } else if (m.goes_back) {
    lowering_.report().warn("HEI-019", {}, "the tool stays where the pocket ends: where it stood before is not known");
  }
  if (alone) take_place(out, at);
}

/// The statement before the one `at` says nothing: its line is that one's.
void CycleCalls::take_place(Statements& out, std::size_t at) {
  if (out.size() == at) return;
  out[at].line = std::move(out[at - 1].line);
  out.erase(out.begin() + static_cast<std::ptrdiff_t>(at) - 1);
}

void CycleCalls::at_points(std::size_t i, Statements& out) {
  Item& item = flat_.items[i];
  const Arrival& a = arrival(i);
  Report& report = lowering_.report();
  report.start(item.statement.line.span);
  auto& block = std::get<ir::Block>(item.statement.node);
  const bool rapid = block.motion.kind == ir::MotionKind::rapid;
  block.motion.clear();
  const auto refuse = [&](std::string_view text) {
    if (!report.refused()) report.keep("HEI-029", {}, std::string(text), "cycle.pattern");
    item.statement.node = not_carried("CYCL CALL PAT", report.feature());
    out.push_back(std::move(item.statement));
  };
  if (!a.reached) return out.push_back(std::move(item.statement));
  if (a.pattern < 0) return refuse("which PATTERN DEF is in force here is not known");
  const auto places = figure_places(flat_.patterns[static_cast<std::size_t>(a.pattern)], report);
  if (places.empty()) return refuse("the pattern has no points");
  const bool level = std::all_of(places.begin(), places.end(),
                                 [&](const Place& p) { return ir::equal(p.height, places.front().height); });
  const auto plane = plane_at(a);
  std::vector<Machining> each;
  for (const Place& p : places) {
    if (!level || each.empty()) each.push_back(machining(item, a, p.height, nullptr));
    if (report.refused()) return refuse({});
  }
  if (!item.height && each.front().cycle != nullptr)
    report.warn("HEI-019", {},
                "the height of the tool at the call is not known: between the points the tool goes to that of the "
                "cycle, on the control to the higher one",
                "go along the tool axis to a number before the call");
  for (auto& m : each) raise(m, item.height);
  out.push_back(std::move(item.statement));
  const ir::Statement first = out.back();
  const std::size_t at = out.size();
  const auto* hole = each.front().cycle == nullptr ? nullptr : std::get_if<ir::HoleCycle>(&each.front().cycle->node);
  // At feed the spindle of a tap that stops it stands between the points.
  const bool stands = !rapid && hole != nullptr && hole->spindle_after == ir::SpindleStep::off;
  const bool modal = level && hole != nullptr && !each.front().speed_after && !stands;
  for (std::size_t k = 0; k < places.size(); ++k) {
    ir::Block b = move(rapid ? ir::MotionKind::rapid : ir::MotionKind::linear,
                       {coordinate(plane.u, places[k].u), coordinate(plane.v, places[k].v)});
    if (modal && k == 0) {
      ir::CycleDefine define;
      define.cycle = each.front().cycle;
      b.actions.emplace_back().data = std::move(define);
    }
    out.push_back(behind(first, std::move(b)));
    if (!modal) put(each[level ? 0 : k], plane, out);
  }
  if (modal) {
    ir::Block cancel;
    cancel.actions.emplace_back().data = ir::CycleCancel{};
    out.push_back(behind(first, std::move(cancel)));
  }
  if (std::get<ir::Block>(first.node).empty()) take_place(out, at);
}

/// Between the points the tool goes where it stood at the call, if that is higher than the cycle's own way out.
void CycleCalls::raise(Machining& m, const std::optional<ir::Value>& height) {
  if (!height) return;
  const auto high_enough = [&height](const ir::Value& v) {
    return v.literal() && height->literal() && v.number >= height->number;
  };
  const auto* last = m.moves.empty() ? nullptr : &m.moves.back();
  if (last != nullptr && last->kind == CycleMove::Kind::rapid && last->w && !high_enough(*last->w)) {
    CycleMove up;
    up.w = larger(*last->w, *height);
    m.moves.push_back(std::move(up));
  }
  const auto* hole = m.cycle == nullptr ? nullptr : std::get_if<ir::HoleCycle>(&m.cycle->node);
  if (hole == nullptr || hole->retract.base != ir::LevelBase::absolute || high_enough(hole->retract.value)) return;
  ir::HoleCycle higher = *hole;
  higher.retract.value = larger(higher.retract.value, *height);
  m.cycle = std::make_shared<const ir::Cycle>(ir::Cycle{std::move(higher)});
}

/// 220 and 221: to the second clearance, from point to point, the cycle at each.
void CycleCalls::pattern(std::size_t i, Statements& out) {
  Item& item = flat_.items[i];
  const CycleDefinition& own = flat_.cycles[static_cast<std::size_t>(item.index)];
  const Arrival& a = arrival(i);
  Report& report = lowering_.report();
  const Machining m = machining(item, a, std::nullopt, &own);
  const auto points = m.any() ? pattern_points(own, report) : std::vector<PatternPoint>{};
  if (points.empty()) {
    item.statement.node = not_carried("CYCL DEF " + std::to_string(own.number),
                                      report.feature().empty() ? "cycle.pattern" : report.feature(), !report.refused());
    out.push_back(std::move(item.statement));
    return;
  }
  const bool low = own.values.at(301).value.is(0);
  const auto plane = plane_at(a);
  const auto number = [&own](std::int16_t q) { return own.values.at(q).value.number; };
  const double top = number(203) + std::max(number(204), number(200));
  item.statement.node = move(ir::MotionKind::rapid, {coordinate(plane.w, ir::Value(top))});
  out.push_back(std::move(item.statement));
  const ir::Statement first = out.back();
  for (std::size_t k = 0; k < points.size(); ++k) {
    ir::Block b = move(ir::MotionKind::rapid,
                       {coordinate(plane.u, ir::Value(points[k].u)), coordinate(plane.v, ir::Value(points[k].v))});
    if (k == 0 && m.cycle != nullptr && !m.speed_after) {
      ir::CycleDefine define;
      define.cycle = m.cycle;
      b.actions.emplace_back().data = std::move(define);
    }
    out.push_back(behind(first, std::move(b)));
    if (m.cycle == nullptr || m.speed_after) put(m, plane, out);
  }
  if (m.cycle != nullptr && !m.speed_after) {
    ir::Block cancel;
    cancel.actions.emplace_back().data = ir::CycleCancel{};
    out.push_back(behind(first, std::move(cancel)));
  }
  if (low) out.push_back(behind(first, move(ir::MotionKind::rapid, {coordinate(plane.w, ir::Value(top))})));
}

}  // namespace cnctrans::frontends::heidenhain
