// Variables of texts and axes, for a target that has numbers only: where the value is known from the program it stands
// in the place of the variable, and what is computed from it is written as its result.
#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "ir/analysis/flow_states.h"
#include "ir/edit/file_line.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/expressions/fold_texts.h"

namespace cnctrans::ir::passes {

namespace {

/// A literal text or axis.
bool is_literal(const ExprPtr& e) {
  return e && (std::holds_alternative<String>(e->node) || std::holds_alternative<AxisName>(e->node));
}

/// A domain of FlowStates: variable -> the literal that it holds. Numbers are followed as well, for texts that show
/// them.
class KnownLiterals {
 public:
  using Values = std::map<std::string, ExprPtr>;
  /// Shared by the statements that change nothing.
  class State {
   public:
    [[nodiscard]] const Values& get() const { return *values_; }
    Values& own() {
      if (values_.use_count() > 1) values_ = std::make_shared<Values>(*values_);
      return *values_;
    }
    [[nodiscard]] bool same(const State& other) const { return values_ == other.values_; }

   private:
    std::shared_ptr<Values> values_ = std::make_shared<Values>();
  };

  KnownLiterals(const Program& program, const LegaliseContext& context) : program_(program), context_(context) {
    for (std::size_t r = 0; r < program.routines.size(); ++r) {
      for (const auto& p : program.routines[r].parameters) handed_over_.insert(name_in(p.variable, r));
      for_each_statement(program.routines[r].body, [&](const Statement& s) {
        routine_of_[s.id] = r;
        const auto* c = std::get_if<CallRoutine>(&s.node);
        const auto* m = std::get_if<ModalCall>(&s.node);
        if (c == nullptr && m == nullptr) return;
        for (const auto& a : c != nullptr ? c->arguments : m->call.arguments) {
          if (a.by_reference) handed_over_.insert(name_of(a.reference, s));
        }
      });
    }
  }

  static State start(const Routine& /*r*/, bool /*called*/) { return {}; }
  static bool touches(const Routine& r) {
    bool found = false;
    for_each_statement(r.body, [&found](const Statement& s) {
      found = found || std::holds_alternative<Assign>(s.node) || std::holds_alternative<For>(s.node) ||
              std::holds_alternative<Declare>(s.node) || std::holds_alternative<Opaque>(s.node);
    });
    return found;
  }
  /// Variables that other routines can change as well are forgotten.
  static void unknown(State& state) {
    std::erase_if(state.own(), [](const auto& entry) { return entry.first.find('*') != std::string::npos; });
  }
  static bool join(State& a, const State& b) {
    const auto lost = [&b](const auto& entry) {
      const auto it = b.get().find(entry.first);
      return it == b.get().end() || !equal(it->second, entry.second);
    };
    if (a.same(b) || std::none_of(a.get().begin(), a.get().end(), lost)) return false;
    std::erase_if(a.own(), lost);
    return true;
  }
  void transfer(const Statement& s, State& state) const {
    if (const auto* a = std::get_if<Assign>(&s.node)) {
      for (const auto& item : a->items) write(item, with_known_texts(item.value, values(s, state)), s, state);
    } else if (const auto* d = std::get_if<Declare>(&s.node)) {
      for (const auto& item : d->items) {
        const ExprPtr first = item.initial.empty() ? nullptr : item.initial.front();
        define(*d, item, first ? with_known_texts(first, values(s, state)) : nullptr, s, state);
      }
    } else if (const auto* o = std::get_if<Opaque>(&s.node)) {
      if (!o->harmless) state = {};
    } else {
      each_target(s, [&](const VarRef& v) { forget(v, s, state); });
    }
  }

  // Steps of a transfer.
  void write(const Assign::Item& item, const ExprPtr& value, const Statement& s, State& state) const {
    if (item.to_system) return;
    forget(item.target, s, state);
    set(item.target, value, s, state);
  }
  void define(const Declare& d, const Declare::Item& item, const ExprPtr& first, const Statement& s,
              State& state) const {
    VarRef v;
    v.space = d.space;
    v.name = item.name;
    forget(v, s, state);
    if (item.dimensions.empty()) set(v, d.type == Type::string && !first ? string_literal({}) : first, s, state);
  }
  [[nodiscard]] KnownValues values(const Statement& s, const State& state) const {
    KnownValues known;
    const bool shows = std::holds_alternative<Message>(s.node) && context_.target.message_values;
    known.variable = [this, &s, &state, shows](const VarRef& v) -> ExprPtr {
      const auto it = state.get().find(name_of(v, s));
      return it == state.get().end() || (shows && as_number(it->second) != nullptr) ? nullptr : it->second;
    };
    known.axis_name = [this](AxisId a) {
      const auto* spec = context_.source_machine.axis(a);
      return spec != nullptr ? spec->name : std::string();
    };
    return known;
  }
  /// Of a single variable; empty for an element of an array and for one that is computed. With `*` where other routines
  /// see it too.
  [[nodiscard]] std::string name_of(const VarRef& v, const Statement& s) const {
    const auto at = routine_of_.find(s.id);
    return name_in(v, at == routine_of_.end() ? 0 : at->second);
  }
  /// The variable has a text or an axis for its value.
  [[nodiscard]] bool holds_no_number(const VarRef& v) const {
    if (v.space >= program_.spaces.size()) return false;
    const Type t = program_.spaces[v.space].type;
    return t == Type::string || t == Type::axis;
  }

