#include "lsp/words/words_common.h"

namespace cnctrans::lsp {

void add_words(std::vector<WordInfo>& out, WordKind kind, std::initializer_list<std::string_view> words) {
  for (const auto w : words) out.push_back({std::string(w), kind, {}, {}, true, true});
}

std::string setting_title(ir::Setting setting, std::uint8_t value) {
  return spoken(ir::name(setting)) + ": " + spoken(ir::setting_value_name(setting, value));
}

std::string motion_title(ir::MotionKind kind) {
  switch (kind) {
    case ir::MotionKind::rapid: return "rapid";
    case ir::MotionKind::linear: return "line at feed";
    case ir::MotionKind::arc_cw: return "arc clockwise";
    case ir::MotionKind::arc_ccw: return "arc counter-clockwise";
    default: return spoken(ir::name(kind));
  }
}

std::vector<std::string_view> parts_of(std::string_view list) {
  std::vector<std::string_view> parts;
  while (!list.empty()) {
    const auto comma = list.find(',');
    parts.push_back(list.substr(0, comma));
    list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 1);
  }
  return parts;
}

}  // namespace cnctrans::lsp
