// Rotary positions whose direction the source says, on an axis that is a plain coordinate here (manual 3.7).
#include "backends/fagor/writer.h"

namespace cnctrans::backends::fagor {

void say_rotary(std::string_view axis, const Span& at, Diagnostics& diagnostics) {
  diagnostics.warning("TRN-480", at,
                      "the words of the rotary axis " + std::string(axis) +
                          " are written as plain coordinates; on a rollover axis of the target the sign of an "
                          "absolute word is the direction of turning (said once a program)",
                      "compare the direction of every rotary move on the target's machine");
}

/// The position with its turns, where an absolute word of the source says the direction by its sign and the axis here
/// is a plain coordinate.
std::optional<double> Writer::counted_place(const ir::CoordWord& w) {
  const bool absolute =
      w.mode == ir::WordMode::absolute ||
      (w.mode == ir::WordMode::modal && known<ir::Distance>(ir::Setting::distance) == ir::Distance::absolute);
  if (rollover() || same_dialect() || !absolute || !w.value.literal()) return std::nullopt;
  if (!rotary_places_) rotary_places_.emplace(program(), profile().power_on);
  return rotary_places_->target(current().id, w.axis);
}

void Writer::tell_counted(const ir::CoordWord& w) {
  if (rotary_told_) return;
  rotary_told_ = true;
  diagnostics().warning("TRN-483", span_of(w.pos),
                        "the sign of a rotary position is its direction in the source; here the axis is a plain "
                        "coordinate, and the turns are counted from 0 at the start (said once a program)",
                        "turn the axis to 0 before the program, or set the option fagor.rotary_rollover to yes");
}

}  // namespace cnctrans::backends::fagor
