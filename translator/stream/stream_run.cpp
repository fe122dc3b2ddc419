#include "translator/stream/stream_run.h"

#include "translator/files/definitions.h"

namespace cnctrans::translator {

frontends::TextLook look_through(const std::string& path) {
  return [path](const std::function<bool(std::string_view)>& holds) {
    LineWindowReader reader(window_bytes);
    std::string error;
    if (!reader.open(path, &error)) return true;
    for (std::string_view text = reader.next(); !text.empty(); text = reader.next()) {
      if (holds(text)) return true;
    }
    return !reader.read_error().empty();
  };
}

StreamReplay::StreamReplay(const std::string& path, const Dialect& dialect, const machine::Profile& profile,
                           const interpreter::Options& options, interpreter::TraceSink& sink, FileTable& files)
    : file_(files.add_name(path)), last_{file_, 1, 1, 1, 1}, runner_(profile, options, sink, diagnostics_) {
  std::string error;
  if (!windows_.open(path, &error)) return;
  const frontends::ReadOptions read{frontends::Reader::scanner, &profile, nullptr, look_through(path)};
  reader_ = dialect.frontend->stream(file_, read, path);
  window_ = windows_.first;
}

bool StreamReplay::window() {
  if (reader_ == nullptr || window_.empty()) return false;
  if (utf8_ && !valid_utf8(window_)) {
    utf8_ = false;
    note_encoding(window_, number_ + 1, file_, diagnostics_);
  }
  SourceLine line;
  while (take_line(window_, line)) {
    line.number = ++number_;
    // Lines after the end are read as well: what they have to report belongs to the program.
    const auto errors = diagnostics_.error_count();
    const auto kind = reader_->read(line, statement_, diagnostics_);
    const bool wrong = diagnostics_.error_count() != errors;  // which lines are reached tells the whole program
    if (wrong || kind == frontends::StreamLine::needs_program) {
      reader_ = nullptr;
      return false;
    }
    if (kind == frontends::StreamLine::no_statement) continue;
    if (!going_) continue;
    last_ = statement_.line.span;
    going_ = runner_.step(statement_) && kind != frontends::StreamLine::program_end;
  }
  window_ = windows_.reader.next();
  return !window_.empty();
}

StreamRun StreamReplay::finish() {
  StreamRun run;
  run.outcome = StreamOutcome::needs_program;
  if (reader_ == nullptr || !windows_.reader.read_error().empty()) return run;  // the whole-program path reports
  Diagnostics closing;
  if (reader_->end(number_, closing) != frontends::StreamEnd::complete) return run;
  if (closing.has_errors() || closing.warning_count() != 0) return run;
  run.outcome = StreamOutcome::done;
  run.result = runner_.finish(last_);
  run.diagnostics = std::move(diagnostics_);
  return run;
}

StreamRun run_stream(const std::string& path, const Dialect& dialect, const machine::Profile& profile,
                     const RunOptions& options, interpreter::TraceSink& sink, FileTable& files) {
  StreamRun refused;
  refused.outcome = StreamOutcome::needs_program;
  if (options.reader != frontends::Reader::scanner || !definition_files(dialect, options.libraries).empty())
    return refused;
  StreamReplay replay(path, dialect, profile, options.run, sink, files);
  while (replay.window()) {
  }
  return replay.finish();
}

}  // namespace cnctrans::translator
