// What jumps that are made while a cycle is active take to their labels.
#include "legaliser/cycles/cycle_pass.h"

namespace cnctrans::ir::passes {

void CyclePass::leave(Statement& s) {
  if (!active_) return;
  const bool on = active_->on_target || active_->maybe_on_target;
  const bool off = active_->native && !by_call_ && !active_->on_target;
  each_label_ref(s, [&](const LabelRef& l, bool is_end) {
    if (is_end || l.computed) return;
    Left& left = left_.try_emplace({l.is_number, l.text}, Left{on, off, false, active_->height}).first->second;
    left.on = left.on || on;
    left.off = left.off || off;
    left.left_height = left.left_height || active_->left_height;
    if (left.height != active_->height) left.height.reset();
  });
}

void CyclePass::note_end(const std::vector<LabelRef>& labels, const Statement* written) {
  if (!active_) return;
  if (written != nullptr) behind_range(*written);
  for (const auto& l : labels) {
    if (uses_.is_end(l)) ends_[{l.is_number, l.text}] = {active_->on_target, active_->maybe_on_target};
  }
}

void CyclePass::perhaps_skipped(const Active& before) {
  if (by_call_) return;
  const bool either = active_->on_target || active_->maybe_on_target || before.on_target || before.maybe_on_target;
  active_->on_target = active_->on_target && before.on_target;
  active_->maybe_on_target = either && !active_->on_target;
}

void CyclePass::behind_range(const Statement& s) {
  const auto* r = std::get_if<Repeat>(&s.node);
  if (r == nullptr || by_call_ || r->has_program || r->last.computed) return;
  const auto end = ends_.find({r->last.is_number, r->last.text});
  if (end == ends_.end()) return;
  const auto count = constant_value(r->count);
  const bool surely = !r->count || (count && *count >= 1);
  const auto [on, maybe] = end->second;
  const bool either = on || maybe || (!surely && (active_->on_target || active_->maybe_on_target));
  active_->on_target = on && (surely || active_->on_target);
  active_->maybe_on_target = either && !active_->on_target;
}

void CyclePass::join(const Statement& s) {
  if (!active_) return;
  const bool on = active_->on_target, late = on && active_->deferred;
  const bool off = active_->native && active_->was_on_target && !on;
  bool with = false, without = false;
  for (const auto& l : labels_on(s.line)) {
    if (active_->native && (on || active_->maybe_on_target)) under_cycle_.emplace(l.is_number, l.text);
    without = without || (uses_.is_target(l) && (off || (late && !behind(l))));
    const auto left = left_.find({l.is_number, l.text});
    if (left == left_.end()) continue;
    with = with || left->second.on;
    without = without || (on && left->second.off);
    active_->left_height = active_->left_height || left->second.left_height;
    if (active_->height != left->second.height) active_->height.reset();
  }
  if (!on) active_->maybe_on_target = active_->maybe_on_target || with;
  if (by_call_ || !without) return;
  active_->on_target = false;
  active_->maybe_on_target = true;
}

}  // namespace cnctrans::ir::passes
