#include "legaliser/frames/frame_variables.h"

#include <algorithm>
#include <map>

#include "ir/analysis/call_graph.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/frames/frame_state.h"

namespace cnctrans::ir::passes {

namespace {

/// One number of one slot: the shift of an axis, or the angle.
struct Part {
  FrameSlot slot = FrameSlot::chain;
  std::size_t axis = 0;
  bool angle = false;
  bool operator<(const Part& o) const { return std::tie(slot, angle, axis) < std::tie(o.slot, o.angle, o.axis); }
};

std::optional<Value>& value_of(PlanarFrame& f, const Part& p) {
  return p.angle ? f.angle : f.shift[p.axis];
}

const FrameChange* only_change(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  const FrameChange* found = nullptr;
  if (b == nullptr) return nullptr;
  for (const auto& a : b->actions) {
    const auto* f = std::get_if<FrameOp>(&a.data);
    if (f == nullptr || !f->change) continue;
    if (found != nullptr) return nullptr;
    found = f->change.get();
  }
  return found;
}

bool has_change(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
           const auto* f = std::get_if<FrameOp>(&a.data);
           return f != nullptr && f->change;
         });
}

std::shared_ptr<FrameChange> change_of(FrameSlot slot, FrameKind kind, FrameCombine combine) {
  auto change = std::make_shared<FrameChange>();
  change->slot = slot;
  change->kind = kind;
  change->combine = combine;
  return change;
}

class FrameVariables {
 public:
  FrameVariables(Program& program, const LegaliseContext& context, const std::set<std::uint32_t>& lost)
      : program_(program),
        context_(context),
        machine_(context.source_machine),
        lost_(lost),
        facts_(program, context),
        states_(program, facts_, context) {}

  void run() {
    if (!followed() || !find_parts()) return;
    plan();
    if (!allocate()) return;
    for (auto& r : program_.routines) write(r);
    tell();
  }

