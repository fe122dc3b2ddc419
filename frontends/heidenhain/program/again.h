// Texts that are read more than once, each time as where they are called: a subprogram under several tilted planes or
// contours, and a called program that takes its cycle from its caller.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

/// What a program takes from the one that calls it, and leaves to it.
struct Shared {
  bool readable = false;  ///< it can be read as a subprogram
  bool cycle = false, pattern = false, pole = false;
  bool known = false;    ///< what it defines is known, with all that it calls
  bool defines = false;  ///< a cycle
  bool moves = false;
  std::array<bool, along_text> text{};
};

struct Again {
  /// The lines of the subprogram that the item calls, from `first` to `last`, become items behind all others.
  std::function<void(const Item& call, const Span& first, const Span& last)> read;
  /// So do those of a program, as a subprogram with the label of the item.
  std::function<void(const Item& call, const std::string& name)> read_program;
  /// Of a program that can be called.
  std::function<const Shared&(const std::string& name)> look_into;
};

void read_again(Lowering& lowering, const Again& again);

}  // namespace cnctrans::frontends::heidenhain
