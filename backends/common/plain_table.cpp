// The table of plain words, made once for a stream.
#include <array>
#include <string>

#include "backends/common/index_of.h"
#include "backends/common/stream_writer.h"

namespace cnctrans::backends {

using machine::MMeaning;

namespace {

/// M words by number; the texts live as long as the program.
std::string_view m_text(std::int32_t code, bool two_digits) {
  static const std::array<std::string, 200> texts = [] {
    std::array<std::string, 200> t;
    for (std::size_t i = 0; i < 100; ++i) {
      t[i] = "M" + std::to_string(i);
      t[100 + i] = i < 10 ? "M0" + std::to_string(i) : t[i];
    }
    return t;
  }();
  if (code < 0 || code > 99) return {};
  return texts[static_cast<std::size_t>(code) + (two_digits ? 100 : 0)];
}

std::int32_t code_with(const machine::Profile& profile, MMeaning meaning, std::int32_t usual) {
  const machine::MCode* at = profile.m_code(usual);
  if (at == nullptr || at->meaning == meaning) return usual;
  for (const machine::MCode& m : profile.m_codes) {
    if (m.meaning == meaning) return m.code;
  }
  return usual;
}

}  // namespace

PlainTable plain_table(const Style& style, const machine::Profile& profile) {
  PlainTable t;
  for (const ModalCode& c : style.modal_codes) {
    if (c.value < PlainTable::setting_values) t.settings[index_of(c.setting)][c.value] = c.code;
  }
  for (const MotionCode& c : style.motion_codes) {
    const bool plain = c.kind == ir::MotionKind::rapid || c.kind == ir::MotionKind::linear ||
                       c.kind == ir::MotionKind::arc_cw || c.kind == ir::MotionKind::arc_ccw;
    if (plain) t.motions[index_of(c.kind)] = c.code;
  }
  for (std::size_t i = 0; i < t.axes.size(); ++i) t.axes[i] = ir::fixed_axis_name(static_cast<ir::AxisId>(i));
  t.centers[ir::axis::x] = "I";
  t.centers[ir::axis::y] = "J";
  t.centers[ir::axis::z] = "K";
  t.radius = style.radius_address;
  const auto m = [&](MMeaning meaning, std::int32_t usual) {
    return m_text(code_with(profile, meaning, usual), style.two_digit_m);
  };
  t.spindle_states = {m(MMeaning::spindle_stop, 5), m(MMeaning::spindle_cw, 3), m(MMeaning::spindle_ccw, 4)};
  t.coolant_states = {m(MMeaning::coolant_off, 9), m(MMeaning::coolant_flood, 8), m(MMeaning::coolant_mist, 7),
                      m(MMeaning::coolant_second, 7)};
  t.stops = {m(MMeaning::stop, 0), m(MMeaning::optional_stop, 1)};
  t.tool_change = m(MMeaning::tool_change, 6);
  t.machine_functions.fill(true);
  for (const machine::MCode& c : profile.m_codes) {
    if (c.code < 0 || index_of(c.code) >= t.machine_functions.size()) continue;
    t.machine_functions[index_of(c.code)] = c.meaning == MMeaning::machine_function || c.meaning == MMeaning::none;
  }
  return t;
}

}  // namespace cnctrans::backends
