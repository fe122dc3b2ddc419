#include "frontends/sinumerik/program/frontend.h"
#include "frontends/common/plain_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "base/text.h"
#include "frontends/common/block_start.h"
#include "frontends/sinumerik/frames/face_radius.h"
#include "frontends/sinumerik/frames/geometry_axes.h"
#include "frontends/sinumerik/program/codes_seen.h"
#include "frontends/sinumerik/state/context.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/state/words.h"
#include "frontends/sinumerik/syntax/executed_text.h"
#include "frontends/sinumerik/syntax/line_reader.h"
#include "frontends/sinumerik/syntax/macros.h"

namespace cnctrans::frontends::sinumerik {

namespace {

using namespace cnctrans::sinumerik;

/// Marks of the end of a tape or a file: NUL, EOT, ^Z.
bool is_trailer(std::string_view text) {
  if (text.empty()) return false;
  return std::all_of(text.begin(), text.end(), [](char c) { return c == '\0' || c == '\x04' || c == '\x1A'; });
}

Span line_span(FileId file, const SourceLine& line) {
  return Span{file, line.number, 1, line.number, static_cast<std::uint32_t>(line.text.size()) + 1};
}

void fill_frame(ir::Program& program, const machine::Profile& profile) {
  program.dialect = "sinumerik";
  program.spaces = variable_spaces();
  program.lathe = profile.kind == machine::Kind::lathe;
  program.unit_hint = profile.power_on.units;
  for (const auto& a : profile.axes) {
    if (a.id < ir::axis::first_extra) continue;
    const std::size_t at = a.id - ir::axis::first_extra;
    if (program.axis_names.size() <= at) program.axis_names.resize(at + 1);
    program.axis_names[at] = a.name;
  }
}

/// Kind by the name's ending: `_SPF` and `.SPF` are subprograms.
bool names_subprogram(std::string_view name) {
  const std::string upper = to_upper_ascii(name);
  return upper.size() > 4 && (upper.ends_with("_SPF") || upper.ends_with(".SPF"));
}

/// `_N_UGUD_DEF`, `_N_COMPLETE_TEA`: definitions or data of the machine in an archive (1.2).
bool names_data(std::string_view upper) {
  constexpr std::array types{"_DEF", "_GUD", "_INI", "_TEA", "_SEA", "_TOA", "_UFR", "_RPA", "_COM"};
  return std::any_of(types.begin(), types.end(), [upper](std::string_view t) { return upper.ends_with(t); });
}

/// The name in a header. %SPF20, of older controls, is called as L20.
ir::RoutineName header_name(std::string_view name) {
  const std::string upper = to_upper_ascii(name);
  const bool numbered =
      upper.size() > 3 && upper.starts_with("SPF") && upper.find_first_not_of("0123456789", 3) == std::string::npos;
  return routine_name(numbered ? "L" + upper.substr(3) : upper);
}

/// The unit that the program sets first.
void set_unit_hint(ir::Program& program) {
  bool found = false;
  for (const auto& routine : program.routines) {
    ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
      const auto* block = std::get_if<ir::Block>(&s.node);
      if (block == nullptr || found) return;
      for (const auto& a : block->actions) {
        const auto* set = std::get_if<ir::ModalSet>(&a.data);
        if (set == nullptr || set->setting != ir::Setting::units) continue;
        program.unit_hint = static_cast<ir::Units>(set->value);
        found = true;
      }
    });
  }
}

class FileReading {
 public:
  FileReading(const SourcePtr& source, FileId file, const ReadOptions& options, Diagnostics& diagnostics,
              ReadStats& stats)
      : source_(source),
        machine_(*options.profile),
        context_{{}, machine_, file, program_, diagnostics, {}, ir::MotionKind::linear, {}, {}, 0},
        words_(context_),
        statements_(context_, words_),
        reader_(options.reader),
        stats_(stats) {
    context_.definitions = options.definitions;
    context_.has_program = options.has_program;
  }

