// What a file's blocks owe to each other: done when all of it is known.
#include <algorithm>
#include <memory>
#include <optional>
#include <unordered_map>

#include "dialects/fagor/limits.h"
#include "frontends/common/own_lengths.h"
#include "frontends/fagor/program/finish_parts.h"
#include "frontends/fagor/program/program_reader.h"
#include "frontends/fagor/program/tool_offsets.h"
#include "ir/analysis/dataflow.h"
#include "ir/cycles/pattern.h"
#include "ir/edit/search.h"

namespace cnctrans::fagor {

bool has_jumps(const ir::Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&found](const ir::Statement& s) {
      found = found || std::holds_alternative<ir::Jump>(s.node) || std::holds_alternative<ir::Repeat>(s.node);
    });
  }
  return found;
}

bool in_order_of_text(const ir::Program& program) {
  bool flow = has_jumps(program) || program.routines.size() > 1;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&flow](const ir::Statement& s) {
      flow = flow || std::holds_alternative<ir::CallRoutine>(s.node) || std::holds_alternative<ir::ModalCall>(s.node) ||
             s.line.skip_mask != 0;
    });
  }
  return !flow;
}

namespace {

std::shared_ptr<const ir::FrameChange> cleared(ir::FrameSlot slot) {
  ir::FrameChange f;
  f.slot = slot;
  f.combine = ir::FrameCombine::clear;
  return std::make_shared<const ir::FrameChange>(std::move(f));
}

/// Adds to every block what its functions do besides their own: see finish_program.
/// `table_shift`: the shift in force may be one of G58 and G59, which the next offset cancels.
void complete_block(ir::Block& b, bool& table_shift, bool both, bool clear_preset) {
  for (std::size_t i = 0; i < b.actions.size(); ++i) {
    std::vector<ir::Action> more;
    if (both) {
      const auto* f = std::get_if<ir::FrameOp>(&b.actions[i].data);
      if (f && f->change->slot == ir::FrameSlot::shift) table_shift = f->change->combine == ir::FrameCombine::replace;
    }
    if (std::holds_alternative<ir::WorkOffset>(b.actions[i].data)) {
      ir::Action a;
      if (clear_preset) {
        a.data = ir::FrameOp{cleared(ir::FrameSlot::preset)};
        more.push_back(a);
      }
      if (table_shift) {
        a.data = ir::FrameOp{cleared(ir::FrameSlot::shift)};
        more.push_back(a);
      }
    }
    b.actions.insert(b.actions.begin() + static_cast<std::ptrdiff_t>(i) + 1, more.begin(), more.end());
    i += more.size();
  }
}

/// The statements of the lines that depend on the plane.
std::unordered_map<std::uint32_t, const ir::Statement*> statements_by_line(const ir::Program& program) {
  std::unordered_map<std::uint32_t, const ir::Statement*> found;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&found](const ir::Statement& s) { found.emplace(s.line.span.line, &s); });
  }
  return found;
}

std::optional<ir::Plane> plane_in(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (!b) return std::nullopt;
  for (const auto& a : b->actions) {
    const auto* set = std::get_if<ir::ModalSet>(&a.data);
    if (set && set->setting == ir::Setting::plane) return static_cast<ir::Plane>(set->value);
  }
  return std::nullopt;
}

/// The facts of the program when every subroutine outside of it leaves the plane as it is.
ir::FactTable facts_without_outside(const ir::Program& program, const LowerState& state) {
  ir::Program inside = program;
  for (auto& r : inside.routines) {
    ir::for_each_statement(r.body, [&program](ir::Statement& s) {
      const auto* c = std::get_if<ir::CallRoutine>(&s.node);
      const auto* m = std::get_if<ir::ModalCall>(&s.node);
      const ir::CallRoutine* call = c != nullptr ? c : m != nullptr && !m->off && !m->cycle ? &m->call : nullptr;
      if (call != nullptr && !call->computed && program.find(call->routine) == nullptr) s.node = ir::Label{};
    });
  }
  return ir::analyse(inside, state.profile().power_on);
}

