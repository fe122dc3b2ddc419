// Named variables of a routine and formal parameters, for a target without them: local parameters by letter where the
// target has levels, else variables of the whole program, one for each routine (there is no recursion).
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/saturate.h"
#include "ir/analysis/domains/kept_values.h"
#include "legaliser/analysis/handed_variables.h"
#include "legaliser/control/lower_calls.h"
#include "legaliser/edit/refuse.h"

namespace cnctrans::ir::passes {

namespace {

class NamedLocals {
 public:
  NamedLocals(Program& program, const LegaliseContext& context, const CallGraph& calls)
      : program_(program),
        context_(context),
        calls_(calls),
        reads_first_(program, calls, false),
        handed_(program, context, calls) {
    levels_ = has_numbered_levels(context.target.spaces);
    for (const auto& s : context.target.spaces) {
      for (const auto& g : s.segments) {
        if (g.scope == Scope::level) level_size_ = static_cast<std::size_t>(g.hi - g.lo + 1);
      }
    }
  }

  void run() {
    infos_.resize(program_.routines.size());
    for (std::size_t r = 0; r < infos_.size(); ++r) collect(r);
    for (std::size_t r = 0; r < infos_.size(); ++r) place(r);
    for (std::size_t r = 0; r < infos_.size(); ++r) place_handed(r);
    for (std::size_t r = 0; r < infos_.size(); ++r) rename(r);
    find_changed();
    writes_.emplace(program_);
    for (std::size_t r = 0; r < infos_.size(); ++r) rewrite(r);
    for (std::size_t r = 0; r < infos_.size(); ++r) finish_signature(r);
  }

 private:
  struct Info {
    std::vector<std::string> names;  ///< in order of appearance, parameters first
    std::map<std::string, SpaceId> spaces;
    std::map<std::string, VarRef> places;              ///< where each goes (without array indices)
    std::set<std::string> arrays, by_reference, zero;  ///< zero: must be set to 0 where it is defined
    std::set<std::string> declared;
    std::vector<Parameter> parameters;  ///< as the source had them
    bool has_levels = false;            ///< some go to the target's levels
  };

  bool is_local_space(SpaceId s) const { return is_routine_space(program_, s); }

  void add(Info& info, const VarRef& v) {
    if (!is_local_space(v.space) || v.name.empty()) return;
    if (info.spaces.emplace(v.name, v.space).second) info.names.push_back(v.name);
    if (!v.indices.empty()) info.arrays.insert(v.name);
  }

  static bool reads(const Routine& routine, const VarRef& v) {
    bool found = false;
    for_each_statement(routine.body, [&](const Statement& s) {
      each_expression(s, [&](const ExprPtr& e) { found = found || passes::reads(e, v); });
    });
    return found;
  }

  void collect(std::size_t r) {
    Info& info = infos_[r];
    Routine& routine = program_.routines[r];
    info.parameters = routine.parameters;
    for (const auto& p : routine.parameters) {
      add(info, p.variable);
      info.declared.insert(p.variable.name);
      if (p.by_reference) info.by_reference.insert(p.variable.name);
      if (p.type == Type::string && !calls_.called(r) && reads(routine, p.variable))
        context_.diagnostics.error("TRN-125", routine.header.span,
                                   "the parameter " + p.name + " is a text: the target has numbers only",
                                   "translate the subprogram together with a program that calls it, or write the text "
                                   "where it is used");
    }
    for_each_statement(routine.body, [&](const Statement& s) {
      if (const auto* d = std::get_if<Declare>(&s.node); d != nullptr && is_local_space(d->space)) {
        for (const auto& i : d->items) {
          add(info, VarRef{d->space, i.name, nullptr, {}});
          info.declared.insert(i.name);
          if (!i.dimensions.empty()) info.arrays.insert(i.name);
        }
      }
      each_expression(s, [&](const ExprPtr& e) {
        walk(e, [&](const ExprPtr& x) {
          if (const auto* v = as_variable(x)) add(info, *v);
        });
      });
      each_target(s, [&](const VarRef& v) { add(info, v); });
    });
    for (const auto& n : info.names) {
      if (info.arrays.count(n) != 0) continue;
      const VarRef v{info.spaces[n], n, nullptr, {}};
      if (reads_first_(r, v)) info.zero.insert(n);
    }
  }

  void place_handed(std::size_t r) {
    for (const auto& [name, from] : handed_.of(r)) {
      std::pair<std::size_t, VarRef> at = from;
      for (std::size_t steps = 0; steps < infos_.size(); ++steps) {  // a parameter handed on
        const auto further = handed_.of(at.first).find(at.second.name);
        if (further == handed_.of(at.first).end()) break;
        at = further->second;
      }
      const auto place = infos_[at.first].places.find(at.second.name);
      infos_[r].places[name] = place != infos_[at.first].places.end() ? place->second : at.second;
    }
  }