  ir::Program run() {
    fill_frame(program_, *machine_.profile);
    program_.texts->hold(source_);
    const CodesSeen seen(source_->text());
    context_.uses_css = seen.css;
    context_.more_feeds = seen.per_rev && seen.other_feed;
    context_.more_units = machine_.profile->power_on.units == ir::Units::metric ? seen.inch : seen.metric;
    for (std::size_t p = 0; p < seen.planes.size(); ++p) {
      const bool first = p == static_cast<std::size_t>(machine_.profile->power_on.plane);
      context_.more_planes = context_.more_planes || (seen.planes[p] && !first);
    }
    look_.file = context_.file;
    look_.name = source_->name();
    look_.encoding = source_->encoding();
    look_.eol = source_->main_eol();
    look_.bom = source_->has_bom();
    begin_routine(source_->stem(), source_->extension() == "spf");
    for (const SourceLine& line : source_->lines()) take(line);
    if (blank_ != 0) close_blank();
    end_routine();
    if (!source_->lines().empty()) look_.final_eol = source_->lines().back().has_eol;
    program_.files.push_back(std::move(look_));
    set_unit_hint(program_);
    if (context_.said.contains("GEOAX()")) resolve_geometry_axes(program_, context_.diagnostics);
    face_radius(program_, *machine_.profile, context_.diagnostics);
    return std::move(program_);
  }

 private:
  void begin_routine(std::string_view name, bool sub);
  void end_routine();
  void take(const SourceLine& line);
  void take_block(LineReader::Result result);
  void take_header(const syntax::Block& block, const SourceLine& line);
  void next_file();
  void take_words(const syntax::Block& block, ir::LineInfo info);
  void unread(const syntax::Block& block, ir::LineInfo info);
  SourceLine written_out(const SourceLine& line);
  bool reads_with_macros(const ParseError& first);
  void close_blank();

  SourcePtr source_;
  MachineFacts machine_;
  ir::Program program_;
  FileContext context_;
  WordLowering words_;
  StatementLowering statements_;
  LineReader reader_;
  bool joined_text_ = false;  ///< the line at hand is the text of an EXECSTRING() that was joined
  std::optional<BlockParser> macro_parser_;
  ReadStats& stats_;
  ir::FileLook look_;
  ir::Routine routine_;
  bool open_ = false;
  bool fresh_ = false;  ///< nothing but comments in the routine so far
  std::uint16_t blank_ = 0;
  syntax::Block block_;
  ir::LineInfo info_;
};

void FileReading::begin_routine(std::string_view name, bool sub) {
  routine_ = ir::Routine{};
  routine_.kind = sub ? ir::RoutineKind::sub : ir::RoutineKind::main;
  routine_.name = routine_name(name);
  routine_.file = context_.file;
  open_ = fresh_ = true;
  statements_.begin_routine(routine_);
}

void FileReading::end_routine() {
  if (!open_) return;
  statements_.end_routine(source_.get());
  open_ = false;
  if (routine_.has_signature && program_.main() != nullptr)
    routine_.kind = ir::RoutineKind::sub;  // PROC behind a main program
  program_.routines.push_back(std::move(routine_));
}

/// `%_N_NAME_MPF`, `%MPF100`, `%`: the transfer header of one of several programs.
void FileReading::take_header(const syntax::Block& block, const SourceLine& line) {
  std::string name(trim(block.statements.front().text));
  if (name.empty()) {  // a lone mark of a tape
    if (fresh_ && routine_.body.empty()) {
      look_.leader.emplace_back(line.text);
    } else {
      look_.trailer += line.text;
    }
    return;
  }
  const std::string upper = to_upper_ascii(name);
  const bool data = names_data(upper);
  const bool sub = names_subprogram(name) || upper.rfind("SPF", 0) == 0 || data;
  const bool first = program_.routines.empty() && !routine_.header.span.known();
  const bool begun = !fresh_ || routine_.header.span.known() || !routine_.body.empty();
  if (begun && !(fresh_ && first)) {  // comments before the first header belong to its program
    if (blank_ != 0) close_blank();
    end_routine();
    begin_routine(name, sub);
  }
  routine_.kind = sub ? ir::RoutineKind::sub : ir::RoutineKind::main;
  routine_.name = header_name(name);
  routine_.attributes = name;
  fill_line_info(block, context_.line, routine_.header);
  routine_.header.blank_lines_before = blank_;
  blank_ = 0;
  look_.archive = true;
  if (!data || context_.definitions == nullptr) return;  // a file that is read for what it defines
  context_.warning("SIN-112", {},
                   name + " is no program: it is not run, and what it defines is not seen by the programs here",
                   "save it as a file of its own and name it with --lib");
}

