#include "base/text.h"
#include "dialects/heidenhain/cycles.h"
#include "dialects/heidenhain/functions.h"
#include "dialects/heidenhain/m_codes.h"
#include "dialects/heidenhain/sentences.h"
#include "lsp/words/words_common.h"

namespace cnctrans::lsp {

namespace {

namespace hei = dialects::heidenhain;

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return out;
}

std::string_view unit_of_role(hei::Role role) {
  switch (role) {
    case hei::Role::surface:
    case hei::Role::clearance:
    case hei::Role::depth:
    case hei::Role::second_clearance:
    case hei::Role::peck:
    case hei::Role::degression:
    case hei::Role::least_peck:
    case hei::Role::break_depth:
    case hei::Role::lift:
    case hei::Role::first_stop:
    case hei::Role::last_stop:
    case hei::Role::deeper_start:
    case hei::Role::pitch: return " (mm)";
    case hei::Role::feed:
    case hei::Role::feed_out:
    case hei::Role::mill_feed_word: return " (mm/min)";
    case hei::Role::dwell_bottom:
    case hei::Role::dwell_top: return " (s)";
    case hei::Role::orient: return " (°)";
    default: return {};
  }
}

}  // namespace

std::vector<WordInfo> heidenhain_words() {
  std::vector<WordInfo> out;
  for (const auto& m : hei::m_codes)
    out.push_back({"M" + std::to_string(m.code), WordKind::code, std::string(m.title), {}});
  for (const auto& row : hei::cycle_rows) {
    WordInfo word{"CYCL DEF " + std::to_string(row.number), WordKind::cycle, lower(row.title), {}};
    for (const auto& p : row.parameters) {
      const hei::QWord* q = p.number == 0 ? nullptr : hei::find_q_word(p.number, row.number);
      if (q == nullptr) continue;
      word.parameters.push_back(
          {"Q" + std::to_string(p.number), lower(q->text) + std::string(unit_of_role(q->role)), p.needed});
    }
    out.push_back(std::move(word));
  }
  for (const auto& s : hei::sentences) out.push_back({std::string(s.words), WordKind::keyword, {}, {}});
  struct Row {
    std::string_view word, title;
  };
  constexpr Row paths[] = {{"L", "straight line"},
                           {"C", "arc to an end point about CC"},
                           {"CC", "centre of circles, pole"},
                           {"CR", "arc by its radius"},
                           {"CT", "arc tangent to the path before"},
                           {"CP", "arc in polar coordinates"},
                           {"LP", "line in polar coordinates"},
                           {"CTP", "tangent arc in polar coordinates"},
                           {"RND", "rounding of the corner"},
                           {"CHF", "chamfer of the corner"},
                           {"FN", "function of parameters"},
                           {"REP", "number of repeats"},
                           {"RL", "radius compensation left"},
                           {"RR", "radius compensation right"},
                           {"R0", "radius compensation off"},
                           {"FMAX", "rapid"},
                           {"DR", "sense of rotation"},
                           {"IF", ""},
                           {"GOTO", ""},
                           {"PGM", ""},
                           {"MM", "millimetres"},
                           {"INCH", "inches"}};
  for (const auto& p : paths) out.push_back({std::string(p.word), WordKind::keyword, std::string(p.title), {}});
  for (const auto& f : hei::functions)
    out.push_back({std::string(f.word), WordKind::function, spoken(ir::name(f.function)), {}});
  return out;
}

}  // namespace cnctrans::lsp
