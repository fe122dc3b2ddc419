// Variables (equivalences 18): spaces and numbers of the source become those of the target. Numbers stay where the
// target has them, else whole ranges are shifted, else the used ones are packed in ascending order. Variables without a
// number take a free one. The table goes to the report, and to a comment at the head when a name changed beyond its
// letter.
#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "ir/analysis/call_graph.h"
#include "legaliser/analysis/compensated_variables.h"
#include "legaliser/control/lower_calls.h"
#include "legaliser/edit/given_names.h"
#include "legaliser/edit/variable_pools.h"
#include "legaliser/names/declared_arrays.h"
#include "legaliser/names/variable_table.h"
#include "legaliser/names/variable_use.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// The program speaks of the target's variables already.
bool same_spaces(const Program& program, const LegaliseContext& context) {
  const auto& t = context.target.spaces;
  if (t.empty() || program.spaces.size() < t.size()) return t.empty() && program.spaces.empty();
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (program.spaces[i].prefix != t[i].prefix || program.spaces[i].named() != t[i].named() ||
        program.spaces[i].scope != t[i].scope)
      return false;
  }
  return true;
}

class VariableMap {
 public:
  VariableMap(Program& program, const LegaliseContext& context)
      : program_(program), context_(context), use_(program, context), pools_(context), given_(context, pools_) {}

  void run() {
    number_statements(program_);
    pools_.level_is_global = !use_.levels;
    if (pools_.depends_on_compensation()) compensated_ = compensated_variables(program_, context_);
    place_numbered();
    place_levels();
    place_named();
    report_left_over();
    report_persistence();
    rename();
    finish();
  }

 private:
  using NamedKey = std::pair<SpaceId, std::string>;

  [[nodiscard]] bool compensated(SpaceId space, const std::string& name) const {
    return compensated_.count({space, name}) != 0;
  }

  // --- numbered spaces ------------------------------------------------------------------------------------------

  void place_numbered() {
    for (const auto& [space, numbered] : use_.numbered) {
      const auto& segments = program_.spaces[space].segments;
      std::set<std::int64_t> shifts;
      for (const auto& segment : segments) {
        std::vector<std::int64_t> used;
        bool given = false;
        for (const auto n : numbered.used) {
          if (n < segment.lo || n > segment.hi) continue;
          const auto place = given_.place_of(variable_name(space, n), compensated(space, std::to_string(n)), 1);
          if (!place) {
            used.push_back(n);
            continue;
          }
          places_[{space, n}] = *place;
          given = shifts.insert(*constant_index(*place) - n).second || given;
        }
        const bool stands_for_all = numbered.computed && numbered.used.empty() && &segment == &widest(segments);
        if (used.empty() && (given || !stands_for_all)) continue;
        place_segment(space, segment, std::move(used), shifts);
      }
      if (numbered.computed) computed_index(space, numbered, shifts);
    }
  }
  static const SpaceSegment& widest(const std::vector<SpaceSegment>& segments) {
    return *std::max_element(segments.begin(), segments.end(),
                             [](const SpaceSegment& a, const SpaceSegment& b) { return a.hi - a.lo < b.hi - b.lo; });
  }

  void place_segment(SpaceId space, const SpaceSegment& segment, std::vector<std::int64_t> used,
                     std::set<std::int64_t>& shifts) {
    std::int64_t from = segment.lo;
    if (const auto* pool = pools_.holding(segment.lo, segment)) {  // the numbers stay
      shifts.insert(0);
      std::erase_if(used, [&](std::int64_t n) {
        const auto* own = pools_.holding(n, segment);
        return own != nullptr && take(space, n, *own, n);
      });
      from = pool->hi + 1;
    }
    if (!used.empty() || from == segment.lo) {
      if (const auto shift = pools_.shift_for(segment, from, used)) {
        shifts.insert(shift->second);
        std::erase_if(used, [&](std::int64_t n) { return take(space, n, *shift->first, n + shift->second); });
      }
    }
    for (const auto n : used) {
      shifts.insert(n == 0 ? 1 : n * 1000003);  // packed: no common shift
      const auto free = pools_.any_free(segment, compensated(space, std::to_string(n)));
      if (free)
        take(space, n, *free->first, free->second);
      else
        left_over_.push_back(variable_name(space, n));
    }
  }
  bool take(SpaceId space, std::int64_t n, const VariablePool& pool, std::int64_t to) {
    if (pool.outside_compensation && compensated(space, std::to_string(n))) return false;
    if (!pools_.take(pool.prefix, to)) return false;
    places_[{space, n}] = VarRef{pools_.space(pool.prefix), {}, number(static_cast<double>(to)), {}};
    return true;
  }
  std::string variable_name(SpaceId space, std::int64_t n) const {
    return program_.spaces[space].prefix + std::to_string(n);
  }
  void report_left_over() const {
    if (left_over_.empty()) return;
    const std::string others =
        left_over_.size() == 1 ? "" : " and " + std::to_string(left_over_.size() - 1) + " others";
    context_.diagnostics.error("TRN-120", {}, "no variable of the target is left for " + left_over_.front() + others,
                               "use fewer variables");
  }

