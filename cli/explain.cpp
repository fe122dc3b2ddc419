// explain: the page of a code in the terminal.
#include "base/nearest.h"
#include "cli/common.h"
#include "translator/report/code_pages.h"

namespace cnctrans::cli {

namespace {

/// The few marks of markdown that the pages use, as a terminal shows them.
std::string for_terminal(std::string_view text, bool colour) {
  std::string out;
  bool emphasis = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '`') {
      const auto end = std::min(text.find('`', i + 1), text.size());
      out += text.substr(i + 1, end - i - 1);
      i = end;
    } else if (text[i] == '*' && (emphasis || (i + 1 < text.size() && text[i + 1] != ' '))) {
      while (i + 1 < text.size() && text[i + 1] == '*') ++i;
      emphasis = !emphasis;
      if (colour) out += emphasis ? "\x1b[1m" : "\x1b[0m";
    } else {
      out += text[i];
    }
  }
  return out;
}

/// Lines of at most 80 characters; an empty line, a list and a table keep theirs.
std::string folded(std::string_view text) {
  constexpr std::size_t width = 80;
  std::string out;
  std::size_t column = 0;
  const auto word = [&](std::string_view w) {
    if (column != 0 && column + 1 + w.size() > width) {
      out += '\n';
      column = 0;
    } else if (column != 0) {
      out += ' ';
      ++column;
    }
    out += w;
    column += w.size();
  };
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const bool own = line.empty() || line.starts_with('|') || line.starts_with("- ") || line.starts_with("    ");
    if (own && column != 0) {
      out += '\n';
      column = 0;
    }
    if (line.empty() || line.starts_with('|') || line.starts_with("    ")) {
      out += std::string(line) + "\n";
      continue;
    }
    while (!line.empty()) {
      const auto space = std::min(line.find(' '), line.size());
      if (space != 0) word(line.substr(0, space));
      line.remove_prefix(std::min(space + 1, line.size()));
    }
  }
  return column == 0 ? out : out + "\n";
}

}  // namespace

int explain(const Arguments& a) {
  const auto page = translator::code_page(a.code);
  if (page.heading.empty())
    return usage_error(a, "there is no code " + a.code + did_you_mean(a.code, translator::documented_codes()));
  const bool colour = coloured(a, stdout);
  const std::string heading(page.heading);
  write_all(stdout,
            (colour ? "\x1b[1m" + heading + "\x1b[0m" : heading) + "\n\n" + for_terminal(folded(page.text), colour));
  return ok;
}

}  // namespace cnctrans::cli
