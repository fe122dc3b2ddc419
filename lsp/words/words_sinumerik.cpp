#include <array>

#include "dialects/sinumerik/cycles.h"
#include "dialects/sinumerik/g_functions.h"
#include "dialects/sinumerik/milling.h"
#include "dialects/sinumerik/operators.h"
#include "dialects/sinumerik/turning.h"
#include "lsp/words/parameter_text.h"
#include "lsp/words/words_common.h"

namespace cnctrans::lsp {

namespace {

namespace sin = sinumerik;

struct Meaning {
  std::string_view name, text;
};
/// Parameters of the drilling cycles and patterns, and those that all cycles have.
constexpr std::array meanings = {
    Meaning{"RTP", "retract plane, absolute (mm)"},
    Meaning{"RFP", "reference plane, absolute (mm)"},
    Meaning{"SDIS", "safety distance above the reference plane (mm)"},
    Meaning{"DP", "final depth, absolute (mm)"},
    Meaning{"DPR", "final depth from the reference plane, unsigned (mm)"},
    Meaning{"DTB", "dwell at the final depth (s; negative: revolutions)"},
    Meaning{"DTS", "dwell at the start and between pecks (s)"},
    Meaning{"FDEP", "first depth, absolute (mm)"},
    Meaning{"FDPR", "first depth from the reference plane (mm)"},
    Meaning{"DAM", "amount by which pecks shrink (mm; negative: factor)"},
    Meaning{"FRF", "factor of the feed of the first peck"},
    Meaning{"VARI", "variant of the machining"},
    Meaning{"AXN", "number of the tool axis"},
    Meaning{"MDEP", "smallest peck (mm)"},
    Meaning{"VRT", "withdrawal (mm)"},
    Meaning{"DTD", "dwell at the last depth (s)"},
    Meaning{"DIS1", "distance to the last depth where feeding begins (mm)"},
    Meaning{"SDAC", "sense of the spindle behind the cycle: 3, 4 or 5"},
    Meaning{"SDR", "sense of the spindle on the way out: 0, 3 or 4"},
    Meaning{"SDIR", "sense of the spindle: 3 or 4"},
    Meaning{"MPIT", "size of the thread: 8 for M8"},
    Meaning{"PIT", "pitch of the thread (mm)"},
    Meaning{"POSS", "position of the spindle (°)"},
    Meaning{"SST", "speed of tapping (rev/min)"},
    Meaning{"SST1", "speed on the way out (rev/min)"},
    Meaning{"ENC", "with or without encoder"},
    Meaning{"FFR", "feed (mm/min)"},
    Meaning{"RFF", "feed on the way out (mm/min)"},
    Meaning{"RPA", "lift in the first axis (mm)"},
    Meaning{"RPO", "lift in the second axis (mm)"},
    Meaning{"RPAP", "lift in the tool axis (mm)"},
    Meaning{"SPCA", "reference point, first axis (mm)"},
    Meaning{"SPCO", "reference point, second axis (mm)"},
    Meaning{"CPA", "centre, first axis (mm)"},
    Meaning{"CPO", "centre, second axis (mm)"},
    Meaning{"RAD", "radius (mm)"},
    Meaning{"STA", "angle (°)"},
    Meaning{"STA1", "angle of the first point (°)"},
    Meaning{"INDA", "angle between points (°)"},
    Meaning{"FDIS", "distance of the first hole to the reference point (mm)"},
    Meaning{"DBH", "distance between holes (mm)"},
    Meaning{"NUM", "number of holes"},
    Meaning{"KNAME", "contour: a subprogram, or two labels"},
    Meaning{"NPP", "contour: a subprogram, or two labels"},
    Meaning{"GMODE", "how depths are meant"},
    Meaning{"DMODE", "display and plane"},
    Meaning{"AMODE", "alternatives of the parameters"},
};

template <class Rows>
std::string_view neutral_name(const Rows& rows, std::string_view cycle, std::string_view parameter) {
  for (const auto& row : rows) {
    if (row.name != cycle) continue;
    for (const auto& [own, name] : row.parameters) {
      if (own == parameter && !name.empty()) return name;
    }
  }
  return {};
}

std::string meaning_of(std::string_view cycle, std::string_view parameter) {
  std::string_view name = neutral_name(sin::milling_cycles, cycle, parameter);
  if (name.empty()) name = neutral_name(sin::turning_cycles, cycle, parameter);
  if (!name.empty()) return parameter_with_unit(name);
  for (const auto& m : meanings) {
    if (m.name == parameter) return std::string(m.text);
  }
  return {};
}

std::string cycle_title(const sin::CycleRow& row) {
  switch (row.family) {
    case sin::CycleFamily::drilling: return "drilling cycle";
    case sin::CycleFamily::pattern: return "pattern of positions";
    case sin::CycleFamily::milling: return "milling cycle";
    case sin::CycleFamily::turning: return "turning cycle";
    case sin::CycleFamily::swivel: return "swivelling";
    case sin::CycleFamily::measuring: return "measuring cycle";
  }
  return {};
}

std::string g_title(const sin::GFunction& g) {
  switch (g.use) {
    case sin::GUse::motion:
    case sin::GUse::approach: return motion_title(static_cast<ir::MotionKind>(g.a));
    case sin::GUse::setting: return setting_title(static_cast<ir::Setting>(g.a), g.b);
    case sin::GUse::units: return setting_title(ir::Setting::units, g.a) + (g.b == 1 ? ", F too" : "");
    case sin::GUse::feed: return setting_title(ir::Setting::feed_mode, g.a);
    case sin::GUse::path: return setting_title(ir::Setting::path_mode, g.a);
    case sin::GUse::dwell: return "dwell, F in seconds or S in revolutions";
    case sin::GUse::exact_stop_block: return "exact stop in this block";
    case sin::GUse::frame: return "programmable frame";
    case sin::GUse::work_offset: return g.a == 0 ? "settable offset off" : "settable offset " + std::to_string(g.a);
    case sin::GUse::suppress: return "offsets suppressed in this block";
    case sin::GUse::pole: return "pole of polar coordinates";
    case sin::GUse::limit: return g.a == 0 ? "lower limit of the speed" : "upper limit of the speed";
    case sin::GUse::timing: return "timing; the path is the same";
    case sin::GUse::compensation: return "how radius compensation goes round corners";
    default: return {};
  }
}

}  // namespace

std::vector<WordInfo> sinumerik_words() {
  std::vector<WordInfo> out;
  for (const auto& g : sin::g_functions()) {
    out.push_back({std::string(g.name), WordKind::code, g_title(g), {}});
  }
  struct Row {
    std::string_view word, title;
  };
  constexpr Row m_codes[] = {{"M0", "stop"},
                             {"M1", "optional stop"},
                             {"M2", "program end"},
                             {"M3", "spindle clockwise"},
                             {"M4", "spindle counter-clockwise"},
                             {"M5", "spindle stop"},
                             {"M6", "tool change"},
                             {"M8", "coolant on"},
                             {"M9", "coolant off"},
                             {"M17", "end of the subprogram"},
                             {"M30", "program end"}};
  for (const auto& m : m_codes) out.push_back({std::string(m.word), WordKind::code, std::string(m.title), {}});
  for (const auto& row : sin::cycles()) {
    WordInfo word{std::string(row.name), WordKind::cycle, cycle_title(row), {}};
    for (const auto p : parts_of(row.parameters))
      word.parameters.push_back({std::string(p), meaning_of(row.name, p), false});
    out.push_back(std::move(word));
  }
  add_words(out, WordKind::keyword,
            {"IF",      "ELSE",     "ENDIF", "WHILE", "ENDWHILE", "REPEAT", "UNTIL",   "FOR",     "TO",     "ENDFOR",
             "LOOP",    "ENDLOOP",  "GOTO",  "GOTOF", "GOTOB",    "GOTOC",  "GOTOS",   "CASE",    "OF",     "DEFAULT",
             "REPEATB", "ENDLABEL", "PROC",  "RET",   "EXTERN",   "CALL",   "PCALL",   "EXTCALL", "MCALL",  "DEF",
             "REAL",    "INT",      "BOOL",  "CHAR",  "STRING",   "AXIS",   "FRAME",   "MSG",     "SETAL",  "STOPRE",
             "SAVE",    "DISPLOF",  "SBLOF", "SETMS", "TRANSMIT", "TRACYL", "TRAFOOF", "DIAMON",  "DIAMOF", "DIAM90",
             "AC",      "IC",       "DC",    "ACP",   "ACN",      "CR",     "AR",      "TURN",    "AP",     "RP",
             "ANG",     "RND",      "RNDM",  "CHF",   "CHR"});
  for (const auto& f : sin::functions)
    out.push_back({std::string(f.name), WordKind::function, spoken(ir::name(f.function)), {}});
  add_words(out, WordKind::function, {"AND", "OR", "XOR", "NOT", "DIV", "MOD", "B_AND", "B_OR", "B_XOR", "B_NOT"});
  return out;
}

}  // namespace cnctrans::lsp
