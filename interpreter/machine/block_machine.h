// The machine at block level: modal state, position, frame, spindle, tool, active cycle. It carries out one word block
// at a time and emits its events. It knows no control flow and no variables.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "base/diagnostics.h"
#include "interpreter/machine/emitter.h"
#include "interpreter/machine/open_curve.h"
#include "interpreter/trace/cycle_runs.h"
#include "interpreter/trace/failure.h"
#include "interpreter/trace/standing.h"
#include "interpreter/values/expressions.h"
#include "interpreter/values/frame.h"
#include "ir/analysis/block_coordinate.h"
#include "ir/block.h"
#include "ir/cycles/hole.h"
#include "ir/cycles/machining.h"
#include "ir/cycles/milling/mill_contour.h"
#include "ir/cycles/milling/milling.h"
#include "ir/cycles/pattern.h"
#include "ir/geometry/contour.h"
#include "ir/geometry/geometry.h"
#include "ir/program.h"
#include "machine/profile.h"
#include "machine/world.h"

namespace cnctrans::interpreter {

using namespace ir::geometry;

/// One motion, resolved in the work frame.
struct Move {
  enum class Kind : std::uint8_t { rapid, linear, arc, thread, probe };
  Kind kind = Kind::linear;
  Axes from{}, to{};
  ir::Plane plane = ir::Plane::xy;
  ir::CompSide comp = ir::CompSide::off;
  Vec centre;
  bool ccw = false;
  std::int32_t turns = 0;
  double feed = 0;
  std::optional<double> feed_degrees;  ///< instead of `feed` when only rotary axes move
  ir::FeedMode feed_mode = ir::FeedMode::per_minute;
  double pitch = 0, pitch_change = 0, start_angle = 0;
  bool toward = true;
  bool in_machine = false;  ///< programmed in machine coordinates
  PathStop stop;
  FileId file = 0;
  std::uint32_t line = 0;
};

class BlockMachine final : public SystemData {
 public:
  /// `world`: the one that the profile was put into; null: none.
  BlockMachine(const machine::Profile& profile, Emitter& emitter, Failure& failure, ValueSource* values,
               const machine::World* world = nullptr);

  /// Carries out one block. `with_cycle` false: positions only (a block repeated zero times). False on failure.
  bool block(const ir::Block& b, const Span& where, bool with_cycle = true);
  /// The block just carried out was a path motion (for modal calls).
  [[nodiscard]] bool moved() const { return block_moves_; }
  /// The block runs a modal subprogram: it moves, or has words that do the same on this machine.
  [[nodiscard]] bool runs_modal_call(const ir::Block& b) const {
    return block_moves_ || (policy_.modal_words && path_words(b));
  }
  /// A cycle that runs after every later block with path motion; null ends it.
  bool modal_cycle(const ir::CyclePtr& cycle, ir::CycleTrigger trigger, bool here);
  void cancel_cycle() { hole_.reset(); }
  void message(std::string text, const Span& where);
  /// Contours that several points fit were settled by the nearest one, here.
  [[nodiscard]] const std::vector<Span>& chosen_contours() const { return chosen_contours_; }
  /// The makers' manuals leave the way of splines between their points open: said once, at the first one.
  void tell_path(Diagnostics& diagnostics) const;
  /// The next spline block stands at its first point (a curve with a definition of its own); the curve ends.
  void begin_defined_curve() { curve_from_first_point_ = true; }
  bool end_defined_curve();
  /// The program has ended: nothing may wait for a next element.
  bool finish();
  void end_event(EndReason reason, const Failure& failure, const Span& where);

  [[nodiscard]] const ir::ModalState& modal() const { return modal_; }
  [[nodiscard]] Standing standing() const;
  void restore_modal(const ir::ModalState& state);
  /// The program and routine that the next block belongs to: cycles look up their profiles there.
  void belongs_to(const ir::Program* program, const ir::Routine* routine) {
    program_ = program;
    routine_ = routine;
  }
  /// Where programs that are not at hand are found; null: nowhere.
  void find_programs(const ir::ProgramFinder* library) { library_ = library; }
  /// Where the contours of milling cycles stand that are programs of their own.
  using ContourHomes = std::vector<std::pair<ir::RoutineName, const ir::Program*>>;
  void contour_homes(ContourHomes homes) { contour_homes_ = std::move(homes); }
  /// From now on the cycles of a lathe that are carried out are added there.
  void keep_cycles(std::vector<CycleRun>* runs) { cycle_runs_ = runs; }
  /// Without frames, tool and cycles, ready to read the blocks of a profile.
  void stand_for_contour(const ir::ModalState& state, std::optional<ir::cycles::TurnPoint> from);
  /// The same in the plane in force; where the tool stands is not known.
  void stand_for_mill_contour(const ir::ModalState& state, bool with_height);

