#include "translator/stream/stream.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <optional>
#include <vector>

#include "base/text.h"
#include "ir/edit/search.h"
#include "legaliser/legalise.h"
#include "legaliser/stream/stream_watch.h"
#include "translator/files/program_axes.h"
#include "translator/output/encode.h"
#include "translator/output/origin.h"
#include "translator/stream/line_shapes.h"
#include "translator/stream/stream_tools.h"
#include "translator/stream/stream_windows.h"

namespace cnctrans::translator {

namespace {

/// The head must fit into the first window: longer ones take the whole-program path.
constexpr std::size_t head_limit = 2000;

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
        legal_(to.backend->capabilities_for(target)),
        watch_(legal_, source, target) {}

  void run(const std::string& path, const Progress& progress) {
    path_ = path;
    origin_ = origin_text(options_, path);
    Windows windows;
    if (!windows.open(path, &result_.error)) return fail();
    eol_ = options_.eol.value_or(windows.eol);
    const bool utf8 =
        windows.encoding == Encoding::utf8 && options_.encoding.value_or(Encoding::utf8) == Encoding::utf8;
    if (!utf8) return void(give_up());
    file_ = result_.files.add_name(path);
    note_added_axes(source_, file_, result_.diagnostics);
    const frontends::ReadOptions read{options_.reader, &source_, nullptr, look_through(path)};
    reader_ = from_.frontend->stream(file_, read, path);
    backends::WriteOptions write;
    write.profile = &target_;
    write.unsupported = options_.unsupported;
    write.numbering = options_.numbering;
    write.number_step = options_.number_step;
    write.main_stem = SourceText::from_string(path, {})->stem();
    write.changes_tools = [this] { return changes_tools(); };
    writer_ = to_.backend->stream(write);
    if (!reader_ || !writer_ || !watch_.possible()) return void(give_up());
    out_.reserve(window_bytes + window_bytes / 4);
    if (!take_windows(windows, progress)) return;
    if (!watch_.head_done()) return void(give_up());  // no motion at all: let the whole-program path look at it
    if (reader_->end(result_.lines, reading_) != frontends::StreamEnd::complete) return void(give_up());
    if (reading_.has_errors() || reading_.warning_count() != 0) return void(give_up());
    if (!ended_) {
      reading_.note("TRN-092", last_code_, "the program ends without an end word; one is written");
      ir::Statement end;
      end.line.span = last_code_;
      end.node = ir::End{};
      if (!emit(end)) return;
    }
    writer_->end(out_);
    if (!flush()) return fail();
    result_.diagnostics.append(reading_);
    for (const Diagnostics& pass : passing_) result_.diagnostics.append(pass);
    result_.diagnostics.append(writing_);
  }

 private:
  void fail() { result_.outcome = StreamOutcome::failed; }
  bool give_up() {
    result_.outcome = StreamOutcome::needs_program;
    return false;
  }

  /// Looks through the file for a word that changes the tool.
  bool changes_tools() const {
    const auto look = look_through(path_);
    const auto reader = from_.frontend->stream(file_, {options_.reader, &source_, nullptr, look}, path_);
    return any_line(look, 'M', *reader, [](const ir::Statement& s) {
      const auto* block = std::get_if<ir::Block>(&s.node);
      return block != nullptr && ir::action_in<ir::ToolChange>(*block) != nullptr;
    });
  }

  /// False: the stream has come to an early end (result says how).
  bool take_windows(Windows& windows, const Progress& progress) {
    std::string_view window = windows.first;
    SourceLine line;
    while (!window.empty()) {
      while (take_line(window, line)) {
        if (!take(line)) return false;
      }
      if (!watch_.head_done()) return give_up();
      if (!flush()) {
        fail();
        return false;
      }
      if (progress && windows.reader.file_size() > 0) {
        progress(static_cast<double>(windows.reader.bytes_read()) / static_cast<double>(windows.reader.file_size()));
      }
      window = windows.reader.next();
      if (!window.empty() && !valid_utf8(window)) return give_up();
    }
    result_.lines = line.number;
    result_.error = windows.reader.read_error();
    if (!result_.error.empty()) fail();
    return result_.error.empty();
  }

  bool take(const SourceLine& line) {
    if (shapes_ && !ended_ && !writer_->waits() && shapes_->write(line.text, state_, out_)) {
      watch_.passed_by();
      last_code_ = {file_, line.number, 1, line.number, static_cast<std::uint32_t>(line.text.size()) + 1};
      return true;
    }
    const std::size_t before = out_.size(), said = reading_.all().size() + writing_.all().size();
    if (!take_block(line)) return false;
    if (!watch_.head_done() || ended_) return true;
    const bool quiet = said == reading_.all().size() + writing_.all().size();
    return learn(line, before, quiet);
  }

