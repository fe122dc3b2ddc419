// Cycles that act where they are defined (reference 18, 19): datum shift, mirror, rotation, scale, dwell, orientation,
// preset, and data that change no path.
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>

#include "base/text.h"
#include "frontends/heidenhain/state/lowering.h"
#include "frontends/heidenhain/state/term.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;
using facts::OldKind;
using ir::FrameCombine;
using ir::FrameKind;
using ir::FrameSlot;

namespace {

ir::FrameChange frame(ir::FrameSlot slot, ir::FrameKind kind, ir::FrameCombine combine) {
  ir::FrameChange c;
  c.slot = slot;
  c.kind = kind;
  c.combine = combine;
  return c;
}
ir::FrameOp frame_op(ir::FrameChange c) {
  return {std::make_shared<const ir::FrameChange>(std::move(c))};
}
ir::FrameWord frame_word(ir::AxisId axis, ir::Value v) {
  ir::FrameWord w;
  w.axis = axis;
  w.value = std::move(v);
  return w;
}
/// The last number of the part, whatever words stand before it.
const ir::Value* last_value(const CycleDefinition& cycle, int part) {
  const auto it = cycle.parts.find(part);
  if (it == cycle.parts.end()) return nullptr;
  const ir::Value* found = nullptr;
  for (const auto& l : it->second.letters) {
    if (l.has_value) found = &l.value;
  }
  return found;
}

}  // namespace

/// 7 shift, 8 mirror, 10 rotation, 11 and 26 scale.
void Lowering::frame_cycle(const CycleDefinition& cycle) {
  relies(AlongText::tilt);
  FrameChanges changes;
  switch (cycle.old->kind) {
    case OldKind::datum_shift: changes = datum_shift(cycle); break;
    case OldKind::mirror: changes = mirror(cycle); break;
    case OldKind::rotation: changes = rotation(cycle); break;
    case OldKind::scale: changes = scale(cycle); break;
    default: changes = axis_scale(cycle);
  }
  if (!changes) return;
  if (cycle.old->kind == OldKind::datum_shift && tilt_) return put_tilt();
  ir::Block b;
  if (cycle.old->kind == OldKind::rotation)  // takes the compensation away
    b.actions.emplace_back().data = ir::ModalSet{ir::Setting::comp, static_cast<std::uint8_t>(ir::CompSide::off)};
  for (auto& c : *changes) change_frame(std::move(c), b);
  if (!b.actions.empty()) put(std::move(b));
}

void Lowering::change_frame(ir::FrameChange c, ir::Block& b) {
  const bool slot = c.slot == FrameSlot::mirror || c.slot == FrameSlot::rotation || c.slot == FrameSlot::scale;
  if (slot && tilt_) {
    if (!in_tilt(std::move(c)))
      report_.keep("HEI-022", {}, "IROT behind a tilt adds to a rotation before it; that is not carried",
                   "motion.transformation");
    return;
  }
  if (slot && c.combine == FrameCombine::clear) outer_.erase(c.kind);
  if (slot && c.combine != FrameCombine::clear) outer_.insert(c.kind);
  b.actions.emplace_back().data = frame_op(std::move(c));
}

Lowering::FrameChanges Lowering::wrong_frame(std::string message) {
  report_.refuse("HEI-020", {}, std::move(message));
  return std::nullopt;
}

Lowering::FrameChanges Lowering::datum_shift(const CycleDefinition& cycle) {
  ir::FrameChange absolute = frame(FrameSlot::shift, FrameKind::translate, FrameCombine::replace_named);
  ir::FrameChange added = frame(FrameSlot::shift, FrameKind::translate, FrameCombine::add);
  for (const auto& [n, part] : cycle.parts) {
    for (const auto& l : part.letters) {
      if (l.address == "#") {
        report_.keep("HEI-020", {}, "a row of the datum table: the table is known to the machine only",
                     "motion.transformation");
        return std::nullopt;
      }
      const bool incremental = l.address.size() == 2 && l.address[0] == 'I';
      const ir::AxisId axis = axis_of(incremental ? std::string_view(l.address).substr(1) : l.address);
      if (axis == ir::axis::none || !l.has_value) return wrong_frame("cycle 7 takes axes with their shift");
      if (!has_axis(axis)) return wrong_frame("cycle 7: the machine has no axis " + l.address);
      if (!tilt_)
        (incremental ? added : absolute).words.push_back(frame_word(axis, l.value));
      else if (!shift_in_tilt(axis, l.value, incremental))
        return wrong_frame("cycle 7 in a tilted plane shifts X, Y and Z");
    }
  }
  FrameChanges changes{std::in_place};
  if (!absolute.words.empty()) changes->push_back(std::move(absolute));
  if (!added.words.empty()) changes->push_back(std::move(added));
  return changes->empty() && !tilt_ ? wrong_frame("cycle 7 shifts nothing") : changes;
}