/// The facts of the program; a block that was read in a wrong plane, and given up for that, changes nothing.
ir::FactTable facts_by_flow(const ir::Program& program, const LowerState& state) {
  const auto given_up = [&state](const ir::Statement& s) {
    const auto& uses = state.facts.plane_uses;
    return std::holds_alternative<ir::Opaque>(s.node) &&
           std::any_of(uses.begin(), uses.end(), [&s](const PlaneUse& u) { return u.span.line == s.line.span.line; });
  };
  ir::Program flow = program;
  for (auto& r : flow.routines) {
    ir::for_each_statement(r.body, [&given_up](ir::Statement& s) {
      if (given_up(s)) s.node = ir::Label{};
    });
  }
  return ir::analyse(flow, state.profile().power_on);
}

/// Were the planes that lowering took from the text right? The flow of the program decides.
void judge_planes(ir::Program& program, LowerState& state) {
  FileFacts& facts = state.facts;
  const auto usual = static_cast<std::size_t>(state.profile().power_on.plane);
  bool others = false, from_caller = false;
  for (std::size_t p = 0; p < facts.planes.size(); ++p) others = others || (facts.planes[p] && p != usual);
  for (const auto& use : facts.plane_uses) from_caller = from_caller || use.from_caller;
  if (facts.plane_uses.empty() || (!others && !from_caller)) return;
  ir::number_statements(program);
  const ir::FactTable table = facts_by_flow(program, state);
  const auto lines = statements_by_line(program);
  std::optional<ir::FactTable> inside;
  for (const auto& use : facts.plane_uses) {
    const auto at = lines.find(use.span.line);
    if (at == lines.end()) continue;
    const ir::Facts& before = table.before(at->second->id);
    const auto known = before.settings[static_cast<std::size_t>(ir::Setting::plane)];
    const auto own = plane_in(*at->second);
    if (known && !own) facts.planes_by_flow[use.span.line] = static_cast<ir::Plane>(*known);
    if ((own && *own == use.assumed) || (known && *known == static_cast<std::uint8_t>(use.assumed))) continue;
    state.set_line(use.span);
    if (!inside) inside = facts_without_outside(program, state);
    const auto kept = inside->before(at->second->id).settings[static_cast<std::size_t>(ir::Setting::plane)];
    if (!known && kept && *kept == static_cast<std::uint8_t>(use.assumed)) {
      state.warning("FAG-026", {},
                    "this block depends on the plane; a subroutine of another file that is called before it is taken "
                    "to leave the plane as it is",
                    "write the plane function (G17, G18, G19) behind the call if it does not");
    } else if (others || known) {
      facts.plane_by_flow_differs = facts.plane_by_flow_differs || (known && !own);
      state.error("FAG-026", {}, "this block depends on the plane, and the program reaches it with several planes",
                  "write the plane function (G17, G18, G19) before the block");
    } else {
      state.warning("FAG-026", {},
                    "this block depends on the plane that the calling program has set; the usual plane is assumed",
                    "write the plane function (G17, G18, G19) in the subroutine");
    }
  }
}

bool calls_outside(const ir::Program& program) {
  bool outside = false;
  const auto look = [&](const ir::CallRoutine& call) {
    outside = outside || call.computed || !program.find(call.routine);
  };
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      if (const auto* c = std::get_if<ir::CallRoutine>(&s.node)) look(*c);
      if (const auto* m = std::get_if<ir::ModalCall>(&s.node); m && !m->off) look(m->call);
    });
  }
  return outside;
}

