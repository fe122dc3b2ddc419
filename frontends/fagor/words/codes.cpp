// What each G function makes of its block. The rows are in dialects/fagor/g_codes.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "frontends/fagor/statements/expr.h"
#include "frontends/fagor/words/block.h"
#include "ir/check/missing_features.h"

namespace cnctrans::fagor {

namespace {

using dialects::fagor::Use;
using ir::Order;

template <class Value>
bool positive(const Value& v) {
  return !v.literal() || v.number > 0;
}

/// Cycles along directions of the plane: what they mean with its axes exchanged is not settled.
bool needs_straight_plane(const dialects::fagor::GCode& row) {
  switch (row.use) {
    case Use::hole_cycle: return row.code == 87 || row.code == 88;
    case Use::machining:
    case Use::pocket:
    case Use::pattern: return true;
    default: return false;
  }
}

}  // namespace

void BlockLowerer::apply(const GWord& g) {
  if (state_.turned() && needs_straight_plane(*g.row)) {
    keep(g, "motion.transformation",
         the_function(*g.word) + " in a plane with its axes exchanged (G16 XZ, YX, ZY) is kept as text");
    return;
  }
  switch (g.row->use) {
    case Use::motion: motion_code_ = &g; return;
    case Use::setting: setting(g, Order::before); return;
    case Use::setting_after: setting(g, Order::after); return;
    case Use::compensation: compensation(g); return;
    case Use::plane: plane(g, static_cast<ir::Plane>(g.row->value)); return;
    case Use::plane_axes: plane_axes(g); return;
    case Use::dwell: dwell(g); return;
    case Use::absolute_centre: absolute_centre_ = g.word; return;
    case Use::tangent_arc: tangent_arc_ = g.word; return;
    case Use::three_point_arc: three_points_ = g.word; return;
    case Use::round:
    case Use::chamfer:
    case Use::tangent_entry:
    case Use::tangent_exit: corner(g); return;
    case Use::machine_coordinates:
    case Use::work_offset:
    case Use::numbered_offset:
    case Use::table_shift:
    case Use::shift:
    case Use::preset: apply_offset(g); return;
    case Use::mirror_off:
    case Use::mirror_axis:
    case Use::mirror_axes:
    case Use::scale:
    case Use::rotation:
    case Use::pole: apply_frame(g); return;
    case Use::inclined_plane: inclined_plane(g); return;
    default: apply_special(g); return;
  }
}

void BlockLowerer::apply_special(const GWord& g) {
  switch (g.row->use) {
    case Use::soft_corner:
      setting(g, Order::before);
      state_.note("FAG-008", g.word->pos,
                  "G50 (controlled corner rounding) is read as G05: the programmed path is the same");
      return;
    case Use::look_ahead: look_ahead(g); return;
    case Use::home: home(g); return;
    case Use::straight:
      straight_ = &g;
      compensations_off();
      return;
    case Use::longitudinal: longitudinal_axis(g); return;
    case Use::c_axis: c_axis(g); return;
    case Use::spindle_choice: choose_spindle(g); return;
    case Use::spindle_couple: couple_spindles(g); return;
    case Use::hole_cycle: hole_cycle(g); return;
    case Use::machining: machining_cycle(g); return;
    case Use::pattern: pattern(g); return;
    case Use::pocket: pocket_cycle(g); return;
    case Use::cycle_change: change_cycle(g); return;
    case Use::cycle_cancel:
      state_.cycle_by_text = nullptr;
      act(ir::CycleCancel{}, g.word);
      result_->needs_program = true;
      return;
    case Use::call: result_->call = g.word; return;
    default: give_up(g); return;
  }
}

/// Not translated, or without effect on the path: the whole block is kept as text.
void BlockLowerer::give_up(const GWord& g) {
  result_->opaque = g.row->feature;
  if (g.row->use == Use::no_path || ends_nothing(g)) {
    result_->harmless = true;
    state_.note("FAG-008", g.word->pos,
                the_function(*g.word) + " (" + std::string(g.row->title) +
                    ") has no effect on the path; the block is kept as text");
    return;
  }
  keep(g, g.row->feature, the_function(*g.word) + " (" + std::string(g.row->title) + ") is kept as text");
}

/// The end of something that is not carried out, or a transformation that leaves the programmed path as it is: G46 S1
/// says how the slides follow, G46 alone and G45 alone end theirs.
bool BlockLowerer::ends_nothing(const GWord& g) {
  if (g.row->code == 46) {
    const Word* s = letter('S');
    return coord_count_ == 0 && (!s || (s->expr < 0 && (s->number == 0 || s->number == 1)));
  }
  return g.row->code == 45 && in_->words.size() == 1;
}

/// The whole block stays as text; a run stops there.
void BlockLowerer::keep(const GWord& g, std::string_view feature, std::string message) {
  const auto* missing = ir::find_missing_feature(feature);
  const bool beside = missing != nullptr && missing->beside_path;
  state_.warning("FAG-007", g.word->pos, std::move(message),
                 std::string(beside ? "a run goes on without it" : "a run stops here") +
                     "; only a program for this control can be written with it");
  result_->opaque = feature;
  result_->needs_program = true;
}

void BlockLowerer::setting(const GWord& g, Order order) {
  ir::ModalSet set;
  set.setting = g.row->setting;
  set.value = g.row->value;
  if (g.row->use == Use::soft_corner || g.row->use == Use::look_ahead) {
    set.setting = ir::Setting::path_mode;
    set.value = static_cast<std::uint8_t>(ir::PathMode::continuous);
  }
  if (set.setting == ir::Setting::feed_mode) set.feed_memory = ir::FeedMemory::per_mode;
  if (set.setting == ir::Setting::units) {
    state_.units_by_text = static_cast<ir::Units>(set.value);
    state_.facts.units[set.value] = true;
  }
  act(set, g.word, order);
}

void BlockLowerer::compensation(const GWord& g) {
  ir::ModalSet set;
  set.setting = ir::Setting::comp;
  set.value = g.row->value;
  state_.comp_by_text = static_cast<ir::CompSide>(set.value);
  state_.comp_sure = true;
  if (state_.turned() && state_.comp_by_text != ir::CompSide::off) {  // left seen from behind is right
    const bool left = state_.comp_by_text == ir::CompSide::left;
    state_.comp_by_text = left ? ir::CompSide::right : ir::CompSide::left;
    set.value = static_cast<std::uint8_t>(state_.comp_by_text);
    act(set, g.word);
    out_->actions.back().text = {};
  } else {
    act(set, g.word);
  }
  if (const Word* n = take('N')) {
    // One spelling with its code where it stands right behind it.
    if (const std::string_view whole = spelling(*g.word, *n); whole.size() <= 16) {
      out_->actions.back().text = whole;
    } else {
      act(ir::OpaqueWord{word_text(*n)}, n, Order::with);
    }
    state_.note("FAG-008", n->pos,
                "the collision detection " + std::string(word_text(*n)) +
                    " is kept as text: it does not change the programmed path");
  }
}

/// A cycle in force ends with its plane and with the search for home (25.2).
void BlockLowerer::end_cycle() {
  if (!state_.cycle_by_text) return;
  const bool defines = std::any_of(g_.begin(), g_.begin() + static_cast<std::ptrdiff_t>(g_count_),
                                   [](const GWord& other) { return other.row->use == Use::hole_cycle; });
  const bool cancels = std::any_of(g_.begin(), g_.begin() + static_cast<std::ptrdiff_t>(g_count_),
                                   [](const GWord& other) { return other.row->use == Use::cycle_cancel; });
  if (defines || cancels) return;
  state_.cycle_by_text = nullptr;
  act(ir::CycleCancel{}, nullptr);
  result_->needs_program = true;
}

void BlockLowerer::plane(const GWord& g, ir::Plane p, bool turned) {
  if (!surface_here_) leave_surface();
  if (p != state_.plane_now()) {
    end_cycle();
    state_.plane_changed = true;
    if (state_.comp_sure && state_.comp_by_text != ir::CompSide::off)
      state_.error("FAG-046", g.word->pos, "another plane while radius compensation is in force [1071]",
                   "write G40 and a straight move before it");
  }
  const bool arc = state_.motion_by_text == ir::MotionKind::arc_cw || state_.motion_by_text == ir::MotionKind::arc_ccw;
  if (turned != state_.turned() && (arc || state_.comp_by_text != ir::CompSide::off)) {
    state_.error("FAG-026", g.word->pos,
                 "the sense of this plane is the opposite of the one before, and an arc or radius compensation is "
                 "still in force",
                 "write G1 and G40 before the plane");
  }
  state_.plane_code(p, turned, surface_here_);
  ir::ModalSet set;
  set.setting = ir::Setting::plane;
  set.value = static_cast<std::uint8_t>(p);
  act(set, g.word);
}

/// The plane seen from behind: G2, G3, G41, G42 and angles change their sense.
void BlockLowerer::turned_plane(const GWord& g, ir::Plane p) {
  result_->needs_program = true;
  state_.note("FAG-040", g.word->pos,
              "the plane has its axes exchanged: it is read as the usual one, with G2, G3, G41, G42 and the angles of "
              "G73 in the opposite sense");
  plane(g, p, true);
}

/// G16 with two axes of X, Y, Z; a third letter names the longitudinal axis.
void BlockLowerer::plane_axes(const GWord& g) {
  coords_taken_ = true;
  const auto pair = [this](ir::AxisId a, ir::AxisId b) {
    return axis_of(*coords_[0]) == a && axis_of(*coords_[1]) == b;
  };
  if (coord_count_ < 2) {
    state_.error("FAG-014", g.word->pos, "G16 needs the two axes of the plane");
  } else if (pair(ir::axis::x, ir::axis::y)) {
    plane(g, ir::Plane::xy);
  } else if (pair(ir::axis::z, ir::axis::x)) {
    plane(g, ir::Plane::zx);
  } else if (pair(ir::axis::y, ir::axis::z)) {
    plane(g, ir::Plane::yz);
  } else if (pair(ir::axis::y, ir::axis::x)) {
    turned_plane(g, ir::Plane::xy);
  } else if (pair(ir::axis::x, ir::axis::z)) {
    turned_plane(g, ir::Plane::zx);
  } else if (pair(ir::axis::z, ir::axis::y)) {
    turned_plane(g, ir::Plane::yz);
  } else if (surface_plane(g)) {
    return;
  } else {
    keep(g, "motion.transformation", "a plane of other axes than X, Y and Z is kept as text");
  }
  if (out_->actions.empty()) return;
  // The axes belong to the code: one spelling. One that is read in the opposite sense is written as it is read.
  auto& text = out_->actions.back().text;
  text = {};
  if (!state_.turned() && coord_count_ == 2 && !coords_[0]->has_value && !coords_[1]->has_value) {
    const std::string_view whole = spelling(*g.word, *coords_[1]);
    if (whole.size() <= 8) text = whole;
  }
}

void BlockLowerer::dwell(const GWord& g) {
  const Word* k = take('K');
  if (k && (k->expr >= 0 || k->number != 0)) {
    if (k->expr < 0 && (k->number < 0 || k->number > 99999))
      state_.error("FAG-013", k->pos, "a dwell is 1 to 99999 hundredths of a second");
    ir::Dwell d;
    d.value = value(*k);
    d.scale = 0.01;
    act(std::move(d), g.word);
    return;
  }
  if (state_.comp_by_text != ir::CompSide::off) {
    state_.warning("FAG-028", g.word->pos,
                   "G04 without a time under radius compensation: the control drops the compensation at this point and "
                   "takes it up again",
                   "the translation keeps the stop; check the contour around it");
  }
  act(ir::PreparationStop{}, g.word);
}

/// The first R after the code belongs to it; another R is the arc's.
const syntax::Word* BlockLowerer::corner_radius(const Word& code) {
  const std::size_t count = std::min<std::size_t>(radius_count_, radii_.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (radii_[i]->pos.column < code.pos.column) continue;
    const Word* r = radii_[i];
    if (i == 1) std::swap(radii_[0], radii_[1]);
    radii_taken_ = 1;
    return r;
  }
  return nullptr;
}

void BlockLowerer::corner(const GWord& g) {
  const Word* r = radii_taken_ == 0 ? corner_radius(*g.word) : nullptr;
  if (!r) {
    state_.error("FAG-014", g.word->pos, the_function(*g.word) + " needs a radius R after it");
    return;
  }
  ir::Value v = value(*r);
  if (!positive(v))
    state_.error("FAG-013", r->pos, "the R of " + std::string(word_text(*g.word)) + " must be greater than zero");
  result_->needs_program = true;
  if (g.row->use == Use::tangent_entry || g.row->use == Use::tangent_exit) {
    const auto end = g.row->use == Use::tangent_entry ? ir::TangentEnd::entry : ir::TangentEnd::exit;
    act(ir::TangentialEnd{end, std::move(v)}, g.word, Order::with);
    return;
  }
  ir::Corner c;
  c.kind = g.row->use == Use::round ? ir::CornerKind::round : ir::CornerKind::chamfer_leg;
  c.value = std::move(v);
  act(std::move(c), g.word, Order::with);
}

// --- others ---------------------------------------------------------------------------------------------------------

/// From the code to the word, as they stand in the line.
std::string_view BlockLowerer::spelling(const Word& code, const Word& last) {
  const std::string_view end = word_text(last);
  return {code.address.data(), static_cast<std::size_t>(end.data() + end.size() - code.address.data())};
}

void BlockLowerer::look_ahead(const GWord& g) {
  if (!letter('E')) state_.error("FAG-014", g.word->pos, "G51 needs the contour error E");
  setting(g, Order::before);
  coords_taken_ = true;
  const Word* last = g.word;
  for (const Word& w : in_->words) {
    if (&w == g.word || word_letter(w) == 'M' || word_letter(w) == 'G') continue;
    (void)take(word_letter(w));
    if (w.pos.column > last->pos.column) last = &w;
  }
  out_->actions.back().text = spelling(*g.word, *last);
  state_.note("FAG-008", g.word->pos, "G51 (look-ahead machining) is read as G05: the programmed path is the same",
              "its values are kept as text");
}

void BlockLowerer::home(const GWord& g) {
  result_->needs_program = true;
  if (coord_count_ == 0) {
    keep(g, "block.word", "G74 without axes runs a subroutine that only the machine knows; it is kept as text");
    return;
  }
  home_ = g.word;
  compensations_off();
  end_cycle();
  if (state_.lathe()) return;
  ir::ModalSet off;
  off.setting = ir::Setting::length_comp;
  off.value = static_cast<std::uint8_t>(ir::OnOff::off);
  act(off, nullptr);
}

void BlockLowerer::compensations_off() {
  ir::ModalSet off;
  off.setting = ir::Setting::comp;
  off.value = static_cast<std::uint8_t>(ir::CompSide::off);
  act(off, nullptr);
  state_.comp_by_text = ir::CompSide::off;
}

/// The block stays as it is written; what it does is said by the blocks that follow.
void BlockLowerer::marker(const GWord& g, std::string_view feature) {
  result_->opaque = feature;
  result_->harmless = true;
  result_->needs_program = true;
  state_.note("FAG-008", g.word->pos,
              the_function(*g.word) + " is kept as text; what it does is in the blocks that follow");
}
/// G15 Z: the axis of tool length and cycles, until the next plane function (25.1).
void BlockLowerer::longitudinal_axis(const GWord& g) {
  if (coord_count_ != 1 || axis_of(*coords_[0]) > ir::axis::z) {
    state_.error("FAG-014", g.word->pos, "G15 needs one of the axes X, Y, Z");
    return;
  }
  state_.longitudinal_code(axis_of(*coords_[0]));
  marker(g, "motion.length_axis");
}

/// G28 and G29 alone choose the spindle of the blocks that follow (5.4); with axes they exchange them (7.8), which the
/// words of the blocks that follow say: resolve_exchanges().
void BlockLowerer::choose_spindle(const GWord& g) {
  if (coord_count_ != 0) {
    if (g.row->code == 28 && coord_count_ != 2) {
      state_.error("FAG-014", g.word->pos, "G28 with axes exchanges two of them [47]");
      return;
    }
    for (std::size_t i = 0; i < coord_count_; ++i) {
      if (coords_[i]->has_value)
        state_.error("FAG-004", coords_[i]->pos, "the axes of G28 and G29 have no value [4]");
      else if (!state_.has_axis(axis_of(*coords_[i])))
        state_.warning("FAG-051", coords_[i]->pos, std::string("the machine has no axis ") + word_letter(*coords_[i]),
                       "choose a machine profile that has it");
    }
    coords_taken_ = true;
    state_.facts.axes_exchanged = true;
    marker(g, g.row->feature);
    return;
  }
  state_.spindle_code(g.row->value);
  result_->needs_program = true;
  act(ir::MasterSpindle{g.row->value}, g.word);
}

/// G77S, G78S, G30: the second spindle follows the main one; the path is the same (5.5).
void BlockLowerer::couple_spindles(const GWord& g) {
  const bool axes = coord_count_ != 0 || (g.row->code != 30 && !letter('S'));
  if (axes) {
    keep(g, "beside.coupling", the_function(*g.word) + " (" + std::string(g.row->title) + ") is kept as text");
    return;
  }
  if (g.row->code == 30 && !letter('D')) {
    state_.error("FAG-014", g.word->pos, "G30 needs the phase D");
    return;
  }
  if (const Word* d = letter('D'); d && g.row->code == 30 && d->expr < 0 && std::fabs(d->number) > 359.9999)
    state_.error("FAG-013", d->pos, "the phase is -359.9999 to 359.9999 degrees [13, 237]");
  state_.warning("FAG-037", g.word->pos,
                 "the second spindle follows the main one (" + std::string(word_text(*g.word)) +
                     "): the path is the same, but its speed and place are not followed",
                 "the block is kept as text; only a program for this control can be written with it");
  result_->opaque = g.row->feature;
  result_->harmless = true;
}

}  // namespace cnctrans::fagor
