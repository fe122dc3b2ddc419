#include "translator/stream.h"

#include <array>

#include "base/text.h"
#include "ir/passes/legalise.h"
#include "translator/encode.h"

namespace cnctrans::translator {

namespace {

constexpr std::size_t window_bytes = 1U << 20U;
/// The stretch before the first motion must fit into the first window: longer ones take the whole-program path.
constexpr std::size_t prefix_limit = 2000;

/// A source as windows of whole lines; the first window also tells encoding and line ends.
struct Windows {
  LineWindowReader reader{window_bytes};
  std::string_view first;
  Encoding encoding = Encoding::utf8;
  Eol eol = Eol::lf;
  bool bom = false;

  bool open(const std::string& path, std::string* error) {
    if (!reader.open(path, error)) return false;
    first = reader.next();
    bom = first.substr(0, 3) == "\xEF\xBB\xBF";
    if (bom) first.remove_prefix(3);
    encoding = valid_utf8(first) ? Encoding::utf8 : Encoding::windows1252;
    std::string_view look = first;
    SourceLine line;
    if (take_line(look, line) && line.has_eol) eol = line.eol;
    return true;
  }
};

/// Keeps modal state along the stream, for the blocks that need a pass.
class ModalTracker {
 public:
  explicit ModalTracker(const ir::ModalState& power_on) : state_(power_on) {}
  void follow(const ir::Block& block) {
    for (const auto& a : block.actions) {
      if (const auto* set = std::get_if<ir::ModalSet>(&a.data)) state_.set(set->setting, set->value);
    }
    if (block.has_motion && block.motion.kind != ir::MotionKind::modal && block.motion.keeps_modal)
      state_.motion = block.motion.kind;
  }
  [[nodiscard]] const ir::ModalState& state() const { return state_; }

 private:
  ir::ModalState state_;
};

class StreamTranslation {
 public:
  StreamTranslation(const Dialect& from, const Dialect& to, const machine::Profile& source,
                    const machine::Profile& target, const TranslateOptions& options, StreamResult& result,
                    const TextSink& sink)
      : from_(from),
        to_(to),
        source_(source),
        target_(target),
        options_(options),
        result_(result),
        sink_(sink),
        tracker_(source.power_on),
        legal_(to.backend->capabilities_for(target)) {}

  void run(const std::string& path, const Progress& progress) {
    Windows windows;
    if (!windows.open(path, &result_.error)) return fail();
    eol_ = options_.eol.value_or(windows.eol);
    encoding_ = options_.encoding.value_or(windows.encoding);
    source_encoding_ = windows.encoding;
    if (encoding_ != source_encoding_) return give_up();
    const FileId file = result_.files.add_name(path);
    if (windows.encoding != Encoding::utf8) note_encoding(windows.first, 1, file, diagnostics_);
    const frontends::ReadOptions read{options_.reader, &source_};
    reader_ = from_.frontend->stream(file, read, path);
    backends::WriteOptions write;
    write.profile = &target_;
    write.unsupported = options_.unsupported;
    write.numbering = options_.numbering;
    write.number_step = options_.number_step;
    write.main_stem = SourceText::from_string(path, {})->stem();
    writer_ = to_.backend->stream(write);
    if (!reader_ || !writer_) return give_up();
    out_.reserve(window_bytes + window_bytes / 4);
    if (windows.bom && encoding_ == Encoding::utf8) out_ += "\xEF\xBB\xBF";
    std::string_view window = windows.first;
    std::uint32_t number = 0;
    while (!window.empty()) {
      SourceLine line;
      while (take_line(window, line)) {
        line.number = ++number;
        if (!take(line)) return;
      }
      if (!prefix_done_) return give_up();
      if (!flush()) return fail();
      if (progress && windows.reader.file_size() > 0) {
        progress(static_cast<double>(windows.reader.bytes_read()) / static_cast<double>(windows.reader.file_size()));
      }
      window = windows.reader.next();
      if (encoding_ == Encoding::utf8 && !window.empty() && !valid_utf8(window)) return give_up();
    }
    if (!prefix_done_) return give_up();  // no motion at all: let the whole-program path look at it
    if (!ended_) {
      diagnostics_.note("TRN-092", statement_.line.span, "the program ends without an end word; one is written");
      if (!put_end(false)) return;
    }
    writer_->end(out_);
    result_.lines = number;
    if (!flush()) fail();
  }

 private:
  void fail() { result_.outcome = StreamOutcome::failed; }
  void give_up() { result_.outcome = StreamOutcome::needs_program; }

