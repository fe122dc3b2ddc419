#include <utility>

#include "frontends/fagor/program/finish_parts.h"
#include "ir/analysis/domains/mirrored_presets.h"

namespace cnctrans::fagor {

void set_presets_past_mirrors(ir::Program& program, LowerState& state) {
  const auto& options = state.profile().options;
  if (!state.facts.preset || state.options().g92_mirror == dialects::fagor::PresetOfMirror::through) return;
  bool told = options.count("fagor.g92_mirror") != 0;
  ir::passes::presets_past_mirrors(
      program,
      [&](const ir::Statement& s) {
        state.set_line(s.line.span);
        state.error("FAG-103", {}, "whether this axis is mirrored at G92 depends on the way that leads here",
                    "write G10 before the block, and the mirror image again behind it");
      },
      [&](const ir::Statement& s) {
        if (std::exchange(told, true)) return;
        state.set_line(s.line.span);
        state.warning("FAG-103", {},
                      "G92 under a mirror image: the origin is set as without it, so that behind the block a mirrored "
                      "axis stands at the opposite of the value",
                      "compare with the machine; set the option fagor.g92_mirror (untouched, through) in its profile");
      });
}

}  // namespace cnctrans::fagor
