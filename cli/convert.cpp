#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>

#include "base/text.h"
#include "cli/common.h"
#include "cli/stdout_sink.h"
#include "translator/report/report.h"
#include "translator/stream.h"

namespace cnctrans::cli {

namespace fs = std::filesystem;

namespace {

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return !path.empty() && (path.back() == '/' || fs::is_directory(path, ignored));
}

bool write_file(const fs::path& path, std::string_view bytes, std::string* error) {
  std::error_code ignored;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), ignored);
  AtomicFile file(path.string());
  return file.open(error) && file.write(bytes, error) && file.commit(error);
}

/// Where one output goes.
fs::path target_path(const Arguments& a, const translator::OutputText& out) {
  if (is_folder(a.output)) return fs::path(a.output) / out.name;
  if (out.main) return a.output;
  return fs::path(a.output).parent_path() / out.name;
}

/// What the job has written. No file is written twice with different content, and no input is written over.
class Job {
 public:
  explicit Job(const std::vector<std::string>& inputs) : inputs_(inputs) {}

  /// Names that the programs of further inputs may not have.
  [[nodiscard]] const std::set<std::string>& names() const { return names_; }

  /// Why `bytes` can't be written to `path`; empty when they can.
  std::string conflict(const fs::path& path, std::string_view bytes, const std::string& input, const FileTable& read) {
    std::error_code ignored;
    const auto is_input = [&](const std::string& name) { return fs::equivalent(path, name, ignored); };
    bool source = std::any_of(inputs_.begin(), inputs_.end(), is_input);
    for (FileId i = 1; i < read.size(); ++i) source = source || is_input(read.name(i));
    if (source) return path.string() + " is read by this job and is not written over; choose another place with -o";
    const Written now{input, std::hash<std::string_view>{}(bytes), bytes.size()};
    const auto [it, fresh] =
        written_.emplace(to_upper_ascii(fs::weakly_canonical(fs::absolute(path), ignored).string()), now);
    const Written& before = it->second;
    if (fresh || (before.hash == now.hash && before.size == now.size)) return {};
    return path.string() + " holds a different program already, from the translation of " + before.input +
           "; translate the two into different folders";
  }

  void take_names(const translator::TranslateResult& result) {
    for (const auto& out : result.outputs) {
      names_.insert(to_upper_ascii(out.name));
      if (!out.program.empty()) names_.insert(to_upper_ascii(out.program));
    }
  }

 private:
  struct Written {
    std::string input;
    std::size_t hash = 0, size = 0;
  };
  const std::vector<std::string>& inputs_;
  std::map<std::string, Written> written_;  ///< by path in capitals: the target's file system may not tell case
  std::set<std::string> names_;
};

/// Reports every file of the translation that can't be written; true: none.
bool may_write(const Arguments& a, const translator::TranslateResult& result, const std::string& input, Job& job) {
  Diagnostics diagnostics;
  for (const auto& out : result.outputs) {
    const std::string why = job.conflict(target_path(a, out), out.bytes, input, result.files);
    if (!why.empty()) diagnostics.error("TRN-093", {}, why);
  }
  if (!diagnostics.has_errors()) return true;
  print_diagnostics(a, diagnostics, result.files);
  write_all(stderr, "cnctrans: " + input + ": refused, nothing is written\n");
  return false;
}

int write_outputs(const Arguments& a, const translator::TranslateResult& result, bool unverified) {
  if (a.output.empty() || a.output == "-") {
    if (unverified) {
      write_all(stderr, "cnctrans: the translation is not printed; use -o to keep it as FILE.unverified\n");
      return limit_or_difference;
    }
    for (const auto& out : result.outputs) write_all(stdout, out.bytes);
    return stdout_arrived() ? ok : refused;
  }
  for (const auto& out : result.outputs) {
    fs::path path = target_path(a, out);
    if (unverified) path += ".unverified";
    std::string error;
    if (!write_file(path, out.bytes, &error)) {
      write_all(stderr, "cnctrans: " + error + "\n");
      return refused;
    }
    if (!a.quiet) write_all(stderr, "wrote " + path.string() + "\n");
  }
  return unverified ? limit_or_difference : ok;
}

