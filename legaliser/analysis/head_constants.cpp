#include "legaliser/analysis/head_constants.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.h"

namespace cnctrans::ir::passes {

namespace {

bool straight(const Statement& s) {
  const auto* o = std::get_if<Opaque>(&s.node);
  return std::holds_alternative<Block>(s.node) || std::holds_alternative<Assign>(s.node) ||
         std::holds_alternative<Message>(s.node) || std::holds_alternative<Declare>(s.node) ||
         std::holds_alternative<Label>(s.node) || (o != nullptr && o->harmless);
}

/// Every routine sees the same variable.
bool shared(const VariableSpace& space, std::int64_t n) {
  if (space.named()) return space.scope == Scope::global;
  return std::any_of(space.segments.begin(), space.segments.end(), [n](const SpaceSegment& part) {
    return n >= part.lo && n <= part.hi && part.scope == Scope::global;
  });
}

/// Something that may write variables without showing them.
bool opaque_write(const Program& program, const Statement& s) {
  const auto* o = std::get_if<Opaque>(&s.node);
  if (o != nullptr) return !o->harmless;
  const auto* c = std::get_if<CallRoutine>(&s.node);
  if (c == nullptr) return false;
  if (c->computed) return true;
  for (const auto& r : program.routines) {
    if (r.name == c->routine) return false;
  }
  return true;
}

}  // namespace

std::string listed(const std::map<std::string, double>& values) {
  std::string out;
  for (const auto& [name, value] : values) out += (out.empty() ? "" : ", ") + name + '=' + shortest(value);
  return out;
}

std::optional<HeadConstants::Key> HeadConstants::key_of(const VarRef& v) {
  if (!v.indices.empty()) return std::nullopt;
  if (!v.index) return v.name.empty() ? std::nullopt : std::optional(Key{v.space, v.name, 0});
  const auto n = constant_index(v);
  return n ? std::optional(Key{v.space, v.name, *n}) : std::nullopt;
}

HeadConstants::HeadConstants(const Program& program) : program_(program) {
  const auto main = std::find_if(program.routines.begin(), program.routines.end(),
                                 [](const Routine& r) { return r.kind == RoutineKind::main; });
  if (main == program.routines.end()) return;
  do {
    known_.clear();
    look_at_head(*main);
  } while (!known_.empty() && forget_written_elsewhere());
}

void HeadConstants::look_at_head(const Routine& main) {
  const auto keep = [this](const Key& key, const Known& value) {
    if (changing_.count(key) == 0) known_[key] = value;
  };
  for (const auto& s : main.body) {
    if (!straight(s)) break;
    if (const auto* d = std::get_if<Declare>(&s.node); d != nullptr && s.line.skip_mask == 0) {
      for (const auto& item : d->items) {
        const auto n =
            item.dimensions.empty() && item.initial.size() == 1 ? constant_value(item.initial[0]) : std::nullopt;
        if (n) keep(Key{d->space, item.name, 0}, {*n, s.line.span.line, 0});
      }
    }
    const auto* a = std::get_if<Assign>(&s.node);
    if (a == nullptr) continue;
    Statement behind;  // the assignments of a line follow each other
    behind.line.span.line = s.line.span.line + 1;
    for (const auto& item : a->items) {
      const auto key = item.to_system ? std::nullopt : key_of(item.target);
      if (!key) continue;
      const Value v = fold(Value(item.value), main, behind);
      const auto n = v.literal() ? std::optional(v.number) : constant_value(v.expr);
      if (n && s.line.skip_mask == 0)
        keep(*key, {*n, s.line.span.line, 1});
      else
        known_.erase(*key);
    }
  }
}

bool HeadConstants::forget_written_elsewhere() {
  std::map<Key, int> writes;
  std::set<SpaceId> anywhere;
  bool hidden = false;
  const auto wrote = [&](const VarRef& v) {
    if (const auto key = key_of(v))
      ++writes[*key];
    else
      anywhere.insert(v.space);
  };
  for (const auto& r : program_.routines) {
    for (const auto& p : r.parameters) {
      wrote(p.variable);
      wrote(p.variable);
    }
    for_each_statement(r.body, [&](const Statement& s) {
      hidden = hidden || opaque_write(program_, s);
      each_target(s, wrote);
      if (!std::holds_alternative<CallRoutine>(s.node) && !std::holds_alternative<ModalCall>(s.node)) return;
      each_expression(s, [&](const ExprPtr& e) {  // it may be given by reference
        if (const auto* v = as_variable(e)) {
          wrote(*v);
          wrote(*v);
        }
      });
    });
  }
  if (hidden) known_.clear();
  return std::erase_if(known_, [&](const auto& k) {
           const auto it = writes.find(k.first);
           const bool gone =
               (it != writes.end() && it->second > k.second.writes) || anywhere.count(std::get<0>(k.first)) != 0;
           if (gone) changing_.insert(k.first);
           return gone;
         }) != 0;
}

Value HeadConstants::fold(const Value& v, const Routine& routine, const Statement& at,
                          std::map<std::string, double>* used) const {
  if (v.literal() || known_.empty()) return v;
  const bool main = routine.kind == RoutineKind::main;
  const ExprPtr e = map_expr(v.expr, [&](const ExprPtr& node) -> ExprPtr {
    const auto* ref = as_variable(node);
    const auto key = ref == nullptr ? std::nullopt : key_of(*ref);
    const auto it = key ? known_.find(*key) : known_.end();
    if (it == known_.end()) return node;
    const bool whole = node->type == Type::integer || node->type == Type::boolean;  // it may have been rounded
    if (whole && it->second.value != std::round(it->second.value)) return node;
    const auto& space = program_.spaces[ref->space];
    // Elsewhere a variable of the same name may be another one.
    if (main ? it->second.line >= at.line.span.line : !shared(space, std::get<2>(*key))) return node;
    if (used != nullptr)
      (*used)[space.named() ? ref->name : space.prefix + std::to_string(std::get<2>(*key))] = it->second.value;
    return number(it->second.value);
  });
  const auto n = constant_value(e);
  return n ? Value(*n) : Value(e);
}

std::optional<double> HeadConstants::count(const ExprPtr& times, const Routine& routine, const Statement& at) const {
  const auto* rounded = std::get_if<Call>(&times->node);
  const bool whole = rounded != nullptr && rounded->function == Function::to_integer && !rounded->args.empty();
  const Value v = fold(Value(whole ? rounded->args.front() : times), routine, at);
  return v.literal() ? std::optional(v.number) : constant_value(v.expr);
}

}  // namespace cnctrans::ir::passes
