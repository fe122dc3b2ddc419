#include <cstdio>
#include <memory>

#include "base/text.h"
#include "cli/common.h"
#include "interpreter/trace.h"

namespace cnctrans::cli {

namespace {

/// Where `--trace` and `--vars` write: a file (through a temporary) or standard output. The first fault is kept.
class Target {
 public:
  bool open(const std::string& where) {
    if (where == "-") return true;
    file_ = std::make_unique<AtomicFile>(where);
    good_ = file_->open(&error_);
    return good_;
  }
  void write(std::string_view text) {
    if (good_) good_ = file_ ? file_->write(text, &error_) : write_all(stdout, text);
  }
  [[nodiscard]] bool failed() const { return !good_; }
  /// Everything written has arrived.
  bool close() {
    if (!file_) return stdout_arrived();
    good_ = good_ && file_->commit(&error_);
    if (!good_) write_all(stderr, "cnctrans: " + error_ + "\n");
    return good_;
  }
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
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
  if (a.inputs.size() != 1) return usage_error("run takes one program");
  Target trace, vars;
  if (!a.trace.empty() && !trace.open(a.trace)) return usage_error(trace.error());
  if (!a.vars.empty() && !vars.open(a.vars)) return usage_error(vars.error());
  const auto make_sink = [&](const FileTable& files,
                             const std::vector<std::string>& axes) -> std::unique_ptr<interpreter::TraceSink> {
    if (a.trace.empty()) return std::make_unique<interpreter::TraceCounter>();
    return std::make_unique<JsonSink>(trace, files, axes);
  };
  options.may_stream = a.trace.empty();
  const auto result = translator::run(a.inputs.front(), options, make_sink);
  if (!result.error.empty()) return usage_error(result.error);
  if (!a.trace.empty() && !trace.close()) return usage;
  if (!a.vars.empty()) {
    vars.write(vars_json(result.result));
    if (!vars.close()) return usage;
  }
  print_diagnostics(a, result.diagnostics, result.files);
  const auto& r = result.result;
  if (!a.quiet && a.trace.empty() && a.vars.empty()) {
    std::printf("%s: %llu blocks, %llu events, ended by %s\n", a.inputs.front().c_str(),
                static_cast<unsigned long long>(r.blocks), static_cast<unsigned long long>(r.events),
                std::string(interpreter::name(r.reason)).c_str());
  }
  if (r.reason == interpreter::EndReason::error && !result.diagnostics.has_errors()) {
    write_all(stderr, "cnctrans: " + r.error_code + ": " + r.error_text + "\n");
  }
  if (exit_of(r.reason) == limit_or_difference)
    write_all(stderr, "cnctrans: stopped by the limit (--max-events, --max-steps)\n");
  return result.diagnostics.has_errors() ? refused : exit_of(r.reason);
}

}  // namespace cnctrans::cli
