// Expressions of every statement in the target's form (equivalences 19); words with a computed value through a
// temporary just before their block.
#include <algorithm>

#include "ir/edit/file_line.h"
#include "legaliser/expressions/expression_lowering.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

bool read_anywhere(const ExprPtr& e, const VarRef& v) {
  return reads(e, v);
}

class ExpressionPass {
 public:
  ExpressionPass(const LegaliseContext& context, bool same_language)
      : context_(context), same_language_(same_language) {}

  void one(Editor& editor, Statement&& s, Body& out) {
    if (std::holds_alternative<Assign>(s.node)) return assign(editor, std::move(s), out);
    if (std::holds_alternative<Block>(s.node)) return block(editor, std::move(s), out);
    if (auto* j = std::get_if<Jump>(&s.node)) {
      if (!j->condition && !j->target.computed) {
        out.push_back(std::move(s));
        return;
      }
    }
    rest(editor, std::move(s), out);
  }

 private:
  void block(Editor& editor, Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    if (!has_expression(b)) {
      out.push_back(std::move(s));
      return;
    }
    ExpressionLowering lowering(editor, s.line);
    visit_values(b, [&](Value& v, const Place& place) {
      if (!v.expr || (same_language_ && of_a_table(v, place))) return false;
      v = lowering.word(v);
      return true;
    });
    editor.put(out, std::move(lowering.pre), std::move(s));
  }

  /// A row of a table that the language says by its code alone.
  static bool of_a_table(const Value& v, const Place& place) {
    const auto* datum = std::get_if<SystemRef>(&v.expr->node);
    return place.role == Role::frame_length && place.pos.column == 0 && datum != nullptr &&
           datum->datum == Datum::work_offset;
  }

  /// Assignments stand one after the other: what an item needs comes right before it.
  void assign(Editor& editor, Statement&& s, Body& out) {
    Assign a = std::move(std::get<Assign>(s.node));
    Body pieces;
    std::size_t main = 0;
    for (auto& item : a.items) {
      ExpressionLowering lowering(editor, s.line);
      if (usable_as_scratch(item)) lowering.set_scratch(item.target);
      if (item.target.index && !constant_value(item.target.index))
        item.target.index = lowering.lower(item.target.index);
      for (auto& i : item.target.indices) i = lowering.element_index(i);
      for (auto& x : item.system.args) x = lowering.lower(x);
      item.value = lowering.lower(item.value);
      if (in_place(item, lowering.pre)) {
        add(pieces, std::move(lowering.pre), std::nullopt, s.line);
        continue;
      }
      add(pieces, std::move(lowering.pre), std::move(item), s.line);
    }
    main = pieces.empty() ? 0 : pieces.size() - 1;
    while (main > 0 && !std::holds_alternative<Assign>(pieces[main].node)) --main;  // it carries the line
    if (pieces.empty()) {
      s.node = std::move(a);
      out.push_back(std::move(s));
      return;
    }
    s.node = std::move(pieces[main].node);
    pieces[main] = std::move(s);
    editor.put_group(out, std::move(pieces), main);
  }

  static bool usable_as_scratch(const Assign::Item& item) {
    return !item.to_system && item.target.indices.empty() &&
           (!item.target.index || constant_value(item.target.index)) && !read_anywhere(item.value, item.target);
  }

  /// What comes before has put the value into the target already.
  static bool in_place(const Assign::Item& item, const Body& pre) {
    const auto* v = as_variable(item.value);
    if (item.to_system || v == nullptr || !same_variable(*v, item.target)) return false;
    return std::any_of(pre.begin(), pre.end(),
                       [](const Statement& p) { return std::holds_alternative<Assign>(p.node); });
  }

  void add(Body& pieces, Body&& pre, std::optional<Assign::Item> item, const LineInfo& like) const {
    constexpr std::size_t most_in_a_line = 4;
    for (auto& p : pre) {
      auto* made_assign = std::get_if<Assign>(&p.node);
      auto* last = pieces.empty() ? nullptr : std::get_if<Assign>(&pieces.back().node);
      if (made_assign != nullptr && last != nullptr && context_.target.several_assignments &&
          last->items.size() + made_assign->items.size() <= most_in_a_line) {
        for (auto& i : made_assign->items) last->items.push_back(std::move(i));
      } else {
        pieces.push_back(std::move(p));
      }
    }
    if (!item) return;
    auto* last = pieces.empty() ? nullptr : std::get_if<Assign>(&pieces.back().node);
    if (last != nullptr && context_.target.several_assignments && last->items.size() < most_in_a_line) {
      last->items.push_back(std::move(*item));
      return;
    }
    Assign alone;
    alone.items.push_back(std::move(*item));
    pieces.push_back(made(like, std::move(alone)));
  }

  void rest(Editor& editor, Statement&& s, Body& out) {
    ExpressionLowering lowering(editor, s.line);
    if (auto* j = std::get_if<Jump>(&s.node)) {
      if (j->condition && context_.target.conditions == ConditionForm::expression)
        j->condition = lowering.condition(j->condition);
      if (j->target.computed) j->target.computed = lowering.lower(j->target.computed);
    } else if (auto* i = std::get_if<If>(&s.node)) {
      i->condition = lowering.condition(i->condition);
    } else if (auto* w = std::get_if<While>(&s.node)) {
      w->condition = lowering.condition(w->condition);
    } else if (auto* u = std::get_if<Until>(&s.node)) {
      u->condition = lowering.condition(u->condition);
    } else if (auto* r = std::get_if<Repeat>(&s.node)) {
      r->count = count(lowering, r->count);
    } else if (auto* m = std::get_if<Message>(&s.node); m != nullptr && file_statement(*m)) {
      // its line is written as it is, or refused
    } else if (m != nullptr) {
      for (auto& p : m->parts) {
        if (p && !is_primary(p)) p = context_.target.word_expression ? lowering.lower(p) : lowering.primary(p);
      }
    } else {
      StatementVisitor visit;
      visit.expression = [&lowering](const ExprPtr& e) {
        return e->type == Type::string || e->type == Type::axis ? e : lowering.lower(e);
      };
      if (auto* c = std::get_if<CallRoutine>(&s.node)) {
        const ExprPtr n = c->count;
        c->count = nullptr;
        visit_statement(s, visit);
        std::get<CallRoutine>(s.node).count = count(lowering, n);
      } else {
        visit_statement(s, visit);
      }
    }
    editor.put(out, std::move(lowering.pre), std::move(s));
  }

  ExprPtr count(ExpressionLowering& lowering, const ExprPtr& e) const {
    if (!e) return e;
    return context_.target.repeat_count_expression ? lowering.lower(e) : lowering.primary(e);
  }

  const LegaliseContext& context_;
  bool same_language_;
};

}  // namespace

void lower_expressions(Program& program, const LegaliseContext& context) {
  ExpressionPass pass(context, program.dialect == context.target.dialect);
  for (auto& r : program.routines) {
    Editor editor(program, r, context);
    rewrite_body(r.body, [&](Statement&& s, Body& out) { pass.one(editor, std::move(s), out); });
  }
}

}  // namespace cnctrans::ir::passes
