// The map of names on disk (--names): JSON, read before a translation and written after it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "legaliser/name_map.h"

namespace cnctrans::translator {

/// The map in the text of a names file for translations from `from` to `to` (dialect names). nullopt, with a reason in
/// `*error`: it is no such file, or one for another direction.
std::optional<ir::NameMap> parse_names(std::string_view text, std::string_view from, std::string_view to,
                                       std::string* error);
/// The map in a file; the reason in `*error` begins with its path.
std::optional<ir::NameMap> read_names(const std::string& path, std::string_view from, std::string_view to,
                                      std::string* error);
/// The same text for the same map, whatever order it came about in.
std::string names_text(const ir::NameMap& names, std::string_view from, std::string_view to);
/// What `more` has in addition; an entry of `names` stays as it is.
void add_names(ir::NameMap& names, const ir::NameMap& more);

}  // namespace cnctrans::translator