 private:
  [[nodiscard]] std::string name_in(const VarRef& v, std::size_t routine) const {
    if (v.space >= program_.spaces.size() || !v.indices.empty()) return {};
    const auto& space = program_.spaces[v.space];
    const auto n = v.index ? constant_index(v) : std::nullopt;
    if (space.type == Type::frame || (v.index && !n)) return {};
    std::string name = std::to_string(v.space) + ":";
    name += space.scope != Scope::routine ? "*" : std::to_string(routine) + ".";
    return name + (n ? std::to_string(*n) : v.name);
  }
  void forget(const VarRef& v, const Statement& s, State& state) const {
    if (const std::string name = name_of(v, s); state.get().count(name) != 0) state.own().erase(name);
    if (!v.index || constant_index(v)) return;
    const std::string prefix = std::to_string(v.space) + ":";
    std::erase_if(state.own(), [&prefix](const auto& entry) { return entry.first.starts_with(prefix); });
  }
  void set(const VarRef& v, const ExprPtr& value, const Statement& s, State& state) const {
    const std::string name = name_of(v, s);
    if (name.empty() || !value || s.line.skip_mask != 0 || handed_over_.count(name) != 0) return;
    if (holds_no_number(v)) {
      if (is_literal(value)) state.own()[name] = value;
    } else if (const auto n = constant_value(value); n && value->type != Type::string) {
      state.own()[name] = number(*n);
    }
  }

  const Program& program_;
  const LegaliseContext& context_;
  std::map<std::uint32_t, std::size_t> routine_of_;
  std::set<std::string> handed_over_;  ///< what calls set, and what callees write under another name
};

class KnownTexts {
 public:
  KnownTexts(Program& program, const LegaliseContext& context)
      : program_(program), context_(context), domain_(program, context), states_(program, domain_) {}

  void run() {
    std::vector<std::set<std::string>> left;  // by routine
    bool closed = true;
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [&](Statement& s) { say(s, r); });
      auto& names = left.emplace_back();
      const auto read = [&names](const ExprPtr& e) {
        walk(e, [&names](const ExprPtr& x) {
          if (const auto* v = as_variable(x)) names.insert(v->name);
        });
      };
      for_each_statement(r.body, [&](const Statement& s) {
        each_expression(s, read);
        each_axis_expression(s, read);
        const auto* c = std::get_if<CallRoutine>(&s.node);
        for (std::size_t i = 0; c != nullptr && i < c->arguments.size(); ++i) {
          if (c->arguments[i].by_reference) names.insert(c->arguments[i].reference.name);
        }
        closed = closed && (c == nullptr || (!c->computed && program_.find(c->routine) != nullptr)) &&
                 !std::holds_alternative<ModalCall>(s.node);
      });
      left_anywhere_.insert(names.begin(), names.end());
    }
    closed_ = closed;
    for (std::size_t r = 0; r < left.size(); ++r) {
      left_ = std::move(left[r]);
      remove(program_.routines[r].body);
    }
  }

