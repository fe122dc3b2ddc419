#include "dialects/num/gcodes.h"
#include "dialects/num/mcodes.h"
#include "dialects/num/milling.h"
#include "lsp/words/parameter_text.h"
#include "lsp/words/words_common.h"

namespace cnctrans::lsp {

namespace {

namespace num = dialects::num;

/// Words of the drilling cycles beside the point (11.2).
std::vector<WordParameter> hole_parameters(int code) {
  std::vector<WordParameter> out = {
      {"Z", "bottom of the hole (mm)", true}, {"ER", "retract plane (mm)", false}, {"EH", "surface (mm)", false}};
  if (code == 83 || code == 87) {
    out.push_back({"P", "first peck (mm)", false});
    out.push_back({"Q", "last peck (mm)", false});
    out.push_back({"ES", "number of equal pecks", false});
    out.push_back({"EP", "withdrawal between pecks (mm)", false});
  }
  if (code == 84) out.push_back({"K", "pitch of a rigid tap (mm)", false});
  if (code == 85) out.push_back({"EF", "feed on the way out (mm/min)", false});
  if (code == 86) out.push_back({"EC", "angle at which the spindle stops (°)", false});
  if (code != 84 && code != 85 && code != 86) out.push_back({"EF", "dwell at the bottom (s)", false});
  return out;
}

std::vector<WordParameter> pocket_parameters() {
  std::vector<WordParameter> out = {{"Z", "bottom of the pocket (mm)", true}, {"ER", "retract plane (mm)", false}};
  for (const auto& w : num::pocket_words)
    out.push_back({std::string(w.address), parameter_with_unit(w.parameter), false});
  return out;
}

}  // namespace

std::vector<WordInfo> num_words() {
  std::vector<WordInfo> out;
  for (const auto& g : num::g_codes) {
    WordInfo word{
        "G" + std::to_string(g.code),    WordKind::code, std::string(g.title), {}, g.machine != num::GMachine::lathe,
        g.machine != num::GMachine::mill};
    if (g.kind == num::GKind::hole_cycle) {
      word.kind = WordKind::cycle;
      word.parameters = hole_parameters(g.code);
    }
    if (g.code == 45) {
      word.kind = WordKind::cycle;
      word.parameters = pocket_parameters();
    }
    if (g.kind == num::GKind::turning_cycle) word.kind = WordKind::cycle;
    out.push_back(std::move(word));
  }
  for (const auto& m : num::m_codes)
    out.push_back({"M" + std::to_string(m.code), WordKind::code, std::string(m.title), {}});
  add_words(out, WordKind::keyword,
            {"IF",     "THEN", "ELSE", "ENDI", "WHILE", "DO",   "ENDW", "REPEAT", "UNTIL", "FOR",   "TO",
             "DOWNTO", "BY",   "ENDF", "EXIT", "VAR",   "ENDV", "PUSH", "PULL",   "PROC",  "BUILD", "DELETE"});
  add_words(out, WordKind::function, {"AND", "OR"});
  return out;
}

}  // namespace cnctrans::lsp