  /// One source line. False: the stream has ended (result says how).
  bool take(const SourceLine& line) {
    const frontends::StreamLine kind = reader_->read(line, statement_, diagnostics_);
    if (kind == frontends::StreamLine::needs_program || diagnostics_.has_errors() ||
        diagnostics_.warning_count() != 0) {
      give_up();
      return false;
    }
    if (kind == frontends::StreamLine::no_statement) return true;
    if (!prefix_done_) return take_prefix(kind);
    if (kind != frontends::StreamLine::program_end) return put(statement_);
    ended_ = true;
    const auto* block = std::get_if<ir::Block>(&statement_.node);
    const bool alone = block != nullptr && block->empty();
    return (alone || put(statement_)) && put_end(!alone);
  }

  /// Until the first motion the statements are kept, so that the safe start can be put where it belongs.
  bool take_prefix(frontends::StreamLine kind) {
    prefix_.push_back(statement_);
    if (kind == frontends::StreamLine::program_end || prefix_.size() > prefix_limit) {
      give_up();
      return false;
    }
    const auto* block = std::get_if<ir::Block>(&statement_.node);
    if (block == nullptr) {
      give_up();
      return false;
    }
    if (!block->has_motion || !block->motion.moves()) return true;
    prefix_done_ = true;
    ir::Program program = frame();
    program.routines.front().body = std::move(prefix_);
    ir::number_statements(program);
    const ir::LegaliseContext context{legal_, source_, target_, {options_.cycles}, diagnostics_};
    for (const auto& s : program.routines.front().body) {
      if (const auto* b = std::get_if<ir::Block>(&s.node)) tracker_.follow(*b);
    }
    if (!run_local_passes(program, context)) return false;
    ir::run_pass("safe_start", program, context);
    writer_->begin(program, out_);
    return write_pieces(program);
  }

  bool run_local_passes(ir::Program& program, const ir::LegaliseContext& context) {
    for (const std::string_view pass : ir::block_local_passes()) {
      if (!ir::run_pass(pass, program, context)) {
        give_up();
        return false;
      }
    }
    return true;
  }

  bool write_pieces(const ir::Program& program) {
    for (const auto& piece : program.routines.front().body) {
      const auto* block = std::get_if<ir::Block>(&piece.node);
      if (block == nullptr || diagnostics_.has_errors() || diagnostics_.warning_count() != 0 ||
          !writer_->write(piece, out_, diagnostics_)) {
        give_up();
        return false;
      }
    }
    return true;
  }

  ir::Program frame() const {
    ir::Program program = reader_->frame();
    if (program.routines.empty()) program.routines.emplace_back();
    return program;
  }

  bool put_end(bool joined) {
    ir::Statement end;
    if (joined || !ended_) {
      end.line.joined = joined;
      end.line.span = statement_.line.span;
    } else {
      end.line = statement_.line;  // the end word stands alone in its line
    }
    end.node = ir::End{};
    return put(end);
  }

  /// What depends on more than the block and is not settled by the local passes: the whole program is needed.
  static bool needs_more(const ir::Block& b) {
    if (b.has_motion && b.motion.coords.empty() && !b.motion.centers.empty()) return true;
    for (const auto& a : b.actions) {
      if (std::holds_alternative<ir::MachineFunction>(a.data) || std::holds_alternative<ir::FrameOp>(a.data))
        return true;
      const auto* set = std::get_if<ir::ModalSet>(&a.data);
      if (set != nullptr && (set->setting == ir::Setting::feed_mode || set->setting == ir::Setting::units ||
                             set->setting == ir::Setting::path_mode || set->setting == ir::Setting::diameter)) {
        return true;
      }
    }
    return false;
  }

  bool put(const ir::Statement& s) {
    const auto* block = std::get_if<ir::Block>(&s.node);
    if (block != nullptr && needs_more(*block)) {
      give_up();
      return false;
    }
    if (block != nullptr && !ir::plain_legal(*block, legal_, &target_)) return put_legalised(s);
    if (block != nullptr) tracker_.follow(*block);
    if (!writer_->write(s, out_, diagnostics_) || diagnostics_.has_errors()) {
      give_up();
      return false;
    }
    return true;
  }

  /// A block that a pass has to look at: a program of this block alone, under the modal state reached so far.
  bool put_legalised(const ir::Statement& s) {
    ir::Program program = frame();
    program.routines.front().body = {s};
    ir::number_statements(program);
    machine::Profile source = source_;
    source.power_on = tracker_.state();
    source.power_on.length_comp = source_.power_on.length_comp;  // what the machine does by itself, not a mode reached
    const ir::LegaliseContext context{legal_, source, target_, {options_.cycles}, diagnostics_};
    if (!run_local_passes(program, context) || !write_pieces(program)) return false;
    tracker_.follow(std::get<ir::Block>(s.node));
    return true;
  }

