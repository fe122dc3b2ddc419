// The states of an archive's programs for people and for spreadsheets.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/counted.h"
#include "base/markup.h"
#include "base/source.h"
#include "base/text.h"
#include "translator/files/registry.h"
#include "translator/project/project.h"

namespace cnctrans::translator {

namespace {

std::string list_of(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& w : words) text += (text.empty() ? "" : " ") + w;
  return text;
}

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  SourceLine l;
  while (take_line(text, l)) lines.push_back(l.text);
  return lines;
}

constexpr std::string_view project_style =
    R"(body{font:15px/1.4 sans-serif;margin:1em auto;padding:0 1em;max-width:80em;
color:#222}table{border-collapse:collapse;margin:.5em 0 1.5em}th,td{border:1px solid #bbb;padding:.2em .6em;
text-align:left;vertical-align:top;overflow-wrap:anywhere}th{background:#eee}pre{margin:0;white-space:pre-wrap}
.wide{overflow-x:auto})";

}  // namespace

std::string line_diff(std::string_view before, std::string_view after) {
  const auto a = split_lines(before), b = split_lines(after);
  std::size_t head = 0, tail = 0;
  while (head < std::min(a.size(), b.size()) && a[head] == b[head]) ++head;
  while (tail < std::min(a.size(), b.size()) - head && a[a.size() - 1 - tail] == b[b.size() - 1 - tail]) ++tail;
  const std::size_t n = a.size() - head - tail, m = b.size() - head - tail;
  std::string out;
  const auto say = [&out](char mark, std::string_view line) {
    out += mark;
    out += line;
    out += '\n';
  };
  constexpr std::size_t most = 4'000'000;  // cells of the table of common parts
  if (n * m > most) {
    for (std::size_t i = 0; i < n; ++i) say('-', a[head + i]);
    for (std::size_t i = 0; i < m; ++i) say('+', b[head + i]);
    return out;
  }
  std::vector<std::vector<std::uint32_t>> common(n + 1, std::vector<std::uint32_t>(m + 1));
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = m; j-- > 0;)
      common[i][j] =
          a[head + i] == b[head + j] ? common[i + 1][j + 1] + 1 : std::max(common[i + 1][j], common[i][j + 1]);
  }
  for (std::size_t i = 0, j = 0; i < n || j < m;) {
    if (i < n && j < m && a[head + i] == b[head + j]) {
      ++i, ++j;
    } else if (i < n && (j == m || common[i + 1][j] >= common[i][j + 1])) {
      say('-', a[head + i++]);
    } else {
      say('+', b[head + j++]);
    }
  }
  return out;
}

std::string project_csv(const ProjectResult& r) {
  std::string out = "program,state,lines,moves,outputs,detail\n";
  for (const auto& p : r.programs)
    out += fmt::format("{},{},{},{},{},{}\n", csv_cell(p.path), p.state, p.lines, p.moves, csv_cell(list_of(p.outputs)),
                       csv_cell(p.detail));
  return out;
}

std::string project_html(const ProjectResult& r, const ProjectConfig& config) {
  const Dialect* from = find_dialect(config.from);
  const Dialect* to = find_dialect(config.to);
  const std::string title = fmt::format("{} to {}", from->title, to->title);
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{0}</title><style>{1}</style></head><body>\n<h1>{0}</h1>\n"
      "<p>{2} of {3}; what loads into the control stands in {4}.</p>\n",
      html_text(title), project_style, counted(r.programs.size(), "program"), html_text(config.programs),
      html_text(config.output));
  std::map<std::string, std::size_t> states;
  for (const auto& p : r.programs) ++states[p.state];
  out += "<table><tr><th>state</th><th>programs</th></tr>\n";
  for (const auto& [state, n] : states) out += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", html_text(state), n);
  out +=
      "</table>\n<div class=\"wide\"><table><tr><th>program</th><th>state</th><th>lines</th><th>moves</th>"
      "<th>outputs</th><th>detail</th></tr>\n";
  for (const auto& p : r.programs) {
    std::string detail = html_text(p.detail);
    for (const auto& [name, diff] : p.diffs)
      detail += fmt::format("<details><summary>{}: - as it is, + as it would be</summary><pre>{}</pre></details>",
                            html_text(name), html_text(diff));
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                       html_text(p.path), html_text(p.state), p.lines, p.moves, html_text(list_of(p.outputs)), detail);
  }
  return out + "</table></div>\n</body></html>\n";
}

}  // namespace cnctrans::translator
