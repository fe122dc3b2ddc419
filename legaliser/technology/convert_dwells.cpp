// Dwells in the target's unit, exact stop, stops with and without the spindle, settings that the target can't switch
// (equivalences 13, 14.1, 26).
#include <cmath>
#include <set>

#include "base/text.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/analysis/head_constants.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

constexpr double most_dwells = 100;  ///< blocks that one dwell may become

class DwellPass {
 public:
  DwellPass(const Program& program, const LegaliseContext& context, const FactsOf& facts)
      : context_(context),
        facts_(facts),
        constants_(program),
        longest_told_(program.dialect == context.target.dialect) {}

  void block(Editor& editor, Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    drop_settings(s, b);
    tell_optional_stops(s, b);
    Body pieces, further;
    std::size_t at = 0;
    for (std::size_t i = 0; i < b.actions.size(); ++i) {
      if (auto* d = std::get_if<Dwell>(&b.actions[i].data)) {
        if (!dwell(editor.routine, s, b.actions[i], *d, further)) {
          b.actions.erase(b.actions.begin() + static_cast<std::ptrdiff_t>(i));
          --i;
        }
      }
    }
    const bool stop = exact_stop(s, b, pieces);
    if (stop) at = pieces.size();
    if (!further.empty()) std::get<Block>(further.back().node).actions = join(further.back(), take_after(b));
    pieces.push_back(std::move(s));
    for (auto& more : further) pieces.push_back(std::move(more));
    if (stop) pieces.push_back(path_mode(pieces[at].line, PathMode::continuous));
    editor.put_group(out, std::move(pieces), at);
  }

 private:
  static Statement path_mode(const LineInfo& like, PathMode mode) {
    return make_block(like, action(ModalSet{Setting::path_mode, static_cast<std::uint8_t>(mode), true, {}}));
  }

  static std::vector<Action> join(Statement& dwell, std::vector<Action> late) {
    auto actions = std::move(std::get<Block>(dwell.node).actions);
    std::move(late.begin(), late.end(), std::back_inserter(actions));
    return actions;
  }

  /// Whether the operator asks for it only the machine knows, and on one of the two the spindle stands behind it.
  void tell_optional_stops(const Statement& s, const Block& b) {
    const bool source = context_.source_machine.policies.stop_spindle == machine::StopSpindle::stops;
    const bool target = context_.target_machine.policies.stop_spindle == machine::StopSpindle::stops;
    if (source == target) return;
    for (const auto& a : b.actions) {
      const auto* stop = std::get_if<Stop>(&a.data);
      if (stop == nullptr || !stop->optional) continue;
      if (source)
        context_.diagnostics.warning(
            "TRN-740", word_span(s.line.span, a.pos),
            "the optional stop stops the spindle on the source machine, and it turns on behind this one",
            "write M5 before it where somebody reaches into the machine");
      else
        context_.diagnostics.warning("TRN-741", word_span(s.line.span, a.pos),
                                     "the optional stop of the target stops the spindle, which turns on at the source",
                                     "write M3 or M4 behind it");
    }
  }

  /// Exact stop of one block where the target has the modal one only.
  bool exact_stop(const Statement& s, Block& b, Body& pieces) {
    if (context_.target.exact_stop_block) return false;
    const bool wanted =
        std::erase_if(b.actions, [](const Action& a) { return std::holds_alternative<ExactStopBlock>(a.data); }) != 0;
    const bool moves = b.has_motion && b.motion.moves();
    if (!wanted || !moves) return false;  // of a block that goes nowhere
    if (!context_.target.exact_stop_modal) {
      context_.diagnostics.note("TRN-152", s.line.span, "the target has no exact stop: left out; the path is the same");
      return false;
    }
    if (setting_in<PathMode>(b, facts_.before(s), Setting::path_mode) == PathMode::exact_stop) return false;
    pieces.push_back(path_mode(s.line, PathMode::exact_stop));
    return true;
  }