  bool flush() {
    bool good = true;
    if (eol_ == Eol::lf) {
      good = sink_(out_);
    } else {
      good = sink_(encode_output(out_, Encoding::utf8 == encoding_ ? encoding_ : Encoding::windows1252, eol_, false,
                                 diagnostics_));
    }
    out_.clear();
    if (!good) result_.error = "the output could not be written";
    return good;
  }

  const Dialect& from_;
  const Dialect& to_;
  const machine::Profile& source_;
  const machine::Profile& target_;
  const TranslateOptions& options_;
  StreamResult& result_;
  const TextSink& sink_;
  std::unique_ptr<frontends::StreamReader> reader_;
  std::unique_ptr<backends::StreamWriter> writer_;
  ModalTracker tracker_;
  const ir::Capabilities& legal_;
  Diagnostics& diagnostics_ = result_.diagnostics;
  ir::Statement statement_;
  ir::Body prefix_;
  bool prefix_done_ = false;
  bool ended_ = false;
  std::string out_;
  Eol eol_ = Eol::lf;
  Encoding encoding_ = Encoding::utf8, source_encoding_ = Encoding::utf8;
};

}  // namespace

StreamResult translate_stream(const std::string& path, const TranslateOptions& options, const TextSink& sink,
                              const Progress& progress) {
  StreamResult result;
  const Dialect* from = find_dialect(options.from);
  const Dialect* to = find_dialect(options.to);
  result.outcome = StreamOutcome::needs_program;
  if (from == nullptr || to == nullptr || options.verify || options.annotate ||
      options.reader != frontends::Reader::scanner)
    return result;
  Windows look;
  if (!look.open(path, &result.error)) {
    result.outcome = StreamOutcome::failed;
    return result;
  }
  const auto head = SourceText::from_string(path, std::string(look.first));
  const auto source = choose_profile(*from, options.machine, head.get(), &result.error);
  if (!source) return result;
  const auto target =
      machine::load(!options.target_machine.empty()
                        ? options.target_machine
                        : std::string(to->name) + (source->kind == machine::Kind::lathe ? "-lathe" : "-mill"),
                    &result.error);
  if (!target) return result;
  // Diameters and a length compensation that has to be switched on need the whole program.
  if (source->kind == machine::Kind::lathe || to->backend->capabilities_for(*target).length_comp_switch) return result;
  result.outcome = StreamOutcome::done;
  StreamTranslation(*from, *to, *source, *target, options, result, sink).run(path, progress);
  return result;
}

StreamRun run_stream(const std::string& path, const Dialect& dialect, const machine::Profile& profile,
                     const RunOptions& options, interpreter::TraceSink& sink, FileTable& files) {
  StreamRun run;
  Windows windows;
  std::string error;
  run.outcome = StreamOutcome::needs_program;
  if (!windows.open(path, &error)) return run;
  const FileId file = files.add_name(path);
  const frontends::ReadOptions read{options.reader, &profile};
  const auto reader = dialect.frontend->stream(file, read, path);
  if (!reader || options.reader != frontends::Reader::scanner) return run;
  interpreter::BlockRunner runner(profile, options.run, sink, run.diagnostics);
  ir::Statement statement;
  Span last;
  std::string_view window = windows.first;
  std::uint32_t number = 0;
  bool going = true;
  bool utf8 = true;
  while (!window.empty()) {
    if (utf8 && !valid_utf8(window)) {
      utf8 = false;
      note_encoding(window, number + 1, file, run.diagnostics);
    }
    SourceLine line;
    while (take_line(window, line)) {
      line.number = ++number;
      // Lines after the end are read as well: one that can't be read refuses the program before anything moves.
      const auto kind = reader->read(line, statement, run.diagnostics);
      if (kind == frontends::StreamLine::no_statement) continue;
      if (kind == frontends::StreamLine::needs_program || (going && run.diagnostics.has_errors())) return run;
      if (!going) continue;
      last = statement.line.span;
      going = runner.step(statement) && kind != frontends::StreamLine::program_end;
    }
    window = windows.reader.next();
  }
  run.outcome = StreamOutcome::done;
  run.result = runner.finish(last);
  return run;
}

}  // namespace cnctrans::translator
