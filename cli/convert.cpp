#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "base/sum.h"
#include "base/text.h"
#include "cli/common.h"
#include "translator/files/names_file.h"
#include "translator/files/written_files.h"
#include "translator/folding/unfolding.h"
#include "translator/report/report.h"
#include "translator/translation/draft.h"

namespace cnctrans::cli {

namespace fs = std::filesystem;
using translator::WrittenFiles;

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
  if (out.main) return out.name.find(".draft.") == std::string::npos ? a.output : translator::draft_name(a.output);
  return fs::path(a.output).parent_path() / out.name;
}

/// What the job may write. No input is written over, and nothing that was made of another program (written_files.h).
class Job {
 public:
  explicit Job(const Arguments& a) : a_(a) {}

  void begin(std::size_t input) { at_ = input; }
  [[nodiscard]] const std::string& input() const { return a_.inputs[at_]; }
  [[nodiscard]] WrittenFiles::Origin origin() const {
    return {input(), {a_.inputs.begin() + static_cast<std::ptrdiff_t>(at_) + 1, a_.inputs.end()}, a_.force};
  }

  /// Names that the program of this input may not have.
  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> names = names_;
    if (is_folder(a_.output)) names.merge(WrittenFiles(a_.output, WrittenFiles::Use::look).taken(origin()));
    return names;
  }
  void take_names(const translator::TranslateResult& result) {
    for (const auto& out : result.outputs) {
      names_.insert(to_upper_ascii(out.name));
      if (!out.program.empty()) names_.insert(to_upper_ascii(out.program));
    }
  }

  /// The job reads the file.
  [[nodiscard]] bool reads(const fs::path& path, const FileTable& read) const {
    std::error_code ignored;
    const auto is_input = [&](const std::string& name) { return fs::equivalent(path, name, ignored); };
    bool source = std::any_of(a_.inputs.begin(), a_.inputs.end(), is_input);
    for (FileId i = 1; i < read.size(); ++i) source = source || is_input(read.name(i));
    return source;
  }

 private:
  const Arguments& a_;
  std::size_t at_ = 0;
  std::set<std::string> names_;
};

/// A pipe or a device: nothing is replaced there.
bool is_stream(const std::string& path) {
  std::error_code ignored;
  if (path.starts_with("/dev/") || path.starts_with("/proc/")) return true;
  return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored) && !fs::is_directory(path, ignored);
}

/// Says why files are left alone; true: none is.
bool say_conflicts(const Arguments& a, const std::vector<std::string>& why, const FileTable& files) {
  Diagnostics diagnostics;
  for (const auto& text : why)
    diagnostics.error("TRN-093", {}, text, "choose another place with -o, or replace it with --force");
  a.messages->add(diagnostics, files);
  return why.empty();
}

/// A file that an option names, written as an output is.
bool write_named(const Arguments& a, const std::string& path, std::string_view bytes, const Job& job) {
  std::string error;
  if (is_stream(path)) {
    if (write_file(path, bytes, &error)) return true;
  } else {
    WrittenFiles folder(fs::path(path).parent_path());
    const std::vector<translator::FileToWrite> file{{fs::path(path).filename().string(), bytes, {}, true}};
    if (!say_conflicts(a, folder.conflicts(file, job.origin()), {})) return false;
    if (folder.write(file, job.origin(), &error)) return true;
  }
  not_written(a, error);
  return false;
}

/// The map of names of --names: what stands in the file, and what the translations of this call add.
class NamesFile {
 public:
  explicit NamesFile(const Arguments& a) : a_(a) {}
  translator::Names names;

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
    names = *std::move(found);
    before_ = names.map;
    return true;
  }
  /// A file whose names are all there already is left as it is.
  [[nodiscard]] bool write() const {
    if (a_.names.empty() || names.map == before_) return true;
    std::string error;
    if (!write_file(a_.names, translator::names_text(names, a_.from, a_.to), &error)) {
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

/// The outputs of a translation, with the lines that a folded text leaves out.
class Outputs {
 public:
  Outputs(const translator::TranslateResult& result, const translator::Unfolding* unfolding)
      : result_(result), unfolding_(unfolding) {}

  [[nodiscard]] const translator::TranslateResult& result() const { return result_; }
  [[nodiscard]] bool folded() const { return unfolding_ != nullptr; }
  /// The whole text of one. False: the sink, or the source has changed meanwhile.
  [[nodiscard]] bool write(std::size_t i, const translator::TextSink& sink) const {
    return folded() ? unfolding_->write(i, result_.outputs[i].bytes, sink) : sink(result_.outputs[i].bytes);
  }

 private:
  const translator::TranslateResult& result_;
  const translator::Unfolding* unfolding_;
};

/// A long file, written beside its place until it may stand there.
std::shared_ptr<AtomicFile> write_beside(const fs::path& path, const Outputs& outputs, std::size_t i, std::string& sum,
                                         std::string* error) {
  std::error_code ignored;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), ignored);
  auto file = std::make_shared<AtomicFile>(path.string());
  Sum adding;
  const auto sink = [&](std::string_view piece) {
    adding.add(piece);
    return file->write(piece, error);
  };
  if (!file->open(error)) return nullptr;
  if (!outputs.write(i, sink)) {
    if (error->empty()) *error = "the program was changed while it was translated";
    return nullptr;
  }
  sum = adding.text();
  return file;
}