  /// A variable whose number is computed: every number it may reach must have moved by the same amount.
  void computed_index(SpaceId space, const VariableUse::Numbered& numbered, const std::set<std::int64_t>& shifts) {
    const Span& where = numbered.computed_at.span;
    if (!context_.target.word_indirect) {
      context_.diagnostics.error("TRN-128", where, "the target has no variables with a computed number",
                                 "use fixed variables, with a condition for each");
      return;
    }
    if (shifts.size() != 1) {
      context_.diagnostics.error(
          "TRN-129", where,
          "a variable with a computed number, and the variables of the program don't keep one distance "
          "to those of the target",
          "use one contiguous range of variables");
      return;
    }
    shift_[space] = *shifts.begin();
    for (const auto& segment : program_.spaces[space].segments) {
      if (const auto* pool = pools_.holding_prefix(segment)) shifted_space_[space] = pools_.space(pool->prefix);
    }
    const auto any = places_.lower_bound({space, 0});
    if (any != places_.end() && any->first.first == space) shifted_space_[space] = any->second.space;
    for (const auto& segment : program_.spaces[space].segments)
      pools_.keep_clear(context_.target.spaces[shifted_space_[space]].prefix, segment.lo + shift_[space],
                        segment.hi + shift_[space]);
    context_.diagnostics.warning(
        "TRN-130", where,
        "a variable with a computed number: right as long as the number stays in the range that the "
        "program uses",
        "check the smallest and the largest number");
  }

  // --- local parameters of the target ---------------------------------------------------------------------------

  void place_levels() {
    const SpaceId level = program_.space(level_prefix);
    const auto* pool = pools_.level_pool();
    if (level == program_.spaces.size() || pool == nullptr) return;
    for (std::size_t r = 0; r < program_.routines.size(); ++r) {
      std::int64_t next = pool->lo;
      const auto place = [&](const VarRef& v) {
        if (v.space != level) return;
        const auto key = std::make_pair(r, v.name);
        if (local_.count(key) != 0) return;
        local_[key] = VarRef{pools_.space(pool->prefix), {}, number(static_cast<double>(next++)), {}};
      };
      for (const auto& p : program_.routines[r].parameters) place(p.variable);
      for_each_statement(program_.routines[r].body, [&](const Statement& s) {
        each_target(s, place);
        each_expression(s, [&](const ExprPtr& e) {
          walk(e, [&](const ExprPtr& x) {
            if (const auto* v = as_variable(x)) place(*v);
          });
        });
      });
    }
  }

  // --- named variables ------------------------------------------------------------------------------------------

  void place_named() {
    std::vector<NamedKey> rest;
    for (const auto& [key, info] : use_.named) {
      const auto& space = program_.spaces[key.first];
      if (space.prefix == level_prefix) continue;
      if (space.prefix == array_prefix) continue;                                               // stays a name
      if (space.scope == Scope::routine && has_named_locals(context_.target.spaces)) continue;  // stays a name
      if (const auto place = given_.place_of(key.second, compensated(key.first, key.second), info.elements())) {
        named_places_[key] = *place;
        continue;
      }
      if (keeps_name(key, info)) continue;
      const auto wanted = preferred_number(key.second);
      const auto* pool = wanted && info.dimensions.empty() ? pools_.holding_any(*wanted) : nullptr;
      const bool fits = pool != nullptr && !(pool->outside_compensation && compensated(key.first, key.second));
      if (fits && pools_.take(pool->prefix, *wanted)) {
        named_places_[key] = VarRef{pools_.space(pool->prefix), {}, number(static_cast<double>(*wanted)), {}};
      } else {
        rest.push_back(key);
      }
    }
    for (const auto& key : rest) {
      const std::int64_t size = use_.named[key].elements();
      const auto free = pools_.run_of_free(size, compensated(key.first, key.second));
      if (!free) {
        left_over_.push_back(key.second.substr(0, key.second.find('@')));
        continue;
      }
      for (std::int64_t i = 0; i < size; ++i) pools_.take(free->first->prefix, free->second + i);
      named_places_[key] = VarRef{pools_.space(free->first->prefix), {}, number(static_cast<double>(free->second)), {}};
    }
  }

