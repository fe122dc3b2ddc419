// Rotary positions for a target on which the sign of a position is the direction of turning: a plain coordinate, the
// shortest way and a direction by a word get the sign of the way to them.
#include <cmath>

#include "legaliser/analysis/words.h"
#include "legaliser/early_passes.h"

namespace cnctrans::ir::passes {

namespace {

constexpr double full_turn = 360;

class SignedTurns {
 public:
  SignedTurns(Program& program, const LegaliseContext& context, std::string letters)
      : context_(context), facts_(program, context), letters_(std::move(letters)) {}

  void statement(Statement& s) {
    auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr || !b->has_motion || b->repeat_given != 0) return;
    // On the face and the cylinder of a turning part a word of C may be a length.
    if (setting<Surface>(facts_.before(s), Setting::surface) != Surface::none) return;
    for (auto& c : b->motion.coords) {
      const bool signed_axis = is_rotary_letter(c.axis) && letters_.find(fixed_axis_name(c.axis)) != std::string::npos;
      if (!signed_axis || c.direction == RotaryDirection::by_sign || !c.value.literal()) continue;
      if (distance_of(c, *b, facts_.before(s)) == Distance::absolute) position(s, *b, c);
    }
  }

 private:
  void position(const Statement& s, const Block& b, CoordWord& c) {
    const double to = c.value.number;
    if (c.direction == RotaryDirection::positive || c.direction == RotaryDirection::negative)
      return turn_to(c, to, c.direction == RotaryDirection::negative);
    const auto from = b.motion.frame == FrameUse::normal ? facts_.before(s).position[c.axis] : std::nullopt;
    const bool shortest = c.direction == RotaryDirection::shortest;
    if (!from) {
      if (!shortest && to >= 0 && to < full_turn) warn(s, c);
      return;  // the writer refuses the others
    }
    const double way = shortest ? std::remainder(to - *from, full_turn) : to - *from;
    if (shortest && std::fabs(way) == full_turn / 2) return;
    if (way != 0 && std::fabs(way) < full_turn) return turn_to(c, to, way < 0);
    c.direction = RotaryDirection::as_value;
    c.mode = WordMode::incremental;
    c.value = Value(way);
  }

  /// The position between 0 and 360 degrees; -0 turns backwards to 0.
  static void turn_to(CoordWord& c, double to, bool backwards) {
    const double rest = std::fmod(to, full_turn), at = rest < 0 ? rest + full_turn : rest + 0.0;
    c.direction = RotaryDirection::by_sign;
    if (backwards)
      c.value = Value(-at);
    else if (at != to || std::signbit(to))  // -0 of the source is no direction
      c.value = Value(at);
  }

  void warn(const Statement& s, const CoordWord& c) {
    context_.diagnostics.warning("TRN-552", word_span(s.line.span, c.pos),
                                 "on the target a position without a sign is reached in the positive direction; where "
                                 "the rotary axis stands before is not known here",
                                 "check the direction on the machine, or turn the axis to a known position before");
  }

  const LegaliseContext& context_;
  const FactsOf facts_;
  std::string letters_;
};

}  // namespace

void write_signed_turns(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;
  const std::string& letters = context.target_machine.policies.rotary_signed_axes;
  if (letters.empty()) return;
  SignedTurns pass(program, context, letters);
  for (auto& r : program.routines) for_each_statement(r.body, [&pass](Statement& s) { pass.statement(s); });
}

}  // namespace cnctrans::ir::passes
