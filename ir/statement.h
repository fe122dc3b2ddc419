// Statements: blocks, assignments, control flow, calls, texts. Nothing is dropped: every statement carries its line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/span.h"
#include "ir/block.h"
#include "ir/expr.h"

namespace cnctrans::ir {

/// The name of a routine: a number, an identifier, or both ("L0123" differs from "L123": `text` decides, then
/// `number`).
struct RoutineName {
  std::int64_t number = -1;  ///< -1: none
  std::string text;          ///< identifier as the source writes it, folded to capitals where case does not count
  [[nodiscard]] bool empty() const { return number < 0 && text.empty(); }
  bool operator==(const RoutineName&) const = default;
};

enum class CommentPlace : std::uint8_t { end_of_line, own_line, mid_line };
struct CommentText {
  std::string_view text;  ///< without the marks, bytes untouched
  CommentPlace place = CommentPlace::end_of_line;
  WordPos pos;
};

/// What a source line carries besides its meaning. Views point into text that the program keeps.
struct LineInfo {
  Span span;
  std::string_view number;               ///< digits of the block number as written; empty: none
  char number_mark = 'N';                ///< or ':' (main block)
  std::vector<std::string_view> labels;  ///< identifier labels
  std::uint16_t skip_mask = 0;           ///< bit n = level n; several = any of them
  std::vector<CommentText> comments;
  bool joined = false;  ///< belongs to the same source line as the statement before
  std::uint16_t blank_lines_before = 0;

