// Whole programs as Sinumerik text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backends/common/program_writer.h"
#include "backends/sinumerik/expressions.h"
#include "backends/sinumerik/offsets_in_force.h"
#include "dialects/sinumerik/geometry.h"
#include "legaliser/analysis/modal_needs.h"

namespace cnctrans::backends::sinumerik {

/// "FLANGE_12" when it is a legal program name (two letters or underscores first, letters, digits, underscores, at most
/// 31 characters); empty otherwise.
std::string legal_name(std::string_view stem);

class Writer final : public ProgramWriter {
 public:
  Writer(const ir::Program& program, const WriteOptions& options, Diagnostics& diagnostics);

 protected:
  [[nodiscard]] const cnctrans::sinumerik::GeometryAxes& geometry() const { return geometry_; }
  // frame (writer.cpp)
  void write_program() override;
  ExpressionPrinter& expressions() override { return expressions_; }
  std::string word(std::string_view address, const ir::Value& value, WordPos pos) override;
  std::string label_text(const ir::LineInfo& info) override;
  bool joins(const ir::Statement& before, const ir::Statement& next) override;
  void before_statement(const ir::Statement& next) override;

  // statements (statements.cpp)
  void assign(const ir::Assign& a) override;
  [[nodiscard]] std::string list_text(const ir::Assign& a) const;
  void if_else(const ir::If& i) override;
  void while_loop(const ir::While& w) override;
  void until_loop(const ir::Until& u) override;
  void for_loop(const ir::For& f) override;
  void endless_loop(const ir::Loop& l) override;
  void unread_structure(const ir::Statement& s, const ir::Opaque& text) override;
  void jump(const ir::Jump& j) override;
  void switch_jump(const ir::Switch& s) override;
  void repeat(const ir::Repeat& r) override;
  void call(const ir::CallRoutine& c) override;
  void modal_call(const ir::ModalCall& c) override;
  void return_from(const ir::Return& r) override;
  void end_program(const ir::End& e) override;
  void message(const ir::Message& m) override;
  void file_statement(const ir::Message& m, const ir::FileStatement& f) override;  // files.cpp
  void declare(const ir::Declare& d) override;
  void opaque_word(const ir::Action& a, const ir::OpaqueWord& w) override;

  // words (words.cpp)
  void block(const ir::Block& b) override;
  bool own_line(const ir::Action& a, const ir::Block& b) override;
  bool spelling_is_whole_word(const ir::Action& a) const override;
  void modal_set(const ir::Action& a, const ir::ModalSet& m) override;
  void master_spindle(const ir::Action& a, const ir::MasterSpindle& m) override;
  [[nodiscard]] std::string of_spindle(const char* address, std::uint8_t number) const;
  void set_spindle(const ir::Action& a, const ir::SetSpindle& s) override;
  void spindle_run(const ir::Action& a, const ir::SpindleRun& s) override;
  void set_feed(const ir::Action& a, const ir::SetFeed& f) override;
  void spindle_orient(const ir::Action& a, const ir::SpindleOrient& s) override;
  void spindle_limit(const ir::Action& a, const ir::SpindleLimit& s) override;
  void tool_select(const ir::Action& a, const ir::ToolSelect& t) override;
  void tool_offset(const ir::Action& a, const ir::ToolOffset& t) override;
  void work_offset(const ir::Action& a, const ir::WorkOffset& w) override;
  void frame_op(const ir::Action& a, const ir::FrameOp& f) override;
  void surface_set(const ir::Action& a, const ir::SurfaceSet& s) override;
  void pole_set(const ir::Action& a, const ir::PoleSet& p) override;
  void dwell(const ir::Action& a, const ir::Dwell& d) override;
  void machine_function(const ir::Action& a, const ir::MachineFunction& m) override;
  void cycle_define(const ir::Action& a, const ir::CycleDefine& c) override;
  void cycle_cancel(const ir::Action& a) override;
  void corner(const ir::Action& a, const ir::Corner& c) override;
  void frame_use(const ir::Motion& m) override;
  void coordinate(const ir::Motion& m, const ir::CoordWord& w) override;
  void polynomial(const ir::Motion& m, const ir::PolynomialWord& p);
  void center(const ir::Motion& m, const ir::CenterWord& w) override;
  void radius(const ir::Motion& m) override;
  void motion_extra(const ir::Motion& m, const ir::MotionExtra& e) override;

 private:
  // frame
  void routine_file(std::size_t index, const std::string& name, bool main);
  void routine_text(std::size_t index, const std::string& name);
  std::string main_name();
  [[nodiscard]] std::string sub_name(const ir::RoutineName& name) const;
  void externs(const ir::Routine& r);
  void open_structure();
  void close_structure(const ir::LineInfo& info, const std::string& keyword);
  std::string proc_line(const ir::Routine& r, const std::string& name);

  /// Some thread of the program starts at an angle of its own: SF= stays in force here, so each thread has to say its.
  [[nodiscard]] bool threads_have_angles() const;

  // statements
  bool condition(const ir::ExprPtr& e, std::string& text);
  std::string goto_text(const ir::Jump& j);
  std::string target_text(const ir::LabelRef& label);
  std::string call_text(const ir::CallRoutine& c);
  std::string text_parts(const std::vector<ir::ExprPtr>& parts);
  [[nodiscard]] std::size_t routine_of(const ir::RoutineName& name) const;
  bool refused_problem(WordPos pos = {});

  // words
  std::string value_text(const ir::Value& v, WordPos pos);
  void polar_word(ir::WordMode mode, std::string_view address, const ir::Value& v);
  std::string attribute_word(std::string_view address, std::string_view attribute, const ir::Value& v, WordPos pos);
  std::string cycle_text(const ir::Cycle& cycle, WordPos pos);
  void feed_and_spindle_mode(const ir::Block& b);
  bool needs_feed_mode(const ir::Block& b);
  void offset_again(const ir::Block& b);
  void offset_line(const Span& span);
  std::string offset_word(const Span& where);
  void nested(const ir::Body& statements);
  std::string rotary_attribute(const ir::CoordWord& w);
  bool radius_on_face(ir::AxisId axis);
  bool plain_is_radius(ir::AxisId axis);
  [[nodiscard]] ir::AxisId main_axis(const ir::Motion& m);
  [[nodiscard]] std::optional<double> travel(const ir::CoordWord& w);
  [[nodiscard]] std::string source_word(WordPos pos) const;

  bool stands_already(WordPos pos);

  Expressions expressions_;
  const cnctrans::sinumerik::GeometryAxes geometry_;
  Span written_line_;  ///< where the words stand that were last written as the source has them
  std::uint32_t written_column_ = 0;
  bool list_written_ = false;  ///< the statement before was a list of values in the words of the source
  bool uses_css_ = false;
  bool chooses_master_ = false;  ///< the program chooses its master spindle
  bool angles_ = false;          ///< every thread says its start angle
  std::string group_code_;       ///< G94 G95 G96... of the block being written
  bool group_written_ = false;
  bool block_has_offset_ = false;                  ///< the block being written selects an offset or a tool
  const ir::Statement* without_offset_ = nullptr;  ///< the move in machine coordinates for which D0 was written
  bool told_without_offset_ = false;
  std::optional<ir::passes::CallGraph> calls_;
  std::optional<ir::passes::ModalNeeds> needs_;  ///< made where a mode is not known
  std::optional<OffsetDomain> offset_domain_;
  std::optional<ir::passes::FlowStates<OffsetDomain>> offsets_;  ///< made at the first such move
};

}  // namespace cnctrans::backends::sinumerik
