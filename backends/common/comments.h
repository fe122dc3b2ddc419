// Comment and message texts in the target's character set.
#pragma once

#include <string>
#include <string_view>

#include "backends/common/style.h"
#include "base/diagnostics.h"

namespace cnctrans::backends {

/// Letters with marks become ASCII letters (umlauts with a following E), other characters beyond ASCII become '?'.
/// `text` is UTF-8 or Windows-1252. `lossy` (may be null) is set when a '?' was written.
std::string to_ascii(std::string_view text, bool* lossy);

/// The text between the comment marks. `own`: the text comes from the target's own language and is left as it is.
std::string comment_text(std::string_view text, const CommentStyle& style, bool own, bool* lossy);
/// With the marks.
std::string comment(std::string_view text, const CommentStyle& style, bool own, bool* lossy);

/// Says that a comment got a '?'.
void note_lossy_comment(const Span& place, Diagnostics& diagnostics);

}  // namespace cnctrans::backends
