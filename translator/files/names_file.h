// The map of names on disk (--names): JSON, read before a translation and written after it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "legaliser/name_map.h"
#include "translator/files/outside.h"

namespace cnctrans::translator {

/// All that a names file says.
struct Names {
  ir::NameMap map;
  OutsideRoutines outside;
  /// Names that the machine defines for every program: how many elements an array has in each dimension; empty: it is
  /// one value.
  std::map<std::string, std::vector<std::int64_t>> sizes;
  /// What stands there by hand and goes back as it is: by the parts of the file, the text of each entry. Entries
  /// without an answer are among them.
  std::map<std::string, std::map<std::string, std::string>> by_hand;
  bool operator==(const Names&) const = default;
};

/// The names in the text of a names file for translations from `from` to `to` (dialect names). nullopt, with a reason
/// in `*error`: it is no such file, or one for another direction.
std::optional<Names> parse_names(std::string_view text, std::string_view from, std::string_view to, std::string* error);
/// The names in a file; the reason in `*error` begins with its path.
std::optional<Names> read_names(const std::string& path, std::string_view from, std::string_view to,
                                std::string* error);
/// The same text for the same names, whatever order they came about in.
std::string names_text(const Names& names, std::string_view from, std::string_view to);
/// What `more` has in addition; an entry of `names` stays as it is.
void add_names(ir::NameMap& names, const ir::NameMap& more);

/// Something that the programs of an archive need and nobody has, as an entry of a names file without its answer.
struct Question {
  enum class Kind : std::uint8_t { routine, datum, size } kind = Kind::routine;
  std::string name;
  std::vector<std::string> arguments;  ///< of a routine: letters that its calls give it, or one empty text for each
  bool operator==(const Question&) const = default;
};
/// Adds those that the file does not know yet, each with an empty place for its answer; how many.
std::size_t add_questions(Names& names, const std::vector<Question>& questions);

/// The definitions of `sizes` in the language of `from`; nullptr: there are none, or (a reason in `*error`) the
/// language has none. `path` names the file in messages.
SourcePtr definitions_of(const Names& names, std::string_view from, const std::string& path, std::string* error);

}  // namespace cnctrans::translator
