// Lines given by an angle, polar end points (reference 10.2, 10.3) and single thread segments (12.2).
#include <cmath>
#include <numbers>
#include <utility>

#include "base/saturate.h"
#include "dialects/num/variables.h"
#include "frontends/num/state/actions.h"
#include "frontends/num/state/slots.h"

namespace cnctrans::frontends::num {

using namespace slot;
namespace facts = dialects::num;

/// All words of the block are arguments of the macro, by the place of their address in the table 'A to 'EZ.
void Lowering::macro_words() {
  const Word& g = *marks_.macro;
  flow_->macro = saturate<std::int64_t>(g.number);
  flow_->macro_pos = g.pos;
  for (const Word& w : block_->words) {
    if (&w == &g) continue;
    const int s = slot_of(w.address);
    if (s < 0 || s > facts::last_argument - facts::first_argument || s == letter('G') || s == letter('M') ||
        s == letter('N'))
      return unknown(w, "beside a macro of the machine this word can't be told from the macro's");
    flow_->arguments.emplace_back(facts::first_argument + s, value(w));
  }
  out_->clear();
  steps_.clear();
}

/// ES, ET, E+ and E-. False after a refusal.
bool Lowering::contour_end(ir::contour::Marks& marks) {
  const Word* es = use(e('S'));
  const Word* et = use(e('T'));
  const Word* side = has(letter('E')) ? pending_[static_cast<std::size_t>(letter('E'))] : nullptr;
  used_ |= bit(letter('E'));
  const auto refuse = [this](const Word& w, std::string what) {
    report_.refuse("NUM-043", w.pos, "`" + std::string(text_of(w)) + "`: " + std::move(what), {}, "motion.geometry");
    return false;
  };
  for (const Word* w : {es, et}) {
    if (w != nullptr && w->has_value) return refuse(*w, "it has no value: the end follows from the next block");
  }
  if (es != nullptr && et != nullptr)
    return refuse(*et, "the element is secant or tangent with the next one, not both");
  if (es != nullptr) marks.end = ir::contour::ElementEnd::secant;
  if (et != nullptr) marks.end = ir::contour::ElementEnd::tangent;
  if (side != nullptr) {
    if (marks.end == ir::contour::ElementEnd::given && !state_.contour_open)
      return refuse(*side, "it chooses one of two points, and here the end is written");
    marks.branch = side->number_text.back() == '-' ? ir::contour::Branch::minus : ir::contour::Branch::plus;
  }
  const Word* first = es != nullptr ? es : et != nullptr ? et : side;
  if (first != nullptr && distance_at(first->pos.column) != ir::Distance::absolute)
    return refuse(*first, "angles, tangency and intersections need absolute words (G90)");
  const auto put = [this](const Word* w, std::string_view word) {
    if (w != nullptr) act(*w, Step::special, ir::OpaqueWord{word});
  };
  put(es, ir::contour::mark::secant);
  put(et, ir::contour::mark::tangent);
  if (side != nullptr)
    put(side, marks.branch == ir::contour::Branch::minus ? ir::contour::mark::minus : ir::contour::mark::plus);
  return !report_.refused();
}

/// EA and EX under G91: from the present point.
void Lowering::polar_step(const Word& ea, const Word& ex) {
  const auto plane = ir::plane_axes(this->plane());
  const double angle = ea.number * std::numbers::pi / 180;
  for (const auto& [axis, step] :
       {std::pair{plane.u, ex.number * std::cos(angle)}, std::pair{plane.v, ex.number * std::sin(angle)}}) {
    auto& c = out_->motion.coords.emplace_back();
    c.axis = axis;
    c.scale = ir::WordScale::radius;
    c.mode = ir::WordMode::incremental;
    c.value = ir::Value(std::round(step * 1e9) / 1e9);
    c.pos = ex.pos;
  }
  out_->has_motion = true;
}

/// A line: EA with one coordinate of the plane (the other follows); EA with EX, a length from the origin; ES or ET,
/// where the end follows from the next element.
void Lowering::line_words() {
  auto& m = out_->motion;
  ir::MotionExtra extra;
  ir::contour::Marks marks;
  const Word* ea = use(e('A'));
  if (report_.refused() || !contour_end(marks)) return;
  const auto refuse = [&](const Word& w, std::string what) {
    report_.refuse("NUM-043", w.pos, "`" + std::string(text_of(w)) + "`: " + std::move(what), {}, "motion.geometry");
  };
  if (ea != nullptr) {
    extra.has_line_angle = true;
    extra.line_angle = value(*ea);
  }
  const auto plane = ir::plane_axes(this->plane());
  std::size_t in_plane = 0;
  for (const auto& c : m.coords) in_plane += c.axis == plane.u || c.axis == plane.v ? 1U : 0U;
  const bool closes = state_.contour_open || !state_.known;
  const Word* ex = ea != nullptr && marks.end == ir::contour::ElementEnd::given ? use(e('X')) : nullptr;
  if (ex != nullptr) {
    if (in_plane != 0) return refuse(*ex, "EX gives the end point beside coordinates of the plane");
    const auto mode = distance_at(ex->pos.column);
    if (mode == ir::Distance::incremental && !ea->is_expression && !ex->is_expression) return polar_step(*ea, *ex);
    if (mode != ir::Distance::absolute) return refuse(*ex, "a polar end point under G91 is carried with numbers only");
    extra.has_line_angle = false;
    extra.has_polar_radius = extra.has_polar_angle = true;
    extra.polar_mode = extra.polar_angle_mode = ir::WordMode::absolute;
    extra.polar_radius = value(*ex);
    extra.polar_angle = value(*ea);
  } else if (ea != nullptr && marks.end == ir::contour::ElementEnd::given && in_plane != 1 &&
             !(in_plane == 2 && closes)) {
    return refuse(*ea, in_plane == 0 ? "the line has no end point; ES or ET says that the next element gives it"
                                     : "the line has an end point and an angle");
  }
  m.extra = std::make_shared<const ir::MotionExtra>(std::move(extra));
  out_->has_motion = true;
}

/// G29, G43: the correction of a mould along the normal (P Q R) of its surface, and the tool's axis (I J K) of five
/// axes [9.5]. The positions are those of the program; what the control adds to them no trace shows.
void Lowering::spatial_correction() {
  uses(Modal::motion);
  const ir::MotionKind kind = marks_.motion ? out_->motion.kind : state_.motion;
  const Word* g = marks_.spatial;
  if (g != nullptr) {
    if (state_.cycle.words || (marks_.motion && !is_straight(kind)))
      return report_.refuse("NUM-060", g->pos, "3D correction takes lines, and no cycle", "", "beside.compensation");
    state_.spatial = true;
    act(*g, Step::special, ir::OpaqueWord{text_of(*g)}, ir::Order::after);  // a translation refuses it
    report_.warn("NUM-060", g->pos,
                 "`" + std::string(text_of(*g)) +
                     "`: the run shows the programmed points; the machine adds the correction of the tool to them. No "
                     "translation carries it");
  }
  if (!is_straight(kind)) {
    if (out_->motion.moves())
      report_.refuse("NUM-060", out_->motion.coords.front().pos, "an arc under 3D correction", "write G40 before it",
                     "beside.compensation");
    return;
  }
  for (const char c : {'P', 'Q', 'R', 'I', 'J', 'K'}) {
    if (!has(letter(c))) continue;
    const Word& w = *use(letter(c));
    act(w, Step::special, ir::OpaqueWord{text_of(w)}, ir::Order::after);
  }
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

/// G10: a line that a contact ends; N: where the program goes on then.
void Lowering::interruptible() {
  auto& m = out_->motion;
  const Word& g = *marks_.interruptible;
  uses(Modal::motion);
  const ir::MotionKind kind = marks_.motion ? m.kind : state_.motion;
  const auto refuse = [&](std::string_view what) {
    report_.refuse("NUM-045", g.pos, "`" + std::string(text_of(g)) + "`: " + std::string(what), {}, "motion.probe");
  };
  if (kind != ir::MotionKind::linear || (!marks_.motion && !state_.known) || m.extra || m.coords.empty())
    return refuse("only a line at feed (G1) that a contact ends is carried");
  if (flow_->label_count > 1) return refuse("it takes one block number");
  for (const auto& s : block_->statements) {
    if (s.keyword == "TEST") return refuse("a move that a condition of the program ends is not carried");
  }
  if (flow_->label_count == 1) flow_->interrupted = flow_->labels[0];
  flow_->label_count = 0;
  if (const Word* ef = use(e('F')))
    report_.warn("NUM-034", ef->pos, "EF counts after an interruption only; it is left out");
  flow_->linear_after = marks_.motion;
  flow_->probes = true;
  m.kind = ir::MotionKind::probe_toward;
  m.explicit_code = true;
  m.keeps_modal = false;
}

}  // namespace cnctrans::frontends::num
