// Whole programs as LinuxCNC text.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "backends/common/program_writer.h"
#include "backends/linuxcnc/expressions.h"

namespace cnctrans::backends::linuxcnc {

class Writer final : public ProgramWriter {
 public:
  Writer(const ir::Program& program, const WriteOptions& options, Diagnostics& diagnostics);

 protected:
  // frame and statements (writer.cpp)
  void write_program() override;
  ExpressionPrinter& expressions() override { return expressions_; }
  std::string word(std::string_view address, const ir::Value& value, WordPos pos) override;
  bool joins(const ir::Statement& before, const ir::Statement& next) override;
  void assign(const ir::Assign& a) override;
  void if_else(const ir::If& i) override;
  void while_loop(const ir::While& w) override;
  void until_loop(const ir::Until& u) override;
  void for_loop(const ir::For& f) override;
  void endless_loop(const ir::Loop& l) override;
  void exit_loop() override;
  void jump(const ir::Jump& j) override;
  void repeat(const ir::Repeat& r) override;
  void call(const ir::CallRoutine& c) override;
  void return_from(const ir::Return& r) override;
  void end_program(const ir::End& e) override;
  void message(const ir::Message& m) override;

  // words (words.cpp)
  void block(const ir::Block& b) override;
  bool own_line(const ir::Action& a, const ir::Block& b) override;
  void modal_set(const ir::Action& a, const ir::ModalSet& m) override;
  void set_feed(const ir::Action& a, const ir::SetFeed& f) override;
  void set_spindle(const ir::Action& a, const ir::SetSpindle& s) override;
  void spindle_orient(const ir::Action& a, const ir::SpindleOrient& s) override;
  void spindle_limit(const ir::Action& a, const ir::SpindleLimit& s) override;
  void spindle_gear(const ir::Action& a, const ir::SpindleGear& s) override;
  void tool_offset(const ir::Action& a, const ir::ToolOffset& t) override;
  void work_offset(const ir::Action& a, const ir::WorkOffset& w) override;
  void frame_op(const ir::Action& a, const ir::FrameOp& f) override;
  void dwell(const ir::Action& a, const ir::Dwell& d) override;
  void cycle_cancel(const ir::Action& a) override;
  void machine_function(const ir::Action& a, const ir::MachineFunction& m) override;
  void motion(const ir::Motion& m) override;
  void frame_use(const ir::Motion& m) override;
  void coordinate(const ir::Motion& m, const ir::CoordWord& w) override;
  void motion_extra(const ir::Motion& m, const ir::MotionExtra& e) override;

 private:
  void routine_text(std::size_t index);
  [[nodiscard]] std::string sub_label(const ir::RoutineName& name) const;
  [[nodiscard]] std::string next_label();
  std::optional<std::string> condition(const ir::ExprPtr& e);
  std::string value_text(const ir::ExprPtr& e, WordPos pos);
  bool refused_problem(WordPos pos = {});
  void comp(const ir::Action& a, ir::CompSide side);

  Expressions expressions_;
  std::deque<ir::Body> kept_;       ///< copies of repeated parts; the lines being written point into them
  int repeating_ = 0;               ///< repeated parts that are being written again
  std::int64_t last_label_ = 1000;  ///< of structures
  std::vector<std::string> loops_;  ///< labels of the loops that are open, innermost last
  bool block_css_ = false;          ///< the block being written switches constant cutting speed on
  bool block_spindle_ = false;      ///< ... and sets the speed
  bool tolerance_noted_ = false, has_spindle_limit_ = false, shifts_ = false;
  std::string offset_;  ///< number of the offset selected last in this routine
};

}  // namespace cnctrans::backends::linuxcnc
