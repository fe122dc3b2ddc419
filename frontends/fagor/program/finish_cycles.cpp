// What the flow of the program makes of cycles and modal subroutines that were read by the text.
#include <algorithm>

#include "frontends/common/cycle_changes.h"
#include "frontends/fagor/program/finish_parts.h"
#include "ir/analysis/cycle_ends.h"
#include "ir/analysis/dataflow.h"
#include "ir/cycle.h"
#include "ir/edit/search.h"

namespace cnctrans::fagor {

namespace {

/// Which modal call is in force at a block, as far as the text can tell.
enum class Modal : std::uint8_t { none, subroutine, program, unknown };

}  // namespace

void judge_cycle_changes(ir::Program& program, LowerState& state) {
  const auto is_change = [](const ir::Action& a) {
    return std::get<ir::HoleCycle>(std::get<ir::CycleDefine>(a.data).cycle->node).keeps_initial;
  };
  const auto findings = frontends::judge_changes(program, state.profile().power_on, is_change);
  frontends::report_changes(findings, "FAG-090", state.diagnostics());
}

void end_cycles(ir::Program& program, LowerState& state) {
  if (!in_order_of_text(program)) (void)ir::end_cycles_with_plane(program, state.profile().power_on);
}

void drop_needless_ends(ir::Program& program, LowerState& state) {
  const auto ends = [](const ir::Action& a) {
    const auto* set = std::get_if<ir::ModalSet>(&a.data);
    return set != nullptr && set->setting == ir::Setting::comp && a.order != ir::Order::after && a.text.empty();
  };
  const auto machines = [](const ir::Action& a) {
    const auto* d = std::get_if<ir::CycleDefine>(&a.data);
    return d != nullptr && d->cycle && std::holds_alternative<ir::NamedCycle>(d->cycle->node);
  };
  const auto concerned = [&](const ir::Block& b) {
    return std::any_of(b.actions.begin(), b.actions.end(), machines) &&
           std::any_of(b.actions.begin(), b.actions.end(), ends);
  };
  bool any = false;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      any = any || (b != nullptr && concerned(*b));
    });
  }
  if (!any) return;
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, state.profile().power_on);
  for (auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](ir::Statement& s) {
      auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr || !concerned(*b)) return;
      const auto known = table.before(s.id).settings[static_cast<std::size_t>(ir::Setting::comp)];
      if (known == static_cast<std::uint8_t>(ir::CompSide::off)) std::erase_if(b->actions, ends);
    });
  }
}

void judge_repeats(ir::Program& program, LowerState& state) {
  const auto& programs = state.facts.modal_programs;
  const bool moves_once = state.options().mcall_repeat == dialects::fagor::RepeatUnderModal::sub_only;
  if (programs.empty() && !moves_once) return;
  // The text tells what is in force where nothing jumps and every modal call stands in the main part by itself.
  bool any = false, plain = !has_jumps(program);
  for (const auto& r : program.routines) {
    const bool main = r.kind == ir::RoutineKind::main;
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      if (!std::holds_alternative<ir::ModalCall>(s.node)) return;
      const bool top = std::any_of(r.body.begin(), r.body.end(), [&s](const ir::Statement& t) { return &t == &s; });
      any = true;
      plain = plain && main && top && s.line.skip_mask == 0;
    });
  }
  if (!any) return;
  for (auto& r : program.routines) {
    Modal modal = plain && r.kind == ir::RoutineKind::main ? Modal::none : Modal::unknown;
    ir::for_each_statement(r.body, [&](ir::Statement& s) {
      if (const auto* m = std::get_if<ir::ModalCall>(&s.node); m != nullptr && modal != Modal::unknown) {
        modal = m->off ? Modal::none : programs.count(s.line.span.line) != 0 ? Modal::program : Modal::subroutine;
      }
      auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr || b->repeat_given == 0 || modal == Modal::none) return;
      state.set_line(s.line.span);
      if (modal == Modal::program) {
        state.warning("FAG-091", {}, "the control ignores the repeat count of a block under MEXEC: it runs once",
                      "the count is left out");
        b->repeat_given = 0;
        b->repeat = ir::Value{};
      } else if (modal == Modal::unknown && !programs.empty()) {
        state.error("FAG-091", {},
                    "a repeat count counts under MCALL and not under MEXEC, and which of them is in force here depends "
                    "on the way to this block",
                    "write the block as often as it is to run");
      } else if (moves_once) {
        state.error("FAG-091", {},
                    "a repeat count under MCALL that runs the subroutine only (fagor.mcall_repeat = sub_only) is not "
                    "carried",
                    "write the block once and a PCALL for each further execution");
      }
    });
  }
}

}  // namespace cnctrans::fagor