  void place(std::size_t r) {
    Info& info = infos_[r];
    const Routine& routine = program_.routines[r];
    std::size_t used = 0;
    for (const auto& n : info.names) {
      if (handed_.of(r).count(n) != 0) continue;
      if (info.declared.count(n) == 0 && routine.kind == RoutineKind::sub && infos_[0].declared.count(n) != 0) {
        info.places[n] = frame_variable(program_, n, program_.routines[0]);  // the main program's, seen below
        infos_[0].places[n] = info.places[n];
        continue;
      }
      const bool own_level = levels_ && info.arrays.count(n) == 0 && info.by_reference.count(n) == 0 &&
                             !handed_.hands_on(r, n) && used < level_size_ && infos_[r].places.count(n) == 0;
      if (own_level) {
        info.places[n] = VarRef{level_space(program_), n, nullptr, {}};
        info.has_levels = true;
        ++used;
      } else if (info.places.count(n) == 0) {
        info.places[n] = frame_variable(program_, n, routine);
      }
    }
  }

  void rename(std::size_t r) {
    Info& info = infos_[r];
    const auto change = [&](const VarRef& v) -> std::optional<VarRef> {
      if (!is_local_space(v.space)) return std::nullopt;
      const auto it = info.places.find(v.name);
      if (it == info.places.end()) return std::nullopt;
      VarRef to = it->second;
      to.indices = v.indices;
      return to;
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
    for (auto& p : program_.routines[r].parameters) visit.target(p.variable);
  }

  void rewrite(std::size_t r) {
    caller_ = r;
    rewrite_body(program_.routines[r].body, [&](Statement&& s, Body& out) {
      if (const auto* d = std::get_if<Declare>(&s.node); d != nullptr && is_local_space(d->space)) {
        const Declare copy = *d;
        declare(r, std::move(s), copy, out);
      } else if (std::holds_alternative<CallRoutine>(s.node) || std::holds_alternative<ModalCall>(s.node)) {
        call(std::move(s), out);
      } else {
        out.push_back(std::move(s));
      }
    });
    pick_up_undeclared(r);
  }

  /// A definition becomes the assignments that it stands for.
  void declare(std::size_t r, Statement&& s, const Declare& d, Body& out) {
    const Info& info = infos_[r];
    if (d.type == Type::string || d.type == Type::axis || d.type == Type::frame) {
      refuse(s, program_, context_, "TRN-125",
             "variables of type " + std::string(name(d.type)) + ": the target has numbers only",
             "write the text where it is used");
      out.push_back(std::move(s));
      return;
    }
    Assign values;
    const auto set = [&](VarRef v, ExprPtr value) {
      Assign::Item item;
      item.target = std::move(v);
      item.value = std::move(value);
      values.items.push_back(std::move(item));
    };
    for (const auto& i : d.items) {
      const auto place = info.places.find(i.name);
      if (place == info.places.end()) continue;
      if (i.dimensions.empty()) {
        const bool new_level = place->second.space == program_.space(level_prefix) &&
                               program_.routines[r].kind == RoutineKind::sub;  // starts at 0 by itself
        if (!i.initial.empty())
          set(place->second, i.initial.front());
        else if (info.zero.count(i.name) != 0 && !new_level)
          set(place->second, number(0));
        continue;
      }
      array(s, i, place->second, set);
      sizes_[place->second.name] = dimensions(i);
    }
    // The definition itself stays for arrays: the variables pass asks it for the size.
    Declare rest;
    rest.type = d.type;
    rest.space = program_.space(frame_prefix);
    for (const auto& i : d.items) {
      if (i.dimensions.empty()) continue;
      Declare::Item item = i;
      item.name = info.places.at(i.name).name;
      item.initial.clear();
      rest.items.push_back(std::move(item));
    }
    Body pieces;
    if (!rest.items.empty()) pieces.push_back(made(s.line, std::move(rest)));
    if (!values.items.empty()) pieces.push_back(made(s.line, std::move(values)));
    if (pieces.empty()) pieces.push_back(made(s.line, Block{}));  // its comment and label stay
    pieces.back().line.comments = s.line.comments;
    move_head(s.line, pieces.front().line);
    const bool empty_line = pieces.size() == 1 && std::holds_alternative<Block>(pieces[0].node) &&
                            pieces[0].line.number.empty() && pieces[0].line.labels.empty() &&
                            pieces[0].line.comments.empty();
    if (empty_line) return;
    for (auto& p : pieces) out.push_back(std::move(p));
  }

  static std::vector<std::int64_t> dimensions(const Declare::Item& i) {
    std::vector<std::int64_t> list;
    for (const auto& d : i.dimensions) {
      const auto v = constant_value(d);
      list.push_back(v ? saturate<std::int64_t>(*v) : 0);
    }
    return list;
  }

  /// First values of an array: as given, the rest 0.
  template <class Set>
  void array(const Statement& s, const Declare::Item& item, const VarRef& place, const Set& set) {
    constexpr std::int64_t most = 64;
    std::int64_t count = 1;
    const auto dims = dimensions(item);
    for (const auto d : dims) count *= d;
    if (count <= 0 || count > most) {
      context_.diagnostics.error(
          "TRN-127", s.line.span,
          "array " + item.name + ": the target keeps arrays of up to 64 elements in numbered variables",
          "use a smaller array");
      return;
    }
    for (std::int64_t k = 0; k < count; ++k) {
      VarRef v = place;
      std::int64_t rest = k;
      v.indices.resize(dims.size());
      for (std::size_t d = dims.size(); d-- > 0;) {
        v.indices[d] = number(static_cast<double>(rest % dims[d]));
        rest /= dims[d];
      }
      const auto at = static_cast<std::size_t>(k);
      set(std::move(v), at < item.initial.size() && item.initial[at] ? item.initial[at] : number(0));
    }
  }

  /// Names that no definition of the routine names (made by the reader or a pass) and that are read first.
  void pick_up_undeclared(std::size_t r) {
    Info& info = infos_[r];
    Body before;
    const LineInfo nowhere;
    for (const auto& n : info.names) {
      if (info.declared.count(n) != 0 || info.zero.count(n) == 0 ||
          info.places.at(n).space != program_.space(frame_prefix))
        continue;
      if (program_.routines[r].kind == RoutineKind::sub && infos_[0].declared.count(n) != 0) continue;
      before.push_back(make_assign(nowhere, info.places.at(n), number(0)));
    }
    auto& body = program_.routines[r].body;
    body.insert(body.begin(), std::make_move_iterator(before.begin()), std::make_move_iterator(before.end()));
  }

  void call(Statement&& s, Body& out) {
    auto* call = std::get_if<CallRoutine>(&s.node);
    const auto* modal = std::get_if<ModalCall>(&s.node);
    if (modal != nullptr && (modal->off || modal->cycle)) {
      out.push_back(std::move(s));
      return;
    }
    if (modal != nullptr) call = &std::get<ModalCall>(s.node).call;
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
    pass_arguments(std::move(s), *call, *callee, modal != nullptr, out);
  }

  void pass_arguments(Statement&& s, CallRoutine& call, std::size_t callee, bool modal, Body& out) {
    const Info& info = infos_[callee];
    std::vector<std::pair<VarRef, ExprPtr>> before;
    Body behind, taken_once;
    std::vector<Argument> letters;
    for (std::size_t i = 0; i < info.parameters.size(); ++i) {
      const Parameter& p = info.parameters[i];
      if (handed_.of(callee).count(p.variable.name) != 0) continue;
      const Argument* a = i < call.arguments.size() && (call.arguments[i].value || call.arguments[i].by_reference)
                              ? &call.arguments[i]
                              : nullptr;
      ExprPtr value = a == nullptr ? p.default_value : a->value ? a->value : variable(a->reference);
      if (!p.by_reference) value = taken_as(p.type, value);
      const VarRef& place = info.places.at(p.variable.name);
      if (place.space == program_.space(level_prefix)) {
        Argument letter;
        letter.name = std::string(1, static_cast<char>('A' + letter_index(info, p.variable.name)));
        letter.value = value;
        if (letter.value) letters.push_back(std::move(letter));
        continue;
      }
      before.emplace_back(place, value ? value : number(0));
      const auto* v = as_variable(a != nullptr ? value : nullptr);
      if (p.by_reference && v != nullptr) behind.push_back(make_assign(s.line, *v, variable(place)));
    }
    call.arguments = std::move(letters);
    call.level = info.has_levels ? CallLevel::new_level : CallLevel::shared;
    if (modal && !(before.empty() && behind.empty())) {
      refuse(s, program_, context_, "TRN-124",
             "a modal call whose parameters the target would have to set before each of its calls",
             "call after each block");
      out.push_back(std::move(s));
      return;
    }
    const bool changed = std::any_of(before.begin(), before.end(),
                                     [this](const auto& item) { return changed_.count(item.first.name) != 0; });
    const bool by_pass = call.count && (changed || !behind.empty());
    if (call.count) {  // the source computes an argument once, for all passes
      const auto run = reached_from(calls_, callee);
      const auto once = [&](ExprPtr& value) {
        const bool computed = value && value->type != Type::string && !constant_value(value);
        if (computed && writes_->may_change(value, caller_, run))
          value = kept(program_, s.line, value, "arguments", kept_, taken_once);
      };
      for (auto& letter : call.arguments) once(letter.value);
      for (auto& [place, value] : before) {
        const bool back = std::any_of(behind.begin(), behind.end(), [&place = place](const Statement& b) {
          return same_variable(*as_variable(std::get<Assign>(b.node).items.front().value), place);
        });
        if (by_pass && !back) once(value);  // by reference it goes over anew
      }
      if (!taken_once.empty()) move_head(s.line, taken_once.front().line);
      for (auto& t : taken_once) out.push_back(std::move(t));
    }
    if (by_pass) return each_pass(std::move(s), call, std::move(before), std::move(behind), out);
    const LineInfo like = s.line;
    surround(out, assign_in_parallel(program_, like, std::move(before)), std::move(s), std::move(behind));
  }

  /// A parameter of whole numbers rounds what it is given, one of truth values takes what is not 0 for 1.
  static ExprPtr taken_as(Type type, const ExprPtr& value) {
    if (!value || value->type == type || value->type == Type::boolean) return value;
    if (type != Type::integer && type != Type::boolean) return value;
    if (const auto n = constant_value(value)) return number(type == Type::integer ? std::round(*n) : *n != 0 ? 1 : 0);
    Expr e;
    e.type = type;
    e.node = Call{type == Type::integer ? Function::to_integer : Function::to_boolean, {value}, RoundHalf::away};
    return std::make_shared<const Expr>(std::move(e));
  }
  /// The subprogram changes a parameter: it is set before each pass, as in the source.
  void each_pass(Statement&& s, CallRoutine& call, std::vector<std::pair<VarRef, ExprPtr>>&& values, Body&& behind,
                 Body& out) {
    const LineInfo like = s.line;
    For loop;
    loop.counter = VarRef{frame_space(program_), "N" + std::to_string(++passes_) + "@arguments", nullptr, {}};
    loop.from = number(1);
    loop.to = std::exchange(call.count, nullptr);
    Statement inner = made(like, std::move(call));
    surround(loop.body, assign_in_parallel(program_, like, std::move(values)), std::move(inner), std::move(behind));
    s.node = std::move(loop);
    out.push_back(std::move(s));
  }
  /// Parameters that some routine writes, directly or by handing them on by reference.
  void find_changed() {
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [this](const Statement& s) {
        each_target(s, [this](const VarRef& v) {
          if (!v.name.empty()) changed_.insert(v.name);
        });
        if (const auto* c = std::get_if<CallRoutine>(&s.node)) handed_on(*c);
        if (const auto* m = std::get_if<ModalCall>(&s.node)) handed_on(m->call);
      });
    }
  }
  void handed_on(const CallRoutine& c) {
    for (const auto& a : c.arguments) {
      if (a.by_reference) changed_.insert(a.reference.name);
      const auto* v = a.value ? as_variable(a.value) : nullptr;
      if (v != nullptr) changed_.insert(v->name);  // the callee may take it by reference
    }
  }

