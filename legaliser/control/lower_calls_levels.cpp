// Levels of local parameters (P0-P25 and the like): a call either shares the caller's set or opens one of its own. A
// variable that only one routine uses becomes its own; one that a shared call passes on becomes one variable of the
// program.
#include <algorithm>
#include <numeric>
#include <set>

#include "base/saturate.h"
#include "legaliser/control/lower_calls.h"
#include "legaliser/edit/refuse.h"

namespace cnctrans::ir::passes {

namespace {

class Levels {
 public:
  Levels(Program& program, const LegaliseContext& context, const CallGraph& calls)
      : program_(program), context_(context), calls_(calls), reads_first_(program, calls, false) {
    for (std::size_t i = 0; i < program.spaces.size(); ++i) {
      for (const auto& g : program.spaces[i].segments) {
        if (g.scope != Scope::level) continue;
        space_ = static_cast<SpaceId>(i);
        lo_ = g.lo;
        count_ = static_cast<std::size_t>(g.hi - g.lo + 1);
      }
    }
    named_target_ = has_named_locals(context.target.spaces);
  }

  void run() {
    find_mentions();
    join_shared_calls();
    decide();
    find_formals();
    find_call_values();  // before names change: reading first is asked in the source's terms
    rename();
    for (std::size_t r = 0; r < program_.routines.size(); ++r) rewrite_calls(r);
    if (named_target_) {
      for (std::size_t r = 0; r < program_.routines.size(); ++r) sign(r);
    }
    for (auto& g : program_.spaces[space_].segments) {
      if (g.scope == Scope::level) g.scope = Scope::global;
    }
  }

 private:
  using Routines = std::set<std::size_t>;
  struct Class {
    Routines mentions, roots, members;
    bool local = false;
    std::size_t owner = 0;
  };

