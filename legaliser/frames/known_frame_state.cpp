#include "legaliser/frames/known_frame_state.h"

#include <algorithm>

#include "base/saturate.h"
#include "ir/frame_rows.h"

namespace cnctrans::ir::passes {

namespace rows = frame_rows;

namespace {

bool is_frame_datum(Datum d) {
  return d == Datum::frame_programmed || d == Datum::frame_settable || d == Datum::frame_active ||
         d == Datum::frame_total;
}
bool in_range(std::int32_t row, std::int32_t first, std::int32_t behind) {
  return row >= first && row < behind;
}

}  // namespace

PlanarFrame unknown_frame() {
  PlanarFrame f;
  f.foreign = true;
  return f;
}

std::optional<std::int32_t> table_row(const SystemRef& ref) {
  const auto n = ref.args.size() == 1 ? constant_value(ref.args[0]) : std::nullopt;
  if (!n) return std::nullopt;
  return saturate<std::int32_t>(*n);
}

bool speaks_of_frames(const Statement& s, const Program& program) {
  const auto of_frames = [&program](const VarRef& v) {
    return v.space < program.spaces.size() && program.spaces[v.space].type == Type::frame;
  };
  bool found = false;
  each_expression(s, [&](const ExprPtr& e) {
    walk(e, [&](const ExprPtr& x) {
      const auto* c = std::get_if<Call>(&x->node);
      found = found || x->type == Type::frame || (c != nullptr && c->function == Function::frame_part);
    });
  });
  each_target(s, [&](const VarRef& v) { found = found || of_frames(v); });
  if (const auto* a = std::get_if<Assign>(&s.node)) {
    for (const auto& i : a->items) found = found || (i.to_system && is_frame_datum(i.system.datum));
  }
  return found;
}

std::string KnownFrameDomain::name_of(const VarRef& v) const {
  if (v.space >= program_.spaces.size() || program_.spaces[v.space].type != Type::frame || v.name.empty()) return {};
  std::string name = std::to_string(v.space) + "." + v.name;
  for (const auto& i : v.indices) {
    const auto n = constant_value(i);
    if (!n) return {};
    name += "," + std::to_string(saturate<std::int32_t>(*n));
  }
  return name;
}

KnownFrames KnownFrameDomain::start(const Routine& r, bool /*called*/) const {
  State state;
  state.lost = r.kind != RoutineKind::main;
  return state;
}

bool KnownFrameDomain::touches(const Routine& r) const {
  bool found = false;
  for_each_statement(r.body, [&](const Statement& s) {
    const auto* o = std::get_if<Opaque>(&s.node);
    const auto* d = std::get_if<Declare>(&s.node);
    found = found || speaks_of_frames(s, program_) || (o != nullptr && !o->harmless) ||
            (d != nullptr && d->type == Type::frame);
    if (const auto* a = std::get_if<Assign>(&s.node)) {
      for (const auto& i : a->items) found = found || (i.to_system && i.system.datum == Datum::work_offset);
    }
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) return;
    for (const auto& a : b->actions)
      found = found || std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data);
  });
  return found;
}

bool KnownFrameDomain::join(State& a, const State& b) const {
  const State before = a;
  a.lost = a.lost || b.lost;
  if (a.lost) return !before.lost;
  std::erase_if(a.variable, [&b](const auto& v) { return b.variable.count(v.first) == 0; });
  for (auto& [name, frame] : a.variable) frame.join(b.variable.at(name));
  for (const auto& [row, frame] : b.row) a.row.try_emplace(row, row_of(before, row));
  for (auto& [row, frame] : a.row) frame.join(row_of(b, row));
  a.shape.join(b.shape);
  a.programmed.join(b.programmed);
  return !(a == before);
}

/// Settable frames start with shifts that the operator has set; base frames start neutral.
PlanarFrame KnownFrameDomain::row_of(const State& state, std::int32_t row) const {
  const auto it = state.row.find(row);
  if (it != state.row.end()) return it->second;
  PlanarFrame f;
  if (row < rows::first) {
    for (auto& v : f.shift) v.reset();
  }
  return f;
}

PlanarFrame KnownFrameDomain::base(const State& state, std::int32_t from) const {
  PlanarFrame f;
  for (auto it = state.row.lower_bound(rows::active_base + from); it != state.row.end() && it->first < rows::neutral;
       ++it)
    f = compose(f, it->second);
  return f;
}

PlanarFrame KnownFrameDomain::inner(const State& state, bool selected) const {
  if (state.lost) return unknown_frame();
  const PlanarFrame outer = base(state);
  if (selected && !only_shifts(outer)) return unknown_frame();  // it turns the settable shift
  return compose(compose(outer, state.shape), state.programmed.whole(machine_));
}

bool KnownFrameDomain::plain(const State& state) const {
  return !state.lost && base(state).neutral() && state.shape.neutral();
}

