#include "translator/api/calls.h"

#include <exception>
#include <memory>

#include "interpreter/trace/run_codes.h"
#include "interpreter/trace/trace.h"

namespace cnctrans::translator {

namespace {

api::Place place_of(const Span& span, const FileTable& files) {
  if (span.file == 0) return {};
  return {files.name(span.file), span.line, span.column, span.end_line, span.end_column};
}

void add_diagnostics(std::vector<api::Diagnostic>& out, const Diagnostics& said, const FileTable& files) {
  for (const auto& d : said.all()) {
    api::Diagnostic& one = out.emplace_back();
    one.code = d.code;
    one.severity = static_cast<api::Severity>(d.severity);
    one.place = place_of(d.span, files);
    one.message = d.message;
    one.hint = d.hint;
    one.shown = render_text(d, files);
  }
  for (const auto& [code, more] : said.more()) {
    api::Diagnostic& one = out.emplace_back();
    one.code = code;
    one.severity = static_cast<api::Severity>(more.severity);
    one.message = std::to_string(more.count) + " more of this code";
    one.shown = code + ": " + one.message + "\n";
  }
}

api::Verdict verdict_of(const verifier::Verdict& v, const FileTable& source, const FileTable& target) {
  api::Verdict out;
  switch (v.status) {
    case verifier::Status::verified: out.result = api::Verdict::Result::verified; break;
    case verifier::Status::within_tolerance: out.result = api::Verdict::Result::within_tolerance; break;
    case verifier::Status::differs: out.result = api::Verdict::Result::differs; break;
    case verifier::Status::nothing_to_compare: out.result = api::Verdict::Result::nothing_to_compare; break;
    case verifier::Status::not_replayable: out.result = api::Verdict::Result::not_replayable; break;
  }
  out.events = v.events;
  out.moves = v.moves;
  out.max_length = v.max_length;
  out.blocks = v.coverage.blocks;
  out.replayed = v.coverage.replayed;
  out.text = verifier::describe(v, source, target);
  return out;
}

api::Status status_of(const verifier::Verdict& v) {
  if (v.good()) return api::Status::ok;
  return v.status == verifier::Status::differs || v.target_stopped ? api::Status::differs : api::Status::refused;
}

/// Hands events on as JSON.
class Teller : public interpreter::TraceSink {
 public:
  Teller(const api::EventSink& sink, const FileTable& files, const std::vector<std::string>& axes)
      : sink_(sink), files_(files), axes_(axes) {}
  void on_event(const interpreter::Event& e) override { sink_(interpreter::to_json(e, files_, axes_)); }

 private:
  const api::EventSink& sink_;
  const FileTable& files_;
  const std::vector<std::string>& axes_;
};

/// What every call does with an exception, which must not leave it: an error without a place.
template <class Result, class Work>
Result guarded(const Work& work) noexcept {
  Result result;
  try {
    work(result);
  } catch (const std::exception& e) {
    result = {};
    result.status = api::Status::refused;
    result.error = e.what();
  }
  return result;
}

}  // namespace

Input input_of(const api::Program& program) {
  if (!program.bytes) return program.name;
  return SourceText::from_string(program.name, *program.bytes);
}

api::Translation translate_for(const Input& input, const TranslateOptions& options) noexcept {
  return guarded<api::Translation>([&](api::Translation& out) {
    TranslateResult done = translate(input, options);
    if (!done.error.empty()) {
      out.error = std::move(done.error);
      return;
    }
    add_diagnostics(out.diagnostics, done.diagnostics, done.files);
    add_diagnostics(out.diagnostics, done.target_diagnostics, done.target_files);
    out.source_machine = std::move(done.source_machine);
    out.target_machine = std::move(done.target_machine);
    out.status = done.refused ? api::Status::refused : api::Status::ok;
    for (auto& o : done.outputs) {
      api::Output one{std::move(o.name), std::move(o.program), std::move(o.bytes), o.main, {}};
      for (const auto& line : o.map.lines) one.lines.push_back(place_of(line, done.files));
      out.outputs.push_back(std::move(one));
    }
    if (!done.verified) return;
    out.verdict = verdict_of(done.verdict, done.files, done.target_files);
    out.verdict->text = proof_text(done, done.target_files);
    if (done.held_back) out.status = status_of(done.verdict);
  });
}

api::Comparison verify_for(const Input& source, const std::vector<Input>& targets,
                           const TranslateOptions& options) noexcept {
  return guarded<api::Comparison>([&](api::Comparison& out) {
    const VerifyResult done = verify(source, targets, options);
    out.error = done.error;
    if (!done.error.empty()) return;
    add_diagnostics(out.diagnostics, done.source_diagnostics, done.source_files);
    add_diagnostics(out.diagnostics, done.target_diagnostics, done.target_files);
    out.verdict = verdict_of(done.verdict, done.source_files, done.target_files);
    out.status = status_of(done.verdict);
  });
}

api::Run run_for(const Input& input, const RunOptions& options, const api::EventSink& sink) noexcept {
  return guarded<api::Run>([&](api::Run& out) {
    RunOptions with = options;
    with.may_stream = !sink;
    const auto make_sink = [&sink](const FileTable& files,
                                   const std::vector<std::string>& axes) -> std::unique_ptr<interpreter::TraceSink> {
      if (!sink) return std::make_unique<interpreter::TraceCounter>();
      return std::make_unique<Teller>(sink, files, axes);
    };
    RunResult done = run(input, with, make_sink);
    const interpreter::Result& r = done.result;
    if (r.error_code == interpreter::code::bad_set) done.error = r.error_text;
    out.error = done.error;
    if (!done.error.empty()) return;
    add_diagnostics(out.diagnostics, done.diagnostics, done.files);
    out.reason = interpreter::name(r.reason);
    out.blocks = r.blocks;
    out.events = r.events;
    out.variables = r.variables;
    const bool stopped = r.reason == interpreter::EndReason::error || done.diagnostics.has_errors();
    const bool ended = r.reason == interpreter::EndReason::program_end;
    out.status = stopped ? api::Status::refused : ended ? api::Status::ok : api::Status::differs;
  });
}

api::Check check_for(const Input& input, const RunOptions& options) noexcept {
  return guarded<api::Check>([&](api::Check& out) {
    const CheckResult done = check(input, options);
    out.error = done.error;
    if (!done.error.empty()) return;
    add_diagnostics(out.diagnostics, done.diagnostics, done.files);
    out.lines = done.stats.lines;
    out.blocks = done.stats.blocks;
    out.blocks_read = done.stats.blocks_read;
    out.status = done.diagnostics.has_errors() ? api::Status::refused : api::Status::ok;
  });
}

}  // namespace cnctrans::translator