 private:
  void say(Statement& s, const Routine& r) {
    if (const auto* m = std::get_if<Message>(&s.node); m != nullptr && file_statement(*m)) return;  // not written
    const auto* before = states_.before(s);
    if (before == nullptr) return;
    KnownLiterals::State state = *before;
    const KnownValues known = domain_.values(s, state);
    const auto with = [&known](const ExprPtr& e) { return with_known_texts(e, known); };
    if (auto* a = std::get_if<Assign>(&s.node)) {  // one after the other
      for (auto& item : a->items) {
        if (item.target.index) item.target.index = with(item.target.index);
        for (auto& i : item.target.indices) i = with(i);
        for (auto& i : item.system.args) i = with(i);
        item.value = with(item.value);
        domain_.write(item, item.value, s, state);
      }
      return;
    }
    if (auto* d = std::get_if<Declare>(&s.node)) {
      for (auto& item : d->items) {
        for (auto& i : item.dimensions) i = with(i);
        for (auto& i : item.initial) i = with(i);
        domain_.define(*d, item, item.initial.empty() ? nullptr : item.initial.front(), s, state);
      }
      return;
    }
    const auto* jump = std::get_if<Jump>(&s.node);
    const bool asks = jump != nullptr && jump->condition && as_number(jump->condition) == nullptr;
    StatementVisitor visit;
    visit.expression = with;
    visit_statement(s, visit);
    if (asks) decide(s);
    say_known_names(s, known, program_, r);
  }
  /// A jump whose condition has become a number is always taken, or never.
  static void decide(Statement& s) {
    auto& j = std::get<Jump>(s.node);
    const auto* n = as_number(j.condition);
    if (n == nullptr) return;
    const bool never = n->value == 0;
    j.condition = nullptr;
    if (never) s.node = Label{};
  }

  static void leave(Statement& s) {
    s.node = Block{};
    settle(s);
  }
  /// What is kept beyond the program may be read by another one.
  void tell_left_out(const Statement& s, const std::string& name) {
    if (!told_.insert(name).second) return;
    context_.diagnostics.warning("TRN-204", s.line.span,
                                 "the target has no texts: " + name +
                                     " is not written any more. Nothing in this program reads it, another one on the "
                                     "control may (said once a variable)",
                                 "look for programs that read it");
  }
  /// Definitions and assignments of variables that nothing reads any more.
  void remove(Body& body) {
    for (auto& s : body) {
      each_body(s, [this](Body& inner) { remove(inner); });
      if (auto* d = std::get_if<Declare>(&s.node); d != nullptr && (d->type == Type::string || d->type == Type::axis)) {
        std::erase_if(d->items, [this](const Declare::Item& i) { return left_.count(i.name) == 0; });
        if (d->items.empty()) leave(s);
      } else if (auto* a = std::get_if<Assign>(&s.node)) {
        std::erase_if(a->items, [&](const Assign::Item& i) {
          if (i.to_system || !domain_.holds_no_number(i.target)) return false;
          const bool own = program_.spaces[i.target.space].scope == Scope::routine;
          const bool unread =
              own ? left_.count(i.target.name) == 0 : closed_ && left_anywhere_.count(i.target.name) == 0;
          if (!unread || domain_.name_of(i.target, s).empty() || !is_literal(i.value)) return false;
          if (!own) tell_left_out(s, i.target.name);
          return true;
        });
        if (a->items.empty()) leave(s);
      }
    }
  }

  Program& program_;
  const LegaliseContext& context_;
  const KnownLiterals domain_;
  const FlowStates<KnownLiterals> states_;
  std::set<std::string> left_, left_anywhere_;  ///< variables that are still read: in the routine, in the program
  std::set<std::string> told_;
  bool closed_ = true;  ///< all that it calls is in the program
};

/// A text or an axis as a value, other than the words of a message.
bool uses_texts(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* d = std::get_if<Declare>(&s.node);
      found = found || (d != nullptr && (d->type == Type::string || d->type == Type::axis));
      const auto look = [&found](const ExprPtr& e) {
        walk(e, [&found](const ExprPtr& x) {
          found = found || (x->type == Type::string && !std::holds_alternative<String>(x->node)) ||
                  x->type == Type::axis || is_text_function(x);
        });
      };
      each_expression(s, look);
      each_axis_expression(s, look);
    });
  }
  return found;
}

/// Calls that come back into their own routine, and returns to a label of the caller, are not followed.
bool followable(const Program& program) {
  if (CallGraph(program).recursion() != nullptr) return false;
  bool good = true;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&good](const Statement& s) {
      const auto* back = std::get_if<Return>(&s.node);
      good = good && (back == nullptr || back->values.empty());
    });
  }
  return good;
}

}  // namespace

void write_known_texts(Program& program, const LegaliseContext& context) {
  const auto texts = [](const VariableSpace& s) { return s.type == Type::string || s.type == Type::axis; };
  if (std::any_of(context.target.spaces.begin(), context.target.spaces.end(), texts)) return;
  if (std::none_of(program.spaces.begin(), program.spaces.end(), texts) || !uses_texts(program)) return;
  if (!followable(program)) return;
  number_statements(program);
  KnownTexts(program, context).run();
}

}  // namespace cnctrans::ir::passes
