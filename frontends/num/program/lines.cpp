#include "frontends/num/program/lines.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/num/limits.h"
#include "dialects/num/variables.h"
#include "frontends/common/block_start.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;

void note_missing_end(const Span& end, Diagnostics& diagnostics) {
  diagnostics.note("NUM-037", end, "the program has no M02; it ends with its last block");
}

void fill_line(const syntax::Block& b, const Span& span, ir::LineInfo& line) {
  line.clear();
  line.span = span;
  line.number = b.number;
  line.skip_mask = b.skip_mask;
  if (b.comments.empty()) return;
  std::uint32_t last = b.number_pos.column;
  const bool alone = b.words.empty() && b.statements.empty() && b.number.empty();
  if (!b.words.empty()) last = std::max(last, b.words.back().pos.column);
  if (!b.statements.empty()) last = std::max(last, b.statements.back().pos.column);
  for (const auto& c : b.comments) {
    const auto place = alone                 ? ir::CommentPlace::own_line
                       : c.pos.column < last ? ir::CommentPlace::mid_line
                                             : ir::CommentPlace::end_of_line;
    line.comments.push_back({c.text, place, c.pos});
  }
}

ir::RoutineName name_of_file(std::string_view stem) {
  const auto number = parse_decimal(stem);
  const bool digits = !stem.empty() && stem.find_first_not_of("0123456789") == std::string_view::npos;
  if (digits && number && *number >= facts::program_min && *number <= facts::program_max) {
    return {saturate<std::int64_t>(*number), {}};
  }
  return {-1, to_upper_ascii(stem)};
}

namespace {

/// Whether the text names PREF (E6x000) or DEC3 (E6x004).
bool names_pref(std::string_view text) {
  for (std::size_t at = text.find("E6"); at != std::string_view::npos; at = text.find("E6", at + 1)) {
    const std::string_view digits = text.substr(at + 2, 4);
    if (digits.size() == 4 && digits[0] <= '8' && digits.substr(1, 2) == "00" && (digits[3] == '0' || digits[3] == '4'))
      return true;
  }
  return false;
}

/// Whether an offset may be another one behind it: G92, or a value for an E6x0nn.
bool sets_offsets(std::string_view text) {
  constexpr std::size_t name = 6;
  if (text.find("G92") != std::string_view::npos) return true;
  for (std::size_t at = text.find("E6"); at != std::string_view::npos; at = text.find("E6", at + 1)) {
    const auto next = text.find_first_not_of(' ', at + name);
    if (next != std::string_view::npos && text[next] == '=' && text[at + name - 1] != '5') return true;  // 5: the shift
  }
  return false;
}

/// Whether the text names a latched position (E7x001).
bool names_latched(std::string_view text) {
  for (std::size_t at = text.find("E7"); at != std::string_view::npos; at = text.find("E7", at + 1)) {
    if (at + 3 < text.size() && text.substr(at + 3, 3) == "001") return true;
  }
  return false;
}

Span line_span(FileId file, const SourceLine& l) {
  return {file, l.number, 1, l.number, static_cast<std::uint32_t>(l.text.size() + 1)};
}

/// What a tape leaves in a file: NUL, DC1, DC3, EOT and ^Z at the ends of a line are no text.
std::string_view without_tape_bytes(std::string_view text) {
  const auto tape = [](char c) { return c == '\0' || c == '\x11' || c == '\x13' || c == '\x04' || c == '\x1a'; };
  while (!text.empty() && tape(text.front())) text.remove_prefix(1);
  while (!text.empty() && tape(text.back())) text.remove_suffix(1);
  return text;
}

/// `X OFF`: the reader of the tape stops.
bool ends_tape(std::string_view text) {
  constexpr std::string_view mark = "XOFF";
  std::size_t at = 0;
  for (const char c : text) {
    if (c == ' ' || c == '\t') continue;
    if (at == mark.size() || (c | 0x20) != (mark[at] | 0x20)) return false;
    ++at;
  }
  return at == mark.size();
}

bool blank(std::string_view text) {
  return text.find_first_not_of(" \t") == std::string_view::npos;
}

}  // namespace

FileReader::FileReader(const SourcePtr& source, FileId file, const ReadOptions& options, Diagnostics& diagnostics,
                       ReadStats& stats)
    : source_(source),
      file_(file),
      diagnostics_(diagnostics),
      stats_(stats),
      settings_(make_settings(*options.profile)),
      lower_(settings_, diagnostics),
      reader_(options.reader, settings_.structured) {
  lower_.collect_uses();
}

