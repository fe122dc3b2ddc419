#include "frontends/fagor/syntax/line_reader.h"

#include "base/text.h"
#include "dialects/fagor/limits.h"
#include "frontends/fagor/syntax/scan_table.h"

namespace cnctrans::fagor {

namespace {

constexpr bool is_control(char c) {
  return c == '\0' || c == '\x03' || c == '\x04' || c == '\x1a' || c == '\x1b';
}
/// The scanner takes any digit as a skip level; the control has three.
bool known_skip_levels(const syntax::Block& b) {
  return b.skip_mask < (1U << dialects::fagor::max_skip_levels);
}

}  // namespace

bool LineReader::read(std::string_view line, syntax::Block& block, ParseError& error, LowerState& state) {
  scanned_ =
      mode_ != frontends::Reader::antlr && frontends::scan_plain(line, scan_table, block) && known_skip_levels(block);
  if (scanned_ && mode_ == frontends::Reader::scanner) return true;
  if (!parser_) parser_ = std::make_unique<BlockParser>();
  if (!scanned_) return parser_->parse_block(line, block, error);
  const bool parsed = parser_->parse_block(line, other_, error);
  if (!parsed || !(other_ == block)) {
    state.error("CNC-READERS", {}, "the word scanner and the grammar read this block differently",
                "scanner:\n" + syntax::dump(block) + "grammar:\n" + (parsed ? syntax::dump(other_) : error.message));
  }
  return true;
}

std::string_view without_control(std::string_view line) {
  while (!line.empty() && is_control(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_control(line.back())) line.remove_suffix(1);
  return line;
}

Span line_span(FileId file, const SourceLine& line) {
  return {file, line.number, 1, line.number, static_cast<std::uint32_t>(line.text.size()) + 1};
}

void fill_line(const syntax::Block& block, const Span& span, ir::LineInfo& line) {
  line.clear();
  line.span = span;
  line.number = block.number;
  line.skip_mask = block.skip_mask;
  const bool alone = block.words.empty() && block.statements.empty() && block.number.empty();
  for (const auto& c : block.comments) {
    line.comments.push_back({c.text, alone ? ir::CommentPlace::own_line : ir::CommentPlace::end_of_line, c.pos});
  }
}

bool read_header(std::string_view line, std::string& title, std::string& attributes) {
  line.remove_prefix(1);
  const std::size_t first = line.find(',');
  title = std::string(trim(line.substr(0, first)));
  attributes.clear();
  if (first == std::string_view::npos) return false;
  std::string_view rest = trim(line.substr(first + 1));
  const std::size_t second = rest.find(',');
  const bool closed = second != std::string_view::npos && trim(rest.substr(second + 1)).empty();
  attributes = std::string(trim(rest.substr(0, second)));
  const bool known = attributes.find_first_not_of("OHMXohmx- ") == std::string::npos;
  return closed && known && first <= static_cast<std::size_t>(dialects::fagor::max_header_comment);
}

}  // namespace cnctrans::fagor
