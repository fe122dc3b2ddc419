// Last looks: marks without a block join the next block, empty blocks that passes left over disappear.
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// A mark whose label the next statement can carry.
bool can_join(const Statement& mark, const Statement& next, const Capabilities& target) {
  if (!std::holds_alternative<Label>(mark.node) || mark.line.span.known() == false) return false;
  const LineInfo& a = mark.line;
  const LineInfo& b = next.line;
  if (!a.comments.empty() || a.joined || b.joined || b.skip_mask != 0 || a.skip_mask != 0 || a.blank_lines_before != 0)
    return false;
  if (std::holds_alternative<Label>(next.node) || std::holds_alternative<Declare>(next.node) ||
      std::holds_alternative<Opaque>(next.node))
    return false;
  if (!a.number.empty() && !b.number.empty()) return false;
  if (!b.comments.empty() && b.comments.front().place == CommentPlace::own_line) return false;
  if (const auto* block = std::get_if<Block>(&next.node); block != nullptr && block->empty()) return false;
  return target.identifier_labels || a.labels.empty();
}

/// Assignments that a pass made of one statement of the source, one behind the other: one line says them.
bool join_assignments(Statement& before, Statement& s, const Capabilities& target) {
  constexpr std::size_t most_in_a_line = 4;
  auto* a = std::get_if<Assign>(&before.node);
  auto* b = std::get_if<Assign>(&s.node);
  if (a == nullptr || b == nullptr || !target.several_assignments || !s.line.span.known()) return false;
  const bool one_place = before.line.span.file == s.line.span.file && before.line.span.line == s.line.span.line;
  if (!one_place || !shows_nothing(s.line) || !before.line.comments.empty() || s.line.joined || before.line.joined ||
      s.line.blank_lines_before != 0 || s.line.skip_mask != before.line.skip_mask ||
      a->items.size() + b->items.size() > most_in_a_line)
    return false;
  const auto machine = [](const Assign::Item& i) { return i.to_system; };
  if (std::any_of(a->items.begin(), a->items.end(), machine) || std::any_of(b->items.begin(), b->items.end(), machine))
    return false;
  for (auto& i : b->items) a->items.push_back(std::move(i));
  return true;
}

/// A motion code by itself, right before a block that says its own.
bool said_again(const Statement& before, const Statement& s) {
  const auto* a = std::get_if<Block>(&before.node);
  const auto* b = std::get_if<Block>(&s.node);
  if (a == nullptr || b == nullptr || !shows_nothing(before.line) || before.line.skip_mask != 0 ||
      before.line.blank_lines_before != 0 || s.line.joined || s.line.skip_mask != 0)
    return false;
  const bool code_only = a->has_motion && a->actions.empty() && !a->motion.moves() && a->repeat_given == 0 &&
                         a->motion.keeps_modal && a->motion.frame == FrameUse::normal;
  return code_only && b->has_motion && b->motion.explicit_code && b->motion.kind != MotionKind::modal &&
         b->motion.keeps_modal;
}

bool makes_neutral(const FrameChange& c) {
  if (c.combine == FrameCombine::clear) return true;
  return c.combine == FrameCombine::replace && c.kind == FrameKind::rotate && c.slot == FrameSlot::rotation &&
         c.has_angle && c.angle.is(0);
}
/// The slot that the block makes neutral, when that is all it does.
std::optional<FrameSlot> cleared(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || b->has_motion || b->actions.size() != 1 || b->repeat_given != 0 || s.line.skip_mask != 0)
    return std::nullopt;
  const auto* f = std::get_if<FrameOp>(&b->actions[0].data);
  return f != nullptr && f->change && makes_neutral(*f->change) ? std::optional(f->change->slot) : std::nullopt;
}
/// The slot that the block makes neutral behind whatever else it does to frames.
std::optional<FrameSlot> cleared_at_last(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || b->has_motion || b->actions.empty() || b->repeat_given != 0 || s.line.skip_mask != 0)
    return std::nullopt;
  const auto* f = std::get_if<FrameOp>(&b->actions.back().data);
  return f != nullptr && f->change && makes_neutral(*f->change) ? std::optional(f->change->slot) : std::nullopt;
}
/// The same right behind.
bool cleared_again(const Statement& before, const Statement& s) {
  const auto slot = cleared(before);
  return slot && slot == cleared(s) && shows_nothing(s.line) && s.line.blank_lines_before == 0 && !s.line.joined &&
         !before.line.joined;
}

