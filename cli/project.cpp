// project: an archive as one job.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/counted.h"
#include "cli/common.h"
#include "translator/project/project.h"

namespace cnctrans::cli {

int project(const Arguments& a) {
  translator::ProjectOptions options;
  options.folder = a.inputs.front();
  options.jobs = a.jobs;
  options.timeout = a.timeout;
  options.again = a.again;
  options.status = a.status;
  options.reports = a.reports;
  ProgressLine progress(options.folder);
  const auto result = translator::project(options, [&progress](const translator::BatchProgress& p) {
    progress(p.total == 0 ? 1 : static_cast<double>(p.done) / static_cast<double>(p.total));
  });
  if (!result.error.empty()) return usage_error(a, result.error);
  int status = ok;
  std::map<std::string, std::size_t> states;
  const std::string_view fine[] = {"verified",  "within tolerance", "written",
                                   "no motion", "not replayable",   "changed by hand"};
  for (const auto& p : result.programs) {
    ++states[p.state];
    if (p.state == "differs") status = limit_or_difference;
    if (status == ok && std::find(std::begin(fine), std::end(fine), p.state) == std::end(fine)) status = refused;
  }
  if (a.status) {
    for (const auto& p : result.programs)
      write_all(stdout, fmt::format("{:<18}{}{}\n", p.state, p.path, p.detail.empty() ? "" : ": " + p.detail));
    return ok;
  }
  if (a.quiet) return status;
  for (const auto& p : result.programs) {
    const bool told = p.state == "verified" || p.state == "within tolerance" || p.state == "no motion";
    if (!told) write_all(stdout, fmt::format("{}: {}{}\n", p.path, p.state, p.detail.empty() ? "" : ": " + p.detail));
    for (const auto& [name, diff] : p.diffs) write_all(stdout, diff);
  }
  std::string counts;
  for (const auto& [state, n] : states) counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", n, state);
  write_all(stdout, fmt::format("{} ({} done before), {} new or other: {}\nwrote {}/project.html\n",
                                counted(result.programs.size(), "program"), result.reused,
                                counted(result.written.size(), "file"), counts, options.folder));
  return status;
}

}  // namespace cnctrans::cli
