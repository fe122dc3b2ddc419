// A file as windows of whole lines.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/text.h"
#include "frontends/common/frontend.h"
#include "translator/pipeline.h"

namespace cnctrans::translator {

constexpr std::size_t window_bytes = 1U << 20U;

/// A source as windows of whole lines; the first window also tells encoding and line ends.
struct Windows {
  LineWindowReader reader{window_bytes};
  std::string_view first;
  Encoding encoding = Encoding::utf8;
  Eol eol = Eol::lf;

  bool open(const std::string& path, std::string* error) {
    if (!reader.open(path, error)) return false;
    first = reader.next();
    if (first.starts_with("\xEF\xBB\xBF")) first.remove_prefix(3);
    encoding = valid_utf8(first) ? Encoding::utf8 : Encoding::windows1252;
    std::string_view look = first;
    SourceLine line;
    if (take_line(look, line) && line.has_eol) eol = line.eol;
    return true;
  }
};

/// Looks through a file, window by window.
frontends::TextLook look_through(const std::string& path);

}  // namespace cnctrans::translator