  /// A name of the whole program that one routine alone uses can stay where the target has names for its routines.
  bool keeps_name(const NamedKey& key, const VariableUse::Named& info) {
    if (!has_named_locals(context_.target.spaces) || info.routines.size() != 1) return false;
    std::string plain = key.second.substr(0, key.second.find('@'));
    if (plain.size() < 2 || !std::all_of(plain.begin(), plain.end(), [](char c) {
          return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
        }))
      return false;
    if (plain[0] >= '0' && plain[0] <= '9') return false;
    const std::size_t user = *info.routines.begin();
    if (program_.routines[user].kind == RoutineKind::sub) {  // a name of its own would start anew with each call
      const CallGraph calls(program_);
      if (ReadFirst(program_, calls, false)(user, VarRef{key.first, key.second, nullptr, {}})) return false;
    }
    if (plain.size() < 3 || !(plain[1] >= 'A' && plain[1] <= 'Z')) plain = "_" + plain;  // X1, R5: addresses
    const Type type = program_.spaces[key.first].type == Type::string ? Type::string : Type::real;
    named_places_[key] = VarRef{local_space(type), plain, nullptr, {}};
    declared_[{*info.routines.begin(), type}].push_back(plain);
    return true;
  }

  // --- rewriting ------------------------------------------------------------------------------------------------

  std::optional<VarRef> moved(const VarRef& v, std::size_t routine) const {
    if (v.space >= program_.spaces.size()) return std::nullopt;
    const auto& space = program_.spaces[v.space];
    if (!space.named()) {
      if (const auto n = constant_index(v)) {
        const auto it = places_.find({v.space, *n});
        return it == places_.end() ? std::nullopt : std::optional(it->second);
      }
      const auto shift = shift_.find(v.space);
      if (shift == shift_.end()) return std::nullopt;
      VarRef to = v;
      to.space = shifted_space_.at(v.space);
      const auto k = static_cast<double>(shift->second);
      if (k > 0) to.index = binary(BinaryOp::add, v.index, number(k));
      if (k < 0) to.index = binary(BinaryOp::subtract, v.index, number(-k));
      return to;
    }
    if (space.prefix == level_prefix) {
      const auto it = local_.find({routine, v.name});
      return it == local_.end() ? std::nullopt : std::optional(it->second);
    }
    const auto it = named_places_.find({v.space, v.name});
    if (it == named_places_.end()) return kept_name(v);
    return v.indices.empty() ? it->second : element(v, it->second);
  }

  /// A routine's own name, in the target's space of the same type.
  std::optional<VarRef> kept_name(const VarRef& v) const {
    const auto& from = program_.spaces[v.space];
    const auto& spaces = context_.target.spaces;
    std::optional<SpaceId> any;
    for (std::size_t i = 0; i < spaces.size(); ++i) {
      if (!spaces[i].named() || spaces[i].scope != from.scope) continue;
      if (!any || spaces[i].type == from.type) any = static_cast<SpaceId>(i);
    }
    if (!any) return std::nullopt;
    VarRef to = v;
    to.space = *any;
    return to;
  }

  /// An element of an array: its number from the indices.
  std::optional<VarRef> element(const VarRef& v, const VarRef& base) const {
    const auto& dims = use_.named.at({v.space, v.name}).dimensions;
    if (dims.size() != v.indices.size()) return std::nullopt;
    ExprPtr offset;
    for (std::size_t i = 0; i < dims.size(); ++i) {
      if (offset) offset = binary(BinaryOp::multiply, offset, number(static_cast<double>(dims[i])));
      offset = offset ? binary(BinaryOp::add, offset, v.indices[i]) : v.indices[i];
    }
    VarRef to = base;
    to.index = binary(BinaryOp::add, offset, base.index);
    if (const auto n = constant_value(to.index)) {
      to.index = number(*n);
    } else if (!context_.target.word_indirect) {
      context_.diagnostics.error("TRN-128", at_, "an array with a computed index: the target has no such variables",
                                 "use fixed indices");
    }
    return to;
  }

