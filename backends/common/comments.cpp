#include "backends/common/comments.h"

#include <algorithm>
#include <vector>

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

namespace {

/// How much of `text` goes into `room` characters: up to a blank where one stands near the end; never half a character.
std::size_t cut_at(std::string_view text, std::size_t room) {
  const std::size_t blank = text.substr(0, room + 1).find_last_of(' ');
  if (blank != std::string_view::npos && blank > room / 2) return blank;
  while (room > 1 && (static_cast<unsigned char>(text[room]) & 0xC0U) == 0x80U) --room;
  return room;
}

/// The texts of the comments that stand one behind the other.
std::vector<std::string_view> bodies(std::string_view comments, const CommentStyle& style) {
  std::vector<std::string_view> found;
  for (std::size_t at = comments.find(style.open); at != std::string_view::npos; at = comments.find(style.open)) {
    comments.remove_prefix(at + style.open.size());
    const std::size_t end =
        style.close.empty() ? comments.size() : std::min(comments.find(style.close), comments.size());
    found.push_back(comments.substr(0, end));
    comments.remove_prefix(end);
  }
  return found;
}

}  // namespace

std::string wrapped(std::string_view line, std::size_t comments, const CommentStyle& style, std::size_t length) {
  const std::size_t marks = style.open.size() + style.close.size();
  constexpr std::size_t least = 16;  // a shorter piece goes to the next line
  if (length == 0 || line.size() <= length || length < marks + least) return std::string(line);
  std::string out, current(line.substr(0, comments));
  const auto end_line = [&out, &current] {
    while (!current.empty() && current.back() == ' ') current.pop_back();
    out += current + '\n';
    current.clear();
  };
  for (std::string_view body : bodies(line.substr(comments), style)) {
    const bool indented = body.starts_with(' ');
    for (bool first = true; first || !body.empty(); first = false) {
      if (!first) end_line();
      const std::string_view blank = !first && indented ? " " : "";
      const auto taken = [&] {
        const std::size_t gap = current.empty() || current.back() == ' ' ? 0 : 1;
        return current.size() + gap + marks + blank.size();
      };
      if (!current.empty() && taken() + std::min(body.size(), least) > length) end_line();
      const std::size_t room = length - taken();
      const std::size_t n = body.size() <= room ? body.size() : cut_at(body, room);
      if (!current.empty() && current.back() != ' ') current += ' ';
      current.append(style.open).append(blank).append(body.substr(0, n)).append(style.close);
      body = trim(body.substr(n));
    }
  }
  return out + current;
}

void note_lossy_comment(const Span& place, Diagnostics& diagnostics) {
  diagnostics.note("TRN-209", place, "a character of this comment does not exist on the target control and became '?'");
}

}  // namespace cnctrans::backends
