// Diameter and radius words of a lathe (equivalences 5.2): the target's own rule for every word; numbers are rescaled
// where the two controls read the same word differently.
#include <algorithm>

#include "base/text.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// Calls `look` with each diameter or radius code.
template <class Look>
void each_mode(const Program& program, const Look& look) {
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        const auto* m = std::get_if<ModalSet>(&a.data);
        if (m != nullptr && m->setting == Setting::diameter) look(static_cast<DiameterMode>(m->value));
      }
    });
  }
}

/// Every diameter or radius code of the program says the mode of power-on.
bool keeps_mode(const Program& program, const LegaliseContext& context) {
  bool keeps = true;
  each_mode(program, [&](DiameterMode m) { keeps = keeps && m == context.source_machine.power_on.diameter; });
  return keeps;
}

/// Absolute words may be diameters where increments are radii.
bool has_absolute_only(const Program& program, const LegaliseContext& context) {
  bool found = context.source_machine.power_on.diameter == DiameterMode::absolute_only;
  each_mode(program, [&found](DiameterMode m) { found = found || m == DiameterMode::absolute_only; });
  return found;
}

class DiameterPass {
 public:
  DiameterPass(const LegaliseContext& context, const FactsOf& facts, const Program& program)
      : context_(context),
        facts_(facts),
        same_language_(program.dialect == context.target.dialect),
        one_mode_(keeps_mode(program, context)),
        alone_(program.main() == nullptr),
        absolute_only_(has_absolute_only(program, context)) {}

  void block(Statement& s, Block& b, bool in_main) {
    Facts assumed;
    const Facts& known = facts_.before(s);
    const bool idle = one_mode_ && (!in_main || !known.reachable) && !caller_may_switch(known) &&
                      !setting<DiameterMode>(known, Setting::diameter);  // not run
    if (idle) {
      assumed = known;
      assumed.settings[static_cast<std::size_t>(Setting::diameter)] =
          static_cast<std::uint8_t>(context_.source_machine.power_on.diameter);
    }
    const Facts& facts = idle ? assumed : known;
    if (b.has_motion) {
      for (auto& c : b.motion.coords) coordinate(s, c, b, facts);
      for (auto& c : b.motion.centers) center(s, c, b, facts);
    }
    for (auto& a : b.actions) {
      if (auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change) frame(s, *f, b, facts);
    }
    if (settings(b)) settle(s);
  }

 private:
  /// A subprogram by itself, on a machine whose X is a radius at power-on: its programs switch to diameters first.
  [[nodiscard]] bool caller_may_switch(const Facts& facts) const {
    return facts.reachable && alone_ && context_.options.uncalled == Uncalled::unknown &&
           context_.source_machine.power_on.diameter == DiameterMode::radius;
  }
  /// Radius from a word of the target: 0.5 or 1. `mode` is the source's mode of the moment.
  std::optional<double> target_factor(AxisId axis, WordScale scale, std::optional<Distance> distance,
                                      std::optional<DiameterMode> mode, bool face = false) const {
    if (face && axis == axis::x && context_.target.surface_x_radius) return 1;
    if (!is_diameter_axis(context_.target_machine, axis) || scale == WordScale::radius) return 1;
    if (scale == WordScale::diameter) return 0.5;
    if (!context_.target.diameter_switch) return context_.target.fixed_diameter == DiameterMode::radius ? 1 : 0.5;
    if (!mode) return std::nullopt;
    if (*mode == DiameterMode::radius) return 1;
    if (*mode == DiameterMode::absolute_only && context_.target.diameter_absolute_only &&
        distance != Distance::absolute)
      return 1;
    return 0.5;
  }

  void rescale(const Statement& s, Value& v, std::optional<double> from, std::optional<double> to, WordPos pos) const {
    if (from && to) {
      if (*from == *to) return;
      v = ir::scale(v, *from / *to);
      v.text = {};
      return;
    }
    context_.diagnostics.error("TRN-173", word_span(s.line.span, pos),
                               "whether this word is a radius or a diameter depends on the path that leads here",
                               "write the diameter or radius code before this block on every path");
  }

  void coordinate(const Statement& s, CoordWord& c, const Block& b, const Facts& facts) const {
    if (!concerns(c.axis) && c.scale != WordScale::diameter) return;
    const auto distance = distance_of(c, b, facts);
    const auto mode = setting_in<DiameterMode>(b, facts, Setting::diameter);
    const bool face = setting<Surface>(facts, Setting::surface) == Surface::face;
    const auto to = target_factor(c.axis, WordScale::modal, distance, mode, face);
    const bool same_increment = !facts_.before(s).reachable || distance == Distance::absolute || !absolute_only_ ||
                                context_.target.diameter_absolute_only;
    if (c.scale == WordScale::modal && !mode && !face && context_.target.diameter_switch && same_increment)
      return;  // the same code does the same
    rescale(s, c.value, to_radius(c.axis, c.scale, distance, b, facts, context_.source_machine), to, c.pos);
    c.scale = WordScale::modal;
  }

