// The writer of whole programs: file frame and statements (writer.cpp), words (writer_words.cpp), offsets and frames
// (writer_frames.cpp), motion and cycles (writer_motion.cpp).
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "backends/common/file_groups.h"
#include "backends/common/program_writer.h"
#include "backends/fagor/cycles.h"
#include "backends/fagor/expressions.h"
#include "dialects/fagor/g_codes.h"
#include "ir/analysis/rotary_places.h"

namespace cnctrans::backends::fagor {

/// The code of what the language has no word for.
inline constexpr std::string_view no_word = "TRN-202";

/// The file's name: six digits. The stem when it is that; else the program's number, else the digits in the stem.
std::string file_name(const ir::Program& program, const WriteOptions& options, bool lathe);
/// `wanted`, or the next program number whose name is not taken in this job.
std::string free_file_name(const std::string& wanted, const WriteOptions& options);
/// `%TITLE ,MX,`; empty when a program of this language has no header.
std::string header_line(const ir::Program& program, const WriteOptions& options);
/// Name of a file of subroutines: `stem` where it is a program number, else the number of its first subroutine.
std::string called_file_name(const ir::Routine& first, const std::string& stem, bool lathe);
/// Its header, for a source of another language.
std::string called_header_line(const ir::Routine& first);

/// An empty line of the source. The control takes no empty block: a remark without text stands for it.
bool is_empty_line(const ir::Statement& s);

/// TRN-480: a rotary word is written as a plain coordinate.
void say_rotary(std::string_view axis, const Span& at, Diagnostics& diagnostics);

class Writer : public ProgramWriter {
 public:
  Writer(const ir::Program& program, const WriteOptions& options, const Style& style, Diagnostics& diagnostics);

 protected:
  void write_program() override;
  ExpressionPrinter& expressions() override { return printer_; }
  std::string word(std::string_view address, const ir::Value& value, WordPos pos) override;

  void block(const ir::Block& b) override;
  void assign(const ir::Assign& a) override;
  void if_else(const ir::If& i) override;
  void unread_structure(const ir::Statement& s, const ir::Opaque& text) override;
  void jump(const ir::Jump& j) override;
  void repeat(const ir::Repeat& r) override;
  void call(const ir::CallRoutine& c) override;
  void modal_call(const ir::ModalCall& c) override;
  void return_from(const ir::Return& r) override;
  void end_program(const ir::End& e) override;
  void message(const ir::Message& m) override;

  void action(const ir::Action& a) override;
  void modal_set(const ir::Action& a, const ir::ModalSet& m) override;
  void surface_set(const ir::Action& a, const ir::SurfaceSet& s) override;
  void set_feed(const ir::Action& a, const ir::SetFeed& f) override;
  void master_spindle(const ir::Action& a, const ir::MasterSpindle& m) override;
  void spindle_orient(const ir::Action& a, const ir::SpindleOrient& s) override;
  void spindle_limit(const ir::Action& a, const ir::SpindleLimit& s) override;
  void spindle_gear(const ir::Action& a, const ir::SpindleGear& s) override;
  void tool_select(const ir::Action& a, const ir::ToolSelect& t) override;
  void work_offset(const ir::Action& a, const ir::WorkOffset& w) override;
  void frame_op(const ir::Action& a, const ir::FrameOp& f) override;
  [[nodiscard]] bool rollover() const;
  void tell_rotary(const ir::CoordWord& w);
  [[nodiscard]] std::optional<double> counted_place(const ir::CoordWord& w);
  void tell_counted(const ir::CoordWord& w);
  void pole_set(const ir::Action& a, const ir::PoleSet& p) override;
  void dwell(const ir::Action& a, const ir::Dwell& d) override;
  void cycle_define(const ir::Action& a, const ir::CycleDefine& c) override;
  void cycle_cancel(const ir::Action& a) override;
  void corner(const ir::Action& a, const ir::Corner& c) override;
  void tangential_end(const ir::Action& a, const ir::TangentialEnd& t) override;

  void motion(const ir::Motion& m) override;
  void frame_use(const ir::Motion& m) override;
  void coordinate(const ir::Motion& m, const ir::CoordWord& w) override;
  void center(const ir::Motion& m, const ir::CenterWord& w) override;
  void motion_extra(const ir::Motion& m, const ir::MotionExtra& e) override;
  [[nodiscard]] bool stands_still(const ir::CoordWord& w);

