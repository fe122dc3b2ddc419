// What the words of a block mean together: coordinates of a move, of an origin shift or of a preset; F of a dwell; I J
// K of an arc; G90 and G91 by their place among the words.
#include <algorithm>
#include <utility>

#include "dialects/num/limits.h"
#include "dialects/num/variables.h"
#include "frontends/num/state/actions.h"
#include "frontends/num/state/slots.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;
using namespace slot;

void Lowering::resolve() {
  if (has(e('M'))) {
    report_.carry("NUM-034", pending_[static_cast<std::size_t>(e('M'))]->pos,
                  "EM sets the graphic view; the block is kept as text", "block.word");
    return;
  }
  if (marks_.any) resolve_special();
  if (!report_.refused()) resolve_motion();
  if (!report_.refused() && (present_ & ~used_) != 0) resolve_values();
  if (!report_.refused() && ((present_ & ~used_) != 0 || flow_->label_count != 0)) leftovers();
  if (marks_.unsorted) sort_actions();
  face_words();
}

void Lowering::resolve_special() {
  if (marks_.tool_axis != nullptr) tool_axis(*marks_.tool_axis);
  if (marks_.mirror != nullptr) mirror(*marks_.mirror);
  if (marks_.turning != nullptr) turning_cycle(*marks_.turning);
  if (marks_.distance_count != 0) resolve_distance();
  if (marks_.machine_frame != nullptr) {
    const Word& w = *marks_.machine_frame;
    for (const auto& c : out_->motion.coords) {
      if (c.pos.column < w.pos.column) {
        report_.refuse("NUM-012", w.pos, "G52 must stand before the axis words it counts for");
        return;
      }
    }
    for (const auto& c : out_->motion.coords) {
      if (distance_at(c.pos.column) != ir::Distance::incremental) continue;
      report_.refuse("NUM-012", w.pos, "G52 needs absolute programming (G90)");
      return;
    }
    out_->motion.frame = ir::FrameUse::machine;
    out_->motion.frame_pos = w.pos;
  }
  if (marks_.dwell != nullptr) resolve_dwell();
  if (marks_.shift != nullptr) frame_shift(*marks_.shift);
  if (marks_.preset != nullptr) preset(*marks_.preset);
  if (marks_.orient != nullptr) {
    ir::SpindleOrient orient;
    if (const Word* ec = use(e('C'))) orient.angle = value(*ec);
    act(*marks_.orient, Step::machine_before, std::move(orient));
  }
  if (marks_.retract != nullptr && flow_->label_count == 1) {
    leave_out(*marks_.retract, "NUM-033", "names the blocks of an emergency retract, which are never run here", 2);
    flow_->label_count = 0;
  } else if (marks_.retract != nullptr) {
    unknown(*marks_.retract, "G75 needs one block number");
  }
  if (marks_.css != nullptr && !marks_.motion && !out_->motion.coords.empty()) {
    auto& coords = out_->motion.coords;
    if (coords.size() != 1 || coords[0].axis != ir::axis::x) {
      unknown(*marks_.css, "axis words beside G96 without a motion function can't be told from a reference diameter");
      return;
    }
    report_.warn(
        "NUM-031", coords[0].pos,
        "X in a G96 block without a motion function sets the reference diameter and moves nothing; it is left out");
    coords.clear();
  }
}

void Lowering::resolve_motion() {
  auto& m = out_->motion;
  if (marks_.spatial != nullptr || state_.spatial) spatial_correction();
  if (report_.refused()) return;
  if (marks_.cycle != nullptr) return define_cycle(*marks_.cycle);
  const bool words = (present_ & cycle_slots & ~used_) != 0 && marks_.interruptible == nullptr;
  if (words) uses(Modal::cycle);
  if (words && !state_.cycle.words && state_.several_cycles)
    return report_.refuse("NUM-048", {},
                          "these words change the cycle in force, and which one that is depends on the way to this "
                          "block",
                          "write the whole cycle here");
  if (state_.cycle.words) {
    const bool own_motion = marks_.motion && marks_.dwell == nullptr;
    if (own_motion && words) {
      report_.refuse("NUM-026", m.code_pos, "a motion function while a drilling cycle is active",
                     "write G80 before it");
      return;
    }
    if (words) return change_cycle();
    flow_->in_cycle = own_motion || moves_cycle_axis();  // the ways through the program say whether it is in force here
  }
  if (marks_.three_points != nullptr) return through_points();
  if (marks_.thread != nullptr) return thread_segment();
  const bool contour = (present_ & geometry_slots & ~used_) != 0;
  if (contour || (present_ & arc_slots & ~used_) != 0) uses(Modal::motion);
  if (contour && !is_arc(marks_.motion ? m.kind : state_.motion)) {
    line_words();
  } else if (contour || (present_ & arc_slots & ~used_) != 0 || (marks_.motion && is_arc(m.kind))) {
    const bool explicit_arc = marks_.motion && is_arc(m.kind);
    if (explicit_arc || (!marks_.motion && (is_arc(state_.motion) || !state_.known))) resolve_arc(explicit_arc);
  }
  if (report_.refused()) return;
  if (m.moves() || m.radius_given) {
    out_->has_motion = true;
    state_.contour_open = contour && ir::contour::marks_of(*out_).end != ir::contour::ElementEnd::given;
  }
  if (marks_.interruptible != nullptr) interruptible();
  if (flow_->code != nullptr && out_->has_motion) {
    report_.refuse("NUM-013", m.coords.empty() ? m.code_pos : m.coords[0].pos, "a move in the block of a jump or call",
                   "put it into a block of its own");
  }
}