  bool take_block(const SourceLine& line) {
    plain_ = false;
    const frontends::StreamLine kind = reader_->read(line, statement_, reading_);
    if (kind == frontends::StreamLine::needs_program || reading_.has_errors() || reading_.warning_count() != 0)
      return give_up();
    if (kind == frontends::StreamLine::no_statement) return true;
    auto* block = std::get_if<ir::Block>(&statement_.node);
    if (block == nullptr || !number_tools(*block)) return give_up();
    if (std::popcount(statement_.line.skip_mask) > 1) return give_up();  // jumps, where the target takes one level
    // After a block that may be skipped the modal state is known only when the block does not touch it.
    if (statement_.line.skip_mask != 0 &&
        (!block->actions.empty() || block->motion.kind != ir::MotionKind::modal || !watch_.head_done() ||
         watch_.look(*block) != ir::StreamWatch::Verdict::plain))
      return give_up();
    const bool end = kind == frontends::StreamLine::program_end;
    const bool code = end || !block->empty() || !statement_.line.number.empty();
    if (code) {
      if (ended_) return give_up();  // blocks behind the end
      last_code_ = statement_.line.span;
    }
    if (!watch_.head_done()) return end ? give_up() : take_head();
    ended_ = ended_ || end;
    if (!end) return put(*block);
    const bool alone = block->empty();
    if (!alone && !put(*block)) return false;
    ir::Statement last;
    last.node = ir::End{reader_->end_word(), false};
    if (alone) {
      last.line = statement_.line;
    } else {
      last.line.span = statement_.line.span;
      last.line.joined = true;
    }
    return emit(last);
  }

  /// Tools by their names get numbers. False: the table of them can't be written any more.
  bool number_tools(ir::Block& block) {
    const auto* tool = ir::action_in<ir::ToolSelect>(block);
    if (tool == nullptr || tool->name.empty()) return true;
    if (!tools_) {
      if (watch_.head_done()) return false;
      tools_.emplace();
      tools_->look(*from_.frontend, file_, path_, {options_.reader, &source_, nullptr, look_through(path_)},
                   {legal_, source_, target_, {options_.cycles}, passing_[pass_index(ir::tool_pass)]});
    }
    tools_->apply(block);
    return true;
  }

  // --- lines of a shape that came before ----------------------------------------------------------------------------

  /// The state that reader and passes have reached, as a small number; the same state has the same one.
  std::uint32_t state_now() {
    const std::pair<std::uint64_t, std::uint64_t> key{reader_->modal_key(), watch_.key()};
    const auto it = std::find(states_.begin(), states_.end(), key);
    if (it == states_.end()) states_.push_back(key);
    return static_cast<std::uint32_t>(it - states_.begin());
  }

  /// Some line of the file has I or J with a number: an arc by its centre, as a rule.
  bool has_centres() {
    if (!centres_) {
      centres_ = look_through(path_)([](std::string_view text) {
        for (std::size_t i = text.find_first_of("IJ"); i < text.size(); i = text.find_first_of("IJ", i + 1)) {
          const char next = i + 1 < text.size() ? text[i + 1] : '\0';
          if ((next >= '0' && next <= '9') || next == '-' || next == '+' || next == '.' || next == '=') return true;
        }
        return false;
      });
    }
    return *centres_;
  }

  /// False: the attempt to learn the line's shape left another state behind, which must not happen.
  bool learn(const SourceLine& line, std::size_t before, bool quiet) {
    if (!shapes_) {
      if (watch_.needs_places() && has_centres()) return true;
      const int places = std::min(writer_->places_kept(), watch_.places());
      if (reader_->modal_key() == 0 || places < 0) return true;
      shapes_.emplace(reader_->free_numbers(), places);
      state_ = state_now();
      return true;
    }
    const std::uint32_t now = state_now();
    if (now == state_ && plain_ && quiet && out_.size() > before) {
      const std::string text = out_.substr(before);
      shapes_->learn(line.text, now, text, [&](std::string_view marked) { return try_line(line, marked); });
      if (state_now() != now) return give_up();
    }
    state_ = now;
    return true;
  }

  std::optional<std::string> try_line(const SourceLine& like, std::string_view text) {
    SourceLine line = like;
    line.text = text;
    Diagnostics said;
    if (reader_->read(line, statement_, said) != frontends::StreamLine::statement) return std::nullopt;
    const auto* block = std::get_if<ir::Block>(&statement_.node);
    if (block == nullptr || watch_.look(*block) != ir::StreamWatch::Verdict::plain) return std::nullopt;
    std::string out;
    const bool good = writer_->write(statement_, out, said) && said.empty();
    return good ? std::optional(std::move(out)) : std::nullopt;
  }

  /// The head's statements are kept until the safe start can be put where it belongs.
  bool take_head() {
    head_.push_back(statement_);
    if (head_.size() > head_limit || !watch_.take_head(statement_)) return give_up();
    if (!watch_.head_done()) return true;
    ir::Program program = frame();
    program.routines.front().body = std::move(head_);
    put_origin(program, origin_);
    if (tools_) tools_->put_table(program.routines.front().body);
    ir::number_statements(program);
    if (!run_passes(ir::head_passes(), program, source_, true)) return give_up();
    const ir::LegaliseContext context{legal_, source_, target_, {options_.cycles}, passing_.back()};
    ir::run_pass("safe_start", program, context);
    ir::run_pass("tidy", program, context);
    if (passing_.back().has_errors()) return give_up();
    writer_->begin(program, out_);
    return emit_all(program);
  }