bool is_plain_assignment(const Statement& s) {
  const auto* a = std::get_if<Assign>(&s.node);
  return a != nullptr && s.line.skip_mask == 0 && s.line.labels.empty() && s.line.number.empty() &&
         std::none_of(a->items.begin(), a->items.end(), [](const auto& i) { return i.to_system; });
}
/// The same behind assignments, which no frame concerns.
bool cleared_before(const Body& body, const Statement& s) {
  const auto slot = cleared(s);
  if (!slot) return false;
  const bool shown = !shows_nothing(s.line) || s.line.blank_lines_before != 0 || s.line.joined;
  for (auto it = body.rbegin(); it != body.rend(); ++it) {
    if (cleared_again(*it, s) || (!shown && cleared_at_last(*it) == slot)) return true;
    if (!is_plain_assignment(*it)) return false;
  }
  return false;
}

/// The slot that the block fills anew before it moves.
std::optional<FrameSlot> filled(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || b->actions.empty() || s.line.skip_mask != 0) return std::nullopt;
  const auto* f = std::get_if<FrameOp>(&b->actions[0].data);
  const bool fills =
      f != nullptr && f->change && f->change->combine == FrameCombine::replace && b->actions[0].order != Order::after;
  return fills ? std::optional(f->change->slot) : std::nullopt;
}
/// What clears the slot that this block fills has nothing to clear for.
void drop_idle_clear(Body& body, const Statement& s) {
  const auto slot = filled(s);
  for (std::size_t i = body.size(); slot && i > 0; --i) {
    const Statement& before = body[i - 1];
    if (cleared(before) == slot && shows_nothing(before.line) && before.line.blank_lines_before == 0 &&
        !before.line.joined) {
      body.erase(body.begin() + static_cast<std::ptrdiff_t>(i - 1));
      return;
    }
    if (!is_plain_assignment(before)) return;
  }
}

/// The distance mode that a block says, and nothing else.
const ModalSet* mode_alone(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  if (b == nullptr || b->has_motion || b->actions.size() != 1 || b->repeat_given != 0 || s.line.skip_mask != 0 ||
      !shows_nothing(s.line) || s.line.blank_lines_before != 0)
    return nullptr;
  const auto* m = std::get_if<ModalSet>(&b->actions[0].data);
  return m != nullptr && m->setting == Setting::distance ? m : nullptr;
}
/// A block made of the line above it whose mode the next one replaces before it moves.
bool mode_replaced(const Body& body, const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  if (body.size() < 2 || mode_alone(body.back()) == nullptr || b == nullptr || s.line.joined || s.line.skip_mask != 0)
    return false;
  const Span &made = body.back().line.span, &of = body[body.size() - 2].line.span;
  if (made.file != of.file || made.line != of.line) return false;
  return std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
    const auto* m = std::get_if<ModalSet>(&a.data);
    return m != nullptr && m->setting == Setting::distance && a.order != Order::after;
  });
}
/// A mode that the block before has said already.
bool mode_said(const Statement& before, const Statement& s) {
  const ModalSet* now = mode_alone(s);
  const auto* b = now == nullptr ? nullptr : std::get_if<Block>(&before.node);
  if (b == nullptr || before.line.skip_mask != 0 || s.line.joined) return false;
  const ModalSet* last = nullptr;
  for (const auto& a : b->actions) {
    const auto* m = std::get_if<ModalSet>(&a.data);
    if (m != nullptr && m->setting == Setting::distance) last = m;
  }
  return last != nullptr && last->value == now->value;
}

bool number_only(const LineInfo& line) {
  return !line.number.empty() && line.labels.empty() && line.comments.empty() && line.skip_mask == 0 &&
         line.blank_lines_before == 0 && !line.joined;
}

using LabelKey = std::pair<bool, std::string>;  ///< whether it is a number, its text
LabelKey key_of(const LabelRef& l) {
  return {l.is_number, l.text};
}

/// The labels of a routine, and who goes to them.
struct RoutineLabels {
  explicit RoutineLabels(Routine& r) {
    for_each_statement(r.body, [this](Statement& s) {
      for (const auto& l : labels_on(s.line)) ++lines[key_of(l)];
      each_label_ref(s, [this](LabelRef& l, bool is_end) {
        computed = computed || l.computed;
        if (is_end) ends.insert(key_of(l));
      });
    });
  }
  std::map<LabelKey, int> lines;  ///< how many have the label
  std::set<LabelKey> ends;        ///< of ranges
  bool computed = false;          ///< where somebody goes is known at run time only
};

