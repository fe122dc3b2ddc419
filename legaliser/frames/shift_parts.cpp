// The coarse and the fine part of a shift (equivalences 17.1), for a target whose shift is one: where the programmable
// frame is nothing but a shift in numbers, the statement becomes the whole shift.
#include <algorithm>
#include <array>

#include "ir/edit/search.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

/// The shift of the chain as its two parts; not known: something else than a shift in numbers may be in force.
struct KnownShift {
  bool known = true;
  std::array<double, axis::first_extra> coarse{}, fine{};
  std::array<WordScale, axis::first_extra> scale{};
};

bool is_part(const FrameChange& c) {
  return c.slot == FrameSlot::chain && c.kind == FrameKind::translate && c.combine == FrameCombine::replace_named &&
         !c.by_distance_mode;
}

bool has_parts(const Program& program) {
  return any_action(program, [](const Action& a) {
    const auto* op = std::get_if<FrameOp>(&a.data);
    return op != nullptr && op->change && is_part(*op->change);
  });
}

class ShiftParts {
 public:
  explicit ShiftParts(Program& program) : program_(program) {}

  void run() {
    for (auto& r : program_.routines) {
      if (r.kind != RoutineKind::main) continue;
      const LabelUses uses = label_uses(program_, r);
      now_ = KnownShift{};
      for (auto& s : r.body) {
        for (const auto& l : labels_on(s.line)) {
          if (uses.is_target(l) || uses.computed) now_.known = false;
        }
        statement(s);
      }
    }
  }

 private:
  void statement(Statement& s) {
    auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) {
      const bool goes_on = std::holds_alternative<Assign>(s.node) || std::holds_alternative<Message>(s.node) ||
                           std::holds_alternative<Declare>(s.node) || std::holds_alternative<Label>(s.node) ||
                           std::holds_alternative<Jump>(s.node);
      if (!goes_on) now_.known = false;
      return;
    }
    for (auto& a : b->actions) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      if (m != nullptr && (m->setting == Setting::units || m->setting == Setting::diameter)) now_.known = false;
      auto* op = std::get_if<FrameOp>(&a.data);
      if (op == nullptr) continue;
      if (!op->change || s.line.skip_mask != 0 || op->change->slot != FrameSlot::chain)
        now_.known = false;
      else
        follow(a, *op);
    }
  }

  void follow(Action& a, FrameOp& op) {
    const FrameChange& c = *op.change;
    const bool whole = c.combine == FrameCombine::clear || c.combine == FrameCombine::replace;
    if (whole) now_ = KnownShift{};
    if (c.combine == FrameCombine::clear) return;
    const bool literal = std::all_of(c.words.begin(), c.words.end(), [](const FrameWord& w) {
      return w.value.literal() && w.axis < axis::first_extra;
    });
    if (c.kind != FrameKind::translate || !literal) now_.known = false;
    if (!now_.known) return;
    for (const auto& w : c.words) {
      const bool fine = c.combine == FrameCombine::compose || c.fine;
      double& part = fine ? now_.fine[w.axis] : now_.coarse[w.axis];
      part = w.value.number + (c.combine == FrameCombine::compose ? part : 0);
      now_.scale[w.axis] = w.scale;
    }
    if (is_part(c)) write(a, op);
  }

  void write(Action& a, FrameOp& op) const {
    auto change = std::make_shared<FrameChange>();
    change->slot = FrameSlot::chain;
    change->combine = FrameCombine::replace;
    for (AxisId axis = 0; axis < axis::first_extra; ++axis) {
      const double total = now_.coarse[axis] + now_.fine[axis];
      const bool named = std::any_of(op.change->words.begin(), op.change->words.end(),
                                     [axis](const FrameWord& w) { return w.axis == axis; });
      if (total != 0 || named) change->words.push_back(FrameWord{axis, Value{total}, now_.scale[axis], {}});
    }
    op.change = std::move(change);
    a.text = {};
  }

  Program& program_;
  KnownShift now_;
};

}  // namespace

void join_shift_parts(Program& program, const LegaliseContext& context) {
  if (!context.target.frame_chain && has_parts(program)) ShiftParts(program).run();
}

}  // namespace cnctrans::ir::passes
