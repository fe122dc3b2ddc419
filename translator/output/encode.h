// The last step of writing: character set and line ends.
#pragma once

#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "base/source.h"

namespace cnctrans::translator {

/// `text` has LF line ends and either valid UTF-8 or, where comments were copied from a Windows-1252 source, single
/// bytes of it. Characters that the encoding lacks become '?' with a warning TRN-091.
/// `bom`: a mark of UTF-8 before the text, for a file that stays in its language and had one; no control wants it.
std::string encode_output(std::string_view text, Encoding encoding, Eol eol, bool bom, Diagnostics& diagnostics);

}  // namespace cnctrans::translator
