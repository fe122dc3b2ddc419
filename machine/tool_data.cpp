#include "machine/tool_data.h"

#include <algorithm>

namespace cnctrans::machine {

std::vector<std::string> tool_data_names(std::string_view list, std::optional<std::int32_t> tool,
                                         std::optional<std::int32_t> offset) {
  std::vector<std::string> out;
  for (std::string_view rest = list; !rest.empty();) {
    const auto bar = std::min(rest.find('|'), rest.size());
    std::string name;
    for (std::size_t i = 0; i < bar; ++i) {
      const bool mark = rest[i] == '#' && i + 1 < bar && (rest[i + 1] == 'T' || rest[i + 1] == 'D');
      if (!mark) {
        name += rest[i];
        continue;
      }
      const auto& number = rest[++i] == 'T' ? tool : offset;
      name += number ? std::to_string(*number) : std::string("*");
    }
    rest.remove_prefix(std::min(bar + 1, rest.size()));
    out.push_back(std::move(name));
  }
  return out;
}

}  // namespace cnctrans::machine
