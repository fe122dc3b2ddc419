// Compiling expressions; places of variables.
#include "interpreter/values/expressions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

namespace {

bool gives_text(ir::Function f) {
  switch (f) {
    case ir::Function::to_string:
    case ir::Function::upper_case:
    case ir::Function::lower_case:
    case ir::Function::character:
    case ir::Function::axis_text:
    case ir::Function::substring: return true;
    default: return false;
  }
}

}  // namespace

ExprId Evaluator::add(const Node& n) {
  nodes_.push_back(n);
  return static_cast<ExprId>(nodes_.size() - 1);
}

ExprId Evaluator::fault(std::string text) {
  Node n;
  n.kind = Kind::fault;
  n.a = static_cast<std::uint32_t>(texts_.size());
  texts_.push_back(std::move(text));
  return add(n);
}

std::uint32_t Evaluator::compile_list(const std::vector<ir::ExprPtr>& list, const NameScope& scope) {
  std::vector<ExprId> ids;
  for (const auto& e : list) ids.push_back(e ? compile(*e, scope) : fault("an argument is missing"));
  const auto first = static_cast<std::uint32_t>(children_.size());
  children_.insert(children_.end(), ids.begin(), ids.end());
  return first;
}

/// A variable that is no local of the routine. Where names need no declaration it exists from here on.
NamedVariable& Evaluator::global_of(const ir::VarRef& v, const NameScope& scope) {
  const auto& spaces = scope.program->spaces;
  const auto* space = v.space < spaces.size() ? &spaces[v.space] : nullptr;
  auto& global = variables_.global(v.name, space != nullptr ? space->type : ir::Type::real);
  if (space == nullptr || space->scope != ir::Scope::routine) global.declared = true;
  return global;
}

ExprId Evaluator::compile_variable(const ir::VarRef& v, const NameScope& scope) {
  Node n;
  auto* space = v.space < scope.spaces->size() ? (*scope.spaces)[v.space] : nullptr;
  if (space != nullptr && v.name.empty()) {
    n.what = space;
    const auto index = ir::constant_value(v.index);
    if (!index) {
      n.kind = Kind::computed_number;
      n.a = v.index ? compile(*v.index, scope) : fault("the variable has no number");
      return add(n);
    }
    const auto* number = space->find(*index);
    if (number == nullptr) return fault("there is no variable " + space->prefix + number_text(*index));
    n.a = static_cast<std::uint32_t>(*index);
    n.kind = number->where == NumberedSpace::Where::level ? Kind::level_number : Kind::global_number;
    return add(n);
  }
  n.b = static_cast<std::uint32_t>(v.indices.size());
  n.a = compile_list(v.indices, scope);
  if (const auto it = scope.locals.find(v.name); it != scope.locals.end()) {
    n.kind = Kind::local;
    n.value = it->second.index;
    n.is_text = it->second.is_text;
    return add(n);
  }
  n.kind = Kind::global_name;
  auto& global = global_of(v, scope);
  n.what = &global;
  n.is_text = global.is_text();
  return add(n);
}

ExprId Evaluator::compile_call(const ir::Call& c, const NameScope& scope) {
  Node n;
  if (c.function == ir::Function::frame_part) {
    n.kind = Kind::frame_part;
    n.what = &c;
    return add(n);
  }
  n.kind = Kind::function;
  n.op = static_cast<std::uint8_t>(c.function);
  n.attribute = static_cast<std::uint8_t>(c.half);
  n.b = static_cast<std::uint32_t>(c.args.size());
  n.a = compile_list(c.args, scope);
  n.is_text = gives_text(c.function);
  return add(n);
}

ExprId Evaluator::compile(const ir::Expr& e, const NameScope& scope) {
  Node n;
  if (const auto* number = std::get_if<ir::Number>(&e.node)) {
    n.value = number->value;
    return add(n);
  }
  if (const auto* string = std::get_if<ir::String>(&e.node)) {
    n.kind = Kind::text;
    n.is_text = true;
    n.a = static_cast<std::uint32_t>(texts_.size());
    texts_.push_back(string->text);
    return add(n);
  }
  if (const auto* axis = std::get_if<ir::AxisName>(&e.node)) {
    n.value = axis->axis;
    return add(n);
  }
  if (const auto* v = std::get_if<ir::VarRef>(&e.node)) return compile_variable(*v, scope);
  if (const auto* s = std::get_if<ir::SystemRef>(&e.node)) {
    n.kind = Kind::system;
    n.what = s;
    n.b = static_cast<std::uint32_t>(s->args.size());
    n.a = compile_list(s->args, scope);
    return add(n);
  }
  if (const auto* u = std::get_if<ir::Unary>(&e.node)) {
    n.kind = Kind::unary;
    n.op = static_cast<std::uint8_t>(u->op);
    n.a = compile(*u->operand, scope);
    return add(n);
  }
  if (const auto* b = std::get_if<ir::Binary>(&e.node)) {
    n.kind = Kind::binary;
    n.op = static_cast<std::uint8_t>(b->op);
    n.attribute = static_cast<std::uint8_t>(b->compare);
    n.is_text = b->op == ir::BinaryOp::concat;
    n.a = compile(*b->left, scope);
    n.b = compile(*b->right, scope);
    return add(n);
  }
  return compile_call(std::get<ir::Call>(e.node), scope);
}