  void rename() {
    zero_first_ = to_zero();
    for (std::size_t r = 0; r < program_.routines.size(); ++r) {
      StatementVisitor visit;
      visit.expression = [&](const ExprPtr& e) {
        return map_expr(e, [&](const ExprPtr& x) {
          const auto* v = as_variable(x);
          const auto to = v != nullptr ? moved(*v, r) : std::nullopt;
          return to ? variable(*to, x->type) : x;
        });
      };
      visit.target = [&](VarRef& v) {
        if (auto to = moved(v, r)) v = std::move(*to);
      };
      auto& routine = program_.routines[r];
      for_each_statement(routine.body, [&](Statement& s) { at_ = s.line.span, visit_statement(s, visit); });
      for (auto& p : routine.parameters) visit.target(p.variable);
      define(routine.body);
    }
  }

  /// Definitions of names that have become numbers: their first values are assigned where they stood.
  void define(Body& b) const {
    Body out;
    for (auto& s : b) {
      Assign first = first_values(s, named_places_);
      const LineInfo like = s.line;
      if (!drop_declare(s)) out.push_back(std::move(s));
      for (auto& item : first.items) out.push_back(make_assign(like, std::move(item.target), std::move(item.value)));
    }
    b = std::move(out);
  }

  bool drop_declare(Statement& s) const {
    auto* d = std::get_if<Declare>(&s.node);
    if (d == nullptr) return false;
    std::erase_if(d->items, [&](const Declare::Item& i) { return named_places_.count({d->space, i.name}) != 0; });
    if (d->items.empty()) {
      s.node = Block{};  // its comment and label stay
      return s.line.number.empty() && s.line.labels.empty() && s.line.comments.empty();
    }
    if (const auto to = kept_name(VarRef{d->space, d->items.front().name, nullptr, {}})) d->space = to->space;
    return false;
  }

  /// Variables that start at 0 in the source, keep an old value in the target, and are read before they are written.
  std::vector<VarRef> to_zero() {
    std::vector<VarRef> list;
    const CallGraph calls(program_);
    ReadFirst reads(program_, calls, true);
    std::size_t main = 0;
    while (main < program_.routines.size() && program_.routines[main].kind != RoutineKind::main) ++main;
    if (main == program_.routines.size()) return list;
    const auto starts_old = [&](const VarRef& to) { return to.name.empty() && !pools_.starts_at_zero(to); };
    for (const auto& [key, to] : places_) {
      if (!program_.spaces[key.first].starts_at_zero || !starts_old(to)) continue;
      if (reads(main, VarRef{key.first, {}, number(static_cast<double>(key.second)), {}})) list.push_back(to);
    }
    for (const auto& [key, to] : named_places_) {
      if (!starts_old(to) || !may_be_read_first(program_, key) ||
          !reads(main, VarRef{key.first, key.second, nullptr, {}}))
        continue;
      for (std::int64_t k = 0; k < use_.named.at(key).elements(); ++k) {
        list.push_back(to);
        list.back().index = number(constant_value(to.index).value_or(0) + static_cast<double>(k));
      }
    }
    return list;
  }

  /// Variables whose values come from outside the program: from an earlier one, or from the control's own definitions.
  void report_persistence() {
    const CallGraph calls(program_);
    ReadFirst reads(program_, calls, true);
    std::string lost, elsewhere;
    const auto note = [&](const std::string& from, const VarRef& to) {
      std::string& list = pools_.persistent(to) ? elsewhere : lost;
      list += (list.empty() ? "" : ", ") + from + " (" + target_name(to) + ")";
    };
    if (program_.routines.empty()) return;
    for (const auto& [key, to] : places_) {
      const VarRef from{key.first, {}, number(static_cast<double>(key.second)), {}};
      const auto* segment = segment_of(program_, from);
      if (segment != nullptr && segment->persistent && reads(0, from)) note(variable_name(key.first, key.second), to);
    }
    for (const auto& [key, to] : named_places_) {
      const auto& space = program_.spaces[key.first];
      const bool outside = space.scope == Scope::global && key.second.find('@') == std::string::npos;
      if (outside && reads(0, VarRef{key.first, key.second, nullptr, {}})) note(key.second, to);
    }
    if (!lost.empty()) {
      context_.diagnostics.warning(
          "TRN-131", {},
          "read before they are written: " + lost +
              "; the source takes the value of an earlier program, the target starts without it",
          "set them at the start of the program");
    }
    if (!elsewhere.empty()) {
      context_.diagnostics.note("TRN-131", {},
                                "read before they are written: " + elsewhere +
                                    "; the source takes the value that its variable has from earlier, the target the "
                                    "one of the variable in brackets",
                                "bring the values over, or set them at the start of the program");
    }
  }

