// A routine as a flat list of instructions: structures become conditional jumps, so that a label inside a structure can
// be reached from anywhere. Built once per routine.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/program/interpreter.h"
#include "interpreter/values/expressions.h"
#include "ir/program.h"

namespace cnctrans::interpreter {

inline constexpr std::uint32_t nowhere = 0xffffffff;

enum class Op : std::uint8_t {
  nothing,  ///< a place for labels
  block,
  lines_behind,  ///< blocks that are not in the program
  assign,
  branch_false,  ///< to `target` when `expr` is zero
  go,            ///< structural jump to `target`
  jump,          ///< programmed jump (ir::Jump)
  choose,        ///< ir::Switch
  for_begin,
  for_test,
  for_step,
  repeat,
  call,
  modal_call,
  give_back,
  end,
  message,
  declare,
  opaque,
  fault,      ///< a line that reading gave an error for
  stray_exit  ///< an Exit outside of loops
};

struct Instruction {
  Op op = Op::nothing;
  std::uint32_t target = nowhere;      ///< jump, loop end; repeat: first instruction of the range
  std::uint32_t target_end = nowhere;  ///< repeat: one past the last
  ExprId expr = no_expr;               ///< compiled at first use
  const ir::Statement* statement = nullptr;
  const ir::Jump* jump_node = nullptr;  ///< jump
  const Diagnostic* fault = nullptr;    ///< fault
};

/// A labelled block: its instructions are begin..end-1 (all statements of its source line).
struct LabelPlace {
  std::uint32_t begin = 0, end = 0;
};

struct Flow {
  const ir::Routine* routine = nullptr;
  const ir::Program* program = nullptr;
  NameScope names;
  std::vector<NamedVariable> locals;  ///< shapes of the locals, in the order of their index
  std::vector<Instruction> code;
  std::map<std::string, std::vector<LabelPlace>, std::less<>> labels;  ///< by label_key(), in text order

  /// The place a jump from instruction `from` finds; null: there is none.
  [[nodiscard]] const LabelPlace* find(std::string_view key, ir::Search search, std::uint32_t from) const;
  /// The end of a repeated part whose beginning is known: the next such label from there on, or the first of all.
  [[nodiscard]] const LabelPlace* find_end(std::string_view key, ir::Search search, const LabelPlace& first) const;
  /// Range of a Repeat at `from` with fixed labels. False when a label is missing (its text in `missing`).
  bool range(std::string_view first, std::string_view last, ir::Search search, bool order_free, std::uint32_t from,
             std::uint32_t& begin, std::uint32_t& end, std::string& missing) const;
};

/// "#120" for block number 120, "NAME" for an identifier.
std::string label_key(const ir::LabelRef& label);
std::string label_key(std::string_view text, bool is_number);
/// A label as the program wrote it, for messages.
std::string label_text(std::string_view key);

/// Blocks whose skip level is on are left out; their labels stay. A line that reading gave an error for is a fault.
Flow build_flow(const ir::Program& program, const ir::Routine& routine, const Options& options);
/// What a reached fault is to the run.
std::string fault_text(const Diagnostic& fault);

/// Name of a routine for messages.
std::string routine_text(const ir::RoutineName& name);

}  // namespace cnctrans::interpreter