  void drop_settings(const Statement& s, Block& b) {
    const auto& t = context_.target;
    std::erase_if(b.actions, [&](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      if (m == nullptr) return false;
      switch (m->setting) {
        case Setting::path_mode:
          if (t.exact_stop_modal) return false;
          if (m->value == static_cast<std::uint8_t>(PathMode::exact_stop)) {
            note_once(Setting::path_mode, s, a, "the target has no modal exact stop: left out; the path is the same");
          }
          return true;
        case Setting::retract_plane: return !t.retract_plane_switch;
        case Setting::feed_point:
          if (t.feed_point_switch) return false;
          note_once(Setting::feed_point, s, a,
                    "the target can't choose the point F holds for: left out; the path is the same");
          return true;
        case Setting::feed_override:
          if (t.feed_override_switch) return false;
          note_once(Setting::feed_override, s, a, "the target can't switch the feed override: left out");
          return true;
        default: return false;
      }
    });
    if (t.inverse_time) return;
    for (const auto& a : b.actions) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      if (m != nullptr && m->setting == Setting::feed_mode &&
          m->value == static_cast<std::uint8_t>(FeedMode::inverse_time)) {
        context_.diagnostics.error("TRN-153", word_span(s.line.span, a.pos), "the target has no inverse-time feed",
                                   "program the feed in mm/min");
      }
    }
  }

  void note_once(Setting setting, const Statement& s, const Action& a, std::string text) {
    if (noted_.insert(setting).second)
      context_.diagnostics.note("TRN-151", word_span(s.line.span, a.pos), std::move(text));
  }

  /// A dwell in revolutions under a known speed, `scale` the seconds in one of it; nullopt (reported) otherwise.
  std::optional<Value> seconds_of_revolutions(const Statement& s, const Action& a, const Dwell& d, double& scale) {
    const auto& f = facts_.before(s);
    const auto mode = setting<SpindleMode>(f, Setting::spindle_mode);
    const bool known = f.spindle && *f.spindle > 0 && mode == SpindleMode::rpm;
    if (known && !d.value.literal()) {
      const double each = d.scale * 60 / *f.spindle;
      context_.diagnostics.warning("TRN-154", word_span(s.line.span, a.pos),
                                   "a dwell of computed revolutions is written as " + rounded(each, 4) +
                                       " s for each of them, for " + shortest(*f.spindle) + " rev/min");
      scale = each;
      return d.value;
    }
    if (known) {
      const double seconds = d.value.number * d.scale * 60 / *f.spindle;
      context_.diagnostics.warning("TRN-154", word_span(s.line.span, a.pos),
                                   "a dwell of " + shortest(d.value.number) + " revolutions is written as " +
                                       rounded(seconds, 2) + " s, for " + shortest(*f.spindle) + " rev/min");
      scale = 1;
      return Value{seconds};
    }
    context_.diagnostics.error("TRN-155", word_span(s.line.span, a.pos),
                               "a dwell in spindle revolutions, and the speed is not known here",
                               "program the dwell in seconds");
    return std::nullopt;
  }

  /// False: the action goes away.
  bool dwell(const Routine& routine, const Statement& s, Action& a, Dwell& d, Body& further) {
    const auto& t = context_.target;
    if (d.revolutions && t.dwell_revolutions) return true;
    Value value = d.value;
    double scale = d.scale;
    if (d.revolutions) {
      const auto seconds = seconds_of_revolutions(s, a, d, scale);
      if (!seconds) return true;
      value = *seconds;
    }
    if (!value.literal()) {
      const Value folded = constants_.fold(value, routine, s);
      const auto known = folded.literal() ? std::optional(folded.number) : constant_value(folded.expr);
      if (known && *known * scale > t.dwell_max) value = Value{*known};
      if (!known) tell_longest(s, a);
    }
    if (!value.literal()) {
      d.value = ir::scale(value, scale / t.dwell_unit);
      d.scale = t.dwell_unit;
      d.revolutions = false;
      return true;
    }
    double seconds = value.number * scale;
    if (seconds <= 0) {
      a.text = {};
      return false;  // no dwell at all: nothing is written
    }
    if (seconds < t.dwell_min) {
      context_.diagnostics.warning(
          "TRN-156", word_span(s.line.span, a.pos),
          "a dwell of " + shortest(seconds) + " s is raised to the target's shortest, " + shortest(t.dwell_min) + " s");
      seconds = t.dwell_min;
    }
    if (std::ceil(seconds / t.dwell_max) > most_dwells) {
      context_.diagnostics.error("TRN-742", word_span(s.line.span, a.pos),
                                 "a dwell of " + shortest(seconds) + " s would be more than " + shortest(most_dwells) +
                                     " blocks of the target's longest, " + shortest(t.dwell_max) + " s",
                                 "write a loop around a shorter dwell, or a stop of the program (M0)");
      return true;
    }
    seconds = spread(s, seconds, further);
    const bool same = scale == t.dwell_unit && !d.revolutions && seconds == value.number * scale;
    if (!same) {
      d.value = Value{in_units(s, a, seconds)};
      a.text = {};
    }
    d.scale = t.dwell_unit;
    d.revolutions = false;
    return true;
  }

  double in_units(const Statement& s, const Action& a, double seconds) {
    const double units = seconds / context_.target.dwell_unit;
    if (context_.target.dwell_unit >= 1) return units;
    const double whole = std::max(1.0, std::round(units));
    if (std::fabs(whole - units) > 1e-9 * units) {
      context_.diagnostics.warning("TRN-157", word_span(s.line.span, a.pos),
                                   "a dwell of " + shortest(seconds) + " s is rounded to " +
                                       shortest(whole * context_.target.dwell_unit) + " s");
    }
    return whole;
  }

  /// The source may wait longer than the target's word says.
  void tell_longest(const Statement& s, const Action& a) {
    constexpr double usual = 999;
    if (longest_told_ || context_.target.dwell_max >= usual) return;
    longest_told_ = true;
    context_.diagnostics.warning("TRN-693", word_span(s.line.span, a.pos),
                                 "this dwell is computed, and the target waits " + shortest(context_.target.dwell_max) +
                                     " s at most in one block (said once a program)",
                                 "make sure that it is never longer");
  }

  /// A dwell beyond the largest word becomes several equal ones: all but the first go to `further`. The last one is
  /// what is left, so that rounding does not add up: an hour in parts of up to 99.99 s is 36 times 97.3 s and 97.2 s.
  double spread(const Statement& s, double seconds, Body& further) {
    if (seconds <= context_.target.dwell_max) return seconds;
    const double unit = context_.target.dwell_unit;
    const double step = std::min(unit, 0.01);
    const double n = std::ceil(seconds / context_.target.dwell_max);
    const double each = std::ceil(seconds / n / step - 1e-9) * step;
    for (double i = 1; i < n; ++i) {
      const double part = i + 1 < n ? each : seconds - (n - 1) * each;
      further.push_back(make_block(s.line, action(Dwell{Value{part / unit}, unit, false})));
    }
    return each;
  }

  const LegaliseContext& context_;
  const FactsOf& facts_;
  const HeadConstants constants_;
  std::set<Setting> noted_;
  bool longest_told_;
};

}  // namespace

void convert_dwells(Program& program, const LegaliseContext& context) {
  const FactsOf facts(program, context);
  DwellPass pass(program, context, facts);
  edit_blocks(program, context, [&pass](Editor& e, Statement&& s, Body& out) { pass.block(e, std::move(s), out); });
}

}  // namespace cnctrans::ir::passes
