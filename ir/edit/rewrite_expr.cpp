#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::ir::passes {

namespace {

bool map_list(const std::vector<ExprPtr>& from, std::vector<ExprPtr>& to, const ExprMap& change) {
  bool changed = false;
  to.reserve(from.size());
  for (const auto& e : from) {
    to.push_back(map_expr(e, change));
    changed = changed || to.back() != e;
  }
  return changed;
}

/// The node with mapped children, or null when nothing changed.
struct MapChildren {
  const ExprMap& change;
  using Node = decltype(Expr::node);
  std::optional<Node> operator()(const Number&) const { return std::nullopt; }
  std::optional<Node> operator()(const String&) const { return std::nullopt; }
  std::optional<Node> operator()(const AxisName&) const { return std::nullopt; }
  std::optional<Node> operator()(const VarRef& v) const {
    VarRef copy{v.space, v.name, map_expr(v.index, change), {}};
    const bool list = map_list(v.indices, copy.indices, change);
    if (!list && copy.index == v.index) return std::nullopt;
    return copy;
  }
  std::optional<Node> operator()(const SystemRef& s) const {
    SystemRef copy = s;
    copy.args.clear();
    if (!map_list(s.args, copy.args, change)) return std::nullopt;
    return copy;
  }
  std::optional<Node> operator()(const Unary& u) const {
    ExprPtr operand = map_expr(u.operand, change);
    if (operand == u.operand) return std::nullopt;
    return Unary{u.op, std::move(operand)};
  }
  std::optional<Node> operator()(const Binary& b) const {
    ExprPtr left = map_expr(b.left, change), right = map_expr(b.right, change);
    if (left == b.left && right == b.right) return std::nullopt;
    return Binary{b.op, std::move(left), std::move(right), b.compare};
  }
  std::optional<Node> operator()(const Call& c) const {
    Call copy{c.function, {}, c.half};
    if (!map_list(c.args, copy.args, change)) return std::nullopt;
    return copy;
  }
};

}  // namespace

ExprPtr map_expr(const ExprPtr& e, const ExprMap& change) {
  if (!e) return e;
  auto node = std::visit(MapChildren{change}, e->node);
  if (!node) return change(e);
  Expr copy = *e;
  copy.node = std::move(*node);
  return change(std::make_shared<const Expr>(std::move(copy)));
}

std::optional<std::int64_t> constant_index(const VarRef& ref) {
  const auto v = constant_value(ref.index);
  if (!v || !std::isfinite(*v) || std::fabs(*v) > 1e15) return std::nullopt;
  return static_cast<std::int64_t>(std::llround(*v));
}

bool same_variable(const VarRef& a, const VarRef& b) {
  if (a.space != b.space || a.name != b.name || a.indices.size() != b.indices.size()) return false;
  if (!equal(a.index, b.index)) return false;
  for (std::size_t i = 0; i < a.indices.size(); ++i) {
    if (!equal(a.indices[i], b.indices[i])) return false;
  }
  return true;
}

bool reads(const ExprPtr& e, const VarRef& ref) {
  bool found = false;
  walk(e, [&](const ExprPtr& n) {
    const auto* v = std::get_if<VarRef>(&n->node);
    if (v == nullptr || v->space != ref.space || v->name != ref.name) return;
    const auto a = constant_index(*v), b = constant_index(ref);
    if (v->index && ref.index && a && b && *a != *b) return;
    found = true;
  });
  return found;
}

bool is_primary(const ExprPtr& e) {
  return !e || std::holds_alternative<Number>(e->node) || std::holds_alternative<VarRef>(e->node) ||
         std::holds_alternative<SystemRef>(e->node) || std::holds_alternative<String>(e->node) ||
         std::holds_alternative<AxisName>(e->node);
}

const Number* as_number(const ExprPtr& e) {
  return e ? std::get_if<Number>(&e->node) : nullptr;
}
const VarRef* as_variable(const ExprPtr& e) {
  return e ? std::get_if<VarRef>(&e->node) : nullptr;
}

std::string quoted(std::string_view name) {
  return "'" + std::string(name) + "'";
}

std::string variable_text(const VarRef& ref, const Program& program) {
  if (!ref.name.empty()) return ref.name;
  const std::string prefix = ref.space < program.spaces.size() ? program.spaces[ref.space].prefix : std::string("?");
  const auto n = constant_index(ref);
  return n ? prefix + std::to_string(*n) : prefix + "(...)";
}

LabelRef label_of(std::string text, bool is_number) {
  if (is_number) {
    const auto first = text.find_first_not_of('0');
    text = first == std::string::npos ? "0" : text.substr(first);
  } else {
    text = to_upper_ascii(text);
  }
  return LabelRef{std::move(text), is_number, nullptr};
}

std::vector<LabelRef> labels_on(const LineInfo& line) {
  std::vector<LabelRef> list;
  if (!line.number.empty()) list.push_back(label_of(std::string(line.number), true));
  for (const auto l : line.labels) list.push_back(label_of(std::string(l), false));
  return list;
}

bool same_label(const LabelRef& a, const LabelRef& b) {
  return !a.computed && !b.computed && a.is_number == b.is_number && a.text == b.text;
}

std::string label_text(const LabelRef& label) {
  return label.is_number ? "N" + label.text : label.text;
}

}  // namespace cnctrans::ir::passes
