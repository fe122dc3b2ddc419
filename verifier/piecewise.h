// Compares two long traces piece by piece, so that neither has to be kept.
#pragma once

#include <cstddef>
#include <vector>

#include "verifier/compare.h"

namespace cnctrans::verifier {

/// Takes the events of both sides as they come. A piece ends behind a straight move that both sides make as the n-th of
/// the piece, to the same place, as well as the moves around it; the state that holds there goes ahead of the next one.
class PiecewiseComparison {
 public:
  explicit PiecewiseComparison(Options options) : options_(std::move(options)) {}

  std::vector<interpreter::Event> source, target;  ///< not compared yet; to be added to

  /// Compares what can be. False: a difference, or no place where a piece could end. Then this comparison says nothing.
  [[nodiscard]] bool advance();
  /// Compares the rest; false as above.
  [[nodiscard]] bool finish();
  /// Of all pieces, when all went well.
  [[nodiscard]] const Verdict& verdict() const { return verdict_; }

 private:
  using Events = std::vector<interpreter::Event>;
  [[nodiscard]] bool compare_piece(Events a, Events b);
  void keep_state(const Events& piece, Events& rest, std::size_t& kept) const;

  Options options_;
  Verdict verdict_;
  std::size_t kept_source_ = 0, kept_target_ = 0;  ///< events that only say the state, ahead of the others
  bool first_ = true;
};

}  // namespace cnctrans::verifier
