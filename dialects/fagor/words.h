// Statement words of the high-level language (ch. 11, 12) and device words.
#pragma once

#include <array>
#include <string_view>

namespace cnctrans::dialects::fagor {

inline constexpr std::array<std::string_view, 43> statement_words = {
    "ERROR", "MSG",  "DGWZ",  "ESBLK", "DSBLK", "ESTOP",  "DSTOP",  "EFHOLD", "DFHOLD", "GOTO", "RPT",
    "IF",    "ELSE", "SUB",   "RET",   "CALL",  "PCALL",  "MCALL",  "MDOFF",  "LSUB",   "LL",   "PROBE",
    "REPOS", "EXEC", "MEXEC", "OPEN",  "WRITE", "PAGE",   "SYMBOL", "IB",     "INPUT",  "ODW",  "DW",
    "DWH",   "DWB",  "SK",    "WKEY",  "WBUF",  "SYSTEM", "DIGIT",  "TRACE",  "PI",     "ARG"};
inline constexpr std::array<std::string_view, 3> device_words = {"HD", "DNC2", "DNCE"};

}  // namespace cnctrans::dialects::fagor
