#include "frontends/sinumerik/syntax/line_reader.h"

#include "frontends/common/word_scanner.h"
#include "frontends/sinumerik/syntax/scan_table.h"

namespace cnctrans::sinumerik {

BlockParser& LineReader::parser() {
  if (!parser_) parser_.emplace();
  return *parser_;
}

LineReader::Result LineReader::read(std::string_view line, syntax::Block& out) {
  scanned_ = false;
  difference_.clear();
  if (reader_ != frontends::Reader::antlr && frontends::scan_plain(line, scan_table, out)) {
    scanned_ = true;
    if (reader_ == frontends::Reader::both) {
      const bool parsed = parser().parse_block(line, other_, error_);
      if (!parsed) {
        difference_ = "the grammar does not read it: " + error_.message;
      } else if (!(out == other_)) {
        difference_ = "scanner:\n" + syntax::dump(out) + "grammar:\n" + syntax::dump(other_);
      }
    }
    return Result::plain;
  }
  if (!parser().parse_block(line, out, error_)) return Result::unread;
  return out.plain ? Result::plain : Result::parsed;
}

void fill_line_info(const syntax::Block& block, const Span& span, ir::LineInfo& out) {
  out.clear();
  out.span = span;
  out.number = block.number;
  out.number_mark = block.number_mark;
  for (const auto& l : block.labels) out.labels.push_back(l);
  out.skip_mask = block.skip_mask;
  const bool alone = block.words.empty() && block.statements.empty() && block.number.empty() && block.labels.empty();
  for (const auto& c : block.comments) {
    out.comments.push_back(
        ir::CommentText{c.text, alone ? ir::CommentPlace::own_line : ir::CommentPlace::end_of_line, c.pos});
  }
}

}  // namespace cnctrans::sinumerik
