// The survey for people and for spreadsheets. The same folder gives the same bytes.
#include <fmt/format.h>

#include <algorithm>

#include "base/counted.h"
#include "base/markup.h"
#include "base/text.h"
#include "translator/survey/survey.h"

namespace cnctrans::translator {

namespace {

/// How many programs of each kind, and by control.
struct Sums {
  std::map<std::string, std::size_t> kinds, controls, features;
  std::size_t lines = 0, blocks = 0, unread = 0;
};

Sums sums_of(const Survey& s) {
  Sums sums;
  for (const auto& p : s.programs) {
    ++sums.kinds[p.kind];
    ++sums.controls[p.dialect.empty() ? "not known" : p.dialect];
    for (const auto& f : p.features) ++sums.features[f];
    sums.lines += p.lines;
    sums.blocks += p.blocks;
    sums.unread += p.unread;
  }
  return sums;
}

std::vector<std::pair<std::string, std::size_t>> most_first(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::pair<std::string, std::size_t>> list(counts.begin(), counts.end());
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return list;
}

std::string needs_text(const std::map<std::string, Need>& needs) {
  std::string text;
  for (const auto& [name, need] : needs) text += fmt::format("{}{}:{}", text.empty() ? "" : " ", name, need.times);
  return text;
}

std::string joined(const std::set<std::string>& words) {
  std::string text;
  for (const auto& w : words) text += (text.empty() ? "" : "; ") + w;
  return text;
}

std::string count_table(std::string_view title, std::string_view what,
                        const std::vector<std::pair<std::string, std::size_t>>& rows) {
  std::string text = fmt::format("<h2>{}</h2>\n<table><tr><th>{}</th><th>programs</th></tr>\n", title, what);
  for (const auto& [name, n] : rows) text += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", html_text(name), n);
  return text + "</table>\n";
}

constexpr std::string_view survey_style = R"(body{font:15px/1.4 sans-serif;margin:1em auto;padding:0 1em;max-width:80em;
color:#222}table{border-collapse:collapse;margin:.5em 0 1.5em}th,td{border:1px solid #bbb;padding:.2em .6em;
text-align:left;vertical-align:top;overflow-wrap:anywhere}th{background:#eee}.wide{overflow-x:auto})";

constexpr std::size_t shown_in_text = 20;

}  // namespace

std::string survey_text(const Survey& s, const SurveyOptions& options) {
  const Sums sums = sums_of(s);
  std::string out =
      fmt::format("{}: {}, {}\n", options.in, counted(s.programs.size(), "file"), counted(sums.lines, "line"));
  for (const auto& kind : program_kinds()) {
    if (const auto it = sums.kinds.find(kind); it != sums.kinds.end())
      out += fmt::format("  {:<16}{}\n", kind, it->second);
  }
  out += "controls:\n";
  for (const auto& [control, n] : most_first(sums.controls)) out += fmt::format("  {:<16}{}\n", control, n);
  if (sums.unread != 0) out += fmt::format("{} of {} blocks can't be read\n", sums.unread, sums.blocks);
  const auto programs = s.programs.size() - (sums.kinds.count("no program") != 0 ? sums.kinds.at("no program") : 0);
  out += fmt::format("{} of {} programs need nothing that is not here\n", s.complete, programs);
  if (s.missing.empty()) return out;
  out += fmt::format("missing ({}), in the order in which answers free the most programs:\n", s.missing.size());
  out += fmt::format("  {:<9}{:<28}{:>6}{:>10}{:>7}{:>9}\n", "what", "name", "times", "programs", "alone", "unlocks");
  for (std::size_t i = 0; i < std::min(s.missing.size(), shown_in_text); ++i) {
    const Missing& m = s.missing[i];
    out += fmt::format("  {:<9}{:<28}{:>6}{:>10}{:>7}{:>9}\n", name(m.kind), m.name, m.times, m.programs, m.alone,
                       m.unlocks);
  }
  if (s.missing.size() > shown_in_text) out += fmt::format("  and {} more\n", s.missing.size() - shown_in_text);
  return out;
}

std::string survey_programs_csv(const Survey& s) {
  std::string out = "program,control,kind,lines,blocks,unread,calls,data,names,features\n";
  for (const auto& p : s.programs) {
    out += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csv_cell(p.path), p.dialect, csv_cell(p.kind), p.lines,
                       p.blocks, p.unread, csv_cell(needs_text(p.calls)), csv_cell(needs_text(p.data)),
                       csv_cell(needs_text(p.names)), csv_cell(joined(p.features)));
  }
  return out;
}

std::string survey_missing_csv(const Survey& s) {
  std::string out = "rank,what,name,times,programs,alone,unlocks\n";
  std::size_t rank = 0;
  for (const auto& m : s.missing)
    out += fmt::format("{},{},{},{},{},{},{}\n", ++rank, name(m.kind), csv_cell(m.name), m.times, m.programs, m.alone,
                       m.unlocks);
  return out;
}

std::string survey_html(const Survey& s, const SurveyOptions& options) {
  const Sums sums = sums_of(s);
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>Survey of {0}</title><style>{1}</style></head><body>\n<h1>Survey of "
      "{0}</h1>\n<p>{2} files, {3} lines; {4} of {5} blocks can't be read. {6} programs need nothing that is not "
      "here.</p>\n",
      html_text(options.in), survey_style, s.programs.size(), sums.lines, sums.unread, sums.blocks, s.complete);
  std::vector<std::pair<std::string, std::size_t>> kinds;
  for (const auto& kind : program_kinds()) {
    if (const auto it = sums.kinds.find(kind); it != sums.kinds.end()) kinds.emplace_back(kind, it->second);
  }
  out += count_table("Kinds", "kind", kinds) + count_table("Controls", "control", most_first(sums.controls));
  out +=
      "<h2>What is missing</h2>\n<p>In the order in which answers free the most programs. <b>alone</b>: programs that "
      "need nothing else; <b>unlocks</b>: programs that lack nothing once this and all above it are answered.</p>\n"
      "<div class=\"wide\"><table><tr><th>what</th><th>name</th><th>times</th><th>programs</th><th>alone</th>"
      "<th>unlocks</th></tr>\n";
  for (const auto& m : s.missing)
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", name(m.kind),
                       html_text(m.name), m.times, m.programs, m.alone, m.unlocks);
  out += "</table></div>\n" + count_table("What the programs use", "feature", most_first(sums.features));
  out +=
      "<h2>Programs</h2>\n<div class=\"wide\"><table><tr><th>program</th><th>control</th><th>kind</th><th>lines</th>"
      "<th>unread</th><th>calls</th><th>data</th></tr>\n";
  for (const auto& p : s.programs) {
    auto data = needs_text(p.data);
    if (!p.names.empty()) data += (data.empty() ? "" : " ") + needs_text(p.names);
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                       html_text(p.path), p.dialect, p.kind, p.lines, p.unread, html_text(needs_text(p.calls)),
                       html_text(data));
  }
  return out + "</table></div>\n</body></html>\n";
}

}  // namespace cnctrans::translator
