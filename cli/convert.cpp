#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>

#include "base/text.h"
#include "cli/common.h"
#include "cli/stdout_sink.h"
#include "translator/names_file.h"
#include "translator/report/report.h"
#include "translator/stream.h"
#include "translator/stream_proof.h"

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

void refuse(const Arguments& a, const std::string& input) {
  a.messages->say(Severity::error, "CNC-REFUSED", "cnctrans: " + input + ": refused, nothing is written");
}
void not_written(const Arguments& a, const std::string& why) {
  a.messages->say(Severity::error, "CNC-OUTPUT", "cnctrans: " + why);
}
void wrote(const Arguments& a, const std::string& path) {
  if (!a.quiet) a.messages->say(Severity::note, "CNC-WRITTEN", "wrote " + path);
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

  /// Another file of this job has the program that this one would bring: the control knows programs by these.
  std::string same_program(const fs::path& path, const translator::OutputText& out, const std::string& input) {
    if (out.program.size() < 2 || out.program.find_first_not_of("0123456789", 1) != std::string::npos) return {};
    std::error_code ignored;
    const auto place = fs::weakly_canonical(fs::absolute(path), ignored).string();
    const auto [it, fresh] = programs_.emplace(out.program, std::pair{place, input});
    if (fresh || iequals_ascii(it->second.first, place)) return {};
    return path.string() + " would be the program " + out.program + ", which " + it->second.first +
           " is already, from the translation of " + it->second.second + "; give one of them another number by --names";
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
  std::map<std::string, std::pair<std::string, std::string>> programs_;  ///< file and input by `%n`
  std::set<std::string> names_;
};

/// The map of names of --names: what stands in the file, and what the translations of this call add.
class NamesFile {
 public:
  explicit NamesFile(const Arguments& a) : a_(a) {}
  ir::NameMap map;

  /// False, and the reason is said: it is there and can't be used.
  bool read() {
    std::error_code ignored;
    if (a_.names.empty() || !fs::exists(a_.names, ignored)) return true;
    std::string error;
    auto found = translator::read_names(a_.names, a_.from, a_.to, &error);
    if (!found) {
      usage_error(a_, error);
      return false;
    }
    map = *std::move(found);
    before_ = map;
    return true;
  }
  /// A file whose names are all there already is left as it is.
  [[nodiscard]] bool write() const {
    if (a_.names.empty() || map == before_) return true;
    std::string error;
    if (!write_file(a_.names, translator::names_text(map, a_.from, a_.to), &error)) {
      not_written(a_, error);
      return false;
    }
    wrote(a_, a_.names);
    return true;
  }

 private:
  const Arguments& a_;
  ir::NameMap before_;
};

/// Reports every file of the translation that can't be written; true: none.
bool may_write(const Arguments& a, const translator::TranslateResult& result, const std::string& input, Job& job) {
  Diagnostics diagnostics;
  for (const auto& out : result.outputs) {
    const std::string why = job.conflict(target_path(a, out), out.bytes, input, result.files);
    const std::string same = job.same_program(target_path(a, out), out, input);
    for (const auto& text : {why, same})
      if (!text.empty()) diagnostics.error("TRN-093", {}, text);
  }
  if (!diagnostics.has_errors()) return true;
  a.messages->add(diagnostics, result.files);
  refuse(a, input);
  return false;
}

int write_outputs(const Arguments& a, const translator::TranslateResult& result) {
  if (a.output.empty() || a.output == "-") {
    if (result.held_back) {
      a.messages->say(Severity::note, "CNC-WRITTEN",
                      "cnctrans: the translation is not printed; -o FILE keeps it as FILE.unverified, --no-verify "
                      "writes it without proof");
      return ok;
    }
    for (const auto& out : result.outputs) write_all(stdout, out.bytes);
    return stdout_arrived() ? ok : refused;
  }
  for (const auto& out : result.outputs) {
    fs::path path = target_path(a, out);
    if (result.held_back) path += ".unverified";
    std::string error;
    if (!write_file(path, out.bytes, &error)) {
      not_written(a, error);
      return refused;
    }
    wrote(a, path.string());
  }
  return ok;
}

bool write_report(const Arguments& a, const translator::TranslateOptions& options, const std::string& input,
                  const translator::TranslateResult& result) {
  std::string error;
  std::vector<std::string> written;
  if (was_read(a.report, result.files)) {
    not_written(a, a.report + " is read by this job and is not written over; choose another place with --report");
    return false;
  }
  for (const auto& out : result.outputs)
    written.push_back(a.output.empty() || a.output == "-" ? out.name : target_path(a, out).string());
  const auto text = (*translator::report_writer(a.report))(translator::make_report(input, options, result, written));
  if (!write_file(a.report, text, &error)) {
    not_written(a, error);
    return false;
  }
  wrote(a, a.report);
  return true;
}

/// The files of the verification under the names they were written to.
FileTable targets_as_written(const Arguments& a, const translator::TranslateResult& result) {
  if (a.output.empty() || a.output == "-") return result.target_files;
  FileTable files;
  for (const auto& out : result.outputs)
    files.add(
        SourceText::from_string(target_path(a, out).string() + (result.held_back ? ".unverified" : ""), out.bytes));
  return files;
}

/// What the proofs of a call came to: its last lines.
class Proofs {
 public:
  explicit Proofs(const Arguments& a) : a_(a) {}

  void add(const std::string& input, const translator::TranslateOptions& options,
           const translator::TranslateResult& result) {
    if (!result.verified) return;
    const FileTable targets = targets_as_written(a_, result);
    a_.messages->add(result.target_diagnostics, targets);
    const std::string text = input + ": " + translator::proof_text(result, targets);
    if (result.verdict.good()) {
      if (!a_.quiet || options.strict) lines_.push_back({Severity::note, text});
    } else {
      lines_.push_back({result.held_back ? Severity::error : Severity::warning, text});
    }
  }
  void verified(const std::string& input, const verifier::Verdict& verdict) {
    if (!a_.quiet) lines_.push_back({Severity::note, input + ": " + verifier::describe(verdict, {}, {})});
  }
  void not_proved(const std::string& input, const std::string& why) {
    lines_.push_back({Severity::warning, input + ": not proved: " + why});
  }
  void say() const {
    for (const auto& line : lines_) a_.messages->say(line.severity, "CNC-VERDICT", line.text);
  }

 private:
  struct Line {
    Severity severity;
    std::string text;
  };
  const Arguments& a_;
  std::vector<Line> lines_;
};

/// The whole-program path: in memory, with calls, proved.
int convert_whole(const Arguments& a, const translator::TranslateOptions& options, const std::string& input, Job& job,
                  ir::NameMap& names, Proofs& proofs) {
  translator::TranslateOptions with = options;
  with.taken = job.names();
  with.single_output = a.output.empty() || a.output == "-";
  with.files_apart = is_folder(a.output);
  const auto result = translator::translate(input, with);
  if (!result.error.empty()) return usage_error(a, result.error);
  a.messages->add(result.diagnostics, result.files);
  if (!a.report.empty() && !write_report(a, options, input, result)) return refused;
  if (result.refused) {
    refuse(a, input);
    return refused;
  }
  if (!with.single_output && !may_write(a, result, input, job)) return refused;
  job.take_names(result);
  const int status = write_outputs(a, result);
  if (status == ok && !result.held_back) translator::add_names(names, result.names);
  proofs.add(input, options, result);
  return result.held_back ? std::max(status, exit_of(result.verdict)) : status;
}

/// A straight-line file of this size is still proved as a whole program where a proof in step can't be made: that takes
/// memory (docs/verify.md).
constexpr std::uintmax_t replayed_bytes = 2'000'000;

using Spool = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// The text of a spool goes to where the call wants it. False: it can't be written; that is said.
bool write_spool(const Arguments& a, std::FILE* spool) {
  const bool to_stdout = a.output.empty() || a.output == "-";
  std::string error = "the standard output could not be written";
  AtomicFile file(a.output);
  bool good = to_stdout || file.open(&error);
  std::string buffer(1U << 18U, '\0');
  std::rewind(spool);
  while (good) {
    const std::string_view piece(buffer.data(), std::fread(buffer.data(), 1, buffer.size(), spool));
    if (piece.empty()) break;
    good = to_stdout ? write_all(stdout, piece) : file.write(piece, &error);
  }
  good = good && std::ferror(spool) == 0 && (to_stdout ? stdout_arrived() : file.commit(&error));
  if (!good) not_written(a, error);
  return good;
}

/// The stream with its proof: what it writes is put aside until both texts have been replayed in step.
std::optional<int> convert_stream_proved(const Arguments& a, const translator::TranslateOptions& options,
                                         const std::string& input, Proofs& proofs) {
  const Spool spool(std::tmpfile(), &std::fclose);
  if (!spool) return std::nullopt;
  ProgressLine progress(input);
  translator::TranslateOptions with = options;
  with.verify = false;
  const auto keep = [&spool](std::string_view text) { return write_all(spool.get(), text); };
  const auto result = translator::translate_stream(input, with, keep, [&progress](double part) { progress(part); });
  if (result.outcome != translator::StreamOutcome::done || std::fflush(spool.get()) != 0) return std::nullopt;
  const std::string text = "/proc/self/fd/" + std::to_string(::fileno(spool.get()));
  const auto proof = translator::prove_stream(input, text, options);
  std::error_code ignored;
  const bool small = fs::file_size(input, ignored) <= replayed_bytes;
  const bool proved = proof.proved == translator::StreamProved::yes;
  if (!proved && (small || proof.proved == translator::StreamProved::no)) return std::nullopt;
  if (!write_spool(a, spool.get())) return refused;
  a.messages->add(result.diagnostics, result.files);
  if (!a.output.empty() && a.output != "-") wrote(a, a.output);
  if (proved) {
    proofs.verified(input, proof.verdict);
  } else {
    proofs.not_proved(input,
                      "a file of more than 2 MB that can't be replayed line by line; --verify replays it in memory");
  }
  return ok;
}

/// Tries the stream; nullopt: the whole-program path must do it.
std::optional<int> convert_stream(const Arguments& a, const translator::TranslateOptions& options,
                                  const std::string& input, Proofs& proofs) {
  if (options.annotate || options.names != nullptr || is_folder(a.output) || !a.report.empty()) return std::nullopt;
  if (options.verify && options.strict) return std::nullopt;
  std::error_code ignored;
  if (fs::equivalent(a.output, input, ignored)) return std::nullopt;
  if (options.verify) return convert_stream_proved(a, options, input, proofs);
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
      not_written(a, "the standard output could not be written");
      return refused;
    }
  } else {
    AtomicFile file(a.output);
    if (!file.open(&error)) return std::nullopt;
    result = translator::translate_stream(
        input, options, [&file, &error](std::string_view t) { return file.write(t, &error); }, tell);
    if (result.outcome == translator::StreamOutcome::done && !file.commit(&error)) {
      not_written(a, error);
      return refused;
    }
  }
  if (result.outcome != translator::StreamOutcome::done) return std::nullopt;
  a.messages->add(result.diagnostics, result.files);
  if (!to_stdout) wrote(a, a.output);
  return ok;
}

}  // namespace

