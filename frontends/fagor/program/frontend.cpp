#include "frontends/fagor/program/frontend.h"
#include "frontends/common/plain_words.h"

#include <algorithm>
#include <optional>

#include "base/text.h"
#include "dialects/fagor/limits.h"
#include "frontends/fagor/program/program_reader.h"
#include "frontends/fagor/program/tool_offsets.h"
#include "ir/edit/search.h"

namespace cnctrans::frontends::fagor {

namespace {

using cnctrans::fagor::BlockLowerer;
using cnctrans::fagor::BlockResult;
using cnctrans::fagor::LineReader;
using cnctrans::fagor::LowerState;
using cnctrans::fagor::may_change_tools;
using cnctrans::fagor::ParseError;
using cnctrans::fagor::WaitingOffset;

constexpr std::size_t max_number_digits = 8;  ///< of a block number; longer ones are reported

/// Word blocks, comments, header and program end; anything else needs the whole program.
class FagorStream : public StreamReader {
 public:
  FagorStream(FileId file, const ReadOptions& options, std::string_view file_name)
      : profile_(*options.profile),
        look_(options.look),
        file_(file),
        state_(*options.profile, quiet_),
        reader_(options.reader) {
    frame_.dialect = "fagor";
    frame_.spaces = cnctrans::fagor::make_spaces();
    frame_.lathe = state_.lathe();
    frame_.unit_hint = options.profile->power_on.units;
    ir::Routine& main = frame_.routines.emplace_back();
    main.kind = ir::RoutineKind::main;
    main.file = file;
    main.name.text = to_upper_ascii(SourceText::from_string(std::string(file_name), {})->stem());
  }

  StreamLine read(const SourceLine& line, ir::Statement& out, Diagnostics& diagnostics) override {
    state_.set_diagnostics(diagnostics);
    state_.set_line(cnctrans::fagor::line_span(file_, line));
    if (cnctrans::fagor::without_control(line.text).size() != line.text.size()) return StreamLine::needs_program;
    if (!line.text.empty() && line.text.front() == '%') return header(line, out);
    ParseError error;
    if (!reader_.read(line.text, block_, error, state_) || !block_.statements.empty()) return StreamLine::needs_program;
    if (block_.number.size() > max_number_digits) return StreamLine::needs_program;
    first_ = first_ && block_.words.empty() && block_.number.empty();
    cnctrans::fagor::fill_line(block_, state_.line(), out.line);
    if (!std::holds_alternative<ir::Block>(out.node)) out.node = ir::Block{};
    BlockResult result;
    lowerer_.lower(block_, std::get<ir::Block>(out.node), result);
    if (state_.facts.unlisted_parameters || result.needs_program || result.call || !result.opaque.empty())
      return StreamLine::needs_program;
    if (state_.tool_changer() && !follow_offset(out)) return StreamLine::needs_program;
    if (!result.end) return StreamLine::statement;
    if (waiting()) return StreamLine::needs_program;
    end_word_ = cnctrans::fagor::word_text(*result.end);
    return StreamLine::program_end;
  }

  [[nodiscard]] std::string_view end_word() const override { return end_word_; }
  StreamEnd end(std::uint32_t /*lines*/, Diagnostics& /*diagnostics*/) override {
    return waiting() ? StreamEnd::needs_program : StreamEnd::complete;
  }
  [[nodiscard]] const ir::Program& frame() const override { return frame_; }

 private:
  /// The text holds an M06.
  enum class Changes : std::uint8_t { unknown, maybe, never };

  [[nodiscard]] bool waiting() const { return rule_.waits() && changes_ != Changes::never; }

  StreamLine header(const SourceLine& line, ir::Statement& out) {
    ir::Routine& main = frame_.routines[0];
    if (!first_ || main.header.span.known() || line.text.size() == 1) return StreamLine::needs_program;
    if (!cnctrans::fagor::read_header(trim(line.text), main.title, main.attributes)) return StreamLine::needs_program;
    main.header.span = state_.line();
    out.line.clear();
    out.line.span = state_.line();
    out.node = ir::Block{};
    return StreamLine::no_statement;
  }

  /// The D beside a T of a tool changer (5.6). False: the whole program is needed.
  bool follow_offset(ir::Statement& s) {
    auto& block = std::get<ir::Block>(s.node);
    if (block.actions.empty() && !rule_.waits()) return true;
    if (changes_ == Changes::never) return ir::action_in<ir::ToolChange>(block) == nullptr;
    using Step = WaitingOffset::Step;
    const Step step = rule_.follow(s, false);
    if (step == Step::begins) {
      if (changes_ == Changes::unknown) changes_ = look_for_changes();
      if (changes_ == Changes::never) return true;
      waiting_ = WaitingOffset::take(block);
    } else if (step == Step::arrives) {
      WaitingOffset::put(block, std::move(waiting_));
    }
    return step != Step::lost;
  }
  /// Without an M06 anywhere the tools are changed by hand, and no offset waits.
  [[nodiscard]] Changes look_for_changes() const {
    const auto holds = [this](std::string_view text) { return may_change_tools(text, profile_); };
    return !look_ || look_(holds) ? Changes::maybe : Changes::never;
  }

  const machine::Profile& profile_;
  TextLook look_;
  FileId file_;
  WaitingOffset rule_;
  ir::Action waiting_{};  ///< the offset of a tool that the spindle does not have yet
  Changes changes_ = Changes::unknown;
  Diagnostics quiet_;
  LowerState state_;
  LineReader reader_;
  BlockLowerer lowerer_{state_};
  syntax::Block block_;
  ir::Program frame_;
  std::string_view end_word_;
  bool first_ = true;
};

class FagorFrontend : public Frontend {
 public:
  [[nodiscard]] std::string_view dialect() const override { return "fagor"; }
  ir::Program read(const SourcePtr& source, FileId file, const ReadOptions& options, Diagnostics& diagnostics,
                   ReadStats* stats) const override {
    // What only the whole file shows is known to the next reading: where the main part goes on behind a subroutine,
    // then the planes that the flow of the program brings.
    std::set<std::uint32_t> lines_of_main;
    std::map<std::uint32_t, ir::Plane> planes;
    while (true) {
      Diagnostics said = diagnostics;  // with its limits
      said.clear();
      cnctrans::fagor::ProgramReader reader(options, file, said);
      reader.know_lines_of_main(lines_of_main);
      reader.know_planes(planes);
      ir::Program program = reader.read(source, stats);
      const bool with_planes = !planes.empty();
      if (!reader.lines_of_main().empty()) {
        lines_of_main = reader.lines_of_main();
      } else if (with_planes || (planes = reader.planes_by_flow()).empty()) {
        diagnostics.append(said);
        return program;
      }
    }
  }
  [[nodiscard]] PlainWords plain_words() const override {
    PlainWords words = usual_plain_words(4);
    words.comments = {';', 0};
    return words;
  }
  std::unique_ptr<StreamReader> stream(FileId file, const ReadOptions& options,
                                       std::string_view file_name) const override {
    return std::make_unique<FagorStream>(file, options, file_name);
  }
};

}  // namespace

std::unique_ptr<Frontend> make_frontend() {
  return std::make_unique<FagorFrontend>();
}

}  // namespace cnctrans::frontends::fagor