/// The senses of a plane with its axes exchanged were taken from the text: right where the text is the order of work.
void judge_turned_plane(const ir::Program& program, LowerState& state) {
  if (!state.facts.first_turned_plane.known() || in_order_of_text(program)) return;
  state.set_line(state.facts.first_turned_plane);
  state.error(
      "FAG-026", {},
      "a plane with its axes exchanged (G16 XZ, YX, ZY) in a program with jumps, calls or skipped blocks: which "
      "blocks it holds for can't be told",
      "write G16 ZX, XY or YZ, and turn the arcs over");
}

/// The spindle and the longitudinal axis were taken from the text: right where no other way leads to the block.
void judge_text_uses(const ir::Program& program, LowerState& state) {
  const FileFacts& facts = state.facts;
  if (facts.text_uses.empty()) return;
  const bool jumps = has_jumps(program);
  for (const auto& use : facts.text_uses) {
    if (!(use.longitudinal ? facts.longitudinal : facts.second_spindle) || (!use.from_caller && !jumps)) continue;
    state.set_line(use.span);
    state.error(
        "FAG-038", {},
        use.longitudinal ? "this block depends on the longitudinal axis (G15), and other ways may lead to it"
                         : "this block depends on the spindle chosen (G28, G29), and other ways may lead to it",
        use.longitudinal ? "write the plane function or G15 before the block" : "write G28 or G29 before the block");
  }
}

/// A hole bored away from its depth, and one that begins below its reference plane (25.3).
void judge_depths(ir::Program& program, LowerState& state) {
  bool any = false;
  const auto cycle_in = [](const ir::Statement& s) -> const ir::HoleCycle* {
    const auto* b = std::get_if<ir::Block>(&s.node);
    if (b == nullptr) return nullptr;
    for (const auto& a : b->actions) {
      const auto* d = std::get_if<ir::CycleDefine>(&a.data);
      const auto* hole = d != nullptr && d->cycle ? std::get_if<ir::HoleCycle>(&d->cycle->node) : nullptr;
      if (hole != nullptr && hole->axis == ir::axis::none && !hole->keeps_initial) return hole;
    }
    return nullptr;
  };
  for (const auto& r : program.routines)
    ir::for_each_statement(r.body, [&](const ir::Statement& s) { any = any || cycle_in(s) != nullptr; });
  if (!any) return;
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, state.profile().power_on);
  const auto check = [&](const ir::Statement& s) {
    const ir::HoleCycle* hole = cycle_in(s);
    if (hole == nullptr) return;
    ir::Facts at = table.before(s.id);
    for (const auto& a : std::get<ir::Block>(s.node).actions) {
      const auto* set = std::get_if<ir::ModalSet>(&a.data);
      if (set != nullptr && a.order != ir::Order::after)
        at.settings[static_cast<std::size_t>(set->setting)] = set->value;
    }
    const auto distance = at.settings[static_cast<std::size_t>(ir::Setting::distance)];
    const auto plane = at.settings[static_cast<std::size_t>(ir::Setting::plane)];
    if (!at.reachable || !distance || !plane) return;
    const bool absolute = *distance == static_cast<std::uint8_t>(ir::Distance::absolute);
    const ir::AxisId normal = ir::plane_axes(static_cast<ir::Plane>(*plane)).w;
    const auto tool = at.position[normal];
    const auto height = [&](const ir::Level& l, std::optional<double> from) -> std::optional<double> {
      if (!l.value.literal()) return std::nullopt;
      const bool own = l.base == ir::LevelBase::absolute || (l.base == ir::LevelBase::distance_mode && absolute);
      return own ? std::optional(l.value.number) : from ? std::optional(*from + l.value.number) : std::nullopt;
    };
    auto reference = height(hole->reference, tool);
    const bool relative = !reference && !tool && hole->bottom.value.literal() &&
                          (hole->bottom.base == ir::LevelBase::from_reference || !absolute);
    if (relative) reference = 0;  // only the way from it to the bottom counts
    const auto bottom = reference ? height(hole->bottom, reference) : std::nullopt;
    if (!reference || !bottom) return;
    state.set_line(s.line.span);
    if (*bottom > *reference) {
      state.warning("FAG-048", {}, "the depth of this cycle lies above its reference plane: the tool works upwards",
                    "look at the sign of I");
    }
    if (tool && *tool < *reference - 1e-9 && *tool > *bottom + 1e-9) {
      state.error("FAG-046", {},
                  "the tool stands between the reference plane and the depth where the cycle is called [1046]",
                  "move it above the reference plane");
    }
  };
  for (const auto& r : program.routines) ir::for_each_statement(r.body, check);
}

