#include "frontends/num/state/settings.h"

#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/num/limits.h"
#include "dialects/num/mcodes.h"
#include "dialects/num/options.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;

namespace {

/// "6:9100 55:8055": M06 calls %9100, M55 calls %8055.
void read_m_programs(std::string_view text, Settings& s) {
  while (!(text = trim(text)).empty()) {
    const std::string_view pair = text.substr(0, text.find(' '));
    text.remove_prefix(pair.size());
    const std::size_t colon = pair.find(':');
    const auto code = parse_decimal(pair.substr(0, colon));
    const auto program = parse_decimal(colon == std::string_view::npos ? "" : pair.substr(colon + 1));
    const auto whole = [](const std::optional<double>& v, double most) {
      return v && *v >= 0 && *v <= most && *v == std::floor(*v);
    };
    if (whole(code, facts::m_max) && whole(program, facts::system_program_max))
      s.m_programs[saturate<std::int64_t>(*code)] = saturate<std::int64_t>(*program);
    else
      s.bad_m_programs = pair;
  }
}

}  // namespace

Settings make_settings(const machine::Profile& profile) {
  Settings s;
  s.options = facts::options_of(profile);
  const auto& o = s.options;
  s.lathe = profile.kind == machine::Kind::lathe;
  s.structured = o.family != facts::Family::n7xx;
  s.centre_absolute = o.centre == facts::ArcCentre::absolute_in_g90;
  s.range_by_position = o.range_order == facts::RangeOrder::position;
  s.stop_ends_spindle = profile.policies.stop_spindle == machine::StopSpindle::stops;
  s.face_radius = o.face_x == facts::FaceX::radius;
  s.chased = facts::thread_habits(o);
  s.reentrant = facts::reentrant_habits(o);
  s.plunged_by_p = facts::plunge_habits(o, true);
  s.plunged_by_r = facts::plunge_habits(o, false);
  if (o.linear_unit_um > 0) s.units_per_mm = 1000 / o.linear_unit_um;
  if (o.rotary_unit > 0) s.units_per_degree = std::round(1 / o.rotary_unit);
  s.power_on = profile.power_on;
  for (const auto& axis : profile.axes) {
    if (axis.id < 32) s.axes |= 1U << axis.id;
  }
  for (const char c : profile.policies.rotary_signed_axes) {
    const ir::AxisId id = ir::fixed_axis(static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
    if (id != ir::axis::none && ir::is_rotary_letter(id)) s.modulo |= 1U << id;
  }
  for (const auto& row : facts::m_codes) {
    s.m[static_cast<std::size_t>(row.code)] = {row.meaning, row.order, row.argument, true};
  }
  for (const auto& m : profile.m_codes) {
    if (m.code < 0 || m.code > 999) continue;
    s.m[static_cast<std::size_t>(m.code)] = {m.meaning, m.order, static_cast<std::int16_t>(m.argument), true};
  }
  read_m_programs(o.m_programs, s);
  if (o.m30 == facts::M30::end) s.m[30] = {machine::MMeaning::program_end, ir::Order::after, 0, true};
  return s;
}

}  // namespace cnctrans::frontends::num
