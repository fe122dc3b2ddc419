// The length of a tool (equivalences 15): which offset a tool gets that comes without a D, and along which axis its
// length lies in another plane.
#pragma once

#include "ir/block.h"
#include "legaliser/legalise.h"
#include "machine/profile.h"

namespace cnctrans::ir::passes {

/// The machines give other offsets to a tool without a D (option `tool.bare_offset`).
inline bool bare_offsets_differ(const machine::Profile& source, const machine::Profile& target) {
  return source.policies.tool_bare_offset != target.policies.tool_bare_offset;
}
/// On mills the length follows the plane on one of the machines only (option `tool.length_axis`).
inline bool length_axes_differ(const machine::Profile& source, const machine::Profile& target) {
  return source.kind == machine::Kind::mill && source.policies.tool_length_axis != target.policies.tool_length_axis;
}

/// Follows a program block by block: has the tool in the spindle come without a D?
class BareTool {
 public:
  BareTool() = default;
  /// `kept` of the source's option: a D that stands before the change stays there; elsewhere the change takes its own.
  /// `chosen`: a tool has been chosen before, or may have been.
  explicit BareTool(const machine::Profile& source, bool chosen = true)
      : keeps_(source.policies.tool_bare_offset == machine::ToolBareOffset::kept), chosen_(chosen) {}
  /// \return a move uses such a tool, for the first time
  bool follow(const Block& block, const LineInfo& line);
  /// A tool has come without one.
  [[nodiscard]] bool waits() const { return waiting_; }
  /// The D may have been given where it can't be seen.
  void forget() {
    waiting_ = false;
    chosen_ = true;
  }
  /// Where such a tool has come that a move uses: TRN-522.
  void tell(const LegaliseContext& context) const;

 private:
  bool keeps_ = false;
  bool chosen_ = true;              ///< some T stands before: without one a change brings what the machine has ready
  bool given_ = false;              ///< a D since the last T, not left out where that T is not
  bool waiting_ = false;            ///< changed without one
  bool used_ = false;               ///< by a move: the rest does not matter any more
  std::uint16_t chosen_under_ = 0;  ///< the skip levels of the last T
  Span change_;
};

}  // namespace cnctrans::ir::passes
