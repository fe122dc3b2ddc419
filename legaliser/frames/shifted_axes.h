#pragma once

#include <array>
#include <optional>

#include "ir/axis.h"

namespace cnctrans::ir::passes {

/// The programmed shift along straight text, in numbers, and where the axes stood before it changed.
struct Shifted {
  std::array<std::optional<double>, axis::count_max> shift{}, at{}, moved{};
  bool turned = true;  ///< a rotation, or something else than a shift, may be in force
  void clear_all() {
    shift.fill(std::nullopt);
    at.fill(std::nullopt);
    moved.fill(std::nullopt);
    turned = true;
  }
  void start() {
    clear_all();
    shift.fill(0);
    moved.fill(0);
    turned = false;
  }
};

}  // namespace cnctrans::ir::passes
