// The summary of a batch: by status, by diagnostic code, program by program. The same results give the same bytes.
#include <fmt/format.h>

#include <algorithm>

#include "base/markup.h"
#include "base/text.h"
#include "translator/batch/batch_record.h"
#include "translator/files/readable.h"
#include "translator/report/overview.h"

namespace cnctrans::translator {
namespace {

using Codes = std::map<std::string, CodeCount>;

struct Counts {
  std::map<std::string, std::size_t> status;
  Codes errors, warnings;
  std::size_t verified = 0;
};

Counts count(const std::vector<BatchRecord>& records) {
  Counts c;
  for (const auto& r : records) {
    ++c.status[r.status];
    count_codes(r.errors, c.errors);
    count_codes(r.warnings, c.warnings);
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
  Overview page;
  page.title = fmt::format("{} to {}", from != nullptr ? from->title : "", to != nullptr ? to->title : "");
  page.lead = fmt::format("{} of {} programs done; verified: {} ({} %).", records.size(), all, c.verified,
                          share(c.verified, records.size()));
  page.states = batch_statuses();
  page.columns = {{"moves", true}, {"errors"}, {"detail"}};
  page.codes = {{"Errors", c.errors}, {"Warnings", c.warnings}};
  for (const auto& r : records) {
    auto& row = page.rows.emplace_back();
    row = {r.program, r.status, {std::to_string(r.moves), codes_text(r.errors), r.detail}, r.errors, {}, {}};
    if (!r.report.empty()) row.report = r.program + "/" + r.report;
    row.codes.insert(r.warnings.begin(), r.warnings.end());
  }
  return overview_html(page);
}

}  // namespace cnctrans::translator