  void before_statement(const ir::Statement& next) override;
  bool joins(const ir::Statement& before, const ir::Statement& next) override;
  bool own_line(const ir::Action& a, const ir::Block& b) override;
  [[nodiscard]] ir::Order target_order(const ir::Action& a) const override;
  bool spelling_is_whole_word(const ir::Action& a) const override;

 private:
  // file frame
  void write_routine(std::size_t index);
  void write_called(const FileGroup& group, const std::string& main_file);
  void write_main(std::size_t index);
  // statements
  void statement_line(const std::string& text);  ///< `(text)`, alone in its block
  [[nodiscard]] std::string assignments(const ir::Assign& a, std::size_t from, std::size_t to);
  [[nodiscard]] std::string jump_text(const ir::Jump& j);
  [[nodiscard]] std::string range_text(const ir::Repeat& r);
  [[nodiscard]] std::string call_text(std::string_view keyword, const ir::CallRoutine& c);
  [[nodiscard]] std::string message_text(const ir::Message& m);
  [[nodiscard]] std::string error_number(const ir::ExprPtr& number);
  [[nodiscard]] std::string argument_text(const ir::Argument& a);
  [[nodiscard]] std::string action_text(const ir::Body& body);
  [[nodiscard]] bool written_as_g_call(const ir::CallRoutine& c) const;
  [[nodiscard]] bool runs_program(const ir::CallRoutine& c, std::string_view keyword) const;
  void plain_block(const ir::Block& b);
  [[nodiscard]] ir::Block on_surface(const ir::Block& b, ir::Surface surface) const;
  void g_call(const ir::CallRoutine& c);
  void keep_letters();
  void text_problem(std::string what);  ///< a part of a statement that can't be said
  // words
  [[nodiscard]] std::string_view g(dialects::fagor::Use use, int value = 0) const;
  [[nodiscard]] bool implied(const ir::Action& a);
  void frame_words(const ir::FrameChange& f, WordPos pos);
  void shift(const ir::Action& a, const ir::FrameChange& f);
  void rotation(const ir::Action& a, const ir::FrameChange& f);
  void inclined_plane(const ir::Action& a, const ir::FrameChange& f);
  void scale(const ir::Action& a, const ir::FrameChange& f);
  void mirror(const ir::Action& a, const ir::FrameChange& f);
  void plane_point(const std::vector<ir::FrameWord>& words, WordPos pos);
  void further_line(WordPos pos);
  [[nodiscard]] std::optional<ir::Value> scaled(ir::AxisId axis, ir::WordScale scale, const ir::Value& v);
  template <class Enum>
  [[nodiscard]] std::optional<Enum> known(ir::Setting s) {
    const auto v = setting(s);
    return v ? std::optional(static_cast<Enum>(*v)) : std::nullopt;
  }
  // cycles
  [[nodiscard]] std::string cycle_retract(const ir::Action& a, const CycleWords& w);
  void cycle_approach(const CycleWords& w);
  bool machining_cycle(const ir::Action& a, const ir::CycleDefine& c);
  void cycle_change(const ir::Action& a, const ir::HoleCycle& change);
  [[nodiscard]] bool curve_in_force();
  [[nodiscard]] bool arc_ends(const ir::Motion& m);
  [[nodiscard]] bool absolute_center(const ir::CenterWord& c);

  bool lathe_;
  Printer printer_;
  const ir::Block* block_ = nullptr;
  bool has_surfaces_ = false;
  bool has_cycles_ = false;                 ///< of another control
  bool has_tool_changes_ = false;           ///< by M06, in a program of another control
  std::set<const ir::Statement*> waiting_;  ///< blocks whose D stays beside its T
  bool rotary_told_ = false;
  std::optional<ir::RotaryPlaces> rotary_places_;  ///< made when the first word asks for it
  ir::Block surface_block_;                        ///< the block at hand in the words of the face or the cylinder
  ir::Plane plane_by_text_ = ir::Plane::xy;        ///< of the last plane function written
  bool after_offset_ = false;                      ///< the last thing written is a work offset
  bool offset_before_ = false;                     ///< the same, for the block at hand
  std::optional<ir::HoleCycle> last_hole_;         ///< the last hole cycle written, for changes of it
};

}  // namespace cnctrans::backends::fagor
