// Irregular pockets of the mill (25.5): the call G66 and its operations G67 and G68.
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "dialects/fagor/limits.h"
#include "dialects/fagor/pockets.h"
#include "frontends/fagor/statements/expr.h"
#include "frontends/fagor/words/block.h"

namespace cnctrans::fagor {

namespace facts = dialects::fagor;

/// Runs once, where it is called; the operations only when they are called.
void BlockLowerer::pocket_cycle(const GWord& g) {
  cycle_ = true;
  result_->needs_program = true;
  const std::string code = "G" + std::to_string(g.row->code);
  ir::NamedCycle c;
  c.name = std::string(cycle_row_->cycle);
  std::uint32_t there = 0;
  for (std::size_t i = 0; i < cycle_word_count_; ++i) {
    const Word& w = *cycle_words_[i];
    const auto* row = facts::find_letter(*cycle_row_, word_letter(w));
    there |= bit(word_letter(w));
    if (!pocket_value(w, row->parameter)) return;
    c.words.emplace_back(std::string(row->parameter), value(w));
  }
  const auto has = [there](char letter) { return (there & bit(letter)) != 0; };
  for (const auto& l : cycle_row_->letters) {
    if (l.letter == 0 || !l.mandatory || has(l.letter)) continue;
    state_.error("FAG-014", g.word->pos,
                 code + " needs the word " + l.letter + (g.row->code == 66 ? " (error 34)" : " (error 35)"));
    return;
  }
  if (coord_count_ != 0) {
    state_.error(
        "FAG-070", coords_[0]->pos,
        code + " takes no axis words" + (g.row->code == 66 ? " (error 34)" : ": the control chooses the point"));
    return;
  }
  if (g.row->code == 66) {
    for (std::size_t i = 0; i < facts::pocket_pairs.size(); i += 2) {
      const char first = facts::pocket_pairs[i], last = facts::pocket_pairs[i + 1];
      if (has(first) || !has(last)) continue;
      state_.error("FAG-070", g.word->pos,
                   std::string("G66 takes ") + last + " only together with " + first + " (error 34)");
      return;
    }
    if (has('C')) {
      keep(g, "cycle.milling", "G66 with a semi-finishing (a pocket with depth profiles) is kept as text");
      return;
    }
  } else if (!letter('T')) {
    state_.error("FAG-071", g.word->pos, code + " needs the tool T in its block (error 158)");
    return;
  }
  ir::CycleDefine define;
  define.modal = false;
  define.cycle = std::make_shared<const ir::Cycle>(ir::Cycle{std::move(c)});
  act(std::move(define), g.word);
  if (g.row->code != 66) return;
  ir::ModalSet after;
  after.setting = ir::Setting::comp;
  after.value = static_cast<std::uint8_t>(ir::CompSide::off);
  act(after, nullptr, ir::Order::after);
  state_.comp_by_text = ir::CompSide::off;
  after.setting = ir::Setting::distance;
  after.value = static_cast<std::uint8_t>(ir::Distance::absolute);
  act(after, nullptr, ir::Order::after);
}

/// What a fixed number of one word may be.
bool BlockLowerer::pocket_value(const Word& w, std::string_view parameter) {
  const bool label = parameter.ends_with("_label");
  if (label &&
      (w.expr >= 0 || w.number < 0 || w.number != std::floor(w.number) || w.number > facts::max_profile_label)) {
    state_.error("FAG-015", w.pos, "a label of a pocket is a fixed number from 0 to 9999");
    return false;
  }
  if (w.expr >= 0) return true;
  const bool whole = w.number == std::floor(w.number) && w.number >= 0;
  const bool bad = (parameter == "direction" && (!whole || w.number > 2)) ||
                   (parameter == "intersection" && (!whole || w.number > 1)) ||
                   (parameter == "plunge_angle" && (w.number < 0 || w.number > 90)) ||
                   ((parameter == "step" || parameter == "plunge_feed" || parameter == "tip_radius") && w.number < 0);
  if (bad)
    state_.error("FAG-013", w.pos, "the word " + std::string(word_text(w)) + " is out of its range (error 1042)");
  return !bad;
}

}  // namespace cnctrans::fagor
