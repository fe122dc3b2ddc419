#include "translator/batch/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>
#include <thread>

#include "base/os/os.h"
#include "base/sum.h"
#include "base/text.h"
#include "translator/batch/batch_folder.h"
#include "translator/batch/batch_record.h"
#include "translator/files/names_file.h"
#include "translator/files/readable.h"
#include "translator/folding/unfolding.h"
#include "translator/report/report.h"
#include "translator/version.h"

namespace cnctrans::translator {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Part programs below the folder, by the extensions of the dialect, sorted.
std::vector<std::string> programs_below(const fs::path& folder, BatchFolder& out, const Dialect& dialect) {
  std::vector<std::string> found;
  std::error_code ignored;
  const auto is_program = [&dialect](const fs::path& path) {
    std::string extension = path.extension().string();
    if (extension.empty()) return false;
    for (const auto* list : {&dialect.mill_extensions, &dialect.lathe_extensions, &dialect.other_extensions}) {
      for (const auto& e : *list) {
        if (iequals_ascii(extension.substr(1), e)) return true;
      }
    }
    return false;
  };
  for (auto it = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, ignored);
       it != fs::recursive_directory_iterator(); it.increment(ignored)) {
    if (it->is_regular_file(ignored) && is_program(it->path()) && !out.is_result(it->path()))
      found.push_back(it->path().lexically_relative(folder).generic_string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// What a result depends on besides the files: another job does not take it over.
std::string job_sum(const BatchOptions& o) {
  const TranslateOptions& t = o.translate;
  std::string text = fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}", version, t.from, t.to, t.machine,
                                 t.target_machine, static_cast<int>(t.reader), static_cast<int>(t.unsupported),
                                 static_cast<int>(t.numbering), t.number_step, t.annotate, static_cast<int>(t.cycles),
                                 t.raise_structure, t.encoding ? static_cast<int>(*t.encoding) : -1,
                                 t.eol ? static_cast<int>(*t.eol) : -1, t.run.max_events);
  for (const auto& l : t.libraries) text += "|" + l;
  if (!o.names_key.empty())
    text += "|" + o.names_key;
  else if (t.names != nullptr)
    text += "|" + names_text(*t.names, t.from, t.to);
  if (!t.tools.empty()) text += "|tools " + t.tools;
  if (!t.origin) text += "|no origin";
  if (o.reports) text += "|reports";
  text += fmt::format("|proof {} {} {} {} {}", t.verify, t.strict, t.further.skips, t.further.explore,
                      t.further.time ? t.further.time->count() : 0);
  for (const auto& [name, value] : t.run.set) text += "|" + name + "=" + value;
  return sum_of(text + "|" + std::to_string(t.run.skip_mask) + "|" + std::to_string(t.run.max_steps));
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

void count_codes(const Diagnostics& diagnostics, BatchRecord& r) {
  for (const auto& d : diagnostics.all()) {
    if (d.severity == Severity::error) ++r.errors[d.code];
    if (d.severity == Severity::warning) ++r.warnings[d.code];
  }
  for (const auto& [code, more] : diagnostics.more()) {
    if (more.severity == Severity::error) r.errors[code] += more.count;
    if (more.severity == Severity::warning) r.warnings[code] += more.count;
  }
}

std::string first_error(const TranslateResult& result) {
  for (const auto& d : result.diagnostics.all()) {
    if (d.severity == Severity::error) return fmt::format("line {}: {}: {}", d.span.line, d.code, d.message);
  }
  return {};
}

std::string status_of(const TranslateResult& result, bool readable) {
  if (!result.error.empty()) return "unreadable";
  if (result.refused) return "refused";
  if (result.draft) return "draft";
  if (!result.verified || !readable) return "written";
  switch (result.verdict.status) {
    case verifier::Status::verified: return "verified";
    case verifier::Status::within_tolerance: return "within tolerance";
    case verifier::Status::differs: return "differs";
    case verifier::Status::nothing_to_compare: return "no motion";
    case verifier::Status::not_replayable: break;
  }
  return "not replayable";
}

class Batch {
 public:
  explicit Batch(const BatchOptions& options) : options_(options), folder_(options), job_(job_sum(options)) {}

  BatchResult run(const std::function<void(const BatchProgress&)>& progress) {
    BatchResult result;
    const Dialect* from = find_readable(options_.translate.from, &result.error);
    const Dialect* to = find_dialect(options_.translate.to);
    if (from != nullptr && to == nullptr) result.error = unknown_dialect(options_.translate.to);
    std::error_code ignored;
    if (result.error.empty() && !fs::is_directory(options_.in, ignored))
      result.error = options_.in + " is not a folder";
    for (const auto& [dialect, machine] :
         {std::pair{from, &options_.translate.machine}, {to, &options_.translate.target_machine}})
      if (result.error.empty()) (void)choose_profile(*dialect, *machine, nullptr, &result.error);
    if (result.error.empty()) result.error = folder_.fault();
    if (!result.error.empty()) return result;
    readable_ = readable(*to);
    const auto all = programs(*from);
    result.all = all.size();
    if (!options_.collect_only) work(all, result, progress);
    collect(all, result);
    return result;
  }

  /// Those that this job is about.
  std::vector<std::string> programs(const Dialect& from) {
    auto all = programs_below(options_.in, folder_, from);
    if (options_.only.empty()) return all;
    const std::set<std::string> wanted(options_.only.begin(), options_.only.end());
    std::erase_if(all, [&wanted](const std::string& p) { return !wanted.contains(p); });
    return all;
  }
  [[nodiscard]] bool open(const std::string& program) const {
    return folder_.left_alone(program).empty() && (options_.again || !done(program));
  }

 private:
  struct Child {
    os::Child process;
    std::string program;
    Clock::time_point start;
  };

  /// The result of an earlier run, when it is still that of these files and options.
  [[nodiscard]] bool done(const std::string& program) const {
    const auto r = read_record(folder_.record_path(program));
    if (!r || r->job != job_ || r->status == "crashed" || r->status == "timed out" || r->status == "left alone")
      return false;
    return std::all_of(r->read.begin(), r->read.end(), [this](const auto& item) {
      const fs::path path(item.first);
      return sum_of_file((path.is_absolute() ? path : fs::path(options_.in) / path).string()) == item.second;
    });
  }

  void work(const std::vector<std::string>& all, BatchResult& result,
            const std::function<void(const BatchProgress&)>& progress) {
    std::vector<std::string> open;
    for (std::size_t i = options_.shard - 1; i < all.size(); i += options_.shards) {
      ++result.programs;
      if (const auto why = folder_.left_alone(all[i]); !why.empty())
        leave_alone(all[i], why);
      else if (!options_.again && done(all[i]))
        ++result.reused;
      else
        open.push_back(all[i]);
    }
    const auto start = Clock::now();
    std::size_t finished = 0;
    const auto tell = [&] {
      if (!progress) return;
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      const double rate = seconds > 0 ? static_cast<double>(finished) / seconds : 0;
      const auto left = static_cast<double>(open.size() - finished);
      progress({result.reused + finished, result.programs, rate, rate > 0 ? left / rate : 0});
    };
    std::vector<Child> children;
    for (std::size_t next = 0; finished < open.size();) {
      while (next < open.size() && children.size() < std::max(1U, options_.jobs))
        children.push_back(begin(open[next++]));
      const std::size_t before = children.size();
      std::erase_if(children, [this](Child& c) { return ended(c); });
      finished += before - children.size();
      tell();
      if (before == children.size()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  /// The record says so where it can be written; else it stands in the summary of this run alone.
  void leave_alone(const std::string& program, const std::string& why) {
    BatchRecord r = failed(program, "left alone", one_line(why));
    if (const auto before = read_record(folder_.record_path(program))) r.outputs = before->outputs;
    std::error_code ignored;
    if (!fs::exists(folder_.record_path(program), ignored) || !folder_.write_record(r))
      unrecorded_.push_back(std::move(r));
  }

  Child begin(const std::string& program) {
    Child c{{}, program, Clock::now()};
    if (!c.process.begin([&](std::FILE*) { return translate_one(program); }))
      folder_.write(failed(program, "crashed", "no process could be started"), {});
    return c;
  }

  bool ended(Child& c) const {
    const auto end = c.process.ended(false);
    if (!end) {
      if (!c.process.begun()) return true;
      if (Clock::now() - c.start < std::chrono::seconds(options_.timeout)) return false;
      c.process.kill();
      folder_.write(failed(c.program, "timed out", fmt::format("not done within {} s", options_.timeout)), {});
      return true;
    }
    if (end->good) return true;
    const std::string why = end->signal != 0 ? fmt::format("the translation ended with signal {}", end->signal)
                                             : "the translation ended without a result";
    folder_.write(failed(c.program, "crashed", why), {});
    return true;
  }

  [[nodiscard]] BatchRecord failed(const std::string& program, const char* status, std::string detail) const {
    BatchRecord r;
    r.program = program;
    r.status = status;
    r.detail = std::move(detail);
    r.job = job_;
    return r;
  }

  /// False: what became of it could not be written.
  bool translate_one(const std::string& program) const {
    const fs::path in(options_.in);
    TranslateOptions t = options_.translate;
    t.strict = t.strict && readable_;
    t.keep_traces = options_.reports;
    TranslateResult result;
    try {
      result = translate_file((in / program).string(), t);
    } catch (const std::bad_alloc&) {
      return folder_.write(failed(program, "crashed", "not enough memory for this program"), {});
    }
    BatchRecord r = failed(program, "", {});
    r.status = status_of(result, readable_);
    r.lines = result.lines;
    r.moves = result.verdict.moves;
    r.max_length = result.verdict.max_length;
    count_codes(result.diagnostics, r);
    if (!result.error.empty()) {
      r.detail = result.error;
    } else if (result.refused) {
      r.detail = first_error(result);
    } else if (!result.verified || !result.verdict.good() || result.lines_by_form != 0) {
      r.detail = proof_text(result, result.target_files);
    }
    r.detail = one_line(std::move(r.detail));
    for (FileId i = 1; i < result.files.size(); ++i) note_read(result.files.name(i), r);
    note_read((in / program).string(), r);
    for (const auto& file : {t.machine, t.target_machine, t.tools}) note_read(file, r);
    const bool bad = result.held_back && r.status != "no motion";
    std::vector<FileToWrite> files;
    for (const auto& out : result.outputs) files.push_back({bad ? out.name + ".unverified" : out.name, out.bytes});
    std::string report;
    if (options_.reports && result.error.empty()) {
      report = report_html(make_report((in / program).string(), t, result));
      r.report = report_name;
      files.push_back({r.report, report});
    }
    return folder_.write(std::move(r), files);
  }

  void note_read(const std::string& path, BatchRecord& r) const {
    const fs::path below = fs::path(path).lexically_relative(options_.in);
    const bool inside = !below.empty() && *below.begin() != "..";
    const std::string sum = sum_of_file(path);
    std::error_code ignored;
    if (!sum.empty()) r.read[inside ? below.generic_string() : fs::absolute(path, ignored).generic_string()] = sum;
  }

  /// The last shard that comes here sees the results of all: its summary is the one that stays.
  void collect(const std::vector<std::string>& all, BatchResult& result) const {
    const auto read = [&] {
      for (const auto& program : all) {
        const auto said = std::find_if(unrecorded_.begin(), unrecorded_.end(),
                                       [&](const BatchRecord& r) { return r.program == program; });
        if (said != unrecorded_.end()) {
          result.records.push_back(*said);
        } else if (auto r = read_record(folder_.record_path(program)); r && r->program == program) {
          result.records.push_back(std::move(*r));
        }
      }
      return result.records;
    };
    std::string error;
    if (!folder_.write_summary(read, all.size(), &error))
      result.error = "the summary can't be written to " + options_.out + ": " + error;
  }

  const BatchOptions& options_;
  BatchFolder folder_;
  std::string job_;
  std::vector<BatchRecord> unrecorded_;
  bool readable_ = true;  ///< the target: what is written can be replayed
};

}  // namespace

std::vector<std::string> batch_programs(const BatchOptions& options) {
  std::string ignored;
  const Dialect* from = find_readable(options.translate.from, &ignored);
  return from != nullptr ? Batch(options).programs(*from) : std::vector<std::string>();
}

std::vector<std::string> batch_open(const BatchOptions& options) {
  std::vector<std::string> list = batch_programs(options);
  const Batch job(options);
  std::erase_if(list, [&job](const std::string& p) { return !job.open(p); });
  return list;
}

BatchResult batch(const BatchOptions& options, const std::function<void(const BatchProgress&)>& progress) {
  return Batch(options).run(progress);
}

}  // namespace cnctrans::translator
