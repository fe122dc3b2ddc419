#include "frontends/heidenhain/ways/flow.h"

#include <algorithm>

#include "dialects/heidenhain/variables.h"
#include "frontends/heidenhain/ways/from_pole.h"
#include "frontends/heidenhain/ways/way.h"
#include "ir/edit/rewrite.h"
#include "ir/text/texts.h"

namespace cnctrans::frontends::heidenhain {

namespace {

/// Narrowed to what both say; true when it changed.
bool narrow(Arrival& a, const Arrival& b) {
  if (!b.reached) return false;
  if (!a.reached) {
    a = b;
    return true;
  }
  const Arrival before = a;
  const auto same = [](int& mine, int other) {
    if (mine != other) mine = Arrival::several;
  };
  same(a.cycle, b.cycle);
  same(a.pole, b.pole);
  same(a.modal, b.modal);
  same(a.plane, b.plane);
  same(a.pattern, b.pattern);
  a.moved = a.moved || b.moved;
  a.written = a.written || b.written;
  same(a.from, b.from);
  a.changed = a.changed || b.changed;
  same(a.overlay, b.overlay);
  same(a.tool, b.tool);
  same(a.plunge, b.plunge);
  for (std::size_t k = 0; k < along_text; ++k) same(a.text[k], b.text[k]);
  same(a.selected, b.selected);
  a.outside = a.outside || b.outside;
  a.rewritten = a.rewritten || b.rewritten;
  a.selected_outside = a.selected_outside || b.selected_outside;
  for (const auto& [name, text] : b.texts) a.texts.try_emplace(name);
  for (auto& [name, text] : a.texts) {
    const auto other = b.texts.find(name);
    if (other == b.texts.end() || other->second != text) text.reset();
  }
  return !(a == before);
}

bool writes_pole(const Item& i, const Pole& pole) {
  return std::any_of(i.writes.begin(), i.writes.end(), [&pole](const ir::VarRef& v) {
    return std::any_of(pole.words.begin(), pole.words.end(),
                       [&v](const auto& w) { return w.value.expr && ir::passes::reads(w.value.expr, v); });
  });
}

bool is_text(const ir::Assign::Item& item) {
  return item.target.space == dialects::heidenhain::space_qs;
}
bool sets_text(const Item& i) {
  const auto* assign = std::get_if<ir::Assign>(&i.statement.node);
  return assign != nullptr && std::any_of(assign->items.begin(), assign->items.end(), is_text);
}
/// What an assignment makes of the texts.
void follow_texts(const Item& i, Arrival& a) {
  const auto known = [&a](const ir::ExprPtr& e) {
    const auto* v = ir::passes::as_variable(e);
    const auto it = v == nullptr ? a.texts.end() : a.texts.find(v->name);
    return it == a.texts.end() || !it->second ? e : ir::string_literal(*it->second);
  };
  const auto* assign = std::get_if<ir::Assign>(&i.statement.node);
  for (const auto& item : assign->items) {
    if (!is_text(item)) continue;
    auto text = ir::constant_text(ir::passes::map_expr(item.value, known));
    if (i.statement.line.skip_mask != 0) text.reset();
    a.texts[item.target.name] = std::move(text);
  }
}

/// The plane that the item selects.
std::optional<int> plane_in(const Item& i) {
  std::optional<int> plane;
  const auto* b = std::get_if<ir::Block>(&i.statement.node);
  for (std::size_t k = 0; b != nullptr && k < b->actions.size(); ++k) {
    const auto* set = std::get_if<ir::ModalSet>(&b->actions[k].data);
    if (set != nullptr && set->setting == ir::Setting::plane) plane = set->value;
  }
  return plane;
}

}  // namespace

Flow::Flow(const Flat& flat) : flat_(flat) {
  std::vector<int> called;
  for (std::size_t i = 0; i < flat.items.size(); ++i) {
    if (flat.items[i].kind != ItemKind::label) continue;
    if (!labels_.emplace(label_key(flat.items[i]), static_cast<int>(i)).second) doubled_.push_back(static_cast<int>(i));
  }
  for (const Item& i : flat.items) {
    const int at = i.kind == ItemKind::call ? label(i) : -1;
    if (at >= 0) called.push_back(at);
  }
  std::sort(called.begin(), called.end());
  called.erase(std::unique(called.begin(), called.end()), called.end());
  roots_.emplace_back();
  for (const int c : called) roots_.emplace_back().start = c;
  for (std::size_t r = 0; r < roots_.size(); ++r) reach(roots_[r], r != 0);
  find_sets();
  run();
}

int Flow::label(const Item& use) const {
  const auto it = labels_.find(label_key(use));
  return it == labels_.end() ? -1 : it->second;
}

std::vector<int> Flow::next(int item, bool sub) const {
  const Item& i = flat_.items[static_cast<std::size_t>(item)];
  switch (i.kind) {
    case ItemKind::end:
      if (i.statement.line.skip_mask == 0) return {};
      break;
    case ItemKind::sub_end:
      if (sub) return {};
      break;
    case ItemKind::jump:
    case ItemKind::repeat: {
      const auto* jump = std::get_if<ir::Jump>(&i.statement.node);
      const bool always = jump != nullptr && !jump->condition && i.statement.line.skip_mask == 0;
      const int to = label(i);
      std::vector<int> out;
      if (to >= 0) out.push_back(to);
      if (!always) out.push_back(item + 1);
      return out;
    }
    default: break;
  }
  return {item + 1};
}

void Flow::reach(Root& root, bool sub) const {
  const int count = static_cast<int>(flat_.items.size());
  root.reached.assign(flat_.items.size(), false);
  std::vector<int> open{root.start};
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    if (at >= count) {
      root.runs_out = true;
      continue;
    }
    if (root.reached[static_cast<std::size_t>(at)]) continue;
    root.reached[static_cast<std::size_t>(at)] = true;
    const ItemKind kind = flat_.items[static_cast<std::size_t>(at)].kind;
    if (sub && kind == ItemKind::sub_end) root.ends.push_back(at);
    if (kind == ItemKind::end) root.runs_out = true;
    for (const int n : next(at, sub)) open.push_back(n);
  }
  std::sort(root.ends.begin(), root.ends.end());
}

