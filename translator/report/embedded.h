// The parts of the HTML report: page.html, style.css, viewer.js and three.js, compiled in by the build.
#pragma once

#include "base/embedded.h"

namespace cnctrans::translator {

extern const EmbeddedText report_texts[];
extern const std::size_t report_texts_count;

}  // namespace cnctrans::translator
