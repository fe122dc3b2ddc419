#include "frontends/fagor/frontend.h"

#include <algorithm>
#include <optional>

#include "base/text.h"
#include "dialects/fagor/limits.h"
#include "frontends/fagor/program_reader.h"

namespace cnctrans::frontends::fagor {

namespace {

using cnctrans::fagor::BlockLowerer;
using cnctrans::fagor::BlockResult;
using cnctrans::fagor::LineReader;
using cnctrans::fagor::LowerState;
using cnctrans::fagor::ParseError;

constexpr std::size_t max_number_digits = 8;  ///< of a block number; longer ones are reported

/// Word blocks, comments, header and program end; anything else needs the whole program.
class FagorStream : public StreamReader {
 public:
  FagorStream(FileId file, const ReadOptions& options, std::string_view file_name)
      : file_(file), state_(*options.profile, quiet_), reader_(options.reader) {
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
    if (!carry_offset(std::get<ir::Block>(out.node), out.line, result.offset_waits)) return StreamLine::needs_program;
    if (!result.end) return StreamLine::statement;
    if (waiting_) return StreamLine::needs_program;
    end_word_ = cnctrans::fagor::word_text(*result.end);
    return StreamLine::program_end;
  }

  [[nodiscard]] std::string_view end_word() const override { return end_word_; }
  void end(std::uint32_t /*lines*/, Diagnostics& diagnostics) override {
    if (waiting_)
      diagnostics.warning("FAG-052", state_.line(), "the offset beside a T waits for an M06 that does not come");
  }
  /// Coordinates and centres are checked against 99999.9999 only, block numbers against 8 digits; F0 has a meaning of
  /// its own. Rotary words are looked at one by one.
  [[nodiscard]] FreeNumbers free_numbers() const override {
    FreeNumbers free;
    for (const char c : std::string_view("XYZUVWIJK")) {
      free[static_cast<std::size_t>(c - 'A')] = {true, true, true, 5, dialects::fagor::decimals_mm};
    }
    free['F' - 'A'] = {true, false, false, 5, dialects::fagor::decimals_mm};
    free['N' - 'A'] = {true, false, true, max_number_digits, 0};
    return free;
  }
  [[nodiscard]] std::uint64_t modal_key() const override {
    std::uint64_t key = 1;
    const auto add = [&key](auto value) { key = key << 5U | static_cast<std::uint64_t>(value); };
    add(state_.plane_now());
    add(state_.comp_by_text);
    add(state_.units_by_text);
    add(state_.motion_by_text);
    add(static_cast<int>(state_.motion_sure) + 2 * static_cast<int>(state_.comp_begins) +
        4 * static_cast<int>(state_.plane_changed) + 8 * static_cast<int>(state_.comp_sure));
    add(state_.facts.rotary);
    add(state_.facts.preset);
    add(state_.facts.table_shift);
    add(state_.facts.shift);
    add(waiting_.has_value());
    return key;
  }
  [[nodiscard]] const ir::Program& frame() const override { return frame_; }

 private:
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

  /// On a tool changer the D beside a T counts from the M06 on (offsets_with_change). False: the whole program is
  /// needed.
  bool carry_offset(ir::Block& block, const ir::LineInfo& line, bool waits) {
    if (!waiting_ && !waits) return true;
    if (line.skip_mask != 0) return false;
    const auto find = [&block](auto is) { return std::find_if(block.actions.begin(), block.actions.end(), is); };
    const auto offset = find([](const ir::Action& a) { return std::holds_alternative<ir::ToolOffset>(a.data); });
    const auto tool = find([](const ir::Action& a) { return std::holds_alternative<ir::ToolSelect>(a.data); });
    const auto change = find([](const ir::Action& a) { return std::holds_alternative<ir::ToolChange>(a.data); });
    const auto end = block.actions.end();
    if (waiting_) {
      if (offset != end || tool != end) return false;
      if (change == end) return true;
      waiting_->order = change->order;
      waiting_->pos = {};
      waiting_->text = {};
      block.actions.insert(change + 1, std::move(*waiting_));
      waiting_.reset();
      return true;
    }
    if (offset == end || change != end || !std::get<ir::ToolOffset>(offset->data).number.literal()) return false;
    waiting_ = std::move(*offset);
    block.actions.erase(offset);
    return true;
  }

  FileId file_;
  std::optional<ir::Action> waiting_;  ///< the offset of a tool that the spindle does not have yet
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
    return cnctrans::fagor::ProgramReader(options, file, diagnostics).read(source, stats);
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
