// What becomes of a construct that the target cannot say, and the statements that every language refuses by default.
#include <utility>

#include "backends/common/comments.h"
#include "backends/common/program_writer.h"
#include "base/text.h"
#include "ir/check/missing_features.h"
#include "ir/source_line.h"

namespace cnctrans::backends {

Span ProgramWriter::span_of(WordPos pos) const {
  if (info_ == nullptr) return {};
  return word_span(info_->span, pos);
}

std::string ProgramWriter::source_line(const Span& span) const {
  return ir::source_line(span, program_);
}

void ProgramWriter::refuse(std::string_view code, WordPos pos, std::string what, std::string hint) {
  const bool first = !refused();
  if (first) {
    refusal_code_ = code;
    refusal_moves_ = true;
  }
  if (options_.unsupported == Unsupported::error) {
    diagnostics_.error(code, span_of(pos), std::move(what), std::move(hint));
  } else {
    diagnostics_.warning(code, span_of(pos), std::move(what) + "; the line is left out", std::move(hint));
  }
}

bool ProgramWriter::part_of_refused(const ir::Statement& s) const {
  const Span& own = s.line.span;
  return refused_block_ && own.known() && own.file == refused_block_->file && own.line == refused_block_->line;
}

/// The remark of the first part has said it; a line of its own is only needed where a label or number stands.
void ProgramWriter::refuse_rest() {
  refusal_code_.clear();
  if (info_->labels.empty() && info_->number.empty()) {
    line_open_ = false;
    line_.clear();
    return;
  }
  refusal_code_ = "TRN-476";
  refusal_moves_ = false;
}

/// The remark stands in place of the line: number and labels stay, so that jumps still find it.
void ProgramWriter::emit_refusal() {
  std::string code = std::exchange(refusal_code_, std::string{});
  if (options_.unsupported != Unsupported::error && refusal_moves_ && info_->span.known()) refused_block_ = info_->span;
  line_.clear();
  std::string source(trim(source_line(info_->span)));
  if (source.empty() && current_ != nullptr) {
    if (const auto* o = std::get_if<ir::Opaque>(&current_->node)) source = std::string(trim(o->text));
  }
  if (refusal_moves_ && info_->span.known() && !files_.empty()) files_.back().left_out.push_back(info_->span);
  if (options_.draft) {
    const auto item = options_.to_do.find({info_->span.file, info_->span.line});
    const bool known = item != options_.to_do.end();
    if (known) code = "TO DO " + std::to_string(item->second.number) + ':';
    stop_before(refusal_moves_ && (!known || item->second.stop));
  }
  std::string text = line_head(true);
  refusal_code_.clear();
  CommentStyle remark = style_.comment;
  remark.blank_after_open = false;
  const std::size_t comments = text.size();
  text += comment("!! " + code + ' ' + source, remark, false, nullptr);
  emit_remark(text, comments, info_->span);
  if (options_.unsupported == Unsupported::comment && refusal_moves_ && !options_.draft) {
    first_of_source_line_ = false;
    emit(line_head(true) + m_word(0), info_->span);
  }
}

/// The machine stops before the first line of a run that is left out, and where a jump leads into it.
void ProgramWriter::stop_before(bool wanted) {
  if (!wanted || (stopped_ && !is_join(*info_))) return;
  emit(line_head(true) + m_word(0), info_->span);
  first_of_source_line_ = false;
  stopped_ = true;
}

void ProgramWriter::remark_line(const ir::LineInfo& info) {
  if (info.joined || !info.span.known()) return;
  CommentStyle remark = style_.comment;
  remark.blank_after_open = false;
  const std::string source(trim(source_line(info.span)));
  finish_line();
  emit_remark(comment("!! " + source, remark, false, nullptr), 0, info.span);
}

void ProgramWriter::remark_body(const ir::Body& statements) {
  for (const ir::Statement& s : statements) {
    remark_line(s.line);
    if (const auto* i = std::get_if<ir::If>(&s.node)) {
      remark_body(i->then_body);
      remark_line(i->else_line);
      remark_body(i->else_body);
      remark_line(i->end_line);
    } else if (const auto* w = std::get_if<ir::While>(&s.node)) {
      remark_body(w->body);
      remark_line(w->end_line);
    } else if (const auto* u = std::get_if<ir::Until>(&s.node)) {
      remark_body(u->body);
      remark_line(u->end_line);
    } else if (const auto* f = std::get_if<ir::For>(&s.node)) {
      remark_body(f->body);
      remark_line(f->end_line);
    } else if (const auto* l = std::get_if<ir::Loop>(&s.node)) {
      remark_body(l->body);
      remark_line(l->end_line);
    }
  }
}

void ProgramWriter::unread_structure(const ir::Statement& s, const ir::Opaque& text) {
  refuse("TRN-205", {}, "'" + text.text + "' is not translated, and nothing of what it encloses");
  current_ = &s;
  refuse_structure({});
}

void ProgramWriter::opaque(const ir::Opaque& o) {
  if (same_dialect()) {
    add(std::string(trim(o.text)), Rank::head);
    return;
  }
  const bool told = o.feature == "text.unread";
  if (o.harmless && (o.feature.empty() || told)) return;  // says nothing to another control
  if (o.harmless) {
    diagnostics_.note("TRN-205", current_->line.span,
                      "'" + o.text + "' has no counterpart and no effect on the part; it is kept as a remark");
    refusal_code_ = "TRN-205";
    refusal_moves_ = false;
    return;
  }
  std::string source(trim(source_line(current_->line.span)));
  if (const auto* f = ir::find_missing_feature(o.feature); f != nullptr && f->of_one_machine) {
    diagnostics_.warning("TRN-220", current_->line.span,
                         "'" + o.text + "' is left out: " + std::string(f->title) + " stay with the machine",
                         "see that the target's machine has its own");
    refusal_code_ = "TRN-220";
    refusal_moves_ = false;
    return;
  }
  refuse("TRN-205", {}, "'" + (source.empty() ? o.text : source) + "' is not translated",
         std::string(ir::not_translated_hint(o.feature)));
}

/// The structured statement being written, with all that it encloses. Without a text it is refused already.
void ProgramWriter::refuse_structure(std::string what) {
  const ir::Statement& whole = *current_;
  if (!what.empty()) refuse("TRN-201", {}, std::move(what));
  finish_line();
  ir::Body remarks{whole};
  remarks.front().line.joined = true;
  remark_body(remarks);
}

void ProgramWriter::label() {}

namespace {
constexpr std::string_view no_statement = "TRN-201";
}

void ProgramWriter::assign(const ir::Assign& /*a*/) {
  refuse(no_statement, {}, "an assignment has no counterpart here");
}
void ProgramWriter::if_else(const ir::If& /*i*/) {
  refuse_structure("IF has no counterpart here");
}
void ProgramWriter::while_loop(const ir::While& /*w*/) {
  refuse_structure("a WHILE loop has no counterpart here");
}
void ProgramWriter::until_loop(const ir::Until& /*u*/) {
  refuse_structure("an UNTIL loop has no counterpart here");
}
void ProgramWriter::for_loop(const ir::For& /*f*/) {
  refuse_structure("a FOR loop has no counterpart here");
}
void ProgramWriter::endless_loop(const ir::Loop& /*l*/) {
  refuse_structure("an endless loop has no counterpart here");
}
void ProgramWriter::exit_loop() {
  refuse(no_statement, {}, "leaving a loop has no counterpart here");
}
void ProgramWriter::jump(const ir::Jump& /*j*/) {
  refuse(no_statement, {}, "a jump has no counterpart here");
}
void ProgramWriter::switch_jump(const ir::Switch& /*s*/) {
  refuse(no_statement, {}, "a choice of jumps by a value has no counterpart here");
}
void ProgramWriter::repeat(const ir::Repeat& /*r*/) {
  refuse(no_statement, {}, "the repetition of a range of blocks has no counterpart here");
}
void ProgramWriter::call(const ir::CallRoutine& /*c*/) {
  refuse(no_statement, {}, "this call has no counterpart here");
}
void ProgramWriter::modal_call(const ir::ModalCall& /*c*/) {
  refuse(no_statement, {}, "a modal call has no counterpart here");
}
void ProgramWriter::return_from(const ir::Return& /*r*/) {
  refuse(no_statement, {}, "this return has no counterpart here");
}
void ProgramWriter::end_program(const ir::End& /*e*/) {
  refuse(no_statement, {}, "this end has no counterpart here");
}
void ProgramWriter::message(const ir::Message& /*m*/) {
  refuse(no_statement, {}, "this message has no counterpart here");
}
void ProgramWriter::file_statement(const ir::Message& /*m*/, const ir::FileStatement& /*f*/) {
  refuse("TRN-570", {}, "a line for a file of the control is not translated", "take it out, or show it as a message");
}
void ProgramWriter::declare(const ir::Declare& /*d*/) {
  refuse(no_statement, {}, "a definition of variables has no counterpart here");
}

}  // namespace cnctrans::backends
