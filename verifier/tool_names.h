// Tools that the source calls by name and the translation by number.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "interpreter/trace/trace.h"

namespace cnctrans::verifier {

class ToolNames {
 public:
  /// The same number or name; a name of the source that became a number is that number everywhere, and no other is.
  bool same(const interpreter::Event& a, const interpreter::Event& b) {
    if (a.text.empty() || !b.text.empty()) return a.number == b.number && a.text == b.text;
    const auto named = numbers_.emplace(a.text, b.number).first;
    const auto numbered = names_.emplace(b.number, a.text).first;
    return named->second == b.number && numbered->second == a.text;
  }

 private:
  std::map<std::string, std::int32_t> numbers_;  ///< by their names in the source, as met so far
  std::map<std::int32_t, std::string> names_;
};

}  // namespace cnctrans::verifier