int convert(const Arguments& a) {
  if (a.from.empty() || a.to.empty()) return usage_error(a, "--from and --to are needed");
  if (a.inputs.empty()) return usage_error(a, "no input file");
  if (a.inputs.size() > 1 && !is_folder(a.output)) return usage_error(a, "several input files need -o FOLDER/");
  if (!a.report.empty() && a.inputs.size() > 1) return usage_error(a, "--report takes one input file");
  if (!a.report.empty() && !translator::report_writer(a.report))
    return usage_error(a, "--report FILE must end in .html, .json, .md or .sarif");
  const std::string folder = is_folder(a.output) ? std::string() : a.output;
  std::string why = output_conflict({{"--report", a.report}, {"--names", a.names}}, a.inputs);
  if (why.empty())
    why = output_conflict({{"-o", folder}, {"--report", a.report}, {"--names", a.names}}, machine_files(a));
  if (!why.empty()) return usage_error(a, why);
  translator::TranslateOptions options;
  if (!proved_options(a, options)) return usage;
  options.keep_traces = !a.report.empty();
  int status = ok;
  Job job(a.inputs);
  NamesFile names(a);
  if (!names.read()) return usage;
  if (!a.names.empty()) options.names = &names.map;
  Proofs proofs(a);
  for (const auto& input : a.inputs) {
    const auto streamed = convert_stream(a, options, input, proofs);
    status = std::max(status, streamed ? *streamed : convert_whole(a, options, input, job, names.map, proofs));
  }
  if (!names.write()) status = std::max<int>(status, refused);
  proofs.say();
  return status;
}

}  // namespace cnctrans::cli
