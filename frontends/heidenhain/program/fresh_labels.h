// Names for the labels of a text that stands in the program once more.
#pragma once

#include <set>
#include <span>
#include <string>

#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

/// Of subprograms of a file; what would need more is refused.
inline constexpr int most_copies = 64;

class FreshLabels {
 public:
  explicit FreshLabels(Lowering& lowering);

  /// The labels of these items, and what leads to them, get names that no other label has.
  void rename(std::span<Item> copy);

 private:
  std::string free(const Item& label);

  Lowering& lowering_;
  std::set<std::string> taken_;
};

}  // namespace cnctrans::frontends::heidenhain
