// Statement words of the high-level language (ch. 11, 12): what becomes of each.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cnctrans::dialects::fagor {

enum class Carried : std::uint8_t {
  yes,      ///< read, run and written
  no_path,  ///< no effect on the path: kept as text with a note
  no        ///< kept as text with a warning; a run stops there. `feature` is the key in the missing-features registry
};
struct StatementInfo {
  std::string_view word;
  std::string_view section;
  std::string_view title;
  Carried carried = Carried::yes;
  std::string_view feature = {};
};
inline constexpr std::string_view keeps = "language.statement";
inline constexpr std::array<StatementInfo, 41> statements = {{
    {"ERROR", "12.2", "message and stop"},
    {"ERREUR", "12.2", "the French manual's print of ERROR"},
    {"MSG", "12.2", "message"},
    {"DGWZ", "12.2", "graphic zone", Carried::no_path, keeps},
    {"ESBLK", "12.3", "blocks treated as one", Carried::no_path, keeps},
    {"DSBLK", "12.3", "end of that", Carried::no_path, keeps},
    {"ESTOP", "12.3", "STOP allowed", Carried::no_path, keeps},
    {"DSTOP", "12.3", "STOP locked", Carried::no_path, keeps},
    {"EFHOLD", "12.3", "feed-hold allowed", Carried::no_path, keeps},
    {"DFHOLD", "12.3", "feed-hold locked", Carried::no_path, keeps},
    {"GOTO", "12.4", "jump"},
    {"RPT", "12.4", "repeated range"},
    {"IF", "12.4", "condition"},
    {"ELSE", "12.4", "condition"},
    {"SUB", "12.5", "subroutine"},
    {"LSUB", "2.2", "local subroutine"},
    {"RET", "12.5", "end of a subroutine"},
    {"CALL", "12.5", "call"},
    {"PCALL", "12.5", "call with parameters"},
    {"MCALL", "12.5", "modal call"},
    {"MDOFF", "12.5", "end of a modal call"},
    {"LL", "2.2", "call of a local subroutine"},
    {"PROBE", "10.3", "probing cycle", Carried::no, "motion.probe"},
    {"DIGIT", "25.9", "digitising", Carried::no, "motion.probe"},
    {"TRACE", "25.9", "tracing", Carried::no, "motion.probe"},
    {"REPOS", "12.7", "return to the interrupted point", Carried::no, keeps},
    {"EXEC", "12.8", "run of another program"},
    {"MEXEC", "12.8", "modal run of another program"},
    {"OPEN", "12.8", "a program is written"},
    {"WRITE", "12.8", "a block of that program"},
    {"PAGE", "12.9", "screen", Carried::no_path, keeps},
    {"SYMBOL", "12.9", "screen", Carried::no_path, keeps},
    {"IB", "12.9", "input of the operator", Carried::no, "beside.data"},
    {"INPUT", "12.9", "input of the operator", Carried::no, keeps},
    {"ODW", "12.9", "screen", Carried::no_path, keeps},
    {"DW", "12.9", "screen", Carried::no_path, keeps},
    {"SK", "12.9", "soft keys", Carried::no, keeps},
    {"WKEY", "12.9", "waits for a key", Carried::no, "beside.data"},
    {"WBUF", "12.9", "edited block", Carried::no, "beside.data"},
    {"SYSTEM", "12.9", "end of a user page", Carried::no, keeps},
    {"PI", "11.3", "constant"},
}};
inline constexpr const StatementInfo* find_statement(std::string_view word) {
  for (const auto& s : statements) {
    if (s.word == word) return &s;
  }
  return nullptr;
}

}  // namespace cnctrans::dialects::fagor
