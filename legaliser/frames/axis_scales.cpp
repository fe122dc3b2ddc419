#include "legaliser/frames/axis_scales.h"

#include <algorithm>

#include "ir/edit/rewrite.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

bool scales_axes(const FrameChange& c) {
  return c.kind == FrameKind::scale && !c.uniform_scale && c.combine == FrameCombine::replace_named;
}

/// Takes back what no program of factors alone has put: written, it would take the factors back on the target.
bool takes_nothing_back(const Action& a, const FrameChange& c) {
  return c.combine == FrameCombine::clear && c.slot != FrameSlot::chain && c.slot != FrameSlot::scale &&
         a.pos.column != 0;
}

/// Leaves a frame as it is where nothing else changes it: the reset that a reader adds to an offset, a factor of 1.
bool idle(const Action& a, const FrameChange& c) {
  if (c.combine == FrameCombine::clear)
    return takes_nothing_back(a, c) || (c.slot != FrameSlot::chain && a.pos.column == 0);
  return c.kind == FrameKind::scale && c.uniform_scale && c.words.size() == 1 && c.words[0].value.is(1);
}

const FrameChange* change_in(const Action& a) {
  const auto* f = std::get_if<FrameOp>(&a.data);
  return f != nullptr ? f->change.get() : nullptr;
}

/// The factors of single axes are all that the program does to its frames.
bool only_scales(const Program& program) {
  bool found = false, other = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        const FrameChange* c = change_in(a);
        if (c == nullptr) continue;
        found = found || scales_axes(*c);
        other = other || !(scales_axes(*c) || idle(a, *c));
      }
    });
  }
  return found && !other;
}

Assign::Item component(const FrameWord& w) {
  Expr frame;
  frame.type = Type::frame;
  SystemRef whole;
  whole.datum = Datum::frame_programmed;
  frame.node = whole;
  Expr axis;
  axis.type = Type::axis;
  axis.node = AxisName{w.axis};
  Expr with;
  with.type = Type::frame;
  with.node = Call{Function::frame_with,
                   {std::make_shared<const Expr>(std::move(frame)), std::make_shared<const Expr>(std::move(axis)),
                    number(static_cast<double>(FramePart::scale)), as_expr(w.value)},
                   RoundHalf::away};
  Assign::Item item;
  item.to_system = true;
  item.system = std::move(whole);
  item.value = std::make_shared<const Expr>(std::move(with));
  item.pos = w.pos;
  return item;
}

}  // namespace

std::optional<AxisId> axis_of_component(const Assign::Item& item) {
  if (!item.to_system || item.system.datum != Datum::frame_programmed || !item.value) return std::nullopt;
  const auto* with = std::get_if<Call>(&item.value->node);
  if (with == nullptr || with->function != Function::frame_with || with->args.size() != 4) return std::nullopt;
  const auto* axis = std::get_if<AxisName>(&with->args[1]->node);
  return axis != nullptr ? std::optional(axis->axis) : std::nullopt;
}

void write_axis_scales(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || context.target.functions.count(Function::frame_with) == 0 ||
      !only_scales(program))
    return;
  for (auto& r : program.routines) {
    Editor editor(program, r, context);
    rewrite_body(r.body, [&](Statement&& s, Body& out) {
      auto* b = std::get_if<Block>(&s.node);
      Assign all;
      if (b != nullptr) {
        std::erase_if(b->actions, [&all](const Action& a) {
          const FrameChange* c = change_in(a);
          if (c != nullptr && takes_nothing_back(a, *c)) return true;
          if (c == nullptr || !scales_axes(*c)) return false;
          for (const auto& w : c->words) all.items.push_back(component(w));
          return true;
        });
      }
      if (all.items.empty()) {
        out.push_back(std::move(s));
      } else if (b->actions.empty() && !b->has_motion) {
        s.node = std::move(all);
        out.push_back(std::move(s));
      } else {
        Body before;
        before.push_back(made(s.line, std::move(all)));
        editor.put(out, std::move(before), std::move(s));
      }
    });
  }
}

}  // namespace cnctrans::ir::passes
