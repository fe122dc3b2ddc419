#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/text.h"
#include "cli/common.h"
#include "interpreter/trace/run_codes.h"
#include "interpreter/trace/trace.h"
#include "translator/files/written_files.h"

namespace cnctrans::cli {

namespace {

/// Where `--trace` and `--vars` write: a file (through a temporary) or standard output. The first fault is kept.
class Target {
 public:
  explicit Target(const Arguments& a) : a_(a) {}
  bool open(const std::string& where) {
    path_ = where;
    if (where == "-") return true;
    file_ = std::make_unique<AtomicFile>(where);
    good_ = file_->open(&error_);
    return good_;
  }
  void write(std::string_view text) {
    if (good_) good_ = file_ ? file_->write(text, &error_) : write_all(stdout, text);
  }
  [[nodiscard]] bool failed() const { return !good_; }
  /// Everything written has arrived. No file that the run has read is written over.
  bool close(const FileTable& read) {
    if (!file_) return stdout_arrived();
    if (good_ && was_read(path_, read)) {
      good_ = false;
      error_ = path_ + ": the run has read this file; it is not written over";
    }
    good_ = good_ && file_->commit(&error_);
    if (!good_) a_.messages->say(Severity::error, "CNC-OUTPUT", "cnctrans: " + error_);
    return good_;
  }
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  const Arguments& a_;
  std::string path_;
  std::unique_ptr<AtomicFile> file_;
  std::string error_;
  bool good_ = true;
};

class JsonSink : public interpreter::TraceSink {
 public:
  JsonSink(Target& target, const FileTable& files, const std::vector<std::string>& axes)
      : target_(target), files_(files), axes_(axes) {}
  ~JsonSink() override { flush(); }
  void on_event(const interpreter::Event& e) override {
    if (target_.failed()) return;
    buffer_ += interpreter::to_json(e, files_, axes_);
    buffer_ += '\n';
    if (buffer_.size() > (1U << 16U)) flush();
  }

 private:
  void flush() {
    target_.write(buffer_);
    buffer_.clear();
  }
  Target& target_;
  const FileTable& files_;
  const std::vector<std::string>& axes_;
  std::string buffer_;
};

std::string vars_json(const interpreter::Result& result) {
  std::string text = "{";
  for (const auto& [name, value] : result.variables) {
    if (text.size() > 1) text += ", ";
    text += '"';
    for (const char c : name) {
      if (c == '"' || c == '\\') text += '\\';
      text += c;
    }
    text += "\": " + value;
  }
  return text + "}\n";
}

/// What the program has written, each file in the folder of --written. No file is written over that the run has read
/// or that belongs to somebody else (translator/files/written_files.h).
bool write_files(const Arguments& a, const translator::RunResult& result) {
  const translator::WrittenFiles::Origin origin{a.inputs.front(), {}, a.force};
  translator::WrittenFiles folder(a.written);
  std::vector<translator::FileToWrite> files;
  std::string error;
  for (const auto& [name, text] : result.written) {
    const std::string path = (std::filesystem::path(a.written) / name).string();
    if (was_read(path, result.files)) error = path + ": the run has read this file; it is not written over";
    files.push_back({name, text});
  }
  if (error.empty())
    for (const auto& why : folder.conflicts(files, origin)) error = why + "; --force replaces it";
  if (error.empty() && folder.write(files, origin, &error)) return true;
  a.messages->say(Severity::error, "CNC-OUTPUT", "cnctrans: " + error);
  return false;
}

int exit_of(interpreter::EndReason reason) {
  switch (reason) {
    case interpreter::EndReason::program_end: return ok;
    case interpreter::EndReason::error: return refused;
    case interpreter::EndReason::event_limit:
    case interpreter::EndReason::step_limit: break;
  }
  return limit_or_difference;
}

}  // namespace

int run(const Arguments& a) {
  translator::RunOptions options;
  if (!run_options(a, options)) return usage;
  if (a.inputs.size() != 1) return usage_error(a, "run takes one program");
  std::vector<std::string> read = machine_files(a);
  read.push_back(a.inputs.front());
  if (!a.written.empty() && !std::filesystem::is_directory(a.written))
    return usage_error(a, "--written " + a.written + ": no such folder");
  if (const auto why = output_conflict({{"--trace", a.trace}, {"--vars", a.vars}}, read); !why.empty())
    return usage_error(a, why);
  Target trace(a), vars(a);
  if (!a.trace.empty() && !trace.open(a.trace)) return usage_error(a, trace.error());
  if (!a.vars.empty() && !vars.open(a.vars)) return usage_error(a, vars.error());
  const auto make_sink = [&](const FileTable& files,
                             const std::vector<std::string>& axes) -> std::unique_ptr<interpreter::TraceSink> {
    if (a.trace.empty()) return std::make_unique<interpreter::TraceCounter>();
    return std::make_unique<JsonSink>(trace, files, axes);
  };
  options.may_stream = a.trace.empty();
  const auto result = translator::run(input_of(a, a.inputs.front()), options, make_sink);
  if (!result.error.empty()) return usage_error(a, result.error);
  if (!a.trace.empty() && !trace.close(result.files)) return usage;
  if (!a.vars.empty()) {
    vars.write(vars_json(result.result));
    if (!vars.close(result.files)) return usage;
  }
  if (!a.written.empty() && !write_files(a, result)) return usage;
  a.messages->add(result.diagnostics, result.files);
  const auto& r = result.result;
  if (!a.quiet && a.trace.empty() && a.vars.empty()) {
    std::printf("%s: %llu blocks, %llu events, ended by %s\n", a.inputs.front().c_str(),
                static_cast<unsigned long long>(r.blocks), static_cast<unsigned long long>(r.events),
                std::string(interpreter::name(r.reason)).c_str());
  }
  if (r.reason == interpreter::EndReason::error && !result.diagnostics.has_errors()) {
    a.messages->say(Severity::error, r.error_code, "cnctrans: " + r.error_code + ": " + r.error_text);
  }
  if (exit_of(r.reason) == limit_or_difference)
    a.messages->say(Severity::note, "CNC-LIMIT", "cnctrans: stopped by the limit (--max-events, --max-steps)");
  if (r.error_code == interpreter::code::bad_set) return usage;
  return result.diagnostics.has_errors() ? refused : exit_of(r.reason);
}

}  // namespace cnctrans::cli
