// What a target language can say. A backend publishes one; the passes rewrite what is missing.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ir/program.h"

namespace cnctrans::ir {

/// How an expression may be built.
enum class ExpressionForm : std::uint8_t {
  full,          ///< precedence and parentheses
  left_to_right  ///< one chain, strictly from left to right, no parentheses; a function binds the next primary
};
enum class ConditionForm : std::uint8_t {
  expression,      ///< any boolean expression
  single_relation  ///< operand relation expression, one relation, no AND/OR; structured statements take several of
                   ///< variables and numbers, joined by AND and OR from left to right
};
enum class ArgumentForm : std::uint8_t {
  none,       ///< no arguments: variables are shared
  letters,    ///< A..Z set local parameters
  positional  ///< formal parameters in order
};
enum class OutputForm : std::uint8_t {
  one_file_with_subs,    ///< subprograms follow the main program in its file
  one_file_per_program,  ///< each subprogram is a file
  programs_in_one_file   ///< whole programs one after the other in a file
};

/// How the coordinates of a SurfaceSet are said.
enum class SurfaceForm : std::uint8_t {
  none,          ///< not at all
  y_words,       ///< by a word of its own; X, Y, Z
  y_from_x,      ///< the same, and the cylinder is that on which X stands
  c_with_plane,  ///< with the plane; the second coordinate is a word of C, and the plane of the cylinder is Z C
};

/// A pool of numbers of a target variable space that a pass may hand out.
struct VariablePool {
  std::string prefix;  ///< space prefix
  std::int64_t lo = 0, hi = 0;
  Scope scope = Scope::global;
  bool temporaries = false;           ///< preferred for temporaries
  bool outside_compensation = false;  ///< can't be used while radius compensation is on
};

/// A machine datum in the target's words: its name, and how many of its units make a millimetre or a degree.
struct DataForm {
  std::string text;
  double units = 1;
  bool writable = false;
};

struct Capabilities {
  std::string dialect;

  // statements
  bool structured_if = false;       ///< IF ... ELSE ... ENDIF
  bool one_line_if_action = false;  ///< IF c assignment [ELSE assignment]
  bool while_loop = false, until_loop = false, for_loop = false, endless_loop = false;
  bool for_step = false;       ///< a FOR with a step other than 1
  bool loop_exit = false;      ///< Exit
  bool switch_jump = false;    ///< Switch node
  bool computed_jump = false;  ///< label number from an expression
  bool repeat_range = false;   ///< Repeat in place
  bool repeat_other_program = false;
  bool repeat_count_expression = false;   ///< else a number or a variable
  bool repeat_count_variable = true;      ///< ... or only a number
  bool repeat_ends_here = false;          ///< a Repeat carries out what stands right before it, nothing else
  bool repeat_needs_identifiers = false;  ///< the labels of a Repeat must be identifiers
  std::int64_t repeat_max = 9999;         ///< largest count of a Repeat or a call
  bool block_repeat = false;              ///< Block::repeat
  bool modal_call = false;
  bool modal_call_here = false;        ///< a modal call also runs where it stands
  bool modal_cycle_by_call = false;    ///< a modal cycle is written as a modal call (definition does not run by itself)
  bool cycle_each_call = false;        ///< no cycle is modal: each point has a call of its own behind its move
  bool declares_variables = false;     ///< Declare, named variables
  bool assignment_joins_words = true;  ///< an assignment may share a line with words
  bool several_assignments = true;
  bool statement_joins_words = false;  ///< a jump, call or end may share a line with words
  ConditionForm conditions = ConditionForm::expression;
  std::set<Search> searches;  ///< how jumps may search
  bool identifier_labels = false;
  bool number_labels = true;
  std::int64_t label_max = 99999999;
  std::string label_prefix = "LAB";  ///< identifier labels that a pass makes: LAB1, LAB20
  bool duplicate_labels = false;
  /// The name of the target that a label or subprogram gets; empty: none of it can be. Unset: every name will do.
  std::function<std::string(std::string_view)> plain_name;

  // expressions
  ExpressionForm expressions = ExpressionForm::full;
  bool word_expression = false;    ///< X=R1*2
  bool word_variable = true;       ///< XP100, X L1
  bool word_variable_sign = true;  ///< X-P100
  bool word_indirect = false;      ///< a variable with a computed index in a word or an expression
  bool word_indirect_value =
      true;  ///< with word_indirect: as the value of a word too (X=R[R1]), not only in expressions
  bool relation_as_value = false;  ///< stores 1/0
  std::set<UnaryOp> unary;
  std::set<BinaryOp> binary;
  std::set<Function> functions;
  Compare compare = Compare::exact;
  std::int32_t constant_decimals = 15;  ///< places of a constant inside an expression
  double constant_max = 1e300;          ///< largest constant inside an expression
  bool condition_right_chain = false;   ///< single_relation: the right side may be a chain, else a number or variable
  std::function<bool(const SystemRef&)> system_data;  ///< machine data that the backend can name; empty: none
  /// Machine data that the backend can name in a unit of its own; empty: none.
  std::function<std::optional<DataForm>(const SystemRef&)> data_form;
  /// The present place of an axis as the program counts it, as a formula of data that the backend can name (mm,
  /// degrees): for where the frame only shifts and no gauge of a tool counts; nullptr: none.
  std::function<ExprPtr(AxisId)> work_position;
  std::int32_t word_decimals = 4;  ///< places of a metric length word
  std::int32_t word_decimals_inch = 5;

