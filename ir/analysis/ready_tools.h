// Which tool a change brings: the one that was chosen last on every way to it.
#pragma once

#include <map>
#include <optional>

#include "ir/program.h"

namespace cnctrans::ir {

struct ReadyTool {
  std::optional<ToolSelect> tool;  ///< chosen last; none: not chosen yet, or unsure
  bool unsure = false;             ///< the ways disagree, or it was chosen elsewhere
  bool changed = false;            ///< a change has brought it since
};

class ReadyTools {
 public:
  /// Of a whole program; its statements must have ids.
  explicit ReadyTools(const Program& program);
  [[nodiscard]] ReadyTool before(const Statement& s) const;

 private:
  std::map<std::uint32_t, ReadyTool> before_;
};

}  // namespace cnctrans::ir
