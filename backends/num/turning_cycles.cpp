// Turning cycles in their own words (reference 12).
#include <algorithm>
#include <array>
#include <cmath>

#include "backends/num/writer.h"
#include "base/text.h"

namespace cnctrans::backends::num {

namespace facts = dialects::num;

/// The moves of the cycle follow from options, and the target's profile says others.
bool Writer::other_habits(const ir::Action& a, const CycleWords& words, const facts::CycleHabits& habits) {
  for (const auto& h : {habits.first, habits.second}) {
    if (!h.given) continue;
    const auto it = std::find_if(words.begin(), words.end(), [&h](const auto& w) { return w.first == h.word; });
    if ((it == words.end() ? 0 : it->second.number) == h.value) continue;
    refuse("TRN-691", a.pos,
           "the moves of this cycle follow from " + std::string(habits.option) +
               " and its fellows, and the target's machine profile sets them otherwise",
           "set the same in both profiles");
    return true;
  }
  return false;
}

namespace {

/// How each word of a cycle is addressed.
struct TurningWord {
  std::string_view cycle, parameter, address;
};
constexpr std::array turning_words = {TurningWord{"thread.chased", "x_end", "X"},
                                      TurningWord{"thread.chased", "z_end", "Z"},
                                      TurningWord{"thread.chased", "pitch", "K"},
                                      TurningWord{"thread.chased", "cone", "EA"},
                                      TurningWord{"thread.chased", "infeed_angle", "EB"},
                                      TurningWord{"thread.chased", "exit", "R"},
                                      TurningWord{"thread.chased", "depth", "P"},
                                      TurningWord{"thread.chased", "finish_stock", "Q"},
                                      TurningWord{"thread.chased", "starts", "F"},
                                      TurningWord{"thread.chased", "passes", "S"},
                                      TurningWord{"stock.blank", "first_label", "N"},
                                      TurningWord{"stock.blank", "last_label", "N"},
                                      TurningWord{"stock.blank", "stock_x", "I"},
                                      TurningWord{"stock.blank", "stock_z", "K"},
                                      TurningWord{"stock.blank", "step", "P"},
                                      TurningWord{"stock.blank", "axial_step", "R"},
                                      TurningWord{"stock.groove", "first_label", "N"},
                                      TurningWord{"stock.groove", "last_label", "N"},
                                      TurningWord{"stock.groove", "entry_angle", "EA"},
                                      TurningWord{"stock.groove", "step", "P"},
                                      TurningWord{"stock.groove", "axial_step", "R"},
                                      TurningWord{"stock.groove", "limit_x", "X"},
                                      TurningWord{"stock.groove", "limit_z", "Z"},
                                      TurningWord{"stock.groove", "stock_x", "I"},
                                      TurningWord{"stock.groove", "stock_z", "K"},
                                      TurningWord{"stock.reentrant", "first_label", "N"},
                                      TurningWord{"stock.reentrant", "last_label", "N"},
                                      TurningWord{"stock.reentrant", "x_2", "X"},
                                      TurningWord{"stock.reentrant", "z_2", "Z"},
                                      TurningWord{"stock.reentrant", "step", "P"},
                                      TurningWord{"stock.reentrant", "axial_step", "R"},
                                      TurningWord{"stock.reentrant", "stock_x", "I"},
                                      TurningWord{"stock.reentrant", "stock_z", "K"},
                                      TurningWord{"stock.reentrant", "withdrawal", "ER"},
                                      TurningWord{"stock.reentrant", "entry_angle", "EA"},
                                      TurningWord{"stock.reentrant", "groove_feed", "EF"},
                                      TurningWord{"groove.plunged", "second_edge", "D"},
                                      TurningWord{"groove.plunged", "x_end", "X"},
                                      TurningWord{"groove.plunged", "z_end", "Z"},
                                      TurningWord{"groove.plunged", "slope_angle", "EA"},
                                      TurningWord{"groove.plunged", "step", "P"},
                                      TurningWord{"groove.plunged", "axial_step", "R"},
                                      TurningWord{"groove.plunged", "base_dwell", "EF"}};

}  // namespace

/// G33, G63 to G66 in their own words; the points of a blank are the blocks that follow.
bool Writer::turning_cycle(const ir::Action& a, const ir::NamedCycle& c) {
  const std::string_view code = c.name == "stock.blank"       ? "G64"
                                : c.name == "stock.groove"    ? "G65"
                                : c.name == "stock.reentrant" ? "G63"
                                : c.name == "groove.plunged"  ? "G66"
                                : c.name == "thread.chased"   ? "G33"
                                                              : "";
  if (code.empty()) return false;
  const bool by_p = std::any_of(c.words.begin(), c.words.end(), [](const auto& w) { return w.first == "step"; });
  if (code == "G63" && other_habits(a, c.words, facts::reentrant_habits(own_options_))) return true;
  if (code == "G66" && other_habits(a, c.words, facts::plunge_habits(own_options_, by_p))) return true;
  if (code == "G66") {  // the distance between the edges of its tool is no word
    const auto it = std::find_if(c.words.begin(), c.words.end(), [](const auto& w) { return w.first == "width"; });
    const double unit = setting(ir::Setting::units) == static_cast<std::uint8_t>(ir::Units::inch) ? 25.4 : 1;
    const double theirs = it == c.words.end() ? 0 : it->second.number * unit;
    if (std::abs(theirs - parse_decimal(own_options_.plunged_width).value_or(0)) > 1e-6) {
      refuse("TRN-691", a.pos,
             "the plunges of this cycle follow from num.g66_width, and the target's machine profile sets it otherwise",
             "set the same in both profiles");
      return true;
    }
  }
  std::string text(a.text.empty() ? code : a.text);
  const bool back = std::any_of(c.words.begin(), c.words.end(), [](const auto& w) { return w.first == "reversed"; });
  std::vector<std::pair<std::string, ir::Value>> words = c.words;
  if (back && words.size() > 1) std::swap(words[0].second, words[1].second);
  for (const auto& [parameter, v] : words) {
    const auto row =
        std::find_if(turning_words.begin(), turning_words.end(),
                     [&c, &p = parameter](const TurningWord& r) { return r.cycle == c.name && r.parameter == p; });
    if (row != turning_words.end()) text += ' ' + word(row->address, v, a.pos);
  }
  add(std::move(text), Rank::setting, a.pos);
  return true;
}

}  // namespace cnctrans::backends::num
