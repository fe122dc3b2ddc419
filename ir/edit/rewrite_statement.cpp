#include "ir/edit/rewrite.h"
#include "ir/text/text.h"

namespace cnctrans::ir::passes {

namespace {

/// One walk serves changing and reading: `expr` may replace the expression, `target` may change a written variable.
template <class S, class OnExpr, class OnTarget>
struct StatementParts {
  const OnExpr& expr;
  const OnTarget& target;

  template <class E>
  void one(E& e) const {
    if (e) expr(e);
  }
  template <class V>
  void var(V& v) const {
    target(v);
    one(v.index);
    for (auto& i : v.indices) one(i);
  }
  template <class L>
  void label(L& l) const {
    one(l.computed);
  }
  template <class J>
  void jump(J& j) const {
    label(j.target);
    one(j.condition);
  }
  template <class C>
  void call(C& c) const {
    one(c.computed);
    for (auto& a : c.arguments) {
      one(a.value);
      if (a.by_reference) var(a.reference);
    }
    label(c.first);
    label(c.last);
    one(c.count);
  }
  template <class N>
  void visit(N& node) const {
    if (auto* a = std::get_if<Assign>(&node)) {
      for (auto& i : a->items) {
        if (i.to_system) {
          for (auto& x : i.system.args) one(x);
        } else {
          var(i.target);
        }
        one(i.value);
      }
    } else if (auto* c = std::get_if<If>(&node)) {
      one(c->condition);
    } else if (auto* w = std::get_if<While>(&node)) {
      one(w->condition);
    } else if (auto* u = std::get_if<Until>(&node)) {
      one(u->condition);
    } else if (auto* f = std::get_if<For>(&node)) {
      var(f->counter);
      one(f->from);
      one(f->to);
      one(f->step);
    } else {
      visit_rest(node);
    }
  }
  template <class N>
  void visit_rest(N& node) const {
    if (auto* j = std::get_if<Jump>(&node)) {
      jump(*j);
    } else if (auto* sw = std::get_if<Switch>(&node)) {
      one(sw->value);
      for (auto& [value, to] : sw->cases) {
        one(value);
        jump(to);
      }
      for (auto& to : sw->fallback) jump(to);
    } else if (auto* r = std::get_if<Repeat>(&node)) {
      label(r->first);
      label(r->last);
      one(r->count);
    } else if (auto* c = std::get_if<CallRoutine>(&node)) {
      call(*c);
    } else if (auto* m = std::get_if<ModalCall>(&node)) {
      call(m->call);
    } else if (auto* ret = std::get_if<Return>(&node)) {
      for (auto& v : ret->values) one(v);
    } else if (auto* msg = std::get_if<Message>(&node)) {
      for (auto& p : msg->parts) one(p);
      one(msg->number);
    } else if (auto* d = std::get_if<Declare>(&node)) {
      for (auto& i : d->items) {
        for (auto& x : i.dimensions) one(x);
        for (auto& x : i.initial) one(x);
      }
    }
  }
};

void read_block(const Block& block, const std::function<void(const ExprPtr&)>& visit) {
  if (!has_expression(block)) return;
  Block copy = block;
  visit_values(copy, [&visit](Value& v, const Place&) {
    if (v.expr) visit(v.expr);
    return false;
  });
}

/// A word whose expression becomes a number is a word with that number.
bool change_value(Value& v, const std::function<ExprPtr(const ExprPtr&)>& change) {
  if (!v.expr) return false;
  ExprPtr made = change(v.expr);
  const Number* number = made != v.expr ? as_number(made) : nullptr;
  v = number != nullptr ? Value(number->value) : Value(std::move(made));
  return true;
}

void change_cycle(CyclePtr& cycle, const std::function<ExprPtr(const ExprPtr&)>& change) {
  if (!cycle) return;
  auto copy = std::make_shared<Cycle>(*cycle);
  bool changed = false;
  visit_values(
      *copy, [&change](Value& v, const Place&) { return change_value(v, change); }, changed);
  if (changed) cycle = std::move(copy);
}

}  // namespace

void visit_statement(Statement& s, const StatementVisitor& visit) {
  if (auto* block = std::get_if<Block>(&s.node)) {
    if (!has_expression(*block)) return;
    visit_values(*block, [&visit](Value& v, const Place&) { return change_value(v, visit.expression); });
    return;
  }
  if (auto* modal = std::get_if<ModalCall>(&s.node)) change_cycle(modal->cycle, visit.expression);
  const auto on_expr = [&visit](ExprPtr& e) { e = visit.expression(e); };
  const auto on_target = [&visit](VarRef& v) {
    if (visit.target) visit.target(v);
  };
  StatementParts<Statement, decltype(on_expr), decltype(on_target)>{on_expr, on_target}.visit(s.node);
}

void each_expression(const Statement& s, const std::function<void(const ExprPtr&)>& visit) {
  if (const auto* block = std::get_if<Block>(&s.node)) return read_block(*block, visit);
  if (const auto* modal = std::get_if<ModalCall>(&s.node); modal != nullptr && modal->cycle) {
    Cycle copy = *modal->cycle;
    bool changed = false;
    visit_values(
        copy,
        [&visit](Value& v, const Place&) {
          if (v.expr) visit(v.expr);
          return false;
        },
        changed);
  }
  const auto on_expr = [&visit](const ExprPtr& e) { visit(e); };
  const auto on_target = [](const VarRef&) {};
  StatementParts<const Statement, decltype(on_expr), decltype(on_target)>{on_expr, on_target}.visit(s.node);
}

void each_target(const Statement& s, const std::function<void(const VarRef&)>& visit) {
  if (std::holds_alternative<Block>(s.node)) return;
  const auto on_expr = [](const ExprPtr&) {};
  const auto on_target = [&visit](const VarRef& v) { visit(v); };
  StatementParts<const Statement, decltype(on_expr), decltype(on_target)>{on_expr, on_target}.visit(s.node);
}

void each_body(Statement& s, const std::function<void(Body&)>& visit) {
  if (auto* i = std::get_if<If>(&s.node)) {
    visit(i->then_body);
    visit(i->else_body);
  } else if (auto* w = std::get_if<While>(&s.node)) {
    visit(w->body);
  } else if (auto* u = std::get_if<Until>(&s.node)) {
    visit(u->body);
  } else if (auto* f = std::get_if<For>(&s.node)) {
    visit(f->body);
  } else if (auto* l = std::get_if<Loop>(&s.node)) {
    visit(l->body);
  }
}

Statement make_assign(const LineInfo& like, VarRef target, ExprPtr value) {
  Assign a;
  Assign::Item item;
  item.target = std::move(target);
  item.value = std::move(value);
  a.items.push_back(std::move(item));
  return made(like, std::move(a));
}

Statement make_jump(const LineInfo& like, const LabelRef& target, ExprPtr condition) {
  Jump j;
  j.target = target;
  j.condition = std::move(condition);
  return made(like, std::move(j));
}

void set_label(LineInfo& line, const LabelRef& label, Program& program) {
  if (label.is_number) {
    line.number = program.keep(label.text);
  } else {
    line.labels.push_back(program.keep(label.text));
  }
}

Statement make_label(const LineInfo& like, const LabelRef& label, Program& program) {
  Statement s = made(like, Label{});
  s.line.skip_mask = 0;  // a mark that is skipped would be missed by nobody, but it must be found
  set_label(s.line, label, program);
  return s;
}

Statement make_comment(std::string text, Program& program) {
  Statement s;
  s.node = Block{};
  CommentText c;
  c.text = program.keep(std::move(text));
  c.place = CommentPlace::own_line;
  s.line.comments.push_back(c);
  return s;
}

bool is_remark(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  const bool nothing = std::holds_alternative<Label>(s.node) || (b != nullptr && b->empty() && b->repeat_given == 0);
  return nothing && s.line.number.empty() && s.line.labels.empty();
}

Body::iterator below_head(Body& body) {
  auto at = body.begin();
  while (at != body.end() && (std::holds_alternative<Declare>(at->node) || is_remark(*at))) ++at;
  return at;
}

Statement make_block(const LineInfo& like, Action action) {
  Block b;
  b.actions.push_back(std::move(action));
  return made(like, std::move(b));
}

void move_head(LineInfo& from, LineInfo& to) {
  to.number = from.number;
  to.number_mark = from.number_mark;
  to.labels = std::move(from.labels);
  to.blank_lines_before = from.blank_lines_before;
  to.joined = from.joined;
  from.number = {};
  from.number_mark = 'N';
  from.labels.clear();
  from.blank_lines_before = 0;
  from.joined = false;
  std::vector<CommentText> stay;
  for (const auto& c : from.comments) {
    (c.place == CommentPlace::own_line ? to.comments : stay).push_back(c);
  }
  from.comments = std::move(stay);
}

}  // namespace cnctrans::ir::passes