  // calls
  ArgumentForm arguments = ArgumentForm::none;
  bool local_levels = false;       ///< CallLevel::new_level exists
  bool shared_level_calls = true;  ///< CallLevel::shared exists (callee sees the caller's locals)
  bool call_count = true;
  bool call_range = false;  ///< CallRoutine::has_range
  bool computed_call = false;
  bool heading_below_header = true;  ///< comments about a routine stand below its header, not above it
  bool named_routines = false;
  bool early_return = false;
  bool end_in_sub_ends_all = true;
  std::int64_t routine_number_min = 1, routine_number_max = 9999;
  OutputForm output = OutputForm::one_file_per_program;
  std::vector<VariableSpace> spaces;  ///< the target's spaces, in the order its Program::spaces shall have
  std::vector<VariablePool> pools;

  // words
  /// An action that must stand alone in its block (no motion, no other action beside it). Empty: none.
  std::function<bool(const Action&)> own_block;
  /// Motions that the backend writes.
  std::set<MotionKind> motions = {MotionKind::modal, MotionKind::rapid, MotionKind::linear, MotionKind::arc_cw,
                                  MotionKind::arc_ccw};
  std::set<FrameUse> frame_uses = {FrameUse::normal};
  std::set<CornerKind> corners;
  bool motion_in_each_block = false;  ///< no motion code stays in force
  bool thread_stays = true;           ///< that of a thread does
  bool corner_modal = false;          ///< a corner function that stays in force
  bool corner_feed = false;           ///< a feed of the corner's own
  bool polar = false, line_angle = false;
  bool distance_per_word = false;      ///< X=IC(..)
  bool distance_inside_block = false;  ///< G90/G91 act from their place in the block on
  std::set<CenterMode> centers;        ///< arc centre forms
  bool radius_minor = true, radius_major = true;
  bool arc_through_point = false, arc_tangent = false;
  bool tangential_ends = false;  ///< arcs into and out of a contour that a word beside a straight move adds
  bool arc_angle = false;
  bool helix_turns = false, helix_pitch = false;
  bool helix_angle = false;            ///< ... or by the angle through which it turns, beyond 360 degrees
  bool full_circle_needs_end = false;  ///< both end coordinates must be written
  /// What a centre word of each form means on a diameter axis; modal: as the end point. Not named: radius.
  std::map<CenterMode, WordScale> center_scales;
  bool diameter_switch = true;  ///< Setting::diameter can be written
  bool diameter_absolute_only = false;
  DiameterMode fixed_diameter = DiameterMode::radius;  ///< lathe mode of a control without a switch
  SurfaceForm surfaces = SurfaceForm::none;
  bool machine_move_ends_offset = false;  ///< the line behind a move of the machine selects the tool offset
  bool surface_x_radius = false;          ///< X of the face is a radius whatever the diameter mode
  bool surface_needs_radius = false;      ///< the diameter mode must be off on the face
  bool surface_clears_frames = false;     ///< SurfaceSet deselects work offset and programmable frame
  bool exact_stop_modal = true, exact_stop_block = false;
  double dwell_unit = 1;  ///< seconds of one unit of the dwell word
  double dwell_min = 0, dwell_max = 99999;
  bool dwell_revolutions = false;
  bool inverse_time = true;
  bool length_comp_switch = false;  ///< Setting::length_comp can be written
  bool frame_rotation = true;
  /// Programmable frame: which slot takes which operations. Empty slot: the target has none.
  std::map<FrameSlot, std::set<FrameCombine>> frames;
  bool shift_survives_end = false;      ///< the programmable shift holds on after the end of the program
  bool work_offset_ends_shift = false;  ///< a programmable shift is taken back where a work offset is selected
  std::int32_t work_offset_rows = 99;   ///< settable offsets that a program can select
  bool work_offset_off = true;
  bool units_with_feed = true;        ///< a unit switch that holds for F as well
  bool units_geometry_only = false;   ///< a unit switch that leaves F alone
  bool retract_plane_switch = false;  ///< Setting::retract_plane can be written
  bool feed_point_switch = false, feed_override_switch = false;
  bool gear_needed = false;  ///< a gear range must be programmed (profile option "default_gear")
  FeedMemory feed_memory = FeedMemory::shared;
  bool frame_chain = false;  ///< FrameSlot::chain (else shift/rotation/scale/mirror slots)
  bool spindle_limit = true;
  std::int32_t skip_levels = 1;
  bool skip_several = false;  ///< several levels on one block
  bool skip_on_structures = true;
  bool messages = true;         ///< a program can show texts
  bool message_values = false;  ///< values inside messages
  std::size_t message_length = 200;
  std::size_t block_length = 512;
  /// A cycle the backend writes natively with exactly the moves of its expansion. Default: none.
  std::function<bool(const Cycle&)> native_cycle;
};

}  // namespace cnctrans::ir
