// Gear ranges (equivalences 14.2): some controls have none in force at power-on, and the spindle waits for one. Where
// the source starts the spindle without a range of its own, the one of the target's profile is said.
#include <algorithm>
#include <charconv>

#include "ir/analysis/flow_states.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// A domain of FlowStates: has a gear range been said?
class GearDomain {
 public:
  enum class Said : std::uint8_t { no, yes, perhaps };
  struct State {
    Said said = Said::no;
  };

  /// A subprogram that nothing at hand calls leaves the range to its caller.
  [[nodiscard]] static State start(const Routine& r, bool called) {
    return {!called && r.kind == RoutineKind::main ? Said::no : Said::yes};
  }
  static void transfer(const Statement& s, State& state) {
    if (const auto* b = std::get_if<Block>(&s.node); b != nullptr && says(*b)) state.said = Said::yes;
  }
  [[nodiscard]] static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && says(*b));
    });
    return found;
  }
  static void unknown(State& state) {
    if (state.said == Said::no) state.said = Said::perhaps;
  }
  static bool join(State& a, const State& b) {
    if (a.said == b.said || a.said == Said::perhaps) return false;
    a.said = Said::perhaps;
    return true;
  }

  /// Starts the main spindle.
  static bool starts(const Action& a) {
    const auto* run = std::get_if<SpindleRun>(&a.data);
    return run != nullptr && run->state != SpindleState::off && run->number == 1;
  }

 private:
  /// Behind a start the range is there in any case: this pass says it where the source does not.
  static bool says(const Block& b) {
    return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
      const auto* g = std::get_if<SpindleGear>(&a.data);
      return starts(a) || (g != nullptr && !g->automatic && g->number == 1);
    });
  }
};

class Gears {
 public:
  Gears(Program& program, const LegaliseContext& context)
      : program_(program), context_(context), option_(context.target_machine.dialect + ".default_gear") {}

  void run() {
    if (!read_option()) return;
    replace_automatic();
    number_statements(program_);
    const FlowStates<GearDomain> states(program_, GearDomain{});
    std::vector<Statement*> bare;
    bool unsure = false;
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [&](Statement& s) {
        const auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr || !needs(*b)) return;
        const auto* before = states.before(s);
        if (before == nullptr || before->said == GearDomain::Said::yes) return;
        unsure = unsure || before->said == GearDomain::Said::perhaps;
        bare.push_back(&s);
      });
    }
    if (bare.empty()) return;
    report(*bare.front());
    if (m_ == nullptr) return;
    if (unsure) return at_head();
    for (Statement* s : bare) beside(std::get<Block>(s->node));
  }

 private:
  /// False: the profile says that the machine has no ranges.
  bool read_option() {
    const auto& machine = context_.target_machine;
    word_ = machine.policies.spindle_default_gear;
    if (word_.empty()) return false;
    std::int32_t code = -1;
    std::from_chars(word_.data() + 1, word_.data() + word_.size(), code);
    m_ = machine.m_code(code);
    if (m_ != nullptr && m_->meaning != machine::MMeaning::gear) m_ = nullptr;
    return true;
  }

  /// A range in the block itself counts where it stands before the start.
  static bool needs(const Block& b) {
    for (const auto& a : b.actions) {
      const auto* g = std::get_if<SpindleGear>(&a.data);
      if (g != nullptr && g->number == 1 && a.order != Order::after) return false;
    }
    return std::any_of(b.actions.begin(), b.actions.end(), GearDomain::starts);
  }

  void replace_automatic() {
    if (m_ == nullptr) return;
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [this](Statement& s) {
        auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr) return;
        for (auto& a : b->actions) {
          auto* g = std::get_if<SpindleGear>(&a.data);
          if (g == nullptr || !g->automatic) continue;
          context_.diagnostics.warning("TRN-391", word_span(s.line.span, a.pos),
                                       "the automatic choice of the gear range has no counterpart on the target: " +
                                           word_ + " of its profile (" + option_ + ") is written",
                                       "write the range that the speeds behind this block need");
          *g = SpindleGear{g->number, m_->argument, false};
          a.order = m_->order;
        }
      });
    }
  }

  void report(const Statement& first) const {
    if (m_ == nullptr) {
      context_.diagnostics.warning(
          "TRN-390", first.line.span,
          "no gear range is in force where the spindle starts here; the target has none at "
          "power-on, and " +
              word_ + " (" + option_ + ") is no gear range of its profile",
          "name a gear range of the machine in the profile, or an empty one where it has none");
      return;
    }
    context_.diagnostics.note("TRN-390", first.line.span,
                              "no gear range is in force where the spindle starts here; the target has none at "
                              "power-on: " +
                                  word_ + " of its profile (" + option_ + ") is written");
  }

  Action gear() const { return action(SpindleGear{1, m_->argument, false}, m_->order); }

  /// M03 M41: the range stands beside the start.
  void beside(Block& b) const {
    const auto at = std::find_if(b.actions.begin(), b.actions.end(), GearDomain::starts);
    Action made = gear();
    if (at->pos.column != 0) made.pos = {at->pos.column + 1, 0};  // a word of its own, between that one and the next
    b.actions.insert(at + 1, std::move(made));
  }

  /// Some ways come with a range: those change it again behind the head.
  void at_head() const {
    for (auto& r : program_.routines) {
      if (r.kind == RoutineKind::main) r.body.insert(below_head(r.body), make_block(LineInfo{}, gear()));
    }
  }

  Program& program_;
  const LegaliseContext& context_;
  std::string option_, word_;
  const machine::MCode* m_ = nullptr;  ///< of the profile; none: not a gear range there
};

/// A range that the machine of the target lacks: its control chooses one.
void leave_missing_ranges(Program& program, const LegaliseContext& context) {
  const auto& codes = context.target_machine.m_codes;
  const auto gear = [](const machine::MCode& m) { return m.meaning == machine::MMeaning::gear; };
  if (std::none_of(codes.begin(), codes.end(), gear)) return;
  const auto has = [&](std::int32_t range) {
    const bool there = std::any_of(codes.begin(), codes.end(),
                                   [&](const machine::MCode& m) { return gear(m) && m.argument == range; });
    return there && (range > 0 || context.target.gear_needed);  // elsewhere the code of range 0 means the choice
  };
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (auto& a : b->actions) {
        auto* g = std::get_if<SpindleGear>(&a.data);
        if (g == nullptr || g->automatic || g->number != 1 || has(g->gear)) continue;
        context.diagnostics.warning("TRN-391", word_span(s.line.span, a.pos),
                                    "the target has no gear range " + std::to_string(g->gear) +
                                        ": its control chooses one by the speed, or the "
                                        "range in force stays",
                                    "write the range that the speeds behind this block need");
        g->automatic = true;
        a.text = {};
      }
    });
  }
}

}  // namespace

void choose_gears(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;
  leave_missing_ranges(program, context);
  if (!context.target.gear_needed) return;
  Gears(program, context).run();
}

}  // namespace cnctrans::ir::passes
