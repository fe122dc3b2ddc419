#include "frontends/num/program/frontend.h"
#include "frontends/common/plain_words.h"

#include <map>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/num/limits.h"
#include "dialects/num/milling.h"
#include "dialects/num/variables.h"
#include "frontends/common/own_lengths.h"
#include "frontends/common/word_scanner.h"
#include "frontends/num/cycles/cycle_changes.h"
#include "frontends/num/cycles/cycle_moves.h"
#include "frontends/num/program/lines.h"
#include "frontends/num/state/arrivals.h"
#include "frontends/num/statements/jumps.h"
#include "frontends/num/words/compensation.h"
#include "frontends/num/words/surfaces.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;

namespace {

/// Straight-line programs line by line: word blocks only, of one program, without anything to report.
class NumStream : public StreamReader {
 public:
  NumStream(FileId file, const ReadOptions& options, std::string_view file_name)
      : file_(file),
        settings_(make_settings(*options.profile)),
        lower_(settings_, ignored_),
        watch_(settings_.power_on),
        reader_(options.reader, settings_.structured) {
    frame_.dialect = "num";
    frame_.spaces = facts::spaces();
    frame_.lathe = settings_.lathe;
    ir::Routine main;
    main.file = file;
    std::string_view stem = file_name.substr(file_name.find_last_of("/\\") + 1);
    stem = stem.substr(0, stem.rfind('.'));
    main.name = name_of_file(stem);
    frame_.routines.push_back(std::move(main));
  }

  StreamLine read(const SourceLine& line, ir::Statement& out, Diagnostics& diagnostics) override {
    const Span span{file_, line.number, 1, line.number, static_cast<std::uint32_t>(line.text.size() + 1)};
    ParseError error;
    if (line.text.size() > facts::block_length || !reader_.read(line.text, syntax_, error) ||
        !reader_.difference().empty()) {
      return StreamLine::needs_program;
    }
    if (!syntax_.plain) return header(span);
    if (!std::holds_alternative<ir::Block>(out.node)) out.node = ir::Block{};
    fill_line(syntax_, span, out.line);
    started_ = started_ || !syntax_.words.empty() || !syntax_.number.empty();
    if (syntax_.number.size() > 5 || (syntax_.number.size() == 5 && syntax_.number > "32767"))
      return StreamLine::needs_program;
    const bool good = lower_.words(syntax_, span, line.text, std::get<ir::Block>(out.node), flow_);
    if (!good || flow_.code != nullptr || flow_.linear_after || flow_.probes || flow_.in_cycle ||
        flow_.m_program >= 0 || !flow_.preset.empty() || !ignored_.empty()) {
      (void)diagnostics;  // the whole-program path reports
      return StreamLine::needs_program;
    }
    if (watch_.suspects(std::get<ir::Block>(out.node))) return StreamLine::needs_program;
    ended_ = ended_ || flow_.end;
    return flow_.end ? StreamLine::program_end : StreamLine::statement;
  }

  [[nodiscard]] std::string_view end_word() const override { return flow_.end_text; }
  StreamEnd end(std::uint32_t lines, Diagnostics& diagnostics) override {
    if (!ended_ && started_) note_missing_end(Span{file_, lines, 1, lines, 1}, diagnostics);
    return StreamEnd::complete;
  }
  [[nodiscard]] const ir::Program& frame() const override { return frame_; }

 private:
  StreamLine header(const Span& span) {
    const auto& list = syntax_.statements;
    if (span.line != 1 || list.size() != 1 || list[0].keyword != "%" || list[0].args.empty() ||
        frame_.routines[0].header.span.known()) {
      return StreamLine::needs_program;
    }
    auto& main = frame_.routines[0];
    const double n = list[0].args[0].number;
    if (n != static_cast<double>(saturate<std::int64_t>(n)) || syntax_.comments.size() > 1)
      return StreamLine::needs_program;
    main.name = {saturate<std::int64_t>(n), {}};
    main.header.span = span;
    if (!syntax_.comments.empty()) main.title = std::string(trim(syntax_.comments[0].text));
    return StreamLine::no_statement;
  }

  FileId file_;
  Settings settings_;
  Diagnostics ignored_;
  Lowering lower_;
  CompensationWatch watch_;
  BlockReader reader_;
  ir::Program frame_;
  syntax::Block syntax_;
  Flow flow_;
  bool started_ = false, ended_ = false;
};

using ChangedCycles = std::map<std::uint32_t, std::uint32_t>;

/// The file, read once more as long as the ways of the program bring other facts to a block than it was read with
/// (arrivals.h). A reading can bring calls to light that the one before it had not understood.
ir::Program read_by_the_ways(const SourcePtr& source, FileId file, const ReadOptions& options, Diagnostics& diagnostics,
                             ReadStats& counts, ChangedCycles& changed) {
  constexpr int most_readings = 6;
  const ir::ModalState& power_on = options.profile->power_on;
  const ReadStats before = counts;
  Diagnostics empty = diagnostics;  // with its limits
  empty.clear();
  Arrivals arrivals;
  std::map<std::uint32_t, ActiveCycle> cycles;
  for (int reading = 1;; ++reading) {
    counts = before;
    Diagnostics said = empty;
    FileReader reader(source, file, options, said, counts);
    if (reading > 1) reader.know_arrivals(arrivals, std::move(cycles));
    ir::Program program = reader.read();
    const auto& uses = reader.lowering().modal_uses();
    const Ways ways = uses.empty() ? Ways{} : ways_of(program, options.callers);
    arrivals = arrivals_at(ways, uses, power_on);
    if (reading < most_readings && !agrees(uses, arrivals)) {
      cycles = reader.lowering().cycles();
      continue;
    }
    diagnostics.append(said);
    judge_uses(ways, uses, arrivals, diagnostics);
    changed = reader.lowering().changed_cycles();
    return program;
  }
}

class NumFrontend : public Frontend {
 public:
  [[nodiscard]] std::string_view dialect() const override { return "num"; }
  ir::Program read(const SourcePtr& source, FileId file, const ReadOptions& options, Diagnostics& diagnostics,
                   ReadStats* stats) const override {
    ReadStats own;
    ReadStats& counts = stats != nullptr ? *stats : own;
    ChangedCycles changed;
    ir::Program program = read_by_the_ways(source, file, options, diagnostics, counts, changed);
    judge_cycle_changes(program, options.profile->power_on, changed, diagnostics);
    judge_cycle_moves(program, options.profile->power_on, diagnostics);
    settle_own_lengths(program, options.profile->power_on,
                       {facts::reapproach, facts::oriented_clearance, facts::pocket_clearance}, diagnostics);
    judge_jumps(program, diagnostics);
    judge_surfaces(program, options.profile->power_on, diagnostics);
    judge_compensation(program, options.profile->power_on, diagnostics);
    return program;
  }
  [[nodiscard]] bool reads_by_callers() const override { return true; }
  [[nodiscard]] PlainWords plain_words() const override {
    PlainWords words = usual_plain_words(3, dialects::num::label_max);
    words.comments = {'(', ')'};
    return words;
  }
  [[nodiscard]] std::unique_ptr<StreamReader> stream(FileId file, const ReadOptions& options,
                                                     std::string_view file_name) const override {
    return std::make_unique<NumStream>(file, options, file_name);
  }
};

}  // namespace

std::unique_ptr<const Frontend> make_frontend() {
  return std::make_unique<NumFrontend>();
}

}  // namespace cnctrans::frontends::num
