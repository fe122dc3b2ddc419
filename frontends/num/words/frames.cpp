// Origin shifts, preset, mirror, scale, tool axis (reference 8, 9.2), and which of G90 and G91 counts for a word.
#include <utility>

#include "base/text.h"
#include "dialects/num/variables.h"
#include "frontends/num/state/actions.h"
#include "frontends/num/state/slots.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;
using namespace slot;

void Lowering::resolve_distance() {
  // A word between two of them has the mode of the one before it; words before the first keep the mode in force.
  const auto mode_of = [](const Word* w) {
    return w->number == 91 ? ir::WordMode::incremental : ir::WordMode::absolute;
  };
  const Word* first = marks_.distances[0];
  const Word* last = marks_.distances[marks_.distance_count - 1U];
  const auto mode_at = [&](std::uint32_t column) {
    ir::WordMode m = ir::WordMode::modal;
    for (std::size_t i = 0; i < marks_.distance_count; ++i) {
      if (marks_.distances[i]->pos.column < column) m = mode_of(marks_.distances[i]);
    }
    return m;
  };
  bool before_first = false;
  for (const auto& c : out_->motion.coords) before_first = before_first || c.pos.column < first->pos.column;
  for (const char c : {'I', 'J', 'K'}) {
    before_first = before_first ||
                   (has(letter(c)) && pending_[static_cast<std::size_t>(letter(c))]->pos.column < first->pos.column);
  }
  if (before_first || marks_.distance_count > 1) {
    for (auto& c : out_->motion.coords) {
      if (before_first || c.pos.column < last->pos.column) c.mode = mode_at(c.pos.column);
    }
  }
  state_.distance = last->number == 91 ? ir::Distance::incremental : ir::Distance::absolute;
  marks_.distance_after = before_first;
  // Each of them is kept at its place; the last one stays in force.
  for (std::size_t i = 0; i < marks_.distance_count; ++i) {
    const Word& w = *marks_.distances[i];
    ir::ModalSet set;
    set.setting = ir::Setting::distance;
    set.value = facts::u8(w.number == 91 ? ir::Distance::incremental : ir::Distance::absolute);
    act(w, before_first ? Step::after : Step::setting, set, before_first ? ir::Order::after : ir::Order::before);
  }
}

std::optional<ir::Distance> Lowering::distance_at(std::uint32_t column) {
  const auto own = own_distance(column);
  if (!own) uses(Modal::distance);
  return own || !state_.known ? own : marks_.distance_before;
}

std::optional<ir::Distance> Lowering::own_distance(std::uint32_t column) const {
  std::optional<ir::Distance> mode;
  for (std::size_t i = 0; i < marks_.distance_count; ++i) {
    const Word& w = *marks_.distances[i];
    if (w.pos.column < column) mode = w.number == 91 ? ir::Distance::incremental : ir::Distance::absolute;
  }
  return mode;
}

std::vector<ir::FrameWord> Lowering::take_frame_words() {
  std::vector<ir::FrameWord> words;
  for (auto& c : out_->motion.coords) {
    ir::FrameWord w;
    w.axis = c.axis;
    w.value = std::move(c.value);
    w.pos = c.pos;
    words.push_back(std::move(w));
  }
  out_->motion.coords.clear();
  return words;
}

void Lowering::rotation_words(ir::FrameChange& change, const Word& ed) {
  change.slot = ir::FrameSlot::rotation;
  change.kind = ir::FrameKind::rotate;
  change.combine = ir::FrameCombine::replace;
  change.has_angle = true;
  change.angle = value(ed);
}

void Lowering::frame_shift(const Word& g59) {
  const Word* ed = use(e('D'));
  auto& coords = out_->motion.coords;
  if (coords.empty() && ed == nullptr) return unknown(g59, "G59 needs the axes it shifts");
  // Words that count in one mode make one change; a mode of their own is that of the G90 or G91 before them.
  bool whole = true;
  while (!coords.empty()) {
    const ir::WordMode mode = coords.front().mode;
    std::vector<ir::CoordWord> others;
    std::erase_if(coords, [&](ir::CoordWord& c) {
      if (c.mode == mode) return false;
      others.push_back(std::move(c));
      return true;
    });
    ir::FrameChange shift;
    shift.slot = ir::FrameSlot::shift;
    shift.kind = ir::FrameKind::translate;
    shift.combine = mode == ir::WordMode::incremental ? ir::FrameCombine::add : ir::FrameCombine::replace_named;
    shift.by_distance_mode = mode == ir::WordMode::modal;
    shift.words = take_frame_words();
    const WordPos first = shift.words.front().pos;
    ir::Action& change = act(g59, Step::frame, frame_op(std::move(shift)));
    if (!whole) {  // a further change stands where its words do
      change.pos = first;
      change.text = {};
    }
    whole = false;
    coords = std::move(others);
  }
  if (ed == nullptr) return;
  ir::FrameChange turn;
  rotation_words(turn, *ed);
  for (const char c : {'I', 'J', 'K'}) {
    const Word* w = use(letter(c));
    if (w == nullptr) continue;
    ir::FrameWord centre;
    centre.axis = centre_axis(c);
    centre.value = axis_value(*w, centre.axis);
    centre.pos = w->pos;
    turn.words.push_back(std::move(centre));
  }
  act(*ed, Step::frame, frame_op(std::move(turn)));
}