Lowering::FrameChanges Lowering::mirror(const CycleDefinition& cycle) {
  ir::FrameChange m = frame(FrameSlot::mirror, FrameKind::mirror, FrameCombine::replace);
  for (const auto& [n, part] : cycle.parts) {
    for (const auto& l : part.letters) {
      const ir::AxisId axis = axis_of(l.address);
      if (axis == ir::axis::none || l.has_value) continue;  // words of the dialog
      if (!has_axis(axis)) return wrong_frame("cycle 8: the machine has no axis " + l.address);
      m.words.push_back(frame_word(axis, ir::Value(1)));
    }
  }
  if (m.words.empty()) m.combine = FrameCombine::clear;
  return {{std::move(m)}};
}

Lowering::FrameChanges Lowering::rotation(const CycleDefinition& cycle) {
  const ir::Value* angle = last_value(cycle, 1);
  if (angle == nullptr) return wrong_frame("cycle 10 has no angle");
  const auto& letters = cycle.parts.at(1).letters;
  const bool adds =
      std::any_of(letters.begin(), letters.end(), [](const auto& l) { return l.address == "IROT" && l.has_value; });
  if (!adds && angle->is(0)) return {{frame(FrameSlot::rotation, FrameKind::rotate, FrameCombine::clear)}};
  ir::FrameChange r = frame(FrameSlot::rotation, FrameKind::rotate, adds ? FrameCombine::add : FrameCombine::replace);
  r.has_angle = true;
  r.angle = *angle;
  return {{std::move(r)}};
}

/// In the plane: the tool axis keeps its measure (MP7410).
Lowering::FrameChanges Lowering::scale(const CycleDefinition& cycle) {
  const ir::Value* factor = last_value(cycle, 1);
  if (factor == nullptr) return wrong_frame("cycle 11 has no factor");
  ir::FrameChange k = frame(FrameSlot::scale, FrameKind::scale, FrameCombine::replace);
  const auto plane = ir::plane_axes(plane_of(tool_axis_));
  if (factor->is(1))
    k.combine = FrameCombine::clear;
  else
    k.words = {frame_word(plane.u, *factor), frame_word(plane.v, *factor)};
  return {{std::move(k)}};
}

Lowering::FrameChanges Lowering::axis_scale(const CycleDefinition& cycle) {
  if (tilt_) {
    report_.keep("HEI-022", {}, "cycle 26 in a tilted plane is not carried", "motion.transformation");
    return std::nullopt;
  }
  ir::FrameChange k = frame(FrameSlot::scale, FrameKind::scale, FrameCombine::replace);
  std::map<ir::AxisId, ir::Value> centre;
  for (const auto& [n, part] : cycle.parts) {
    for (const auto& l : part.letters) {
      const ir::AxisId axis = axis_of(l.address);
      if (axis != ir::axis::none && l.has_value)
        k.words.push_back(frame_word(axis, l.value));
      else if (l.address.size() == 3 && l.address.substr(0, 2) == "CC")
        centre[axis_of(std::string_view(l.address).substr(2))] = l.value;
    }
  }
  const bool one = std::all_of(k.words.begin(), k.words.end(), [](const auto& w) { return w.value.is(1); });
  FrameChanges changes{std::in_place};
  // f (p + t) = c + f (p - c) where t = (1 / f - 1) c.
  ir::FrameChange inner = frame(FrameSlot::chain, FrameKind::translate, FrameCombine::replace);
  for (const auto& w : k.words) {
    const Term c = centre.count(w.axis) != 0 ? Term(centre[w.axis]) : Term(0), f(w.value);
    const Term t = (Term(1) / f - Term(1)) * c;
    if (!t.is(0)) inner.words.push_back(frame_word(w.axis, t.value()));
  }
  if (!inner.words.empty() || std::exchange(scaled_about_, false)) {
    const auto plane = ir::plane_axes(plane_of(tool_axis_));
    scaled_about_ = !inner.words.empty() && !one;
    if (!scaled_about_) inner.words = {frame_word(plane.u, ir::Value(0)), frame_word(plane.v, ir::Value(0))};
    changes->push_back(std::move(inner));
  }
  const bool all = k.words.size() == 3 && std::all_of(k.words.begin(), k.words.end(), [&k](const auto& w) {
                     return w.axis <= ir::axis::z && w.value.literal() && w.value.number == k.words[0].value.number;
                   });
  k.uniform_scale = all && !one;
  if (k.uniform_scale) k.words.resize(1);
  if (one) {
    k.words.clear();
    k.combine = FrameCombine::clear;
  }
  changes->push_back(std::move(k));
  return changes;
}

