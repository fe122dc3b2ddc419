// G functions (reference 5.1, 5.2; groups 4.3). `value` is the ir enumerator that the code sets, where it sets one.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "ir/modal.h"

namespace cnctrans::dialects::num {

/// What a G function is, beyond its number.
enum class GKind : std::uint8_t {
  unknown,
  motion,           ///< value: ir::MotionKind
  dwell,            ///< G04 F
  exact_stop,       ///< G09
  interruptible,    ///< G10
  handwheel,        ///< G12: no effect on the nominal path
  tool_axis,        ///< G16 P+- Q+- R+-
  plane,            ///< value: ir::Plane
  surface,          ///< value: ir::Surface: G20 G21 G22
  lathe_transform,  ///< G98
  three_points,     ///< G23
  comp,             ///< value: ir::CompSide
  spatial_comp,     ///< G29 G43
  mirror,           ///< G51
  machine_frame,    ///< G52
  offsets_off,      ///< G53
  offsets_on,       ///< G54
  shift,            ///< G59
  units,            ///< value: ir::Units
  scale_off,
  scale_on,        ///< G73 G74
  retract_sub,     ///< G75
  save_values,     ///< G76
  call,            ///< G77
  synchronise,     ///< G78
  jump,            ///< G79
  cycle_off,       ///< G80
  hole_cycle,      ///< G81-G89
  distance,        ///< value: ir::Distance
  preset,          ///< G92 (axes, R, S)
  feed_mode,       ///< value: ir::FeedMode
  spindle_mode,    ///< value: ir::SpindleMode
  thread_segment,  ///< G38
  turning_cycle,   ///< G33 G63-G66
  milling_cycle,   ///< G31 G45 G46
  spline,          ///< G06 G48 G49
  transform,       ///< G24 G26: tilted plane, tool centre point
  concatenation,   ///< G997 G998 G999
  grinding_axis    ///< G05 G07
};

/// Groups of modal functions; a new one of a group replaces the one before.
enum class GGroup : std::uint8_t {
  block_only,
  motion,
  plane,
  tool_axis,
  lathe,
  comp,
  units,
  scale,
  mirror,
  offsets,
  cycle,
  distance,
  feed,
  spindle,
  retract,
  special
};

/// Where it exists: on mills (M), lathes (T) or both.
enum class GMachine : std::uint8_t { both, mill, lathe };

struct GCode {
  std::int16_t code = -1;
  GKind kind = GKind::unknown;
  std::uint8_t value = 0;
  GGroup group = GGroup::block_only;
  GMachine machine = GMachine::both;
  std::string_view title;
  std::string_view section;
};

template <class E>
constexpr std::uint8_t u8(E e) {
  return static_cast<std::uint8_t>(e);
}

inline constexpr std::array g_codes{
    GCode{0, GKind::motion, u8(ir::MotionKind::rapid), GGroup::motion, GMachine::both, "rapid, interpolated", "6.1"},
    GCode{1, GKind::motion, u8(ir::MotionKind::linear), GGroup::motion, GMachine::both, "line at feed", "6.2"},
    GCode{2, GKind::motion, u8(ir::MotionKind::arc_cw), GGroup::motion, GMachine::both, "arc or helix clockwise",
          "6.3"},
    GCode{3, GKind::motion, u8(ir::MotionKind::arc_ccw), GGroup::motion, GMachine::both,
          "arc or helix counter-clockwise", "6.3"},
    GCode{4, GKind::dwell, 0, GGroup::block_only, GMachine::both, "dwell, F in seconds", "6.5"},
    GCode{5, GKind::grinding_axis, 0, GGroup::block_only, GMachine::lathe, "inclined axis", "5.2"},
    GCode{6, GKind::spline, 0, GGroup::motion, GMachine::both, "run a spline", "6.8"},
    GCode{7, GKind::grinding_axis, 0, GGroup::block_only, GMachine::lathe, "inclined axis, first position", "5.2"},
    GCode{9, GKind::exact_stop, 0, GGroup::block_only, GMachine::both, "exact stop at block end", "6.6"},
    GCode{10, GKind::interruptible, 0, GGroup::block_only, GMachine::both, "interruptible block", "6.7"},
    GCode{12, GKind::handwheel, 0, GGroup::block_only, GMachine::both, "handwheel overspeed", "6.9"},
    GCode{16, GKind::tool_axis, 0, GGroup::tool_axis, GMachine::both, "tool axis", "9.2"},
    GCode{17, GKind::plane, u8(ir::Plane::xy), GGroup::plane, GMachine::both, "plane XY", "4.3"},
    GCode{18, GKind::plane, u8(ir::Plane::zx), GGroup::plane, GMachine::both, "plane ZX", "4.3"},
    GCode{19, GKind::plane, u8(ir::Plane::yz), GGroup::plane, GMachine::both, "plane YZ", "4.3"},
    GCode{20, GKind::surface, u8(ir::Surface::none), GGroup::lathe, GMachine::lathe, "X Z coordinates", "12.6"},
    GCode{21, GKind::surface, u8(ir::Surface::face), GGroup::lathe, GMachine::lathe, "face milling with C", "12.6"},
    GCode{22, GKind::surface, u8(ir::Surface::cylinder), GGroup::lathe, GMachine::lathe, "cylinder milling with C",
          "12.6"},
    GCode{23, GKind::three_points, 0, GGroup::block_only, GMachine::both, "circle through three points", "6.4"},
    GCode{24, GKind::transform, 0, GGroup::special, GMachine::mill, "tilted working plane", "5.1"},
    GCode{26, GKind::transform, 0, GGroup::special, GMachine::mill, "tool centre point control", "5.1"},
    GCode{29, GKind::spatial_comp, 0, GGroup::comp, GMachine::both, "3D tool correction", "9.5"},
    GCode{31, GKind::milling_cycle, 0, GGroup::cycle, GMachine::mill, "thread with a single-point tool", "11.5"},
    GCode{33, GKind::turning_cycle, 0, GGroup::block_only, GMachine::lathe, "threading cycle", "12.1"},
    GCode{38, GKind::thread_segment, 0, GGroup::block_only, GMachine::lathe, "chained threads", "12.2"},
    GCode{40, GKind::comp, u8(ir::CompSide::off), GGroup::comp, GMachine::both, "radius compensation off", "9.3"},
    GCode{41, GKind::comp, u8(ir::CompSide::left), GGroup::comp, GMachine::both, "radius compensation left", "9.3"},
    GCode{42, GKind::comp, u8(ir::CompSide::right), GGroup::comp, GMachine::both, "radius compensation right", "9.3"},
    GCode{43, GKind::spatial_comp, 0, GGroup::comp, GMachine::both, "3D correction, cylindrical tool", "9.5"},
    GCode{45, GKind::milling_cycle, 0, GGroup::cycle, GMachine::mill, "simple pocket", "11.6"},
    GCode{46, GKind::milling_cycle, 0, GGroup::cycle, GMachine::mill, "pocket with islands", "11.7"},
    GCode{48, GKind::spline, 0, GGroup::block_only, GMachine::both, "define a spline", "6.8"},
    GCode{49, GKind::spline, 0, GGroup::block_only, GMachine::both, "delete a spline", "6.8"},
    GCode{51, GKind::mirror, 0, GGroup::mirror, GMachine::both, "mirror", "8.5"},
    GCode{52, GKind::machine_frame, 0, GGroup::block_only, GMachine::both, "machine coordinates", "8.7"},
    GCode{53, GKind::offsets_off, 0, GGroup::offsets, GMachine::both, "PREF and DEC1 ignored", "8.2"},
    GCode{54, GKind::offsets_on, 0, GGroup::offsets, GMachine::both, "PREF and DEC1 applied", "8.2"},
    GCode{59, GKind::shift, 0, GGroup::block_only, GMachine::both, "programmed origin shift", "8.3"},
    GCode{63, GKind::turning_cycle, 0, GGroup::block_only, GMachine::lathe, "roughing with grooves", "12.5"},
    GCode{64, GKind::turning_cycle, 0, GGroup::cycle, GMachine::lathe, "paraxial roughing", "12.3"},
    GCode{65, GKind::turning_cycle, 0, GGroup::block_only, GMachine::lathe, "groove roughing", "12.4"},
    GCode{66, GKind::turning_cycle, 0, GGroup::block_only, GMachine::lathe, "plunge cycle", "12.5"},
    GCode{70, GKind::units, u8(ir::Units::inch), GGroup::units, GMachine::both, "inch", "8.9"},
    GCode{71, GKind::units, u8(ir::Units::metric), GGroup::units, GMachine::both, "metric", "8.9"},
    GCode{73, GKind::scale_off, 0, GGroup::scale, GMachine::both, "scale off", "8.6"},
    GCode{74, GKind::scale_on, 0, GGroup::scale, GMachine::both, "scale E69000 on", "8.6"},
    GCode{75, GKind::retract_sub, 0, GGroup::retract, GMachine::both, "emergency retract sequence", "13.3"},
    GCode{76, GKind::save_values, 0, GGroup::block_only, GMachine::both, "write values into a program", "13.4"},
    GCode{77, GKind::call, 0, GGroup::block_only, GMachine::both, "call", "13.2"},
    GCode{78, GKind::synchronise, 0, GGroup::block_only, GMachine::both, "axis group synchronisation", "13.5"},
    GCode{79, GKind::jump, 0, GGroup::block_only, GMachine::both, "jump", "13.1"},
    GCode{80, GKind::cycle_off, 0, GGroup::cycle, GMachine::both, "cycle off", "11.1"},
    GCode{81, GKind::hole_cycle, 0, GGroup::cycle, GMachine::both, "drilling", "11.2"},
    GCode{82, GKind::hole_cycle, 0, GGroup::cycle, GMachine::both, "counterboring", "11.2"},
    GCode{83, GKind::hole_cycle, 0, GGroup::cycle, GMachine::both, "deep hole", "11.2"},
    GCode{84, GKind::hole_cycle, 0, GGroup::cycle, GMachine::both, "tapping", "11.2"},
    GCode{85, GKind::hole_cycle, 0, GGroup::cycle, GMachine::both, "reaming", "11.2"},
    GCode{86, GKind::hole_cycle, 0, GGroup::cycle, GMachine::both, "boring, oriented stop", "11.2"},
    GCode{87, GKind::hole_cycle, 0, GGroup::cycle, GMachine::both, "drilling with chip breaking", "11.2"},
    GCode{88, GKind::hole_cycle, 0, GGroup::cycle, GMachine::both, "boring and facing", "11.2"},
    GCode{89, GKind::hole_cycle, 0, GGroup::cycle, GMachine::both, "boring with dwell", "11.2"},
    GCode{90, GKind::distance, u8(ir::Distance::absolute), GGroup::distance, GMachine::both, "absolute", "6.10"},
    GCode{91, GKind::distance, u8(ir::Distance::incremental), GGroup::distance, GMachine::both, "incremental", "6.10"},
    GCode{92, GKind::preset, 0, GGroup::block_only, GMachine::both, "preset, limits", "8.2, 7"},
    GCode{93, GKind::feed_mode, u8(ir::FeedMode::inverse_time), GGroup::feed, GMachine::both, "F = 1/min", "7"},
    GCode{94, GKind::feed_mode, u8(ir::FeedMode::per_minute), GGroup::feed, GMachine::both, "F per minute", "7"},
    GCode{95, GKind::feed_mode, u8(ir::FeedMode::per_rev), GGroup::feed, GMachine::both, "F per revolution", "7"},
    GCode{96, GKind::spindle_mode, u8(ir::SpindleMode::css), GGroup::spindle, GMachine::both, "constant cutting speed",
          "7"},
    GCode{97, GKind::spindle_mode, u8(ir::SpindleMode::rpm), GGroup::spindle, GMachine::both, "spindle rev/min", "7"},
    GCode{98, GKind::lathe_transform, 0, GGroup::lathe, GMachine::lathe, "first X for the C axis", "12.6"},
    GCode{997, GKind::concatenation, 0, GGroup::special, GMachine::both, "run what G999 stored", "5.1"},
    GCode{998, GKind::concatenation, 0, GGroup::special, GMachine::both, "allow running under G999", "5.1"},
    GCode{999, GKind::concatenation, 0, GGroup::special, GMachine::both, "suspend running", "5.1"},
};

/// Codes of macros: G100..G255 call %10100..%10255.
inline constexpr int g_macro_first = 100, g_macro_last = 255;

namespace detail {
constexpr auto make_g_index() {
  std::array<std::int8_t, 1000> index{};
  for (auto& i : index) i = -1;
  for (std::size_t i = 0; i < g_codes.size(); ++i) {
    index[static_cast<std::size_t>(g_codes[i].code)] = static_cast<std::int8_t>(i);
  }
  return index;
}
inline constexpr auto g_index = make_g_index();
}  // namespace detail

/// The row of a code; nullptr when the control has none.
inline constexpr const GCode* g_code(double number) {
  if (!(number >= 0 && number < 1000)) return nullptr;
  const auto n = static_cast<std::size_t>(number);
  if (static_cast<double>(n) != number || detail::g_index[n] < 0) return nullptr;
  return &g_codes[static_cast<std::size_t>(detail::g_index[n])];
}

/// The functions that only lathes have.
inline std::vector<int> lathe_codes() {
  std::vector<int> codes;
  for (const auto& row : g_codes) {
    if (row.machine == GMachine::lathe) codes.push_back(row.code);
  }
  return codes;
}

/// What is missing for this function: a key of the registry of missing features; empty: it is carried.
constexpr std::string_view missing_feature(const GCode& row) {
  switch (row.kind) {
    case GKind::turning_cycle: return "";
    case GKind::milling_cycle: return row.code == 46 ? "cycle.milling" : "";
    case GKind::transform:
    case GKind::grinding_axis:
    case GKind::lathe_transform: return "motion.transformation";
    case GKind::concatenation: return "language.statement";
    case GKind::hole_cycle: return "";
    default: return {};
  }
}

/// Why a function is not carried, or what of one that is carried in part.
struct GRemark {
  std::int16_t code;
  std::string_view text;
};
inline constexpr std::array g_reasons{
    GRemark{5, "the angle of the inclined axis and its first position are not described"},
    GRemark{7, "as G05"},
    GRemark{24, "an option of the control; neither its words nor its rotations are described"},
    GRemark{26, "an option of the control; what it does to the programmed point is not described"},
    GRemark{46, "the words of its parts (NU0 to NU9) and its path are not described"},
    GRemark{98, "what X says of the face or the cylinder is not described"},
    GRemark{997, "what the control stores under G999 is not described"},
    GRemark{998, "as G997"},
    GRemark{999, "as G997"},
};
constexpr std::string_view g_reason(std::int16_t code) {
  for (const auto& r : g_reasons) {
    if (r.code == code) return r.text;
  }
  return {};
}
inline constexpr std::array g_remarks{
    GRemark{0, "EA ES ET E+ E-: contours whose points follow from up to 3 later elements (NUM-043, RUN-031)"},
    GRemark{1, "as G0"},
    GRemark{2, "as G0; R with ET: an arc between two elements"},
    GRemark{3, "as G2"},
    GRemark{6, "the curve between the points is not described"},
    GRemark{10, "a line at feed that a contact ends; not with a condition (NUM-045)"},
    GRemark{12, "left out with a warning (NUM-034)"},
    GRemark{16, "cycles work along it; a translation needs the plane whose normal it is (NUM-038)"},
    GRemark{29, "lines; the run shows the programmed points, no translation carries the correction (NUM-060)"},
    GRemark{31, "its passes are those of options (num.g31, NUM-071); EF is not carried"},
    GRemark{43, "as G29"},
    GRemark{63, "its passes are those of options (num.g63, NUM-071); EX is not carried"},
    GRemark{66, "its plunges are those of options (num.g66, NUM-071); EX and EZ are not carried"},
    GRemark{75, "left out with a warning (NUM-033)"},
    GRemark{76,
            "with H: kept as text, it changes another program (NUM-034); into this program: kept as text too, a run "
            "stops there (NUM-004)"},
    GRemark{78, "kept as text, no effect on the path (NUM-034)"},
    GRemark{83, "P and Q of one size, or falling; a last peck of its own (num.peck_law = constant) is refused"},
    GRemark{92, "R counts for all arcs (NUM-032)"},
    GRemark{96, "X beside it is no move (NUM-031)"},
};
constexpr std::string_view g_remark(std::int16_t code) {
  for (const auto& r : g_remarks) {
    if (r.code == code) return r.text;
  }
  return {};
}

}  // namespace cnctrans::dialects::num
