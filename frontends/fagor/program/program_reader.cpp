#include "frontends/fagor/program/program_reader.h"

#include <utility>

#include "base/text.h"
#include "dialects/fagor/limits.h"
#include "frontends/common/block_start.h"
#include "frontends/fagor/program/subroutine_ends.h"
#include "frontends/fagor/statements/statement.h"

namespace cnctrans::fagor {

namespace {

/// The statement with its brackets and what follows it, without the comment.
std::string_view statement_text(const syntax::Block& b, std::string_view text) {
  const std::size_t open = text.rfind('(', b.statements.front().pos.column - 1);
  const std::size_t end = b.comments.empty() ? text.size() : b.comments.front().pos.column - 1;
  const std::size_t first = open == std::string_view::npos ? b.statements.front().pos.column - 1 : open;
  return trim(text.substr(first, end - first));
}

bool is_trivia(const syntax::Block& b) {
  return b.words.empty() && b.statements.empty() && b.number.empty();
}

}  // namespace

ProgramReader::ProgramReader(const frontends::ReadOptions& options, FileId file, Diagnostics& diagnostics)
    : file_(file), state_(*options.profile, diagnostics), reader_(options.reader) {
  program_.dialect = "fagor";
  program_.spaces = make_spaces();
  program_.lathe = state_.lathe();
  ir::Routine& main = program_.routines.emplace_back();
  main.kind = ir::RoutineKind::main;
  main.file = file;
}

ir::Program ProgramReader::read(const SourcePtr& source, frontends::ReadStats* stats) {
  program_.texts->hold(source);
  describe_file(*source);
  program_.routines[0].name.text = to_upper_ascii(source->stem());
  for (const SourceLine& l : source->lines()) line(l);
  if (current_ != 0) close_subroutine();
  for (auto& s : pending_) current().body.push_back(std::move(s));
  if (local_group_) {
    state_.error("FAG-032", {}, "the local subroutines are not followed by the line that starts the main part",
                 "write a line that begins with % after the last (RET)");
  }
  if (lost_blocks_ != 0) {
    state_.set_line(first_lost_block_);
    state_.warning("FAG-036", {},
                   "an earlier conversion from another control left " + std::to_string(lost_blocks_) +
                       " comments for blocks that it did not understand; this is the first",
                   "compare with the original program: what stood there is not in this file");
  }
  if (lines_of_main_.empty()) found_lines_of_main_ = lines_of_the_main_part(program_);
  settle_main();
  finish_program(program_, state_);
  program_.unit_hint = state_.facts.units[1] && !state_.facts.units[0] ? ir::Units::inch
                       : state_.facts.units[0]                         ? ir::Units::metric
                                                                       : state_.profile().power_on.units;
  if (stats) *stats = stats_;
  return std::move(program_);
}

std::map<std::uint32_t, ir::Plane> ProgramReader::planes_by_flow() const {
  // The senses of a plane with its axes exchanged are those of the text.
  const bool again = state_.facts.plane_by_flow_differs && !state_.facts.first_turned_plane.known();
  return again ? state_.facts.planes_by_flow : std::map<std::uint32_t, ir::Plane>{};
}

void ProgramReader::describe_file(const SourceText& source) {
  ir::FileLook look;
  look.file = file_;
  look.name = source.name();
  look.encoding = source.encoding();
  look.eol = source.main_eol();
  look.bom = source.has_bom();
  look.final_eol = source.lines().empty() || source.lines().back().has_eol;
  program_.files.push_back(std::move(look));
}

void ProgramReader::line(const SourceLine& source_line) {
  ++stats_.lines;
  state_.set_line(line_span(file_, source_line));
  std::string_view text = without_control(source_line.text);
  if (text.size() != source_line.text.size()) {
    if (!control_noted_) state_.note("FAG-031", {}, "control characters of a tape or a transfer are left out");
    control_noted_ = true;
    program_.files[0].trailer += source_line.text;
    if (text.empty()) return;
  }
  const std::string_view trimmed = trim(text);
  if (!trimmed.empty() && trimmed.front() == '%') {
    percent(trimmed);
  } else {
    block(text);
  }
  if (!trimmed.empty() && trimmed.front() != ';') header_allowed_ = false;
}

/// Header, start mark of the main part, or the mark that ends a tape.
void ProgramReader::percent(std::string_view text) {
  ir::Routine& main = program_.routines[0];
  if (header_allowed_ && !main.header.span.known()) {
    main.header.span = state_.line();
    if (text.size() > 1 && !read_header(text, main.title, main.attributes)) {
      state_.warning("FAG-001", {},
                     "the header is not of the form %comment,MX, with a comment of at most 20 characters",
                     "the control lists such a program with asterisks; attributes are O, H, M and X");
    }
    state_.attributes = main.attributes;
    return;
  }
  if (local_group_) {
    close_subroutine();
    for (auto& s : pending_) current().body.push_back(std::move(s));
    pending_.clear();
    current_ = 0;
    local_group_ = false;
    main.header_text = std::string(text);
    if (!main.header.span.known()) main.header.span = state_.line();
    state_.start_routine(false);
    return;
  }
  if (text.size() == 1) {
    program_.files[0].trailer += text;
    ended_ = true;
    return;
  }
  ++stats_.blocks;
  state_.error("FAG-032", {},
               "a line with % is the file's header or, after local subroutines, the start of the main part");
  ir::Statement s = fresh();
  s.node = ir::Opaque{std::string(text), "text.unread", false};
  add(std::move(s));
}

ir::Statement ProgramReader::fresh() const {
  ir::Statement s;
  fill_line(block_, state_.line(), s.line);
  return s;
}

void ProgramReader::unread(std::string_view text, const ParseError& error) {
  state_.error("FAG-002", error.pos, "the block can't be read: " + error.message,
               "it is kept as text; the program can't run with it");
  ir::Statement s;
  s.line.span = state_.line();
  const frontends::BlockStart start = frontends::block_start(text);  // what jumps there finds it
  s.line.number = start.number;
  s.node = ir::Opaque{std::string(start.number.empty() ? trim(text) : start.rest), "text.unread", false};
  add(std::move(s));
}

void ProgramReader::block(std::string_view text) {
  ParseError error;
  if (!reader_.read(text, block_, error, state_)) {
    ++stats_.blocks;
    unread(text, error);
    return;
  }
  if (is_trivia(block_)) {
    add_trivia();
    return;
  }
  ++stats_.blocks;
  if (current_ != 0 && lines_of_main_.count(state_.line().line) != 0) go_on_with_main();
  if (ended_) {
    state_.error("FAG-032", {}, "the tape mark % stands before this block");
    ended_ = false;
  }
  if (reader_.scanned()) ++stats_.scanner_blocks;
  const std::size_t errors = state_.errors();
  if (!block_.number.empty()) {
    state_.labelled();
    if (block_.number.size() > 8 && block_.number.find_first_not_of('0') + 8 < block_.number.size()) {
      state_.error("FAG-015", block_.number_pos, "a block number has at most 8 digits");
    }
  } else if (!block_.words.empty() && block_.statements.empty() && word_letter(block_.words.front()) == 'N') {
    state_.error("FAG-015", block_.words.front().pos,
                 "a block number is a fixed number; a parameter can't stand for it");
  }
  if (block_.statements.empty()) {
    iso_block(text);
  } else if (const auto& k = block_.statements.front().keyword; k == "SUB" || k == "LSUB") {
    open_subroutine(block_.statements.front());
  } else {
    ir::Statement s = fresh();
    lower_statement(block_, statement_text(block_, text), state_, s);
    add(std::move(s));
  }
  if (state_.errors() == errors) ++stats_.blocks_read;
}

void ProgramReader::iso_block(std::string_view text) {
  ir::Statement s = fresh();
  BlockResult result;
  auto& b = s.node.emplace<ir::Block>();
  lowerer_.lower(block_, b, result);
  if (!result.opaque.empty()) {
    const auto& first = block_.words.front();
    const std::size_t end = block_.comments.empty() ? text.size() : block_.comments.front().pos.column - 1;
    s.node = ir::Opaque{std::string(trim(text.substr(first.pos.column - 1, end - first.pos.column + 1))),
                        std::string(result.opaque), result.harmless};
  } else if (result.call) {
    lower_g_call(block_, *result.call, state_, s);
  } else if (result.end) {
    const std::string_view code = word_text(*result.end);
    if (b.empty()) {
      s.node = ir::End{code, !state_.in_subroutine()};
    } else {
      ir::Statement end;
      end.line.span = state_.line();
      end.line.joined = true;
      end.node = ir::End{code, !state_.in_subroutine()};
      add(std::move(s));
      s = std::move(end);
    }
  }
  add(std::move(s));
}

/// The maker's converter from older controls leaves such a comment for every block that it did not understand (there is
/// no manual section; the programs say so).
void ProgramReader::look_for_lost_blocks() {
  for (const auto& c : block_.comments) {
    if (to_upper_ascii(trim(c.text)).starts_with("BLOQUE CNC8025 INCORRECTO")) {
      if (lost_blocks_++ == 0) first_lost_block_ = state_.line();
    }
  }
}

void ProgramReader::add_trivia() {
  look_for_lost_blocks();
  ir::Statement s = fresh();
  s.node = ir::Block{};
  pending_.push_back(std::move(s));
}

void ProgramReader::add(ir::Statement statement) {
  auto& body = current().body;
  for (auto& p : pending_) body.push_back(std::move(p));
  pending_.clear();
  body.push_back(std::move(statement));
  if (current_ == 0) main_has_code_ = true;
}

/// Comments before the first subroutine of a file without a main part belong to the subroutine.
void ProgramReader::open_subroutine(const syntax::Statement& statement) {
  const bool local = statement.keyword == "LSUB";
  const std::int64_t number = subroutine_number(statement, state_);
  if (current_ != 0) {
    close_subroutine();
  } else if (!lines_of_main_.empty()) {
    main_state_ = state_;
  }
  ir::Body first;
  if (current_ == 0 && !main_has_code_) {
    first = std::move(pending_);
  } else {
    for (auto& p : pending_) current().body.push_back(std::move(p));
  }
  pending_.clear();
  if (number >= 0 && !numbers_.insert({local, number}).second) {
    state_.error("FAG-025", statement.pos,
                 "the subroutine " + std::to_string(number) + " is defined twice in the file");
  }
  if (local && main_has_code_) state_.error("FAG-025", statement.pos, "local subroutines stand before the main part");
  ir::Routine r;
  r.kind = ir::RoutineKind::sub;
  r.locality = local ? ir::Locality::file_local : ir::Locality::global;
  r.name.number = number;
  r.file = file_;
  r.body = std::move(first);
  fill_line(block_, state_.line(), r.header);
  program_.routines.push_back(std::move(r));
  current_ = program_.routines.size() - 1;
  local_group_ = local;
  state_.start_routine(true);
}

/// The subroutine has ended at a (RET) above: this block and what follows it are the main part's, and what its text has
/// said last holds as far as it does behind a label.
void ProgramReader::go_on_with_main() {
  close_subroutine();
  current_ = 0;
  if (main_state_) state_.go_back_to(*main_state_);
}

/// The parts of a subroutine end with (RET). Blocks behind that have a number at their head may be named by a cycle
/// (its profile, 9.2, 25.5): nothing runs into them.
void ProgramReader::close_subroutine() {
  const ir::Routine& r = current();
  bool named = true;  // the first block behind the RET has a number
  for (auto s = r.body.rbegin(); s != r.body.rend(); ++s) {
    const auto* b = std::get_if<ir::Block>(&s->node);
    if (b && b->empty() && s->line.number.empty()) continue;
    if (std::holds_alternative<ir::Return>(s->node)) {
      if (named) return;
      break;
    }
    named = !s->line.number.empty() && r.locality != ir::Locality::file_local;
  }
  const Span now = state_.line();
  state_.set_line(r.header.span);
  state_.error("FAG-025", {}, "the subroutine " + std::to_string(r.name.number) + " does not end with (RET)",
               "blocks after the last (RET) belong to no subroutine, and no jump leads there");
  state_.set_line(now);
}

/// A file of subroutines only has no main routine.
void ProgramReader::settle_main() {
  if (main_has_code_ || program_.routines.size() < 2) return;
  ir::Routine main = std::move(program_.routines.front());
  program_.routines.erase(program_.routines.begin());
  ir::Routine& r = program_.routines.front();
  r.title = main.title;
  r.attributes = main.attributes;
  for (auto& s : main.body) program_.routines.back().body.push_back(std::move(s));
}

}  // namespace cnctrans::fagor
