#include "frontends/sinumerik/syntax/macros.h"

#include "base/text.h"

namespace cnctrans::sinumerik {

namespace {

bool starts_name(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$';
}
bool goes_on_name(char c) {
  return starts_name(c) || (c >= '0' && c <= '9');
}

}  // namespace

std::optional<std::string> expand_macros(std::string_view line,
                                         const std::map<std::string, std::string, std::less<>>& macros) {
  std::string out;
  bool changed = false;
  for (std::size_t i = 0; i < line.size();) {
    std::size_t end = i + 1;
    if (line[i] == ';') {
      end = line.size();
    } else if (line[i] == '"') {
      const std::size_t close = line.find('"', i + 1);
      end = close == std::string_view::npos ? line.size() : close + 1;
    } else if (goes_on_name(line[i])) {  // a number takes its letters along: 1EX3
      while (end < line.size() && goes_on_name(line[end])) ++end;
      const std::string name = to_upper_ascii(line.substr(i, end - i));
      if (name == "DEFINE" || name == "REDEF") return std::nullopt;
      if (const auto found = macros.find(name); found != macros.end()) {
        out += found->second;
        changed = true;
        i = end;
        continue;
      }
    }
    out += line.substr(i, end - i);
    i = end;
  }
  if (!changed) return std::nullopt;
  return out;
}

}  // namespace cnctrans::sinumerik
