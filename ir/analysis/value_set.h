// Which values an expression can have, where the program says so by itself: for jumps to computed labels.
#pragma once

#include <optional>
#include <vector>

#include "ir/program.h"

namespace cnctrans::ir {

/// The values that `e` can have when it is a constant, or a variable that the program sets to constants only
/// (ascending, each once). nullopt: anything is possible. A value that a variable had before the program started is not
/// counted.
std::optional<std::vector<double>> possible_values(const Program& program, const ExprPtr& e);
/// May a jump to the computed label `l` lead to the block number or identifier on a line? True when nothing is known.
class ComputedLabel {
 public:
  ComputedLabel(const Program& program, const LabelRef& l);
  [[nodiscard]] bool may_be(std::string_view label, bool is_number) const;

 private:
  std::optional<std::vector<double>> values_;
};

}  // namespace cnctrans::ir
