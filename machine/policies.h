// The named options of a profile (options.cpp: values and meanings), read once where the profile is made. The option
// "frame.preset" is the field frame_preset, its values are those of FramePreset, in the order of the table.
#pragma once

#include <cstdint>
#include <string>

namespace cnctrans::machine {

enum class ArcTangentStraight : std::uint8_t { error, line };
enum class ArcThroughPoint : std::uint8_t { in_plane, in_space };
enum class CallMissing : std::uint8_t { error, passed_over };
enum class CallModalInModal : std::uint8_t { allowed, refused };
enum class CallUncalledState : std::uint8_t { when_needed, unknown, power_on };
enum class CompInterruptions : std::uint8_t { taken, refused };
enum class CompRapid : std::uint8_t { kept, suspended };
enum class CompRotation : std::uint8_t { kept, ended };
enum class CornerStraightOn : std::uint8_t { left_out, refused };
enum class CornerWithoutSuccessor : std::uint8_t { error, left_out };
enum class CycleAxisWord : std::uint8_t { moves, refused };
enum class CycleBelowReference : std::uint8_t { passes, refused };
enum class CycleFaceGrooveLeft : std::uint8_t { unknown, larger_x, smaller_x };
enum class CycleGrooveDepth : std::uint8_t { smaller, absolute, increment };
enum class CycleGrooveEdge : std::uint8_t { minus, plus };
enum class CycleGroovePosition : std::uint8_t { as_shaped, mirrored };
enum class CycleLevels : std::uint8_t { as_written, by_mode };
enum class CyclePartingAfter : std::uint8_t { kept, restored };
enum class CyclePartingPart : std::uint8_t { plus, minus };
enum class CyclePartingRetract : std::uint8_t { always, by_variant };
enum class CyclePartingSpeed : std::uint8_t { by_limit, by_mode };
enum class CyclePlaneFunction : std::uint8_t { keeps, ends };
enum class CyclePocketEntry : std::uint8_t { arc, straight };
enum class CyclePocketLinks : std::uint8_t { at_depth, over };
enum class CyclePositioning : std::uint8_t { modal, rapid };
enum class CycleReliefEdge : std::uint8_t { usual, refused };
enum class CycleStops : std::uint8_t { needed, all };
enum class CycleUnknownRadius : std::uint8_t { assumed, stop };
enum class FeedMixedAxes : std::uint8_t { resultant, linear };
enum class FileLines : std::uint8_t { opened, named };
enum class FrameChangeKeeps : std::uint8_t { machine, programmed };
enum class FrameFirstArc : std::uint8_t { any, absolute_centre };
enum class FrameMirrorOrder : std::uint8_t { stated, assumed_with_rotation, assumed };
enum class FramePlaneChange : std::uint8_t { keeps, may_end_rotation };
enum class FramePreset : std::uint8_t { own, with_work_offset };
enum class FrameRotationCentre : std::uint8_t { as_written, scaled_and_mirrored };
enum class FrameShift : std::uint8_t { as_said, by_distance };
enum class HelixPitchMismatch : std::uint8_t { error, nearest };
enum class MachineDataUnits : std::uint8_t { modal, machine, with_feed };
enum class MachineMoveUnits : std::uint8_t { modal, machine };
enum class MachineMoveWords : std::uint8_t { modal, absolute };
enum class MachinePositionScale : std::uint8_t { radius, words };
enum class PolarRadius : std::uint8_t { present, programmed };
enum class RotaryDirection : std::uint8_t { by_sign, in_word };
enum class RoundUpNegative : std::uint8_t { stated, unstated };
enum class RunFaults : std::uint8_t { before, when_reached };
enum class StopSpindle : std::uint8_t { goes_on, stops };
enum class ThreadPitch : std::uint8_t { each_block, modal };
enum class ThreadStartAngle : std::uint8_t { block, modal };
enum class ToolBareOffset : std::uint8_t { kept, table, edge };
/// A T carries the change out, or a command behind it does.
enum class ToolChange : std::uint8_t { on_select, by_command };
enum class ToolLengthAxis : std::uint8_t { tool, plane };
enum class ToolOffset : std::uint8_t { row, edge };
enum class WorkOffsetWrite : std::uint8_t { on_select, at_once };

/// How a machine and its control behave where programs alone do not tell. Defaults: what holds when a profile does not
/// say.
struct Policies {
  ArcTangentStraight arc_tangent_straight = ArcTangentStraight::error;
  ArcThroughPoint arc_through_point = ArcThroughPoint::in_plane;
  double block_m_functions = 0;
  double block_machine_functions = 0;
  std::string call_decoration;
  CallMissing call_missing = CallMissing::error;
  CallModalInModal call_modal_in_modal = CallModalInModal::allowed;
  bool call_modal_words = false;
  bool call_saves_modals = false;
  CallUncalledState call_uncalled_state = CallUncalledState::when_needed;
  double calls_local_levels = 0;
  CompInterruptions comp_interruptions = CompInterruptions::taken;
  CompRapid comp_rapid = CompRapid::kept;
  CompRotation comp_rotation = CompRotation::kept;
  double compare_equal_within = 0;
  bool corner_chamfer_at_arc = false;
  CornerStraightOn corner_straight_on = CornerStraightOn::left_out;
  CornerWithoutSuccessor corner_without_successor = CornerWithoutSuccessor::error;
  CycleAxisWord cycle_axis_word = CycleAxisWord::moves;
  CycleBelowReference cycle_below_reference = CycleBelowReference::passes;
  CycleFaceGrooveLeft cycle_face_groove_left = CycleFaceGrooveLeft::unknown;
  CycleGrooveDepth cycle_groove_depth = CycleGrooveDepth::smaller;
  double cycle_groove_dwell = 0;
  CycleGrooveEdge cycle_groove_edge = CycleGrooveEdge::minus;
  CycleGroovePosition cycle_groove_position = CycleGroovePosition::as_shaped;
  CycleLevels cycle_levels = CycleLevels::as_written;
  CyclePartingAfter cycle_parting_after = CyclePartingAfter::kept;
  CyclePartingPart cycle_parting_part = CyclePartingPart::plus;
  CyclePartingRetract cycle_parting_retract = CyclePartingRetract::always;
  CyclePartingSpeed cycle_parting_speed = CyclePartingSpeed::by_limit;
  CyclePlaneFunction cycle_plane_function = CyclePlaneFunction::keeps;
  CyclePocketEntry cycle_pocket_entry = CyclePocketEntry::arc;
  CyclePocketLinks cycle_pocket_links = CyclePocketLinks::at_depth;
  double cycle_pocket_tolerance = 0.001;
  CyclePositioning cycle_positioning = CyclePositioning::modal;
  CycleReliefEdge cycle_relief_edge = CycleReliefEdge::usual;
  bool cycle_rotary_triggers = false;
  CycleStops cycle_stops = CycleStops::needed;
  CycleUnknownRadius cycle_unknown_radius = CycleUnknownRadius::assumed;
  FeedMixedAxes feed_mixed_axes = FeedMixedAxes::resultant;
  FileLines file_lines = FileLines::opened;
  FrameChangeKeeps frame_change_keeps = FrameChangeKeeps::machine;
  FrameFirstArc frame_first_arc = FrameFirstArc::any;
  FrameMirrorOrder frame_mirror_order = FrameMirrorOrder::stated;
  FramePlaneChange frame_plane_change = FramePlaneChange::keeps;
  FramePreset frame_preset = FramePreset::own;
  bool frame_preset_outlasts = false;
  FrameRotationCentre frame_rotation_centre = FrameRotationCentre::as_written;
  FrameShift frame_shift = FrameShift::as_said;
  HelixPitchMismatch helix_pitch_mismatch = HelixPitchMismatch::error;
  std::string machine_data_lengths;
  MachineDataUnits machine_data_units = MachineDataUnits::machine;
  MachineMoveUnits machine_move_units = MachineMoveUnits::modal;
  MachineMoveWords machine_move_words = MachineMoveWords::modal;
  MachinePositionScale machine_position_scale = MachinePositionScale::radius;
  /// Variables that a number names (R parameters): how many the machine has; 0: as many as the language knows.
  double numbered_variables = 0;
  double path_curve_tolerance = 0.001;
  bool polar_plane_resets_pole = false;
  bool polar_pole_follows_arc = false;
  bool polar_pole_stays = false;
  PolarRadius polar_radius = PolarRadius::present;
  RotaryDirection rotary_direction = RotaryDirection::by_sign;
  bool rotary_rollover = false;    ///< of every rotary axis: the sign of an absolute word is its direction
  std::string rotary_signed_axes;  ///< letters of the axes on which it is; "-" for none
  RoundUpNegative round_up_negative = RoundUpNegative::stated;
  RunFaults run_faults = RunFaults::before;
  std::string spindle_default_gear;  ///< word of the gear that is written where the source has none
  StopSpindle stop_spindle = StopSpindle::goes_on;
  ThreadPitch thread_pitch = ThreadPitch::each_block;
  ThreadStartAngle thread_start_angle = ThreadStartAngle::block;
  ToolBareOffset tool_bare_offset = ToolBareOffset::kept;
  ToolChange tool_change = ToolChange::by_command;
  ToolLengthAxis tool_length_axis = ToolLengthAxis::tool;
  ToolOffset tool_offset = ToolOffset::row;
  std::string tool_radius_data;
  std::string tool_width_data;
  bool work_offset_kept = false;
  WorkOffsetWrite work_offset_write = WorkOffsetWrite::on_select;

  bool operator==(const Policies&) const = default;
};

}  // namespace cnctrans::machine
