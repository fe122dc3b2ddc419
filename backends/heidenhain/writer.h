// The writer of conversational programs: statements and words over the shared ProgramWriter.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "backends/common/program_writer.h"
#include "backends/heidenhain/call_plan.h"
#include "backends/heidenhain/expressions.h"
#include "backends/heidenhain/label_names.h"
#include "backends/heidenhain/tool_plan.h"

namespace cnctrans::backends::heidenhain {

/// The codes of what the language has no statement, word or cycle for.
inline constexpr std::string_view no_statement = "TRN-201", no_word = "TRN-202", no_cycle = "TRN-214";

class Writer final : public ProgramWriter {
 public:
  Writer(const ir::Program& program, const WriteOptions& options, Diagnostics& diagnostics);

 protected:
  void write_program() override;
  ExpressionPrinter& expressions() override { return printer_; }
  std::string word(std::string_view address, const ir::Value& value, WordPos pos) override;
  std::string label_text(const ir::LineInfo& info) override;
  void before_statement(const ir::Statement& next) override;
  bool joins(const ir::Statement& before, const ir::Statement& next) override;

  void block(const ir::Block& b) override;
  void assign(const ir::Assign& a) override;
  void jump(const ir::Jump& j) override;
  void repeat(const ir::Repeat& r) override;
  void call(const ir::CallRoutine& c) override;
  void return_from(const ir::Return& r) override;
  void end_program(const ir::End& e) override;
  void message(const ir::Message& m) override;

  bool own_line(const ir::Action& a, const ir::Block& b) override;
  void modal_set(const ir::Action& a, const ir::ModalSet& m) override;
  void set_feed(const ir::Action& a, const ir::SetFeed& f) override;
  void set_spindle(const ir::Action& a, const ir::SetSpindle& s) override;
  void spindle_gear(const ir::Action& a, const ir::SpindleGear& s) override;
  void tool_select(const ir::Action& a, const ir::ToolSelect& t) override;
  void tool_change(const ir::Action& a) override;
  void tool_offset(const ir::Action& a, const ir::ToolOffset& t) override;
  void work_offset(const ir::Action& a, const ir::WorkOffset& w) override;
  void frame_op(const ir::Action& a, const ir::FrameOp& f) override;
  void dwell(const ir::Action& a, const ir::Dwell& d) override;
  void stop(const ir::Action& a, const ir::Stop& s) override;
  void corner(const ir::Action& a, const ir::Corner& c) override;
  void cycle_define(const ir::Action& a, const ir::CycleDefine& c) override;
  void cycle_cancel(const ir::Action& a) override;

  void motion(const ir::Motion& m) override;

 private:
  // files
  void open_program(const std::string& stem, bool main);
  void close_program();
  void write_routine(std::size_t index);
  [[nodiscard]] std::string called_stem(std::size_t routine) const;
  [[nodiscard]] std::optional<std::size_t> callee(const ir::CallRoutine& c) const;

  // words that wait for a block that can take them
  void say_waiting();
  [[nodiscard]] std::string take_waiting();  ///< the line that says it; empty: nothing waits
  void forget_waiting() { feed_.reset(), side_.reset(); }
  [[nodiscard]] bool is_join(const ir::LineInfo& info) const;

  // words
  std::string amount(const ir::Value& value, WordPos pos);         ///< unsigned: F500, FQ5
  std::string signed_amount(const ir::Value& value, WordPos pos);  ///< +10, -Q5
  std::string condition_operand(const ir::ExprPtr& e);
  std::string tool_call(const ir::Action& change);
  void shift(const ir::Action& a, const ir::FrameChange& c);
  void scale(const ir::Action& a, const ir::Value& factor);
  void old_cycle(int number, const std::vector<std::string>& parts);

  // cycles
  std::string q_line(std::int16_t cycle, std::int16_t number, const ir::Value& value, WordPos pos);
  std::string definition(const ir::Statement& call, const ir::CycleDefine& d);
  void define_cycle(const ir::Statement& call, const ir::CycleDefine& d);
  void own_speed(const ir::HoleCycle& c);
  void spindle_again(const ir::CycleDefine& d);

  // motion
  std::optional<ir::MotionKind> kind_of(const ir::Motion& m);
  std::optional<bool> increment(const ir::CoordWord& w);
  void straight(const ir::Motion& m, bool rapid);
  void arc(const ir::Motion& m, bool ccw);
  void coordinates(const ir::Motion& m);
  void side_word();
  void feed_word(bool rapid);
  [[nodiscard]] bool has_centre_line(const ir::Block& b);
  void centre_line(const ir::Motion& m);
  std::string centre_word(const ir::Motion& m, ir::AxisId axis);

  Expressions printer_;
  LabelNames names_;
  ToolPlan tools_;
  CallPlan plan_;
  std::string stem_;                 ///< of the file being written
  std::string unit_;                 ///< MM or INCH
  std::optional<std::string> feed_;  ///< F that no block has said yet
  std::optional<ir::CompSide> side_;
  std::string defined_;  ///< the cycle definition that is surely in force
  bool gear_told_ = false;
  bool moves_ = false;  ///< the block at hand moves
  std::string corner_;  ///< what stands behind its move
};

}  // namespace cnctrans::backends::heidenhain