ir::Program FileReader::read() {
  program_.dialect = "num";
  program_.spaces = facts::spaces();
  program_.lathe = settings_.lathe;
  program_.texts->hold(source_);
  ir::FileLook look;
  look.file = file_;
  look.name = source_->name();
  look.encoding = source_->encoding();
  look.eol = source_->main_eol();
  look.bom = source_->has_bom();
  const auto& lines = source_->lines();
  const std::string text = to_upper_ascii(source_->text());
  lower_.expressions().keep_offsets_apart(names_pref(text));
  lower_.expressions().know_offsets_only_read(names_pref(text) && !sets_offsets(text));
  latches_ = names_latched(text);
  look.final_eol = lines.empty() || lines.back().has_eol;
  program_.files.push_back(std::move(look));
  find_macros();
  if (!settings_.bad_m_programs.empty()) {
    diagnostics_.error("NUM-061", Span{file_, 1, 1, 1, 1},
                       "num.m_programs of the machine profile: `" + settings_.bad_m_programs + "` is no M:program",
                       "write it as 6:9100");
  }
  for (const SourceLine& l : lines) line(l);
  if (!open_ && program_.routines.empty()) begin_routine({}, {}, {});
  end_routine();
  for (const std::int64_t n : lower_.expressions().unlisted())
    program_.spaces[facts::space_e].segments.push_back({n, n, ir::Scope::global, true, false, true});
  program_.files[0].archive = program_.routines.size() > 1;
  return std::move(program_);
}

/// Macros of the machine (%10100 to %10255) that the file brings along.
void FileReader::find_macros() {
  constexpr std::string_view mark = "%10";
  for (const SourceLine& l : source_->lines()) {
    const std::string_view text = without_tape_bytes(l.text);
    if (text.substr(0, mark.size()) != mark) continue;
    const auto n = parse_decimal(text.substr(mark.size(), 3));
    const bool ends =
        text.size() == mark.size() + 3 || (text.size() > mark.size() + 3 && (text[6] < '0' || text[6] > '9'));
    if (n && ends) lower_.add_macro(saturate<std::int64_t>(*n));
  }
}

void FileReader::begin_routine(ir::RoutineName name, std::string title, ir::LineInfo header) {
  end_routine();
  routine_ = ir::Routine{};
  routine_.kind = program_.routines.empty() ? ir::RoutineKind::main : ir::RoutineKind::sub;
  routine_.name = std::move(name);
  if (routine_.name.empty() && routine_.kind == ir::RoutineKind::main) routine_.name = name_of_file(source_->stem());
  routine_.title = std::move(title);
  routine_.header = std::move(header);
  routine_.file = file_;
  builder_ = StructureBuilder(routine_.body);
  open_ = true;
  only_comments_ = true;
  in_var_ = false;
  ended_ = false;
  lower_.start_program(routine_.kind == ir::RoutineKind::main, routine_.name.number);
  lower_.expressions().forget_symbols();
}

/// Blank lines at the end of a program: a block without anything stands for the last of them.
void FileReader::close_blank(const Span& next) {
  if (blank_ == 0) return;
  ir::Statement s;
  s.line.span = {file_, next.line - 1, 1, next.line - 1, 1};
  s.line.blank_lines_before = static_cast<std::uint16_t>(blank_ - 1);
  s.node = ir::Block{};
  blank_ = 0;
  put(std::move(s));
}

void FileReader::end_routine() {
  if (!open_) return;
  if (blank_ != 0) close_blank({file_, source_->last_line() + 1, 1, 0, 0});
  open_ = false;
  for (const Span& s : builder_.finish(source_.get())) {
    diagnostics_.error("NUM-022", s, "the statement that begins here has no end in this program",
                       "add ENDI, ENDW, ENDF or UNTIL");
  }
  for (const auto& use : lower_.expressions().undeclared()) {
    if (lower_.expressions().declared(use.name)) continue;
    diagnostics_.warning(
        "NUM-025", use.span,
        "`" + use.name + "` is not declared in this program (VAR ... ENDV); it must come from the caller");
  }
  check_stack();
  if (settings_.options.missing_range_end == dialects::num::MissingRangeEnd::to_last_lower)
    mend_range_ends(routine_, diagnostics_);
  if (routine_.kind == ir::RoutineKind::main && !ended_ && !only_comments_ && !source_->lines().empty()) {
    Span end{file_, source_->lines().back().number, 1, source_->lines().back().number, 1};
    note_missing_end(end, diagnostics_);
  }
  program_.routines.push_back(std::move(routine_));
}

void FileReader::tape_mark(std::string_view raw) {
  auto& look = program_.files[0];
  if (!open_ || only_comments_)
    look.leader.emplace_back(raw);
  else
    look.trailer += std::string(raw) + "\n";
}

