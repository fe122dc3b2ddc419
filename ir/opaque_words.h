// What a word kept as text may do: told by the place at which it is carried out.
#pragma once

#include "ir/block.h"

namespace cnctrans::ir {

/// A word that leaves the programmed path and the modal state alone (dynamics, accuracy, corners of the compensated
/// path) is carried `with` the motion of its block; one that could do more stands `before` it, and what follows it is
/// not known. `after` it stands what belongs to the tool: positions are as programmed, a translation refuses the word.
inline bool leaves_path_alone(const Action& a) {
  return a.order == Order::with && std::holds_alternative<OpaqueWord>(a.data);
}

}  // namespace cnctrans::ir