  void clear() {
    span = {};
    number = {};
    number_mark = 'N';
    labels.clear();
    skip_mask = 0;
    comments.clear();
    joined = false;
    blank_lines_before = 0;
  }
};

struct Statement;
using Body = std::vector<Statement>;

/// `targets[i] := values[i]`, in order, one after the other.
struct Assign {
  struct Item {
    VarRef target;
    ExprPtr value;
    WordPos pos;
    SystemRef system;  ///< when `to_system`: a machine datum is written
    bool to_system = false;
  };
  std::vector<Item> items;
};

/// One-line form (`IF c action ELSE action`) or structured.
struct If {
  ExprPtr condition;
  Body then_body, else_body;
  bool one_line = false;
  bool has_else = false;
  LineInfo else_line, end_line;
};
struct While {
  ExprPtr condition;
  Body body;
  LineInfo end_line;
};
/// Runs at least once.
struct Until {
  Body body;
  ExprPtr condition;
  LineInfo end_line;
};
struct For {
  VarRef counter;
  ExprPtr from, to, step;  ///< `to` and `step` are evaluated before each pass; step null: 1
  Body body;
  LineInfo end_line;
};
struct Loop {
  Body body;
  LineInfo end_line;
};
struct Exit {};

enum class Search : std::uint8_t {
  whole_first,  ///< first one from the start of the routine's file part
  forward,
  backward,
  forward_then_backward,
  to_start  ///< the routine's first block
};
/// A label: block number or identifier, fixed or computed.
struct LabelRef {
  std::string text;  ///< digits of a number without leading zeros, or identifier in capitals
  bool is_number = false;
  ExprPtr computed;  ///< when not null the label is found at run time
};
struct Jump {
  LabelRef target;
  ExprPtr condition;  ///< null: always
  Search search = Search::whole_first;
  bool quiet = false;  ///< a missing label is no error: go on with the next block
};
/// Several computed targets by a value: the first case that equals it, else `fallback`.
struct Switch {
  ExprPtr value;
  std::vector<std::pair<ExprPtr, Jump>> cases;
  std::vector<Jump> fallback;  ///< none or one
};
/// The blocks of a range as the points of a curve with a number.
enum class CurveUse : std::uint8_t {
  none,
  define,  ///< the curve is defined; its blocks are not carried out
  run,     ///< they are carried out as the points of one curve
  remove   ///< the curve is forgotten; no labels
};
/// The blocks from the one labelled `first` to the one labelled `last` (inclusive) are carried out `count` times, here.
/// `last` empty (no text, not computed): from `first` up to this statement, itself not included.
struct Repeat {
  LabelRef first, last;
  ExprPtr count;  ///< null: 1
  Search search = Search::whole_first;
  bool order_free = false;   ///< the labels may stand in either order
  bool has_program = false;  ///< the range stands in another routine
  RoutineName program;
  CurveUse curve_use = CurveUse::none;
  std::int32_t curve = 0;  ///< number of the curve
};

enum class CallLevel : std::uint8_t {
  shared,    ///< callee works on the caller's local parameters
  new_level  ///< callee has local parameters of its own
};
struct Argument {
  std::string name;  ///< letter ("A") or formal name; empty: by position
  ExprPtr value;     ///< null: omitted (default)
  bool by_reference = false;
  VarRef reference;
};
struct CallRoutine {
  RoutineName routine;
  ExprPtr computed;  ///< when not null the number is found at run time
  std::vector<Argument> arguments;
  CallLevel level = CallLevel::shared;
  ExprPtr count;           ///< null: once
  bool has_range = false;  ///< only the blocks `first`..`last` of the routine
  LabelRef first, last;
  bool tail = false;  ///< does not come back (EXEC)
  bool optional = false;
};
/// After every later block with motion the call is made; `off` ends it.
struct ModalCall {
  bool off = false;
  bool here = false;  ///< also made at once
  CallRoutine call;
  CyclePtr cycle;  ///< or a cycle instead of a call
};
struct Return {
  std::vector<ExprPtr> values;
  std::string_view text;  ///< as written ("M17", "RET")
};
/// End of the program. `returns`: in a subprogram it only returns.
struct End {
  std::string_view text;  ///< as written ("M30")
  bool returns_from_sub = false;
};
enum class MessageKind : std::uint8_t { show, clear, error };
/// What a statement does with a file of the control.
enum class FileUse : std::uint8_t {
  create,   ///< opens it; an error where there is one of that name
  replace,  ///< opens it; what it held is gone
  append,   ///< opens it; lines come behind what it holds
  line      ///< a line: into the file it names, else into the one opened last
};
struct Message {
  MessageKind kind = MessageKind::show;
  std::vector<ExprPtr> parts;  ///< strings and numbers, joined
  ExprPtr number;              ///< error number; of a statement for a file its name or number, null: none is named
  /// A statement for a file of the control, as it was written (ir/edit/file_line.h). A run shows its lines.
  std::string file_line;
  FileUse file_use = FileUse::line;
};
/// Definition of variables.
struct Declare {
  struct Item {
    std::string name;
    std::vector<ExprPtr> dimensions;
    std::vector<ExprPtr> initial;
  };
  Type type = Type::real;
  std::string type_text;  ///< as written where the type has more to it ("STRING[20]")
  SpaceId space = 0;
  std::vector<Item> items;
};
/// Labels are in LineInfo; a Label statement is a mark without a block (end label of a repeated part).
struct Label {};
/// Kept text of a construct that is carried, not understood. `moves`: it could move the machine or change its state.
struct Opaque {
  std::string text;
  std::string feature;  ///< key in the missing-features registry
  bool harmless = false;
};

/// What a statement does. Its special members are compiled once (ir/statement.cpp), as those of ActionData.
struct StatementNode : std::variant<Block, Assign, If, While, Until, For, Loop, Exit, Jump, Switch, Repeat, CallRoutine,
                                    ModalCall, Return, End, Message, Declare, Label, Opaque> {
  using variant::variant;
  StatementNode();
  StatementNode(const StatementNode&);
  StatementNode(StatementNode&&) noexcept;
  StatementNode& operator=(const StatementNode&);
  StatementNode& operator=(StatementNode&&) noexcept;
  ~StatementNode();
};

struct Statement {
  LineInfo line;
  StatementNode node;
  std::uint32_t id = 0;  ///< given by number_statements()
};

}  // namespace cnctrans::ir
