// batch: every program below a folder.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/counted.h"
#include "base/os/os.h"
#include "cli/common.h"
#include "translator/batch/batch.h"
#include "translator/files/names_file.h"

namespace cnctrans::cli {

namespace {

/// A translation keeps both traces while it is verified: several run side by side.
constexpr std::uint64_t events_each = 500'000;
constexpr std::uint64_t steps_each = 50'000'000;

/// "2/8": shard 2 of 8.
bool read_shard(std::string_view text, translator::BatchOptions& out) {
  const auto slash = text.find('/');
  if (slash == std::string_view::npos) return false;
  const auto number = [](std::string_view digits, unsigned& n) {
    const auto r = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    return r.ec == std::errc{} && r.ptr == digits.data() + digits.size();
  };
  return number(text.substr(0, slash), out.shard) && number(text.substr(slash + 1), out.shards) && out.shard >= 1 &&
         out.shard <= out.shards;
}

std::string duration(double seconds) {
  const auto s = static_cast<long>(std::lround(seconds));
  return s < 100 ? fmt::format("{} s", s) : fmt::format("{}:{:02} min", s / 60, s % 60);
}

}  // namespace

int batch(const Arguments& a) {
  translator::BatchOptions options;
  if (!proved_options(a, options.translate)) return usage;
  translator::Names names;
  if (!a.names.empty()) {
    std::string error;
    auto found = translator::read_names(a.names, a.from, a.to, &error);
    if (!found) return usage_error(a, error);
    names = *std::move(found);
    options.translate.names = &names;
    if (!add_definitions(a, names, options.translate)) return usage;
  }
  if (!a.max_events) options.translate.run.max_events = events_each;
  options.translate.run.max_steps = std::min(a.max_steps, steps_each);
  if (a.inputs.size() != 2)
    return usage_error(a, "batch takes the folder of the programs and a folder for the results");
  options.in = a.inputs[0];
  options.out = a.inputs[1];
  options.jobs = a.jobs;
  options.timeout = a.timeout;
  options.again = a.again;
  options.force = a.force;
  options.collect_only = a.collect;
  options.reports = a.reports;
  if (!a.shard.empty() && !read_shard(a.shard, options))
    return usage_error(a, "--shard wants K/N with K from 1 to N, not '" + a.shard + "'");

  bool shown = false;
  const bool terminal = os::is_terminal(stderr);
  const auto progress = [&shown](const translator::BatchProgress& p) {
    constexpr std::size_t width = 30;
    const std::size_t full = p.total == 0 ? width : width * p.done / p.total;
    shown = true;
    write_all(stderr,
              fmt::format("\r\x1b[K[{}{}] {} of {}, {:.1f}/s, {} left", std::string(full, '#'),
                          std::string(width - full, '.'), p.done, p.total, p.per_second, duration(p.seconds_left)));
  };
  const auto result =
      translator::batch(options, terminal ? std::function<void(const translator::BatchProgress&)>(progress) : nullptr);
  if (shown) write_all(stderr, "\r\x1b[K");
  if (!result.error.empty()) return usage_error(a, result.error);

  int status = ok;
  std::string counts;
  for (const auto& s : translator::batch_statuses()) {
    const auto n = std::count_if(result.records.begin(), result.records.end(),
                                 [&s](const translator::BatchRecord& r) { return r.status == s; });
    if (n == 0) continue;
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", n, s);
    if (s == "differs") status = limit_or_difference;
    const bool fine = s == "verified" || s == "within tolerance" || s == "written" || s == "no motion" ||
                      (s == "not replayable" && !options.translate.strict);
    if (!fine && status == ok) status = refused;
  }
  if (!a.quiet) {
    const std::string reused = result.reused == 0 ? "" : fmt::format(" ({} done before)", result.reused);
    write_all(stdout, fmt::format("{} in this run{}; {} of {} done: {}\nwrote {}/summary.html\n",
                                  counted(result.programs, "program"), reused, result.records.size(), result.all,
                                  counts.empty() ? "none" : counts, options.out));
  }
  return status;
}

}  // namespace cnctrans::cli
