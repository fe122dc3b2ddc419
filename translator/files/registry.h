// The dialects the house knows: one line each in registry.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backends/common/backend.h"
#include "frontends/common/frontend.h"
#include "machine/profile.h"

namespace cnctrans::translator {

/// What tells a program for a lathe before it is read. Words in capitals.
struct LatheMarks {
  std::vector<int> codes;                           ///< G functions of lathes only
  std::vector<std::string_view> diameter_words;     ///< switch X to diameters: a lathe, also with Y words
  std::vector<int> codes_without_y;                 ///< G functions that mean a lathe where no Y word stands
  std::vector<std::string_view> words_without_y{};  ///< words of the same kind
};

struct Dialect {
  std::string_view name;                           ///< "fagor": what --from and --to take
  std::string_view title;                          ///< "Fagor 8055"
  std::vector<std::string_view> mill_extensions;   ///< that say "mill", lower case
  std::vector<std::string_view> lathe_extensions;  ///< that say "lathe"
  std::vector<std::string_view> other_extensions;  ///< that a library folder may hold besides
  int first_skip_switch = 0;                       ///< number of the first block-skip switch on the control
  std::string_view numbered_stem;                  ///< what stands before the number in the file name of a subprogram
  char comment_open = ';';                         ///< marks of comments, for a look at a text before it is read
  char comment_close = 0;                          ///< 0: to the end of the line
  LatheMarks lathe;                                ///< for files whose extension does not tell
  std::vector<std::pair<int, char>> axis_codes{};  ///< G functions that use an axis without a word of it
  std::shared_ptr<const frontends::Frontend> frontend;
  std::shared_ptr<const backends::Backend> backend;
  /// Of files that define names for every program of a machine: their extension, or the end of their name behind `_`.
  std::vector<std::string_view> definition_extensions{};
  /// The file that holds what a program has written under a name of the control; null: no program writes files.
  std::string (*written_file)(std::string_view name, bool lathe) = nullptr;
  /// A line of a definition file that defines a number, or an array of them; null: no machine defines names.
  std::string (*definition)(std::string_view name, const std::vector<std::int64_t>& sizes) = nullptr;
  /// Feature of a machine datum that a program may set and that changes no programmed position; null: it has none.
  std::string_view (*datum_feature)(std::string_view name) = nullptr;
  /// The datum is a setting of the machine, which only a program or its builder changes; null: it has none.
  bool (*is_setting)(std::string_view name) = nullptr;
};

/// All dialects in the order `cnctrans dialects` lists them.
const std::vector<Dialect>& dialects();
/// nullptr when unknown.
const Dialect* find_dialect(std::string_view name);

}  // namespace cnctrans::translator
