// Rotary positions whose sign is the direction of turning, for targets that write the direction as a word: a computed
// position becomes a branch, one block for each direction.
#include <algorithm>
#include <memory>

#include "legaliser/analysis/words.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

class DirectionPass {
 public:
  DirectionPass(Program& program, const LegaliseContext& context)
      : program_(program), context_(context), facts_(program, context) {}

  void routine(Routine& r) {
    uses_ = label_uses(program_, r);
    body(r.body);
  }

 private:
  void body(Body& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      Statement& s = list[i];
      each_body(s, [this](Body& inner) { body(inner); });
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion || b->repeat_given != 0 || ends_range(s)) continue;
      const Facts facts = facts_.before(s);
      const auto at = computed(*b, facts);
      if (!at) continue;
      context_.diagnostics.note("TRN-180", word_span(s.line.span, b->motion.coords[*at].pos),
                                "the sign of a computed rotary position is the direction of turning: written as two "
                                "blocks, one for each direction",
                                "keep the value below 360 degrees");
      s.node = branch(std::get<Block>(std::move(s.node)), *at, facts, s.line);
      s.line.joined = false;
      if (i + 1 < list.size()) list[i + 1].line.joined = false;
    }
  }

  [[nodiscard]] bool ends_range(const Statement& s) const {
    return !s.line.number.empty() && uses_.is_end({std::string(s.line.number), true, nullptr});
  }

  /// The first position that needs it.
  static std::optional<std::size_t> computed(const Block& b, const Facts& facts) {
    for (std::size_t i = 0; i < b.motion.coords.size(); ++i) {
      const CoordWord& w = b.motion.coords[i];
      if (w.direction == RotaryDirection::by_sign && !w.value.literal() &&
          distance_of(w, b, facts) == Distance::absolute)
        return i;
    }
    return std::nullopt;
  }

  /// -0 turns backwards to 0: of `-e` only a negative `e` turns forwards.
  static If branch(Block b, std::size_t at, const Facts& facts, const LineInfo& like) {
    const ExprPtr value = as_expr(b.motion.coords[at].value);
    const auto* minus = std::get_if<Unary>(&value->node);
    const bool turned = minus != nullptr && minus->op == UnaryOp::negate;
    const ExprPtr size = turned ? minus->operand : value;
    If node;
    node.condition = binary(BinaryOp::ge, size, number(0));
    node.has_else = true;
    node.then_body.push_back(block(b, at, size, turned, facts, like));
    node.else_body.push_back(block(b, at, unary(UnaryOp::negate, size), !turned, facts, like));
    return node;
  }

  static Statement block(Block b, std::size_t at, ExprPtr value, bool backwards, const Facts& facts,
                         const LineInfo& like) {
    CoordWord& w = b.motion.coords[at];
    w.value = Value{std::move(value)};
    w.direction = backwards ? RotaryDirection::negative : RotaryDirection::positive;
    if (const auto next = computed(b, facts)) return made(like, branch(std::move(b), *next, facts, like));
    return made(like, std::move(b));
  }

  Program& program_;
  const LegaliseContext& context_;
  FactsOf facts_;
  LabelUses uses_;
};

}  // namespace

void choose_directions(Program& program, const LegaliseContext& context) {
  if (context.target_machine.policies.rotary_direction != machine::RotaryDirection::in_word) return;
  DirectionPass pass(program, context);
  for (auto& r : program.routines) pass.routine(r);
}

}  // namespace cnctrans::ir::passes
