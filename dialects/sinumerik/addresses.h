// Addresses of more than one letter, position attributes, procedures without effect on the path
// (reference-language 1.5, 14; motion 5).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace cnctrans::sinumerik {

enum class NamedWord : std::uint8_t {
  arc_radius,
  opening_angle,
  turns,
  polar_radius,
  polar_angle,
  line_angle,
  round,
  round_modal,
  chamfer_leg,
  chamfer_chord,
  corner_feed,
  corner_feed_modal,
  thread_start,
  spindle_limit,
  spindle_position,
  rotation_in_plane,
  block_feed,
  tooth_feed,     ///< FZ: feed for each tooth of the tool
  cutting_speed,  ///< SVC: speed at the cutting edge of the tool
  fixed_point,
  probe,
  probe_to_end,
  point_weight,
  spline_degree,
  interval,      ///< of a polynomial's parameter, between the knots of a B-spline
  orientation,   ///< of the tool under a transformation: kept
  timing,        ///< tolerances, overrides, accelerations: the nominal path is the same
  joint,         ///< how a machine reaches the programmed end
  compensation,  ///< acts only on the compensated path
  unsupported
};
struct NamedWordRow {
  std::string_view name;  ///< capitals
  NamedWord use;
};
std::span<const NamedWordRow> named_words();
/// Any case; null when it is no address of the control.
const NamedWordRow* named_word(std::string_view name);

/// `ACC[X]=50`: a limit or tolerance of one axis that leaves the nominal path alone (capitals).
bool is_timing_of_axis(std::string_view capitals);

/// `X=AC(10)`: how a position is meant.
enum class Attribute : std::uint8_t { none, ac, ic, dc, acp, acn, dac, dic, rac, ric, unsupported };
/// Capitals; `none` when the function is no position attribute.
Attribute attribute(std::string_view name);
/// By its number in GP(position, number); `unsupported` for the others.
Attribute attribute(double number);

/// What a predefined procedure (`NAME(...)` or `NAME`) is to a translation.
enum class Procedure : std::uint8_t {
  none,  ///< not predefined: a subprogram
  message,
  set_alarm,
  stop_preparation,
  repeat_return,
  program_start,
  master_spindle,
  axis_setting,    ///< DIAMONA[X], SCC[X]: a setting of one axis
  screen,          ///< operator screens, blanks, groups: no effect on machining
  timing,          ///< dynamics, feed groups, single-block and display switches
  transformation,  ///< the programmed positions stay those of the tool; the frames in force are deselected (motion 9.1)
  coordination,    ///< other channels, interrupts, exchange of axes: no move of its own
  spline_axes,     ///< SPLINEPATH
  polynomial_path,  ///< POLYPATH
  geometry_axes,    ///< GEOAX: another axis in the place of X, Y or Z
  preset,           ///< PRESETON: the present machine position gets another value
  unsupported       ///< acts on the machine and is not carried
};
struct ProcedureRow {
  std::string_view name;
  Procedure use;
};
std::span<const ProcedureRow> procedures();
Procedure procedure(std::string_view capitals);

/// Entry of the missing-features registry that a procedure of Procedure::unsupported stands under (capitals).
std::string_view procedure_missing_feature(std::string_view capitals);

/// True when a user variable, label or subprogram may not have this name (capitals).
bool is_reserved(std::string_view capitals);
/// A function, procedure or address of the control that is not carried yet.
bool is_predefined(std::string_view capitals);
/// All of them, and the functions of axes and frames that are carried; both in alphabetical order.
std::span<const std::string_view> predefined_names();
std::span<const std::string_view> axis_and_frame_functions();

}  // namespace cnctrans::sinumerik