  bool read(const ir::SystemRef& ref, std::span<const double> args, double& out) override;
  bool write(const ir::SystemRef& ref, std::span<const double> args, double value) override;
  bool read_frame(const ir::SystemRef& ref, std::span<const double> args, Frame& out) override;
  bool write_frame(const ir::SystemRef& ref, std::span<const double> args, const Frame& f) override;
  [[nodiscard]] double length_of(ir::AxisId axis, double value) const override;
  [[nodiscard]] std::string axis_name(ir::AxisId axis) const override;
  /// --set of a machine datum by its name.
  void preset_datum(const std::string& name, double value) {
    written_[name] = value;
    unread_.insert(name);
  }
  [[nodiscard]] bool preset_unread(const std::string& name) const { return unread_.count(name) != 0; }
  /// Data that nobody gave: the value of a machine at rest was taken, here for the first time.
  struct Assumed {
    Span where;
    std::string name;
    double value = 0;
    std::string hint;  ///< how to give another
  };
  [[nodiscard]] const std::vector<Assumed>& assumed() const { return assumed_; }
  /// The radius of a tool that nobody gives, and the first milling cycle that ran with it.
  struct AssumedRadius {
    Span where;
    std::int32_t tool = 0;
    double radius = 0;  ///< mm
  };
  [[nodiscard]] const std::vector<AssumedRadius>& assumed_radii() const { return assumed_radii_; }
  /// The program writes tables of zero points.
  [[nodiscard]] bool writes_zeros() const { return writes_zeros_; }
  std::uint64_t arguments_given = 0;  ///< of the present call level
  std::size_t calls_open = 0;
  std::string_view last_label;  ///< number of the numbered statement carried out last; empty: none yet
  bool block_again = false;     ///< a further pass of a repeated block: the cycle it defines is in force already
  bool single_points = false;   ///< a pattern stops at each point: a modal subprogram runs there
  /// The block goes on behind the modal subprogram: with the next point, or with what acts behind the last one.
  [[nodiscard]] bool points_left() const { return open_pattern_ != nullptr; }

 private:
  struct AxisState {
    bool present = false, rotary = false, diameter = false;
    double scale_absolute = 1, scale_incremental = 1;  ///< mm (radius) in one unit of a word under the modes in force
  };
  struct Spindle {
    ir::SpindleMode mode = ir::SpindleMode::rpm;
    ir::SpindleState state = ir::SpindleState::off;
    bool oriented = false;
    std::array<double, 2> value{};  ///< by SpindleMode
    bool has_limit = false;
    double limit = 0;
    double angle = 0;
    // as the last event showed it
    ir::SpindleMode shown_mode = ir::SpindleMode::rpm;
    double shown_value = 0, shown_limit = 0;
  };
  /// Options of the profile, looked up once.
  struct Policies {
    bool cycle_rapid = false, rotary_triggers = false, modal_words = false, keeps_programmed = false,
         centre_through_frame = false;
    bool nearest_pitch = false, machine_metric = false, pole_follows_arc = false, plane_resets_pole = false,
         pole_stays = false, start_angle_stays = false, position_as_words = false, machine_absolute = false,
         offsets_at_once = false, preset_is_offset = false, straight_tangents = false, polar_radius_stays = false;
    bool data_modal = false;                         ///< machine data in the units of the program
    bool table_offset = false, edge_offset = false;  ///< of a tool without a D
    bool mill = false;
    bool plane_ends_cycle = false, cycles_in_full = false;
  };
  struct Pending {
    Move move;
    ir::CornerKind corner = ir::CornerKind::round;
    bool tangential = false, exit = false, modal = false;
    double size = 0;
    bool has_feed = false;
    double feed = 0;
    std::uint64_t frame_serial = 0;
  };
  // values
  double value(const ir::Value& v) { return v.expr ? expression(v) : v.number; }
  double expression(const ir::Value& v);
  [[nodiscard]] double unit() const { return modal_.units == ir::Units::inch ? 25.4 : 1; }
  [[nodiscard]] double feed_unit() const;
  double coordinate(ir::AxisId a, const ir::Value& v, ir::WordScale scale, bool absolute);
  bool check_axis(ir::AxisId a);

