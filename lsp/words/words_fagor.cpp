#include "dialects/fagor/cycles.h"
#include "dialects/fagor/g_codes.h"
#include "dialects/fagor/m_codes.h"
#include "dialects/fagor/operators.h"
#include "dialects/fagor/patterns.h"
#include "dialects/fagor/pockets.h"
#include "lsp/words/parameter_text.h"
#include "lsp/words/words_common.h"

namespace cnctrans::lsp {

namespace {

namespace fagor = dialects::fagor;

std::string title_of(const fagor::GCode& g) {
  if (!g.title.empty()) return std::string(g.title);
  switch (g.use) {
    case fagor::Use::motion: return motion_title(g.motion);
    case fagor::Use::setting:
    case fagor::Use::setting_after:
    case fagor::Use::compensation: return setting_title(g.setting, g.value);
    case fagor::Use::plane: return setting_title(ir::Setting::plane, g.value);
    case fagor::Use::plane_axes: return "plane by two axes";
    case fagor::Use::dwell: return "dwell, K in hundredths of a second";
    case fagor::Use::absolute_centre: return "absolute centre of the arc";
    case fagor::Use::tangent_arc: return "arc tangent to the path before";
    case fagor::Use::three_point_arc: return "arc through three points";
    case fagor::Use::mirror_off: return "mirror image off";
    case fagor::Use::mirror_axis:
    case fagor::Use::mirror_axes: return "mirror image";
    case fagor::Use::round: return "rounding of the corner";
    case fagor::Use::chamfer: return "chamfer of the corner";
    case fagor::Use::tangent_entry: return "tangential entry";
    case fagor::Use::tangent_exit: return "tangential exit";
    case fagor::Use::look_ahead: return "look-ahead";
    case fagor::Use::soft_corner: return "controlled round corner";
    case fagor::Use::machine_coordinates: return "machine coordinates";
    case fagor::Use::work_offset: return "zero offset " + std::to_string(g.value);
    case fagor::Use::table_shift: return "additional zero offset " + std::to_string(g.value);
    case fagor::Use::numbered_offset: return "zero offset by its number";
    case fagor::Use::shift: return "incremental zero offset";
    case fagor::Use::preset: return "preset of coordinates, limit of the speed";
    case fagor::Use::pole: return "pole of polar coordinates";
    case fagor::Use::scale: return "scale";
    case fagor::Use::rotation: return "rotation of the coordinates";
    case fagor::Use::home: return "reference point";
    case fagor::Use::cycle_cancel: return "end of the canned cycle";
    case fagor::Use::call: return "call of the subroutine of the same number";
    default: return {};
  }
}

std::string hole_title(int code) {
  struct Row {
    int code;
    std::string_view title;
  };
  constexpr Row rows[] = {{69, "deep hole drilling with variable pecks"},
                          {81, "drilling"},
                          {82, "drilling with dwell"},
                          {83, "deep hole drilling with equal pecks"},
                          {84, "tapping"},
                          {85, "reaming"},
                          {86, "boring, rapid out"},
                          {87, "rectangular pocket"},
                          {88, "circular pocket"},
                          {89, "boring, out at feed"}};
  for (const auto& r : rows) {
    if (r.code == code) return std::string(r.title);
  }
  return {};
}

/// Letters of the canned cycles of the mill; J and K are others in pockets.
std::string hole_letter(char letter, int code) {
  const bool pocket = code == 87 || code == 88;
  switch (letter) {
    case 'Z': return "reference plane (mm)";
    case 'I': return "depth (mm), from the reference plane under G91";
    case 'B': return pocket ? "depth of a pass (mm)" : "peck (mm)";
    case 'C': return pocket ? "step in the plane (mm)" : "distance to the last depth where feeding begins (mm)";
    case 'D': return "distance of the reference plane to the surface (mm)";
    case 'H': return pocket ? "feed of the finishing pass (mm/min)" : "withdrawal after each peck (mm)";
    case 'J':
      if (code == 83) return "number of pecks";
      return pocket ? "half of the length, or the radius (mm)" : "pecks between two full withdrawals";
    case 'K': return code == 87 ? "half of the width (mm)" : "dwell at the bottom (hundredths of a second)";
    case 'L': return pocket ? "finishing stock (mm)" : "smallest peck (mm)";
    case 'R': return code == 84 ? "1: rigid" : "factor of the next peck";
    case 'V': return "plunging feed (mm/min)";
    default: return {};
  }
}

void add_hole_cycle(WordInfo& word, int code) {
  for (const auto& row : fagor::hole_letters) {
    if (row.code != code) continue;
    word.kind = WordKind::cycle;
    word.title = hole_title(code);
    word.parameters = {{"Z", hole_letter('Z', code), true}, {"I", hole_letter('I', code), true}};
    for (const char c : row.mandatory) word.parameters.push_back({std::string(1, c), hole_letter(c, code), true});
    for (const char c : row.optional) word.parameters.push_back({std::string(1, c), hole_letter(c, code), false});
  }
}

void add_letters(WordInfo& word, const fagor::CycleRow* row) {
  if (row == nullptr) return;
  word.kind = WordKind::cycle;
  for (const auto& l : row->letters) {
    if (l.letter != 0)
      word.parameters.push_back({std::string(1, l.letter), parameter_with_unit(l.parameter), l.mandatory});
  }
}

std::string m_title(fagor::MKind kind) {
  switch (kind) {
    case fagor::MKind::stop: return "stop";
    case fagor::MKind::optional_stop: return "optional stop";
    case fagor::MKind::program_end: return "program end";
    case fagor::MKind::spindle_cw: return "spindle clockwise";
    case fagor::MKind::spindle_ccw: return "spindle counter-clockwise";
    case fagor::MKind::spindle_stop: return "spindle stop";
    case fagor::MKind::tool_change: return "tool change";
    case fagor::MKind::coolant_mist: return "mist coolant";
    case fagor::MKind::coolant_flood: return "coolant on";
    case fagor::MKind::coolant_off: return "coolant off";
    case fagor::MKind::orient: return "spindle orientation";
    case fagor::MKind::gear: return "gear range";
    case fagor::MKind::live_tool: return "driven tool";
  }
  return {};
}

}  // namespace

std::vector<WordInfo> fagor_words() {
  std::vector<WordInfo> out;
  for (const auto& g : fagor::g_codes()) {
    WordInfo word{"G" + std::to_string(g.code), WordKind::code, title_of(g), {}, g.model != fagor::Model::lathe,
                  g.model != fagor::Model::mill};
    if (g.use == fagor::Use::hole_cycle) add_hole_cycle(word, g.code);
    if (g.use == fagor::Use::machining) add_letters(word, fagor::find_cycle(g.code));
    if (g.use == fagor::Use::pattern) add_letters(word, fagor::find_pattern(g.code));
    if (g.use == fagor::Use::pocket) add_letters(word, fagor::find_pocket(g.code));
    out.push_back(std::move(word));
  }
  for (const auto& m : fagor::m_codes)
    out.push_back({"M" + std::to_string(m.code), WordKind::code, m_title(m.kind), {}});
  add_words(
      out, WordKind::keyword,
      {"IF",    "ELSE",  "GOTO",   "RPT",    "SUB",   "LSUB",  "RET",    "CALL",  "LL",    "PCALL", "MCALL", "MDOFF",
       "EXEC",  "MEXEC", "OPEN",   "WRITE",  "MSG",   "ERROR", "PROBE",  "DIGIT", "TRACE", "INPUT", "ESBLK", "DSBLK",
       "ESTOP", "DSTOP", "EFHOLD", "DFHOLD", "REPOS", "PAGE",  "SYMBOL", "DGWZ",  "ODW",   "WKEY",  "WBUF",  "SYSTEM"});
  for (const auto& o : fagor::operators) {
    if (o.word[0] >= 'A') out.push_back({std::string(o.word), WordKind::function, {}, {}});
  }
  for (const auto& f : fagor::functions)
    out.push_back({std::string(f.word), WordKind::function, spoken(ir::name(f.function)), {}});
  return out;
}

}  // namespace cnctrans::lsp
