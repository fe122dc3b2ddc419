#include "dialects/fagor/axis_exchange.h"

#include <cctype>
#include <string_view>
#include <vector>

namespace cnctrans::dialects::fagor {

std::optional<ir::passes::AxisExchange> axis_exchange(const ir::Statement& s) {
  const auto* kept = std::get_if<ir::Opaque>(&s.node);
  if (kept == nullptr || !kept->harmless || kept->feature != "language.synchronised") return std::nullopt;
  int code = -1;
  bool function = false;
  std::vector<ir::AxisId> axes;
  for (const char written : kept->text) {
    const char c = static_cast<char>(std::toupper(static_cast<unsigned char>(written)));
    if (c == ' ' || c == '\t') continue;
    if (c == 'G' && !function) {
      function = true;
    } else if (c >= '0' && c <= '9' && function && axes.empty()) {
      code = (code < 0 ? 0 : code) * 10 + (c - '0');
      if (code > 29) return std::nullopt;
    } else if (const ir::AxisId axis = ir::fixed_axis(c); axis != ir::axis::none && code >= 0) {
      axes.push_back(axis);
    } else {
      return std::nullopt;
    }
  }
  ir::passes::AxisExchange out;
  if (code == 29 && !axes.empty()) {
    out.ends = std::move(axes);
    return out;
  }
  if (code != 28 || axes.size() != 2) return std::nullopt;
  out.pairs.emplace_back(axes[0], axes[1]);
  return out;
}

}  // namespace cnctrans::dialects::fagor
