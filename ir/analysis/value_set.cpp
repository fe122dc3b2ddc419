#include "ir/analysis/value_set.h"

#include <algorithm>

#include "base/text.h"

namespace cnctrans::ir {

namespace {

using Values = std::optional<std::vector<double>>;
constexpr std::size_t most_values = 64;
constexpr int deepest = 8;  ///< variables set from variables; also what ends a circle

Values values_of(const Program& program, const ExprPtr& e, int depth);

/// Looks through a program for everything that can set one variable.
class Writers {
 public:
  Writers(const Program& program, const VarRef& v, int depth) : program_(program), wanted_(v), depth_(depth) {}

  std::optional<std::vector<double>> values() {
    if (!wanted_.indices.empty()) return std::nullopt;
    if (!wanted_.name.empty()) {
      named_ = true;
    } else {
      const auto n = constant_value(wanted_.index);
      if (!n) return std::nullopt;
      number_ = *n;
    }
    for (const auto& r : program_.routines) {
      for (const auto& p : r.parameters) {
        if (same(p.variable)) return std::nullopt;
      }
      for_each_statement(r.body, [this](const Statement& s) { look_at(s); });
    }
    if (open_ || values_.empty() || values_.size() > most_values) return std::nullopt;
    std::sort(values_.begin(), values_.end());
    values_.erase(std::unique(values_.begin(), values_.end()), values_.end());
    return values_;
  }

 private:
  [[nodiscard]] bool same(const VarRef& v) {
    if (v.space != wanted_.space) return false;
    if (named_) return iequals_ascii(v.name, wanted_.name);
    if (!v.name.empty() || !v.index) return false;
    const auto n = constant_value(v.index);
    if (!n) open_ = true;  // a computed number may mean this variable
    return n && *n == number_;
  }
  void set(const ExprPtr& value) {
    const Values v = open_ ? std::nullopt : values_of(program_, value, depth_ + 1);
    if (v) {
      values_.insert(values_.end(), v->begin(), v->end());
    } else {
      open_ = true;
    }
  }
  void look_at(const Statement& s) {
    if (const auto* a = std::get_if<Assign>(&s.node)) {
      for (const auto& item : a->items) {
        if (!item.to_system && same(item.target)) set(item.value);
      }
    } else if (const auto* f = std::get_if<For>(&s.node)) {
      if (same(f->counter)) open_ = true;
    } else if (const auto* d = std::get_if<Declare>(&s.node)) {
      for (const auto& item : d->items) {
        if (!named_ || d->space != wanted_.space || !iequals_ascii(item.name, wanted_.name)) continue;
        if (item.initial.empty()) {
          values_.push_back(0);
        } else {
          set(item.initial.front());
        }
      }
    } else if (const auto* c = std::get_if<CallRoutine>(&s.node)) {
      look_at(*c);
    } else if (const auto* m = std::get_if<ModalCall>(&s.node)) {
      look_at(m->call);
    }
  }
  /// Arguments set local parameters of the callee: by letter, or by reference.
  void look_at(const CallRoutine& c) {
    for (const auto& a : c.arguments) {
      if (a.by_reference && same(a.reference)) open_ = true;
      const bool letter = a.name.size() == 1 && a.name[0] >= 'A' && a.name[0] <= 'Z';
      if (!named_ && letter && a.name[0] - 'A' == number_) open_ = true;
    }
  }

  const Program& program_;
  const VarRef& wanted_;
  int depth_;
  bool named_ = false;
  double number_ = 0;
  bool open_ = false;
  std::vector<double> values_;
};

Values combined(const Program& program, const Binary& b, int depth) {
  const Values left = values_of(program, b.left, depth);
  const Values right = left ? values_of(program, b.right, depth) : std::nullopt;
  if (!left || !right || left->size() * right->size() > most_values) return std::nullopt;
  std::vector<double> out;
  for (const double l : *left) {
    for (const double r : *right) {
      const auto v = constant_value(binary(b.op, number(l), number(r), b.compare));
      if (!v) return std::nullopt;
      out.push_back(*v);
    }
  }
  return out;
}

Values values_of(const Program& program, const ExprPtr& e, int depth) {
  if (!e || depth > deepest) return std::nullopt;
  if (const auto n = constant_value(e)) return std::vector<double>{*n};
  if (const auto* v = std::get_if<VarRef>(&e->node)) return Writers(program, *v, depth).values();
  if (const auto* b = std::get_if<Binary>(&e->node)) return combined(program, *b, depth);
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<double>> possible_values(const Program& program, const ExprPtr& e) {
  return values_of(program, e, 0);
}

ComputedLabel::ComputedLabel(const Program& program, const LabelRef& l)
    : values_(possible_values(program, l.computed)) {}

bool ComputedLabel::may_be(std::string_view label, bool is_number) const {
  if (!values_) return true;
  if (!is_number) return false;
  const auto n = parse_decimal(label);
  return n && std::find(values_->begin(), values_->end(), *n) != values_->end();
}

}  // namespace cnctrans::ir
