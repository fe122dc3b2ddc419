#include "backends/common/program_writer.h"

#include <algorithm>

#include "backends/common/comments.h"
#include "base/text.h"

namespace cnctrans::backends {
namespace {

/// A cycle before which the writer may put a rapid to its retract plane.
bool wants_approach(const ir::Action& a) {
  const auto* d = std::get_if<ir::CycleDefine>(&a.data);
  const auto* hole = d != nullptr && d->cycle ? std::get_if<ir::HoleCycle>(&d->cycle->node) : nullptr;
  return hole != nullptr && hole->retract.given;
}

bool has_one_shots(const ir::Program& program, const Style& style) {
  const bool approaches = style.approaches_cycles && program.dialect != style.dialect;
  bool found = false;
  for (const ir::Routine& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      found = found || (b != nullptr && b->has_motion &&
                        (!b->motion.keeps_modal || (style.code_waits_for_move && is_code_alone(b->motion))));
      found =
          found || (approaches && b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), wants_approach));
    });
  }
  return found;
}

bool has_ids(const ir::Program& program) {
  for (const ir::Routine& r : program.routines) {
    if (!r.body.empty()) return r.body.front().id != 0;
  }
  return true;
}

const ir::Opaque* opaque_at(const ir::Statement* s, const Span& line) {
  if (s == nullptr || !line.known() || s->line.span.line != line.line) return nullptr;
  return std::get_if<ir::Opaque>(&s->node);
}

/// A reader that can't read the condition of a structure keeps its text beside it: as the first statement of the body,
/// or behind the structure when the condition closes it.
const ir::Opaque* unread_part(const ir::Statement& s, const ir::Statement* after) {
  const ir::Body* body = nullptr;
  if (const auto* i = std::get_if<ir::If>(&s.node)) body = &i->then_body;
  if (const auto* w = std::get_if<ir::While>(&s.node)) body = &w->body;
  if (const auto* f = std::get_if<ir::For>(&s.node)) body = &f->body;
  if (body != nullptr) return body->empty() ? nullptr : opaque_at(&body->front(), s.line.span);
  const auto* u = std::get_if<ir::Until>(&s.node);
  return u != nullptr ? opaque_at(after, u->end_line.span) : nullptr;
}

}  // namespace

ProgramWriter::ProgramWriter(const ir::Program& program, const WriteOptions& options, const Style& style,
                             Diagnostics& diagnostics)
    : numbered_(has_ids(program) ? ir::Program{} : program),
      program_(has_ids(program) ? program : numbered_),
      options_(options),
      style_(style),
      diagnostics_(diagnostics),
      same_dialect_(program.dialect == style.dialect),
      labels_(program),
      tracker_(has_one_shots(program, style)) {
  if (&program_ == &numbered_) ir::number_statements(numbered_);
}

std::vector<OutputFile> ProgramWriter::write() {
  if (options_.numbering == Numbering::renumber && !labels_.renumberable()) {
    diagnostics_.note("TRN-212", {}, "the block numbers are kept: " + labels_.why_not());
  }
  write_program();
  finish_line();
  resolve_numbers();
  return std::move(files_);
}

void ProgramWriter::resolve_numbers() {
  if (options_.numbering != Numbering::renumber) return;
  for (OutputFile& f : files_) renumbering_.resolve(f.text);
}

// ---- files and lines -----------------------------------------------------------------------------------------------

std::string ProgramWriter::free_stem(const std::string& stem, std::string_view extension) {
  std::string name = stem;
  for (int n = 2; options_.is_taken(name + std::string(extension)); ++n) name = stem + '_' + std::to_string(n);
  if (name != stem) note_taken(stem + std::string(extension), name + std::string(extension));
  return name;
}

void ProgramWriter::note_taken(const std::string& name, const std::string& instead) {
  diagnostics_.note("TRN-219", {},
                    "the name " + name + " is taken by another program of this job; this one is called " + instead);
}

void ProgramWriter::open_file(std::string name, bool main, std::string program) {
  finish_line();
  OutputFile file;
  file.name = std::move(name);
  file.program = std::move(program);
  file.main = main;
  files_.push_back(std::move(file));
  next_number_ = 0;
}

