// TOOL CALL says the tool, its axis and the speed at once; other languages say them in several words and blocks. What
// each tool word of a program becomes.
#pragma once

#include <map>
#include <set>

#include "backends/common/labels.h"
#include "ir/analysis/ready_tools.h"
#include "ir/program.h"

namespace cnctrans::backends::heidenhain {

class ToolPlan {
 public:
  ToolPlan(const ir::Program& program, const LabelUse& use);

  /// The tool that this change brings; null: the text does not tell.
  [[nodiscard]] const ir::ToolSelect* tool_of(const ir::Action& change) const;
  /// The speed that stands in the same TOOL CALL; null: none.
  [[nodiscard]] const ir::SetSpindle* speed_of(const ir::Action& change) const;
  /// It stands in the TOOL CALL before it.
  [[nodiscard]] bool speed_is_said(const ir::Action& speed) const { return said_.count(&speed) != 0; }
  /// The choice is its change as well, or the change follows before anything else happens.
  [[nodiscard]] bool said_with_change(const ir::Action& select) const { return said_.count(&select) != 0; }
  /// No offset, and a move may follow before the next tool or offset.
  [[nodiscard]] bool offset_off_matters(const ir::Action& offset) const { return matters_.count(&offset) != 0; }

 private:
  void routine(std::size_t index, const LabelUse& use);
  void find_speed(const ir::Body& body, std::size_t at, std::size_t action, std::size_t routine, const LabelUse& use);
  void offsets_off();

  const ir::Program& program_;
  const ir::ReadyTools ready_;
  std::map<const ir::Action*, ir::ToolSelect> tools_;
  std::map<const ir::Action*, const ir::SetSpindle*> speeds_;
  std::set<const ir::Action*> said_, matters_;
};

}  // namespace cnctrans::backends::heidenhain
