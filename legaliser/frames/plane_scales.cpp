// A scale of two axes for a target that scales all of them: where the third axis can be followed in the text, its words
// are divided by the factor, so that scaling leaves it as it is (equivalences 17.1).
#include <algorithm>
#include <cmath>

#include "ir/edit/rewrite.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

constexpr AxisId linear_axes = axis::z + 1;

/// The factor of a scale of two of the axes X, Y, Z, and the third one.
struct TwoAxes {
  double factor = 1;
  AxisId other = axis::none;
};

std::optional<TwoAxes> scale_of_two(const FrameChange& c, const machine::Profile& machine) {
  if (c.kind != FrameKind::scale || c.uniform_scale || c.words.size() != 2) return std::nullopt;
  const FrameWord &a = c.words[0], &b = c.words[1];
  const bool plain = a.axis < linear_axes && b.axis < linear_axes && a.axis != b.axis && a.value.literal() &&
                     b.value.literal() && a.value.number == b.value.number && a.value.number > 0;
  if (!plain) return std::nullopt;
  const auto other = static_cast<AxisId>(axis::x + axis::y + axis::z - a.axis - b.axis);
  if (machine.axis(other) == nullptr) return std::nullopt;
  return TwoAxes{a.value.number, other};
}

class PlaneScales {
 public:
  PlaneScales(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void run() {
    for (auto& r : program_.routines) {
      uses_ = label_uses(program_, r);
      main_ = r.kind == RoutineKind::main;
      for (std::size_t i = 0; i < r.body.size(); ++i) {
        if (auto* op = scale_in(r.body[i])) complete(r.body, i, *op);
      }
    }
  }

 private:
  static FrameOp* scale_in(Statement& s) {
    auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return nullptr;
    for (auto& a : b->actions) {
      auto* op = std::get_if<FrameOp>(&a.data);
      if (op != nullptr && op->change && op->change->kind == FrameKind::scale) return op;
    }
    return nullptr;
  }

  void complete(Body& body, std::size_t at, FrameOp& op) {
    const auto two = scale_of_two(*op.change, context_.source_machine);
    if (!two || body[at].line.skip_mask != 0) return;
    std::size_t end = at + 1;
    while (end < body.size() && !ends(body[end])) {
      if (!can_follow(body[end], two->other)) return;
      ++end;
    }
    if (end == body.size() && !main_) return;  // the scale goes on in the caller
    auto change = std::make_shared<FrameChange>(*op.change);
    FrameWord word = change->words.front();
    word.axis = two->other;
    word.pos = {};
    change->words.push_back(word);
    op.change = std::move(change);
    bool divided = false;
    for (std::size_t i = at + 1; i < end; ++i) divided = divide(body[i], *two) || divided;
    if (!divided) return;
    const std::string name(program_.axis_name(two->other));
    context_.diagnostics.note("TRN-339", body[at].line.span,
                              "the target scales all axes: the " + name +
                                  " words up to the end of this scale are divided by its factor, so that " + name +
                                  " moves as it did");
  }

  /// Another programmable frame takes the place of the scale, or the program ends.
  static bool ends(const Statement& s) {
    if (std::holds_alternative<End>(s.node)) return true;
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return false;
    return std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
      const auto* op = std::get_if<FrameOp>(&a.data);
      return op != nullptr && op->change && op->change->slot == FrameSlot::chain &&
             (op->change->combine == FrameCombine::clear || op->change->combine == FrameCombine::replace);
    });
  }

  bool can_follow(const Statement& s, AxisId other) const {
    for (const auto& l : labels_on(s.line)) {
      if (uses_.is_target(l) || uses_.computed) return false;
    }
    if (const auto* b = std::get_if<Block>(&s.node)) return s.line.skip_mask == 0 && can_follow_block(*b, other);
    if (const auto* f = std::get_if<For>(&s.node)) return can_follow_body(f->body, other);
    if (const auto* w = std::get_if<While>(&s.node)) return can_follow_body(w->body, other);
    if (const auto* u = std::get_if<Until>(&s.node)) return can_follow_body(u->body, other);
    if (const auto* i = std::get_if<If>(&s.node))
      return can_follow_body(i->then_body, other) && can_follow_body(i->else_body, other);
    return std::holds_alternative<Assign>(s.node) || std::holds_alternative<Message>(s.node) ||
           std::holds_alternative<Declare>(s.node) || std::holds_alternative<Label>(s.node);
  }
  bool can_follow_body(const Body& body, AxisId other) const {
    return std::all_of(body.begin(), body.end(), [&](const Statement& s) { return !ends(s) && can_follow(s, other); });
  }
  static bool can_follow_block(const Block& b, AxisId other) {
    for (const auto& a : b.actions) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      if ((m != nullptr && m->setting == Setting::plane) || std::holds_alternative<CycleDefine>(a.data)) return false;
      const auto* op = std::get_if<FrameOp>(&a.data);
      if (op != nullptr && (!op->change || op->change->kind == FrameKind::scale ||
                            op->change->slot != FrameSlot::chain || op->change->rotation_axis != axis::none))
        return false;
      if (op != nullptr && op->change->kind == FrameKind::rotate && !op->change->has_angle) return false;
    }
    if (!b.has_motion) return true;
    const Motion& m = b.motion;
    const bool threads = m.kind == MotionKind::thread || m.kind == MotionKind::thread_variable ||
                         m.kind == MotionKind::tap_rigid || m.kind == MotionKind::tap_rigid_out;
    const bool centre = std::any_of(m.centers.begin(), m.centers.end(), [&](const auto& c) { return c.axis == other; });
    const bool special =
        m.extra && (!m.extra->computed.empty() || !m.extra->through.empty() || m.extra->has_pitch || m.extra->has_lead);
    return !threads && !centre && !special;
  }

  /// True when a word was divided.
  static bool divide(Statement& s, const TwoAxes& two) {
    bool done = false;
    each_body(s, [&](Body& inner) {
      for (auto& x : inner) done = divide(x, two) || done;
    });
    auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return done;
    const auto part = [&](Value& v) {
      if (v.is(0)) return;
      v = scale(v, 1 / two.factor);
      v.text = {};
      done = true;
    };
    for (auto& a : b->actions) {
      auto* op = std::get_if<FrameOp>(&a.data);
      if (op == nullptr || op->change->kind != FrameKind::translate) continue;
      auto change = std::make_shared<FrameChange>(*op->change);
      for (auto& w : change->words) {
        if (w.axis == two.other) part(w.value);
      }
      op->change = std::move(change);
    }
    if (!b->has_motion || b->motion.frame != FrameUse::normal) return done;
    for (auto& c : b->motion.coords) {
      if (c.axis == two.other) part(c.value);
    }
    return done;
  }

  Program& program_;
  const LegaliseContext& context_;
  LabelUses uses_;
  bool main_ = false;
};

}  // namespace

void complete_scales(Program& program, const LegaliseContext& context) {
  const bool wanted = !context.target.frame_chain && context.target.frames.count(FrameSlot::scale) != 0;
  if (wanted) PlaneScales(program, context).run();
}

}  // namespace cnctrans::ir::passes
