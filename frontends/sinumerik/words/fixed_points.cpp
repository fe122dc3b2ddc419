// G751, a fixed point over a point on the way (language reference 14.3, motion reference 2.5), and the lines between
// G291 and G290, which are in another language of the control.
#include <algorithm>
#include <utility>

#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/statements/row_parts.h"

namespace cnctrans::sinumerik {

using syntax::Block;
using syntax::Word;

namespace {

constexpr double over_a_point = 751, to_other_mode = 291, to_own_mode = 290;

bool is_g(const Word& w, double number) {
  return w.has_value && !w.is_expression && (w.address == "G" || w.address == "g") && w.number == number;
}
bool is_fp(const Word& w) {
  return w.address.size() == 2 && (w.address[0] | 0x20) == 'f' && (w.address[1] | 0x20) == 'p';
}

}  // namespace

/// The words of a block that has nothing else; false (reported) when one of them is not carried.
bool StatementLowering::block_words(const Block& block, ir::Block& out) {
  Parts parts;
  bool ok = sort_items(block, parts);
  ok = ok && parts.calls.empty() && parts.actions.empty() && parts.assign.items.empty() && parts.beside_text.empty();
  if (ok && !words_.lower(parts.words, parts.indirect, out)) {
    ok = false;
    if (!words_.feature().empty()) feature_ = words_.feature();
  }
  return ok && put_axis_words(parts, out) && words_.tail() == Tail::none;
}

bool StatementLowering::split_block(const Block& block, const ir::LineInfo& info) {
  for (std::size_t i = 0; i < block.words.size(); ++i) {
    if (is_g(block.words[i], over_a_point)) return via_point(block, i, info);
  }
  return false;
}

/// G751 FP=1 X50: in rapid to X50, then what G75 FP=1 X0 does. The point on the way counts as other words do, with the
/// frames in force.
bool StatementLowering::via_point(const Block& block, std::size_t code, const ir::LineInfo& info) {
  const WordPos pos = block.words[code].pos;
  Block way = block, fixed = block;
  way.words.erase(way.words.begin() + static_cast<std::ptrdiff_t>(code));
  std::erase_if(way.words, is_fp);
  fixed.words[code].number = 75;
  std::erase_if(fixed.words, [this](const Word& w) {
    const bool axis = w.address.size() == 1 ? c_.machine.axis(w.address[0]) != ir::axis::none
                                            : c_.machine.axis(w.address) != ir::axis::none;
    return !axis && !is_fp(w) && !is_g(w, 75);
  });
  for (Word& w : fixed.words) {  // where the axes go is the machine's own
    if (is_fp(w) || is_g(w, 75)) continue;
    w.is_expression = false;
    w.number = 0;
    w.number_text = "0";
  }
  fixed.statements.clear();
  ir::Block first, second;
  const bool read = block_words(way, first) && block_words(fixed, second);
  if (!read || first.motion.coords.empty() || !first.motion.centers.empty() || first.motion.explicit_code) {
    if (read) refuse("block.word", pos, "G751 needs the axes of its point on the way, and no motion code beside it");
    add_opaque(block, info, feature_.empty() ? std::string_view("block.word") : feature_, false);
    return true;
  }
  first.motion.kind = ir::MotionKind::rapid;
  first.motion.keeps_modal = false;
  first.motion.explicit_code = true;
  first.motion.code_pos = pos;
  second.motion.code_text = "G75";
  c_.warning(
      "SIN-102", pos,
      "G751: the point on the way is taken in the coordinates of the workpiece, with the frames in force; no manual "
      "at hand says it",
      "write it as G0 and G75 in two blocks");
  ir::LineInfo outer = info, own = further_line(info);
  emit(outer, std::move(first));
  emit(own, std::move(second));
  return true;
}

/// G291: the lines up to G290 are in the other language of the control. They are kept; a run stops where it comes to
/// one.
bool StatementLowering::in_other_mode(const Block& block, const ir::LineInfo& info) {
  const bool alone = block.words.size() == 1 && block.statements.empty();
  if (!other_mode_) {
    if (!alone || !is_g(block.words[0], to_other_mode)) return false;
    other_mode_ = true;
    c_.warning(
        "SIN-103", block.words[0].pos,
        "G291: what follows up to G290 is in another language of the control: it is kept as text, and a run or a "
        "translation that comes to a block of it stops",
        "translate that part for itself, from the other language");
  } else if (alone && is_g(block.words[0], to_own_mode)) {
    other_mode_ = false;
  } else {
    add_opaque(block, info, "language.other_mode", false);
    return true;
  }
  ir::Action a;
  a.pos = block.words[0].pos;
  a.text = c_.slice(a.pos);
  a.data = ir::OpaqueWord{a.text};
  a.order = ir::Order::with;
  ir::Block words;
  words.actions.push_back(std::move(a));
  ir::LineInfo outer = info;
  emit(outer, std::move(words));
  return true;
}

}  // namespace cnctrans::sinumerik