/// G60 to G65 repeat the machining in force (25.4): an error where the file has none at all.
void judge_patterns(const ir::Program& program, LowerState& state) {
  if (program.main() == nullptr || calls_outside(program)) return;
  bool machining = false;
  std::vector<Span> patterns;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* m = std::get_if<ir::ModalCall>(&s.node);
      machining = machining || (m != nullptr && !m->off);
      const auto* b = std::get_if<ir::Block>(&s.node);
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
        const auto* d = std::get_if<ir::CycleDefine>(&b->actions[i].data);
        if (d == nullptr || !d->cycle) continue;
        const auto* named = std::get_if<ir::NamedCycle>(&d->cycle->node);
        const auto* pattern = named != nullptr ? ir::cycles::find_pattern(named->name) : nullptr;
        machining = machining || named == nullptr;
        if (pattern != nullptr && pattern->from_tool) patterns.push_back(s.line.span);
      }
    });
  }
  if (machining) return;
  for (const Span& where : patterns) {
    state.set_line(where);
    state.error("FAG-046", {}, "points of a pattern where no canned cycle and no MCALL is in force: nothing to repeat",
                "write the cycle or MCALL before it");
  }
}

/// X, C and Y mean other things on the face and the cylinder than elsewhere: was the text the order of work?
void judge_surfaces(ir::Program& program, LowerState& state) {
  if (!state.facts.surfaces || in_order_of_text(program)) return;
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, state.profile().power_on);
  const auto concerned = [](const ir::Block& b) {
    const auto& m = b.motion;
    const auto moves = [](const ir::CoordWord& w) {
      return w.axis == ir::axis::x || w.axis == ir::axis::y || w.axis == ir::axis::c;
    };
    const auto sense = [](const ir::Action& a) {
      const auto* set = std::get_if<ir::ModalSet>(&a.data);
      return set != nullptr && set->setting == ir::Setting::comp;
    };
    return (b.has_motion && (m.explicit_code || std::any_of(m.coords.begin(), m.coords.end(), moves))) ||
           std::any_of(b.actions.begin(), b.actions.end(), sense);
  };
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr || ir::action_in<ir::SurfaceSet>(*b) != nullptr || !concerned(*b)) return;
      const auto line = state.facts.surface_lines.find(s.line.span.line);
      const auto assumed = line == state.facts.surface_lines.end() ? ir::Surface::none : line->second;
      const ir::Facts& before = table.before(s.id);
      const auto known = before.settings[static_cast<std::size_t>(ir::Setting::surface)];
      const auto plane = before.settings[static_cast<std::size_t>(ir::Setting::plane)];
      const bool turned = assumed != ir::Surface::cylinder || plane == static_cast<std::uint8_t>(ir::Plane::yz);
      if (!before.reachable || (known == static_cast<std::uint8_t>(assumed) && turned)) return;
      state.set_line(s.line.span);
      state.error("FAG-045", {},
                  "this block depends on the C axis (G15, G16), and other ways may lead to it than the text says",
                  "write G16 XC, G16 ZC or G18 before the block");
    });
  }
}

