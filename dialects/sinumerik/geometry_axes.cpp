#include "dialects/sinumerik/geometry_axes.h"

#include <algorithm>

#include "base/text.h"

namespace cnctrans::sinumerik {

namespace {

constexpr std::string_view call = "GEOAX(";
constexpr std::string_view geometry = "XYZ";

ir::AxisId axis_id(std::string_view name, const std::vector<std::string>& names) {
  if (name.size() == 1) return ir::fixed_axis(name[0]);
  const auto it = std::find(names.begin(), names.end(), name);
  return it == names.end() ? ir::axis::none : static_cast<ir::AxisId>(ir::axis::first_extra + (it - names.begin()));
}

}  // namespace

std::optional<std::vector<GeometryAxis>> geometry_axes(std::string_view written) {
  std::string text;
  for (const char c : to_upper_ascii(written)) {
    if (c != ' ' && c != '\t') text += c;
  }
  if (!text.starts_with(call) || !text.ends_with(')')) return std::nullopt;
  std::string_view rest = std::string_view(text).substr(call.size(), text.size() - call.size() - 1);
  std::vector<GeometryAxis> out;
  while (!rest.empty()) {
    const bool pair = rest.size() >= 3 && rest[0] >= '0' && rest[0] <= '3' && rest[1] == ',';
    if (!pair) return std::nullopt;
    GeometryAxis a;
    a.number = rest[0] - '0';
    rest.remove_prefix(2);
    const std::size_t comma = std::min(rest.find(','), rest.size());
    a.channel_axis = rest.substr(0, comma);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    if (a.channel_axis.empty()) return std::nullopt;
    out.push_back(std::move(a));
  }
  return out;
}

bool is_own_axis(const GeometryAxis& a) {
  if (a.number < 1) return false;
  const char letter = geometry[static_cast<std::size_t>(a.number) - 1];
  const std::string& n = a.channel_axis;
  return n.size() <= 2 && n[0] == letter && (n.size() == 1 || n[1] == '1' || n[1] == letter);
}

std::optional<ir::passes::AxisExchange> geometry_exchange(const ir::Statement& s,
                                                          const std::vector<std::string>& names) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (b == nullptr) return std::nullopt;
  for (const auto& a : b->actions) {
    const auto* word = std::get_if<ir::OpaqueWord>(&a.data);
    const auto pairs = word != nullptr ? geometry_axes(word->word) : std::nullopt;
    if (!pairs) continue;
    ir::passes::AxisExchange out;
    if (pairs->empty()) out.ends = {ir::axis::x, ir::axis::y, ir::axis::z};
    for (const auto& p : *pairs) {
      const auto axis = static_cast<ir::AxisId>(p.number - 1);
      out.ends.push_back(axis);
      if (!is_own_axis(p)) out.pairs.emplace_back(axis, axis_id(p.channel_axis, names));
    }
    return out;
  }
  return std::nullopt;
}

}  // namespace cnctrans::sinumerik