  void finish() {
    std::vector<std::string> head;
    for (const auto& [key, to] : places_) {
      const std::string from = variable_name(key.first, key.second), name = target_name(to);
      report(from, name, {});
      note_place(from, to, 1);
      if (constant_index(to) != key.second) head.push_back(from + "=" + name);
    }
    for (const auto& [key, to] : named_places_) {
      const auto at = key.second.find('@');
      const std::string plain = key.second.substr(0, at), name = target_name(to);
      const std::string owner = at == std::string::npos ? "" : key.second.substr(at + 1);
      report(plain, name, owner);
      const bool own = owner == "arguments" || plain.find("_OF_CALLER") != std::string::npos || !to.name.empty();
      if (!own) note_place(key.second, to, use_.named.at(key).elements());
      if (own || preferred_number(key.second) == constant_index(to)) continue;
      head.push_back(owner.empty() || owner == "0" ? plain + "=" + name : plain + "(" + owner + ")=" + name);
    }
    for (const auto& [key, to] : local_) {
      const Routine& r = program_.routines[key.first];
      const std::string name = target_name(to);
      report(key.second, name, routine_tag(r));
      head.push_back(r.kind == RoutineKind::main ? key.second + "=" + name
                                                 : key.second + "(" + routine_tag(r) + ")=" + name);
    }
    std::vector<VariableSpace> spaces = context_.target.spaces;
    program_.spaces = std::move(spaces);
    for (const auto& [key, names] : declared_)
      declare_at_top(program_.routines[key.first], key.second, local_space(key.second), names);
    put_variable_table(program_, head, zero_first_);
  }
  /// The target's names of routines of that type.
  SpaceId local_space(Type type) const {
    const auto& spaces = context_.target.spaces;
    for (std::size_t i = 0; i < spaces.size(); ++i) {
      if (spaces[i].named() && spaces[i].scope == Scope::routine && spaces[i].type == type)
        return static_cast<SpaceId>(i);
    }
    return 0;
  }
  std::string target_name(const VarRef& v) const {
    if (!v.name.empty()) return v.name;
    const auto n = constant_index(v);
    return context_.target.spaces[v.space].prefix + (n ? std::to_string(*n) : std::string("?"));
  }
  void report(const std::string& from, const std::string& to, const std::string& routine) const {
    if (context_.report != nullptr) {
      context_.report->renamed.push_back({Renamed::Kind::variable, from, to, routine == "0" ? "" : routine});
    }
  }

  void note_place(const std::string& from, const VarRef& to, std::int64_t size) const {
    if (context_.report != nullptr)
      context_.report->names.variables[name_in_map(from)] = place_in_map(target_name(to), size);
  }

  Program& program_;
  const LegaliseContext& context_;
  VariableNames compensated_;
  VariableUse use_;
  VariablePools pools_;
  GivenNames given_;
  std::vector<std::string> left_over_;  ///< no variable of the target is free for them
  std::map<std::pair<SpaceId, std::int64_t>, VarRef> places_;
  std::map<SpaceId, std::int64_t> shift_;
  std::map<SpaceId, SpaceId> shifted_space_;
  std::map<std::pair<std::size_t, std::string>, VarRef> local_;
  std::map<NamedKey, VarRef> named_places_;
  std::map<std::pair<std::size_t, Type>, std::vector<std::string>> declared_;
  std::vector<VarRef> zero_first_;
  Span at_;  ///< of the statement at hand
};

}  // namespace

void map_variables(Program& program, const LegaliseContext& context) {
  if (!same_spaces(program, context)) VariableMap(program, context).run();
}

}  // namespace cnctrans::ir::passes
