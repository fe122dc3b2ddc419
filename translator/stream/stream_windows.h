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

/// A source as windows of whole lines, without a byte order mark.
struct Windows {
  LineWindowReader reader{window_bytes};
  std::string_view first;

  bool open(const std::string& path, std::string* error) {
    if (!reader.open(path, error)) return false;
    first = reader.next();
    if (first.starts_with("\xEF\xBB\xBF")) first.remove_prefix(3);
    return true;
  }
};

/// Looks through a file, window by window.
frontends::TextLook look_through(const std::string& path);

}  // namespace cnctrans::translator