void Lowering::preset(const Word& g92) {
  bool any = false;
  if (!out_->motion.coords.empty()) {
    ir::FrameChange change;
    change.slot = ir::FrameSlot::preset;
    change.kind = ir::FrameKind::translate;
    change.combine = ir::FrameCombine::preset;
    change.words = take_frame_words();
    if (expressions_.offsets_apart()) {
      for (const auto& w : change.words) flow_->preset.push_back(w.axis);
    }
    act(g92, Step::frame, frame_op(std::move(change)));
    any = true;
  }
  if (const Word* s = use(letter('S'))) {
    act(*s, Step::value, ir::SpindleLimit{1, value(*s), false});
    any = true;
  }
  if (const Word* r = use(letter('R'))) {
    ir::ModalSet set;
    set.setting = ir::Setting::feed_point;
    set.value = facts::u8(!r->is_expression && r->number == 0 ? ir::FeedPoint::centre : ir::FeedPoint::contact);
    ir::Action& a = act(*r, Step::setting, set);
    if (!any) {  // one spelling: R means nothing without its code
      const std::size_t from = g92.pos.column - 1, to = r->pos.column - 1 + r->pos.length;
      if (to > from) a.text = text_.substr(from, to - from);
    }
    report_.warn("NUM-032", r->pos,
                 "G92 R: the feed counts at the contour for arcs of at least this radius; read as for all arcs (times "
                 "differ, the path does not)");
    any = true;
  }
  if (!any) unknown(g92, "G92 needs axes, R or S");
}

void Lowering::mirror(const Word& g51) {
  ir::FrameChange change;
  change.slot = ir::FrameSlot::mirror;
  change.kind = ir::FrameKind::mirror;
  change.combine = ir::FrameCombine::replace_named;
  for (const Word& w : block_->words) {
    const int s = slot_of(w.address);
    const ir::AxisId axis = s >= 0 && s < 26 ? ir::fixed_axis(static_cast<char>('A' + s)) : ir::axis::none;
    if (axis == ir::axis::none) continue;
    if (w.has_value || w.number_text.empty()) return unknown(w, "G51 takes axes with a sign: X- mirrors, X+ ends it");
    ir::FrameWord word;
    word.axis = axis;
    word.value = ir::Value(w.number_text.back() == '-' ? 1 : 0);
    word.pos = w.pos;
    change.words.push_back(std::move(word));
  }
  out_->motion.coords.clear();
  if (change.words.empty()) return unknown(g51, "G51 needs the axes it mirrors");
  act(g51, Step::frame, frame_op(std::move(change)));
}

void Lowering::scale(const Word& w, bool on) {
  ir::FrameChange change;
  change.slot = ir::FrameSlot::scale;
  change.kind = ir::FrameKind::scale;
  change.combine = on ? ir::FrameCombine::replace : ir::FrameCombine::clear;
  if (on) {
    change.uniform_scale = true;
    ir::FrameWord factor;
    factor.value = ir::Value(
        ir::binary(ir::BinaryOp::divide, ir::numbered(facts::space_e, 69000, ir::Type::integer), ir::number(1000)));
    change.words.push_back(std::move(factor));
  }
  act(w, Step::frame, frame_op(std::move(change)));
}

/// Another tool axis than +Z: holes and pockets lie along it. The length of the tool counts there, which no position
/// shows: `natural`: other controls do the same in the plane of the text.
void Lowering::other_tool_axis(const Word& g16, const Word& axis, bool natural) {
  const auto order = natural ? ir::Order::with : ir::Order::after;  // `after`: a translation refuses it
  const std::size_t from = g16.pos.column - 1, to = axis.pos.column - 1 + axis.pos.length;
  const std::size_t end = g16.pos.column - 1 + g16.pos.length;
  const bool beside = axis.pos.column - 1 >= end && trim(text_.substr(end, axis.pos.column - 1 - end)).empty();
  const std::string_view words = beside ? text_.substr(from, to - from) : text_of(g16);
  act(g16, Step::special, ir::OpaqueWord{words}, order).text = words;
  if (!beside) act(axis, Step::special, ir::OpaqueWord{text_of(axis)}, order);
  if (axis.address == "R" && natural)
    return report_.note("NUM-034", g16.pos, "`G16` R+ names the tool axis that counts anyway");
  report_.warn("NUM-038", g16.pos,
               std::string("`G16 ") + std::string(text_of(axis)) +
                   "`: cycles work along this axis, and the length of the tool counts along it, which no position of a "
                   "run shows; " +
                   (natural ? "other controls take the normal of the plane, which is the same here"
                            : "other controls take the normal of the plane, which is another one"),
               natural ? "" : "select the plane whose normal is the tool axis");
}

void Lowering::tool_axis(const Word& g16) {
  for (const auto& [name, axis] :
       {std::pair{'P', ir::axis::x}, std::pair{'Q', ir::axis::y}, std::pair{'R', ir::axis::z}}) {
    const int s = letter(name);
    if (!has(s) || pending_[static_cast<std::size_t>(s)]->has_value) continue;
    used_ |= bit(s);
    const Word& w = *pending_[static_cast<std::size_t>(s)];
    const bool plus = w.number_text.empty() || w.number_text.back() == '+';
    state_.tool_axis = axis;
    const bool alone = block_->words.size() == 2 && block_->statements.empty();
    if (axis == ir::axis::z && plus && alone)
      return leave_out(g16, "NUM-034", "R+ names the tool axis that counts anyway", 2);
    return other_tool_axis(g16, w, plus && (axis == ir::axis::z || ir::plane_axes(plane()).w == axis));
  }
  unknown(g16, "G16 needs P, Q or R with a sign");
}

}  // namespace cnctrans::frontends::num
