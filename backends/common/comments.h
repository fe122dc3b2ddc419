// Comment and message texts in the target's character set.
#pragma once

#include <string>
#include <string_view>

#include "backends/common/style.h"
#include "base/diagnostics.h"
#include "base/transliterate.h"

namespace cnctrans::backends {

/// The text between the comment marks. `own`: the text comes from the target's own language and is left as it is.
std::string comment_text(std::string_view text, const CommentStyle& style, bool own, bool* lossy);
/// With the marks.
std::string comment(std::string_view text, const CommentStyle& style, bool own, bool* lossy);

/// A line whose comments (from `comments` on) make it longer than `length`, as several: what does not fit goes to
/// comment lines of their own behind it.
std::string wrapped(std::string_view line, std::size_t comments, const CommentStyle& style, std::size_t length);

/// Says that a comment got a '?'.
void note_lossy_comment(const Span& place, Diagnostics& diagnostics);

}  // namespace cnctrans::backends