/// PROC behind the end of a program: somebody has put several files one behind the other.
void FileReading::next_file() {
  const auto& proc = block_.statements.front();
  context_.warning("SIN-040", proc.pos,
                   "PROC behind the end of the program: read as the next file, " + proc.text +
                       ".SPF; on the control each program has a file of its own",
                   "save it as " + proc.text + ".SPF");
  end_routine();
  begin_routine(proc.text, true);
}

void FileReading::close_blank() {
  ir::Statement s;
  s.line.span = context_.line;
  s.line.blank_lines_before = static_cast<std::uint16_t>(blank_ - 1);
  s.node = ir::Block{};
  blank_ = 0;
  statements_.add(std::move(s));
}

/// A macro may stand for an operator with its operand (DEFINE TENS AS DIV 10 MOD 10). True when the line can be read
/// with each name that is in the way of one replaced by such a text.
bool FileReading::reads_with_macros(const ParseError& first) {
  constexpr int most = 4;
  std::string text(context_.text);
  ParseError at = first;
  for (int n = 0; n < most; ++n) {
    if (at.column == 0 || at.column + at.length - 1 > text.size()) return false;
    const std::string_view name = std::string_view(text).substr(at.column - 1, at.length);
    const auto of_name = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0 ||
        !std::all_of(name.begin(), name.end(), of_name) || is_reserved(to_upper_ascii(name))) {
      return false;
    }
    text.replace(at.column - 1, at.length, "MOD 1");
    syntax::Block scratch;
    if (!macro_parser_) macro_parser_.emplace();
    if (macro_parser_->parse_block(text, scratch, at)) return !scratch.statements.empty();
  }
  return false;
}

void FileReading::unread(const syntax::Block& block, ir::LineInfo info) {
  const ParseError& e = reader_.error();
  const WordPos pos{e.column, e.length};
  if (statements_.other_mode()) {
    ++stats_.blocks_read;
    return statements_.add_opaque(block, std::move(info), "language.other_mode", false);
  }
  if (reads_with_macros(e)) {
    context_.keep(
        "SIN-024", pos,
        std::string(context_.slice(pos)) + " stands where an operator belongs: a macro that another file defines");
    ++stats_.blocks_read;
  } else {
    context_.error("SIN-001", pos, "the block can't be read: " + e.message);
  }
  if (info.labels.empty())
    if (const auto label = frontends::block_start(context_.text).label; !label.empty()) info.labels.push_back(label);
  statements_.add_unread(block, std::move(info));
}

void FileReading::take_words(const syntax::Block& block, ir::LineInfo info) {
  if (statements_.defines() || !WordLowering::is_motion_block(block)) {
    if (statements_.lower(block, std::move(info)) || context_.only_kept()) ++stats_.blocks_read;
    return;
  }
  ir::Statement s;
  auto& node = s.node.emplace<ir::Block>();
  if (!words_.lower(block, node)) {
    statements_.add_opaque(block, std::move(info), words_.feature(), false);
    if (context_.only_kept()) ++stats_.blocks_read;
    return;
  }
  ++stats_.blocks_read;
  const Tail tail = words_.tail();
  ir::LineInfo rest;
  rest.span = info.span;
  rest.skip_mask = info.skip_mask;
  rest.joined = true;
  s.line = std::move(info);
  const auto text = context_.slice(words_.tail_pos());
  if (tail == Tail::none || !node.empty()) {
    statements_.add(std::move(s));
    if (tail == Tail::none) return;
    s = ir::Statement{};
    s.line = std::move(rest);
  }
  if (tail == Tail::program_end) s.node = ir::End{text, true};
  if (tail == Tail::subprogram_end) s.node = ir::Return{{}, text};
  statements_.add(std::move(s));
}