FrameLookup KnownFrameDomain::lookup(const State& state) const {
  return [this, &state](const Expr& e) -> std::optional<PlanarFrame> {
    if (state.lost) return std::nullopt;
    std::optional<PlanarFrame> f;
    if (const auto* v = std::get_if<VarRef>(&e.node)) {
      const auto it = state.variable.find(name_of(*v));
      if (it != state.variable.end()) f = it->second;
    } else if (const auto* ref = std::get_if<SystemRef>(&e.node)) {
      const auto row = table_row(*ref);
      if (ref->datum == Datum::frame_programmed)
        f = state.programmed.whole(machine_);
      else if (ref->datum == Datum::frame_settable && row == rows::total_base)
        f = base(state, rows::own_base);
      else if (ref->datum == Datum::frame_settable && row)
        f = row_of(state, *row);
    }
    return f && f->foreign ? std::nullopt : f;
  };
}

void KnownFrameDomain::select(const WorkOffset& w, State& state) const {
  if (!w.off && !w.index.literal()) {
    state.lost = true;
    return;
  }
  const std::int32_t row = w.off ? 0 : saturate<std::int32_t>(w.index.number);
  state.shape = row == 0 ? PlanarFrame{} : row_of(state, row);
  state.shape.shift = PlanarFrame{}.shift;
  const auto stored = state.row;
  for (const auto& [at, frame] : stored) {
    if (in_range(at, rows::stored_base, rows::active_base))
      state.row[at - rows::stored_base + rows::active_base] = frame;
  }
}

void KnownFrameDomain::assign_system(const SystemRef& ref, const std::optional<PlanarFrame>& value, const Statement& s,
                                     State& state) const {
  const PlanarFrame f = value.value_or(unknown_frame());
  switch (ref.datum) {
    case Datum::frame_programmed:
      state.programmed = FrameState{};
      state.programmed.put(FrameSlot::chain, f);
      return;
    case Datum::frame_active:  // the settable shift in force goes: known where none is
      if (facts_.before(s).work_offset == 0)
        state.shape = f;
      else
        state.lost = true;
      return;
    case Datum::frame_settable: {
      const auto row = table_row(ref);
      if (row && *row < rows::neutral)
        state.row[*row] = f;
      else
        state.lost = true;
      return;
    }
    default: state.lost = true;
  }
}

void KnownFrameDomain::assign(const Assign::Item& item, const Statement& s, State& state) const {
  if (state.lost) return;
  if (item.to_system) {
    if (is_frame_datum(item.system.datum)) {
      assign_system(item.system, constant_frame(item.value, lookup(state)), s, state);
    } else if (item.system.datum == Datum::work_offset && item.system.axis < PlanarFrame::axes) {
      const auto row = table_row(item.system);
      if (!row) return;
      PlanarFrame f = row_of(state, *row);
      const auto value = constant_value(item.value);
      f.shift[item.system.axis] = value ? std::optional(Value{*value}) : std::nullopt;
      state.row[*row] = f;
    }
    return;
  }
  state.programmed.forget(item.target);
  const std::string name = name_of(item.target);
  if (name.empty()) {
    const auto space = item.target.space;
    if (space < program_.spaces.size() && program_.spaces[space].type == Type::frame) state.variable.clear();
    return;
  }
  const auto value = constant_frame(item.value, lookup(state));
  if (value)
    state.variable[name] = *value;
  else
    state.variable.erase(name);
}

void KnownFrameDomain::act(const Action& a, const Statement& s, const Block& b, State& state) const {
  if (state.lost) return;
  if (const auto* w = std::get_if<WorkOffset>(&a.data)) {
    select(*w, state);
    state.programmed.select(*w, machine_);
  } else if (const auto* f = std::get_if<FrameOp>(&a.data); f != nullptr && f->change) {
    state.programmed.apply(*f->change, facts_.before(s), b, machine_);
  }
}

void KnownFrameDomain::transfer(const Statement& s, State& state) const {
  if (state.lost) return;
  if (const auto* d = std::get_if<Declare>(&s.node)) {
    if (d->type != Type::frame) return;
    for (const auto& item : d->items) {
      VarRef v;
      v.space = d->space;
      v.name = item.name;
      if (item.dimensions.empty() && item.initial.empty()) state.variable[name_of(v)] = PlanarFrame{};
    }
  } else if (const auto* a = std::get_if<Assign>(&s.node)) {
    for (const auto& item : a->items) assign(item, s, state);
  } else if (const auto* b = std::get_if<Block>(&s.node)) {
    for (const auto& action : b->actions) act(action, s, *b, state);
    state.programmed.follow_units(*b, facts_.before(s), machine_);
  } else if (const auto* o = std::get_if<Opaque>(&s.node)) {
    state.lost = !o->harmless;
  } else {
    each_target(s, [&state](const VarRef& v) { state.programmed.forget(v); });
  }
}

}  // namespace cnctrans::ir::passes
