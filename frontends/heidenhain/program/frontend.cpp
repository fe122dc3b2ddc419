#include "frontends/heidenhain/program/frontend.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/text.h"
#include "dialects/heidenhain/variables.h"
#include "frontends/common/block_start.h"
#include "frontends/heidenhain/program/again.h"
#include "frontends/heidenhain/program/areas.h"
#include "frontends/heidenhain/program/copies.h"
#include "frontends/heidenhain/program/cycle_feeds.h"
#include "frontends/heidenhain/program/finish.h"
#include "frontends/heidenhain/program/leads.h"
#include "frontends/heidenhain/program/plunge.h"
#include "frontends/heidenhain/program/structure.h"
#include "frontends/heidenhain/program/text_labels.h"
#include "frontends/heidenhain/program/tools.h"
#include "frontends/heidenhain/program/ways_of_text.h"
#include "frontends/heidenhain/syntax/reader.h"
#include "ir/analysis/dataflow.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;

namespace {

/// R0 and the tool axis stand in nearly every block: where the ways of the program bring nothing else, they say nothing
/// new. What a program that calls this file has left in force is not known.
void leave_out_what_is_in_force(ir::Program& program, const ir::ModalState& power_on) {
  ir::number_statements(program);
  ir::Routine& main = program.routines[0];
  main.kind = ir::RoutineKind::sub;
  const ir::FactTable table = ir::analyse(program, power_on);
  main.kind = ir::RoutineKind::main;
  for (auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](ir::Statement& s) {
      auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      const ir::Facts& before = table.before(s.id);
      if (!before.reachable) return;
      std::erase_if(b->actions, [&](const ir::Action& a) {
        const auto* set = std::get_if<ir::ModalSet>(&a.data);
        return set != nullptr && before.settings[static_cast<std::size_t>(set->setting)] == set->value;
      });
    });
  }
}

/// Sentences that manuals print in several lines without `~` (reference 1.3), and what the further lines begin with.
struct Wrapped {
  std::string_view sentence;
  std::array<std::string_view, 7> further;
};
constexpr std::array wrapped{
    Wrapped{"PLANE", {"TURN", "MOVE", "STAY"}},
    Wrapped{"PATTERN DEF", {"(", "POS", "ROW", "PAT", "FRAME", "CIRC", "PITCHCIRC"}},
};

bool goes_on(std::string_view line, std::string_view below) {
  const auto begins = [](std::string_view text, std::string_view word) {
    if (word.empty() || !iequals_ascii(text.substr(0, word.size()), word)) return false;
    const char next = text.size() > word.size() ? text[word.size()] : ' ';
    return word == "(" || std::isalpha(static_cast<unsigned char>(next)) == 0;
  };
  const std::string_view first = trim(line.substr(std::min(line.find_first_not_of(" \t0123456789"), line.size())));
  const std::string_view next = trim(below);
  if (first.find(';') != std::string_view::npos || first.empty() || first.back() == '~') return false;
  return std::any_of(wrapped.begin(), wrapped.end(), [&](const Wrapped& w) {
    return begins(first, w.sentence) &&
           std::any_of(w.further.begin(), w.further.end(), [&](std::string_view word) { return begins(next, word); });
  });
}

class HeidenhainReader {
 public:
  HeidenhainReader(const SourcePtr& source, FileId file, const ReadOptions& options, Diagnostics& diagnostics,
                   ReadStats& stats)
      : source_(source),
        file_(file),
        options_(options),
        diagnostics_(diagnostics),
        stats_(stats),
        reader_(options.reader),
        lowering_(*options.profile, program_, diagnostics) {}

