// Canned cycles: hole cycles of the mill (25.2, 25.3), machining cycles of the lathe (ch. 9).
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "dialects/fagor/limits.h"
#include "dialects/fagor/milling.h"
#include "frontends/fagor/statements/expr.h"
#include "frontends/fagor/words/block.h"
#include "ir/cycles/machining.h"

namespace cnctrans::fagor {

namespace {

namespace facts = dialects::fagor;
using syntax::Word;

const facts::HoleLetters& letters_of(int code) {
  return *std::find_if(std::begin(facts::hole_letters), std::end(facts::hole_letters),
                       [code](const facts::HoleLetters& l) { return l.code == code; });
}
bool whole_from_one(const Word& w) {
  return w.expr >= 0 || (w.number >= 1 && w.number == std::floor(w.number));
}
ir::Value magnitude(const ir::Value& v) {
  return v.literal() ? ir::Value(std::fabs(v.number)) : ir::Value(ir::call(ir::Function::abs, {v.expr}));
}

}  // namespace

/// Takes the word of the longitudinal axis out of the block's coordinates.
const Word* BlockLowerer::take_coordinate(ir::AxisId axis) {
  for (std::size_t i = 0; i < coord_count_; ++i) {
    if (axis_of(*coords_[i]) != axis) continue;
    const Word* w = coords_[i];
    std::copy(coords_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
              coords_.begin() + static_cast<std::ptrdiff_t>(coord_count_),
              coords_.begin() + static_cast<std::ptrdiff_t>(i));
    --coord_count_;
    return w;
  }
  return nullptr;
}

/// A letter of a cycle: axis letters, R and D are its own only behind the depth I, D only before T.
const Word* BlockLowerer::take_cycle_word(char c, const Word& depth) {
  const auto behind = [&depth](const Word& w) { return w.pos.column > depth.pos.column; };
  if (c == 'R') {
    for (std::size_t i = 0; i < std::min<std::size_t>(radius_count_, radii_.size()); ++i) {
      if (!behind(*radii_[i])) continue;
      if (i == 1) std::swap(radii_[0], radii_[1]);
      radii_taken_ = 1;
      return radii_[0];
    }
    return nullptr;
  }
  const ir::AxisId axis = ir::fixed_axis(c);
  if (axis != ir::axis::none) {
    const bool there = std::any_of(coords_.begin(), coords_.begin() + static_cast<std::ptrdiff_t>(coord_count_),
                                   [&](const Word* w) { return axis_of(*w) == axis && behind(*w); });
    return there ? take_coordinate(axis) : nullptr;
  }
  const Word* w = letter(c);
  if (!w || !behind(*w)) return nullptr;
  if (c == 'D' && letter('T') && letter('T')->pos.column < w->pos.column) return nullptr;
  return take(c);
}

/// G69 draws back to the reference plane behind every peck: without H, whatever J says, and with J1, whatever H says.
bool BlockLowerer::full_retract(int code) const {
  if (code != 69) return false;
  const Word* h = letter('H');
  const Word* j = letter('J');
  return h == nullptr || (j != nullptr && j->expr < 0 && j->number == 1);
}

/// The word of the longitudinal axis is the reference plane, I the bottom (G83: one peck with its sign); K is the
/// dwell.
void BlockLowerer::hole_cycle(const GWord& g) {
  cycle_ = true;
  result_->needs_program = true;
  refuse_under_arc(g);
  const int code = g.row->value;
  const facts::HoleLetters& letters = letters_of(code);
  const Word* depth = take('I');
  if (!depth || !depth->has_value) {
    state_.error("FAG-014", g.word->pos, the_function(*g.word) + " needs the depth I");
    return;
  }
  const bool out_every_time = full_retract(code);
  for (const char c : letters.kept) {
    if (!take_cycle_word(c, *depth) || (out_every_time && (c == 'H' || c == 'J'))) continue;
    keep(g, "cycle.hole", the_function(*g.word) + " with the word " + c + " is kept as text");
    return;
  }
  std::array<const Word*, 26> words{};
  for (const std::string_view list : {letters.mandatory, letters.optional}) {
    for (const char c : list) {
      words[index(c)] = take_cycle_word(c, *depth);
      if (words[index(c)] || list.data() == letters.optional.data()) continue;
      state_.error("FAG-014", g.word->pos, the_function(*g.word) + " needs the word " + c);
      return;
    }
  }
  ir::HoleCycle c;
  c.reference.given = true;
  c.reference.base = ir::LevelBase::from_initial;
  c.axis = state_.longitudinal_given();
  if (const Word* z = take_coordinate(state_.longitudinal())) {
    c.reference.base = ir::LevelBase::distance_mode;
    c.reference.otherwise = ir::LevelBase::from_initial;
    c.reference.value = value(*z);
  }
  c.bottom.given = true;
  c.bottom.value = value(*depth);
  c.bottom.base = ir::LevelBase::distance_mode;
  c.bottom.otherwise = ir::LevelBase::from_reference;
  const bool pocket = facts::find_milling(code) != nullptr;
  if (const Word* k = words[index('K')]; k && !pocket) {
    c.dwell_bottom = value(*k);
    c.dwell_scale = 0.01;
  }
  if (!cycle_parameters(g, words, c)) return;
  state_.cycle_by_text = std::make_shared<const ir::HoleCycle>(c);
  state_.cycle_code_by_text = code;
  ir::CycleDefine define;
  define.cycle = std::make_shared<const ir::Cycle>(ir::Cycle{std::move(c)});
  act(std::move(define), g.word);
}

/// What the code makes of its words besides levels and dwell.
bool BlockLowerer::cycle_parameters(const GWord& g, const std::array<const Word*, 26>& words, ir::HoleCycle& c) {
  switch (g.row->value) {
    case 69: return variable_pecks(g, words, c);
    case 83: return equal_pecks(g, *words[index('J')], c);
    case 84:
      c.kind = ir::HoleKind::tap_floating;
      if (const Word* r = words[index('R')]; r && (r->expr >= 0 || r->number != 0)) {
        c.kind = ir::HoleKind::tap;
        c.rigid = true;
        if (r->expr >= 0 || r->number != 1) {
          keep(g, "cycle.hole", the_function(*g.word) + " with another R than 0 or 1 is kept as text");
          return false;
        }
      }
      break;
    case 85: c.kind = ir::HoleKind::ream; break;
    case 86: c.kind = ir::HoleKind::bore_stop; break;
    case 87:
    case 88: return pocket_words(g, words, c);
    case 89: c.kind = ir::HoleKind::bore; break;
    default: break;
  }
  return true;
}

/// G79: words of the active cycle from the next point on. The levels it does not name stay as they are.
void BlockLowerer::change_cycle(const GWord& g) {
  cycle_ = true;
  result_->needs_program = true;
  if (!state_.cycle_by_text) {
    keep(g, "cycle.hole", "G79 where no cycle stands above it is kept as text (error 157 without an active cycle)");
    return;
  }
  const int code = state_.cycle_code_by_text;
  ir::HoleCycle c = *state_.cycle_by_text;
  const Word* z = take_coordinate(state_.longitudinal());
  const Word* i = take('I');
  const bool pocket = facts::find_milling(code) != nullptr;
  const Word* j = code == 83 ? take('J') : nullptr;
  const Word* k = code == 83 || pocket ? nullptr : take('K');
  if (k) {
    c.dwell_bottom = value(*k);
    c.dwell_scale = 0.01;
    if (code == 69) c.pecks.dwell = c.dwell_bottom;
    if (code == 82 || code == 81) c.kind = ir::HoleKind::drill;
  }
  bool more = false;
  if (code == 69 && !change_pecks(c, more)) return;
  if (pocket && !change_pocket(code, c, more)) return;
  if (i) c.bottom.value = value(*i);
  if (z) {
    c.reference.value = value(*z);
    c.reference.base = ir::LevelBase::distance_mode;
  }
  if (!change_further(g, code, c, more)) return;
  if (coord_count_ != 0) {
    state_.error("FAG-014", g.word->pos, "G79 takes no point (error 163)");
    return;
  }
  if (!z && !i && !j && !k && !more) {
    if (unused_ != 0)
      keep(g, "cycle.hole", "the change of this cycle's parameter is kept as text");
    else
      state_.error("FAG-014", g.word->pos, "G79 needs a parameter of the cycle (error 71)");
    return;
  }
  if (code == 83) {
    c.bottom.value = state_.cycle_by_text->bottom.value;
    if (!change_equal_pecks(g, i, j, c)) return;
  }
  state_.cycle_by_text = std::make_shared<const ir::HoleCycle>(c);
  c.keeps_initial = true;
  c.reference.given = z != nullptr;
  c.bottom.given = i != nullptr || code == 83;
  ir::CycleDefine define;
  define.here = false;
  define.cycle = std::make_shared<const ir::Cycle>(ir::Cycle{std::move(c)});
  act(std::move(define), g.word);
}

/// R of G69 and G84, D of G69 and the pockets; they are no polar radius and no tool offset here (25.2).
bool BlockLowerer::change_further(const GWord& g, int code, ir::HoleCycle& c, bool& changed) {
  for (const char kept : letters_of(code).kept) {
    if (letter(kept) == nullptr) continue;
    keep(g, "cycle.hole", std::string("the change of the word ") + kept + " of this cycle is kept as text");
    return false;
  }
  if (radius_count_ != 0 && (code == 69 || code == 84)) {
    const Word& r = *radii_[0];
    radii_taken_ = 1;
    changed = true;
    const bool neutral = r.expr < 0 && (r.number == 0 || r.number == (code == 69 ? 1 : 0));
    if (code == 69) {
      c.pecks.law = neutral ? ir::PeckLaw::constant : ir::PeckLaw::geometric;
      c.pecks.degression = neutral ? ir::Value{} : value(r);
      c.pecks.minimum = neutral ? ir::Value{} : state_.cycle_minimum_by_text;
    } else if (r.expr >= 0 || (r.number != 0 && r.number != 1)) {
      keep(g, "cycle.hole", "another R than 0 or 1 of G84 is kept as text");
      return false;
    } else {
      c.kind = neutral ? ir::HoleKind::tap_floating : ir::HoleKind::tap;
      c.rigid = !neutral;
    }
  }
  if (code != 69 && facts::find_milling(code) == nullptr) return true;
  const Word* d = take('D');
  if (d == nullptr) return true;
  changed = true;
  c.surface = {};
  const bool none = d->expr < 0 && d->number == 0;
  if (!none) surface_below(g, *d, c);
  if (code == 69) c.pecks.first_from_surface = !none;
  return true;
}

/// B C L of G69.
bool BlockLowerer::change_pecks(ir::HoleCycle& c, bool& changed) {
  for (const char letter : std::string_view("BCL")) {
    const Word* w = take(letter);
    if (!w && letter != 'L') w = take_coordinate(ir::fixed_axis(letter));
    if (!w) continue;
    if (letter != 'L' && w->expr < 0 && w->number <= 0) {
      state_.error("FAG-013", w->pos, std::string("the ") + letter + " of G69 must be greater than zero (error 1042)");
      return false;
    }
    if (letter == 'L') state_.cycle_minimum_by_text = value(*w);
    if (letter == 'L' && c.pecks.law != ir::PeckLaw::geometric) {  // counts with R only
      changed = true;
      continue;
    }
    (letter == 'B' ? c.pecks.first : letter == 'C' ? c.pecks.reapproach : c.pecks.minimum) = value(*w);
    changed = true;
  }
  return true;
}

/// I and J of G83: the other one stays.
bool BlockLowerer::change_equal_pecks(const GWord& g, const Word* i, const Word* j, ir::HoleCycle& c) {
  if (j && !whole_from_one(*j)) {
    state_.error("FAG-014", g.word->pos, "G83 needs the number of pecks J, a whole number from 1");
    return false;
  }
  const ir::Value count = j ? value(*j) : c.pecks.count;
  if (!count.literal() || (!i && (!c.bottom.value.literal() || !c.pecks.count.literal()))) {
    keep(g, "cycle.hole", "a change of G83 by values that only the run knows is kept as text");
    return false;
  }
  const ir::Value peck = i ? value(*i) : ir::Value(c.bottom.value.number / c.pecks.count.number);
  c.bottom.value = peck.literal()
                       ? ir::Value(peck.number * count.number)
                       : ir::Value(ir::binary(ir::BinaryOp::multiply, ir::as_expr(peck), ir::as_expr(count)));
  c.pecks.first = magnitude(peck);
  c.pecks.count = count;
  return true;
}

/// G60 to G65: the points at which the machining in force is repeated.
void BlockLowerer::pattern(const GWord& g) {
  cycle_ = true;
  result_->needs_program = true;
  ir::NamedCycle c;
  c.name = std::string(cycle_row_->cycle);
  std::uint32_t there = 0;
  for (std::size_t i = 0; i < cycle_word_count_; ++i) {
    const Word& w = *cycle_words_[i];
    there |= bit(word_letter(w));
    c.words.emplace_back(std::string(facts::find_letter(*cycle_row_, word_letter(w))->parameter), value(w));
  }
  for (const auto& l : cycle_row_->letters) {
    if (l.letter == 0 || !l.mandatory || (there & bit(l.letter)) != 0) continue;
    state_.error("FAG-014", g.word->pos, the_function(*g.word) + " needs the word " + l.letter);
    return;
  }
  ir::CycleDefine define;
  define.modal = false;
  define.cycle = std::make_shared<const ir::Cycle>(ir::Cycle{std::move(c)});
  act(std::move(define), g.word);
}

/// G83: bottom = reference + J * I; the tool feeds again from 1 mm above the last depth.
bool BlockLowerer::equal_pecks(const GWord& g, const Word& count, ir::HoleCycle& c) {
  if (!whole_from_one(count)) {
    state_.error("FAG-014", g.word->pos, "G83 needs the number of pecks J, a whole number from 1");
    return false;
  }
  const ir::Value peck = c.bottom.value, pecks = value(count);
  c.kind = ir::HoleKind::peck_full;
  c.bottom.base = ir::LevelBase::from_reference;
  c.bottom.otherwise = ir::LevelBase::from_initial;
  c.bottom.value = peck.literal() && pecks.literal()
                       ? ir::Value(peck.number * pecks.number)
                       : ir::Value(ir::binary(ir::BinaryOp::multiply, ir::as_expr(peck), ir::as_expr(pecks)));
  c.pecks.law = ir::PeckLaw::count;
  c.pecks.first = magnitude(peck);
  c.pecks.count = pecks;
  c.pecks.reapproach = one_millimetre();
  return true;
}

ir::Value BlockLowerer::one_millimetre() const {
  return ir::Value(state_.units_by_text == ir::Units::inch ? 1 / 25.4 : 1);
}

/// G69: pecks B, R*B, R*R*B ... not below L (with R), from the surface D below the reference plane; dwell K after each.
bool BlockLowerer::variable_pecks(const GWord& g, const std::array<const Word*, 26>& words, ir::HoleCycle& c) {
  const auto word = [&words](char letter) { return words[index(letter)]; };
  for (const char letter : std::string_view("BC")) {
    const Word* w = word(letter);
    if (w && w->expr < 0 && w->number <= 0) {
      state_.error("FAG-013", w->pos, std::string("the ") + letter + " of G69 must be greater than zero (error 1042)");
      return false;
    }
  }
  c.kind = ir::HoleKind::peck_full;
  state_.cycle_minimum_by_text = word('L') ? value(*word('L')) : ir::Value{};
  c.pecks.law = ir::PeckLaw::constant;
  c.pecks.first = value(*word('B'));
  if (const Word* r = word('R'); r && (r->expr >= 0 || (r->number != 0 && r->number != 1))) {
    c.pecks.law = ir::PeckLaw::geometric;
    c.pecks.degression = value(*r);
    if (const Word* l = word('L')) c.pecks.minimum = value(*l);
  }
  c.pecks.reapproach = word('C') ? value(*word('C')) : one_millimetre();
  c.pecks.dwell = c.dwell_bottom;
  const Word* d = word('D');
  if (!d || (d->expr < 0 && d->number == 0)) return true;
  surface_below(g, *d, c);
  c.pecks.first_from_surface = true;
  return true;
}

/// The surface lies D from the reference plane toward the bottom: downward, unless the words say otherwise.
void BlockLowerer::surface_below(const GWord& g, const Word& d, ir::HoleCycle& c) {
  const bool known =
      c.bottom.value.literal() && c.reference.value.literal() && c.reference.base == ir::LevelBase::distance_mode;
  const bool upward = known && c.bottom.value.number >= c.reference.value.number;
  if (!known) {
    state_.warning("FAG-044", g.word->pos,
                   "the surface is taken to lie below the reference plane: the depth is known when the program runs");
  }
  c.surface.given = true;
  c.surface.base = ir::LevelBase::from_reference;
  c.surface.value = upward ? value(d) : ir::negate(value(d));
}

/// A letter of a pocket that may not be zero (error 1042).
bool BlockLowerer::pocket_letter(const Word& w, char letter, bool zero_refused) {
  if (!zero_refused || w.expr >= 0 || w.number != 0) return true;
  state_.error("FAG-013", w.pos, std::string("the ") + letter + " of a pocket must not be zero (error 1042)");
  return false;
}

/// G87 and G88: half sizes J K, axial pass B, step C, stock of the finishing pass L, feeds H and V.
bool BlockLowerer::pocket_words(const GWord& g, const std::array<const Word*, 26>& words, ir::HoleCycle& c) {
  const facts::MillingCycle& row = *facts::find_milling(g.row->value);
  c.kind = ir::HoleKind::mill;
  c.mill.shape = std::string(row.shape);
  for (const auto& l : row.letters) {
    const Word* w = l.letter == 0 ? nullptr : words[index(l.letter)];
    if (!w) continue;
    if (!pocket_letter(*w, l.letter, l.zero_refused)) return false;
    c.mill.words.emplace_back(std::string(l.parameter), value(*w));
  }
  c.mill.words.emplace_back("step_factor", ir::Value(facts::pocket_step));
  c.mill.words.emplace_back("plunge_factor", ir::Value(facts::pocket_plunge));
  if (const Word* d = words[index('D')]; d && (d->expr >= 0 || d->number != 0)) surface_below(g, *d, c);
  return true;
}

/// Letters of a pocket behind G79.
bool BlockLowerer::change_pocket(int code, ir::HoleCycle& c, bool& changed) {
  for (const auto& l : facts::find_milling(code)->letters) {
    if (l.letter == 0) continue;
    const Word* w = take(l.letter);
    if (!w && ir::fixed_axis(l.letter) != ir::axis::none) w = take_coordinate(ir::fixed_axis(l.letter));
    if (!w) continue;
    if (!pocket_letter(*w, l.letter, l.zero_refused)) return false;
    const auto it = std::find_if(c.mill.words.begin(), c.mill.words.end(),
                                 [&l](const auto& word) { return word.first == l.parameter; });
    if (it != c.mill.words.end())
      it->second = value(*w);
    else
      c.mill.words.emplace_back(std::string(l.parameter), value(*w));
    changed = true;
  }
  return true;
}

// --- the lathe ------------------------------------------------------------------------------------------------------

/// Behind the code of a machining cycle its letters are its own, whatever they mean elsewhere.
bool BlockLowerer::gather_cycle_word(const Word& w, char c) {
  if (w.extension >= 0 || !facts::find_letter(*cycle_row_, c)) return false;
  const auto begin = cycle_words_.begin(), end = begin + static_cast<std::ptrdiff_t>(cycle_word_count_);
  if (std::any_of(begin, end, [c](const Word* other) { return word_letter(*other) == c; })) {
    state_.error("FAG-005", w.pos, std::string("the word ") + c + " stands twice in the block");
    return true;
  }
  cycle_words_[cycle_word_count_++] = &w;
  return true;
}

/// Ch. 9: runs once, where it is programmed. Most of them end the radius compensation, some before their first move.
void BlockLowerer::machining_cycle(const GWord& g) {
  cycle_ = true;
  result_->needs_program = true;
  ir::NamedCycle c;
  c.name = std::string(cycle_row_->cycle);
  std::uint32_t there = 0;
  for (std::size_t i = 0; i < cycle_word_count_; ++i) {
    const Word& w = *cycle_words_[i];
    const auto* row = facts::find_letter(*cycle_row_, word_letter(w));
    there |= bit(word_letter(w));
    const bool label = row->parameter.ends_with("_label");
    if (label &&
        (w.expr >= 0 || w.number < 0 || w.number != std::floor(w.number) || w.number > facts::max_profile_label))
      state_.error("FAG-015", w.pos, "a label of a profile is a fixed number from 0 to 9999");
    c.words.emplace_back(std::string(row->parameter), value(w));
  }
  for (const auto& l : cycle_row_->letters) {
    if (l.letter == 0 || !l.mandatory || (there & bit(l.letter)) != 0) continue;
    state_.error("FAG-014", g.word->pos, the_function(*g.word) + " needs the word " + l.letter);
    return;
  }
  const auto* machining = ir::cycles::find_machining(c.name);
  if (facts::ends_compensation_first(cycle_row_->code)) compensations_off();
  ir::CycleDefine define;
  define.modal = false;
  define.cycle = std::make_shared<const ir::Cycle>(ir::Cycle{std::move(c)});
  act(std::move(define), g.word);
  if (!machining->ends_comp) return;
  ir::ModalSet off;
  off.setting = ir::Setting::comp;
  off.value = static_cast<std::uint8_t>(ir::CompSide::off);
  act(off, nullptr, ir::Order::after);
  state_.comp_by_text = ir::CompSide::off;
  if (!machining->ends_modes) return;
  off.setting = ir::Setting::distance;
  off.value = static_cast<std::uint8_t>(ir::Distance::absolute);
  act(off, nullptr, ir::Order::after);
}

}  // namespace cnctrans::fagor
