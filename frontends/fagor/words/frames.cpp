// Zero offsets, programmed frames and the pole.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "frontends/fagor/statements/expr.h"
#include "frontends/fagor/words/block.h"

namespace cnctrans::fagor {

namespace {

using dialects::fagor::Use;

ir::Value negated(ir::Value v) {
  if (!v.literal()) return ir::Value(ir::unary(ir::UnaryOp::negate, v.expr));
  return ir::Value(-v.number);
}

}  // namespace

// --- offsets --------------------------------------------------------------------------------------------------------

std::shared_ptr<const ir::FrameChange> BlockLowerer::frame_of(ir::FrameSlot slot, ir::FrameKind kind,
                                                              ir::FrameCombine combine) {
  ir::FrameChange f;
  f.slot = slot;
  f.kind = kind;
  f.combine = combine;
  return std::make_shared<const ir::FrameChange>(std::move(f));
}

void BlockLowerer::take_coordinates_into(ir::FrameChange& change) {
  coords_taken_ = true;
  for (std::size_t i = 0; i < coord_count_; ++i) {
    const Word& w = *coords_[i];
    if (!state_.has_axis(axis_of(w)))
      state_.error("FAG-009", w.pos, std::string("the machine has no axis ") + word_letter(w));
    if (axis_of(w) == ir::axis::c && state_.surface_by_text != ir::Surface::none)
      state_.error("FAG-045", w.pos, "a frame of the C axis under work on the face or the cylinder is not carried");
    ir::FrameWord f;
    f.axis = axis_of(w);
    f.value = value(w);
    f.pos = w.pos;
    change.words.push_back(std::move(f));
  }
}

void BlockLowerer::apply_offset(const GWord& g) {
  ir::FrameChange change;
  change.kind = ir::FrameKind::translate;
  switch (g.row->use) {
    case Use::machine_coordinates:
      if (coord_count_ == 0) {
        ir::WorkOffset none;
        none.off = true;
        act(std::move(none), g.word);
        return;
      }
      machine_coords_ = g.word;
      if (!state_.facts.first_machine_move.known())
        state_.facts.first_machine_move = word_span(state_.line(), g.word->pos);
      return;
    case Use::work_offset: act(ir::WorkOffset{ir::Value(g.row->value), false}, g.word); return;
    case Use::numbered_offset: {
      const Word* n = take('N');
      if (!n || !n->has_value) {
        state_.error("FAG-014", g.word->pos, "G159 needs the number of the offset N");
        return;
      }
      if (n->expr < 0 && (n->number < 1 || n->number > 20 || n->number != std::floor(n->number)))
        state_.error("FAG-013", n->pos, "zero offsets are N1 to N20");
      act(ir::WorkOffset{value(*n), false}, g.word);
      out_->actions.back().text = {};
      return;
    }
    case Use::table_shift: {  // the table's row, axis by axis, on top of the offset in force
      state_.facts.table_shift = true;
      if (!state_.facts.first_table_shift.known())
        state_.facts.first_table_shift = word_span(state_.line(), g.word->pos);
      result_->needs_program = true;
      change.slot = ir::FrameSlot::shift;
      change.combine = ir::FrameCombine::replace;
      for (const auto& axis : state_.profile().axes) {
        ir::Expr datum;
        ir::SystemRef ref;
        ref.datum = ir::Datum::work_offset;
        ref.axis = axis.id;
        ref.text = "ORG" + axis.name;
        ref.args.push_back(ir::number(g.row->value));
        datum.node = std::move(ref);
        ir::FrameWord f;
        f.axis = axis.id;
        f.scale = ir::WordScale::radius;
        f.value = ir::Value(std::make_shared<const ir::Expr>(std::move(datum)));
        change.words.push_back(std::move(f));
      }
      break;
    }
    case Use::shift:
      state_.facts.shift = state_.facts.inner_frames = true;
      if (coord_count_ != 0) result_->needs_program = true;
      change.slot = ir::FrameSlot::shift;
      change.combine = coord_count_ == 0 ? ir::FrameCombine::clear : ir::FrameCombine::replace_named;
      take_coordinates_into(change);
      break;
    case Use::preset:
      if (const Word* s = take('S')) act(ir::SpindleLimit{state_.spindle(), value(*s), false}, s);
      if (coord_count_ == 0) {
        if ((seen_ & bit('S')) == 0) state_.error("FAG-014", g.word->pos, "G92 needs coordinates or a speed limit S");
        return;
      }
      state_.facts.preset = true;
      result_->needs_program = true;
      change.slot = ir::FrameSlot::preset;
      change.combine = ir::FrameCombine::preset;
      take_coordinates_into(change);
      break;
    default: return;
  }
  act(ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(change))}, g.word);
}

// --- mirror, scale, rotation, pole ----------------------------------------------------------------------------------

