// Which moves call the cycle that follows them: L X+10 Y+20 R0 FMAX M99.
#pragma once

#include <map>
#include <set>

#include "backends/common/labels.h"
#include "ir/program.h"

namespace cnctrans::backends::heidenhain {

class CallPlan {
 public:
  CallPlan(const ir::Program& program, const LabelUse& use);

  /// The statement with the call behind this move; null: none.
  [[nodiscard]] const ir::Statement* call_behind(const ir::Statement& move) const;
  /// The move before it calls it.
  [[nodiscard]] bool is_called(const ir::Statement& call) const { return called_.count(call.id) != 0; }
  /// Its end of the shift is part of the cycle 247 behind it.
  [[nodiscard]] bool is_taken_back(const ir::Statement& shift) const { return taken_back_.count(shift.id) != 0; }

 private:
  std::map<std::uint32_t, const ir::Statement*> calls_;
  std::set<std::uint32_t> called_, taken_back_;
};

/// The cycle of a block that runs one and does nothing else.
const ir::CycleDefine* lone_call(const ir::Statement& s);

}  // namespace cnctrans::backends::heidenhain