void Lowering::resolve_dwell() {
  const Word& g = *marks_.dwell;
  const Word* f = use(letter('F'));
  if (f == nullptr) return report_.refuse("NUM-008", g.pos, "a dwell needs its time (F in seconds)");
  if (!out_->motion.coords.empty())
    return report_.refuse("NUM-013", out_->motion.coords[0].pos, "a move in the block of a dwell",
                          "put it into a block of its own");
  if (!f->is_expression && (f->number < 0 || f->number > facts::dwell_max)) {
    return report_.refuse("NUM-008", f->pos, "a dwell lasts from 0.01 to 99.99 seconds");
  }
  if (!f->is_expression && f->number < facts::dwell_min)
    report_.warn("NUM-059", f->pos, "a dwell lasts from 0.01 to 99.99 seconds; this one counts for nothing here",
                 "leave it out");
  ir::Dwell dwell;
  dwell.value = value(*f);
  act(g, Step::special, std::move(dwell));
}

void Lowering::resolve_values() {
  if (flow_->code != nullptr && flow_->code->kind == facts::GKind::call) {
    flow_->program = use(letter('H'));
    flow_->repeat = use(letter('S'));
  }
  if (flow_->code != nullptr && flow_->code->kind == facts::GKind::spline) {
    flow_->program = use(letter('H'));
    flow_->curve = use(nu);
  }
  const bool own_feed =
      has(letter('F')) && (used_ & bit(letter('F'))) == 0;  // not the time of a dwell, nor G33's starts
  if (const Word* w = own_feed ? use(letter('F')) : nullptr) act(*w, Step::value, ir::SetFeed{value(*w), false});
  if (has(letter('S')) && flow_->repeat == nullptr && (used_ & bit(letter('S'))) == 0) {
    const Word* w = use(letter('S'));
    act(*w, Step::value, ir::SetSpindle{1, value(*w)});
  }
  if (const Word* w = use(letter('T'))) {
    ir::ToolSelect select;
    select.number = value(*w);
    act(*w, Step::value, std::move(select));
  }
  if (const Word* w = use(letter('D'))) {
    if (check_literal(*w, static_cast<double>(facts::offset_max))) act(*w, Step::value, ir::ToolOffset{value(*w)});
  }
  const bool own_corner = has(e('B')) && (used_ & bit(e('B'))) == 0;
  if (const Word* w = own_corner ? use(e('B')) : nullptr) corner(*w);
  if (has(e('D')) && (used_ & bit(e('D'))) == 0) {
    const Word* w = use(e('D'));
    ir::FrameChange change;
    rotation_words(change, *w);
    act(*w, Step::frame, frame_op(std::move(change)));
  }
  if (const Word* w = use(e('G'))) {
    leave_out(*w, "NUM-034", "lowers the acceleration; it does not change the path", 1);
  }
}

void Lowering::leftovers() {
  if (flow_->label_count != 0 && flow_->code == nullptr)
    unknown(*flow_->labels[0], "a block number stands first in its block");
  const std::uint64_t left = present_ & ~used_;
  for (int s = 0; s < 64; ++s) {
    if ((left >> s & 1U) == 0) continue;
    const Word& w = *pending_[static_cast<std::size_t>(s)];
    if ((geometry_slots & bit(s)) != 0) {
      report_.refuse("NUM-004", w.pos,
                     "`" + std::string(text_of(w)) + "`: angles and tangency belong to a line or an arc", {},
                     "motion.geometry");
    } else if ((arc_slots & bit(s)) != 0 && s == letter('R') && !w.has_value) {
      report_.keep("NUM-028", w.pos,
                   "`" + std::string(text_of(w)) + "`: end points corrected by the tool radius are not carried yet",
                   "block.word");
    } else if ((arc_slots & bit(s)) != 0 && out_->has_motion && !w.is_expression && w.number == 0) {
      report_.warn("NUM-042", w.pos,
                   "`" + std::string(text_of(w)) + "` beside a line is 0 and says nothing; it is left out");
    } else {
      unknown(w, "means nothing in this block");
    }
  }
}

void Lowering::corner(const Word& eb) {
  ir::Corner corner;
  corner.value = value(eb);
  bool minus = !eb.is_expression && eb.number < 0;
  if (eb.is_expression && corner.value.expr) {
    if (const auto* u = std::get_if<ir::Unary>(&corner.value.expr->node)) {
      corner.value = ir::Value(u->operand);
      minus = true;
    } else {
      report_.warn("NUM-008", eb.pos, "EB with a variable is read as a fillet; a negative value would be a chamfer");
    }
  } else if (minus) {
    corner.value = ir::Value(-eb.number, eb.number_text.find('-') == 0 && corner.value.text.size() > 1
                                             ? corner.value.text.substr(1)
                                             : std::string_view{});
  }
  corner.kind = minus ? ir::CornerKind::chamfer_leg : ir::CornerKind::round;
  if (!eb.is_expression && eb.number == 0) return;  // no corner
  if (!out_->has_motion || !out_->motion.moves()) return unknown(eb, "EB belongs to a block that moves");
  act(eb, Step::special, std::move(corner));
}

void Lowering::sort_actions() {
  auto& actions = out_->actions;
  for (std::size_t i = 1; i < actions.size(); ++i) {
    for (std::size_t j = i; j > 0 && steps_[j] < steps_[j - 1]; --j) {
      std::swap(steps_[j], steps_[j - 1]);
      std::swap(actions[j], actions[j - 1]);
    }
  }
}

}  // namespace cnctrans::frontends::num
