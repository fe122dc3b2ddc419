// The writer of NUM programs: statements and words over the shared ProgramWriter.
#pragma once

#include <set>
#include <string_view>

#include "backends/common/file_groups.h"
#include "backends/common/program_writer.h"
#include "backends/num/chain_printer.h"
#include "dialects/num/assumed_cycles.h"
#include "dialects/num/options.h"

namespace cnctrans::backends::num {

/// The code of what the language has no word for.
inline constexpr std::string_view no_word = "TRN-202";

class Writer final : public ProgramWriter {
 public:
  Writer(const ir::Program& program, const WriteOptions& options, Diagnostics& diagnostics);

 protected:
  void write_program() override;
  ExpressionPrinter& expressions() override { return printer_; }
  std::string word(std::string_view address, const ir::Value& value, WordPos pos) override;

  void block(const ir::Block& b) override;
  bool to_plane(const ir::Block& b);
  void assign(const ir::Assign& a) override;
  void if_else(const ir::If& i) override;
  void while_loop(const ir::While& w) override;
  void until_loop(const ir::Until& u) override;
  void for_loop(const ir::For& f) override;
  void exit_loop() override;
  void jump(const ir::Jump& j) override;
  void repeat(const ir::Repeat& r) override;
  void curve(const ir::Repeat& r);
  void call(const ir::CallRoutine& c) override;
  void return_from(const ir::Return& r) override;
  void end_program(const ir::End& e) override;
  void message(const ir::Message& m) override;
  void declare(const ir::Declare& d) override;

  void modal_set(const ir::Action& a, const ir::ModalSet& m) override;
  void freezes_speed(const ir::Action& a, const ir::ModalSet& m);
  bool css_ = false;  ///< G96 was written last, G97 not since
  void stop(const ir::Action& a, const ir::Stop& s) override;
  void spindle_orient(const ir::Action& a, const ir::SpindleOrient& s) override;
  void spindle_limit(const ir::Action& a, const ir::SpindleLimit& s) override;
  void tell_limit(const ir::Action& a, const ir::SpindleLimit& s);
  void work_offset(const ir::Action& a, const ir::WorkOffset& w) override;
  void frame_op(const ir::Action& a, const ir::FrameOp& f) override;
  void surface_set(const ir::Action& a, const ir::SurfaceSet& s) override;
  void dwell(const ir::Action& a, const ir::Dwell& d) override;
  void cycle_define(const ir::Action& a, const ir::CycleDefine& c) override;
  void cycle_cancel(const ir::Action& a) override;
  void corner(const ir::Action& a, const ir::Corner& c) override;

  void motion(const ir::Motion& m) override;
  void frame_use(const ir::Motion& m) override;
  void coordinate(const ir::Motion& m, const ir::CoordWord& w) override;
  bool inverse_time_arc(WordPos pos);
  [[nodiscard]] bool switched(const ir::Motion& m, const ir::CoordWord& w);
  void center(const ir::Motion& m, const ir::CenterWord& w) override;
  void radius(const ir::Motion& m) override;
  void motion_extra(const ir::Motion& m, const ir::MotionExtra& e) override;

  bool spelling_is_whole_word(const ir::Action& a) const override;
  bool joins(const ir::Statement& before, const ir::Statement& next) override;

 private:
  const dialects::num::Options own_options_;  ///< of the target machine
  void write_routine(std::size_t index, std::int64_t number);
  void open_called(const FileGroup& group, const std::string& main_stem);
  [[nodiscard]] std::int64_t main_number() const;
  [[nodiscard]] std::string condition(const ir::ExprPtr& e);
  [[nodiscard]] bool structured_allowed();
  std::string structured_condition(const ir::ExprPtr& e);
  [[nodiscard]] bool behind_words(WordPos pos) const;
  [[nodiscard]] bool begins_css() const;
  [[nodiscard]] bool machine_frame_in_incremental(const ir::Motion& m);
  bool increment(const ir::CoordWord& w);  ///< it says a way, not a position
  std::string decimals(const ir::Value& value);
  std::string level_word(std::string_view address, const ir::Level& level, WordPos pos);
  void shift(const ir::Action& a, const ir::FrameChange& c);
  void straight_extra(const ir::Motion& m, const ir::MotionExtra& e);
  void pocket(const ir::Action& a, const ir::HoleCycle& c);
  void hole_cycle(const ir::Action& a, const ir::HoleCycle& c);
  bool turning_cycle(const ir::Action& a, const ir::NamedCycle& c);
  using CycleWords = std::vector<std::pair<std::string, ir::Value>>;
  bool other_habits(const ir::Action& a, const CycleWords& words, const dialects::num::CycleHabits& habits);
  void hole_levels(const ir::Action& a, const ir::HoleCycle& c);
  [[nodiscard]] std::string target_variable(const ir::VarRef& v);

  ChainPrinter printer_;
  bool cycle_here_ = false;  ///< the block being written defines a cycle
  bool cancelled_ = false;   ///< ... or ends one
  bool inch_rounding_noted_ = false;
  std::set<std::uint32_t> declares_first_, declares_last_;
};

}  // namespace cnctrans::backends::num