  // machine data (machine_data.cpp)
  [[nodiscard]] const double* given_datum(const ir::SystemRef& ref, std::span<const double> args) const;
  bool read_position(const ir::SystemRef& ref, std::span<const double> args, double& out) const;
  bool read_technology(const ir::SystemRef& ref, std::span<const double> args, double& out) const;
  bool read_state(const ir::SystemRef& ref, std::span<const double> args, double& out) const;
  bool read_of_run(const ir::SystemRef& ref, std::span<const double> args, const std::string& name, double& out);
  bool read_at_rest(const std::string& name, double& out);
  bool place_in_table(ir::AxisId axis, std::span<const double> args, double& out) const;
  void assume(const std::string& name, double value, const std::string& hint = {});

  // actions (actions.cpp)
  friend struct ActionRunner;
  bool actions(const ir::Block& b, bool after);
  bool settings_first(const ir::Block& b);
  void set_modal(const ir::ModalSet& m, const ir::Block& b);
  void set_comp(ir::CompSide side);
  void set_feed(const ir::SetFeed& f);
  void feeds(const ir::Block& b, bool of_block);
  void set_spindle_value(const ir::SetSpindle& s);
  void set_spindle_limit(const ir::SpindleLimit& l);
  bool whole(double number, std::string_view what, std::int32_t& out);
  bool select_tool(const ir::ToolSelect& t);
  // the offset of the tool (tool_offset.cpp)
  void select_offset();
  void offset_of_selected(bool own);
  void offset_of_change(bool own);
  void put_offset(Event& e, std::uint32_t moved) const;
  [[nodiscard]] PathStop path_stop() const;
  bool machine_function(const ir::MachineFunction& m);
  bool define_cycle(const ir::CycleDefine& c);
  void set_corner(const ir::Corner& c);
  void set_tangential(const ir::TangentialEnd& t);
  bool set_work_offset(const ir::WorkOffset& w);
  bool profile_function(const machine::MCode& m);
  void set_units();
  void set_spindle_mode(ir::SpindleMode mode, bool with_value);
  Spindle* spindle(int number);
  void run_spindle(int number, ir::SpindleState state);
  void emit_spindle(int number);
  void turn_at(const ir::cycles::TurnMove& m);
  void emit_if_running(const ir::Block& b, int number, bool after);
  void emit_tool(bool change);
  void emit_coolant(std::string_view state);
  void emit_dwell(double amount, bool revolutions);
  void emit_stop(bool optional);
  Event& plain(EventKind kind);

  // frames (frames.cpp)
  bool change_frame(const ir::FrameChange& c);
  void set_pole(const ir::PoleSet& p);
  bool preset(const ir::FrameChange& c, Frame& slot);
  bool change_slot(const ir::FrameChange& c, ir::FrameCombine combine, Frame& slot);
  bool translate(const ir::FrameChange& c, ir::FrameCombine combine, Frame& slot);
  bool rotate(const ir::FrameChange& c, ir::FrameCombine combine, Frame& slot);
  bool stretch(const ir::FrameChange& c, ir::FrameCombine combine, Frame& slot);
  Frame inner_of(ir::FrameSlot slot) const;
  [[nodiscard]] Frame slot_frame(ir::FrameSlot slot) const;
  bool rebuild_frame();
  bool use_frame(const Frame& f);
  [[nodiscard]] Frame offset_frame() const;
  [[nodiscard]] Frame settable_frame() const;
  /// The base frames in force from this row on.
  [[nodiscard]] Frame base_frame(std::int32_t from = 0) const;
  void load_base();
  void load_offset(std::int32_t row);
  [[nodiscard]] Frame programmable_frame() const;

