// What the words of a block mean together: coordinates of a move, of an origin shift or of a preset; F of a dwell; I J
// K of an arc; G90 and G91 by their place among the words.
#include <algorithm>
#include <utility>

#include "dialects/num/limits.h"
#include "dialects/num/variables.h"
#include "frontends/num/actions.h"
#include "frontends/num/lower.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;
using slot::e;
using slot::letter;

namespace {

constexpr std::uint64_t bit(int s) {
  return std::uint64_t{1} << s;
}
constexpr std::uint64_t arc_slots = bit(letter('I')) | bit(letter('J')) | bit(letter('K')) | bit(letter('R'));
constexpr std::uint64_t cycle_slots =
    bit(e('R')) | bit(e('H')) | bit(e('F')) | bit(e('P')) | bit(e('S')) | bit(letter('P')) | bit(letter('Q'));
constexpr std::uint64_t geometry_slots = bit(e('A')) | bit(e('S')) | bit(e('T')) | bit(letter('E'));

bool is_arc(ir::MotionKind k) {
  return k == ir::MotionKind::arc_cw || k == ir::MotionKind::arc_ccw;
}

struct PlaneLetters {
  char u, v, w;
};
constexpr PlaneLetters centre_letters(ir::Plane p) {
  if (p == ir::Plane::zx) return {'K', 'I', 'J'};
  return p == ir::Plane::yz ? PlaneLetters{'J', 'K', 'I'} : PlaneLetters{'I', 'J', 'K'};
}
constexpr ir::AxisId centre_axis(char c) {
  return c == 'I' ? ir::axis::x : c == 'J' ? ir::axis::y : ir::axis::z;
}

ir::FrameOp frame_op(ir::FrameChange change) {
  return {std::make_shared<const ir::FrameChange>(std::move(change))};
}

}  // namespace

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
}

void Lowering::resolve_special() {
  if (marks_.tool_axis != nullptr) tool_axis(*marks_.tool_axis);
  if (marks_.mirror != nullptr) mirror(*marks_.mirror);
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
  if (before_first && marks_.shift != nullptr) {
    report_.refuse("NUM-012", first->pos, "G90 or G91 in the middle of the words of this block",
                   "write it before them");
    return;
  }
  if (before_first || marks_.distance_count > 1) {
    for (auto& c : out_->motion.coords) {
      if (before_first || c.pos.column < last->pos.column) c.mode = mode_at(c.pos.column);
    }
  }
  const bool incremental = last->number == 91;
  state_.distance = incremental ? ir::Distance::incremental : ir::Distance::absolute;
  ir::ModalSet set;
  set.setting = ir::Setting::distance;
  set.value = facts::u8(state_.distance);
  marks_.distance_after = before_first;
  if (before_first)
    act(*last, Step::after, set, ir::Order::after);
  else
    act(*last, Step::setting, set);
}

std::optional<ir::Distance> Lowering::distance_at(std::uint32_t column) const {
  std::optional<ir::Distance> mode;
  if (state_.known) mode = marks_.distance_before;
  for (std::size_t i = 0; i < marks_.distance_count; ++i) {
    const Word& w = *marks_.distances[i];
    if (w.pos.column < column) mode = w.number == 91 ? ir::Distance::incremental : ir::Distance::absolute;
  }
  return mode;
}

void Lowering::resolve_motion() {
  auto& m = out_->motion;
  if (marks_.cycle != nullptr) return define_cycle(*marks_.cycle);
  if (state_.cycle) {
    if (marks_.motion && marks_.dwell == nullptr)
      return report_.refuse("NUM-026", m.code_pos, "a motion function while a drilling cycle is active",
                            "write G80 before it");
    const bool moves_tool = m.frame == ir::FrameUse::normal &&
                            std::any_of(m.coords.begin(), m.coords.end(),
                                        [this](const ir::CoordWord& c) { return c.axis == cycle_axis(); });
    if (moves_tool || (present_ & cycle_slots) != 0) return change_cycle();
  }
  if (marks_.three_points != nullptr) return through_points();
  if (marks_.thread != nullptr) return thread_segment();
  if (has(e('A'))) {
    if (const Word* ea = use(e('A'))) line_by_angle(*ea);
    return;
  }
  if ((present_ & arc_slots & ~used_) != 0 || (marks_.motion && is_arc(m.kind))) {
    const bool explicit_arc = marks_.motion && is_arc(m.kind);
    if (explicit_arc || (!marks_.motion && (is_arc(state_.motion) || !state_.known))) resolve_arc(explicit_arc);
  }
  if (m.moves() || m.radius_given) out_->has_motion = true;
  if (flow_->code != nullptr && out_->has_motion) {
    report_.refuse("NUM-013", m.coords.empty() ? m.code_pos : m.coords[0].pos, "a move in the block of a jump or call",
                   "put it into a block of its own");
  }
}

