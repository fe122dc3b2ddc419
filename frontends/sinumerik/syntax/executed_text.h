// EXECSTRING: the block that a text is (language reference 8.7).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "frontends/sinumerik/state/context.h"

namespace cnctrans::sinumerik {

struct ExecutedText {
  std::string line;     ///< with the block in the place of EXECSTRING()
  bool joined = false;  ///< numbers of the run stand in the text: they became values of words
};
/// Nothing when the line has no EXECSTRING(), or when its text is not told by the line.
std::optional<ExecutedText> executed_text(std::string_view line, const FileContext& context);

}  // namespace cnctrans::sinumerik
