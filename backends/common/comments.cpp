#include "backends/common/comments.h"

#include "base/text.h"

namespace cnctrans::backends {

std::string comment_text(std::string_view text, const CommentStyle& style, bool own, bool* lossy) {
  if (own) return std::string(text);
  if (style.trim) text = trim(text);
  std::string out = style.ascii ? to_ascii(text, lossy) : std::string(text);
  if (style.upper) out = to_upper_ascii(out);
  for (char& c : out) {
    const auto at = style.forbidden.find(c);
    if (at != std::string_view::npos && at < style.instead.size()) c = style.instead[at];
  }
  if (style.blank_after_open && !out.empty() && out.front() != ' ' && out.front() != ';' && out.front() != '!') {
    out.insert(0, 1, ' ');
  }
  return out;
}

std::string comment(std::string_view text, const CommentStyle& style, bool own, bool* lossy) {
  std::string out(style.open);
  out += comment_text(text, style, own, lossy);
  out += style.close;
  return out;
}

void note_lossy_comment(const Span& place, Diagnostics& diagnostics) {
  diagnostics.note("TRN-209", place, "a character of this comment does not exist on the target control and became '?'");
}

}  // namespace cnctrans::backends
