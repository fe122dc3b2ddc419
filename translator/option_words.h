// Options by the words of the command line, for all who take them as text: the command, the C interface.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "translator/pipeline.h"

namespace cnctrans::translator {

/// Sets `unsupported`, `numbering`, `cycles`, `structure`, `encoding`, `eol` or `reader` to what `value` means. False:
/// there is no such option, or it has no such value; nothing is changed.
bool set_word(TranslateOptions& options, std::string_view option, std::string_view value);

/// Adds NAME=VALUE to the initial values of a replay; false: it is not of that form.
bool add_setting(interpreter::Options& run, std::string_view item);

/// Adds the block-skip switches of a list such as "0,3"; false: it is none. A mark without a number is that of the
/// first switch of the control, whatever its number: 0 always means it. `dialect`: of the program; may be null.
bool add_skips(interpreter::Options& run, std::string_view list, const Dialect* dialect);
void add_skip(interpreter::Options& run, unsigned level, const Dialect* dialect);
inline constexpr unsigned last_skip_level = 15;

/// A verification keeps both traces in memory: about 0.5 kB an event.
inline constexpr std::uint64_t kept_events = 2'000'000;

}  // namespace cnctrans::translator
