// The word scanner of path functions: `12 L X+10 IY-5 R0 FMAX M3 ;text` at the speed of text. Everything else is left
// to the grammar, which is the definition.
#pragma once

#include <string_view>

#include "frontends/common/syntax.h"

namespace cnctrans::frontends::heidenhain {

/// Reads a line that is made of words, or empty, or a comment. False: not such a line, `out` is undefined, use the
/// grammar. Never reports anything.
bool scan_path(std::string_view line, syntax::Block& out);

}  // namespace cnctrans::frontends::heidenhain
