#include "frontends/num/syntax/reader.h"

#include "frontends/common/word_scanner.h"
#include "frontends/num/syntax/scan_table.h"

namespace cnctrans::frontends::num {

bool BlockReader::scan(std::string_view line, syntax::Block& out) const {
  if (!scan_plain(line, scan_table, out)) return false;
  // `VAR`, `CUT` look like words without values: keywords at the start of a block are the grammar's.
  return !structured_ || out.words.empty() || out.words.front().has_value || !begins_with_keyword(line);
}

void BlockReader::compare(std::string_view line, const syntax::Block& scanned) {
  syntax::Block by_grammar;
  ParseError error;
  if (!parser_.parse(line, by_grammar, error)) {
    difference_ = "the scanner reads the block, the grammar does not: " + error.message;
  } else if (!(by_grammar == scanned)) {
    difference_ = "scanner:\n" + syntax::dump(scanned) + "grammar:\n" + syntax::dump(by_grammar);
  }
}

bool BlockReader::read(std::string_view line, syntax::Block& out, ParseError& error) {
  difference_.clear();
  scanned_ = reader_ != Reader::antlr && scan(line, out);
  if (scanned_) {
    if (reader_ == Reader::both && line.size() <= longest_block) compare(line, out);
    return true;
  }
  return parser_.parse(line, out, error);
}

}  // namespace cnctrans::frontends::num