  std::size_t node(std::size_t routine, std::size_t v) const { return routine * count_ + v; }
  std::size_t find(std::size_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  std::optional<std::size_t> local_number(const VarRef& v) const {
    if (v.space != space_ || !v.index) return std::nullopt;
    const auto n = constant_index(v);
    if (!n || *n < lo_ || *n >= lo_ + static_cast<std::int64_t>(count_)) return std::nullopt;
    return saturate<std::size_t>(*n - lo_);
  }
  VarRef source_variable(std::size_t v) const {
    return VarRef{space_, {}, number(static_cast<double>(lo_ + static_cast<std::int64_t>(v))), {}};
  }
  std::optional<std::size_t> letter_of(const Argument& a) const {
    if (a.name.size() != 1 || a.name[0] < 'A' || a.name[0] > 'Z') return std::nullopt;
    const auto v = static_cast<std::size_t>(a.name[0] - 'A');
    return v < count_ ? std::optional(v) : std::nullopt;
  }
  bool is_root(std::size_t r) const {
    return program_.routines[r].kind == RoutineKind::main || calls_.called_with(r, CallLevel::new_level) ||
           !calls_.called(r);
  }
  std::string name_of(std::size_t v) const {
    return program_.spaces[space_].prefix + std::to_string(lo_ + static_cast<std::int64_t>(v));
  }

  void find_mentions() {
    const std::size_t n = program_.routines.size();
    mentioned_.assign(n, std::vector<bool>(count_, false));
    for (std::size_t r = 0; r < n; ++r) {
      const auto note = [&](const VarRef& v) {
        if (const auto k = local_number(v)) mentioned_[r][*k] = true;
      };
      for_each_statement(program_.routines[r].body, [&](const Statement& s) {
        each_expression(s, [&](const ExprPtr& e) {
          walk(e, [&](const ExprPtr& x) {
            if (const auto* v = as_variable(x)) note(*v);
          });
        });
        each_target(s, note);
      });
    }
  }

  void join_shared_calls() {
    parent_.resize(program_.routines.size() * count_);
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (const auto& site : calls_.sites()) {
      if (site.level != CallLevel::shared || !site.callee) continue;
      for (std::size_t v = 0; v < count_; ++v) parent_[find(node(site.caller, v))] = find(node(*site.callee, v));
    }
    classes_.assign(parent_.size(), {});
    for (std::size_t r = 0; r < program_.routines.size(); ++r) {
      for (std::size_t v = 0; v < count_; ++v) {
        Class& c = classes_[find(node(r, v))];
        c.members.insert(r);
        if (mentioned_[r][v]) c.mentions.insert(r);
        if (is_root(r)) c.roots.insert(r);
      }
    }
  }

  void decide() {
    for (std::size_t r = 0; r < program_.routines.size(); ++r) {
      for (std::size_t v = 0; v < count_; ++v) {
        if (!mentioned_[r][v]) continue;
        Class& c = classes_[find(node(r, v))];
        if (c.mentions.size() == 1) {
          // Shared with callers that do not use it: still its own when nothing of the last call is looked at.
          const bool alone = c.members.size() == 1 || (is_root(r) && !calls_.called_with(r, CallLevel::shared));
          c.local = alone || !reads_first_(r, source_variable(v));
        }
        if (c.local) {
          c.owner = r;
          continue;
        }
        const bool in_main = std::any_of(c.members.begin(), c.members.end(), [this](std::size_t m) {
          return program_.routines[m].kind == RoutineKind::main;
        });
        c.owner = in_main ? main_index() : *(c.roots.empty() ? c.mentions : c.roots).begin();
      }
    }
  }
  std::size_t main_index() const {
    for (std::size_t i = 0; i < program_.routines.size(); ++i) {
      if (program_.routines[i].kind == RoutineKind::main) return i;
    }
    return 0;
  }

  VarRef target_variable(std::size_t r, std::size_t v) {
    const Class& c = classes_[find(node(r, v))];
    const Routine& owner = program_.routines[c.owner];
    if (named_target_ && c.local) return VarRef{program_.space(""), "_" + name_of(v), nullptr, {}};
    if (named_target_ && owner.kind == RoutineKind::main) return source_variable(v);  // one variable of the program
    return frame_variable(program_, name_of(v), owner);
  }
  bool is_local(std::size_t r, std::size_t v) {
    const Class& c = classes_[find(node(r, v))];
    return c.local && c.owner == r;
  }

  /// Letters that some call gives a routine and that are its own there: its formal parameters.
  void find_formals() {
    formals_.assign(program_.routines.size(), {});
    if (!named_target_) return;
    if (program_.space("") == program_.spaces.size()) program_.spaces.push_back(VariableSpace{});
    for (const auto& site : calls_.sites()) {
      if (site.level != CallLevel::new_level || !site.callee) continue;
      for (const auto& a : arguments(*site.statement)) {
        const auto v = letter_of(a);
        if (v && is_local(*site.callee, *v)) formals_[*site.callee].insert(*v);
      }
    }
  }
  static const std::vector<Argument>& arguments(const Statement& s) {
    static const std::vector<Argument> none;
    if (const auto* c = std::get_if<CallRoutine>(&s.node)) return c->arguments;
    if (const auto* m = std::get_if<ModalCall>(&s.node)) return m->call.arguments;
    return none;
  }

  /// Which variables of a called frame start at 0 when no argument sets them.
  void find_call_values() {
    starts_at_zero_.assign(program_.routines.size(), {});
    for (std::size_t r = 0; r < program_.routines.size(); ++r) {
      if (!calls_.called_with(r, CallLevel::new_level)) continue;
      for (std::size_t v = 0; v < count_; ++v) {
        const Class& c = classes_[find(node(r, v))];
        if (!c.mentions.empty() && reads_first_(r, source_variable(v))) starts_at_zero_[r].insert(v);
      }
    }
  }

  void rename() {
    for (std::size_t r = 0; r < program_.routines.size(); ++r) {
      const auto change = [&](const VarRef& v) -> std::optional<VarRef> {
        const auto k = local_number(v);
        return k ? std::optional(target_variable(r, *k)) : std::nullopt;
      };
      StatementVisitor visit;
      visit.expression = [&](const ExprPtr& e) {
        return map_expr(e, [&](const ExprPtr& x) {
          const auto* v = as_variable(x);
          const auto to = v != nullptr ? change(*v) : std::nullopt;
          return to ? variable(*to, x->type) : x;
        });
      };
      visit.target = [&](VarRef& v) {
        if (auto to = change(v)) v = std::move(*to);
      };
      for_each_statement(program_.routines[r].body, [&](Statement& s) { visit_statement(s, visit); });
    }
  }

  /// The routine and those that share its level.
  Routines frame_of(std::size_t routine) const {
    Routines frame{routine};
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& site : calls_.sites()) {
        if (site.level != CallLevel::shared || !site.callee || frame.count(site.caller) == 0) continue;
        changed = frame.insert(*site.callee).second || changed;
      }
    }
    return frame;
  }

