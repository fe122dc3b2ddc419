// Machine data whose name on the target the map of names (--names) gives: their text is that name behind a mark.
#pragma once

#include <string>
#include <string_view>

#include "ir/expr.h"

namespace cnctrans::ir {

/// No control's name begins with it. In NameMap::variables it stands before the data of the source as well.
inline constexpr char given_mark = '=';

inline bool is_given(const SystemRef& ref) {
  return ref.text.starts_with(given_mark);
}
/// As it is written.
inline std::string given_name(const SystemRef& ref) {
  return ref.text.substr(1);
}
inline SystemRef given_datum(std::string_view name) {
  SystemRef ref;
  ref.text = given_mark + std::string(name);
  return ref;
}

}  // namespace cnctrans::ir