bool write_report(const Arguments& a, const translator::TranslateOptions& options, const std::string& input,
                  const translator::TranslateResult& result) {
  std::string error;
  std::vector<std::string> written;
  for (const auto& out : result.outputs)
    written.push_back(a.output.empty() || a.output == "-" ? out.name : target_path(a, out).string());
  const auto text = (*translator::report_writer(a.report))(translator::make_report(input, options, result, written));
  if (!write_file(a.report, text, &error)) {
    write_all(stderr, "cnctrans: " + error + "\n");
    return false;
  }
  if (!a.quiet) write_all(stderr, "wrote " + a.report + "\n");
  return true;
}

/// The whole-program path: in memory, with calls, verified on request.
int convert_whole(const Arguments& a, const translator::TranslateOptions& options, const std::string& input, Job& job) {
  translator::TranslateOptions with = options;
  with.taken = job.names();
  with.single_output = a.output.empty() || a.output == "-";
  const auto result = translator::translate(input, with);
  if (!result.error.empty()) return usage_error(result.error);
  print_diagnostics(a, result.diagnostics, result.files);
  if (!a.report.empty() && !write_report(a, options, input, result)) return refused;
  if (result.refused) {
    write_all(stderr, "cnctrans: " + input + ": refused, nothing is written\n");
    return refused;
  }
  if (!with.single_output && !may_write(a, result, input, job)) return refused;
  job.take_names(result);
  const bool bad = result.verified && !result.verdict.good();
  const int status = write_outputs(a, result, bad);
  if (result.verified)
    write_all(stderr, input + ": " + verifier::describe(result.verdict, result.files, result.target_files) + "\n");
  return status;
}

/// Tries the stream; nullopt: the whole-program path must do it.
std::optional<int> convert_stream(const Arguments& a, const translator::TranslateOptions& options,
                                  const std::string& input) {
  if (options.verify || options.annotate || is_folder(a.output)) return std::nullopt;
  std::error_code ignored;
  if (fs::equivalent(a.output, input, ignored)) return std::nullopt;
  ProgressLine progress(input);
  const auto tell = [&progress](double part) { progress(part); };
  const bool to_stdout = a.output.empty() || a.output == "-";
  std::string error;
  translator::StreamResult result;
  if (to_stdout) {
    StdoutSink sink;
    if (!sink.good()) return std::nullopt;
    result = translator::translate_stream(
        input, options, [&sink](std::string_view t) { return sink.write(t); }, tell);
    const bool kept = result.outcome == translator::StreamOutcome::done;
    if (!(kept ? sink.commit() : sink.discard())) {
      write_all(stderr, "cnctrans: the standard output could not be written\n");
      return refused;
    }
  } else {
    AtomicFile file(a.output);
    if (!file.open(&error)) return std::nullopt;
    result = translator::translate_stream(
        input, options, [&file, &error](std::string_view t) { return file.write(t, &error); }, tell);
    if (result.outcome == translator::StreamOutcome::done && !file.commit(&error)) {
      write_all(stderr, "cnctrans: " + error + "\n");
      return refused;
    }
  }
  if (result.outcome != translator::StreamOutcome::done) return std::nullopt;
  print_diagnostics(a, result.diagnostics, result.files);
  if (!to_stdout && !a.quiet) write_all(stderr, "wrote " + a.output + "\n");
  return ok;
}

}  // namespace

int convert(const Arguments& a) {
  if (a.from.empty() || a.to.empty()) return usage_error("--from and --to are needed");
  if (a.inputs.empty()) return usage_error("no input file");
  if (a.inputs.size() > 1 && !is_folder(a.output)) return usage_error("several input files need -o FOLDER/");
  if (!a.report.empty() && a.inputs.size() > 1) return usage_error("--report takes one input file");
  if (!a.report.empty() && !translator::report_writer(a.report))
    return usage_error("--report FILE must end in .html, .json, .md or .sarif");
  translator::TranslateOptions options;
  if (!translate_options(a, options)) return usage;
  if (!a.report.empty())
    options.verify = options.keep_traces = true;  // a report without its proof would be half of one
  int status = ok;
  Job job(a.inputs);
  for (const auto& input : a.inputs) {
    const auto streamed = convert_stream(a, options, input);
    status = std::max(status, streamed ? *streamed : convert_whole(a, options, input, job));
  }
  return status;
}

}  // namespace cnctrans::cli
