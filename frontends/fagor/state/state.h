// What lowering knows while it goes through a file: the machine, the report, and what the text has said so far.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "dialects/fagor/g_codes.h"
#include "dialects/fagor/options.h"
#include "frontends/common/syntax.h"
#include "ir/cycle.h"
#include "ir/program.h"
#include "machine/profile.h"

namespace cnctrans::fagor {

/// Space of the arithmetic parameters in every program this frontend makes.
inline constexpr ir::SpaceId parameter_space = 0;
/// The spaces of a Fagor program: `P` with its ranges and scopes.
std::vector<ir::VariableSpace> make_spaces();

/// A block whose reading depends on the plane: the last plane function in the text was taken; judged at the file's end.
struct PlaneUse {
  Span span;
  ir::Plane assumed = ir::Plane::xy;
  bool from_caller = false;  ///< in a subroutine before any plane function of its own
};

/// A block whose reading depends on another function by its place in the text.
struct TextUse {
  Span span;
  bool longitudinal = false;  ///< of the longitudinal axis, else of the spindle
  bool from_caller = false;   ///< in a subroutine before any such function of its own
};

/// Features of the file that change how other blocks are completed at its end.
struct FileFacts {
  std::array<bool, 3> planes{};     ///< programmed by G17 G18 G19 G16
  bool preset = false;              ///< G92 with axes
  bool table_shift = false;         ///< G58 G59
  bool shift = false;               ///< G158
  bool rotary = false;              ///< an absolute word of a rotary axis was read as a plain coordinate
  std::array<bool, 2> units{};      ///< programmed by G71 [0], G70 [1]
  bool rotation = false;            ///< G73
  bool inner_frames = false;        ///< G10 to G14, G72, G73, G158
  Span first_inclined_plane;        ///< G49 with words
  std::vector<Span> inclined_ends;  ///< G49 alone
  std::vector<Span> tool_planes;    ///< G49 T
  bool turned_by_axes = false;      ///< a word of A, B or C
  bool scaled = false;              ///< G72 S with another factor than 1, by the text
  bool scaled_rotary = false;       ///< and a rotary word behind it: told
  Span first_table_shift, first_machine_move, first_axis_scale;
  Span first_turned_plane;  ///< G16 with the axes of a plane exchanged
  std::vector<PlaneUse> plane_uses;
  /// The one plane that the flow of the program brings to a block, by its line, where the text says another one: the
  /// file is read once more with them.
  std::map<std::uint32_t, ir::Plane> planes_by_flow;
  bool plane_by_flow_differs = false;
  std::map<std::uint32_t, ir::Surface> surface_lines;  ///< blocks read as coordinates of a face or cylinder, by line
  bool surfaces = false;                               ///< G15 R, G16 XC
  bool second_spindle = false;                         ///< G28
  std::set<std::uint32_t> modal_programs;              ///< lines of MEXEC
  std::vector<TextUse> text_uses;                      ///< of the spindle and of the longitudinal axis
  bool longitudinal = false;                           ///< G15 of the mill
  bool unlisted_parameters = false;                    ///< P26 to P99
  bool axes_exchanged = false;                         ///< G28 with axes
  std::set<std::string> machine_data;                  ///< variables reported as known to the machine only
};

class LowerState {
 public:
  LowerState(const machine::Profile& profile, Diagnostics& diagnostics);

  // machine
  [[nodiscard]] const machine::Profile& profile() const { return *profile_; }
  [[nodiscard]] const dialects::fagor::Options& options() const { return options_; }
  [[nodiscard]] bool lathe() const { return lathe_; }
  [[nodiscard]] bool has_axis(ir::AxisId id) const { return id < axes_.size() && axes_[id]; }
  [[nodiscard]] const dialects::fagor::GCode* g(int code) const {
    return code >= 0 && code <= dialects::fagor::max_g_code ? g_rows_[static_cast<std::size_t>(code)] : nullptr;
  }
  [[nodiscard]] const machine::MCode* m(int code) const;
  [[nodiscard]] bool tool_changer() const { return profile_->policies.tool_change == machine::ToolChange::by_command; }
  [[nodiscard]] bool rollover() const {
    return profile_->policies.rotary_rollover;
  }  ///< rotary axes: the sign of an absolute value is the sense