  void rewrite_calls(std::size_t caller) {
    rewrite_body(program_.routines[caller].body, [&](Statement&& s, Body& out) {
      auto* call = std::get_if<CallRoutine>(&s.node);
      auto* modal = std::get_if<ModalCall>(&s.node);
      if (modal != nullptr && !modal->off && !modal->cycle) call = &modal->call;
      if (call == nullptr || call->level != CallLevel::new_level) {
        out.push_back(std::move(s));
        return;
      }
      const auto callee = call->computed ? std::nullopt : calls_.index_of(call->routine);
      if (!callee) {
        if (!call->arguments.empty()) {
          refuse(s, program_, context_, "TRN-123",
                 "the called subprogram is not at hand: how its arguments arrive in the target is not known",
                 "add the folder with the subprogram with --lib");
        }
        out.push_back(std::move(s));
        return;
      }
      new_level_call(std::move(s), *call, *callee, modal != nullptr, out);
    });
  }

  void new_level_call(Statement&& s, CallRoutine& call, std::size_t callee, bool modal, Body& out) {
    std::map<std::size_t, ExprPtr> given;
    for (auto& a : call.arguments) {
      if (const auto v = letter_of(a)) given[*v] = a.value;
    }
    std::vector<std::pair<VarRef, ExprPtr>> values;
    Body behind;
    const Routines frame = frame_of(callee);
    for (std::size_t v = 0; v < count_; ++v) {
      const Class& c = classes_[find(node(callee, v))];
      const bool used = std::any_of(frame.begin(), frame.end(), [&](std::size_t r) { return mentioned_[r][v]; });
      if (!used || (named_target_ && is_local(callee, v))) continue;
      const VarRef target = target_variable(callee, v);
      if (c.roots.size() > 1) {  // another level waits in the same variable: kept over the call
        const VarRef saved = frame_variable(program_, name_of(v) + "_OF_CALLER", program_.routines[callee]);
        values.emplace_back(saved, variable(target));
        behind.push_back(make_assign(s.line, target, variable(saved)));
      }
      const auto it = given.find(v);
      if (it != given.end())
        values.emplace_back(target, it->second);
      else if (starts_at_zero_[callee].count(v) != 0)
        values.emplace_back(target, number(0));
    }
    call.arguments.clear();
    if (named_target_) positional(call, given, callee);
    call.level = named_target_ ? CallLevel::new_level : CallLevel::shared;
    if (modal && !(values.empty() && behind.empty())) {
      refuse(s, program_, context_, "TRN-124",
             "a modal call whose parameters the target would have to set before each of its calls",
             "call after each block");
      out.push_back(std::move(s));
      return;
    }
    if (call.count && !values.empty()) {
      context_.diagnostics.warning(
          "TRN-126", s.line.span, "the arguments are set once before all repetitions; the source sets them before each",
          "make sure that the subprogram does not change its parameters");
    }
    const LineInfo like = s.line;
    surround(out, assign_in_parallel(program_, like, std::move(values)), std::move(s), std::move(behind));
  }

  void positional(CallRoutine& call, const std::map<std::size_t, ExprPtr>& given, std::size_t callee) const {
    for (const auto v : formals_[callee]) {
      Argument a;
      const auto it = given.find(v);
      if (it != given.end()) a.value = it->second;
      call.arguments.push_back(std::move(a));
    }
    while (!call.arguments.empty() && !call.arguments.back().value) call.arguments.pop_back();
  }

  /// Signature and local variables of the routine.
  void sign(std::size_t r) {
    Routine& routine = program_.routines[r];
    routine.parameters.clear();
    std::vector<std::string> names;
    for (std::size_t v = 0; v < count_; ++v) {
      if (formals_[r].count(v) != 0) {
        Parameter p;
        p.name = "_" + name_of(v);
        p.variable = target_variable(r, v);
        routine.parameters.push_back(std::move(p));
      } else if (mentioned_[r][v] && is_local(r, v)) {
        names.push_back("_" + name_of(v));
      }
    }
    routine.has_signature = !routine.parameters.empty();
    declare_at_top(routine, Type::real, program_.space(""), names);
  }

  Program& program_;
  const LegaliseContext& context_;
  const CallGraph& calls_;
  ReadFirst reads_first_;
  SpaceId space_ = 0;
  std::int64_t lo_ = 0;
  std::size_t count_ = 0;
  bool named_target_ = false;
  std::vector<std::vector<bool>> mentioned_;
  std::vector<std::size_t> parent_;
  std::vector<Class> classes_;
  std::vector<std::set<std::size_t>> formals_, starts_at_zero_;
};

}  // namespace

void lower_levels(Program& program, const LegaliseContext& context, const CallGraph& calls) {
  Levels(program, context, calls).run();
}

}  // namespace cnctrans::ir::passes
