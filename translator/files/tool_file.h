// Tools out of a file of the shop (--tools): a CSV or JSON list, or the tables of a control as it saves them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/profile.h"

namespace cnctrans::translator {

struct ToolFile {
  std::vector<machine::Tool> tools;  ///< by number; one of each
  std::string form;                  ///< "CSV", "JSON", "$TC_DP data", "offset table"
};

/// The tools in a text; nullopt, and why in `*error`: it is no list of tools. `lathe`: how the lengths of a table are
/// meant where the table does not say.
std::optional<ToolFile> parse_tools(std::string_view text, bool lathe, std::string* error);
/// The same of a file; the reason begins with its path.
std::optional<ToolFile> read_tools(const std::string& path, bool lathe, std::string* error);

/// Puts the tools into a profile, each in the place of one with its number.
void put_tools(const std::vector<machine::Tool>& tools, machine::Profile& profile);

}  // namespace cnctrans::translator