 private:
  /// All that the program does to the frame stands in the program, in one unit.
  bool followed() const {
    if (std::none_of(program_.routines.begin(), program_.routines.end(),
                     [](const Routine& r) { return r.kind == RoutineKind::main; }))
      return false;
    bool good = true;
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        const auto* repeat = std::get_if<Repeat>(&s.node);
        const auto* call = std::get_if<CallRoutine>(&s.node);
        const auto* kept = std::get_if<Opaque>(&s.node);
        if (std::holds_alternative<ModalCall>(s.node) || (kept != nullptr && !kept->harmless)) good = false;
        if (repeat != nullptr && (repeat->has_program || repeat->first.computed || repeat->last.computed)) good = false;
        if (call != nullptr && (call->computed || call->has_range || program_.find(call->routine) == nullptr))
          good = false;
        if (const auto* b = std::get_if<Block>(&s.node)) good = good && one_unit(s, *b);
      });
    }
    return good;
  }
  bool one_unit(const Statement& s, const Block& b) const {
    return std::none_of(b.actions.begin(), b.actions.end(), [&](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      if (m == nullptr || (m->setting != Setting::units && m->setting != Setting::diameter)) return false;
      const auto before = facts_.before(s).settings[static_cast<std::size_t>(m->setting)];
      return !(before && *before == m->value) && !states_.before(s).neutral();
    });
  }

  /// What is not known at the statements that are lost. False: something among it can't be a number in a variable.
  bool find_parts() {
    bool good = true;
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        if (lost_.count(s.id) == 0) return;
        const FrameChange* c = only_change(s);
        const FrameState state = states_.before(s);
        good = good && c != nullptr && s.line.skip_mask == 0 && c->combine != FrameCombine::preset &&
               c->slot != FrameSlot::preset && (c->kind == FrameKind::translate || c->kind == FrameKind::rotate);
        const bool about_centre = c != nullptr && c->kind == FrameKind::rotate && !c->words.empty();
        for (const auto slot : machine_.frame_order) {
          const PlanarFrame f = state.slot(slot);
          const bool centre = slot == FrameSlot::rotation && (f.has_shift() || (about_centre && c->slot == slot));
          if (f.foreign || !f.factor || !f.mirror || centre) good = false;
        }
        add_unknown(state);
      });
    }
    return good && !variables_.empty() && close();
  }
  /// What else the new values depend on, where a statement changes one of the parts.
  bool close() {
    bool good = true;
    for (bool more = true; more && good;) {
      more = false;
      for (const auto& r : program_.routines) {
        for_each_statement(r.body, [&](const Statement& s) {
          if (!has_change(s) || !good) return;
          const FrameChange* c = only_change(s);
          if (c == nullptr) good = false;
          if (c == nullptr) return;
          const FrameState before = said(s);
          FrameState after = before;
          after.apply(*c, facts_.before(s), std::get<Block>(s.node), machine_);
          for (const auto& v : std::map(variables_)) {
            PlanarFrame to = after.slot(v.first.slot);
            if (to.foreign) good = false;
            if (value_of(to, v.first)) continue;
            const std::size_t known = variables_.size();
            add_unknown(before);
            if (variables_.size() == known) good = false;
            more = true;
          }
        });
      }
    }
    return good;
  }
  void add_unknown(const FrameState& state) {
    for (const auto slot : machine_.frame_order) {
      const PlanarFrame f = state.slot(slot);
      if (!f.angle) add({slot, 0, true});
      for (std::size_t i = 0; i < PlanarFrame::axes; ++i) {
        if (!f.shift[i]) add({slot, i, false});
      }
    }
  }
  void add(const Part& p) { variables_.emplace(p, VarRef{}); }

  /// The state before the statement with the variables in the place of what is not known.
  [[nodiscard]] FrameState said(const Statement& s) const {
    FrameState state = states_.before(s);
    for (const auto& [part, variable] : variables_) {
      PlanarFrame f = state.slot(part.slot);
      auto& value = value_of(f, part);
      if (value) continue;
      value = Value{ir::variable(variable)};
      state.put(part.slot, f);
    }
    return state;
  }

  // ---- which values are read again

  struct Effect {
    bool reads = false, writes = false;
  };
  /// What the statement does to the variable of a part.
  [[nodiscard]] Effect effect(const Statement& s, const Part& p) const {
    const FrameChange* c = only_change(s);
    if (c == nullptr) return {has_change(s), false};
    const FrameState before = states_.before(s);
    FrameState after = before;
    after.apply(*c, facts_.before(s), std::get<Block>(s.node), machine_);
    PlanarFrame from = before.slot(p.slot), to = after.slot(p.slot);
    const auto &a = value_of(from, p), &b = value_of(to, p);
    if (lost_.count(s.id) != 0) return {true, true};
    if (!b) return {!a || states_unknown(s), true};
    return {false, !a || !equal(*a, *b)};
  }
  [[nodiscard]] bool states_unknown(const Statement& s) const {
    const FrameState state = states_.before(s);
    return std::any_of(variables_.begin(), variables_.end(), [&state](const auto& v) {
      PlanarFrame f = state.slot(v.first.slot);
      return !value_of(f, v.first);
    });
  }

  /// Looks before anything is changed.
  void plan() {
    for (const auto& r : program_.routines) flows_.push_back(control_flow(program_, r));
    for (std::size_t i = 0; i < program_.routines.size(); ++i) {
      const Routine& r = program_.routines[i];
      for (const auto& v : variables_) {
        if (r.kind == RoutineKind::main && read_behind(i, 0, v.first)) at_start_.insert(v.first);
        for_each_statement(r.body, [&](const Statement& s) {
          if (has_change(s) && (lost_.count(s.id) != 0 || read_behind(i, s.id, v.first)))
            needed_.emplace(s.id, v.first);
        });
      }
    }
    flows_.clear();
  }
  [[nodiscard]] bool uses_it(std::size_t routine, const Part& p) const {
    bool found = false;
    for_each_statement(program_.routines[routine].body, [&](const Statement& s) {
      if (!has_change(s)) return;
      const Effect e = effect(s, p);
      found = found || e.reads || e.writes;
    });
    return found;
  }
  /// A value that the variable has behind statement `from` (0: at the start of the routine) is read before it changes.
  [[nodiscard]] bool read_behind(std::size_t routine, std::uint32_t from, const Part& p) const {
    const ControlFlow& flow = flows_[routine];
    std::set<std::uint32_t> seen;
    std::vector<std::uint32_t> open;
    const auto visit = [&](std::uint32_t id) {
      if (seen.insert(id).second) open.push_back(id);
    };
    const Body& body = program_.routines[routine].body;
    if (from == 0 && !body.empty()) visit(body.front().id);
    if (from != 0) {
      for (const auto id : flow.successors[from]) visit(id);
    }
    while (!open.empty()) {
      const auto id = open.back();
      open.pop_back();
      if (id == 0) {  // the end of a subprogram: its callers go on
        if (program_.routines[routine].kind != RoutineKind::main && others_use(routine, p)) return true;
        continue;
      }
      const Statement* s = flow.statements[id];
      if (s == nullptr) continue;
      if (const auto* call = std::get_if<CallRoutine>(&s->node)) {
        const Routine* callee = program_.find(call->routine);
        if (callee != nullptr && reaches_use(static_cast<std::size_t>(callee - program_.routines.data()), p))
          return true;
      }
      if (has_change(*s)) {
        const Effect e = effect(*s, p);
        if (e.reads) return true;
        if (e.writes && s->line.skip_mask == 0) continue;
      }
      for (const auto next : flow.successors[id]) visit(next);
    }
    return false;
  }
  [[nodiscard]] bool others_use(std::size_t routine, const Part& p) const {
    for (std::size_t i = 0; i < program_.routines.size(); ++i) {
      if (i != routine && uses_it(i, p)) return true;
    }
    return uses_it(routine, p);
  }
  [[nodiscard]] bool reaches_use(std::size_t routine, const Part& p) const {
    std::set<std::size_t> seen{routine};
    std::vector<std::size_t> open{routine};
    const CallGraph calls(program_);
    while (!open.empty()) {
      const auto i = open.back();
      open.pop_back();
      if (uses_it(i, p)) return true;
      for (const auto& site : calls.sites()) {
        if (site.caller == i && site.callee && seen.insert(*site.callee).second) open.push_back(*site.callee);
      }
    }
    return false;
  }

  // ---- writing

  /// Variables, and their values at the start of the program.
  bool allocate() {
    const auto main = std::find_if(program_.routines.begin(), program_.routines.end(),
                                   [](const Routine& r) { return r.kind == RoutineKind::main; });
    const auto index = static_cast<std::size_t>(main - program_.routines.begin());
    if (context_.target.declares_variables && one_routine() != index) return false;  // its own are local
    Editor editor(program_, *main, context_);
    LineInfo where;
    for (auto& [part, variable] : variables_) {
      const auto taken = editor.take(where);
      if (!taken) return false;
      variable = *taken;
    }
    const auto place = behind_straight_head(*main);
    Body first;
    LineInfo like;
    if (place != main->body.end()) like.span = place->line.span;
    for (const auto& p : at_start_) first.push_back(make_assign(like, variables_.at(p), number(0)));
    main->body.insert(place, std::make_move_iterator(first.begin()), std::make_move_iterator(first.end()));
    return true;
  }
  /// In front of the first statement of the main program that branches, calls, is led to or changes the frame.
  Body::iterator behind_straight_head(Routine& main) const {
    const LabelUses uses = label_uses(program_, main);
    return std::find_if(below_head(main.body), main.body.end(), [&](const Statement& s) {
      const auto labels = labels_on(s.line);
      const bool led_to = std::any_of(labels.begin(), labels.end(),
                                      [&uses](const LabelRef& l) { return uses.is_target(l) || uses.is_end(l); });
      const bool straight = std::holds_alternative<Block>(s.node) || std::holds_alternative<Assign>(s.node) ||
                            std::holds_alternative<Message>(s.node);
      const bool touches = has_change(s) && std::any_of(variables_.begin(), variables_.end(), [&](const auto& v) {
                             const Effect e = effect(s, v.first);
                             return e.reads || e.writes;
                           });
      return led_to || !straight || touches;
    });
  }
  /// The routine that alone changes the frame; else the number of routines.
  [[nodiscard]] std::size_t one_routine() const {
    std::size_t found = program_.routines.size();
    for (std::size_t i = 0; i < program_.routines.size(); ++i) {
      bool changes = false;
      for_each_statement(program_.routines[i].body, [&](const Statement& s) { changes = changes || has_change(s); });
      if (!changes) continue;
      if (found != program_.routines.size()) return program_.routines.size();
      found = i;
    }
    return found;
  }

  void write(Routine& r) {
    Editor editor(program_, r, context_);
    rewrite_body(r.body, [&](Statement&& s, Body& out) {
      const FrameChange* c = only_change(s);
      if (c == nullptr || s.id == 0) {
        out.push_back(std::move(s));
        return;
      }
      const FrameState before = said(s);
      FrameState after = before;
      after.apply(*c, facts_.before(s), std::get<Block>(s.node), machine_);
      Body first;
      assign(editor, s, before, after, first);
      if (lost_.count(s.id) != 0 && after.slot(c->slot).known()) {  // of a part of a shift nobody knows the whole
        set_frame(s, *c, states_.before(s), after, first);
        if (!where_) where_ = s.line.span;
      }
      editor.put(out, std::move(first), std::move(s));
    });
  }

  /// The new values of the variables. One that reads a variable which is written before it goes through a temporary.
  void assign(Editor& editor, const Statement& s, const FrameState& before, FrameState& after, Body& out) {
    std::vector<std::pair<VarRef, ExprPtr>> list;
    for (const auto& [part, variable] : variables_) {
      PlanarFrame from = before.slot(part.slot), to = after.slot(part.slot);
      const auto &a = value_of(from, part), &b = value_of(to, part);
      if (!b || (a && equal(*a, *b))) continue;
      if (needed_.count({s.id, part}) != 0) list.emplace_back(variable, as_expr(*b));
      if (lost_.count(s.id) == 0) continue;
      value_of(to, part) = Value{ir::variable(variable)};
      after.put(part.slot, to);
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      const bool read_later = std::any_of(list.begin() + static_cast<std::ptrdiff_t>(i) + 1, list.end(),
                                          [&](const auto& l) { return reads(l.second, list[i].first); });
      if (!read_later) continue;
      const auto old = editor.take(s.line);
      if (!old) continue;
      out.push_back(make_assign(s.line, *old, ir::variable(list[i].first)));
      for (std::size_t k = i + 1; k < list.size(); ++k) {
        list[k].second = map_expr(list[k].second, [&](const ExprPtr& e) {
          const auto* v = as_variable(e);
          return v != nullptr && same_variable(*v, list[i].first) ? ir::variable(*old) : e;
        });
      }
    }
    for (auto& l : list) out.push_back(make_assign(s.line, l.first, l.second));
  }

  /// The statement's change becomes the whole slot as it is behind it; blocks before it say the other slots that are
  /// not known.
  void set_frame(Statement& s, const FrameChange& c, const FrameState& before, const FrameState& after,
                 Body& first) const {
    auto& b = std::get<Block>(s.node);
    std::vector<Action> own;
    for (const auto slot : machine_.frame_order) {
      const PlanarFrame was = before.slot(slot);
      std::vector<Action> made;
      std::vector<FrameWord> words;
      for (std::size_t i = 0; i < PlanarFrame::axes; ++i) {
        const bool named = slot == c.slot && c.kind == FrameKind::translate &&
                           std::any_of(c.words.begin(), c.words.end(), [i](const auto& w) { return w.axis == i; });
        const PlanarFrame now = after.slot(slot);  // a clear names none and changes all
        const bool other = was.shift[i] && now.shift[i] && !equal(*was.shift[i], *now.shift[i]);
        if (!was.shift[i] || named || other) words.push_back(now.word(i));
      }
      if (slot == FrameSlot::chain && (slot == c.slot || !was.known())) {
        put_chain(after.slot(slot), made);
      } else if (slot == FrameSlot::rotation && (!was.angle || (slot == c.slot && c.kind == FrameKind::rotate))) {
        put_turn(after.slot(slot), slot, FrameCombine::replace, made);
      } else if (slot == FrameSlot::shift && !words.empty()) {
        auto change = change_of(slot, FrameKind::translate, FrameCombine::replace_named);
        change->words = std::move(words);
        made.push_back(action(FrameOp{std::move(change)}));
      }
      for (auto& a : made) {
        if (slot == c.slot)
          own.push_back(std::move(a));
        else
          first.push_back(make_block(s.line, std::move(a)));
      }
    }
    const auto at = std::find_if(b.actions.begin(), b.actions.end(),
                                 [](const Action& a) { return std::holds_alternative<FrameOp>(a.data); });
    const auto place = b.actions.erase(at);
    b.actions.insert(place, std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
    settle(s);
  }

  static void put_turn(const PlanarFrame& f, FrameSlot slot, FrameCombine combine, std::vector<Action>& made) {
    auto change = change_of(slot, FrameKind::rotate, combine);
    change->has_angle = true;
    change->angle = *f.angle;
    change->rotation_axis = plane_axes(f.plane).w;
    made.push_back(action(FrameOp{std::move(change)}));
  }
  static void put_chain(const PlanarFrame& f, std::vector<Action>& made) {
    const auto next = [&made] { return made.empty() ? FrameCombine::replace : FrameCombine::compose; };
    if (f.has_shift()) {
      auto change = change_of(FrameSlot::chain, FrameKind::translate, next());
      change->words = f.shift_words(true);
      made.push_back(action(FrameOp{std::move(change)}));
    }
    if (f.turns()) put_turn(f, FrameSlot::chain, next(), made);
    if (f.scales()) {
      auto change = change_of(FrameSlot::chain, FrameKind::scale, next());
      change->uniform_scale = true;
      change->words.push_back({axis::x, *f.factor, WordScale::radius, {}});
      made.push_back(action(FrameOp{std::move(change)}));
    }
    if (f.mirrors()) {
      auto change = change_of(FrameSlot::chain, FrameKind::mirror, next());
      for (AxisId a = 0; a < PlanarFrame::axes; ++a) {
        if ((*f.mirror >> a & 1U) != 0) change->words.push_back({a, Value{1.0}, WordScale::modal, {}});
      }
      made.push_back(action(FrameOp{std::move(change)}));
    }
  }

  void tell() const {
    std::string list;
    for (const auto& [part, variable] : variables_) {
      if (!list.empty()) list += ", ";
      list += variable_text(variable, program_) + " (" +
              (part.angle ? std::string("rotation")
                          : "shift " + std::string(program_.axis_name(static_cast<AxisId>(part.axis)))) +
              ")";
    }
    context_.diagnostics.note(
        "TRN-490", where_.value_or(Span{}),
        "what the programmable frame holds here depends on the path that leads here: it is kept in " + list);
  }

  Program& program_;
  const LegaliseContext& context_;
  const machine::Profile& machine_;
  const std::set<std::uint32_t>& lost_;
  const FactsOf facts_;
  const FrameStates states_;
  std::map<Part, VarRef> variables_;
  std::vector<ControlFlow> flows_;
  std::set<Part> at_start_;                          ///< read before anything sets them
  std::set<std::pair<std::uint32_t, Part>> needed_;  ///< read behind the statement
  std::optional<Span> where_;
};

}  // namespace

void keep_frames_in_variables(Program& program, const LegaliseContext& context, const std::set<std::uint32_t>& lost) {
  FrameVariables(program, context, lost).run();
}

}  // namespace cnctrans::ir::passes