/// G49 alone in a file that inclines no plane: nothing to end.
void drop_inclined_ends(ir::Program& program, LowerState& state) {
  if (state.facts.first_inclined_plane.known() || state.facts.inclined_ends.empty()) return;
  for (const Span& where : state.facts.inclined_ends) {
    state.set_line(where);
    state.note("FAG-008", {}, "G49 alone ends no inclined plane of this file; the block is kept as text");
  }
  for (auto& r : program.routines) {
    ir::for_each_statement(r.body, [](ir::Statement& s) {
      auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr || b->actions.size() != 1 || b->has_motion) return;
      const auto* op = std::get_if<ir::FrameOp>(&b->actions[0].data);
      if (op == nullptr || op->change->slot != ir::FrameSlot::chain || op->change->kind != ir::FrameKind::translate)
        return;
      s.node = ir::Opaque{std::string(b->actions[0].text), "motion.transformation", true};
    });
  }
}

}  // namespace

void finish_program(ir::Program& program, LowerState& state) {
  const FileFacts& facts = state.facts;
  judge_planes(program, state);
  judge_text_uses(program, state);
  judge_depths(program, state);
  frontends::OwnLengths own;
  own.reapproach = 1;  // G83, G69 (25.3)
  frontends::settle_own_lengths(program, state.profile().power_on, own, state.diagnostics());
  judge_surfaces(program, state);
  judge_patterns(program, state);
  judge_cycle_changes(program, state);
  end_cycles(program, state);
  drop_needless_ends(program, state);
  judge_repeats(program, state);
  drop_inclined_ends(program, state);
  if (facts.unlisted_parameters) {
    const auto& range = dialects::fagor::unlisted_parameters;
    program.spaces[parameter_space].segments.push_back({range.lo, range.hi, ir::Scope::global, true});
  }
  offsets_with_change(program, state);
  // A part zero set by G92 ends with the next G53..G57, G159; it may come from a routine of another file.
  const bool clear_preset = facts.preset || !program.main() || calls_outside(program);
  const bool both = facts.table_shift && facts.shift;
  if (clear_preset || facts.table_shift) {
    bool table_shift = facts.table_shift && !both;
    for (auto& r : program.routines) {
      ir::for_each_statement(r.body, [&](ir::Statement& s) {
        if (auto* b = std::get_if<ir::Block>(&s.node)) complete_block(*b, table_shift, both, clear_preset);
      });
    }
  }
  judge_turned_plane(program, state);
  set_presets_past_mirrors(program, state);
  resolve_exchanges(program, state);
  if (both && !in_order_of_text(program)) {
    state.set_line(facts.first_table_shift);
    state.error(
        "FAG-027", {},
        "G58 or G59 and G158 in a program with jumps, calls or skipped blocks: what the next G54 cancels depends on "
        "which came last",
        "use only one of the two");
  }
  if (facts.first_axis_scale.known() && facts.rotation) {
    state.set_line(facts.first_axis_scale);
    state.error("FAG-027", {}, "factors of single axes (G72 X) and a rotation (G73) in one program are not carried",
                "transform the coordinates of the part");
  }
  if (facts.first_inclined_plane.known() && facts.inner_frames) {
    state.set_line(facts.first_inclined_plane);
    state.error("FAG-027", {},
                "an inclined plane (G49) and a shift, mirror image, scale or rotation in one program are not carried",
                "transform the coordinates of the part");
  }
  for (const Span& where : facts.tool_planes) {
    if (!facts.turned_by_axes) break;
    state.set_line(where);
    state.error("FAG-054", {},
                "the plane across the tool (G49 T) in a program that moves A, B or C: where the tool points "
                "depends on the head of the machine",
                "write the angles (A B C or Q R S)");
  }
  const bool inch_machine = state.profile().power_on.units == ir::Units::inch;
  if (facts.first_machine_move.known() && facts.units[inch_machine ? 0 : 1]) {
    state.set_line(facts.first_machine_move);
    state.warning("FAG-030", {}, "coordinates with G53 are in the unit of the machine, not in the unit of the program",
                  "they are taken in the machine's unit; check the machine positions");
  }
}

}  // namespace cnctrans::fagor
