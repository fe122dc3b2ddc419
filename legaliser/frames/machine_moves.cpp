#include "legaliser/frames/machine_moves.h"

#include <algorithm>

#include "base/text.h"
#include "ir/analysis/flow_states.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

namespace {

/// A domain of FlowStates: on every way the last word of the tool was an offset 0.
class OffDomain {
 public:
  struct State {
    bool off = false;
  };
  [[nodiscard]] static State start(const Routine& /*r*/, bool /*called*/) { return {}; }
  static void transfer(const Statement& s, State& state) {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    for (const auto& a : b->actions) {
      if (const auto* d = std::get_if<ToolOffset>(&a.data)) state.off = d->number.is(0);
      if (std::holds_alternative<ToolSelect>(a.data) || std::holds_alternative<ToolChange>(a.data)) state.off = false;
    }
  }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      found = found || (b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
                          return std::holds_alternative<ToolOffset>(a.data) ||
                                 std::holds_alternative<ToolSelect>(a.data) ||
                                 std::holds_alternative<ToolChange>(a.data);
                        }));
    });
    return found;
  }
  static void unknown(State& state) { state.off = false; }
  static bool join(State& a, const State& b) {
    const bool changed = a.off && !b.off;
    a.off = a.off && b.off;
    return changed;
  }
};

/// A mill that stays where it is along its tool.
bool across(const Block& b, const Facts& facts, const LegaliseContext& context) {
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  if (context.source_machine.kind != machine::Kind::mill || plane != Plane::xy) return false;
  return std::none_of(b.motion.coords.begin(), b.motion.coords.end(),
                      [](const CoordWord& c) { return c.axis != axis::x && c.axis != axis::y; });
}

}  // namespace

MachineMoves::MachineMoves(const Program& program, const LegaliseContext& context, const FactsOf& facts)
    : program_(program), context_(context), facts_(facts) {
  std::set<const Statement*> moves;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&moves](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b != nullptr && b->has_motion && b->motion.frame == FrameUse::machine_with_length) moves.insert(&s);
    });
  }
  if (moves.empty()) return;
  const OffDomain domain;
  const FlowStates<OffDomain> states(program, domain);
  for (const Statement* s : moves) {
    const auto& b = std::get<Block>(s->node);
    const auto* before = states.before(*s);
    OffDomain::State here = before != nullptr ? *before : OffDomain::State{};
    OffDomain::transfer(*s, here);
    if (here.off || across(b, facts.before(*s), context)) without_length_.insert(s->id);
  }
}

bool MachineMoves::fit(Statement& s, Block& b) const {
  if (!words(s, b)) return false;
  const auto& uses = context_.target.frame_uses;
  if (uses.count(b.motion.frame) != 0) return true;
  if (b.motion.frame == FrameUse::machine_with_length && uses.count(FrameUse::machine) != 0) {
    if (!without_length_.contains(s.id))
      context_.diagnostics.warning(
          "TRN-321", word_span(s.line.span, b.motion.frame_pos),
          "a move in machine coordinates that keeps the tool length: the target leaves the length out, so "
          "the slide stands off by the tool length",
          "check the height of this move");
    b.motion.frame = FrameUse::machine;
    return true;
  }
  refuse(s, program_, context_, "TRN-322", "a move in machine coordinates of a kind that the target lacks", {},
         b.motion.frame_pos);
  return false;
}

/// Increments and positions in machine coordinates, by what the modes mean there on both controls. False: refused.
bool MachineMoves::words(Statement& s, Block& b) const {
  if (b.motion.frame == FrameUse::no_programmable) return true;
  const auto positions = [](const machine::Profile& m) {
    return m.policies.machine_move_words == machine::MachineMoveWords::absolute;
  };
  const bool from = positions(context_.source_machine), to = positions(context_.target_machine);
  const Capabilities& t = context_.target;
  for (auto& c : b.motion.coords) {
    if (from && c.mode == WordMode::modal) c.mode = WordMode::absolute;
    const auto d = distance_of(c, b, facts_.before(s));
    if (!to) continue;
    if (d == Distance::incremental) {
      refuse(s, program_, context_, "TRN-322", "an incremental move in machine coordinates, which the target lacks",
             "write the position in machine coordinates", c.pos);
      return false;
    }
    if (!d) {
      context_.diagnostics.warning(
          "TRN-321", word_span(s.line.span, c.pos),
          "whether this word in machine coordinates is absolute depends on the path that leads here; the target "
          "takes it as a machine position",
          "write the distance mode before this move");
    }
    const bool by_block = !t.distance_per_word && !t.distance_inside_block;
    c.mode = by_block ? WordMode::modal : WordMode::absolute;
  }
  return true;
}

}  // namespace cnctrans::ir::passes
