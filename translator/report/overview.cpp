#include "translator/report/overview.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/markup.h"
#include "base/text.h"
#include "base/uri.h"
#include "translator/report/code_pages.h"
#include "translator/report/embedded.h"

namespace cnctrans::translator {

namespace {

std::string_view first_word(std::string_view state) {
  return state.substr(0, state.find(' '));
}

std::string percent(std::size_t part, std::size_t of) {
  return rounded(of == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(of), 2);
}

/// A bar, and a table of how many programs have each state.
std::string state_table(const Overview& o) {
  std::map<std::string, std::size_t> count;
  for (const auto& r : o.rows) ++count[r.state];
  std::string bar, rows;
  for (const auto& s : o.states) {
    const auto n = count.find(s);
    if (n == count.end()) continue;
    const std::string share = percent(n->second, o.rows.size());
    bar += fmt::format("<span class=\"{}\" style=\"width:{}%\" title=\"{}: {}\"></span>", first_word(s), share, s,
                       n->second);
    rows += fmt::format(
        "<tr><td class=\"s {0}\"><a href=\"#programs\" data-state=\"{1}\">{1}</a></td><td class=\"n\">{2}</td>"
        "<td class=\"n\">{3} %</td></tr>\n",
        first_word(s), html_text(s), n->second, share);
  }
  return "<div class=\"bar\">" + bar + "</div>\n<table><tr><th>result</th><th>programs</th><th>share</th></tr>\n" +
         rows + "</table>\n";
}

/// The most frequent first, each with what it means.
std::string code_table(const std::string& title, const std::map<std::string, CodeCount>& codes) {
  std::vector<std::pair<std::string, CodeCount>> list(codes.begin(), codes.end());
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.second.programs > b.second.programs; });
  std::string text =
      fmt::format("<h2>{}</h2>\n<table><tr><th>code</th><th>programs</th><th>times</th><th>what it means</th></tr>\n",
                  html_text(title));
  for (const auto& [code, n] : list) {
    const CodePage page = code_page(code);
    const std::string meaning = page.text.empty() ? ""
                                                  : fmt::format("<details><summary>{}</summary><pre>{}</pre></details>",
                                                                html_text(code_title(page)), html_text(page.text));
    text += fmt::format(
        "<tr><td><a href=\"#programs\" data-code=\"{0}\">{0}</a></td><td class=\"n\">{1}</td><td class=\"n\">{2}</td>"
        "<td>{3}</td></tr>\n",
        html_text(code), n.programs, n.times, meaning);
  }
  return text + "</table>\n";
}

std::string row_html(const OverviewRow& r, const std::vector<OverviewColumn>& columns) {
  std::string codes;
  for (const auto& [code, n] : r.codes) codes += (codes.empty() ? "" : "|") + code;
  const std::string name = html_text(r.program);
  std::string text = fmt::format(
      "<tr data-state=\"{0}\" data-codes=\"{1}\"><td>{2}</td><td class=\"s {3}\">{0}</td>", html_text(r.state),
      html_text(codes),
      r.report.empty() ? name : fmt::format("<a href=\"{}\">{}</a>", html_text(uri_of_path(r.report)), name),
      first_word(r.state));
  for (std::size_t i = 0; i < r.cells.size(); ++i) {
    text += columns[i].number ? fmt::format("<td class=\"n\" data-title=\"{}\">", html_text(columns[i].title)) : "<td>";
    text += html_text(r.cells[i]);
    for (std::size_t k = 0; i + 1 == r.cells.size() && k < r.details.size(); ++k)
      text += fmt::format("<details><summary>{}</summary><pre>{}</pre></details>", html_text(r.details[k].first),
                          html_text(r.details[k].second));
    text += "</td>";
  }
  return text + "</tr>\n";
}

}  // namespace

void count_codes(const std::map<std::string, std::size_t>& said, std::map<std::string, CodeCount>& codes) {
  for (const auto& [code, times] : said) {
    ++codes[code].programs;
    codes[code].times += times;
  }
}

std::string overview_html(const Overview& o) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>{0}</title><style>{1}</style></head><body>\n"
      "<h1>{0}</h1>\n<p>{2}</p>\n",
      html_text(o.title), report_text("overview_style"), html_text(o.lead));
  text += state_table(o);
  for (const auto& [title, codes] : o.codes) text += code_table(title, codes);
  text +=
      "<h2>Programs</h2>\n<p class=\"filter\" id=\"filter\" hidden><label>find <input id=\"find\" "
      "type=\"search\"></label>"
      "<label>result <select id=\"state\"><option value=\"\">all</option></select></label>"
      "<label>code <select id=\"code\"><option value=\"\">all</option></select></label><span id=\"shown\"></span></p>\n"
      "<table id=\"programs\"><thead><tr><th>program</th><th>result</th>";
  for (const auto& c : o.columns)
    text += fmt::format("<th{}>{}</th>", c.number ? " data-number" : "", html_text(c.title));
  text += "</tr></thead><tbody>\n";
  for (const auto& r : o.rows) text += row_html(r, o.columns);
  return text + "</tbody></table>\n<script>" + std::string(report_text("overview")) + "</script>\n</body></html>\n";
}

}  // namespace cnctrans::translator