void Lowering::resolve_arc(bool explicit_code) {
  auto& m = out_->motion;
  const PlaneLetters p = centre_letters(state_.plane);
  const std::array<char, 3> order{p.u, p.v, p.w};
  std::size_t given = 0;
  for (const char c : order) given += has(letter(c)) ? 1U : 0U;
  const Word* radius = has(letter('R')) ? use(letter('R')) : nullptr;
  const bool pitch = has(letter(p.w)) && (radius != nullptr || given == 3);
  const std::size_t centres = given - (pitch ? 1U : 0U);
  const WordPos where = m.explicit_code ? m.code_pos : block_->words.front().pos;
  if (radius != nullptr) {
    if (centres != 0) return report_.refuse("NUM-011", radius->pos, "an arc has a centre or a radius, not both");
    if (!radius->is_expression && radius->number <= 0)
      return report_.refuse("NUM-011", radius->pos, "the radius of an arc must be above 0");
    m.radius_given = true;
    m.radius = value(*radius);
    m.radius_pos = radius->pos;
  } else if (centres == 1) {
    return report_.refuse("NUM-011", where, "the centre of the arc is incomplete: both coordinates must be written",
                          "a missing one would be 0, not the present position");
  } else if (centres == 0) {
    if (!m.coords.empty() && (explicit_code || state_.known))
      report_.refuse("NUM-011", where, "the arc has neither centre nor radius");
    return;
  }
  for (const char c : order) {
    if (!has(letter(c)) || (pitch && c == p.w)) continue;
    const Word* w = use(letter(c));
    auto& centre = m.centers.emplace_back();
    centre.axis = centre_axis(c);
    centre.mode = settings_.centre_absolute ? ir::CenterMode::follows_distance : ir::CenterMode::from_start;
    centre.scale = ir::WordScale::modal;
    centre.value = axis_value(*w, centre.axis);
    centre.pos = w->pos;
    if (settings_.centre_absolute && marks_.distance_count > 1) {
      return report_.refuse("NUM-012", w->pos, "the centre of an arc beside both G90 and G91",
                            "use one of them in the block");
    }
    if (settings_.centre_absolute && marks_.distance_after && marks_.distances[0]->pos.column < w->pos.column) {
      centre.mode = marks_.distances[0]->number == 91 ? ir::CenterMode::from_start : ir::CenterMode::absolute;
    }
  }
  if (pitch) {
    const Word* w = use(letter(p.w));
    if (!w->is_expression && w->number <= 0)
      return report_.refuse("NUM-011", w->pos, "the pitch of a helix must be above 0");
    ir::MotionExtra extra;
    extra.has_pitch = true;
    extra.pitch = value(*w);
    m.extra = std::make_shared<const ir::MotionExtra>(std::move(extra));
  }
}

void Lowering::through_points() {
  auto& m = out_->motion;
  const Word& g = *marks_.three_points;
  ir::MotionExtra extra;
  for (const char c : {'I', 'J', 'K'}) {
    const Word* w = use(letter(c));
    if (w == nullptr) continue;
    ir::CenterWord point;
    point.axis = centre_axis(c);
    point.mode = ir::CenterMode::follows_distance;
    point.scale = ir::WordScale::modal;
    point.value = axis_value(*w, point.axis);
    point.pos = w->pos;
    extra.through.push_back(std::move(point));
  }
  if (marks_.motion || extra.through.size() != 2 || m.coords.size() < 2) {
    return report_.refuse("NUM-011", g.pos,
                          "G23 needs an end point and a point on the arc, and no other motion function");
  }
  m.kind = ir::MotionKind::arc_through_point;
  m.explicit_code = true;
  m.keeps_modal = false;
  m.code_pos = g.pos;
  m.code_text = text_of(g);
  m.extra = std::make_shared<const ir::MotionExtra>(std::move(extra));
  out_->has_motion = true;
  flow_->linear_after = true;
  state_.motion = ir::MotionKind::linear;
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
  ir::Dwell dwell;
  dwell.value = value(*f);
  act(g, Step::special, std::move(dwell));
}

void Lowering::resolve_values() {
  if (flow_->code != nullptr && flow_->code->kind == facts::GKind::call) {
    flow_->program = use(letter('H'));
    flow_->repeat = use(letter('S'));
  }
  if (const Word* w = use(letter('F'))) act(*w, Step::value, ir::SetFeed{value(*w), false});
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
  if (const Word* w = has(e('B')) ? use(e('B')) : nullptr) corner(*w);
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
                     "`" + std::string(text_of(w)) + "`: profiles by angles and tangency are not carried yet", {},
                     "motion.geometry");
    } else if ((arc_slots & bit(s)) != 0 && s == letter('R') && !w.has_value) {
      report_.refuse("NUM-028", w.pos,
                     "`" + std::string(text_of(w)) + "`: end points corrected by the tool radius are not carried yet",
                     {}, "block.word");
    } else {
      unknown(w, "means nothing in this block");
    }
  }
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
  ir::FrameChange shift;
  shift.slot = ir::FrameSlot::shift;
  shift.kind = ir::FrameKind::translate;
  shift.combine = ir::FrameCombine::replace_named;
  shift.by_distance_mode = true;
  shift.words = take_frame_words();
  const Word* ed = use(e('D'));
  if (shift.words.empty() && ed == nullptr) return unknown(g59, "G59 needs the axes it shifts");
  if (!shift.words.empty()) act(g59, Step::frame, frame_op(std::move(shift)));
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
    act(*r, Step::setting, set);
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

void Lowering::tool_axis(const Word& g16) {
  for (const auto& [name, axis] :
       {std::pair{'P', ir::axis::x}, std::pair{'Q', ir::axis::y}, std::pair{'R', ir::axis::z}}) {
    const int s = letter(name);
    if (!has(s) || pending_[static_cast<std::size_t>(s)]->has_value) continue;
    used_ |= bit(s);
    const Word& w = *pending_[static_cast<std::size_t>(s)];
    const bool plus = w.number_text.empty() || w.number_text.back() == '+';
    if (axis != ir::axis::z || !plus) {
      return report_.refuse("NUM-038", g16.pos, "a tool axis other than +Z is not carried yet", {},
                            "motion.transformation");
    }
    state_.tool_axis = axis;
    leave_out(g16, "NUM-034", "R+ names the tool axis that counts anyway", 2);
    return;
  }
  unknown(g16, "G16 needs P, Q or R with a sign");
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
  if (!out_->has_motion || out_->motion.coords.empty()) return unknown(eb, "EB belongs to a block that moves");
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
