// What labels are told apart by.
#pragma once

#include <string>
#include <utility>

#include "ir/statement.h"

namespace cnctrans::ir {

/// A block number, or a name, and its text.
using LabelName = std::pair<bool, std::string>;
inline LabelName label_name(const LabelRef& l) {
  return {l.is_number, l.text};
}

}  // namespace cnctrans::ir
