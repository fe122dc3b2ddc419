#include "ir/modal.h"

#include <span>

namespace cnctrans::ir {

namespace {

using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, 3> plane_names{"xy", "zx", "yz"};
constexpr std::array<std::string_view, 2> distance_names{"absolute", "incremental"};
constexpr std::array<std::string_view, 2> units_names{"metric", "inch"};
constexpr std::array<std::string_view, 3> diameter_names{"radius", "diameter", "absolute_only"};
constexpr std::array<std::string_view, 3> feed_names{"per_minute", "per_rev", "inverse_time"};
constexpr std::array<std::string_view, 2> path_names{"continuous", "exact_stop"};
constexpr std::array<std::string_view, 2> spindle_names{"rpm", "css"};
constexpr std::array<std::string_view, 3> comp_names{"off", "left", "right"};
constexpr std::array<std::string_view, 2> on_off_names{"off", "on"};
constexpr std::array<std::string_view, 2> retract_names{"initial", "reference"};
constexpr std::array<std::string_view, 2> feed_point_names{"centre", "contact"};
constexpr std::array<std::string_view, 3> spline_end_names{"free", "natural", "tangent"};
constexpr std::array<std::string_view, 2> reference_names{"arc_length", "parameter"};
constexpr std::array<std::string_view, 4> surface_names{"none", "face", "cylinder", "tool"};
constexpr std::array<std::string_view, 21> motion_names{
    "modal",           "rapid",        "linear",          "arc_cw",
    "arc_ccw",         "thread",       "thread_variable", "arc_through_point",
    "arc_tangent",     "spline_akima", "spline_b",        "spline_cubic",
    "polynomial",      "probe_toward", "probe_away",      "to_stop",
    "reference_point", "fixed_point",  "tap_rigid",       "tap_rigid_out",
    "tap_floating"};

struct SettingRow {
  std::string_view name;
  Names values;
};
// In the order of Setting.
constexpr std::array<SettingRow, setting_count> settings{{{"plane", plane_names},
                                                          {"distance", distance_names},
                                                          {"units", units_names},
                                                          {"diameter", diameter_names},
                                                          {"feed_mode", feed_names},
                                                          {"path_mode", path_names},
                                                          {"spindle_mode", spindle_names},
                                                          {"comp", comp_names},
                                                          {"length_comp", on_off_names},
                                                          {"retract_plane", retract_names},
                                                          {"feed_point", feed_point_names},
                                                          {"feed_override", on_off_names},
                                                          {"spline_start", spline_end_names},
                                                          {"spline_end", spline_end_names},
                                                          {"path_reference", reference_names},
                                                          {"polynomial_axes", on_off_names},
                                                          {"surface", surface_names}}};

template <class E>
std::uint8_t raw(E e) {
  return static_cast<std::uint8_t>(e);
}

}  // namespace

std::uint8_t ModalState::get(Setting s) const {
  switch (s) {
    case Setting::plane: return raw(plane);
    case Setting::distance: return raw(distance);
    case Setting::units: return raw(units);
    case Setting::diameter: return raw(diameter);
    case Setting::feed_mode: return raw(feed_mode);
    case Setting::path_mode: return raw(path_mode);
    case Setting::spindle_mode: return raw(spindle_mode);
    case Setting::comp: return raw(comp);
    case Setting::length_comp: return raw(length_comp);
    case Setting::retract_plane: return raw(retract_plane);
    case Setting::feed_point: return raw(feed_point);
    case Setting::feed_override: return raw(feed_override);
    case Setting::spline_start: return raw(spline_start);
    case Setting::spline_end: return raw(spline_end);
    case Setting::path_reference: return raw(path_reference);
    case Setting::polynomial_axes: return raw(polynomial_axes);
    case Setting::surface: return raw(surface);
    case Setting::count_: break;
  }
  return 0;
}

void ModalState::set(Setting s, std::uint8_t value) {
  switch (s) {
    case Setting::plane: plane = static_cast<Plane>(value); break;
    case Setting::distance: distance = static_cast<Distance>(value); break;
    case Setting::units: units = static_cast<Units>(value); break;
    case Setting::diameter: diameter = static_cast<DiameterMode>(value); break;
    case Setting::feed_mode: feed_mode = static_cast<FeedMode>(value); break;
    case Setting::path_mode: path_mode = static_cast<PathMode>(value); break;
    case Setting::spindle_mode: spindle_mode = static_cast<SpindleMode>(value); break;
    case Setting::comp: comp = static_cast<CompSide>(value); break;
    case Setting::length_comp: length_comp = static_cast<OnOff>(value); break;
    case Setting::retract_plane: retract_plane = static_cast<RetractPlane>(value); break;
    case Setting::feed_point: feed_point = static_cast<FeedPoint>(value); break;
    case Setting::feed_override: feed_override = static_cast<OnOff>(value); break;
    case Setting::spline_start: spline_start = static_cast<SplineEnd>(value); break;
    case Setting::spline_end: spline_end = static_cast<SplineEnd>(value); break;
    case Setting::path_reference: path_reference = static_cast<PathReference>(value); break;
    case Setting::polynomial_axes: polynomial_axes = static_cast<OnOff>(value); break;
    case Setting::surface: surface = static_cast<Surface>(value); break;
    case Setting::count_: break;
  }
}

std::string_view name(Plane p) {
  return plane_names[raw(p)];
}
std::string_view name(Distance d) {
  return distance_names[raw(d)];
}
std::string_view name(Units u) {
  return units_names[raw(u)];
}
std::string_view name(DiameterMode d) {
  return diameter_names[raw(d)];
}
std::string_view name(FeedMode m) {
  return feed_names[raw(m)];
}
std::string_view name(PathMode m) {
  return path_names[raw(m)];
}
std::string_view name(SpindleMode m) {
  return spindle_names[raw(m)];
}
std::string_view name(CompSide s) {
  return comp_names[raw(s)];
}
std::string_view name(RetractPlane r) {
  return retract_names[raw(r)];
}
std::string_view name(Surface s) {
  return surface_names[raw(s)];
}
std::string_view name(MotionKind k) {
  return motion_names[raw(k)];
}
std::string_view name(Setting s) {
  return settings[raw(s)].name;
}

std::string_view setting_value_name(Setting s, std::uint8_t value) {
  const Names values = settings[raw(s)].values;
  return value < values.size() ? values[value] : std::string_view{};
}

std::optional<std::uint8_t> setting_value(Setting s, std::string_view text) {
  const Names values = settings[raw(s)].values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == text) return static_cast<std::uint8_t>(i);
  }
  return std::nullopt;
}

std::optional<Setting> setting_by_name(std::string_view text) {
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (settings[i].name == text) return static_cast<Setting>(i);
  }
  return std::nullopt;
}

std::optional<MotionKind> motion_kind_by_name(std::string_view text) {
  for (std::size_t i = 0; i < motion_names.size(); ++i) {
    if (motion_names[i] == text) return static_cast<MotionKind>(i);
  }
  return std::nullopt;
}

}  // namespace cnctrans::ir
