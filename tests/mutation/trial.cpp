#include "tests/mutation/trial.h"

#include <algorithm>
#include <memory>

#include "dialects/options.h"
#include "tests/mutation/documented.h"
#include "translator/pipeline.h"

namespace cnctrans::mutation {

namespace {

constexpr std::uint64_t most_events = 4000, most_steps = 100'000, most_silent = 10'000;

void limit(interpreter::Options& run) {
  run.max_events = most_events;
  run.max_steps = most_steps;
  run.max_silent_steps = most_silent;
}

class Into : public interpreter::TraceSink {
 public:
  explicit Into(std::vector<interpreter::Event>& events) : events_(events) {}
  void on_event(const interpreter::Event& e) override { events_.push_back(e); }

 private:
  std::vector<interpreter::Event>& events_;
};

Trace trace_of(const std::string& dialect, const std::string& machine, const std::string& file, const std::string& text,
               const std::optional<machine::World>& world) {
  translator::RunOptions options;
  options.dialect = dialect;
  options.machine = machine;
  limit(options.run);
  options.run.world = world;
  Trace trace;
  options.run.cycles = &trace.cycles;
  std::string ignored;
  if (const auto profile = dialects::load_profile(machine, &ignored))
    trace.start = verifier::start_of(*profile, world ? &*world : nullptr);
  const translator::Input input(SourceText::from_string(file, text));
  const auto read = translator::check(input, options);
  if (!read.error.empty() || read.diagnostics.has_errors()) return trace;
  const auto run =
      translator::run(input, options, [&](const auto&, const auto&) { return std::make_unique<Into>(trace.events); });
  trace.ran = run.error.empty() && run.result.reason == interpreter::EndReason::program_end;
  return trace;
}

Lines lines_of(const std::string& text) {
  Lines lines(1);
  for (const char c : text) {
    if (c == '\n')
      lines.emplace_back();
    else if (c != '\r')
      lines.back() += c;
  }
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

translator::VerifyResult verified(const Translated& t, const std::string& target) {
  translator::TranslateOptions options;
  options.from = t.source.dialect;
  options.to = t.to;
  options.machine = t.source.machine();
  options.target_machine = t.machine;
  translator::prove_as_usual(options);
  options.further.time.reset();  // the same on every computer
  limit(options.run);
  return translator::verify(SourceText::from_string(t.source.file_name(), t.source.text()),
                            {SourceText::from_string(t.file, target)}, options);
}

}  // namespace

std::string text_of(const Lines& lines) {
  std::string text;
  for (const auto& line : lines) text += line + '\n';
  return text;
}

std::optional<Translated> translated(const splice::Program& source, const std::string& to) {
  translator::TranslateOptions options;
  options.from = source.dialect;
  options.to = to;
  options.machine = source.machine();
  options.single_output = true;
  translator::prove_as_usual(options);
  options.further.time.reset();
  limit(options.run);
  const auto result = translator::translate(SourceText::from_string(source.file_name(), source.text()), options);
  if (result.refused || !result.error.empty() || !result.verdict.good() || result.outputs.size() != 1)
    return std::nullopt;
  Translated t{
      source, to, result.target_machine, result.outputs.front().name, lines_of(result.outputs.front().bytes), {}, {},
      {},     {}};
  const auto proved = verified(t, text_of(t.lines)).verdict;
  if (!proved.good()) return std::nullopt;
  t.world = proved.world;
  t.read_first = proved.target_read_first;
  t.source_trace = trace_of(source.dialect, source.machine(), source.file_name(), source.text(), t.world);
  t.trace = trace_of(to, t.machine, t.file, text_of(t.lines), t.world);
  if (!t.source_trace.ran || !t.trace.ran) return std::nullopt;
  return t;
}

Outcome tried(const Translated& t, const Fault& fault) {
  Outcome out;
  const auto lines = with_fault(t.lines, fault);
  if (!lines) return out;
  const std::string text = text_of(*lines);
  const Trace trace = trace_of(t.to, t.machine, t.file, text, t.world);
  if (!trace.ran) {
    out.fate = Fate::no_run;
    return out;
  }
  const Documented found = documented(t, trace);
  if (found.equal) {
    out.fate = Fate::nothing;
    return out;
  }
  const auto result = verified(t, text);
  out.said = verifier::describe(result.verdict, result.source_files, result.target_files);
  out.what = found.what;
  out.aspects = found.aspects;
  out.fate = Fate::caught;
  const auto known = [&t](const std::string& name) {
    return std::find(t.read_first.begin(), t.read_first.end(), name) != t.read_first.end();
  };
  const auto& read = result.verdict.target_read_first;
  if (!out.what.empty() && !std::all_of(read.begin(), read.end(), known)) {
    out.what.clear();  // what comes of it depends on the value; the answer names the variable
    out.aspects = {"variable read first"};
  }
  if (result.verdict.good()) out.fate = out.what.empty() ? Fate::documented : Fate::undocumented;
  return out;
}

std::string command(const Translated& t) {
  return "cnctrans verify --from " + t.source.dialect + " --to " + t.to + " --machine " + t.source.machine() +
         " --target-machine " + t.machine + " " + t.source.file_name() + " " + t.file;
}

}  // namespace cnctrans::mutation
