// A word block: modal settings, machine functions and at most one motion. The hottest type of the program: in a
// stream the same Block is filled again and again, so its vectors keep their memory.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/span.h"
#include "ir/axis.h"
#include "ir/cycle.h"
#include "ir/modal.h"
#include "ir/value.h"

namespace cnctrans::ir {

// --- motion ---------------------------------------------------------------------------------------------------

enum class WordMode : std::uint8_t { modal, absolute, incremental };  ///< modal: by Setting::distance
enum class WordScale : std::uint8_t { modal, radius, diameter };      ///< modal: by Setting::diameter
enum class RotaryDirection : std::uint8_t { as_value, positive, negative, shortest, by_sign };

/// Who moves the axis of a word.
enum class Positioning : std::uint8_t {
  with_path,         ///< it is one of the axes of the path
  alone,             ///< by itself, at its own feed; the block ends when it has arrived
  alone_not_awaited  ///< by itself; the block does not wait for it
};

/// The end point of one axis.
struct CoordWord {
  AxisId axis = axis::x;
  WordMode mode = WordMode::modal;
  WordScale scale = WordScale::modal;
  RotaryDirection direction = RotaryDirection::as_value;
  Positioning positioning = Positioning::with_path;
  Value value;
  WordPos pos;
};
/// The end point of an axis that a variable names.
struct ComputedWord {
  ExprPtr axis;
  WordMode mode = WordMode::modal;
  Value value;
  WordPos pos;
};

enum class CenterMode : std::uint8_t {
  from_start,       ///< offset from the start of the arc
  absolute,         ///< coordinate in the current work frame
  follows_distance  ///< absolute in absolute mode, offset in incremental mode
};
/// One coordinate of an arc's centre (I -> axis X, J -> Y, K -> Z).
struct CenterWord {
  AxisId axis = axis::x;
  CenterMode mode = CenterMode::from_start;
  WordScale scale = WordScale::radius;
  Value value;
  WordPos pos;
};

/// Which offsets count for this block.
enum class FrameUse : std::uint8_t {
  normal,
  machine,              ///< machine coordinates, tool length off
  machine_with_length,  ///< machine coordinates, tool length stays
  no_programmable,      ///< settable offset stays, programmable frame off
};

/// The polynomial by which an axis runs: start + a1 p + a2 p^2 .. a5 p^5, the parameter p from 0 to the interval. The
/// end is the coordinate word of the axis; a1 follows from it.
struct PolynomialWord {
  AxisId axis = axis::none;    ///< none: the common denominator of the geometry axes, 1 at its start
  Value end;                   ///< of the denominator only
  Value a2, a3, a4, a5;        ///< in the units of the axis' words
  std::uint8_t degree = 1;     ///< 1..5: as many coefficients are written
  bool after_address = false;  ///< written behind the address of the axis, not the axis inside of the word
  WordPos pos;
};

/// What only some motions need.
struct MotionExtra {
  // arcs
  bool has_turns = false;
  Value turns;  ///< full turns added to the arc
  bool has_pitch = false;
  Value pitch;  ///< helix: travel along the normal per turn, unsigned; turns follow from it
  bool has_angle = false;
  Value opening_angle;  ///< degrees, unsigned
  bool opening_signed = false;
  std::vector<CenterWord> through;  ///< a point on the arc (three-point arc)
  // polar
  bool has_polar_radius = false, has_polar_angle = false;
  Value polar_radius, polar_angle;
  WordMode polar_mode = WordMode::modal;        ///< of the radius
  WordMode polar_angle_mode = WordMode::modal;  ///< of the angle
  // line by angle and one coordinate
  bool has_line_angle = false;
  Value line_angle;
  // threads
  bool has_lead = false;
  Value lead;  ///< mm per rev
  AxisId lead_axis = axis::none;
  Value lead_change;  ///< per rev
  bool has_start_angle = false;
  Value start_angle;  ///< degrees
  // probing
  Value probe_tolerance;
  bool has_probe_edge = false;
  Value probe_edge;  ///< a move of another kind that measures: number of the probe, negative on its falling edge
  bool probe_goes_on = false;  ///< the move is carried out to its end
  // fixed points of the machine
  bool has_fixed_point = false;
  Value fixed_point;  ///< 1..
  // axes that variables name
  std::vector<ComputedWord> computed;
  // polynomials and splines
  std::vector<PolynomialWord> polynomials;
  bool has_interval = false;
  Value interval;  ///< polynomial: the parameter runs from 0 to it (1 without); B-spline: length of the knot span
  bool has_weight = false;
  Value weight;  ///< B-spline: of the control point of this block (1 without)
  bool has_degree = false;
  Value degree;  ///< B-spline: 1..3 (3 without)
};

struct Motion {
  MotionKind kind = MotionKind::modal;
  bool explicit_code = false;  ///< the source wrote the code
  bool radius_given = false;   ///< arc by radius; negative radius: the arc over 180 degrees
  bool keeps_modal = true;     ///< `kind` stays in force after the block (false: one-shot)
  FrameUse frame = FrameUse::normal;
  WordPos code_pos;
  std::string_view code_text;  ///< "G01" as written
  WordPos frame_pos;
  std::vector<CoordWord> coords;
  std::vector<CenterWord> centers;
  Value radius;
  WordPos radius_pos;
  std::shared_ptr<const MotionExtra> extra;

