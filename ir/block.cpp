#include "ir/block.h"

namespace cnctrans::ir {

ActionData::ActionData() = default;
ActionData::ActionData(const ActionData&) = default;
ActionData::ActionData(ActionData&&) noexcept = default;
ActionData& ActionData::operator=(const ActionData&) = default;
ActionData& ActionData::operator=(ActionData&&) noexcept = default;
ActionData::~ActionData() = default;

}  // namespace cnctrans::ir
