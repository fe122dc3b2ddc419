// Messages on controls with smaller character sets and shorter lines.
#pragma once

#include <string_view>

#include "interpreter/trace/message_form.h"
#include "interpreter/trace/trace.h"

namespace cnctrans::verifier {

/// The same text, but for what a control can't show: letters with marks and small letters, the signs " and $, a value
/// (a '?' stands for it), and what lies behind the end of the target's line.
bool same_message(const interpreter::Event& source, std::string_view target);

}  // namespace cnctrans::verifier