/// With macros written out; the columns of such a line are those of the text made.
SourceLine FileReading::written_out(const SourceLine& line) {
  SourceLine out = line;
  joined_text_ = false;
  if (auto text = executed_text(line.text, context_)) {
    joined_text_ = text->joined;
    out.text = program_.keep(std::move(text->line));
  }
  if (context_.macros.empty()) return out;
  if (auto text = expand_macros(out.text, context_.macros)) out.text = program_.keep(std::move(*text));
  return out;
}

void FileReading::take(const SourceLine& source_line) {
  const SourceLine line = written_out(source_line);
  ++stats_.lines;
  if (is_trailer(line.text)) {
    look_.trailer += line.text;
    return;
  }
  context_.line = line_span(context_.file, line);
  context_.text = line.text;
  context_.errors = context_.kept = 0;
  if (joined_text_) {
    context_.note("SIN-142", WordPos{},
                  "the text of this EXECSTRING() is the block `" + std::string(trim(line.text)) +
                      "`: numbers joined to it are values of its words, not rounded to the digits of a text");
  }
  const LineReader::Result result = reader_.read(line.text, block_);
  if (reader_.scanned()) ++stats_.scanner_blocks;
  if (!reader_.difference().empty()) {
    context_.diagnostics.error("CNC-READERS", context_.line, "the two readers differ:\n" + reader_.difference());
  }
  const bool empty = block_.words.empty() && block_.statements.empty() && block_.number.empty() &&
                     block_.labels.empty() && block_.skip_mask == 0 && result != LineReader::Result::unread;
  if (empty && block_.comments.empty()) {
    ++blank_;
    return;
  }
  if (!block_.statements.empty() && block_.statements.front().keyword == "%") return take_header(block_, line);
  if (!block_.statements.empty() && block_.statements.front().keyword == "PROC" && statements_.ended()) next_file();
  fill_line_info(block_, context_.line, info_);
  info_.blank_lines_before = std::exchange(blank_, std::uint16_t{0});
  if (empty) {
    ir::Statement comment;
    comment.line = info_;
    comment.node = ir::Block{};
    return statements_.add(std::move(comment));
  }
  fresh_ = false;
  if (!block_.labels.empty()) context_.interrupt_lasting();
  ++stats_.blocks;
  context_.skippable = block_.skip_mask != 0;
  if (!context_.skippable) return take_block(result);
  const TextState before = context_;
  take_block(result);
  context_.may_be_left_out(before);
}

void FileReading::take_block(LineReader::Result result) {
  if (result == LineReader::Result::unread) return unread(block_, info_);
  if (result == LineReader::Result::plain) return take_words(block_, info_);
  if (statements_.lower(block_, info_) || context_.only_kept()) ++stats_.blocks_read;
}

// --- streams ----------------------------------------------------------------------------------------------------

class LineStream final : public StreamReader {
 public:
  LineStream(FileId file, const ReadOptions& options, std::string_view name)
      : machine_(*options.profile),
        context_{{}, machine_, file, program_, unused_, {}, options.profile->power_on.motion, {}, {}, 0},
        words_(context_),
        reader_(options.reader) {
    fill_frame(program_, *options.profile);
    context_.offset_chosen = false;
    context_.css = false;
    context_.plane = options.profile->power_on.plane;
    ir::Routine routine;
    const std::size_t slash = name.find_last_of('/');
    std::string_view stem = slash == std::string_view::npos ? name : name.substr(slash + 1);
    stem = stem.substr(0, stem.find_last_of('.'));
    routine.name = routine_name(stem);
    routine.file = file;
    program_.routines.push_back(std::move(routine));
  }

