// The states of an archive's programs for people and for spreadsheets.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/counted.h"
#include "base/markup.h"
#include "base/source.h"
#include "base/text.h"
#include "translator/files/registry.h"
#include "translator/project/project.h"
#include "translator/report/overview.h"

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
  Overview page;
  page.title = fmt::format("{} to {}", from->title, to->title);
  page.lead = fmt::format("{} of {}; what loads into the control stands in {}.", counted(r.programs.size(), "program"),
                          config.programs, config.output);
  std::set<std::string> states;
  for (const auto& p : r.programs) states.insert(p.state);
  page.states.assign(states.begin(), states.end());
  page.columns = {{"lines", true}, {"moves", true}, {"outputs"}, {"detail"}};
  page.codes = {{"Errors", {}}, {"Warnings", {}}};
  for (const auto& p : r.programs) {
    auto& row = page.rows.emplace_back();
    row = {p.path,   p.state,  {std::to_string(p.lines), std::to_string(p.moves), list_of(p.outputs), p.detail},
           p.errors, p.report, {}};
    row.codes.insert(p.warnings.begin(), p.warnings.end());
    count_codes(p.errors, page.codes[0].second);
    count_codes(p.warnings, page.codes[1].second);
    for (const auto& [name, diff] : p.diffs) row.details.emplace_back(name + ": - as it is, + as it would be", diff);
  }
  return overview_html(page);
}

}  // namespace cnctrans::translator
