// Lines given by an angle, polar end points (reference 10.2, 10.3) and single thread segments (12.2).
#include <utility>

#include "base/saturate.h"
#include "frontends/num/actions.h"
#include "frontends/num/lower.h"

namespace cnctrans::frontends::num {

using slot::e;
using slot::letter;

namespace {

bool straight(ir::MotionKind k) {
  return k == ir::MotionKind::rapid || k == ir::MotionKind::linear;
}

}  // namespace

/// All words of the block are arguments of the macro, by the place of their address in the table 'A to 'EZ.
void Lowering::macro_words() {
  constexpr std::int64_t first_alias = 900, last_slot = 51;
  const Word& g = *marks_.macro;
  flow_->macro = saturate<std::int64_t>(g.number);
  flow_->macro_pos = g.pos;
  for (const Word& w : block_->words) {
    if (&w == &g) continue;
    const int s = slot_of(w.address);
    if (s < 0 || s > last_slot || s == letter('G') || s == letter('M') || s == letter('N'))
      return unknown(w, "beside a macro of the machine this word can't be told from the macro's");
    flow_->arguments.emplace_back(first_alias + s, value(w));
  }
  out_->clear();
  steps_.clear();
}

/// EA with one coordinate of the plane (the other follows), or EA with EX, a length from the origin.
void Lowering::line_by_angle(const Word& ea) {
  auto& m = out_->motion;
  const ir::MotionKind kind = marks_.motion ? m.kind : state_.motion;
  const auto not_carried = [&](std::string what) {
    report_.refuse("NUM-004", ea.pos, "`" + std::string(text_of(ea)) + "`: " + std::move(what), {}, "motion.geometry");
  };
  for (const int s : {e('S'), e('T'), letter('E')}) {
    if (!has(s)) continue;
    used_ |= std::uint64_t{1} << s;
    return not_carried("an end point that follows from the next element is not carried yet");
  }
  if (!straight(kind)) return not_carried("the angle of an element that is no line is not carried yet");
  const auto plane = ir::plane_axes(state_.plane);
  std::size_t in_plane = 0;
  for (const auto& c : m.coords) in_plane += c.axis == plane.u || c.axis == plane.v ? 1U : 0U;
  ir::MotionExtra extra;
  if (const Word* ex = use(e('X'))) {
    if (in_plane != 0) return not_carried("EX gives the end point beside coordinates of the plane");
    if (distance_at(ex->pos.column) != ir::Distance::absolute)
      return not_carried("a polar end point is carried under G90 only");
    extra.has_polar_radius = extra.has_polar_angle = true;
    extra.polar_mode = ir::WordMode::absolute;
    extra.polar_radius = value(*ex);
    extra.polar_angle = value(ea);
  } else if (in_plane == 1) {
    extra.has_line_angle = true;
    extra.line_angle = value(ea);
  } else {
    return not_carried(in_plane == 0 ? "the line has no end point" : "the line has an end point and an angle");
  }
  m.extra = std::make_shared<const ir::MotionExtra>(std::move(extra));
  out_->has_motion = true;
}

/// G38: one line cut in step with the spindle, K per revolution.
void Lowering::thread_segment() {
  auto& m = out_->motion;
  const Word& g = *marks_.thread;
  const Word* k = use(letter('K'));
  if (marks_.motion || k == nullptr || m.coords.empty())
    return report_.refuse("NUM-011", g.pos, "G38 needs an end point and the pitch K, and no other motion function");
  if (!k->is_expression && k->number <= 0)
    return report_.refuse("NUM-011", k->pos, "the pitch of a thread must be above 0");
  ir::MotionExtra extra;
  extra.has_lead = true;
  extra.lead = value(*k);
  if (m.coords.size() == 1) extra.lead_axis = m.coords[0].axis;
  m.kind = ir::MotionKind::thread;
  m.explicit_code = true;
  m.keeps_modal = false;
  m.code_pos = g.pos;
  m.code_text = text_of(g);
  m.extra = std::make_shared<const ir::MotionExtra>(std::move(extra));
  out_->has_motion = true;
}

}  // namespace cnctrans::frontends::num
