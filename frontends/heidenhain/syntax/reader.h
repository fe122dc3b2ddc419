// One line -> syntax::Block: the word scanner for path functions, the grammar for the rest (or for all, or both
// compared).
#pragma once

#include <string>
#include <string_view>

#include "frontends/common/frontend.h"
#include "frontends/heidenhain/syntax/parse.h"

namespace cnctrans::frontends::heidenhain {

class LineReader {
 public:
  explicit LineReader(Reader reader) : reader_(reader) {}

  /// False: the line is no block of this language; `error` says why. Views in `out` point into `line`.
  bool read(std::string_view line, syntax::Block& out, ParseError& error);

  /// With Reader::both: how scanner and grammar differed in the last line; empty when they agree.
  [[nodiscard]] const std::string& difference() const { return difference_; }
  [[nodiscard]] bool scanned() const { return scanned_; }  ///< the last line was taken by the scanner

 private:
  void compare(std::string_view line, const syntax::Block& scanned);

  Reader reader_;
  bool scanned_ = false;
  BlockParser parser_;
  std::string difference_;
};

}  // namespace cnctrans::frontends::heidenhain