  // motion (motion.cpp, arcs.cpp, threads in motion.cpp)
  bool motion(const ir::Block& b, bool with_cycle);
  bool quick_line(const ir::Motion& m, bool rapid);
  [[nodiscard]] Move move_from_here() const;
  bool general_motion(const ir::Motion& m, ir::MotionKind kind);
  bool machine_move(const ir::Motion& m, ir::MotionKind kind);
  bool reference_move(const ir::Motion& m);
  bool fixed_point_move(const ir::Motion& m);
  bool to_machine_points(const ir::Motion& named, const std::vector<double>& points);
  bool positioning_moves(const ir::Motion& m);
  bool computed_words(const ir::Motion& m, Move& move);
  bool end_point(const ir::Motion& m, Move& move);
  [[nodiscard]] bool counts_absolutely(ir::WordMode mode) const {
    return mode == ir::WordMode::absolute || (mode == ir::WordMode::modal && modal_.distance == ir::Distance::absolute);
  }
  bool polar_end(const ir::Motion& m, Move& move);
  bool line_by_angle(const ir::Motion& m, Move& move);
  bool thread(const ir::Motion& m, bool variable, Move& move);
  double rotary_target(const ir::CoordWord& w, double v) const;
  bool arc(const ir::Motion& m, ir::MotionKind kind, Move& move);
  bool arc_centre(const ir::Motion& m, Move& move);
  bool polar_arc(const ir::Motion& m, Move& move);
  bool opening_arc(const ir::Motion& m, Move& move);
  bool through_arc(const ir::Motion& m, Move& move);
  bool tangent_arc(Move& move);
  bool arc_turns(const ir::Motion& m, Move& move);
  bool check_radii(const Move& move);
  Vec last_direction(const ir::PlaneAxes& plane) const;
  void arrived(const Move& move);
  [[nodiscard]] double feed_now() const { return feed_[static_cast<std::size_t>(modal_.feed_mode)]; }
  /// Of a move of rotary axes alone: degrees, whatever the unit of length.
  [[nodiscard]] double feed_degrees() const { return feed_degrees_[static_cast<std::size_t>(modal_.feed_mode)]; }

  // the face and the cylinder of a turning part (surfaces.cpp)
  bool set_surface(const ir::SurfaceSet& s);
  void leave_surface(Axes& machine);
  void enter_surface(ir::Surface surface, Axes& machine);
  void y_axis(bool present);
  bool surface_axis(ir::AxisId a);

  // splines and polynomials (curves.cpp)
  bool curve_allowed(const ir::Motion& m, bool spline);
  void begin_curve(ir::MotionKind kind);
  bool spline_words(const ir::Motion& m, double& weight, double& interval);
  bool spline_point(const ir::Motion& m, ir::MotionKind kind);
  bool leave_curve(ir::MotionKind kind);
  bool close_curve(const Move* next);
  bool split_curve();
  [[nodiscard]] Axes start_direction(const Move& move) const;
  bool polynomial(const ir::Motion& m);

  // contours whose points follow from later blocks (contours.cpp)
  struct OpenElement {
    Move move;
    ir::contour::Element data;
    std::optional<Pending> corner;
  };
  bool contour_element(const ir::Motion& m, ir::MotionKind kind, Move move);
  bool contour_data(const ir::Motion& m, ir::MotionKind kind, const Move& move, ir::contour::Element& e);
  bool close_contour();

  // path (path.cpp): corners and emission
  bool send(const Move& move);
  bool emit_move(const Move& move, bool past_held);
  void put_centre_side(Event& e, ir::CompSide side, ir::Plane plane) const;
  void add_travel(const Axes& from, const Event& e);
  bool join(Move& next);
  bool without_corner(const std::string& why);
  bool corner_between(const Pending& p, const Element& a, const Element& b, Fillet& f, std::string& error);
  bool hold_if_corner(const Move& move);
  bool emit_joint(const Move& first, const Move& corner);
  void release_pending();

  // machining cycles (machining_cycles.cpp)
  bool run_machining(const ir::NamedCycle& c);
  bool machining_moves(const ir::cycles::MachiningCycle& cycle, const std::vector<ir::cycles::TurnMove>& moves,
                       bool taps);
  /// `level`: of the surface or of the reference plane. `kind`: CycleRun::radius.
  void keep_place(std::uint64_t first, std::string_view family, double level, double kind);
  void keep_tap(std::uint64_t first, bool left_hand);
  void keep_contours(const ir::cycles::LeftContours& left, CycleRun& run) const;
  bool machining_numbers(const ir::NamedCycle& c, ir::cycles::TurnNumbers& out);
  bool machining_move(const ir::cycles::TurnMove& m, ir::SpindleState sense);
  bool machining_path(const ir::cycles::TurnMove& m);
  std::optional<ir::cycles::TurnProfile> machining_profile(const ir::NamedCycle& c,
                                                           const ir::cycles::TurnNumbers& numbers);

  // patterns (patterns.cpp)
  bool start_pattern(const ir::NamedCycle& c);
  bool run_pattern();
  bool go_on_with_pattern(const ir::Block& b);
  bool to_point(const ir::cycles::PatternPoint& to);