void FileReader::header(const syntax::Statement& s, const Span& span) {
  ir::RoutineName name;
  const double n = s.args.at(0).number;
  name.number = saturate<std::int64_t>(n);
  if (n != static_cast<double>(name.number)) name.text = s.args[0].text;
  if (n < 0 || n > 99999) {
    diagnostics_.error("NUM-036", word_span(span, s.pos), "program numbers go from %1 to %9999", {});
    name.number = 0;
  }
  for (const auto& r : program_.routines) {
    if (r.name == name) {
      diagnostics_.error("NUM-036", word_span(span, s.pos),
                         "a second program %" + s.args[0].text + " in this file; calls reach the first one",
                         "give it another number");
    }
  }
  if (open_ && routine_.name == name) {
    diagnostics_.error("NUM-036", word_span(span, s.pos),
                       "a second program %" + s.args[0].text + " in this file; calls reach the first one",
                       "give it another number");
  }
  // Blank lines and comments before the first header stand before the program.
  if (program_.routines.empty() && (!open_ || only_comments_) && !routine_.header.span.known()) {
    auto& leader = program_.files[0].leader;
    leader.clear();
    for (std::uint32_t row = 1; row < span.line; ++row) leader.emplace_back(source_->line_text(row));
    open_ = false;
    blank_ = 0;
  }
  ir::LineInfo header_line;
  fill_line(syntax_, span, header_line);
  if (open_) close_blank(span);
  std::string title;
  if (!header_line.comments.empty()) {
    title = std::string(trim(header_line.comments.front().text));
    header_line.comments.erase(header_line.comments.begin());
  }
  begin_routine(std::move(name), std::move(title), std::move(header_line));
}

ir::Statement FileReader::with_line() {
  ir::Statement s;
  if (first_) {
    s.line = line_;
  } else {
    s.line.span = line_.span;
    s.line.skip_mask = line_.skip_mask;
    s.line.joined = true;
  }
  first_ = false;
  return s;
}

void FileReader::put(ir::Statement s) {
  builder_.add(std::move(s));
}

void FileReader::opaque(const Span&, std::string_view text, std::string_view feature, bool harmless) {
  ir::Opaque o;
  o.text = std::string(text);
  o.feature = std::string(feature);
  o.harmless = harmless;
  put_node(std::move(o));
}

void FileReader::check_label() {
  if (syntax_.number.empty()) return;
  if (syntax_.number.find_first_not_of("0123456789") != std::string_view::npos) {
    std::string digits;
    for (const char c : syntax_.number) {
      if (c >= '0' && c <= '9') digits += c;
    }
    diagnostics_.warning("NUM-009", word_span(span_, syntax_.number_pos),
                         "blanks inside a number count for nothing; read as N" + digits);
    line_.number = program_.keep(std::move(digits));
  }
  const auto value = parse_decimal(line_.number);
  if (value && *value <= static_cast<double>(facts::label_max)) return;
  diagnostics_.error("NUM-016", word_span(span_, syntax_.number_pos), "block numbers go from N0 to N32767",
                     "renumber the block and its callers");
}

void FileReader::line(const SourceLine& source_line) {
  ++stats_.lines;
  const std::string_view text = without_tape_bytes(source_line.text);
  if ((text.empty() && !source_line.text.empty()) || ends_tape(text)) return tape_mark(source_line.text);
  span_ = line_span(file_, source_line);
  text_ = text;
  if (text_.size() > facts::block_length)
    diagnostics_.note("NUM-039", span_, "the block is longer than the 118 characters of the control");
  ParseError error;
  const bool ok = reader_.read(text_, syntax_, error);
  if (!reader_.difference().empty()) diagnostics_.error("CNC-READERS", span_, reader_.difference());
  const bool blank_line = ok && blank(text_);
  const bool is_block = !ok || !(syntax_.words.empty() && syntax_.statements.empty() && syntax_.number.empty());
  if (is_block) ++stats_.blocks;
  if (reader_.scanned() && is_block) ++stats_.scanner_blocks;
  if (ok && !syntax_.statements.empty() && syntax_.statements[0].keyword == "%") {
    ++stats_.blocks_read;
    if (syntax_.statements[0].args.empty()) return tape_mark(source_line.text);
    return header(syntax_.statements[0], span_);
  }
  if (!open_) begin_routine({}, {}, {});
  first_ = true;
  if (!ok) {
    diagnostics_.error("NUM-001", word_span(span_, error.pos), "the block can't be read: " + error.message, {});
    line_.clear();
    line_.span = span_;
    line_.blank_lines_before = std::exchange(blank_, std::uint16_t{0});
    only_comments_ = false;
    const frontends::BlockStart start = frontends::block_start(text_);  // what jumps there finds it
    line_.number = start.number;
    return opaque(span_, start.number.empty() ? text_ : start.rest, "text.unread", false);
  }
  if (blank_line) {
    if (blank_ == std::numeric_limits<std::uint16_t>::max()) close_blank(span_);
    ++blank_;
    return;
  }
  fill_line(syntax_, span_, line_);
  line_.blank_lines_before = std::exchange(blank_, std::uint16_t{0});
  if (!is_block) return put_node(ir::Block{});
  only_comments_ = false;
  check_label();
  block(span_, text_);
}

}  // namespace cnctrans::frontends::num