  ir::Program read() {
    program_.dialect = "heidenhain";
    program_.spaces = facts::spaces();
    program_.texts->hold(source_);
    ir::FileLook look;
    look.file = file_;
    look.name = source_->name();
    look.encoding = source_->encoding();
    look.eol = source_->main_eol();
    look.bom = source_->has_bom();
    const auto& lines = source_->lines();
    look.final_eol = lines.empty() || lines.back().has_eol;
    program_.files.push_back(std::move(look));
    look_at_callers();
    read_all();
    check_ways_of_text(lowering_);
    take_tools(lowering_, false);
    write_leads(lowering_);
    limit_plunges(lowering_);
    copy_for_cycles(lowering_);
    take_tools(lowering_, true);
    read_areas(lowering_, *options_.profile);
    const Flow flow(lowering_.flat());
    std::vector<std::vector<ir::Statement>> statements;
    finish_items(lowering_, flow, statements);
    ir::Routine main;
    main.file = file_;
    main.name.text = lowering_.name().empty() ? to_upper_ascii(source_->stem()) : lowering_.name();
    program_.unit_hint = lowering_.inch() ? ir::Units::inch : ir::Units::metric;
    build_routines(lowering_, flow, std::move(statements), std::move(main), program_);
    declare_texts();
    if (!lowering_.began() && !lines.empty() && !din_iso_) {
      diagnostics_.warning("HEI-014", Span{file_, 1, 1, 1, 1}, "the file does not begin with BEGIN PGM: millimetres",
                           "write BEGIN PGM NAME MM");
    }
    leave_out_what_is_in_force(program_, options_.profile->power_on);
    const bool alone = options_.callers == nullptr || options_.callers->empty();
    if (feeds_before_cycles(program_, options_.profile->power_on, alone))
      diagnostics_.note("HEI-019", Span{file_, 1, 1, 1, 1},
                        "the program has no M2 or M30: for one that calls it, the F of its last cycle is in force on "
                        "other controls");
    return std::move(program_);
  }

