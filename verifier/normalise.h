// Brings a trace into the form in which two traces are compared.
#pragma once

#include <vector>

#include "interpreter/trace/trace.h"

namespace cnctrans::verifier {

/// What splits a trace into stretches: inside a stretch the order of state changes (spindle, coolant, tool, ...) is
/// free, across a barrier it is not.
[[nodiscard]] bool is_barrier(interpreter::EventKind k);
[[nodiscard]] bool is_motion(interpreter::EventKind k);
/// A motion with feed along a line or an arc.
[[nodiscard]] inline bool cuts(const interpreter::Event& e) {
  return e.kind == interpreter::EventKind::linear || e.kind == interpreter::EventKind::arc;
}

/// Drops commands that change nothing (the spindle already runs so, the coolant is already so, the same offset or
/// compensation side again) and orders the state changes of each stretch by kind, keeping the order inside a kind.
/// The senses of the spindle inside a tap (a thread and back along it) follow from the path and are not compared; the
/// sense that stays is, where the tool cuts again.
/// `keep_selections`: tools that are only made ready; a turret has no such event.
std::vector<const interpreter::Event*> normalise(const std::vector<interpreter::Event>& events, bool keep_offsets,
                                                 bool keep_selections, bool keep_messages);
/// Axes of the source whose offset can be compared. A length compensation that is off has no counterpart on a control
/// without that switch (`switches`): the translator tells it (TRN-142, TRN-143), and what the source means is left
/// open.
[[nodiscard]] inline std::uint32_t known_of_source(const interpreter::Event& e, bool switches) {
  return switches ? e.offset.known : e.offset.known & ~e.offset.switched_off;
}

}  // namespace cnctrans::verifier
