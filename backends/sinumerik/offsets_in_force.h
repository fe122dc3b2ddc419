// Which tool offset is in force before a statement, on every way that leads there.
#pragma once

#include <vector>

#include "ir/analysis/flow_states.h"

namespace cnctrans::backends::sinumerik {

/// What may be in force: one of the offsets that the program selects, that of the start of the program, or the one that
/// the control selects with a tool.
struct OffsetsInForce {
  std::vector<ir::Value> words;
  bool at_start = false, by_tool = false;
  bool open = false;  ///< on some way another program, or text that is only kept, has had its say

  [[nodiscard]] bool certain() const {
    return words.size() == 1 && words[0].literal() && !at_start && !by_tool && !open;
  }
};

class OffsetDomain {
 public:
  using State = OffsetsInForce;
  explicit OffsetDomain(const ir::Program& program);
  [[nodiscard]] State start(const ir::Routine& r, bool called) const;
  static void transfer(const ir::Statement& s, State& state);
  [[nodiscard]] bool touches(const ir::Routine& /*r*/) const { return true; }
  void unknown(State& state) const { state = anything_; }
  static bool join(State& a, const State& b);

 private:
  State anything_;
};

}  // namespace cnctrans::backends::sinumerik