  void center(const Statement& s, CenterWord& c, const Block& b, const Facts& facts) const {
    if (!concerns(c.axis)) return;
    const auto it = context_.target.center_scales.find(c.mode);
    const WordScale wanted = it == context_.target.center_scales.end() ? WordScale::radius : it->second;
    auto distance = setting_in<Distance>(b, facts, Setting::distance);
    if (c.mode == CenterMode::absolute) distance = Distance::absolute;
    if (c.mode == CenterMode::from_start) distance = Distance::incremental;
    const auto mode = setting_in<DiameterMode>(b, facts, Setting::diameter);
    if (wanted == c.scale && (c.scale != WordScale::modal || context_.target.diameter_switch)) return;
    rescale(s, c.value, to_radius(c.axis, c.scale, distance, b, facts, context_.source_machine),
            target_factor(c.axis, wanted, distance, mode, setting<Surface>(facts, Setting::surface) == Surface::face),
            c.pos);
    c.scale = wanted;
  }

  /// No manual says whether a shift of the diameter axis is a diameter (equivalences 5.2).
  void tell_shift(const Statement& s, const FrameChange& f, const FrameWord& w, std::optional<DiameterMode> mode) {
    const bool shift = w.scale == WordScale::modal && f.combine != FrameCombine::clear && !table_row(f) &&
                       f.combine != FrameCombine::preset && is_diameter_axis(context_.source_machine, w.axis);
    if (told_ || same_language_ || !shift || mode == DiameterMode::radius || w.value.is(0)) return;
    told_ = true;
    context_.diagnostics.warning(
        "TRN-652", word_span(s.line.span, w.pos),
        "a shift of X where X words are diameters: it is taken as a diameter on both controls, "
        "so the origin moves by half of it; no manual says so (said once a program)",
        "try it on both machines, or shift X under radius programming");
  }

  void frame(const Statement& s, FrameOp& f, const Block& b, const Facts& facts) {
    if (f.change->kind != FrameKind::translate || (same_language_ && table_row(*f.change))) return;
    auto copy = std::make_shared<FrameChange>(*f.change);
    for (auto& w : copy->words) {
      if (!concerns(w.axis)) continue;
      const auto mode = setting_in<DiameterMode>(b, facts, Setting::diameter);
      tell_shift(s, *f.change, w, mode);
      if (w.scale == WordScale::modal && !mode && context_.target.diameter_switch) continue;
      rescale(s, w.value, to_radius(w.axis, w.scale, Distance::absolute, b, facts, context_.source_machine),
              target_factor(w.axis, WordScale::modal, Distance::absolute, mode), w.pos);
      w.scale = WordScale::modal;
    }
    f.change = std::move(copy);
  }

  /// True when something was taken out.
  bool settings(Block& b) const {
    const auto& t = context_.target;
    return std::erase_if(b.actions, [&](Action& a) {
             auto* m = std::get_if<ModalSet>(&a.data);
             if (m == nullptr || m->setting != Setting::diameter) return false;
             if (!t.diameter_switch) return true;
             if (m->value == static_cast<std::uint8_t>(DiameterMode::absolute_only) && !t.diameter_absolute_only) {
               m->value = static_cast<std::uint8_t>(DiameterMode::diameter);
               a.text = {};
             }
             return false;
           }) != 0;
  }

  bool concerns(AxisId axis) const {
    return is_diameter_axis(context_.source_machine, axis) || is_diameter_axis(context_.target_machine, axis);
  }

  const LegaliseContext& context_;
  const FactsOf& facts_;
  bool same_language_;
  bool one_mode_;       ///< the program leaves the mode of power-on as it is
  bool alone_;          ///< a subprogram whose callers are not at hand
  bool told_ = false;   ///< of a shift of the diameter axis
  bool absolute_only_;  ///< increments are radii, absolute words diameters, somewhere in the program
};

/// A word that says itself that it is a diameter, on whatever axis.
bool has_diameter_word(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion) return;
      for (const auto& c : b->motion.coords) found = found || c.scale == WordScale::diameter;
    });
  }
  return found;
}

}  // namespace

void convert_diameters(Program& program, const LegaliseContext& context) {
  const auto diameter = [](const machine::AxisSpec& a) { return a.diameter; };
  const auto& from = context.source_machine.axes;
  const auto& to = context.target_machine.axes;
  const bool axes = std::any_of(from.begin(), from.end(), diameter) || std::any_of(to.begin(), to.end(), diameter);
  if (!axes && !has_diameter_word(program)) return;
  const FactsOf facts(program, context);
  DiameterPass pass(context, facts, program);
  for (auto& r : program.routines) {
    const bool in_main = r.kind == RoutineKind::main;
    for_each_statement(r.body, [&pass, in_main](Statement& s) {
      if (auto* b = std::get_if<Block>(&s.node)) pass.block(s, *b, in_main);
    });
  }
}

}  // namespace cnctrans::ir::passes
