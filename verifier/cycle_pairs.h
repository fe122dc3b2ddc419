// Finds the cycles of the two runs that stand at the same place of the comparison.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "verifier/similar.h"

namespace cnctrans::verifier {

/// A place in the two normalised traces.
struct PairPlace {
  std::size_t i = 0, j = 0;
  interpreter::Position from_a, from_b;  ///< where the tools stand
};

class CyclePairs {
 public:
  /// The normalised traces, and the first events of the traces before that.
  CyclePairs(const std::vector<const interpreter::Event*>& a, const std::vector<const interpreter::Event*>& b,
             const interpreter::Event* first_a, const interpreter::Event* first_b, const Options& options)
      : a_(a), b_(b), first_a_(first_a), first_b_(first_b), options_(options) {}

  /// The cycle of the source whose first event this is; null: none.
  [[nodiscard]] const interpreter::CycleRun* begins(std::size_t i) const;
  /// The comparison stopped at `now` and had come by the start of `run` at `start`: it is about this cycle.
  [[nodiscard]] bool about(const interpreter::CycleRun& run, const PairPlace& start, const PairPlace& now) const;
  /// Compares the cycle with the one of the translation that begins there, by what they leave. The place behind both;
  /// nullopt with a sentence, or without one when the translation has no cycle there.
  std::optional<PairPlace> skip(const interpreter::CycleRun& run, const PairPlace& start, double& max_length,
                                std::string& what) const;

 private:
  [[nodiscard]] std::size_t number(const interpreter::Event* e, bool source) const {
    return static_cast<std::size_t>(e - (source ? first_a_ : first_b_));
  }
  /// The cycle to which rapid moves lead from there; null: none.
  [[nodiscard]] const interpreter::CycleRun* next_run(std::size_t k, bool source) const;
  /// What the translation's next cycle is to `source` and `target`: one in the same pocket, slots or tap, and whether
  /// the source's next is one there, too.
  enum class Next { elsewhere, here, here_of_both };
  [[nodiscard]] Next next_cycle(const CyclePasses& source, const CyclePasses& target, const PairPlace& at) const;
  [[nodiscard]] const interpreter::CycleRun* run_at(std::size_t j, bool source) const;

  const std::vector<const interpreter::Event*>&a_, &b_;
  const interpreter::Event *first_a_, *first_b_;
  const Options& options_;
};

}  // namespace cnctrans::verifier
