// What the expansion of lathe cycles and pockets has to know of a tool of the machine, and of the machine's options.
#pragma once

#include <cstdint>
#include <optional>

#include "ir/cycles/machining.h"
#include "ir/cycles/milling/milling.h"
#include "machine/profile.h"

namespace cnctrans::machine {

/// Fills the fields of the tool and of the options; a tool that the profile does not have leaves its fields alone.
void tell_tool(const Profile& profile, std::optional<std::int32_t> tool, ir::cycles::TurnContext& out);
/// Fills what the options cycle.pocket_* say of the moves in a pocket with islands.
void tell_pocket(const Policies& policies, ir::cycles::MillContext& out);

}  // namespace cnctrans::machine
