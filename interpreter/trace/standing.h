// What holds on the machine before a statement: for tests that hold an analysis of the program against its run.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "ir/modal.h"
#include "ir/program.h"

namespace cnctrans::interpreter {

struct Standing {
  const ir::ModalState& modal;
  std::span<const double> position;  ///< by axis, mm (radius) or degrees, in the work frame in force
  bool position_open = false;        ///< the end of the last element follows from a later block
  double feed = 0;                   ///< F of the feed mode in force, as programmed
  std::uint8_t master = 1;           ///< the spindle that is chosen
  double spindle = 0;                ///< its S in its mode, in the machine's units
  bool cycle_active = false;
};

/// Called before every statement of the main program that is carried out.
using Witness = std::function<void(const ir::Statement&, const Standing&)>;

}  // namespace cnctrans::interpreter
