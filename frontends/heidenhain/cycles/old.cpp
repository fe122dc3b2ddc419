// Cycles of numbered parts (reference 16.y) -> neutral ones. All of them are counted from where the tool stands.
#include <algorithm>
#include <cmath>
#include <utility>

#include "frontends/heidenhain/cycles/builder.h"
#include "frontends/heidenhain/state/term.h"

namespace cnctrans::frontends::heidenhain {

using dialects::heidenhain::OldKind;
using ir::HoleKind;
using ir::LevelBase;
using ir::Value;

const Value* CycleBuilder::part(int n) const {
  const auto it = cycle_.parts.find(n);
  if (it == cycle_.parts.end()) return nullptr;
  const Value* found = nullptr;
  for (const auto& l : it->second.letters) {
    if (l.has_value) found = &l.value;
  }
  return found;
}

/// All of them are counted from where the tool stands at the call.
bool CycleBuilder::old() {
  const auto kind = cycle_.old->kind;
  const bool pocket = kind == OldKind::pocket || kind == OldKind::round_pocket || kind == OldKind::slot;
  if (kind == OldKind::thread) return thread();
  if (!pocket && kind != OldKind::pecking && kind != OldKind::tapping && kind != OldKind::rigid_tapping)
    return not_carried();
  const Value *distance = part(1), *depth = part(2);
  if (distance == nullptr || depth == nullptr) return refuse("the distance or the depth is missing");
  if (depth->literal() && depth->number > 0) return refuse("a positive depth works upward; that is not carried");
  if (depth->is(0)) {
    skipped_ = true;
    return true;
  }
  hole_.reference = level_of(Value(0), LevelBase::from_initial);
  hole_.surface = level_of(ir::negate(magnitude(*distance)), LevelBase::from_reference);
  hole_.bottom = level_of(ir::negate(magnitude(*depth)), LevelBase::from_surface);
  hole_.retract = level_of(Value(0), LevelBase::from_initial);
  if (kind == OldKind::slot) return old_slot();
  if (pocket) return old_pocket(kind == OldKind::round_pocket);
  const auto feed = [this](int n) {
    if (const Value* f = part(n)) {
      hole_.feed = *f;
      hole_.has_feed = true;
    }
  };
  if (kind == OldKind::pecking) {
    const Value* peck = part(3);
    if (const Value* dwell = part(4)) hole_.dwell_bottom = *dwell;
    feed(5);
    if (peck == nullptr) return refuse("the size of a peck is missing");
    const Value size = magnitude(*peck);
    if (size.literal() && depth->literal() && (size.number == 0 || size.number >= std::abs(depth->number) - 1e-9)) {
      hole_.kind = HoleKind::drill;
      return true;
    }
    hole_.kind = HoleKind::peck_full;
    pecks(size);
    hole_.pecks.reapproach_automatic = true;
    return true;
  }
  if (kind == OldKind::tapping) {
    hole_.kind = HoleKind::tap_floating;
    if (const Value* dwell = part(3)) hole_.dwell_bottom = *dwell;
    feed(4);
    return true;
  }
  const Value* pitch = part(3);
  if (pitch == nullptr) return refuse("the pitch is missing");
  hole_.kind = HoleKind::tap;
  hole_.rigid = true;
  hole_.pitch = *pitch;
  hole_.spindle_after = ir::SpindleStep::off;
  return true;
}

const OldPartValue::Letter* CycleBuilder::letter(int n, std::string_view address) const {
  const auto it = cycle_.parts.find(n);
  if (it == cycle_.parts.end()) return nullptr;
  for (const auto& l : it->second.letters) {
    if (l.address == address) return &l;
  }
  return nullptr;
}

/// 4 and 5: `PECKG -5 F80`, the sides or `RADIUS 30`, `F200 DR+ RADIUS 5`. The tool stands in the middle.
bool CycleBuilder::old_pocket(bool round) {
  hole_.kind = HoleKind::mill;
  hole_.mill.shape = round ? "pocket.circle" : "pocket.rect";
  const int last = round ? 5 : 6;
  const auto number = [&](int n) -> const Value* {  // the first one behind the words of the dialog
    const auto it = cycle_.parts.find(n);
    if (it == cycle_.parts.end()) return nullptr;
    for (const auto& l : it->second.letters) {
      if (l.has_value) return &l.value;
    }
    return nullptr;
  };
  const auto *peck = number(3), *first = number(4), *second = round ? first : number(5);
  const auto *plunge = letter(3, "F"), *feed = letter(last, "F"), *sense = letter(last, "DR");
  if (peck == nullptr || first == nullptr || second == nullptr || feed == nullptr || !feed->has_value)
    return refuse("a size, the infeed or the feed is missing");
  word("infeed", magnitude(*peck));
  if (plunge != nullptr && plunge->has_value) word("plunge_feed", plunge->value);
  word("mill_feed", feed->value);
  word("sense", Value(sense != nullptr && sense->negative ? 2 : 3));
  word("operation", Value(1));
  if (round) {
    word("radius", *first);
  } else {
    word("length", *first);
    word("width", *second);
    const auto* corner = letter(last, "RADIUS");
    if (corner != nullptr && corner->has_value) word("corner", corner->value);
  }
  warn("the way of the passes is that of this program, the part is the same");
  return true;
}

/// 3: the tool stands at an end of the slot, in its middle across; the longer side is the slot's length, its sign the
/// way into it.
bool CycleBuilder::old_slot() {
  if (!old_pocket(false)) return false;
  auto& words = hole_.mill.words;
  const auto size = [&words](std::string_view name) -> Value& {
    return std::find_if(words.begin(), words.end(), [name](const auto& w) { return w.first == name; })->second;
  };
  Value &length = size("length"), &width = size("width");
  if (!length.literal() || !width.literal()) return refuse("the sides of the slot must be numbers");
  const bool across = std::abs(width.number) > std::abs(length.number);
  const double along = across ? width.number : length.number,
               radius_of_end = std::min(std::abs(length.number), std::abs(width.number)) / 2;
  const Term way = Term(along / 2) - (along < 0 ? Term(0) - Term(radius()) : Term(radius()));
  length = magnitude(length);
  width = magnitude(width);
  word("corner", Value(radius_of_end));
  aside_ = across ? std::pair(Value(0), way.value()) : std::pair(way.value(), Value(0));
  return true;
}

/// 18: from where the tool stands by the depth, one turn of the spindle a pitch; the spindle stops there.
bool CycleBuilder::thread() {
  const Value *depth = part(1), *pitch = part(2);
  if (depth == nullptr || pitch == nullptr) return refuse("the depth or the pitch is missing");
  MoveList steps;
  steps.thread(*depth, *pitch);
  steps.spindle_stop();
  return told(steps);
}

}  // namespace cnctrans::frontends::heidenhain