void ProgramWriter::emit(std::string_view text, const Span& span) {
  if (files_.empty()) open_file("", true);
  OutputFile& f = files_.back();
  f.text += text;
  f.text += '\n';
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  f.map.lines.insert(f.map.lines.end(), static_cast<std::size_t>(lines), span);
}

void ProgramWriter::emit_remark(std::string_view text, std::size_t comments, const Span& span) {
  emit(wrapped(text, comments, style_.comment, same_dialect_ ? 0 : style_.line_length), span);
}

void ProgramWriter::raw_line(std::string_view text, const Span& span) {
  finish_line();
  emit(text, span);
}

void ProgramWriter::raw_line_in_branch(std::string_view text, const Span& span) {
  finish_line();
  emit(skip_marks(branch_) + std::string(text), span);
}

void ProgramWriter::start_routine(std::size_t index) {
  finish_line();
  routine_ = index;
  depth_ = 0;
  tracker_.start_routine();
  if (style_.code_waits_for_move) tracker_.join();  // the caller may have left one waiting
  branch_ = 0;
  settings_.fill(std::nullopt);
}

void ProgramWriter::begin_line(const ir::LineInfo& info) {
  finish_line();
  info_ = &info;
  line_open_ = true;
  first_of_source_line_ = true;
  blank_line_ = is_blank_line();
  if (is_join(info)) {
    tracker_.join();
    settings_.fill(std::nullopt);
  }
}

bool ProgramWriter::is_join(const ir::LineInfo& info) const {
  if (std::any_of(info.labels.begin(), info.labels.end(), [](std::string_view l) { return !l.empty(); })) return true;
  return !info.number.empty() && labels_.is_target(routine_, info.number);
}

void ProgramWriter::keyword_line(const ir::LineInfo& info, std::string_view keyword) {
  begin_line(info);
  add(std::string(keyword), Rank::head);
  finish_line();
}

std::string ProgramWriter::label_text(const ir::LineInfo& /*info*/) {
  return {};
}

std::string ProgramWriter::skip_marks(std::uint16_t mask) {
  std::string marks;
  for (std::size_t level = 0; level < 16; ++level) {
    if ((mask >> level & 1U) == 0) continue;
    if (level >= style_.skip_marks.size()) {
      refuse("TRN-201", {}, "block skip level " + std::to_string(level) + " does not exist on the target control");
      continue;
    }
    marks += style_.skip_marks[level];
  }
  if (!marks.empty() && marks.back() != '/') marks += ' ';
  return marks;
}

/// Lines under one skip mark right behind each other are a branch: behind them only what holds with them and without
/// them is known.
void ProgramWriter::follow_branch(const ir::LineInfo& line) {
  if (line.skip_mask == branch_) return;
  if (branch_ != 0) {
    tracker_.merge(before_branch_);
    settings_.fill(std::nullopt);
  }
  branch_ = line.skip_mask;
  before_branch_ = tracker_;
}

/// Skip mark, block number, indentation and labels of the first target line of a source line.
std::string ProgramWriter::line_head(bool numbered) {
  if (style_.label_blocks) {
    std::string head = first_of_source_line_ ? label_text(*info_) : std::string{};
    head += skip_marks(info_->skip_mask);
    return head.append(depth_ * style_.indent, ' ');
  }
  std::string head = skip_marks(info_->skip_mask);
  const bool renumber = options_.numbering == Numbering::renumber && labels_.renumberable();
  if (renumber && numbered) {
    next_number_ += options_.number_step;
    if (first_of_source_line_ && !info_->number.empty()) renumbering_.set(routine_, info_->number, next_number_);
    head += 'N' + std::to_string(next_number_) + ' ';
  } else if (!renumber && first_of_source_line_ && !info_->number.empty()) {
    const bool wanted = options_.numbering != Numbering::none || labels_.must_stay(routine_, info_->number);
    if (wanted) {
      head += same_dialect_ ? info_->number_mark : 'N';
      head += info_->number;
      head += ' ';
    }
  }
  head.append(depth_ * style_.indent, ' ');
  if (first_of_source_line_) head += label_text(*info_);
  return head;
}

namespace {

std::string remark_of(const ir::CommentText& c, const CommentStyle& style, bool own, const Span& line,
                      Diagnostics& diagnostics) {
  bool lossy = false;
  std::string out = comment(c.text, style, own, &lossy);
  if (lossy) note_lossy_comment(word_span(line, c.pos), diagnostics);
  return out;
}

}  // namespace