Arrival Flow::after(int item, Arrival a) const {
  const Item& i = flat_.items[static_cast<std::size_t>(item)];
  follow_from_pole(flat_, item, a);
  for (std::size_t k = 0; k < along_text; ++k) {
    if (i.sets[k] >= 0) a.text[k] = i.sets[k];
  }
  switch (i.kind) {
    case ItemKind::cycle:
      a.cycle = i.index;
      a.modal = 0;
      a.overlay = Arrival::none;
      a.outside = a.rewritten = false;
      return a;
    case ItemKind::pole:
      a.pole = i.index;
      a.moved = a.written = false;
      return a;
    case ItemKind::program:
      a.outside = a.outside || !i.defines_none;
      a.selected_outside = a.moved = a.written = true;
      for (auto& [name, text] : a.texts) text.reset();
      return a;
    default: break;
  }
  if (i.pattern != Arrival::none) a.pattern = i.pattern;
  if (i.tool >= 0) a.tool = i.tool;
  if (i.plunge >= 0) a.plunge = i.plunge;
  if (i.moves || i.index >= 0 || i.at_pattern) a.moved = true;
  if (i.index >= 0) a.overlay = i.index;  // 220 and 221 have heights of their own
  if (i.selects >= 0) {
    a.selected = i.selects;
    a.selected_outside = false;
  }
  if (!i.writes.empty()) {
    a.rewritten = true;
    a.written = a.written || a.pole < 0 || writes_pole(i, flat_.poles[static_cast<std::size_t>(a.pole)]);
  }
  if (sets_text(i)) follow_texts(i, a);
  if (i.call == CycleCall::modal) {
    a.modal = 1;
  } else if (i.call == CycleCall::ends || i.at_pattern || (i.call == CycleCall::once && i.moves)) {
    a.modal = 0;
  }
  if (const auto plane = plane_in(i)) a.plane = *plane;
  return a;
}