 private:
  void read_all() {
    read_lines(*source_, 1, source_->last_line());
    names_.insert(to_upper_ascii(source_->stem()));
    texts_[file_] = source_;
    Again again;
    again.look_into = [this](const std::string& name) -> const Shared& { return look_into(name); };
    again.read_program = [this](const Item& call, const std::string& name) {
      const auto& text = called_.at(name);
      texts_[text.file] = text.source;
      once_more(call, Span{text.file, 1, 1, 1, 1}, Span{text.file, text.source->last_line(), 1, 1, 1});
    };
    again.read = [this](const Item& call, const Span& first, const Span& last) { once_more(call, first, last); };
    find_text_labels(lowering_, false);
    read_again(lowering_, again);
    find_text_labels(lowering_, true);
  }
  void read_lines(const SourceText& source, std::uint32_t first, std::uint32_t last) {
    const auto& lines = source.lines();
    for (std::size_t k = 0; k < lines.size(); ++k) {
      SourceLine l = lines[k];
      while (k + 1 < lines.size() && goes_on(l.text, lines[k + 1].text))
        l.text = program_.keep(std::string(l.text) + ' ' + std::string(trim(lines[++k].text)));
      if (l.number >= first && l.number <= last) line(l);
    }
    lowering_.flush();
  }
  /// What was said of a line is not said again.
  void once_more(const Item& call, const Span& first, const Span& last) {
    const SourcePtr text = texts_.at(first.file);
    program_.texts->hold(text);
    const FileId own = std::exchange(file_, first.file);
    const ReadStats counted = stats_;
    const Diagnostics said = std::exchange(diagnostics_, Diagnostics{});
    if (first.file == own)
      lowering_.read_as_at(call);
    else
      lowering_.open_program(call, first);
    read_lines(*text, first.line, last.line);
    lowering_.close_program();
    const Diagnostics more = std::exchange(diagnostics_, said);
    for (const auto& d : more.all()) {
      if (std::find(said.all().begin(), said.all().end(), d) == said.all().end()) diagnostics_.add(d);
    }
    stats_ = counted;
    file_ = own;
  }
  /// Long programs are toolpaths, which take nothing from their caller.
  const Shared& look_into(const std::string& name) {
    constexpr std::size_t longest = 1U << 20U;
    const auto [it, fresh] = looked_.try_emplace(name);
    if (!fresh || !options_.called_text || names_.count(name) != 0) return it->second;
    const auto text = options_.called_text(name);
    if (!text.source || text.source->bytes().size() > longest) return it->second;
    called_[name] = text;
    Diagnostics unsaid;
    ReadStats uncounted;
    HeidenhainReader probe(text.source, text.file, options_, unsaid, uncounted);
    probe.names_ = names_;
    it->second = probe.shared(lowering_.inch());
    return it->second;
  }
  Shared shared(bool inch) {
    read_all();
    Shared out;
    const Flat& flat = lowering_.flat();
    const Flow flow(flat);
    out.readable = lowering_.inch() == inch;
    out.known = true;
    for (std::size_t i = 0; i < flat.items.size(); ++i) {
      const Item& item = flat.items[i];
      const Arrival& a = flow.arrivals()[i];
      const auto* end = std::get_if<ir::End>(&item.statement.node);
      const bool stays = item.kind != ItemKind::sub_end && (end == nullptr || end->returns_from_sub);
      out.readable = out.readable && (stays || item.statement.line.span.file != file_);
      if (!a.reached) continue;
      const bool runs =
          item.call != CycleCall::none || item.at_pattern || (item.kind == ItemKind::plain && item.index >= 0);
      out.cycle = out.cycle || (runs && a.cycle == Arrival::none);
      out.pattern = out.pattern || (item.at_pattern && a.pattern == Arrival::none);
      out.pole = out.pole || ((item.by_pole || item.polar) && a.pole == Arrival::none);
      out.known = out.known && (item.kind != ItemKind::program || item.defines_none);
      out.defines = out.defines || item.kind == ItemKind::cycle;
      out.moves = out.moves || item.moves;
      for (std::size_t k = 0; k < along_text; ++k) out.text[k] = out.text[k] || (item.relies[k] && a.text[k] == 0);
    }
    return out;
  }
  /// Each file has its own unit.
  void look_at_callers() {
    const auto* all = options_.callers;
    if (all == nullptr || all->empty()) return;
    const auto differs = [all](const ir::Program* p) { return p->unit_hint != all->front()->unit_hint; };
    lowering_.outer_unit(all->front()->unit_hint, std::any_of(all->begin(), all->end(), differs));
  }
  void declare_texts() {
    if (lowering_.texts().empty()) return;
    ir::Declare d;
    d.type = ir::Type::string;
    d.space = facts::space_qs;
    for (const auto& name : lowering_.texts()) d.items.push_back({name, {}, {}});
    ir::Statement s;
    s.line.span = Span{file_, 1, 1, 1, 1};
    s.node = std::move(d);
    auto& body = program_.routines[0].body;
    body.insert(body.begin(), std::move(s));
  }
  void line(const SourceLine& l) {
    ++stats_.lines;
    std::string_view text = l.text;
    while (!text.empty() && (text.back() == '\x1a' || text.back() == '\0')) text.remove_suffix(1);
    const Span span{file_, l.number, 1, l.number, static_cast<std::uint32_t>(l.text.size() + 1)};
    if (trim(text).empty()) {
      if (blank_ < std::numeric_limits<std::uint16_t>::max()) ++blank_;
      return;
    }
    if (std::exchange(first_line_, false) && trim(text).front() == '%') {
      din_iso_ = true;
      diagnostics_.error("HEI-014", span, "a program in DIN/ISO (`%NAME G71`), which is another language",
                         "give the conversational program (.H)");
    }
    if (din_iso_) {
      ir::LineInfo info;
      info.span = span;
      ++stats_.blocks;
      return lowering_.unread(std::move(info), text);
    }
    ParseError error;
    const bool ok = reader_.read(text, syntax_, error);
    if (!reader_.difference().empty()) diagnostics_.error("CNC-READERS", span, reader_.difference());
    ir::LineInfo info;
    info.span = span;
    info.blank_lines_before = std::exchange(blank_, std::uint16_t{0});
    const bool is_block = !ok || !syntax_.words.empty() || !syntax_.statements.empty();
    if (is_block) ++stats_.blocks;
    if (!ok) {
      diagnostics_.error("HEI-001", word_span(span, error.pos), "the block can't be read: " + error.message);
      return lowering_.unread(std::move(info), text);
    }
    if (reader_.scanned() && is_block) ++stats_.scanner_blocks;
    info.skip_mask = syntax_.skip_mask;
    for (const auto& c : syntax_.comments) {
      info.comments.push_back({c.text, is_block ? ir::CommentPlace::end_of_line : ir::CommentPlace::own_line, c.pos});
    }
    const std::size_t errors = diagnostics_.error_count();
    lowering_.line(syntax_, span, text, std::move(info));
    if (is_block && diagnostics_.error_count() == errors) ++stats_.blocks_read;
  }

