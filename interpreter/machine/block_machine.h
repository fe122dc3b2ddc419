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
#include "interpreter/machine/frame_parts.h"
#include "interpreter/machine/given_data.h"
#include "interpreter/machine/open_curve.h"
#include "interpreter/machine/spindles.h"
#include "interpreter/machine/tool_in_use.h"
#include "interpreter/machine/zero_points.h"
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
  [[nodiscard]] bool moved() const { return now_.moves; }
  /// The block runs a modal subprogram: it moves, or has words that do the same on this machine.
  [[nodiscard]] bool runs_modal_call(const ir::Block& b) const {
    return now_.moves || (profile_.policies.call_modal_words && path_words(b));
  }
  /// A cycle that runs after every later block with path motion; null ends it.
  bool modal_cycle(const ir::CyclePtr& cycle, ir::CycleTrigger trigger, bool here);
  void cancel_cycle() { cycle_.hole.reset(); }
  void message(std::string text, const Span& where);
  /// Contours that several points fit were settled by the nearest one, here.
  [[nodiscard]] const std::vector<Span>& chosen_contours() const { return contour_.chosen; }
  /// The makers' manuals leave the way of splines between their points open: said once, at the first one.
  void tell_path(Diagnostics& diagnostics) const;
  /// The next spline block stands at its first point (a curve with a definition of its own); the curve ends.
  void begin_defined_curve() { curve_.from_first_point = true; }
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
  void preset_datum(const std::string& name, double value) { data_.preset(name, value); }
  [[nodiscard]] const GivenData& given_data() const { return data_; }
  /// The radius of a tool that nobody gives, and the first milling cycle that ran with it.
  struct AssumedRadius {
    Span where;
    std::int32_t tool = 0;
    double radius = 0;  ///< mm
  };
  [[nodiscard]] const std::vector<AssumedRadius>& assumed_radii() const { return assumed_radii_; }
  /// The program writes tables of zero points.
  [[nodiscard]] bool writes_zeros() const { return zeros_.written(); }
  std::uint64_t arguments_given = 0;  ///< of the present call level
  std::size_t calls_open = 0;
  std::string_view last_label;  ///< number of the numbered statement carried out last; empty: none yet
  bool block_again = false;     ///< a further pass of a repeated block: the cycle it defines is in force already
  bool single_points = false;   ///< a pattern stops at each point: a modal subprogram runs there
  /// The block goes on behind the modal subprogram: with the next point, or with what acts behind the last one.
  [[nodiscard]] bool points_left() const { return pattern_.open != nullptr; }

 private:
  struct AxisState {
    bool present = false, rotary = false, diameter = false;
    double scale_absolute = 1, scale_incremental = 1;  ///< mm (radius) in one unit of a word under the modes in force
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
  bool read_position(const ir::SystemRef& ref, std::span<const double> args, double& out) const;
  bool read_technology(const ir::SystemRef& ref, std::span<const double> args, double& out) const;
  bool read_state(const ir::SystemRef& ref, std::span<const double> args, double& out) const;
  bool read_of_run(const ir::SystemRef& ref, std::span<const double> args, const std::string& name, double& out);
  bool read_at_rest(const std::string& name, double& out);
  [[nodiscard]] std::int32_t offset_row(std::span<const double> args) const;
  bool place_in_table(ir::AxisId axis, std::span<const double> args, double& out) const;

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
  bool select_tool(const ir::ToolSelect& t, bool own_offset);
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
  void run_master(ir::SpindleState state) { run_spindle(spindles_.master_number(), state); }
  void orient_master(double angle);
  void emit_spindle(int number);
  void emit_master() { emit_spindle(spindles_.master_number()); }
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
  static std::vector<ir::AxisId> named_axes(const ir::FrameChange& c);
  bool preset(const ir::FrameChange& c);
  void change_part(const ir::FrameChange& c, ir::FrameCombine combine);
  Frame turn_of(const ir::FrameChange& c);
  void count_preset();
  bool offset_written(std::int32_t row);
  bool rebuild_frame();
  bool use_frame(const Frame& f);

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
  ZeroPoints zeros_;
  FrameParts parts_;
  bool keeps_programmed_ = false;  ///< frame.change_keeps of the profile; a frame may suspend it
  bool data_modal_ = false;        ///< machine data are in the units of the program
  Axes axis_feed_{};               ///< of axes that move by themselves, mm/min or deg/min; 0: as fast as they go
  /// Increments behind a change of the frame, where they count from the last programmed coordinate.
  struct Increments {
    Axes from{};
    std::uint32_t pending = 0;  ///< bit n: an incremental word of axis n starts from there
  };
  Increments increments_;
  std::array<double, 3> feed_{}, feed_degrees_{};  ///< by FeedMode: in mm; the number programmed
  Spindles spindles_;
  ToolInUse tool_;
  struct Polar {
    Vec pole;
    bool pole_set = false;         ///< by the program, not the zero point of the plane
    std::optional<double> radius;  ///< the one programmed last
  };
  Polar polar_;
  struct Threads {
    double lead = 0, reached_pitch = 0;  ///< mm per revolution: programmed, and at the end of the last one
    double start_angle = 0;              ///< degrees, where it stays in force
    std::uint64_t end = 0;               ///< events up to the last thread, that one included
  };
  Threads thread_;
  /// The last path element, for tangents.
  struct LastElement {
    bool known = false, arc = false, ccw = false;
    std::array<double, 3> before{};  ///< where it began
    Vec centre;
  };
  LastElement last_;
  struct Curve {
    std::unique_ptr<OpenCurve> open;
    bool broken = false;            ///< closed while its motion function is still in force
    bool from_first_point = false;  ///< its first block is where it begins
    double tolerance = 0.001;       ///< mm
    std::vector<ir::AxisId> axes;   ///< of splines; empty: the first three
    std::vector<Span> assumed;      ///< where the way between points is the interpreter's choice
  };
  Curve curve_;
  bool for_contour_ = false;
  std::vector<std::pair<Span, std::string>> corners_left_out_;  ///< with the reason

  struct BlockInWork {
    std::optional<Pending> corner;
    bool sharp = false;  ///< it writes a corner of 0
    bool moves = false, feed_stop = false;
    bool cycle_defined = false, cycle_waits = false, cycle_once = false;
    ir::contour::Marks marks;
    const ir::NamedCycle* machining = nullptr;
  };
  BlockInWork now_;
  std::optional<Pending> pending_;
  struct OpenContour {
    std::vector<OpenElement> elements;  ///< their points are not known yet
    std::vector<Span> chosen;
    std::uint64_t frame = 0, events = 0;
  };
  OpenContour contour_;
  struct ModalCorner {
    double size = 0;  ///< mm; 0: none
    bool has_feed = false;
    double feed = 0;
  };
  ModalCorner modal_corner_;

  /// The face or the cylinder of a turning part.
  struct TurnedSurface {
    double cylinder = 0;   ///< mm: diameter of the unrolled cylinder
    double y_beneath = 0;  ///< place of the Y axis while Y is a coordinate of the face or the cylinder
    bool y_lent = false;   ///< the machine has no Y axis of its own
  };
  TurnedSurface surface_;
  struct ActiveCycle {
    std::optional<ir::cycles::HoleNumbers> hole;
    ir::cycles::MillNumbers mill;  ///< with a hole of kind `mill`
    ir::AxisId axis = ir::axis::z;
    bool follows_plane = false;  ///< a modal call works along the normal of the plane at each point
    ir::CycleTrigger trigger = ir::CycleTrigger::plane_axis_word;
  };
  ActiveCycle cycle_;
  std::optional<ActiveCycle> modal_cycle_;  ///< the modal cycle while another one runs once
  std::vector<ir::cycles::MillContour> mill_contours_;
  ContourHomes contour_homes_;
  std::vector<std::pair<double, double>> hole_entries_;  ///< places of a hole cycle that finds them itself
  std::vector<Span> pocket_orders_;                      ///< contour pockets carried out
  void end_single_cycle();
  struct PatternInWork {
    const ir::NamedCycle* cycle = nullptr;
    bool here = false;                ///< it stands in the block at hand
    const ir::Block* open = nullptr;  ///< a modal subprogram runs between its points, or behind the last one
    std::vector<ir::cycles::PatternPoint> points;
    std::size_t next = 0;
  };
  PatternInWork pattern_;

  const ir::Program* program_ = nullptr;
  const ir::ProgramFinder* library_ = nullptr;
  const ir::Routine* routine_ = nullptr;

  GivenData data_;
  [[nodiscard]] double unit_of_written(const std::string& name) const;
  std::vector<AssumedRadius> assumed_radii_;
  /// Way of the axes since the start, or since the program set it.
  struct Travel {
    Axes way{}, set{};
    std::uint32_t given = 0;  ///< bit n: the program set the way of axis n
  };
  Travel travel_;
};

}  // namespace cnctrans::interpreter
