// The feed along a program, on the source's machine and on the target's: controls keep F over a change of the feed
// mode, keep one F for each mode, or forget it, and they start with a feed or without one.
#pragma once

#include <array>
#include <map>
#include <optional>

#include "legaliser/analysis/facts.h"

namespace cnctrans::ir::passes {

struct FeedState {
  /// Of one feed mode.
  struct Slot {
    std::optional<double> value;  ///< of the source, in program units; none: not known
    bool maybe_none = false;      ///< on some way no F has been given for it
    bool maybe_given = false;     ///< on some way one has
    bool maybe_power_on = false;  ///< on some way it is the feed of power-on
    bool same = true;             ///< the target has the same feed
    bool operator==(const Slot&) const = default;
  };
  std::array<Slot, 3> slots{};
};

/// What a block has to do with the feed beside its own motion.
enum class FeedPoint : std::uint8_t {
  none,
  perhaps,  ///< which cycle is active, and whether one is, depends on the way
  point     ///< a hole is drilled there at the feed in force, or a modal subprogram runs
};

/// A domain of FlowStates.
class FeedDomain {
 public:
  using State = FeedState;
  /// `head_feed`: the translation says the source's power-on feed at its head.
  FeedDomain(const Program& program, const LegaliseContext& context, const FactsOf& facts, bool head_feed);
  [[nodiscard]] State start(const Routine& r, bool called) const;
  void transfer(const Statement& s, State& state) const;
  [[nodiscard]] static bool touches(const Routine& r);
  /// Behind what nobody here has read: whether it has given an F is not known.
  static void unknown(State& state);
  static bool join(State& a, const State& b);

  /// What the modes and F of the block do, without its motion.
  void settle(const Block& b, const Facts& facts, State& state) const;
  /// The block cuts: it moves at feed, or runs a cycle.
  static bool cuts(const Block& b, const Facts& facts);
  /// A later point of a modal cycle, or of a modal subprogram.
  [[nodiscard]] FeedPoint point(const Block& b, const Facts& facts) const;

 private:
  void change_mode(const ModalSet& set, std::optional<std::uint8_t> before, State& state) const;
  void after_point(const Block& b, const Facts& facts, FeedState& state) const;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  bool head_feed_;
  std::map<std::uint32_t, bool> cycles_;  ///< statement of a modal cycle: it runs at the feed in force
};

/// The program asks for the feed in force.
bool reads_feed(const Statement& s);
/// A cut with the power-on feed of the source may come before any F, or a question for the feed.
bool uses_power_on_feed(const Program& program, const LegaliseContext& context, const FactsOf& facts);

}  // namespace cnctrans::ir::passes
