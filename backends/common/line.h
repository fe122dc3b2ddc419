// One line of the target while it is collected: pieces (words) with the place they had in the source, if any.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "backends/common/style.h"
#include "base/span.h"

namespace cnctrans::backends {

/// Pieces are joined with one blank. Those with a source column stand in the order of their columns; the others are
/// put before the first piece of a higher rank, in the order they came.
class Line {
 public:
  void add(std::string text, Rank rank, WordPos pos = {}) { pieces_.push_back({std::move(text), rank, pos.column}); }
  /// True when a piece with this (known) source column is there: a source word that became several actions is written
  /// once.
  [[nodiscard]] bool has_column(std::uint32_t column) const;
  [[nodiscard]] bool empty() const { return pieces_.empty(); }
  void clear() { pieces_.clear(); }
  [[nodiscard]] std::string text(bool by_rank) const;

 private:
  struct Piece {
    std::string text;
    Rank rank;
    std::uint32_t column;
  };
  std::vector<Piece> pieces_;
};

}  // namespace cnctrans::backends
