#include "frontends/heidenhain/syntax/reader.h"

#include "frontends/heidenhain/syntax/scanner.h"

namespace cnctrans::frontends::heidenhain {

void LineReader::compare(std::string_view line, const syntax::Block& scanned) {
  syntax::Block by_grammar;
  ParseError error;
  if (!parser_.parse(line, by_grammar, error)) {
    difference_ = "the scanner reads the block, the grammar does not: " + error.message;
  } else if (!(by_grammar == scanned)) {
    difference_ = "scanner:\n" + syntax::dump(scanned) + "grammar:\n" + syntax::dump(by_grammar);
  }
}

bool LineReader::read(std::string_view line, syntax::Block& out, ParseError& error) {
  difference_.clear();
  scanned_ = reader_ != Reader::antlr && scan_path(line, out);
  if (scanned_) {
    if (reader_ == Reader::both && line.size() <= longest_block) compare(line, out);
    return true;
  }
  return parser_.parse(line, out, error);
}

}  // namespace cnctrans::frontends::heidenhain
