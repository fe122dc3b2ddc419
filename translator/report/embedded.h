// The parts of the HTML pages: page.html, style.css, viewer.js, three.js, overview.js ..., compiled in by the build.
#pragma once

#include "base/embedded.h"

namespace cnctrans::translator {

extern const EmbeddedText report_texts[];
extern const std::size_t report_texts_count;
/// By the name of the file without its ending.
std::string_view report_text(std::string_view name);

}  // namespace cnctrans::translator
