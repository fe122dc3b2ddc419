// How Datum::active_modal asks for the flag of Setting::units.
#pragma once

#include "ir/modal.h"

namespace cnctrans::ir {

/// In the place of the setting: does the unit in force hold for F too, as the third argument says (0, 1)?
inline constexpr int units_feed_too_setting = static_cast<int>(setting_count) + 32;

}  // namespace cnctrans::ir
