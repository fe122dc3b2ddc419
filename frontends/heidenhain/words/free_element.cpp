// FL, FLT, FC, FCT, FPOL, FSELECT (reference 7.1): their words.
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/heidenhain/free_words.h"
#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;

bool Lowering::free_element(const syntax::Statement& s) {
  if (s.keyword == "FSELECT")
    return carried(s, true, "beside.data", "FSELECT: the contour is taken that the data themselves give");
  const auto& words = block_->words;
  FreeElement e;
  e.where = line_.span;
  e.arc = s.keyword == "FC" || s.keyword == "FCT";
  e.tangent = s.keyword == "FLT" || s.keyword == "FCT";
  for (std::size_t i = 0; i < words.size() && !report_.refused(); ++i) {
    const Word& w = words[i];
    std::string address = to_upper_ascii(w.address);
    const Word* number = &w;
    // P1X+20 is two words.
    if (address == "P" && w.has_value && !w.is_expression && i + 1 < words.size()) {
      address += std::to_string(saturate<int>(w.number)) + to_upper_ascii(words[i + 1].address);
      number = &words[++i];
    }
    const bool zero = !number->is_expression && number->number == 0;
    if (address == "DR" && !w.has_value && !w.number_text.empty()) {
      e.sense = w.number_text == "+" ? 1 : -1;
    } else if (address == "CLSD" && !w.has_value && !w.number_text.empty()) {
      (w.number_text == "+" ? e.begins : e.closes) = true;
    } else if (address == "R" && zero) {
      tail(w);
    } else if (facts::in_words(facts::relative_words, address)) {
      report_.keep("HEI-030", w.pos, "`" + std::string(slice(w)) + "`: data from another block are not carried",
                   "motion.geometry", "write the coordinates");
    } else if (number->has_value && facts::in_words(facts::free_words, address)) {
      if (number->is_expression)
        report_.keep("HEI-030", w.pos, "the data of free contours must be numbers", "motion.geometry");
      e.words[address] = number->number;
    } else if (w.has_value && address == "M") {
      machine_function(w);
    } else if (!tail(w) && !report_.refused()) {
      report_.refuse("HEI-002", w.pos, "`" + std::string(slice(w)) + "` means nothing beside " + s.keyword, {},
                     "block.word");
    }
  }
  if (report_.refused()) return false;
  if (s.keyword == "FPOL") {
    const auto x = e.words.find("X"), y = e.words.find("Y");
    if (x == e.words.end() || y == e.words.end()) {
      report_.refuse("HEI-030", s.pos, "FPOL needs both coordinates");
      return false;
    }
    free_pole_ = std::pair(x->second, y->second);
    if (!line_.comments.empty()) put(ir::Block{});
    return true;
  }
  if (rapid_ && e.arc) {
    report_.refuse("HEI-006", s.pos, "an arc is not run in rapid traverse: its feed is unknown", "write F");
    return false;
  }
  e.pole = free_pole_;
  e.rapid = rapid_;
  flat_.elements.push_back(std::move(e));
  out_.motion.kind = ir::MotionKind::linear;
  out_.has_motion = true;
  Item& item = put(ItemKind::plain, std::move(out_));
  item.moves = true;
  item.call = call_;
  item.free = static_cast<int>(flat_.elements.size()) - 1;
  return true;
}

}  // namespace cnctrans::frontends::heidenhain