/// A mark that a pass made, right before a statement with a number of its own: who went to the mark goes there.
void lead_on(Routine& routine, const LegaliseContext& context) {
  std::optional<RoutineLabels> labels;
  std::map<LabelKey, LabelRef> moved;
  Body& body = routine.body;
  for (std::size_t i = 0; i + 1 < body.size(); ++i) {
    Statement& mark = body[i];
    const LineInfo& next = body[i + 1].line;
    if (!std::holds_alternative<Label>(mark.node) || !number_only(mark.line) || next.number.empty() ||
        context.source_numbers == nullptr || context.source_numbers->count(mark.line.number.data()) != 0 ||
        next.joined || next.skip_mask != 0 || std::holds_alternative<Opaque>(body[i + 1].node))
      continue;
    if (!labels) labels.emplace(routine);
    const LabelRef old = labels_on(mark.line).front(), to = labels_on(next).front();
    const bool single = labels->lines[key_of(old)] == 1 && labels->lines[key_of(to)] == 1;
    if (!to.is_number || !single || labels->computed || labels->ends.count(key_of(old)) != 0) continue;
    moved.emplace(key_of(old), to);
    labels->lines[key_of(old)] = 0;
    mark.line.number = {};  // nothing is left of it
  }
  if (moved.empty()) return;
  for_each_statement(body, [&moved](Statement& s) {
    each_label_ref(s, [&moved](LabelRef& l, bool /*is_end*/) {
      for (auto to = moved.find(key_of(l)); to != moved.end(); to = moved.find(key_of(l))) l = to->second;
    });
  });
}

/// A range of one routine that another one runs.
bool names_labels_of_others(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* call = std::get_if<CallRoutine>(&s.node);
      const auto* modal = std::get_if<ModalCall>(&s.node);
      const auto* range = std::get_if<Repeat>(&s.node);
      found = found || (call != nullptr && call->has_range) || (modal != nullptr && modal->call.has_range) ||
              (range != nullptr && range->has_program);
    });
  }
  return found;
}

void tidy_body(Body& body, const Program& program, const LabelUses& uses, const LegaliseContext& context) {
  Body out;
  out.reserve(body.size());
  bool begins_line = false;  // the statement that the line began with has gone
  for (auto& s : body) {
    s.line.joined = s.line.joined && !std::exchange(begins_line, false);
    each_body(s, [&](Body& inner) { tidy_body(inner, program, uses, context); });
    if (program.dialect != context.target.dialect && !out.empty() && join_assignments(out.back(), s, context.target))
      continue;
    if (program.dialect != context.target.dialect && cleared_before(out, s)) continue;
    if (program.dialect != context.target.dialect) drop_idle_clear(out, s);
    if (program.dialect != context.target.dialect && mode_replaced(out, s)) {
      out.pop_back();
      if (!out.empty() && mode_said(out.back(), s)) continue;
    }
    if (program.dialect != context.target.dialect && !out.empty() && said_again(out.back(), s)) out.pop_back();
    if (!out.empty() && can_join(out.back(), s, context.target)) {
      bool end = false;
      for (const auto& l : labels_on(out.back().line)) end = end || uses.is_end(l);
      if (!end) {
        LineInfo& mark = out.back().line;
        if (s.line.number.empty()) s.line.number = mark.number;
        s.line.labels.insert(s.line.labels.begin(), mark.labels.begin(), mark.labels.end());
        out.pop_back();
      }
    }
    const auto* b = std::get_if<Block>(&s.node);
    const bool left_over = b != nullptr && b->empty() && b->repeat_given == 0 && shows_nothing(s.line) &&
                           s.line.blank_lines_before == 0 && s.id == 0;
    const bool bare_mark = std::holds_alternative<Label>(s.node) && shows_nothing(s.line);
    begins_line = (left_over || bare_mark) && !s.line.joined;
    if (!left_over && !bare_mark) out.push_back(std::move(s));
  }
  body = std::move(out);
}

}  // namespace

void tidy(Program& program, const LegaliseContext& context) {
  const bool calls_of_parts = names_labels_of_others(program);
  for (auto& r : program.routines) {
    if (program.dialect != context.target.dialect && !calls_of_parts) lead_on(r, context);
  }
  for (auto& r : program.routines) tidy_body(r.body, program, label_uses(program, r), context);
}

}  // namespace cnctrans::ir::passes
