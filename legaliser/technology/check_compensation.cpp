// Rapid moves while radius compensation is on (equivalences 16): some controls suspend the compensation for such a
// block and take it up again after it, others keep it. The programmed path is the same, the centre of the tool is not.
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/text.h"
#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/refuse.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

bool program_compensates(const Program& program, const machine::Profile& machine) {
  bool found = machine.power_on.comp != CompSide::off;
  for (const auto& r : program.routines) {
    if (found) break;
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        const auto* m = std::get_if<ModalSet>(&a.data);
        found = found || (m != nullptr && m->setting == Setting::comp && m->value != 0);
      }
    });
  }
  return found;
}

/// Moves in the plane; without a plane: along any axis that a plane may have.
bool moves_in_plane(const Block& b, const Facts& facts) {
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  return std::any_of(b.motion.coords.begin(), b.motion.coords.end(), [plane](const CoordWord& c) {
    return plane ? c.axis == plane_axes(*plane).u || c.axis == plane_axes(*plane).v : c.axis <= axis::z;
  });
}

/// What no control takes while radius compensation is on: another tool, offset, work offset, frame or plane.
const Action* forbidden(const Block& b, const Facts& before) {
  for (const auto& a : b.actions) {
    if (std::holds_alternative<ToolSelect>(a.data) || std::holds_alternative<ToolChange>(a.data) ||
        std::holds_alternative<ToolOffset>(a.data) || std::holds_alternative<FrameOp>(a.data))
      return &a;
    if (const auto* w = std::get_if<WorkOffset>(&a.data);
        w != nullptr && before.work_offset != (w->off               ? 0
                                               : w->index.literal() ? w->index.number
                                                                    : -1))
      return &a;
    const auto* m = std::get_if<ModalSet>(&a.data);
    const auto plane = before.settings[static_cast<std::size_t>(Setting::plane)];
    if (m != nullptr && m->setting == Setting::plane && plane && *plane != m->value) return &a;
  }
  return nullptr;
}

/// What some controls do not take there: a stop, a move in machine coordinates.
bool interrupts(const Block& b) {
  return (b.has_motion && b.motion.moves() && b.motion.frame == FrameUse::machine) ||
         std::any_of(b.actions.begin(), b.actions.end(),
                     [](const Action& a) { return std::holds_alternative<Stop>(a.data); });
}

bool rotates(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    const auto* f = std::get_if<FrameOp>(&a.data);
    return f != nullptr && f->change && f->change->kind == FrameKind::rotate;
  });
}

/// Controls stop with an alarm there, or go on with another centre of the tool each.
void check_changes(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || !program_compensates(program, context.source_machine)) return;
  Program numbered = program;
  const FactsOf facts(numbered, context);
  const bool refuses = context.target_machine.policies.comp_interruptions == machine::CompInterruptions::refused &&
                       context.source_machine.policies.comp_interruptions != machine::CompInterruptions::refused;
  const bool ends = context.target_machine.policies.comp_rotation == machine::CompRotation::ended;
  std::map<std::uint32_t, std::string_view> refused;
  for (const auto& r : numbered.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      const Facts& before = facts.before(s);
      const auto side = setting<CompSide>(before, Setting::comp), now = setting_in<CompSide>(*b, before, Setting::comp);
      if (!before.reachable || side == CompSide::off || now == CompSide::off) return;
      if (ends && rotates(*b)) {
        refused[s.id] = "a rotation ends radius compensation on the target, and it is in force, or on some way";
        return;
      }
      if (!side) return;
      if (refuses && interrupts(*b)) {
        refused[s.id] =
            "a stop or a move in machine coordinates while radius compensation is on: the target refuses it";
        return;
      }
      if (b->has_motion && b->motion.kind == MotionKind::reference_point) {
        context.diagnostics.warning("TRN-395", s.line.span,
                                    "a search of the reference point while radius compensation is on: some controls "
                                    "end the compensation there, others refuse it or keep it",
                                    "end the compensation before it and start it again after it");
        return;
      }
      const Action* a = forbidden(*b, before);
      if (a == nullptr) return;
      context.diagnostics.warning(
          "TRN-395", word_span(s.line.span, a->pos),
          "the tool, its offset, the work offset, the frame or the plane changes while radius compensation "
          "is on: most controls refuse that, and the others cut another contour",
          "end the compensation before the change and start it again after it");
    });
  }
  if (refused.empty()) return;
  std::vector<std::uint32_t> ids;  // the copy has the same statements in the same order
  for (const auto& r : numbered.routines) {
    for_each_statement(r.body, [&ids](const Statement& s) { ids.push_back(s.id); });
  }
  std::size_t at = 0;
  std::vector<std::pair<Statement*, std::string_view>> there;
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      const auto it = refused.find(ids[at++]);
      if (it != refused.end()) there.emplace_back(&s, it->second);
    });
  }
  for (const auto& [s, why] : there)
    refuse(*s, program, context, "TRN-399", std::string(why),
           "end the compensation before it and start it again after it");
}

}  // namespace

void check_compensation(Program& program, const LegaliseContext& context) {
  check_changes(program, context);
  check_compensation_ends(program, context);
  const auto source = context.source_machine.policies.comp_rapid;
  if (source == context.target_machine.policies.comp_rapid || !program_compensates(program, context.source_machine))
    return;
  const FactsOf facts(program, context);
  const bool suspends = source == machine::CompRapid::suspended;
  const auto warn = [&](const Statement& s, bool known) {
    context.diagnostics.warning("TRN-144", word_span(s.line.span, std::get<Block>(s.node).motion.code_pos),
                                std::string("a rapid move while radius compensation is ") +
                                    (known ? "on" : "on, on some way that leads here (said once a routine)") +
                                    (suspends ? ": the source suspends it for this move, the target keeps it"
                                              : ": the source keeps it, the target suspends it for this move") +
                                    "; the centre of the tool differs by up to the tool radius",
                                "end the compensation before this move and start it again after it");
  };
  const Block none;
  for (const auto& r : program.routines) {
    bool unsure = false;              // once a routine: what is not known stays so from block to block
    const Statement* lift = nullptr;  // a rapid beside the plane; it counts where the contour goes on behind it
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      const Facts& before = facts.before(s);
      if (!before.reachable) return;
      const auto side = setting<CompSide>(before, Setting::comp), now = setting_in<CompSide>(*b, before, Setting::comp);
      if (now == CompSide::off) lift = nullptr;
      if (!b->has_motion || b->motion.frame != FrameUse::normal) return;
      const bool plane = moves_in_plane(*b, before);
      if (plane && lift != nullptr) warn(*std::exchange(lift, nullptr), true);
      if (motion_in(*b, before).value_or(MotionKind::rapid) != MotionKind::rapid) return;
      if (!side && context.diagnostics.error_count() != 0) return;  // a block before it is refused
      if (side == CompSide::off || now == CompSide::off) return;
      if (!plane) {
        const bool cuts = motion_in(none, before).value_or(MotionKind::linear) != MotionKind::rapid;
        if (side && cuts && b->motion.moves() && lift == nullptr) lift = &s;
        return;
      }
      if (!side && std::exchange(unsure, true)) return;
      warn(s, side.has_value());
    });
    if (lift != nullptr && &r != program.main()) warn(*lift, true);  // the caller goes on
  }
}

}  // namespace cnctrans::ir::passes
