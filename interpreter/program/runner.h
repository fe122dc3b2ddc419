// Runs a whole program: control flow, calls, variables. Blocks are carried out by BlockMachine.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "interpreter/machine/block_machine.h"
#include "interpreter/program/interpreter.h"
#include "interpreter/program/routines.h"
#include "ir/edit/file_line.h"

namespace cnctrans::interpreter {

class Runner {
 public:
  Runner(const ir::Program& program, const machine::Profile& profile, const Options& options, TraceSink& sink,
         Diagnostics& diagnostics);
  Result run();

 private:
  /// One value handed to a parameter.
  struct Bound {
    const ir::Parameter* parameter = nullptr;  ///< null: a level variable of number `number`
    NumberedSpace* space = nullptr;
    std::uint32_t number = 0;
    bool is_text = false, by_reference = false, given = false;
    double value = 0;
    std::string text;
    Place reference;
    unsigned position = 0;  ///< bit in the mask of given arguments
  };
  struct Activation {
    Flow* flow = nullptr;
    Locals locals;
    std::uint32_t return_to = 0;  ///< in the caller
    std::uint32_t entry = 0, stop = nowhere;
    std::int64_t left = 1;  ///< passes still to be done, this one included
    bool opened_level = false, modal = false;
    std::uint64_t caller_arguments = 0;  ///< given to the caller, where both share a level
    std::optional<ir::ModalState> saved;
    std::size_t repeats = 0;       ///< open repeats below belong to callers
    std::vector<Bound> arguments;  ///< kept while passes are left: each starts from them
  };
  struct RepeatFrame {
    std::uint32_t begin = 0, end = 0, return_to = 0;
    std::int64_t left = 1;
    bool block = false;           ///< a block that repeats itself
    std::string last{};           ///< label of its end where a later one counts as well; empty: only the one found
    std::uint32_t first_end = 0;  ///< with `last`: the end of a pass that is not left
    bool curve = false;           ///< its blocks are the points of a curve
  };
  struct PendingCall {
    bool active = false;
    const ir::CallRoutine* call = nullptr;
    Flow* flow = nullptr;
    std::vector<Bound> arguments;
    bool keeps_locals = false;  ///< the run is a further one of a repeated block: it goes on with `left_behind`
    Level left_behind;          ///< local parameters as the last run left them
  };
  enum class State : std::uint8_t { running, ended, failed, event_limit, step_limit };

  // run.cpp
  bool apply_settings();
  bool apply_setting(const std::string& name, const std::string& value);
  void loop();
  bool over_limits();
  void step(Instruction& in);
  void lines_behind(const Span& line);
  void fail_whole();
  [[nodiscard]] bool begins(const Instruction& in) const;
  void go_to(std::uint32_t next);
  void arrived();
  void left_behind();
  void enter_top();
  void fail_state() { state_ = State::failed; }
  Result finish(EndReason reason, const Span& where);
  Result refuse();
  void keep_locals();
  void report_settings();

  // statements.cpp
  void block(Instruction& in);
  void assign(const ir::Statement& s);
  bool condition(Instruction& in);
  bool note_outcome(const Instruction& in, bool holds);
  void for_begin(const ir::For& f);
  bool for_test(const ir::For& f);
  void for_step(const ir::For& f);
  void jump(Instruction& in);
  void take(const ir::Jump& j, std::uint32_t* known);
  void choose(const ir::Switch& s);
  void message(const ir::Message& m, const Span& where);
  void declare(const ir::Declare& d);

  // files.cpp
  bool write_file(const ir::FileStatement& f, const std::string& text);
  bool file_name(const ir::ExprPtr& e, std::string& out);
  WrittenFile* written(const std::string& name);
  bool written_routine(const ir::RoutineName& name, Flow*& out);

  void declare_one(const ir::Declare& d, const ir::Declare::Item& item);
  bool computed_label(const ir::ExprPtr& e, std::string& key);
  bool label_of(const ir::LabelRef& l, std::string& key);
  bool whole_number(const ir::ExprPtr& e, std::int64_t otherwise, std::int64_t& out);

  // calls.cpp
  void repeat(const ir::Repeat& r);
  bool curve_statement(const ir::Repeat& r);
  void call(const ir::CallRoutine& c);
  void modal_call(const ir::ModalCall& m);
  void run_modal_call(std::uint32_t next);
  [[nodiscard]] std::string bare_name(std::string name) const;
  Flow* callee_of(const ir::CallRoutine& c);
  bool range_in(Flow& flow, const ir::LabelRef& first, const ir::LabelRef& last, bool order_free, std::uint32_t& begin,
                std::uint32_t& end);
  bool bind(const ir::CallRoutine& c, Flow& callee, std::vector<Bound>& out);
  bool bind_one(const ir::Argument& a, std::size_t position, Flow& callee, Bound& out);
  bool enter(Flow& callee, const std::vector<Bound>& arguments, ir::CallLevel level, std::uint32_t return_to,
             std::int64_t count);
  bool hand_over(const std::vector<Bound>& arguments, bool again = false);
  bool set_parameter(const Bound& b);
  void give_back(const ir::Return& r);
  void leave(bool returned);
  std::uint32_t close_call();
  void end_program(const ir::End& e);

  const ir::Program& program_;
  const machine::Profile& profile_;
  const Options& options_;
  Diagnostics& diagnostics_;
  Failure failure_;
  Variables variables_;
  Evaluator evaluator_;
  Emitter emitter_;
  BlockMachine machine_;
  Routines routines_;

  std::deque<Activation> calls_;
  std::vector<RepeatFrame> repeats_;
  std::set<std::int32_t> curves_;  ///< defined now
  Flow* flow_ = nullptr;
  std::uint32_t at_ = 0;
  std::uint32_t repeat_end_ = nowhere, stop_ = nowhere;
  PendingCall modal_;
  std::int32_t in_modal_ = 0;
  State state_ = State::running;
  std::uint64_t steps_ = 0, blocks_ = 0, next_check_ = 0, silent_since_ = 0, seen_events_ = 0;
  std::vector<std::uint8_t> covered_, outcomes_;
  std::size_t local_levels_ = 0;
  std::vector<WrittenFile> written_;
  std::size_t open_file_ = no_file;  ///< the one opened last
  static constexpr std::size_t no_file = ~std::size_t{0};
  std::map<std::string, const ir::Program*> read_written_;  ///< by their text
  Span last_;
};

}  // namespace cnctrans::interpreter
