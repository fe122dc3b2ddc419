// The summary of a batch: by status, by diagnostic code, program by program. The same results give the same bytes.
#include <fmt/format.h>

#include <algorithm>

#include "base/markup.h"
#include "base/text.h"
#include "translator/batch/batch_record.h"
#include "translator/files/readable.h"

namespace cnctrans::translator {
namespace {

struct CodeCount {
  std::size_t programs = 0, times = 0;
};
using Codes = std::map<std::string, CodeCount>;

struct Counts {
  std::map<std::string, std::size_t> status;
  Codes errors, warnings;
  std::size_t verified = 0;
};

Counts count(const std::vector<BatchRecord>& records) {
  Counts c;
  const auto add = [](const std::map<std::string, std::size_t>& from, Codes& to) {
    for (const auto& [code, times] : from) {
      ++to[code].programs;
      to[code].times += times;
    }
  };
  for (const auto& r : records) {
    ++c.status[r.status];
    add(r.errors, c.errors);
    add(r.warnings, c.warnings);
    if (r.status == "verified" || r.status == "within tolerance") ++c.verified;
  }
  return c;
}

std::string share(std::size_t part, std::size_t of) {
  return of == 0 ? "0" : rounded(100.0 * static_cast<double>(part) / static_cast<double>(of), 2);
}

std::string codes_text(const std::map<std::string, std::size_t>& codes) {
  std::string text;
  for (const auto& [code, times] : codes) text += fmt::format("{}{}:{}", text.empty() ? "" : " ", code, times);
  return text;
}

/// The codes, the most frequent first.
std::vector<std::pair<std::string, CodeCount>> by_frequency(const Codes& codes) {
  std::vector<std::pair<std::string, CodeCount>> list(codes.begin(), codes.end());
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.second.programs > b.second.programs; });
  return list;
}

std::string code_table(std::string_view title, const Codes& codes) {
  std::string text = fmt::format("<h2>{}</h2>\n<table><tr><th>code</th><th>programs</th><th>times</th></tr>\n", title);
  for (const auto& [code, n] : by_frequency(codes))
    text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", html_text(code), n.programs, n.times);
  return text + "</table>\n";
}

constexpr std::string_view style = R"(body{font:15px/1.4 sans-serif;margin:2em;max-width:80em;color:#222}
table{border-collapse:collapse;margin:.5em 0 1.5em}th,td{border:1px solid #bbb;padding:.2em .6em;text-align:left;
vertical-align:top}th{background:#eee}.bar{height:1.2em;display:flex;max-width:60em}.bar span{display:block}
.verified,.within{background:#4a9d5b}.written{background:#7aa7d0}.no{background:#bbb}.not,.left{background:#d9a441}
.differs,.crashed,.timed{background:#c0392b}.refused,.draft{background:#e0c060}.unreadable{background:#a0785a}
td.s{color:#000;white-space:nowrap})";

std::string_view first_word(std::string_view status) {
  return status.substr(0, status.find(' '));
}

}  // namespace

const std::vector<std::string>& batch_statuses() {
  static const std::vector<std::string> all{"verified",       "within tolerance", "written",    "no motion",
                                            "not replayable", "differs",          "refused",    "unreadable",
                                            "crashed",        "timed out",        "left alone", "draft"};
  return all;
}

std::string summary_csv(const std::vector<BatchRecord>& records, std::size_t all) {
  const Counts c = count(records);
  std::string text = "what,name,programs,times\n";
  text += fmt::format("programs,below the folder,{},\nprograms,done,{},\n", all, records.size());
  for (const auto& s : batch_statuses()) {
    const auto it = c.status.find(s);
    text += fmt::format("status,{},{},\n", s, it == c.status.end() ? 0 : it->second);
  }
  text += fmt::format("share,verified percent,{},\n", share(c.verified, records.size()));
  for (const auto& [code, n] : c.errors) text += fmt::format("error,{},{},{}\n", csv_cell(code), n.programs, n.times);
  for (const auto& [code, n] : c.warnings)
    text += fmt::format("warning,{},{},{}\n", csv_cell(code), n.programs, n.times);
  return text;
}

std::string programs_csv(const std::vector<BatchRecord>& records) {
  std::string text = "program,status,lines,moves,max_length_mm,errors,warnings,outputs,detail\n";
  for (const auto& r : records) {
    std::string outputs;
    for (const auto& o : r.outputs) outputs += (outputs.empty() ? "" : " ") + o;
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_cell(r.program), r.status, r.lines, r.moves,
                        rounded(r.max_length, 6), csv_cell(codes_text(r.errors)), csv_cell(codes_text(r.warnings)),
                        csv_cell(outputs), csv_cell(r.detail));
  }
  return text;
}

std::string summary_html(const std::vector<BatchRecord>& records, const BatchOptions& options, std::size_t all) {
  const Counts c = count(records);
  const Dialect* from = find_dialect(options.translate.from);
  const Dialect* to = find_dialect(options.translate.to);
  const std::string title = fmt::format("{} to {}", from != nullptr ? from->title : "", to != nullptr ? to->title : "");
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title><style>{1}</style></head>"
      "<body>\n<h1>{0}</h1>\n<p>{2} of {3} programs done; verified: {4} ({5} %).</p>\n<div class=\"bar\">",
      html_text(title), style, records.size(), all, c.verified, share(c.verified, records.size()));
  std::string rows;
  for (const auto& s : batch_statuses()) {
    const auto it = c.status.find(s);
    if (it == c.status.end()) continue;
    const std::string percent = share(it->second, records.size());
    text += fmt::format("<span class=\"{}\" style=\"width:{}%\" title=\"{}: {}\"></span>", first_word(s), percent, s,
                        it->second);
    rows += fmt::format("<tr><td class=\"s {}\">{}</td><td>{}</td><td>{} %</td></tr>\n", first_word(s), s, it->second,
                        percent);
  }
  text += "</div>\n<table><tr><th>result</th><th>programs</th><th>share</th></tr>\n" + rows + "</table>\n";
  text += code_table("Errors", c.errors) + code_table("Warnings", c.warnings);
  text +=
      "<h2>Programs</h2>\n<table><tr><th>program</th><th>result</th><th>moves</th><th>errors</th><th>detail</th></"
      "tr>\n";
  for (const auto& r : records) {
    text += fmt::format("<tr><td>{}</td><td class=\"s {}\">{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        html_text(r.program), first_word(r.status), r.status, r.moves, html_text(codes_text(r.errors)),
                        html_text(r.detail));
  }
  return text + "</table>\n</body></html>\n";
}

}  // namespace cnctrans::translator