  /// Each pass speaks in its place among the others. What it says once a program may be a warning; what it says of one
  /// block behind the head needs the whole program.
  bool run_passes(const std::vector<std::string_view>& names, ir::Program& program, const machine::Profile& source,
                  bool head) {
    for (const std::string_view pass : names) {
      Diagnostics said;
      if (!ir::run_pass(pass, program, {legal_, source, target_, {options_.cycles}, said})) return false;
      if (!ir::once_a_program(pass) && (head ? said.warning_count() != 0 : !said.empty())) return false;
      passing_[pass_index(pass)].append(said);
    }
    return true;
  }
  static std::size_t pass_index(std::string_view name) {
    const auto names = ir::head_passes();
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }

  bool emit(const ir::Statement& s) { return writer_->write(s, out_, writing_) || give_up(); }
  bool emit_all(const ir::Program& program) {
    for (const auto& piece : program.routines.front().body) {
      if (!std::holds_alternative<ir::Block>(piece.node)) return give_up();
      if (!emit(piece)) return false;
    }
    return true;
  }

  ir::Program frame() const {
    ir::Program program = reader_->frame();
    if (program.routines.empty()) program.routines.emplace_back();
    return program;
  }

  /// The statement at hand, which is this block.
  bool put(const ir::Block& block) {
    switch (watch_.look(block)) {
      case ir::StreamWatch::Verdict::plain: break;
      case ir::StreamWatch::Verdict::local: return put_legalised(block);
      case ir::StreamWatch::Verdict::whole: return give_up();
    }
    plain_ = true;
    follow();
    return emit(statement_);
  }

  /// A block that a pass has to look at: a program of this block alone, under the modal state reached so far.
  bool put_legalised(const ir::Block& block) {
    ir::Program program = frame();
    ir::Body& body = program.routines.front().body;
    const auto start = watch_.start_of(block);
    if (start) body.push_back(*start);
    body.push_back(statement_);
    ir::number_statements(program);
    const machine::Profile source = watch_.source_for(block);
    if (!run_passes(watch_.passes_for(block), program, source, false)) return give_up();
    if (start) {
      if (body.size() != 2) return give_up();
      body.erase(body.begin());
    }
    ir::run_pass("tidy", program, {legal_, source, target_, {options_.cycles}, passing_.back()});
    follow();
    return emit_all(program);
  }

  void follow() {
    if (!watch_.follow(statement_)) return;
    watch_.bare_tool().tell({legal_, source_, target_, {options_.cycles}, passing_[pass_index(ir::length_pass)]});
  }

  bool flush() {
    bool good = true;
    if (eol_ == Eol::lf) {
      good = sink_(out_);
    } else {
      good = sink_(encode_output(out_, Encoding::utf8, eol_, false, writing_));
    }
    out_.clear();
    if (!good) result_.error = "the output could not be written";
    return good;
  }

  std::string path_;
  const Dialect& from_;
  const Dialect& to_;
  const machine::Profile& source_;
  const machine::Profile& target_;
  const TranslateOptions& options_;
  StreamResult& result_;
  const TextSink& sink_;
  std::unique_ptr<frontends::StreamReader> reader_;
  std::unique_ptr<backends::StreamWriter> writer_;
  const ir::Capabilities& legal_;
  ir::StreamWatch watch_;
  // What each stage says comes in the order of the stages, as from the whole-program path.
  Diagnostics reading_, writing_;
  std::vector<Diagnostics> passing_{ir::head_passes().size() + 1};  ///< of each of these, and of those behind them
  ir::Statement statement_;
  FileId file_ = 0;
  std::optional<LineShapes> shapes_;  ///< from the end of the head on, when reader and writer allow it
  std::vector<std::pair<std::uint64_t, std::uint64_t>> states_;
  std::uint32_t state_ = 0;  ///< of the states
  bool plain_ = false;       ///< the block at hand needed no pass
  ir::Body head_;
  std::string origin_;
  std::optional<bool> centres_;
  std::optional<StreamTools> tools_;  ///< from the first tool by its name on
  Span last_code_;                    ///< of the last statement that is more than a comment
  bool ended_ = false;
  std::string out_;
  Eol eol_ = Eol::lf;
};

}  // namespace

StreamResult translate_stream(const std::string& path, const TranslateOptions& options, const TextSink& sink,
                              const Progress& progress) {
  StreamResult result;
  const auto ends = stream_ends(path, options, &result.error);
  if (!ends || options.verify || options.annotate) {
    result.outcome = StreamOutcome::needs_program;
    return result;
  }
  StreamTranslation(*ends->from, *ends->to, ends->source, ends->target, options, result, sink).run(path, progress);
  return result;
}

}  // namespace cnctrans::translator
