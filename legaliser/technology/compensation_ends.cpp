// Radius compensation begins and ends in a straight move on every control (equivalences 16): the function that begins
// or ends it may stand in the block of that move or before it, an arc may not follow.
#include <vector>

#include "ir/motion_kinds.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/refuse.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

const Action* comp_action(const Block& b) {
  for (const auto& a : b.actions) {
    if (const auto* m = std::get_if<ModalSet>(&a.data); m != nullptr && m->setting == Setting::comp) return &a;
  }
  return nullptr;
}

/// A change of the compensation and the arc that follows it in the text; both may be in one block.
struct Meeting {
  Statement* change;
  Statement* arc;
};

class MeetingSearch {
 public:
  void body(Body& statements) {
    for (auto& s : statements) {
      if (auto* b = std::get_if<Block>(&s.node)) block(s, *b);
      each_body(s, [this](Body& inner) { body(inner); });
    }
  }
  std::vector<Meeting> found;

 private:
  void block(Statement& s, const Block& b) {
    if (comp_action(b) != nullptr) change_ = &s;
    if (!b.has_motion) return;
    if (b.motion.kind != MotionKind::modal) kind_ = b.motion.kind;
    if (!b.motion.moves()) return;
    if (change_ != nullptr && is_any_arc(kind_)) found.push_back({change_, &s});
    change_ = nullptr;
  }
  Statement* change_ = nullptr;
  MotionKind kind_ = MotionKind::modal;  ///< of the text
};

}  // namespace

void check_compensation_ends(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;
  MeetingSearch search;
  for (auto& r : program.routines) search.body(r.body);
  if (search.found.empty()) return;
  const FactsOf facts(program, context);
  for (const auto& m : search.found) {
    const Block& arc = std::get<Block>(m.arc->node);
    const auto kind = motion_in(arc, facts.before(*m.arc));
    if (kind && !is_any_arc(*kind)) continue;
    Block& change = std::get<Block>(m.change->node);
    const Facts& before = facts.before(*m.change);
    const auto side = setting<CompSide>(before, Setting::comp),
               now = setting_in<CompSide>(change, before, Setting::comp);
    if (side == CompSide::off && now == CompSide::off) {  // nothing ends there
      std::erase_if(change.actions, [](const Action& a) {
        const auto* set = std::get_if<ModalSet>(&a.data);
        return set != nullptr && set->setting == Setting::comp;
      });
      settle(*m.change);
      continue;
    }
    refuse(*m.arc, program, context, "TRN-400",
           now == CompSide::off ? "radius compensation ends with an arc: no control takes that"
                                : "radius compensation begins with an arc: no control takes that",
           "put a straight move between G40, G41 or G42 and the arc", arc.motion.code_pos);
  }
}

}  // namespace cnctrans::ir::passes