  // cycles (cycles.cpp)
  bool run_cycle();
  bool turn_hole();
  bool run_hole();
  bool read_mill_contours(const ir::HoleCycle& hole);
  bool mill_context(ir::cycles::MillContext& context);
  bool run_milling();
  std::optional<std::vector<ir::cycles::MillMove>> milling_by_assumed_radius(ir::cycles::MillContext& context,
                                                                             std::string* error);
  void tell_radii(Diagnostics& diagnostics) const;
  bool run_pocket(const ir::NamedCycle& call);
  bool find_pocket_entries();
  bool milling_move(const ir::cycles::MillMove& m, double speed);
  /// Of the tool in use, mm; 0: not known.
  [[nodiscard]] double tool_radius();
  bool resolve_cycle(const ir::CyclePtr& cycle, std::optional<ir::cycles::HoleNumbers>& out, ir::AxisId& axis);
  bool cycle_move(const ir::cycles::CycleMove& m, const Axes& hole, ir::SpindleState sense);
  bool cycle_path(const ir::cycles::CycleMove& m, const Axes& hole);
  bool cycle_pitch(const ir::cycles::CycleMove& m, double& pitch);
  [[nodiscard]] bool cycle_triggers(const ir::Block& b) const;
  [[nodiscard]] bool path_words(const ir::Block& b) const;

  const machine::Profile& profile_;
  /// Of a row of the tool table that the profile leaves empty, mm; 0 without a world.
  [[nodiscard]] double radius_of_world(double row) const { return world_ == nullptr ? 0 : world_->tool_radius(row); }
  const machine::World* world_;
  Emitter& emitter_;
  std::vector<CycleRun>* cycle_runs_ = nullptr;
  Failure& failure_;
  ValueSource* values_;

  ir::ModalState modal_;
  std::array<AxisState, ir::axis::count_max> axis_{};
  std::vector<ir::AxisId> axes_;
  Event path_event_;  ///< `to` is the machine position; reused for every move
  Event event_;       ///< every other event
  Axes p_{};          ///< position in the work frame
  Frame frame_, inverse_;
  bool plain_frame_ = true;  ///< frame_ only translates
  std::uint64_t frame_serial_ = 0;
  std::array<Frame, 6> slots_;  ///< by FrameSlot
  std::uint8_t suspended_ = 0;  ///< bit n: slot n does not count for now, a preset: while no work offset is in force
  Policies policy_;
  std::map<std::int32_t, std::map<ir::AxisId, double>> work_offsets_;
  std::map<std::int32_t, std::map<ir::AxisId, double>> fine_offsets_;  ///< added to those of the same row
  std::map<std::int32_t, Frame> offset_shapes_;  ///< turn, scale and mirror of a row; missing: none
  std::map<std::int32_t, Frame> base_frames_;    ///< in force, outside of the settable frame; by row
  std::map<ir::AxisId, double> active_offset_;   ///< fine part included
  Frame active_shape_;
  bool zero_open_ = true;           ///< no offset has been selected
  bool writes_zeros_ = false;       ///< the program writes the tables of offsets or frames
  Axes fine_shift_{};               ///< of the programmable frame; in the slot too
  Axes axis_feed_{};                ///< of axes that move by themselves, mm/min or deg/min; 0: as fast as they go
  Axes increment_base_{};           ///< last programmed coordinate before a frame change, where that is what counts
  std::uint32_t base_pending_ = 0;  ///< bit n: an incremental word of axis n starts from there
  std::array<double, 3> feed_{}, feed_degrees_{};  ///< by FeedMode: in mm; the number programmed
  std::array<Spindle, 32> spindles_{};
  std::uint8_t master_ = 1;  ///< of the spindles: the one that feeds, threads and cycles follow
  std::int32_t tool_ = 0, tool_in_spindle_ = 0, offset_ = 0;
  /// The offset in force: whether it is one, is none (D0), or that the control's own rule leaves it open.
  enum class OffsetUse : std::uint8_t { open, none, some };
  OffsetUse offset_use_ = OffsetUse::open;
  bool bare_tool_ = false;         ///< no D since its T
  bool tool_came_with_t_ = false;  ///< T changes the tool: M6 has nothing left to do
  std::string tool_name_;
  Vec pole_;
  bool pole_set_ = false;               ///< by the program, not the zero point of the plane
  std::optional<double> polar_radius_;  ///< the one programmed last
  double start_angle_ = 0;              ///< of a thread, where it stays in force
  std::uint64_t thread_end_ = 0;        ///< events up to the last thread, that one included