std::string ProgramWriter::line_comments() {
  std::string out;
  if (!first_of_source_line_) return out;
  for (const ir::CommentText& c : info_->comments) {
    if (!out.empty()) out += ' ';
    out += remark_of(c, style_.comment, same_dialect_, info_->span, diagnostics_);
  }
  return out;
}

void ProgramWriter::emit_comments_before() {
  for (const ir::CommentText& c : info_->comments) {
    emit_remark(remark_of(c, style_.comment, same_dialect_, info_->span, diagnostics_), 0, info_->span);
  }
}

void ProgramWriter::next_line() {
  if (line_open_ && !line_.empty()) rest_of_line();
}

void ProgramWriter::rest_of_line() {
  const ir::LineInfo* info = info_;
  finish_line();
  info_ = info;
  line_open_ = true;
  first_of_source_line_ = false;
}

void ProgramWriter::label_line() {
  if (line_open_ && first_of_source_line_ && line_.empty() && !info_->labels.empty()) rest_of_line();
}

void ProgramWriter::finish_line() {
  if (!line_open_) return;
  line_open_ = false;
  if (first_of_source_line_) {
    for (std::uint16_t i = 0; style_.blank_lines && i < info_->blank_lines_before; ++i) emit(style_.blank_line, {});
  }
  if (refused()) return emit_refusal();
  const std::string words = line_.text(style_.order_by_rank);
  line_.clear();
  const bool several = words.find('\n') != std::string::npos;
  const bool before =
      (style_.comment.line_before || several) && !words.empty() && !same_dialect_ && first_of_source_line_;
  if (before) emit_comments_before();
  const std::string remarks = before ? std::string{} : line_comments();
  const bool target = first_of_source_line_ && !info_->number.empty() && labels_.is_target(routine_, info_->number);
  std::string text = line_head(target || (!words.empty() && words != style_.blank_line));
  if (refused()) return emit_refusal();
  const bool only_head = words.empty() && remarks.empty();
  const bool bare_mark = only_head && !same_dialect_ && text == skip_marks(info_->skip_mask);
  if (bare_mark || (only_head && trim(text).empty())) {
    if (blank_line_ && first_of_source_line_ && style_.blank_lines) emit(style_.blank_line, info_->span);
    return;
  }
  if (!words.empty() && words != style_.blank_line) stopped_ = false;
  text += words;
  while (!text.empty() && (text.back() == ' ' || text.back() == '\n')) text.pop_back();
  if (only_head) {
    if (!style_.only_label.empty()) text += ' ' + std::string(style_.only_label);
  } else if (!remarks.empty()) {
    if (!text.empty()) text.append(words.empty() ? 1 : style_.comment.gap, ' ');
    text += remarks;
  }
  annotate();
  emit_remark(text, text.size() - remarks.size(), info_->span);
}

/// An empty block is an empty line of the source; elsewhere nothing was said because nothing had to be.
bool ProgramWriter::is_blank_line() const {
  const auto* b = current_ != nullptr && info_ == &current_->line ? std::get_if<ir::Block>(&current_->node) : nullptr;
  return b != nullptr && b->empty() && !info_->joined;
}

void ProgramWriter::annotate() {
  if (!options_.annotate || !info_->span.known() || annotated_ == info_->span) return;
  annotated_ = info_->span;
  const std::string source(trim(source_line(info_->span)));
  if (source.empty()) return;
  CommentStyle foreign = style_.comment;
  foreign.blank_after_open = false;
  emit_remark(comment("< " + source, foreign, false, nullptr), 0, info_->span);
}

// ---- bodies --------------------------------------------------------------------------------------------------------

void ProgramWriter::body(const ir::Body& statements) {
  for (std::size_t i = 0; i < statements.size(); ++i) {
    const ir::Statement* before = i == 0 ? nullptr : &statements[i - 1];
    const ir::Statement* after = i + 1 == statements.size() ? nullptr : &statements[i + 1];
    statement(statements[i], before, after);
  }
}

void ProgramWriter::nested_body(const ir::Body& statements) {
  finish_line();
  ++depth_;
  tracker_.join();
  settings_.fill(std::nullopt);
  body(statements);
  finish_line();
  tracker_.join();
  settings_.fill(std::nullopt);
  --depth_;
}