/// The files of the translation, all of one folder. False, and the reason is said: one of them can't be written, and
/// none is.
bool write_files(const Arguments& a, const Outputs& outputs, const Job& job) {
  const translator::TranslateResult& result = outputs.result();
  const fs::path output(a.output), place = is_folder(a.output) ? output : output.parent_path();
  std::vector<translator::FileToWrite> files;
  std::vector<std::string> why;
  std::string error;
  for (std::size_t i = 0; i < result.outputs.size(); ++i) {
    const auto& out = result.outputs[i];
    const fs::path path = target_path(a, out);
    if (job.reads(path, result.files)) why.push_back(path.string() + " is read by this job and is not written over");
    auto& file = files.emplace_back();
    file.name = path.filename().string() + (result.held_back ? ".unverified" : "");
    file.bytes = out.bytes;
    file.program = out.program;
    file.named = out.main && !is_folder(a.output);
    if (!outputs.folded() || !why.empty()) continue;
    const auto beside = write_beside(place / file.name, outputs, i, file.sum, &error);
    if (!beside) {
      not_written(a, error);
      return false;
    }
    file.put_in_place = [beside](std::string* fault) { return beside->commit(fault); };
  }
  WrittenFiles folder(place, is_stream(a.output) ? WrittenFiles::Use::look : WrittenFiles::Use::write);
  if (why.empty()) why = folder.conflicts(files, job.origin());
  if (!say_conflicts(a, why, result.files)) {
    refuse(a, job.input());
    return false;
  }
  if (!folder.write(files, job.origin(), &error)) {
    not_written(a, error);
    return false;
  }
  for (const auto& f : files) wrote(a, (place / f.name).string());
  return true;
}

int write_outputs(const Arguments& a, const Outputs& outputs, const Job& job) {
  if (!a.output.empty() && a.output != "-") return write_files(a, outputs, job) ? ok : refused;
  if (outputs.result().held_back) {
    a.messages->say(Severity::note, "CNC-WRITTEN",
                    "cnctrans: the translation is not printed; -o FILE keeps it as FILE.unverified, --no-verify "
                    "writes it without proof");
    return ok;
  }
  for (std::size_t i = 0; i < outputs.result().outputs.size(); ++i) {
    if (!outputs.write(i, [](std::string_view text) { return write_all(stdout, text); })) break;
  }
  return stdout_arrived() ? ok : refused;
}

bool write_report(const Arguments& a, const translator::TranslateOptions& options, const Job& job,
                  const translator::TranslateResult& result) {
  std::vector<std::string> written;
  if (was_read(a.report, result.files)) {
    not_written(a, a.report + " is read by this job and is not written over; choose another place with --report");
    return false;
  }
  for (const auto& out : result.outputs)
    written.push_back(a.output.empty() || a.output == "-" ? out.name : target_path(a, out).string());
  const auto text =
      (*translator::report_writer(a.report))(translator::make_report(job.input(), options, result, written));
  if (!write_named(a, a.report, text, job)) return false;
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

void tell_draft(const Arguments& a, const std::string& input, const translator::TranslateResult& result) {
  const auto count = [](std::size_t n, const char* what) {
    return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
  };
  a.messages->say(Severity::warning, "CNC-DRAFT",
                  input + ": a draft: " + count(result.to_do.size(), "thing") + " to do, " +
                      count(result.untranslated.size(), "line") + " not translated");
}

int convert_one(const Arguments& a, const translator::TranslateOptions& options, Job& job, ir::NameMap& names,
                Proofs& proofs) {
  const std::string& input = job.input();
  translator::TranslateOptions with = options;
  with.taken = job.names();
  with.single_output = a.output.empty() || a.output == "-";
  with.files_apart = is_folder(a.output);
  const auto folded = input == "-" ? nullptr : translator::translate_folded(input, with);
  const auto result = folded ? std::move(folded->result) : translator::translate(input_of(a, input), with);
  if (!result.error.empty()) return usage_error(a, result.error);
  a.messages->add(result.diagnostics, result.files);
  if (!a.report.empty() && !write_report(a, options, job, result)) return refused;
  if (result.refused) {
    refuse(a, input);
    return refused;
  }
  if (const int status = write_outputs(a, {result, folded ? folded->unfolding.get() : nullptr}, job); status != ok)
    return status;
  job.take_names(result);
  if (!result.held_back) translator::add_names(names, result.names);
  proofs.add(input, options, result);
  if (result.draft) {
    tell_draft(a, input, result);
    return draft;
  }
  return result.held_back ? exit_of(result.verdict) : ok;
}

}  // namespace

int convert(const Arguments& a) {
  if (a.inputs.empty()) return usage_error(a, "no input file");
  if (a.to.empty()) return usage_error(a, "--to is needed: the language of the translation");
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
  Job job(a);
  NamesFile names(a);
  if (!names.read()) return usage;
  if (!a.names.empty()) options.names = &names.names;
  if (!add_definitions(a, names.names, options)) return usage;
  Proofs proofs(a);
  for (std::size_t i = 0; i < a.inputs.size(); ++i) {
    job.begin(i);
    status = std::max(status, convert_one(a, options, job, names.names.map, proofs));
  }
  if (!names.write()) status = std::max<int>(status, refused);
  proofs.say();
  return status;
}

}  // namespace cnctrans::cli
