// Inch and metric (equivalences 5.1). Where the target has the switch it stays; a switch that leaves F and the cutting
// speed alone becomes one that holds for them too, with both converted, and the other way round.
#include "base/text.h"
#include "ir/analysis/flow_states.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/analysis/feed_units.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

class UnitPass {
 public:
  UnitPass(const LegaliseContext& context, const FactsOf& facts, const FlowStates<FeedUnits>& units)
      : context_(context), facts_(facts), units_(units) {}

  void block(Statement& s, Block& b) {
    const auto* state = units_.before(s);
    std::optional<bool> feed_too = state != nullptr ? state->value : std::nullopt;
    for (auto& a : b.actions) {
      auto* m = std::get_if<ModalSet>(&a.data);
      if (m == nullptr || m->setting != Setting::units) continue;
      feed_too = m->feed_too;
      if (legal(m->feed_too)) continue;
      m->feed_too = !m->feed_too;
      a.text = {};
    }
    if (state != nullptr && (!feed_too || !legal(*feed_too))) technology(s, b, feed_too);
  }

 private:
  [[nodiscard]] bool legal(bool feed_too) const {
    return feed_too ? context_.target.units_with_feed : context_.target.units_geometry_only;
  }
  /// F and the cutting speed: in mm and m/min where the switch leaves them alone, else in inches and feet.
  void technology(Statement& s, Block& b, std::optional<bool> feed_too) {
    const auto units = setting_in<Units>(b, facts_.before(s), Setting::units);
    if (units == Units::metric) return;
    for (auto& a : b.actions) {
      auto* f = std::get_if<SetFeed>(&a.data);
      auto* speed = std::get_if<SetSpindle>(&a.data);
      if (speed != nullptr && speed_mode(s, b) == SpindleMode::rpm) speed = nullptr;
      if (f == nullptr && speed == nullptr) continue;
      const bool known_mode = speed == nullptr || speed_mode(s, b);
      if (!units || !feed_too || !known_mode) {
        context_.diagnostics.error(
            "TRN-171", word_span(s.line.span, a.pos),
            std::string(known_mode ? "the unit in force is" : "whether S is a cutting speed is") +
                " not known here, and the unit of " + (f != nullptr ? "F" : "a cutting speed") +
                " differs between the controls",
            known_mode ? "write the unit (inch or metric) before this block on every path"
                       : "write G96 or G97 before this block on every path");
        return;
      }
      if (f != nullptr) {
        if (setting_in<FeedMode>(b, facts_.before(s), Setting::feed_mode) == FeedMode::inverse_time) continue;
        f->value = ir::scale(f->value, *feed_too ? 25.4 : 1 / 25.4);
      } else {
        speed->value = ir::scale(speed->value, *feed_too ? 0.3048 : 1 / 0.3048);
      }
      a.text = {};
    }
  }
  [[nodiscard]] std::optional<SpindleMode> speed_mode(const Statement& s, const Block& b) const {
    return setting_in<SpindleMode>(b, facts_.before(s), Setting::spindle_mode);
  }

  const LegaliseContext& context_;
  const FactsOf& facts_;
  const FlowStates<FeedUnits>& units_;
};

bool has_illegal_switch(const Program& program, const Capabilities& target) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        const auto* m = std::get_if<ModalSet>(&a.data);
        if (m == nullptr || m->setting != Setting::units) continue;
        found = found || !(m->feed_too ? target.units_with_feed : target.units_geometry_only);
      }
    });
  }
  return found;
}

/// Moves in machine coordinates: the source reads them in the machine's own unit, the target in that of the program.
void machine_moves(Program& program, const LegaliseContext& context) {
  const auto own = [](const machine::Profile& m) {
    return m.policies.machine_move_units == machine::MachineMoveUnits::machine;
  };
  if (!own(context.source_machine) || own(context.target_machine)) return;
  const FactsOf facts(program, context);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion || b->motion.frame != FrameUse::machine || b->motion.coords.empty()) return;
      const auto units = setting_in<Units>(*b, facts.before(s), Setting::units);
      if (units == Units::metric) return;
      if (!units) {
        context.diagnostics.error("TRN-171", s.line.span,
                                  "the unit in force is not known here; the source takes this machine position in "
                                  "millimetres, the target in the unit in force",
                                  "write the unit (inch or metric) before this block on every path");
        return;
      }
      for (auto& c : b->motion.coords) {
        if (!is_rotary_letter(c.axis)) c.value = ir::scale(c.value, 1 / 25.4);
      }
    });
  }
}

}  // namespace

void convert_units(Program& program, const LegaliseContext& context) {
  machine_moves(program, context);
  if (!has_illegal_switch(program, context.target)) return;
  const FactsOf facts(program, context);
  const FeedUnits domain(context.source_machine.power_on.units_feed_too);
  const FlowStates<FeedUnits> units(program, domain);
  UnitPass pass(context, facts, units);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&pass](Statement& s) {
      if (auto* b = std::get_if<Block>(&s.node)) pass.block(s, *b);
    });
  }
}

}  // namespace cnctrans::ir::passes
