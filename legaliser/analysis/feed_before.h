// The feed that stands behind a cycle with feeds of its own: the one before it, or none where no F has been given yet.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>

#include "legaliser/analysis/facts.h"

namespace cnctrans::ir::passes {

struct FeedBefore {
  std::optional<double> value;  ///< program units, when it is known
  /// Surely none has been given: there is nothing to restore but behind a tap whose pitch the target takes as F.
  bool none = false;
  std::optional<Value> computed;  ///< the word that gave it, when that is no number and still says the same
  /// The F of millimetres per minute, where the control has kept it while another feed mode is in force.
  std::optional<double> per_minute;
  [[nodiscard]] std::optional<Value> word() const { return value ? std::optional(Value{*value}) : computed; }
};

/// Of the whole program as it is when this is made; statements must have ids.
class FeedsBefore {
 public:
  FeedsBefore(const Program& program, const LegaliseContext& context);
  ~FeedsBefore();
  FeedsBefore(const FeedsBefore&) = delete;
  FeedsBefore& operator=(const FeedsBefore&) = delete;
  /// Behind the F of the block itself. `b`: the block of `s`, perhaps without its motion.
  [[nodiscard]] FeedBefore at(const Statement& s, const Block& b, const Facts& facts) const;
  /// The statements that define a tap with its pitch, modal ones: on some targets the pitch is an F.
  [[nodiscard]] const std::set<std::uint32_t>& taps() const;

 private:
  struct Analysis;
  std::unique_ptr<Analysis> analysis_;
};

}  // namespace cnctrans::ir::passes