/// A cycle of the 200 family that is no machining of its own.
void Lowering::row_effect(const CycleDefinition& cycle) {
  const int index = static_cast<int>(&cycle - flat_.cycles.data());
  if (cycle.row->kind == facts::CycleKind::datum) {
    const ir::Value& row = cycle.values.at(339).value;
    ir::Block b;
    b.actions.emplace_back().data = frame_op(frame(FrameSlot::shift, FrameKind::translate, FrameCombine::clear));
    ir::WorkOffset offset;
    offset.index = row;
    if (row.is(0)) report_.warn("HEI-020", {}, "preset 0 is the datum set by hand: read as no work offset");
    offset.off = row.is(0);
    b.actions.emplace_back().data = std::move(offset);
    put(std::move(b));
    return;
  }
  if (cycle.row->kind == facts::CycleKind::pattern) {
    Item& item = put(ItemKind::plain, ir::Block{});
    item.index = index;
    item.call = CycleCall::once;
    return;
  }
  if (cycle.number == 20 || cycle.number == 270) {
    (cycle.number == 20 ? contour_data_ : train_data_) = index;
    sets(cycle.number == 20 ? AlongText::data : AlongText::train);
    return;
  }
  report_.keep("HEI-018", {}, "cycle " + std::to_string(cycle.number) + " is not carried yet", "cycle.milling");
}

/// Cycle 19.
void Lowering::working_plane(const CycleDefinition& cycle) {
  std::array<ir::Value, 3> angles;
  for (const auto& [n, part] : cycle.parts) {
    for (const auto& l : part.letters) {
      const ir::AxisId axis = axis_of(l.address);
      if (!l.has_value) continue;
      if (axis < ir::axis::a || axis > ir::axis::c)
        return report_.keep("HEI-022", {},
                            "cycle 19 with F or DIST moves the rotary axes: to where is known to the machine only",
                            "motion.transformation");
      angles[axis - ir::axis::a] = l.value;
    }
  }
  tilt(angles);
}

/// Cycle 14.
void Lowering::contour_of_labels(const CycleDefinition& cycle) {
  contour_labels_.clear();
  for (const auto& [n, part] : cycle.parts) {
    for (const auto& l : part.letters) {
      if (l.has_value && l.value.literal()) contour_labels_.push_back(shortest(l.value.number));
    }
  }
  if (contour_labels_.empty()) report_.refuse("HEI-016", {}, "cycle 14 has no labels");
  contours_set();
}

void Lowering::effect(const CycleDefinition& cycle) {
  if (cycle.row != nullptr) return row_effect(cycle);
  switch (cycle.old->kind) {
    case OldKind::datum_shift:
    case OldKind::mirror:
    case OldKind::rotation:
    case OldKind::scale:
    case OldKind::axis_scale: return frame_cycle(cycle);
    case OldKind::dwell: {
      const ir::Value* seconds = last_value(cycle, 1);
      if (seconds == nullptr) return report_.refuse("HEI-016", {}, "the dwell of cycle 9 has no time");
      ir::Block b;
      ir::Dwell dwell;
      dwell.value = *seconds;
      b.actions.emplace_back().data = std::move(dwell);
      put(std::move(b));
      return;
    }
    case OldKind::orientation:
      if (const ir::Value* angle = last_value(cycle, 1)) orient_ = *angle;
      return;
    case OldKind::contour: return contour_of_labels(cycle);
    case OldKind::tolerance:
      return report_.carry("HEI-021", {}, "cycle 32 smooths the path; the programmed path stays; kept as text",
                           "beside.compensation");
    case OldKind::working_plane: return working_plane(cycle);
    default:
      report_.keep("HEI-018", {}, "cycle " + std::to_string(cycle.number) + " is not carried yet", "cycle.milling");
  }
}

/// TRANS DATUM AXIS X+10: the slot of cycle 7.
void Lowering::trans_datum(const syntax::Statement& s) {
  const auto& words = block_->words;
  relies(AlongText::tilt);
  if (tilt_)
    return report_.keep("HEI-022", s.pos, "TRANS DATUM in a tilted plane is not carried", "motion.transformation",
                        "write cycle 7");
  ir::FrameChange c = frame(ir::FrameSlot::shift, ir::FrameKind::translate, ir::FrameCombine::replace_named);
  if (words.empty() || iequals_ascii(words[0].address, "TABLE"))
    return report_.keep("HEI-020", s.pos, "a row of the datum table: the table is known to the machine only",
                        "motion.transformation");
  if (iequals_ascii(words[0].address, "RESET")) c.combine = ir::FrameCombine::clear;
  for (std::size_t i = 1; i < words.size() && c.combine != ir::FrameCombine::clear; ++i) {
    const ir::AxisId axis = axis_of(words[i].address);
    if (axis == ir::axis::none || !words[i].has_value || !has_axis(axis))
      return report_.refuse("HEI-020", words[i].pos, "TRANS DATUM AXIS takes axes with their shift");
    c.words.push_back(frame_word(axis, value(words[i])));
  }
  ir::Block b;
  b.actions.emplace_back().data = frame_op(std::move(c));
  put(std::move(b));
}

}  // namespace cnctrans::frontends::heidenhain
