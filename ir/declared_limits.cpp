#include "ir/declared_limits.h"

#include "base/saturate.h"
#include "base/text.h"

namespace cnctrans::ir {

DeclaredLimits declared_limits(std::string_view type_text) {
  DeclaredLimits out;
  std::string_view rest = type_text;
  const auto part = [&rest] {
    const std::size_t from = rest.find_first_not_of(" \t,");
    rest.remove_prefix(from == std::string_view::npos ? rest.size() : from);
    const std::string_view text = rest.substr(0, rest.find_first_of(" \t,"));
    rest.remove_prefix(text.size());
    return text;
  };
  for (auto text = part(); !text.empty(); text = part()) {
    const bool low = iequals_ascii(text, "LLI");
    if (low || iequals_ascii(text, "ULI")) {
      if (const auto value = parse_decimal(part())) (low ? out.low : out.high) = *value;
      continue;
    }
    const std::size_t open = text.find('[');
    if (open == std::string_view::npos || text.back() != ']') continue;
    const auto n = parse_decimal(trim(text.substr(open + 1, text.size() - open - 2)));
    if (n && *n >= 0) out.length = saturate<std::size_t>(*n);
  }
  return out;
}

}  // namespace cnctrans::ir
