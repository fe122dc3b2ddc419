#include "translator/pipeline.h"

#include <algorithm>

#include "ir/text/text.h"
#include "translator/files/called.h"
#include "translator/files/definitions.h"
#include "translator/files/program_axes.h"
#include "translator/folding/fit.h"
#include "translator/folding/folded_lines.h"
#include "translator/folding/unfolding.h"
#include "translator/proving/proof.h"
#include "translator/stream/stream.h"
#include "translator/translation/reading.h"

namespace cnctrans::translator {

SourcePtr Input::open(std::string* error) const {
  return text_ ? text_ : SourceText::open(path_, error);
}

namespace {

const Diagnostic* first_error(const Diagnostics& said) {
  const auto& all = said.all();
  const auto it = std::find_if(all.begin(), all.end(), [](const auto& d) { return d.severity == Severity::error; });
  return it == all.end() ? nullptr : &*it;
}

}  // namespace

VerifyResult verify(const Input& source, const std::vector<Input>& targets, const TranslateOptions& options) {
  VerifyResult result;
  if (targets.empty()) {
    result.error = "no translation to compare with";
    return result;
  }
  InputOptions target_options = options;
  target_options.machine = options.target_machine;
  for (std::size_t i = 1; i < targets.size(); ++i) {
    const SourcePtr text = targets[i].open(&result.error);
    if (!text) return result;
    target_options.texts.push_back(text);
  }
  Reading a, b;
  if (!a.open(source, options.from, options, &result.error) ||
      !b.open(targets.front(), options.to, target_options, &result.error))
    return result;
  Diagnostics a_said, b_said;
  const ir::Program& a_program = a.read(a_said);
  const ir::Program& b_program = b.read(b_said);
  // The names that a translation by anyone gives to the variables are not known.
  const bool one_language = &a.dialect() == &b.dialect();
  const auto target_settings = [one_language](const Settings& set) { return one_language ? set : Settings(); };
  Proof proof = prove({a_program, a.profile(), a.loader()}, {b_program, b.profile(), b.loader()},
                      {options.run,
                       target_settings,
                       {},
                       options.further,
                       a.dialect().first_skip_switch,
                       b.dialect().backend->capabilities_for(b.profile()),
                       false,
                       false});
  result.verdict = std::move(proof.verdict);
  if (const auto* unread = first_error(b_said); result.verdict.good() && unread != nullptr && !a_said.has_errors()) {
    result.verdict.status = verifier::Status::not_replayable;
    result.verdict.reason = "the translation has an error in line " + std::to_string(unread->span.line) +
                            ", where no replay came to (" + unread->code + ": " + unread->message + ")";
  }
  const auto all_said = [](Diagnostics said, Reading& of, const Replayed& run) {
    said.append(of.loader().library_diagnostics());
    if (run.result.reason != interpreter::EndReason::error) said = as_warnings(said);
    said.append(run.diagnostics);
    return said;
  };
  result.source_diagnostics = all_said(std::move(a_said), a, proof.source);
  result.target_diagnostics = all_said(std::move(b_said), b, proof.target);
  result.source_files = a.loader().files();
  result.target_files = b.loader().files();
  return result;
}

namespace {

/// Names of the extra axes: those of the program, else those of the machine.
std::vector<std::string> names_of_axes(const ir::Program& program, const machine::Profile& profile) {
  std::vector<std::string> names = program.axis_names;
  for (const auto& a : profile.axes) {
    if (a.id < ir::axis::first_extra) continue;
    const auto at = static_cast<std::size_t>(a.id - ir::axis::first_extra);
    if (names.size() <= at) names.resize(at + 1);
    if (names[at].empty()) names[at] = a.name;
  }
  return names;
}

}  // namespace

namespace {

/// A run that never begins.
void refuse(const Diagnostic& why, RunResult& result, const MakeSink& make_sink) {
  result.result.reason = interpreter::EndReason::error;
  result.result.error_code = why.code;
  result.result.error_text = why.message;
  interpreter::Event end;
  end.kind = interpreter::EventKind::end;
  end.reason = interpreter::EndReason::error;
  end.file = why.span.file;
  end.line = why.span.line;
  end.code = why.code;
  end.text = why.message;
  make_sink(result.files, result.axis_names)->on_event(end);
  result.result.events = 1;
}

}  // namespace

RunResult run(const Input& input, const RunOptions& options, const MakeSink& make_sink) {
  RunResult result;
  Reading reading;
  if (!reading.open(input, options.dialect, options, &result.error)) return result;
  const machine::Profile& profile = reading.profile();
  if (options.may_stream && options.tools.empty() && !input.in_memory() && added_axes(profile).empty() &&
      options.run.set.empty() && can_reopen(input.path())) {
    FileTable files;
    const auto counter = make_sink(files, {});
    StreamRun streamed = run_stream(input.path(), reading.dialect(), profile, options, *counter, files);
    if (streamed.outcome == StreamOutcome::done) {
      result.result = std::move(streamed.result);
      result.diagnostics = std::move(streamed.diagnostics);
      result.files.add(reading.source());  // the stream kept the name only: the diagnostics show their lines
      return result;
    }
  }
  if (options.may_stream && !input.in_memory() && can_reopen(input.path())) {
    if (auto folded = run_folded(input.path(), reading.dialect(), options, make_sink, least_folded))
      return *std::move(folded);
  }
  Loader& loader = reading.loader();
  Diagnostics running;
  const ir::Program* program = &reading.read(result.diagnostics);
  if (loader.foreign()) {
    result.files = loader.files();
    refuse(*first_error(result.diagnostics), result, make_sink);
    return result;
  }
  ir::Program defining;
  if (const auto& definitions = loader.definitions(); !definitions.empty()) {
    defining = *program;
    std::vector<ir::RoutineName> called;
    collect_calls(defining, called);
    declare_names(defining, definitions, !called.empty(), result.diagnostics);
    program = &defining;
  }
  result.axis_names = names_of_axes(*program, profile);
  const auto sink = make_sink(loader.files(), result.axis_names);
  interpreter::Options run_options = options.run;
  std::optional<FoldedLines> behind;
  if (options.folded != nullptr) {
    result.unfit = unfit(*program, profile, {reading.dialect().name, profile}, *options.folded);
    behind.emplace(input.path(), reading.dialect().frontend->plain_words(), *options.folded, *program);
    if (!result.unfit && !behind->known()) result.unfit.emplace().whole = true;
    if (result.unfit) return result;
    run_options.behind = &*behind;
  }
  run_options.library = [&loader](const ir::RoutineName& name) { return loader.find(name); };
  run_options.fault = [&loader](FileId f, std::uint32_t from, std::uint32_t to) { return loader.fault(f, from, to); };
  run_options.read_written = [&loader](const std::string& name, const std::string& text, std::string& why) {
    return loader.read_written(name, text, why);
  };
  result.result = interpreter::run(*program, profile, run_options, *sink, running);
  if (behind && result.result.reason == interpreter::EndReason::error) result.unfit.emplace().whole = true;
  for (const auto& f : result.result.written) result.written.emplace_back(loader.written_file(f.name), f.text);
  result.diagnostics.append(loader.library_diagnostics());
  // A line that the run has not come to spoils nothing.
  if (result.result.reason != interpreter::EndReason::error) result.diagnostics = as_warnings(result.diagnostics);
  result.diagnostics.append(running);
  result.files = loader.files();
  return result;
}

RewriteResult rewrite(const SourcePtr& source, const std::string& dialect, const std::string& machine) {
  RewriteResult result;
  InputOptions options;
  options.machine = machine;
  Reading reading;
  if (!reading.open(source, dialect, options, &result.error)) return result;
  result.program = reading.read(result.diagnostics);
  backends::WriteOptions write;
  write.profile = &reading.profile();
  write.main_stem = source->stem();
  write.single_output = true;
  const backends::Backend& backend = *reading.dialect().backend;
  result.files = backend.write(result.program, write, result.diagnostics);
  for (auto& f : result.files) f.text = backends::numbered(backend, write, std::move(f.text));
  return result;
}

CheckResult check(const Input& input, const RunOptions& options) {
  CheckResult result;
  Reading reading;
  if (!reading.open(input, options.dialect, options, &result.error)) return result;
  ir::check_well_formed(reading.read(result.diagnostics, &result.stats), result.diagnostics);
  result.files = reading.loader().files();
  return result;
}

}  // namespace cnctrans::translator