  // report; places are words of the line at hand
  void set_line(const Span& line) {
    line_ = line;
    if (!flow_planes_.empty()) take_flow_plane();
  }
  /// Planes that an earlier reading has found; a line of them begins with its plane.
  void know_planes(std::map<std::uint32_t, ir::Plane> by_line) { flow_planes_ = std::move(by_line); }
  [[nodiscard]] const Span& line() const { return line_; }
  void set_diagnostics(Diagnostics& d) { diagnostics_ = &d; }
  [[nodiscard]] Diagnostics& diagnostics() const { return *diagnostics_; }
  void error(std::string_view code, WordPos pos, std::string message, std::string hint = {});
  void warning(std::string_view code, WordPos pos, std::string message, std::string hint = {});
  void note(std::string_view code, WordPos pos, std::string message, std::string hint = {});
  /// Counts errors reported since the start: a block is given up when it grew.
  [[nodiscard]] std::size_t errors() const { return errors_; }

  // what the text has said
  void start_routine(bool subroutine);
  /// The routine of `before` goes on at a labelled block; what was found in the file since then stays.
  void go_back_to(const LowerState& before);
  [[nodiscard]] bool in_subroutine() const { return in_subroutine_; }
  /// `turned`: the second axis of the plane is its abscissa (G16 XZ): every sense of turning is seen from behind.
  void plane_code(ir::Plane plane, bool turned = false, bool of_surface = false);
  [[nodiscard]] bool turned() const { return turned_; }
  void spindle_code(std::uint8_t number);
  void longitudinal_code(ir::AxisId axis);
  /// The spindle of S and M words here (G28, G29).
  std::uint8_t spindle();
  [[nodiscard]] std::uint8_t spindle_now() const { return spindle_; }
  /// The axis of cycles and tool length here: the normal of the plane, or by G15.
  ir::AxisId longitudinal();
  [[nodiscard]] ir::AxisId longitudinal_given() const { return longitudinal_; }
  /// A block that can be reached from elsewhere: what the text said before may not hold.
  void labelled() {
    spindle_sure_ = longitudinal_sure_ = motion_sure = comp_begins = comp_sure = plane_changed = false;
    constants_.clear();
  }
  /// Parameters that hold a fixed number here, whatever way leads to the block.
  [[nodiscard]] const double* constant(std::int64_t parameter) const;
  void assigned(std::int64_t parameter, const double* value);
  void forget_constants() { constants_.clear(); }
  /// A modal call may change any parameter behind every move.
  void no_constants() { constants_known_ = false; }
  [[nodiscard]] ir::Plane plane_now() const { return plane_; }
  /// The plane by the text; remembered as a use that the file's end has to confirm.
  ir::Plane plane_by_text();
  ir::CompSide comp_by_text = ir::CompSide::off;
  ir::Units units_by_text = ir::Units::metric;
  ir::Surface surface_by_text = ir::Surface::none;  ///< face, cylinder (G15, G16)
  bool surface_plane_by_text = false;               ///< its plane is in force as well
  ir::MotionKind motion_by_text = ir::MotionKind::modal;
  bool motion_sure = false;                            ///< no other way leads here since the last motion code
  bool comp_begins = false;                            ///< G40, G41 or G42 since the last move in the plane
  bool comp_sure = false;                              ///< no other way leads here since G40, G41, G42
  bool plane_changed = false;                          ///< another plane since the last move in the plane
  std::string attributes;                              ///< of the header; empty: a file without one
  std::shared_ptr<const ir::HoleCycle> cycle_by_text;  ///< the hole cycle in force
  ir::Value cycle_minimum_by_text;                     ///< L of G69, which counts with R only
  int cycle_code_by_text = 0;                          ///< its G number
  FileFacts facts;

 private:
  void take_flow_plane();

  std::map<std::uint32_t, ir::Plane> flow_planes_;
  const machine::Profile* profile_;
  Diagnostics* diagnostics_;
  dialects::fagor::Options options_;
  bool lathe_ = false;
  std::array<bool, 9> axes_{};
  std::array<const dialects::fagor::GCode*, dialects::fagor::max_g_code + 1> g_rows_{};
  std::array<const machine::MCode*, 256> m_rows_{};
  Span line_;
  std::size_t errors_ = 0;
  ir::Plane plane_ = ir::Plane::xy;
  bool plane_from_caller_ = false;
  bool turned_ = false;
  bool in_subroutine_ = false;
  std::uint8_t spindle_ = 1;
  ir::AxisId longitudinal_ = ir::axis::none;  ///< by G15; none: the normal of the plane
  bool spindle_sure_ = true, longitudinal_sure_ = true;
  std::map<std::int64_t, double> constants_;
  bool constants_known_ = true;
};

/// The word as written, and an ISO word's letter in capitals.
inline std::string_view word_text(const syntax::Word& w) {
  return {w.address.data(), w.pos.length};
}
inline char word_letter(const syntax::Word& w) {
  return static_cast<char>(w.address[0] & 0x5F);
}

}  // namespace cnctrans::fagor
