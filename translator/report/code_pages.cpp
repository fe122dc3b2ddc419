#include "translator/report/code_pages.h"

#include <algorithm>

#include "base/text.h"

namespace cnctrans::translator {

namespace {

constexpr std::string_view mark = "## ";

/// Where the next page begins.
std::size_t next_page(std::string_view text) {
  if (text.starts_with(mark)) return 0;
  const auto at = text.find("\n## ");
  return at == std::string_view::npos ? text.size() : at + 1;
}

/// Calls `use(heading, text)` for each page until it says true.
template <class Use>
void each_page(const Use& use) {
  for (std::size_t i = 0; i < diagnostic_pages_count; ++i) {
    std::string_view rest = diagnostic_pages[i].text;
    for (rest.remove_prefix(next_page(rest)); !rest.empty();) {
      const auto line = std::min(rest.find('\n'), rest.size());
      const std::string_view heading = rest.substr(mark.size(), line - mark.size());
      rest.remove_prefix(line);
      const auto length = next_page(rest);
      if (use(heading, trim(rest.substr(0, length)))) return;
      rest.remove_prefix(length);
    }
  }
}

constexpr std::string_view dash = " \xE2\x80\x94 ";  // before the title

/// One page may stand for several codes: "CNC-USAGE, CNC-OUTPUT".
std::vector<std::string> codes_of(std::string_view heading) {
  std::vector<std::string> codes;
  heading = heading.substr(0, heading.find(dash));
  while (!heading.empty()) {
    const auto comma = std::min(heading.find(','), heading.size());
    codes.emplace_back(trim(heading.substr(0, comma)));
    heading.remove_prefix(std::min(comma + 1, heading.size()));
  }
  return codes;
}

}  // namespace

CodePage code_page(std::string_view code) {
  CodePage found;
  const std::string wanted = to_upper_ascii(code);
  each_page([&](std::string_view heading, std::string_view text) {
    const auto codes = codes_of(heading);
    if (std::find(codes.begin(), codes.end(), wanted) == codes.end()) return false;
    found = {heading, text};
    return true;
  });
  return found;
}

std::string_view code_title(const CodePage& page) {
  if (const auto at = page.heading.find(dash); at != std::string_view::npos)
    return page.heading.substr(at + dash.size());
  auto end = page.text.size();
  for (const std::string_view stop : {". ", ": ", "; ", " (", "\n"}) end = std::min(end, page.text.find(stop));
  return page.text.substr(0, end);
}

std::vector<std::string> documented_codes() {
  std::vector<std::string> all;
  each_page([&all](std::string_view heading, std::string_view /*text*/) {
    for (auto& c : codes_of(heading)) all.push_back(std::move(c));
    return false;
  });
  return all;
}

}  // namespace cnctrans::translator