  /// Place of a parameter among those that become letters.
  int letter_index(const Info& info, const std::string& parameter) const {
    int index = 0;
    for (const auto& p : info.parameters) {
      if (p.variable.name == parameter) return index;
      if (info.places.at(p.variable.name).space == program_.space(level_prefix)) ++index;
    }
    return index;
  }

  void finish_signature(std::size_t r) {
    Routine& routine = program_.routines[r];
    if (!levels_) routine.parameters.clear();
    std::erase_if(routine.parameters,
                  [this](const Parameter& p) { return p.variable.space != program_.space(level_prefix); });
    routine.has_signature = false;
  }

  Program& program_;
  const LegaliseContext& context_;
  const CallGraph& calls_;
  ReadFirst reads_first_;
  const HandedVariables handed_;
  bool levels_ = false;
  std::size_t level_size_ = 0;
  std::vector<Info> infos_;
  std::map<std::string, std::vector<std::int64_t>> sizes_;
  std::set<std::string> changed_;
  std::optional<Writes> writes_;  ///< in the target's variables
  std::size_t caller_ = 0;        ///< the routine that is rewritten
  int passes_ = 0, kept_ = 0;
};

}  // namespace

void lower_named_locals(Program& program, const LegaliseContext& context, const CallGraph& calls) {
  NamedLocals(program, context, calls).run();
}

}  // namespace cnctrans::ir::passes
