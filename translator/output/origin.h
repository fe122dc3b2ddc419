// Where a translation comes from, as a remark at its head.
#pragma once

#include <string>

#include "ir/program.h"
#include "translator/pipeline.h"

namespace cnctrans::translator {

/// "translated from PART.PIM, Fagor 8055"; empty: nobody asked for it, or the program stays in its language. `path` of
/// the source may be empty: a text without a name.
std::string origin_text(const TranslateOptions& options, const std::string& path);
/// Below the remarks that the program has at its own head. Empty text: nothing.
void put_origin(ir::Program& program, const std::string& text);

}  // namespace cnctrans::translator
