// The words that begin a sentence of the dialog (reference 1.11, appendix A). Path functions (L, C, CC, RND ...) are
// words with what follows them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cnctrans::dialects::heidenhain {

/// Beside the coordinates of LN: the normal of the surface and the direction of the tool.
inline constexpr std::string_view vector_words = "NX NY NZ TX TY TZ";

enum class Sentence : std::uint8_t {
  none,
  begin_program,
  end_program,
  blank_form,
  tool_def,
  tool_call,
  cycle_def,
  cycle_call,
  label,
  call_label,
  call_program,
  call_selected,
  select_program,
  stop,
  plane,
  probe,
  pattern,
  select_pattern,
  global_def,
  shift,      ///< TRANS DATUM
  approach,   ///< APPR
  departure,  ///< DEP
  free_contour,
  declare_string,
  select_table,  ///< SEL TABLE: of the rows that cycle 7 names, which are not carried
  carried        ///< read, and kept as text
};
struct SentenceRow {
  std::string_view words;  ///< one blank between two
  Sentence sentence;
};
/// The longer one first where one begins with the other.
inline constexpr std::array sentences{
    SentenceRow{"BEGIN PGM", Sentence::begin_program},
    SentenceRow{"END PGM", Sentence::end_program},
    SentenceRow{"BLK FORM", Sentence::blank_form},
    SentenceRow{"TOOL DEF", Sentence::tool_def},
    SentenceRow{"TOOL CALL", Sentence::tool_call},
    SentenceRow{"CYCL DEF", Sentence::cycle_def},
    SentenceRow{"CYCLE DEF", Sentence::cycle_def},
    SentenceRow{"CYCL CALL", Sentence::cycle_call},
    SentenceRow{"LBL", Sentence::label},
    SentenceRow{"CALL LBL", Sentence::call_label},
    SentenceRow{"CALL PGM", Sentence::call_program},
    SentenceRow{"CALL SELECTED PGM", Sentence::call_selected},
    SentenceRow{"SEL PGM", Sentence::select_program},
    SentenceRow{"STOP", Sentence::stop},
    SentenceRow{"PLANE", Sentence::plane},
    SentenceRow{"TCH PROBE", Sentence::probe},
    SentenceRow{"PATTERN DEF", Sentence::pattern},
    SentenceRow{"GLOBAL DEF", Sentence::global_def},
    SentenceRow{"TRANS DATUM", Sentence::shift},
    SentenceRow{"APPR", Sentence::approach},
    SentenceRow{"DEP", Sentence::departure},
    SentenceRow{"FLT", Sentence::free_contour},
    SentenceRow{"FL", Sentence::free_contour},
    SentenceRow{"FCT", Sentence::free_contour},
    SentenceRow{"FC", Sentence::free_contour},
    SentenceRow{"FPOL", Sentence::free_contour},
    SentenceRow{"FSELECT", Sentence::free_contour},
    SentenceRow{"DECLARE STRING", Sentence::declare_string},
    SentenceRow{"DECLARE CONTOUR", Sentence::carried},
    SentenceRow{"CONTOUR DEF", Sentence::carried},
    SentenceRow{"SEL CONTOUR", Sentence::carried},
    SentenceRow{"SEL PATTERN", Sentence::select_pattern},
    SentenceRow{"SEL TABLE", Sentence::select_table},
    SentenceRow{"FUNCTION", Sentence::carried},
    SentenceRow{"SPL", Sentence::carried},
};

}  // namespace cnctrans::dialects::heidenhain
