// Text files that the build compiles in (cnc_embed_texts).
#pragma once

#include <cstddef>
#include <string_view>

namespace cnctrans {

struct EmbeddedText {
  std::string_view name;  ///< file name without extension
  std::string_view text;
};

}  // namespace cnctrans
