// How a target language looks: the tables and switches that the shared writers read. One constexpr Style a dialect.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "ir/expr.h"
#include "ir/modal.h"

namespace cnctrans::backends {

/// Place of a word in its line when the source has no place for it: lower comes first. Words of the source keep their
/// order (by column) unless Style::order_by_rank.
enum class Rank : std::uint8_t {
  head,         ///< assignments and statement words that open a line
  setting,      ///< G17 G90 ...
  frame,        ///< G53, SUPA: which offsets count in this block
  motion_code,  ///< G1
  coordinate,
  center,
  radius,
  motion_extra,  ///< TURN=, RND=, K of a thread
  feed,
  spindle,
  tool,
  offset,
  machine,  ///< M and H
  tail      ///< M30, jumps: after everything
};

struct ModalCode {
  ir::Setting setting;
  std::uint8_t value;     ///< enumerator of the setting's type
  std::string_view code;  ///< "G17"
};
struct MotionCode {
  ir::MotionKind kind;
  std::string_view code;
};

struct CommentStyle {
  std::string_view open = ";";
  std::string_view close = {};      ///< empty: the comment runs to the end of the line
  bool blank_after_open = false;    ///< texts of other languages get a blank after the mark when they have none
  bool trim = false;                ///< texts of other languages lose blanks at both ends
  bool ascii = false;               ///< letters are transliterated, other characters become '?'
  bool upper = false;               ///< capitals only
  std::string_view forbidden = {};  ///< characters that can't stand in a comment ...
  std::string_view instead = {};    ///< ... and what is written for each of them
  std::size_t gap = 1;              ///< blanks between the last word and the comment
  bool line_before = false;         ///< a comment at the end of a block goes to a line of its own before it
};

struct Style {
  bool approaches_cycles = false;  ///< the writer may put a rapid to the retract plane before a hole cycle
  std::string_view dialect = {};
  CommentStyle comment = {};
  std::span<const ModalCode> modal_codes = {};
  std::span<const MotionCode> motion_codes = {};
  std::string_view falling_thread = {};  ///< a thread whose lead becomes smaller ("G35"); empty: the sign says it
  int kept_decimals = 4;                 ///< a number text of the source with more places is rounded
  int made_decimals = 4;                 ///< places of numbers that passes made
  bool two_digit_m = false;              ///< M03
  std::size_t line_length = 0;           ///< most characters of a block; 0: no limit is known
  bool order_by_rank = false;            ///< words always in rank order, also when the source had another one
  bool label_blocks = false;             ///< a label is a block of its own; block numbers say nothing and are made last
  std::size_t indent = 0;                ///< blanks a nesting level of structured statements
  bool code_waits_for_move = false;      ///< the code of a cut stands in the block of its move, never alone
  bool blank_lines = true;               ///< blank lines of the source are kept
  std::string_view blank_line = {};      ///< what stands in a blank line (";" where it can't be empty)
  std::string_view only_label = {};      ///< what must follow a block number that stands alone (";")
  std::string_view exact_stop_block = {};  ///< "G9"; empty: the target has none
  std::string_view preparation_stop = {};  ///< "STOPRE"; empty: none
  std::string_view radius_address = "R";
  /// Skip marks: text for level n at index n; a level beyond the end has no counterpart.
  std::span<const std::string_view> skip_marks = {};
};

inline constexpr std::string_view modal_code(const Style& style, ir::Setting setting, std::uint8_t value) {
  for (const ModalCode& c : style.modal_codes) {
    if (c.setting == setting && c.value == value) return c.code;
  }
  return {};
}
inline constexpr std::string_view motion_code(const Style& style, ir::MotionKind kind) {
  for (const MotionCode& c : style.motion_codes) {
    if (c.kind == kind) return c.code;
  }
  return {};
}
/// A value of an enumeration as a ModalCode entry wants it.
template <class Enum>
constexpr std::uint8_t code_value(Enum e) {
  return static_cast<std::uint8_t>(e);
}

}  // namespace cnctrans::backends
