// A scale of two axes for a target that scales all of them: where the third axis can be followed in the text, its words
// are divided by the factor, so that scaling leaves it as it is (equivalences 17.1). A subprogram that is called under
// the scale has a copy with divided words.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

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
    for (auto& c : copies_) add(std::move(c));
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
    slot_ = op.change->slot;
    std::size_t end = at + 1;
    while (end < body.size() && !ends(body[end])) {
      if (!can_follow(body[end], two->other)) return;
      ++end;
    }
    if (end == body.size() && !main_) return;  // the scale goes on in the caller
    auto change = std::make_shared<FrameChange>(*op.change);
    FrameWord word = change->words.front();
    if (slot_ == FrameSlot::chain) {
      word.axis = two->other;
      word.pos = {};
      change->words.push_back(word);
    } else {
      word.axis = axis::x;
      change->words = {word};
      change->uniform_scale = true;
    }
    op.change = std::move(change);
    if (two->factor == 1) return;
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
  [[nodiscard]] bool ends(const Statement& s) const {
    if (std::holds_alternative<End>(s.node)) return true;
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return false;
    return std::any_of(b->actions.begin(), b->actions.end(), [this](const Action& a) {
      const auto* op = std::get_if<FrameOp>(&a.data);
      return op != nullptr && op->change && op->change->slot == slot_ &&
             (op->change->combine == FrameCombine::clear || op->change->combine == FrameCombine::replace);
    });
  }

  bool can_follow(const Statement& s, AxisId other) const {
    for (const auto& l : labels_on(s.line)) {
      if (uses_.is_target(l) || uses_.computed) return false;
    }
    if (const auto* b = std::get_if<Block>(&s.node)) return s.line.skip_mask == 0 && can_follow_block(*b, other);
    if (const auto* call = std::get_if<CallRoutine>(&s.node)) return can_follow_call(*call, other);
    if (const auto* f = std::get_if<For>(&s.node)) return can_follow_body(f->body, other);
    if (const auto* w = std::get_if<While>(&s.node)) return can_follow_body(w->body, other);
    if (const auto* u = std::get_if<Until>(&s.node)) return can_follow_body(u->body, other);
    if (const auto* i = std::get_if<If>(&s.node))
      return can_follow_body(i->then_body, other) && can_follow_body(i->else_body, other);
    const auto* repeat = std::get_if<Repeat>(&s.node);
    const bool stays = std::holds_alternative<Return>(s.node) || std::holds_alternative<Jump>(s.node) ||
                       (repeat != nullptr && !repeat->has_program);
    if (!open_.empty() && stays) return true;  // all of the subprogram is divided
    return std::holds_alternative<Assign>(s.node) || std::holds_alternative<Message>(s.node) ||
           std::holds_alternative<Declare>(s.node) || std::holds_alternative<Label>(s.node);
  }
  bool can_follow_body(const Body& body, AxisId other) const {
    return std::all_of(body.begin(), body.end(), [&](const Statement& s) { return !ends(s) && can_follow(s, other); });
  }
  [[nodiscard]] std::optional<std::size_t> callee_of(const CallRoutine& call) const {
    if (call.computed || call.has_range || call.tail || call.optional) return std::nullopt;
    for (std::size_t i = 0; i < program_.routines.size(); ++i) {
      const Routine& r = program_.routines[i];
      if (r.name == call.routine && r.kind != RoutineKind::main) return i;
    }
    return std::nullopt;
  }
  bool can_follow_call(const CallRoutine& call, AxisId other) const {
    const auto callee = callee_of(call);
    if (!callee || std::count(open_.begin(), open_.end(), *callee) != 0) return false;
    open_.push_back(*callee);
    const LabelUses outer = std::exchange(uses_, LabelUses{});
    const bool can = can_follow_body(program_.routines[*callee].body, other);
    uses_ = outer;
    open_.pop_back();
    return can;
  }
  [[nodiscard]] bool can_follow_block(const Block& b, AxisId other) const {
    for (const auto& a : b.actions) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      if ((m != nullptr && m->setting == Setting::plane) || std::holds_alternative<CycleDefine>(a.data)) return false;
      const auto* op = std::get_if<FrameOp>(&a.data);
      if (op != nullptr &&
          (!op->change || op->change->kind == FrameKind::scale ||
           (slot_ == FrameSlot::chain && op->change->slot != slot_) || op->change->rotation_axis != axis::none))
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
  bool divide(Statement& s, const TwoAxes& two) {
    bool done = false;
    if (auto* call = std::get_if<CallRoutine>(&s.node)) return divide_called(*call, two);
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
      const bool inside = op != nullptr && op->change->kind == FrameKind::translate && op->change->slot == slot_;
      if (!inside) continue;
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

  /// The call is one of a copy whose words are divided.
  bool divide_called(CallRoutine& call, const TwoAxes& two) {
    const std::size_t original = *callee_of(call);
    auto same = std::find_if(copies_.begin(), copies_.end(), [&](const Copy& c) {
      return c.original == original && c.two.factor == two.factor && c.two.other == two.other;
    });
    if (same == copies_.end()) {
      Copy copy{original, two, program_.routines[original], false};
      copy.routine.name = free_name(copy.routine.name);
      for (auto& s : copy.routine.body) copy.divided = divide(s, two) || copy.divided;
      copies_.push_back(std::move(copy));
      same = copies_.end() - 1;
    }
    if (same->divided) call.routine = same->routine.name;
    return same->divided;
  }
  [[nodiscard]] RoutineName free_name(const RoutineName& of) const {
    RoutineName name = of;
    const auto taken = [&] {
      const auto is = [&name](const Routine& r) { return r.name == name; };
      return std::any_of(program_.routines.begin(), program_.routines.end(), is) ||
             std::any_of(copies_.begin(), copies_.end(), [&](const Copy& c) { return is(c.routine); });
    };
    for (int n = 1; taken(); ++n) {
      if (of.text.empty())
        name.number = of.number + n;
      else
        name.text = of.text + "_" + std::to_string(n);
    }
    return name;
  }
  struct Copy {
    std::size_t original = 0;
    TwoAxes two;
    Routine routine;
    bool divided = false;
  };
  /// An original that nothing calls any more gives its place to its copy.
  void add(Copy&& copy) {
    if (!copy.divided) return;
    const RoutineName original = program_.routines[copy.original].name;
    bool called = false;
    const auto look = [&](Body& body) {
      for_each_statement(body, [&](Statement& s) {
        const auto* c = std::get_if<CallRoutine>(&s.node);
        const auto* m = std::get_if<ModalCall>(&s.node);
        called = called || (c != nullptr && (c->computed || c->routine == original)) || m != nullptr;
      });
    };
    for (auto& r : program_.routines) look(r.body);
    for (auto& c : copies_) look(c.routine.body);
    if (called) return program_.routines.push_back(std::move(copy.routine));
    program_.routines[copy.original] = std::move(copy.routine);
  }

  Program& program_;
  const LegaliseContext& context_;
  mutable LabelUses uses_;
  mutable std::vector<std::size_t> open_;  ///< routines that are being followed
  std::vector<Copy> copies_;
  FrameSlot slot_ = FrameSlot::chain;  ///< of the scale at hand
  bool main_ = false;
};

}  // namespace

void complete_scales(Program& program, const LegaliseContext& context) {
  const bool wanted = !context.target.frame_chain && context.target.frames.count(FrameSlot::scale) != 0;
  if (wanted) PlaneScales(program, context).run();
}

}  // namespace cnctrans::ir::passes