  StreamLine read(const SourceLine& line, ir::Statement& out, Diagnostics& diagnostics) override {
    if (is_trailer(line.text)) return StreamLine::needs_program;
    context_.line = line_span(context_.file, line);
    context_.text = line.text;
    context_.errors = 0;
    if (reader_.read(line.text, block_) == LineReader::Result::unread || !reader_.difference().empty()) {
      return StreamLine::needs_program;
    }
    const bool first = std::exchange(first_, false);
    if (first && !block_.statements.empty() && block_.statements.front().keyword == "%") return header();
    if (!block_.statements.empty() || !block_.labels.empty() || !WordLowering::is_motion_block(block_) ||
        !only_addresses()) {
      return StreamLine::needs_program;
    }
    auto* node = std::get_if<ir::Block>(&out.node);
    if (node == nullptr) node = &out.node.emplace<ir::Block>();
    fill_line_info(block_, context_.line, out.line);
    if (!unused_.empty()) unused_.clear();
    std::optional<TextState> before;
    if (block_.skip_mask != 0) before = context_;
    const bool ok = words_.lower(block_, *node);
    if (before) context_.may_be_left_out(*before);
    if (!unused_.empty()) diagnostics.append(unused_);
    if (!ok || words_.tail() == Tail::subprogram_end || default_offset(*node)) return StreamLine::needs_program;
    return words_.tail() == Tail::program_end ? StreamLine::program_end : StreamLine::statement;
  }
  [[nodiscard]] std::string_view end_word() const override { return context_.slice(words_.tail_pos()); }
  StreamEnd end(std::uint32_t /*lines*/, Diagnostics& /*diagnostics*/) override { return StreamEnd::complete; }
  [[nodiscard]] const ir::Program& frame() const override { return program_; }

 private:
  /// `%_N_NAME_MPF` in the first line.
  StreamLine header() {
    const std::string name(trim(block_.statements.front().text));
    const bool sub = names_subprogram(name) || to_upper_ascii(name).starts_with("SPF");
    if (name.empty() || sub || block_.statements.size() > 1) return StreamLine::needs_program;
    program_.routines.front().name = header_name(name);
    return StreamLine::no_statement;
  }
  /// The tool change of the block selects an offset that is not written.
  static bool default_offset(const ir::Block& b) {
    return std::any_of(b.actions.begin(), b.actions.end(), [](const ir::Action& a) {
      return std::holds_alternative<ir::ToolOffset>(a.data) && a.text.empty();
    });
  }
  /// No variables, no calls, no values that are expressions but the name of a tool.
  [[nodiscard]] bool only_addresses() const {
    for (const auto& w : block_.words) {
      const bool tool_name = w.is_expression && w.address == "T" && w.extension < 0 &&
                             block_.exprs[static_cast<std::size_t>(w.expr)].kind == syntax::ExprKind::string;
      if (w.is_expression && !tool_name) return false;
      if (w.address.size() > 1 && (w.has_value ? named_word(w.address) == nullptr : g_function(w.address) == nullptr))
        return false;
    }
    return true;
  }

  MachineFacts machine_;
  ir::Program program_;
  Diagnostics unused_;
  FileContext context_;
  WordLowering words_;
  LineReader reader_;
  syntax::Block block_;
  bool first_ = true;  ///< the line at hand is the first one
};

class SinumerikFrontend final : public Frontend {
 public:
  [[nodiscard]] std::string_view dialect() const override { return "sinumerik"; }

  ir::Program read(const SourcePtr& source, FileId file, const ReadOptions& options, Diagnostics& diagnostics,
                   ReadStats* stats) const override {
    ReadStats unused;
    return FileReading(source, file, options, diagnostics, stats != nullptr ? *stats : unused).run();
  }
  [[nodiscard]] PlainWords plain_words() const override {
    PlainWords words = usual_plain_words(4);
    words.assignments = true;
    words.comments = {';', 0};
    return words;
  }
  std::unique_ptr<StreamReader> stream(FileId file, const ReadOptions& options,
                                       std::string_view file_name) const override {
    return std::make_unique<LineStream>(file, options, file_name);
  }
};

}  // namespace

std::unique_ptr<const Frontend> make_frontend() {
  return std::make_unique<SinumerikFrontend>();
}

}  // namespace cnctrans::frontends::sinumerik