bool Evaluator::named_place(NamedVariable& v, std::span<const double> indices, Place& out) {
  if (indices.size() != v.dimensions.size()) {
    return failure_.fail(code::array_index, "variable " + v.name + " takes " + std::to_string(v.dimensions.size()) +
                                                " indices, not " + std::to_string(indices.size()));
  }
  std::uint32_t flat = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const double x = std::round(indices[i]);
    if (!(x >= 0) || x >= v.dimensions[i]) {
      return failure_.fail(code::array_index, "index " + number_text(x) + " of " + v.name + " is outside 0.." +
                                                  std::to_string(v.dimensions[i] - 1));
    }
    flat = flat * v.dimensions[i] + static_cast<std::uint32_t>(x);
  }
  out = Place{};
  out.named = &v;
  out.index = flat;
  return true;
}

bool Evaluator::local_place(std::size_t local, std::span<const double> indices, Place& out) {
  auto& l = (*locals_)[local];
  if (!l.reference) return named_place(l.own, indices, out);
  if (indices.empty()) {
    out = l.target;
    return true;
  }
  if (l.target.named == nullptr) return failure_.fail(code::wrong_type, l.own.name + " is not an array here");
  return named_place(*l.target.named, indices, out);
}

bool Evaluator::global_place(NamedVariable& v, std::span<const double> indices, Place& out) {
  if (!v.declared && v.set[0] == 0) return failure_.fail(code::no_variable, "variable " + v.name + " is not defined");
  return named_place(v, indices, out);
}

bool Evaluator::node_place(const Node& n, Place& out) {
  std::array<double, 8> indices{};
  const std::size_t count = std::min<std::size_t>(n.b, indices.size());
  for (std::size_t i = 0; i < count; ++i) indices[i] = number(children_[n.a + i]);
  if (failure_.set) return false;
  const std::span<const double> list(indices.data(), count);
  if (n.kind == Kind::local) return local_place(static_cast<std::size_t>(n.value), list, out);
  return global_place(*const_cast<NamedVariable*>(static_cast<const NamedVariable*>(n.what)), list, out);
}

bool Evaluator::place(const ir::VarRef& ref, const NameScope& scope, Place& out, bool whole) {
  auto* space = ref.space < scope.spaces->size() ? (*scope.spaces)[ref.space] : nullptr;
  if (space != nullptr && ref.name.empty()) {
    const auto* literal = ref.index ? std::get_if<ir::Number>(&ref.index->node) : nullptr;
    const double n = literal != nullptr ? literal->value : (ref.index ? number_of(ref.index) : -1);
    if (failure_.set) return false;
    const auto* number = space->find(n);
    if (number != nullptr && number->read_only) {
      return failure_.fail(code::read_only, "variable " + space->prefix + number_text(n) + " can only be read");
    }
    return variables_.place(*space, n, out);
  }
  std::array<double, 8> indices{};
  const std::size_t count = std::min(ref.indices.size(), indices.size());
  for (std::size_t i = 0; i < count; ++i) indices[i] = number_of(ref.indices[i]);
  if (failure_.set) return false;
  const std::span<const double> list(indices.data(), count);
  const auto it = scope.locals.find(ref.name);
  if (whole && list.empty()) {
    out = Place{};
    auto* local = it != scope.locals.end() ? &(*locals_)[it->second.index] : nullptr;
    if (local != nullptr && local->reference) {
      out = local->target;
    } else {
      out.named = local != nullptr ? &local->own : &global_of(ref, scope);
    }
    return true;
  }
  if (it != scope.locals.end()) return local_place(it->second.index, list, out);
  return global_place(global_of(ref, scope), list, out);
}

bool Evaluator::assign(const Place& p, ExprId value) {
  const bool to_text = p.named != nullptr && p.named->is_text();
  if (to_text) {
    auto t = text(value);
    if (failure_.set) return false;
    variables_.store(p, std::move(t));
    return true;
  }
  const double x = number(value);
  return !failure_.set && variables_.store(p, x);
}

std::span<const double> Evaluator::arguments(const ir::SystemRef& ref) {
  std::vector<double> values;
  for (const auto& a : ref.args) values.push_back(number_of(a));
  arguments_ = std::move(values);
  return arguments_;
}

Evaluator::CacheEntry& Evaluator::cache_slot(const ir::Expr* e) {
  if (cache_.size() < 2 * (cached_ + 1)) {
    std::vector<CacheEntry> old(std::max<std::size_t>(64, cache_.size() * 2));
    old.swap(cache_);
    cached_ = 0;
    for (const auto& entry : old) {
      if (entry.expr == nullptr) continue;
      auto at = reinterpret_cast<std::uintptr_t>(entry.expr) >> 4U;
      while (cache_[at & (cache_.size() - 1)].expr != nullptr) ++at;
      cache_[at & (cache_.size() - 1)] = entry;
      ++cached_;
    }
  }
  auto at = reinterpret_cast<std::uintptr_t>(e) >> 4U;
  while (true) {
    auto& entry = cache_[at & (cache_.size() - 1)];
    if (entry.expr == nullptr || (entry.expr == e && entry.scope == scope_)) return entry;
    ++at;
  }
}

ExprId Evaluator::id_of(const ir::ExprPtr& e) {
  const auto& entry = cache_slot(e.get());
  if (entry.expr != nullptr) return entry.id;
  const auto id = compile(*e, *scope_);
  cache_slot(e.get()) = CacheEntry{e.get(), scope_, id};
  ++cached_;
  return id;
}

double Evaluator::number_of(const ir::ExprPtr& e) {
  return number(id_of(e));
}

}  // namespace cnctrans::interpreter
