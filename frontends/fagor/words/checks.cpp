// Blocks at which the control stops with an error of its own, though every word of them can be read (ch. 29). The
// number of the control's error stands in brackets.
#include <algorithm>
#include <string>

#include "frontends/fagor/words/block.h"
#include "ir/motion_kinds.h"

namespace cnctrans::fagor {

namespace {

using dialects::fagor::Use;
constexpr std::string_view block_fault = "FAG-046";

}  // namespace

const syntax::Word* BlockLowerer::has_use(Use use) const {
  const auto end = g_.begin() + static_cast<std::ptrdiff_t>(g_count_);
  const auto it = std::find_if(g_.begin(), end, [use](const GWord& g) { return g.row->use == use; });
  return it == end ? nullptr : it->word;
}

void BlockLowerer::check_block() {
  const ir::Motion& m = out_->motion;
  const bool moves = out_->has_motion && m.moves();
  const bool modal = out_->has_motion && m.kind == ir::MotionKind::modal;
  const auto kind = !modal ? m.kind : state_.motion_sure ? state_.motion_by_text : ir::MotionKind::modal;
  const bool arc = moves && ir::is_any_arc(kind);
  if (motion_code_ != nullptr) state_.motion_sure = true;
  check_centre(kind);
  if (state_.plane_changed && moves) check_tangent();
  const bool only_motion = g_count_ == 0 || (g_count_ == 1 && motion_code_ != nullptr);
  if (only_motion && !arc && !state_.comp_begins) return;  // most blocks
  check_compensation(arc, moves);
  if (arc && (kind == ir::MotionKind::arc_cw || kind == ir::MotionKind::arc_ccw)) check_arc_end();
  if (const Word* machine = has_use(Use::machine_coordinates);
      machine != nullptr && m.extra &&
      (m.extra->has_polar_angle || m.extra->has_polar_radius || m.extra->has_line_angle))
    state_.error(block_fault, machine->pos, "polar words and angles have no place in a G53 block [45]",
                 "write the coordinates of the machine");
  if (const Word* dwell = has_use(Use::dwell); dwell != nullptr && in_->words.size() > 1 && (seen_ & bit('K')) == 0)
    state_.error(block_fault, dwell->pos, "G04 without K stands alone in its block [11]",
                 "put the other words behind it");
}

/// G08 takes its tangent from the path before it, which has to lie in the same plane.
void BlockLowerer::check_tangent() {
  if (tangent_arc_ != nullptr)
    state_.error(block_fault, tangent_arc_->pos,
                 "G08 behind a change of the plane: there is no path in this plane before it [1010]",
                 "move in the plane first");
  const ir::PlaneAxes plane = ir::plane_axes(state_.plane_now());
  const auto& m = out_->motion;
  const bool in_plane = std::any_of(m.coords.begin(), m.coords.end(), [&plane](const ir::CoordWord& c) {
    return c.axis == plane.u || c.axis == plane.v;
  });
  if (in_plane || m.extra || !m.centers.empty()) state_.plane_changed = false;
}

/// I, J, K of a block without a code belong to the arc in force; under G00 and G01 there is none.
void BlockLowerer::check_centre(ir::MotionKind kind) {
  const ir::Motion& m = out_->motion;
  const bool given = out_->has_motion && (!m.centers.empty() || (m.extra && m.extra->has_pitch));
  if (!given || m.explicit_code || (kind != ir::MotionKind::rapid && kind != ir::MotionKind::linear)) return;
  state_.error(block_fault,
               m.centers.empty() ? m.coords.empty() ? WordPos{} : m.coords.front().pos : m.centers.front().pos,
               "I, J and K without an arc: G00 or G01 is in force [52]", "write G02 or G03, or leave them out");
}

/// G40, G41, G42 take effect in a straight move: the block itself, or the first one behind it (13.4).
void BlockLowerer::check_compensation(bool arc, bool moves) {
  const Word* here = has_use(Use::compensation);
  if (here != nullptr && (arc || (motion_code_ != nullptr && ir::is_any_arc(motion_code_->row->motion)))) {
    state_.error(block_fault, here->pos, "radius compensation begins and ends in a straight block [210]",
                 "write it in a block with G00 or G01");
  } else if (here == nullptr && arc && state_.comp_begins) {
    state_.error(block_fault, out_->motion.code_pos,
                 "the first move behind G40, G41 or G42 is an arc; radius compensation begins and ends in a straight "
                 "block [1065]",
                 "put a straight move before it");
  }
  if (here != nullptr) state_.comp_begins = !moves;
  if (moves) state_.comp_begins = false;
}

/// A canned cycle is called under G00 or G01.
void BlockLowerer::refuse_under_arc(const GWord& g) {
  const auto other = [](ir::MotionKind k) {
    return ir::is_any_arc(k) || k == ir::MotionKind::thread || k == ir::MotionKind::thread_variable;
  };
  const auto end = g_.begin() + static_cast<std::ptrdiff_t>(g_count_);
  const bool here = std::any_of(g_.begin(), end, [&other](const GWord& w) {
    return w.row->use == Use::tangent_arc || w.row->use == Use::three_point_arc ||
           (w.row->use == Use::motion && other(w.row->motion));
  });
  const bool straight = std::any_of(
      g_.begin(), end, [&other](const GWord& w) { return w.row->use == Use::motion && !other(w.row->motion); });
  if (here) {
    state_.error(block_fault, g.word->pos, "a canned cycle in a block with an arc or a thread [7]",
                 "write G00 before it");
  } else if (!straight && state_.motion_sure && other(state_.motion_by_text)) {
    state_.error(block_fault, g.word->pos, "a canned cycle while an arc or a thread is in force [28]",
                 "write G00 or G01 before it");
  }
}

/// An arc has both end coordinates, or an angle about its centre. The maker's own examples leave the one out that does
/// not change.
void BlockLowerer::check_arc_end() {
  const ir::Motion& m = out_->motion;
  if (m.extra && (m.extra->has_polar_angle || m.extra->has_polar_radius)) return;
  if (!m.radius_given && m.centers.empty()) return;  // without a centre: said elsewhere
  const ir::PlaneAxes plane = ir::plane_axes(state_.plane_now());
  const auto given = std::count_if(m.coords.begin(), m.coords.end(),
                                   [&plane](const ir::CoordWord& c) { return c.axis == plane.u || c.axis == plane.v; });
  if (given != 1) return;
  state_.warning("FAG-092", m.explicit_code ? m.code_pos : m.coords.front().pos,
                 "an arc with only one of its end coordinates: the other axis ends where it began; some controls stop "
                 "here instead [43]",
                 "write both coordinates of the plane");
}

}  // namespace cnctrans::fagor
