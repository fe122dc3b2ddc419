// Frames as values, base frames and settable frames that turn, for a target that has numbers only: where their parts
// are known they are said as the programmable frame, and their components as numbers. The settable shift stays in the
// target's table; base frames that only shift and the rest of the settable frame stand inside of it.
#include <algorithm>
#include <set>

#include "base/saturate.h"
#include "ir/frame_rows.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/frames/known_frame_state.h"

namespace cnctrans::ir::passes {

namespace {

class KnownFramePass {
 public:
  KnownFramePass(Program& program, const LegaliseContext& context)
      : program_(program),
        context_(context),
        facts_(program, context),
        domain_(program, context, facts_),
        states_(program, domain_) {}

  /// Everything or nothing: where one frame is not known the program stays as it is.
  void run() {
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [this](const Statement& s) { outer_frames_ = outer_frames_ || sets_outer(s); });
    }
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [this](const Statement& s) { good_ = good_ && sayable(s); });
    }
    if (!good_) return;
    for (auto& r : program_.routines) {
      rewrite_body(r.body, [this](Statement&& s, Body& out) { rewrite(std::move(s), out); });
    }
  }

 private:
  [[nodiscard]] bool selected(const Statement& s) const { return facts_.before(s).work_offset != 0; }
  [[nodiscard]] static bool selects(const Action& a) {
    const auto* w = std::get_if<WorkOffset>(&a.data);
    return w != nullptr && !w->off;
  }
  [[nodiscard]] static bool builds(const Action& a) {
    return std::holds_alternative<WorkOffset>(a.data) || std::holds_alternative<FrameOp>(a.data);
  }
  /// Base frames and settable frames.
  [[nodiscard]] static bool sets_outer(const Statement& s) {
    const auto* a = std::get_if<Assign>(&s.node);
    return a != nullptr && std::any_of(a->items.begin(), a->items.end(), [](const Assign::Item& i) {
             return i.to_system && (i.system.datum == Datum::frame_settable || i.system.datum == Datum::frame_active);
           });
  }
  /// It can be written as shift, turn, scale and mirror, in the unit in force.
  [[nodiscard]] bool writable(const PlanarFrame& f, const Statement& s) const {
    if (!f.known() || !f.angle->literal() || !f.factor->literal()) return false;
    if (!f.has_shift()) return true;
    for (const auto& a : context_.source_machine.axes) {
      if (a.diameter && a.id < PlanarFrame::axes && !f.shift[a.id]->is(0)) return false;
    }
    return std::all_of(f.shift.begin(), f.shift.end(), [](const auto& v) { return v->literal(); }) &&
           setting<Units>(facts_.before(s), Setting::units) == Units::metric;
  }

  /// What is not known before is not known to be the same behind.
  [[nodiscard]] static bool stays(const PlanarFrame& before, const PlanarFrame& after) {
    return before.known() && before == after;
  }

  [[nodiscard]] bool sayable(const Statement& s) const {
    const KnownFrames* before = states_.before(s);
    if (before == nullptr) return !speaks_of_frames(s, program_);
    if (const auto* a = std::get_if<Assign>(&s.node)) return sayable(s, *a, *before);
    bool good = true;
    each_expression(s, [&](const ExprPtr& e) { good = good && readable(e, *before); });
    const auto* b = std::get_if<Block>(&s.node);
    return good && (b == nullptr || sayable(s, *b, *before));
  }
  [[nodiscard]] bool readable(const ExprPtr& e, const KnownFrames& state) const {
    bool good = true;
    walk(e, [&](const ExprPtr& x) {
      const auto* c = std::get_if<Call>(&x->node);
      if (c != nullptr && c->function == Function::frame_part)
        good = good && constant_component(x, domain_.lookup(state)).has_value();
    });
    return good;
  }
  [[nodiscard]] bool sayable(const Statement& s, const Assign& a, KnownFrames state) const {
    for (const auto& item : a.items) {
      if (!readable(item.value, state)) return false;
      const PlanarFrame before = domain_.inner(state, selected(s));
      const bool frame = is_frame(item);
      if (frame && !constant_frame(item.value, domain_.lookup(state))) return false;
      domain_.assign(item, s, state);
      if (!frame) continue;
      if (state.lost || (item.to_system && !plain_row(item, state))) return false;
      const PlanarFrame after = domain_.inner(state, selected(s));
      if (!stays(before, after) && !writable(after, s)) return false;
    }
    return true;
  }
  [[nodiscard]] bool sayable(const Statement& s, const Block& b, KnownFrames state) const {
    if (state.lost) return !outer_frames_ || std::none_of(b.actions.begin(), b.actions.end(), builds);
    bool chosen = selected(s);
    for (const auto& a : b.actions) {
      const bool was_plain = domain_.plain(state);
      const PlanarFrame before = domain_.inner(state, chosen);
      domain_.act(a, s, b, state);
      if (std::holds_alternative<WorkOffset>(a.data)) chosen = selects(a);
      if (was_plain && domain_.plain(state)) continue;
      const PlanarFrame after = domain_.inner(state, chosen);
      if (!stays(before, after) && !writable(after, s)) return false;
    }
    return !b.has_motion || b.motion.frame == FrameUse::normal || domain_.plain(state);
  }
  [[nodiscard]] bool is_frame(const Assign::Item& item) const {
    if (item.to_system) {
      const Datum d = item.system.datum;
      return d == Datum::frame_programmed || d == Datum::frame_settable || d == Datum::frame_active ||
             d == Datum::frame_total;
    }
    return item.target.space < program_.spaces.size() && program_.spaces[item.target.space].type == Type::frame;
  }
  /// A row of the table keeps a shift that is known, or the one it has.
  [[nodiscard]] bool plain_row(const Assign::Item& item, const KnownFrames& state) const {
    const auto row = item.system.datum == Datum::frame_settable ? table_row(item.system) : std::nullopt;
    if (!row || *row >= frame_rows::first) return true;
    const auto& shift = state.row.at(*row).shift;
    const bool known = std::all_of(shift.begin(), shift.end(), [](const auto& v) { return v && v->literal(); });
    return known || keeps_shift(item);
  }
  /// frame_with(the row itself, axis, another part, value).
  [[nodiscard]] static bool keeps_shift(const Assign::Item& item) {
    const auto* c = std::get_if<Call>(&item.value->node);
    if (c == nullptr || c->function != Function::frame_with) return false;
    const auto* own = std::get_if<SystemRef>(&c->args[0]->node);
    const auto part = constant_value(c->args[2]);
    return own != nullptr && own->datum == Datum::frame_settable && table_row(*own) == table_row(item.system) && part &&
           *part > static_cast<double>(FramePart::fine);
  }

  // --- writing ----------------------------------------------------------------------------------------------------

  void rewrite(Statement&& s, Body& out) {
    const KnownFrames* before = states_.before(s);
    if (auto* d = std::get_if<Declare>(&s.node); d != nullptr && d->type == Type::frame) {
      s.node = Block{};
      settle(s);
    } else if (before == nullptr) {
    } else if (std::holds_alternative<Assign>(s.node)) {
      if (speaks_of_frames(s, program_)) return assignment(std::move(s), *before, out);
    } else {
      numbers(s, *before);
      if (std::holds_alternative<Block>(s.node)) block(s, *before);
    }
    out.push_back(std::move(s));
  }
  ExprPtr with_numbers(const ExprPtr& e, const KnownFrames& state) const {
    return map_expr(e, [&](const ExprPtr& x) {
      const auto n = constant_component(x, domain_.lookup(state));
      return n ? at(number(*n), x->pos) : x;
    });
  }
  void numbers(Statement& s, const KnownFrames& state) const {
    if (!speaks_of_frames(s, program_)) return;
    StatementVisitor visit;
    visit.expression = [&](const ExprPtr& e) { return with_numbers(e, state); };
    visit_statement(s, visit);
  }

  void assignment(Statement&& s, KnownFrames state, Body& out) {
    const Assign whole = std::get<Assign>(s.node);
    const PlanarFrame before = domain_.inner(state, selected(s));
    std::vector<Assign::Item> items;
    for (const auto& item : whole.items) {
      if (!is_frame(item)) {
        Assign::Item copy = item;
        copy.value = with_numbers(item.value, state);
        items.push_back(std::move(copy));
        domain_.assign(item, s, state);
        continue;
      }
      domain_.assign(item, s, state);
      tell(item, state, s);
      offsets(item, state, items);
    }
    const PlanarFrame after = domain_.inner(state, selected(s));
    Block said;
    if (!(before == after)) say(after, {}, said.actions);
    if (items.empty()) {
      s.node = std::move(said);
      settle(s);
      out.push_back(std::move(s));
      return;
    }
    std::get<Assign>(s.node).items = std::move(items);
    const LineInfo like = s.line;
    out.push_back(std::move(s));
    if (!said.actions.empty()) out.push_back(made(like, std::move(said)));
  }
  /// The shift of a settable frame, axis by axis, as every control has it.
  void offsets(const Assign::Item& item, const KnownFrames& state, std::vector<Assign::Item>& out) const {
    if (!item.to_system || item.system.datum != Datum::frame_settable) return;
    const auto row = table_row(item.system);
    if (!row || *row >= frame_rows::first || keeps_shift(item)) return;
    const PlanarFrame& f = state.row.at(*row);
    for (const auto& spec : context_.source_machine.axes) {
      if (spec.id >= PlanarFrame::axes) continue;
      Assign::Item one;
      one.pos = item.pos;
      one.to_system = true;
      one.system.text = item.system.text;
      one.system.datum = Datum::work_offset;
      one.system.axis = spec.id;
      one.system.args = item.system.args;
      one.value = number(f.shift[spec.id]->number);
      out.push_back(std::move(one));
    }
  }

  void block(Statement& s, KnownFrames state) {
    if (state.lost) return;
    auto& b = std::get<Block>(s.node);
    const Block whole = b;
    std::vector<Action> actions;
    bool chosen = selected(s), changed = false;
    for (const auto& a : whole.actions) {
      const bool was_plain = domain_.plain(state);
      const PlanarFrame before = domain_.inner(state, chosen);
      domain_.act(a, s, whole, state);
      const bool select = std::holds_alternative<WorkOffset>(a.data);
      if (select) chosen = selects(a);
      const bool mine = !(was_plain && domain_.plain(state)) && (select || std::holds_alternative<FrameOp>(a.data));
      if (!mine || select) actions.push_back(a);
      if (!mine) continue;
      changed = true;
      const PlanarFrame after = domain_.inner(state, chosen);
      if (!(before == after)) say(after, a.pos, actions);
    }
    if (!changed) return;
    b.actions = std::move(actions);
    settle(s);
  }

  /// The frame as statements of a chain: TRANS, AROT, ASCALE, AMIRROR.
  static void say(const PlanarFrame& f, WordPos pos, std::vector<Action>& out) {
    std::vector<FrameChange> changes;
    const auto add = [&changes](FrameKind kind) -> FrameChange& {
      FrameChange c;
      c.slot = FrameSlot::chain;
      c.kind = kind;
      c.combine = changes.empty() ? FrameCombine::replace : FrameCombine::compose;
      changes.push_back(std::move(c));
      return changes.back();
    };
    if (f.has_shift()) add(FrameKind::translate).words = f.shift_words(true);
    if (f.turns()) {
      FrameChange& c = add(FrameKind::rotate);
      c.has_angle = true;
      c.angle = *f.angle;
      c.rotation_axis = plane_axes(f.plane).w;
    }
    if (f.scales()) {
      FrameChange& c = add(FrameKind::scale);
      c.uniform_scale = true;
      c.words.push_back({axis::x, *f.factor, WordScale::radius, {}});
    }
    if (f.mirrors()) {
      FrameChange& c = add(FrameKind::mirror);
      for (AxisId a = 0; a < PlanarFrame::axes; ++a) {
        if ((*f.mirror >> a & 1U) != 0) c.words.push_back({a, Value{1.0}, WordScale::radius, {}});
      }
    }
    if (changes.empty()) add(FrameKind::translate).combine = FrameCombine::clear;
    for (auto& c : changes) {
      Action a = action(FrameOp{std::make_shared<const FrameChange>(std::move(c))});
      a.pos = pos;
      out.push_back(std::move(a));
    }
  }

  /// What the source's control keeps for the programs that follow.
  void tell(const Assign::Item& item, const KnownFrames& state, const Statement& s) {
    if (told_ || !item.to_system || item.system.datum != Datum::frame_settable) return;
    const auto row = table_row(item.system);
    if (!row || (*row < frame_rows::first && only_shifts(state.row.at(*row)))) return;
    told_ = true;
    context_.diagnostics.warning(
        "TRN-580", word_span(s.line.span, item.pos),
        "a frame that the source's control keeps for later programs is written as the programmable frame of this one "
        "(said once a program)",
        "set it in the programs that follow as well, if they count on it");
  }

  Program& program_;
  const LegaliseContext& context_;
  const FactsOf facts_;
  const KnownFrameDomain domain_;
  const FlowStates<KnownFrameDomain> states_;
  bool good_ = true, told_ = false;
  bool outer_frames_ = false;
};

bool uses_frame_values(const Program& program) {
  bool any = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* d = std::get_if<Declare>(&s.node);
      any = any || speaks_of_frames(s, program) || (d != nullptr && d->type == Type::frame);
    });
  }
  return any;
}

/// One variable of frames has one name: none of two routines, none that is handed over.
bool names_tell(const Program& program) {
  if (CallGraph(program).recursion() != nullptr) return false;
  std::set<std::string> declared;
  bool good = true;
  for (const auto& r : program.routines) {
    for (const auto& p : r.parameters) good = good && p.type != Type::frame;
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* d = std::get_if<Declare>(&s.node);
      if (d == nullptr || d->type != Type::frame) return;
      for (const auto& item : d->items) good = declared.insert(item.name).second && good;
    });
  }
  return good;
}

}  // namespace

void say_known_frames(Program& program, const LegaliseContext& context) {
  const auto frames = [](const VariableSpace& s) { return s.type == Type::frame; };
  if (program.dialect == context.target.dialect ||
      std::any_of(context.target.spaces.begin(), context.target.spaces.end(), frames))
    return;
  if (!uses_frame_values(program) || !names_tell(program)) return;
  number_statements(program);
  KnownFramePass(program, context).run();
}

}  // namespace cnctrans::ir::passes