  void clear() {
    kind = MotionKind::modal;
    explicit_code = radius_given = false;
    keeps_modal = true;
    frame = FrameUse::normal;
    code_pos = frame_pos = radius_pos = {};
    code_text = {};
    coords.clear();
    centers.clear();
    radius = Value{};
    extra.reset();
  }
  [[nodiscard]] bool moves() const { return !coords.empty() || !centers.empty() || extra != nullptr; }
};

// --- actions --------------------------------------------------------------------------------------------------

struct ModalSet {
  Setting setting = Setting::plane;
  std::uint8_t value = 0;
  bool feed_too = true;                         ///< units: F as well
  FeedMemory feed_memory = FeedMemory::shared;  ///< feed_mode
};
struct SetFeed {
  Value value;
  bool zero_is_maximum = false;
  bool block_only = false;  ///< the feed of before comes back after the block
};
struct SetSpindle {
  std::uint8_t number = 1;
  Value value;
};
enum class SpindleState : std::uint8_t { off, cw, ccw };
struct SpindleRun {
  std::uint8_t number = 1;
  SpindleState state = SpindleState::off;
};
struct SpindleOrient {
  std::uint8_t number = 1;
  Value angle;               ///< degrees
  bool incremental = false;  ///< from the angle at which it stands
};
struct SpindleLimit {
  std::uint8_t number = 1;
  Value value;  ///< rpm
  bool lower = false;
};
struct SpindleGear {
  std::uint8_t number = 1;
  std::int32_t gear = 0;
  bool automatic = false;
};
/// The spindle that feeds per revolution, threads and the constant cutting speed follow from here on.
struct MasterSpindle {
  std::uint8_t number = 1;
};
/// `changes`: selecting carries out the change (turret).
struct ToolSelect {
  Value number;
  std::string_view name;  ///< by name when not empty
  bool changes = false;
};
struct ToolChange {};
struct ToolOffset {
  Value number;
};
/// Settable work offset: row `index` (1 = first), or none.
struct WorkOffset {
  Value index;
  bool off = false;
};
/// Slots of the programmable frame; the order in which they apply is the machine's (MachineProfile::frame_order).
enum class FrameSlot : std::uint8_t { preset, shift, rotation, scale, mirror, chain };
enum class FrameKind : std::uint8_t { translate, rotate, scale, mirror };
enum class FrameCombine : std::uint8_t {
  replace,        ///< the slot holds only this
  replace_named,  ///< named axes replaced, the others keep
  add,            ///< added to what is there
  compose,        ///< acts inside what is there (chain slot)
  clear,          ///< the slot (for `chain`: everything programmable) becomes neutral
  preset          ///< the present position gets these coordinates
};
struct FrameWord {
  AxisId axis = axis::x;
  Value value;  ///< mm, factor, or for mirror 1 = mirrored / 0 = not
  WordScale scale = WordScale::modal;
  WordPos pos;
};
struct FrameChange {
  FrameSlot slot = FrameSlot::shift;
  FrameKind kind = FrameKind::translate;
  FrameCombine combine = FrameCombine::replace;
  bool by_distance_mode = false;  ///< `replace_named` in absolute mode, `add` in incremental mode
  std::vector<FrameWord> words;   ///< translate, scale (per axis), mirror; rotation centre
  bool has_angle = false;
  Value angle;  ///< rotate: degrees in the plane in force, or about `rotation_axis`
  AxisId rotation_axis =
      axis::none;              ///< rotate about this axis whatever the plane; none: the normal of the plane in force
  bool uniform_scale = false;  ///< scale: words[0] holds for all axes
  bool fine = false;           ///< translate the chain, replace_named: its fine part; the coarse part stays
};
struct FrameOp {
  std::shared_ptr<const FrameChange> change;
};
/// A settable offset table entry written by the program.
struct OffsetTableWrite {
  std::int32_t row = 0;
  std::vector<FrameWord> words;
};
/// Pole of polar coordinates.
struct PoleSet {
  std::shared_ptr<const FrameChange> at;  ///< words u v; empty: the present point
};
/// `value * scale` seconds, or revolutions.
struct Dwell {
  Value value;
  double scale = 1;
  bool revolutions = false;
};
struct ExactStopBlock {};
enum class CoolantState : std::uint8_t { off, flood, mist, second };
struct Coolant {
  CoolantState state = CoolantState::off;
};
/// A machine function whose meaning only the profile can give (M and H functions).
struct MachineFunction {
  std::int32_t code = 0;
  std::int32_t extension = -1;
  bool auxiliary = false;  ///< an H function, value in `value`
  bool computed = false;   ///< the code itself is `value`
  Value value;
};
struct Stop {
  bool optional = false;
};
/// Defines a canned cycle. `modal`: it runs again by its trigger until cancelled. `here`: it runs in this block.
struct CycleDefine {
  CyclePtr cycle;
  bool modal = true;
  bool here = true;
  CycleTrigger trigger = CycleTrigger::plane_axis_word;
};
struct CycleCancel {};
enum class CornerKind : std::uint8_t { round, chamfer_leg, chamfer_chord };
struct Corner {
  CornerKind kind = CornerKind::round;
  bool modal = false;
  Value value;
  std::shared_ptr<const Value> feed;  ///< null: the feed of the block
};
enum class TangentEnd : std::uint8_t { entry, exit };
struct TangentialEnd {
  TangentEnd end = TangentEnd::entry;
  Value radius;
};
/// Look-ahead waits until the machine has caught up.
struct PreparationStop {};
/// Text of a word that is carried but not understood; never without a diagnostic.
struct OpaqueWord {
  std::string_view word;
};

struct SplineAxis {
  AxisId axis = axis::x;
};
/// The axes that later splines join; the others move along with them, straight in the parameter of the curve.
struct SplineAxes {
  std::vector<SplineAxis> axes;
};

/// Coordinates on a turning part with the C axis from here on, or (none) those of the axes again. The machine stands
/// still; its point is seen in the new coordinates.
struct SurfaceSet {
  Surface surface = Surface::none;
  Value diameter;  ///< cylinder: of the unrolled surface, in the unit of length; the number 0: on which X stands
};

/// One of the actions. Its special members are compiled once (ir/block.cpp): nearly every source file copies and moves
/// blocks, and making them anew in each costs a third of the build.
struct ActionData : std::variant<ModalSet, SetFeed, SetSpindle, SpindleRun, SpindleOrient, SpindleLimit, SpindleGear,
                                 MasterSpindle, ToolSelect, ToolChange, ToolOffset, WorkOffset, FrameOp, PoleSet, Dwell,
                                 ExactStopBlock, Coolant, MachineFunction, Stop, CycleDefine, CycleCancel, Corner,
                                 TangentialEnd, PreparationStop, OpaqueWord, SplineAxes, SurfaceSet> {
  using variant::variant;
  ActionData();
  ActionData(const ActionData&);
  ActionData(ActionData&&) noexcept;
  ActionData& operator=(const ActionData&);
  ActionData& operator=(ActionData&&) noexcept;
  ~ActionData();
};

/// When an action is carried out relative to the motion of its block.
enum class Order : std::uint8_t { before, with, after };

struct Action {
  ActionData data;
  Order order = Order::before;
  WordPos pos;
  std::string_view text;  ///< the word as written ("M03"); empty when made or changed by a pass
};

/// `actions` stand in the order they are carried out (all `before` and `with` ones, then the motion, then `after`);
/// `pos` keeps the place in the source line, by which a writer orders its words.
struct Block {
  std::vector<Action> actions;
  Motion motion;
  bool has_motion = false;
  std::uint32_t repeat_given = 0;  ///< 1: the block is carried out `repeat` times (0 times: position only)
  Value repeat;

  void clear() {
    actions.clear();
    motion.clear();
    has_motion = false;
    repeat_given = 0;
    repeat = Value{};
  }
  [[nodiscard]] bool empty() const { return actions.empty() && !has_motion; }
};

}  // namespace cnctrans::ir
