// D beside a T on a tool changer counts from the M06 on, with the tool (5.6): the one rule, for whole programs and for
// streams.
#pragma once

#include <string_view>

#include "frontends/fagor/state/state.h"
#include "ir/program.h"

namespace cnctrans::fagor {

/// Goes over the statements in the order of the text.
class WaitingOffset {
 public:
  enum class Step : std::uint8_t {
    nothing,
    begins,   ///< T with its D: the offset waits, to be taken out of the block
    passes,   ///< on the way to the M06
    arrives,  ///< the M06 that the offset comes with
    lost      ///< which M06 it comes with can't be told; the statement itself is still to be looked at
  };
  /// `led_to`: a jump or a repeated part may begin at the statement.
  Step follow(const ir::Statement& s, bool led_to);
  [[nodiscard]] bool waits() const { return waits_; }

  static ir::Action take(ir::Block& block);
  static void put(ir::Block& block, ir::Action offset);

 private:
  [[nodiscard]] Step behind(const ir::Statement& s, bool led_to) const;

  bool waits_ = false;
  bool skipped_ = false;  ///< its block may be skipped
  bool fixed_ = false;    ///< a number: no assignment on the way changes it
};

/// Moves each offset that waits to its M06, in a program that changes tools at all. FAG-052 where it can't be told.
void offsets_with_change(ir::Program& program, LowerState& state);

/// A line of the text may hold an M function that changes the tool on this machine.
bool may_change_tools(std::string_view text, const machine::Profile& profile);

}  // namespace cnctrans::fagor