void ProgramWriter::statement(const ir::Statement& s, const ir::Statement* before, const ir::Statement* after) {
  if (!s.line.joined) {
    before_statement(s);
    follow_branch(s.line);
  }
  current_ = &s;
  if (s.line.joined && before != nullptr && line_open_ && !refused()) {
    if (!joins(*before, s)) {
      next_line();
      before_statement(s);
      if (!line_open_) rest_of_line();
    }
  } else if (!(s.line.joined && line_open_ && refused())) {
    begin_line(s.line);
  }
  if (const ir::Opaque* text = unread_part(s, after)) return unread_structure(s, *text);
  if (part_of_refused(s)) return refuse_rest();
  if (s.line.span.known()) refused_block_.reset();
  dispatch(s);
}

bool ProgramWriter::joins(const ir::Statement& /*before*/, const ir::Statement& next) {
  if (same_dialect_) return true;
  return std::holds_alternative<ir::End>(next.node) || std::holds_alternative<ir::Block>(next.node);
}

void ProgramWriter::dispatch(const ir::Statement& s) {
  struct Visitor {
    ProgramWriter& w;
    void operator()(const ir::Block& n) const { w.block(n); }
    void operator()(const ir::Assign& n) const { w.assign(n); }
    void operator()(const ir::If& n) const { w.if_else(n); }
    void operator()(const ir::While& n) const { w.while_loop(n); }
    void operator()(const ir::Until& n) const { w.until_loop(n); }
    void operator()(const ir::For& n) const { w.for_loop(n); }
    void operator()(const ir::Loop& n) const { w.endless_loop(n); }
    void operator()(const ir::Exit& /*n*/) const { w.exit_loop(); }
    void operator()(const ir::Jump& n) const { w.jump(n); }
    void operator()(const ir::Switch& n) const { w.switch_jump(n); }
    void operator()(const ir::Repeat& n) const { w.repeat(n); }
    void operator()(const ir::CallRoutine& n) const { w.call(n); }
    void operator()(const ir::ModalCall& n) const { w.modal_call(n); }
    void operator()(const ir::Return& n) const { w.return_from(n); }
    void operator()(const ir::End& n) const { w.end_program(n); }
    void operator()(const ir::Message& n) const {
      if (const auto file = w.same_dialect() ? std::nullopt : ir::file_statement(n)) return w.file_statement(n, *file);
      w.message(n);
    }
    void operator()(const ir::Declare& n) const { w.declare(n); }
    void operator()(const ir::Label& /*n*/) const { w.label(); }
    void operator()(const ir::Opaque& n) const { w.opaque(n); }
  };
  std::visit(Visitor{*this}, s.node);
  const bool leaves = std::holds_alternative<ir::CallRoutine>(s.node) || std::holds_alternative<ir::Repeat>(s.node);
  if (leaves) {
    tracker_.join();
    settings_.fill(std::nullopt);
  }
}

std::string ProgramWriter::number_target(std::size_t routine, const ir::LabelRef& label) {
  if (label.computed || !label.is_number)
    refuse("TRN-660", {}, "a label that is no block number of the program that is called, or that only the run knows");
  if (options_.numbering == Numbering::renumber && labels_.renumberable()) {
    return 'N' + Renumbering::mark(routine, label.text);
  }
  return 'N' + label.text;
}

// ---- what is known -------------------------------------------------------------------------------------------------

const ir::Facts* ProgramWriter::facts() {
  return current_ != nullptr ? facts_before(*current_) : nullptr;
}

const ir::Facts* ProgramWriter::facts_before(const ir::Statement& s) {
  if (s.id == 0) return nullptr;
  if (!facts_) {
    facts_ = ir::analyse(program_, options_.profile->power_on, options_.uncalled);
  }
  return &facts_->before(s.id);
}

std::optional<std::uint8_t> ProgramWriter::setting(ir::Setting s) {
  auto& known = settings_[static_cast<std::size_t>(s)];
  if (!known) {
    if (const ir::Facts* f = facts()) known = f->settings[static_cast<std::size_t>(s)];
  }
  return known;
}

void ProgramWriter::note_setting(ir::Setting s, std::uint8_t value) {
  settings_[static_cast<std::size_t>(s)] = value;
}

}  // namespace cnctrans::backends