void BlockLowerer::apply_frame(const GWord& g) {
  result_->needs_program = true;
  state_.facts.inner_frames = state_.facts.inner_frames || g.row->use != Use::pole;
  ir::FrameChange change;
  switch (g.row->use) {
    case Use::mirror_off:
      act(ir::FrameOp{frame_of(ir::FrameSlot::mirror, ir::FrameKind::mirror, ir::FrameCombine::clear)}, g.word);
      return;
    case Use::mirror_axis:
    case Use::mirror_axes: {
      change.slot = ir::FrameSlot::mirror;
      change.kind = ir::FrameKind::mirror;
      change.combine = ir::FrameCombine::replace_named;
      if (g.row->use == Use::mirror_axes)
        take_coordinates_into(change);
      else
        change.words.push_back({g.row->value, ir::Value(1), ir::WordScale::modal, {}});
      if (g.row->use == Use::mirror_axis && !state_.has_axis(g.row->value))
        state_.error("FAG-009", g.word->pos,
                     std::string("the machine has no axis ") + std::string(ir::fixed_axis_name(g.row->value)));
      for (auto& w : change.words) w.value = ir::Value(1);
      if (change.words.empty()) state_.error("FAG-014", g.word->pos, "G14 needs the axes to be mirrored");
      break;
    }
    case Use::scale: {
      const Word* s = take('S');
      if (coord_count_ != 0) {  // of single axes: on the finished path, so outermost; replaced axis by axis (11.5)
        if (s) state_.error("FAG-006", s->pos, "G72 takes a factor S or axes, not both [21]");
        if (!state_.facts.first_axis_scale.known())
          state_.facts.first_axis_scale = word_span(state_.line(), g.word->pos);
        change.slot = ir::FrameSlot::chain;
        change.kind = ir::FrameKind::scale;
        change.combine = ir::FrameCombine::replace_named;
        take_coordinates_into(change);
        for (auto& w : change.words) w.scale = ir::WordScale::radius;
        break;
      }
      if (!s) {
        state_.error("FAG-014", g.word->pos, "G72 needs a factor S");
        return;
      }
      change.slot = ir::FrameSlot::scale;
      change.kind = ir::FrameKind::scale;
      change.uniform_scale = true;
      state_.facts.scaled = s->expr >= 0 || s->number != 1;
      change.words.push_back({ir::axis::x, value(*s), ir::WordScale::radius, s->pos});
      break;
    }
    case Use::rotation: rotation(g); return;
    case Use::pole: pole(g); return;
    default: return;
  }
  act(ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(change))}, g.word);
}

/// Abscissa and ordinate as programmed.
ir::PlaneAxes BlockLowerer::directions() {
  ir::PlaneAxes p = ir::plane_axes(state_.plane_by_text());
  if (state_.turned()) std::swap(p.u, p.v);
  return p;
}

/// Successive rotations add up; G73 alone ends them all.
void BlockLowerer::rotation(const GWord& g) {
  state_.facts.rotation = true;
  ir::FrameChange change;
  change.slot = ir::FrameSlot::rotation;
  change.kind = ir::FrameKind::rotate;
  const Word* q = take('Q');
  const Word* i = take('I');
  const Word* j = take('J');
  change.combine = q ? ir::FrameCombine::add : ir::FrameCombine::clear;
  if (q) {
    change.has_angle = true;
    change.angle = value(*q);
    if (state_.turned()) change.angle = negated(std::move(change.angle));
  }
  if ((i == nullptr) != (j == nullptr) || (i && !q)) {
    state_.error("FAG-014", g.word->pos, "G73 needs the angle Q, and both I and J or neither");
    return;
  }
  if (i) {
    const ir::PlaneAxes p = directions();
    change.words.push_back({p.u, value(*i), ir::WordScale::modal, i->pos});
    change.words.push_back({p.v, value(*j), ir::WordScale::modal, j->pos});
  }
  act(ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(change))}, g.word);
}

/// I is the abscissa of the plane, J the ordinate; alone: the present point.
void BlockLowerer::pole(const GWord& g) {
  const Word* i = take('I');
  const Word* j = take('J');
  if ((i == nullptr) != (j == nullptr)) {
    state_.error("FAG-014", g.word->pos, "G93 needs both I and J, or neither");
    return;
  }
  if (!i) {
    act(ir::PoleSet{}, g.word);
    return;
  }
  ir::FrameChange at;
  const ir::PlaneAxes p = directions();
  at.words.push_back({p.u, value(*i), ir::WordScale::modal, i->pos});
  at.words.push_back({p.v, value(*j), ir::WordScale::modal, j->pos});
  act(ir::PoleSet{std::make_shared<const ir::FrameChange>(std::move(at))}, g.word);
}

}  // namespace cnctrans::fagor