  SourcePtr source_;
  FileId file_;
  const ReadOptions& options_;
  Diagnostics& diagnostics_;
  ReadStats& stats_;
  ir::Program program_;
  LineReader reader_;
  Lowering lowering_;
  syntax::Block syntax_;
  std::set<std::string> names_;  ///< of this program and of those that are being looked into
  std::map<std::string, Shared> looked_;
  std::map<std::string, ReadOptions::Text> called_;
  std::map<FileId, SourcePtr> texts_;
  std::uint16_t blank_ = 0;
  bool first_line_ = true, din_iso_ = false;
};

/// Labels, CC and cycles need the whole program.
class NoStream : public StreamReader {
 public:
  NoStream() { frame_.dialect = "heidenhain"; }
  StreamLine read(const SourceLine&, ir::Statement&, Diagnostics&) override { return StreamLine::needs_program; }
  [[nodiscard]] std::string_view end_word() const override { return {}; }
  StreamEnd end(std::uint32_t, Diagnostics&) override { return StreamEnd::needs_program; }
  [[nodiscard]] const ir::Program& frame() const override { return frame_; }

 private:
  ir::Program frame_;
};

/// Words of plain lines; longer ones stand before those that they begin with.
constexpr std::array<PlainCode, 10> plain_codes{{{"L", 1, 'G'},
                                                 {"CC", -1, 0},
                                                 {"CR", -1, 0},
                                                 {"C", -1, 0},
                                                 {"FMAX", 0, 'G'},
                                                 {"R0", -1, 'R'},
                                                 {"RL", -1, 'R'},
                                                 {"RR", -1, 'R'},
                                                 {"DR+", 3, 'G'},
                                                 {"DR-", 2, 'G'}}};

class HeidenhainFrontend : public Frontend {
 public:
  [[nodiscard]] std::string_view dialect() const override { return "heidenhain"; }
  ir::Program read(const SourcePtr& source, FileId file, const ReadOptions& options, Diagnostics& diagnostics,
                   ReadStats* stats) const override {
    ReadStats own;
    return HeidenhainReader(source, file, options, diagnostics, stats != nullptr ? *stats : own).read();
  }
  /// Straight lines, and arcs by their radius or by a CC before them, with or without block numbers.
  [[nodiscard]] PlainWords plain_words() const override {
    PlainWords words;
    for (const char c : {'X', 'Y', 'Z', 'A', 'B', 'C'})
      words.numbers[static_cast<std::size_t>(c - 'A')] = {
          .free = true, .minus = true, .zero = true, .plus = true, .whole = 5, .places = 4};
    words.numbers['F' - 'A'] = {.free = true, .whole = 5, .places = 3};
    words.numbers['R' - 'A'] = {.free = true, .plus = true, .whole = 5, .places = 4};
    words.numbers['N' - 'A'] = {.free = true, .zero = true, .whole = 8, .most = 99'999'999};
    words.codes = plain_codes;
    words.bare_block_number = true;
    words.lead = "CC";
    words.increment = 'I';
    words.comments = {';', 0};
    return words;
  }
  [[nodiscard]] bool reads_by_callers() const override { return true; }
  [[nodiscard]] std::unique_ptr<StreamReader> stream(FileId, const ReadOptions&, std::string_view) const override {
    return std::make_unique<NoStream>();
  }
};

}  // namespace

std::unique_ptr<const Frontend> make_frontend() {
  return std::make_unique<HeidenhainFrontend>();
}

}  // namespace cnctrans::frontends::heidenhain