  // the last path element, for tangents
  std::array<double, 3> before_{};
  bool last_was_arc_ = false, has_path_ = false;
  Vec last_centre_;
  bool last_ccw_ = false;
  double lead_ = 0, reached_pitch_ = 0;  ///< of threads, mm per revolution: programmed, and at the end of the last one

  // splines
  std::unique_ptr<OpenCurve> curve_;
  bool curve_broken_ = false;            ///< closed while its motion function is still in force
  bool curve_from_first_point_ = false;  ///< its first block is where it begins
  bool for_contour_ = false;
  double curve_tolerance_ = 0.001;
  std::vector<ir::AxisId> spline_axes_;  ///< empty: the first three
  std::vector<Span> curves_assumed_;
  std::vector<std::pair<Span, std::string>> corners_left_out_;  ///< with the reason

  // per block
  std::optional<Pending> block_corner_;
  bool sharp_ = false;  ///< the block writes a corner of 0
  bool block_moves_ = false, feed_stop_ = false, length_comp_said_ = false, offset_of_machine_ = false,
       cycle_defined_here_ = false, cycle_waits_ = false;
  std::optional<Pending> pending_;
  ir::contour::Marks marks_;          ///< of the block at hand
  std::vector<OpenElement> contour_;  ///< their points are not known yet
  std::vector<Span> chosen_contours_;
  std::uint64_t contour_frame_ = 0, contour_events_ = 0;
  double modal_corner_ = 0;
  bool modal_corner_has_feed_ = false;
  double modal_corner_feed_ = 0;

  double cylinder_ = 0;   ///< mm: diameter of the unrolled cylinder
  double y_beneath_ = 0;  ///< place of the Y axis while Y is a coordinate of the face or the cylinder
  bool y_lent_ = false;   ///< the machine has no Y axis of its own

  std::optional<ir::cycles::HoleNumbers> hole_;
  ir::cycles::MillNumbers mill_;  ///< with a hole of kind `mill`
  std::vector<ir::cycles::MillContour> mill_contours_;
  ContourHomes contour_homes_;
  std::vector<std::pair<double, double>> hole_entries_;  ///< places of a hole cycle that finds them itself
  std::vector<Span> pocket_orders_;                      ///< contour pockets carried out
  ir::AxisId hole_axis_ = ir::axis::z;
  bool hole_follows_plane_ = false;  ///< a modal call works along the normal of the plane at each point
  ir::CycleTrigger trigger_ = ir::CycleTrigger::plane_axis_word;
  bool once_ = false;
  struct ModalHole {
    ir::cycles::HoleNumbers hole;
    ir::cycles::MillNumbers mill;
    ir::AxisId axis = ir::axis::z;
    bool follows_plane = false;
    ir::CycleTrigger trigger = ir::CycleTrigger::plane_axis_word;
  };
  std::optional<ModalHole> modal_hole_;  ///< the modal cycle while another one runs once
  void end_single_cycle();
  const ir::NamedCycle* machining_ = nullptr;  ///< of the block at hand
  const ir::NamedCycle* pattern_ = nullptr;    ///< the pattern in work
  bool pattern_here_ = false;                  ///< it stands in the block at hand
  const ir::Block* open_pattern_ = nullptr;    ///< a modal subprogram runs between its points, or behind the last one
  std::vector<ir::cycles::PatternPoint> points_;
  std::size_t next_point_ = 0;

  const ir::Program* program_ = nullptr;
  const ir::ProgramFinder* library_ = nullptr;
  const ir::Routine* routine_ = nullptr;

  std::map<std::string, double> written_;  ///< machine data the program wrote, by name and indices
  [[nodiscard]] double unit_of_written(const std::string& name) const;
  std::set<std::string> written_in_mm_;  ///< of written_
  std::map<std::tuple<ir::Datum, ir::AxisId, std::vector<double>>, double> written_tools_;
  std::vector<Assumed> assumed_;
  std::vector<AssumedRadius> assumed_radii_;
  Axes travelled_{};  ///< way of the axes since the start, or since the program set it
  Axes travel_set_{};
  std::uint32_t travel_given_ = 0;  ///< bit n: the program set the way of axis n
  std::set<std::string> unread_;    ///< of those, what --set gave and nothing has asked for
};

}  // namespace cnctrans::interpreter
