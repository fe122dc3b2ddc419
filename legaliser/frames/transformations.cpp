// Positions in the coordinates of a transformation of the source's machine (five axes, an inclined axis, the C axis)
// that the target is not given.
#include <algorithm>

#include "ir/edit/search.h"
#include "legaliser/analysis/words.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/refuse.h"

namespace cnctrans::ir::passes {

namespace {

/// The target has no such coordinates.
bool lacks(const Capabilities& target, const Action& a) {
  const auto* set = std::get_if<SurfaceSet>(&a.data);
  if (set == nullptr || set->surface == Surface::none) return false;
  return set->surface == Surface::tool || target.surfaces == SurfaceForm::none;
}

/// The word that ends a refused transformation goes with it, and with all that it does to the frames.
void drop_end(Block& b) {
  const auto ends = [](const Action& a) { return std::holds_alternative<SurfaceSet>(a.data); };
  const WordPos word = std::find_if(b.actions.begin(), b.actions.end(), ends)->pos;
  std::erase_if(b.actions, [&word](const Action& a) { return a.pos == word; });
}

}  // namespace

void refuse_transformations(Program& program, const LegaliseContext& context) {
  const auto refused = [&context](const Action& a) { return lacks(context.target, a); };
  if (program.dialect == context.target.dialect || !any_action(program, refused)) return;
  const FactsOf facts(program, context);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      const auto* set = b != nullptr ? action_in<SurfaceSet>(*b) : nullptr;
      if (set == nullptr) return;
      const auto begins = std::find_if(b->actions.begin(), b->actions.end(), refused);
      if (begins != b->actions.end()) {
        const bool c_axis = set->surface != Surface::tool;
        refuse(s, program, context, "TRN-454",
               c_axis ? "work with the C axis on the face or the cylinder has no counterpart here"
                      : "from here on the positions are those of a transformation of the machine, which the target is "
                        "not told",
               "write the part up to its end for the target by its own means", begins->pos);
      } else if (set->surface == Surface::none && !context.options.goes_on) {
        const auto before = setting<Surface>(facts.before(s), Setting::surface);
        if (before && !lacks(context.target, action(SurfaceSet{*before, {}}))) return;
        drop_end(*b);
        settle(s);
      }
    });
  }
}

}  // namespace cnctrans::ir::passes