void Flow::find_sets() {
  const auto add = [](Sets& to, const Sets& from) {
    to.tool = to.tool || from.tool;
    to.plunge = to.plunge || from.plunge;
    to.plane = to.plane || from.plane;
    to.pattern = to.pattern || from.pattern;
    to.cycle = to.cycle || from.cycle;
    to.texts = to.texts || from.texts;
    for (std::size_t k = 0; k < along_text; ++k) to.text[k] = to.text[k] || from.text[k];
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (Root& root : roots_) {
      const Sets before = root.sets;
      for (std::size_t at = 0; at < flat_.items.size(); ++at) {
        if (!root.reached[at]) continue;
        const Item& i = flat_.items[at];
        Sets own{i.tool >= 0,
                 i.plunge >= 0,
                 plane_in(i).has_value(),
                 i.pattern != Arrival::none,
                 i.kind == ItemKind::cycle,
                 sets_text(i) || i.kind == ItemKind::program,
                 {}};
        for (std::size_t k = 0; k < along_text; ++k) own.text[k] = i.sets[k] >= 0;
        add(root.sets, own);
        const auto callee = i.kind == ItemKind::call ? root_of(i) : std::nullopt;
        if (callee) add(root.sets, roots_[*callee].sets);
      }
      changed = changed || !(root.sets == before);
    }
  }
}

std::optional<std::size_t> Flow::root_of(const Item& call) const {
  const int start = label(call);
  for (std::size_t r = 1; r < roots_.size() && start >= 0; ++r) {
    if (roots_[r].start == start) return r;
  }
  return std::nullopt;
}

/// What a call leaves: what its subprogram does not set is what it was.
Arrival Flow::behind_call(const Arrival& before, Arrival out, const Sets& sets) {
  if (!sets.tool) out.tool = before.tool;
  if (!sets.plunge) out.plunge = before.plunge;
  if (!sets.plane) out.plane = before.plane;
  if (!sets.pattern) out.pattern = before.pattern;
  if (!sets.cycle) out.cycle = before.cycle;
  if (!sets.texts) out.texts = before.texts;
  for (std::size_t k = 0; k < along_text; ++k) {
    if (!sets.text[k]) out.text[k] = before.text[k];
  }
  return out;
}

/// Every root by itself: what its callers bring to it, and what it leaves behind.
void Flow::run() {
  const std::size_t count = flat_.items.size();
  arrivals_.assign(count, Arrival{});
  if (count == 0) return;
  std::vector<std::vector<Arrival>> states(roots_.size(), std::vector<Arrival>(count));
  std::vector<Arrival> exits(roots_.size());
  states[0][0].reached = true;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t r = 0; r < roots_.size(); ++r) {
      for (std::size_t at = 0; at < count; ++at) {
        const Arrival& here = states[r][at];
        if (!here.reached) continue;
        const int item = static_cast<int>(at);
        const Item& i = flat_.items[at];
        Arrival out = after(item, here);
        if (i.kind == ItemKind::sub_end && r != 0) changed = narrow(exits[r], out) || changed;
        if (i.kind == ItemKind::call) {
          const auto callee = root_of(i);
          if (!callee) continue;
          Arrival enters = here;
          enters.text = out.text;  // set in lines that are no items
          changed = narrow(states[*callee][static_cast<std::size_t>(roots_[*callee].start)], enters) || changed;
          out = behind_call(enters, exits[*callee], roots_[*callee].sets);
        }
        for (const int n : next(item, r != 0)) {
          if (static_cast<std::size_t>(n) < count && narrow(states[r][static_cast<std::size_t>(n)], out))
            changed = true;
        }
      }
    }
  }
  for (const auto& s : states) {
    for (std::size_t at = 0; at < count; ++at) narrow(arrivals_[at], s[at]);
  }
}

}  // namespace cnctrans::frontends::heidenhain
