// Variables of texts, for a target that has numbers only: where the text is known from the program it stands in the
// place of the variable.
#include <algorithm>
#include <map>
#include <set>

#include "ir/passes/blocks.h"
#include "ir/passes/early_passes.h"
#include "ir/passes/editor.h"
#include "ir/passes/rewrite.h"

namespace cnctrans::ir::passes {

namespace {

using Texts = std::map<std::string, std::string>;  ///< variable -> its text here

const String* text_in(const ExprPtr& e) {
  return e ? std::get_if<String>(&e->node) : nullptr;
}

class KnownTexts {
 public:
  KnownTexts(Program& program, Routine& routine)
      : program_(program), routine_(routine), uses_(label_uses(program, routine)) {}

  void run() {
    Texts here;
    follow(routine_.body, here);
    for_each_statement(routine_.body, [this](const Statement& s) {
      each_expression(s, [this](const ExprPtr& e) { walk(e, [this](const ExprPtr& x) { read(x); }); });
      if (const auto* c = std::get_if<CallRoutine>(&s.node)) {
        for (const auto& a : c->arguments) {
          if (a.by_reference) left_.insert(a.reference.name);
        }
      }
    });
    remove(routine_.body);
  }

 private:
  /// The variable of texts that the reference names; empty: it is none, or an element of an array.
  [[nodiscard]] std::string name_of(const VarRef& v) const {
    const bool text = v.space < program_.spaces.size() && program_.spaces[v.space].type == Type::string &&
                      program_.spaces[v.space].scope == Scope::routine;
    return text && v.indices.empty() && !v.index ? v.name : std::string();
  }
  void read(const ExprPtr& e) {
    if (const auto* v = as_variable(e)) left_.insert(v->name);
  }

  void follow(Body& body, Texts& here) {
    for (auto& s : body) {
      const auto labels = labels_on(s.line);
      if (std::any_of(labels.begin(), labels.end(),
                      [this](const LabelRef& l) { return uses_.is_target(l) || uses_.is_end(l); }))
        here.clear();
      const bool loop = std::holds_alternative<While>(s.node) || std::holds_alternative<Until>(s.node) ||
                        std::holds_alternative<For>(s.node) || std::holds_alternative<Loop>(s.node);
      if (loop) each_body(s, [&](Body& inner) { forget(inner, here); });
      StatementVisitor visit;
      visit.expression = [&](const ExprPtr& e) {
        return map_expr(e, [&](const ExprPtr& x) -> ExprPtr {
          const auto* v = as_variable(x);
          const auto it = v != nullptr ? here.find(name_of(*v)) : here.end();
          return it == here.end() ? x : string_literal(it->second);
        });
      };
      visit_statement(s, visit);
      each_body(s, [&](Body& inner) {
        Texts inside = here;
        follow(inner, inside);
      });
      each_body(s, [&](Body& inner) { forget(inner, here); });
      write(s, here);
    }
  }

  void write(const Statement& s, Texts& here) {
    if (const auto* d = std::get_if<Declare>(&s.node)) {
      if (d->type != Type::string) return;
      for (const auto& item : d->items) {
        const auto* text = item.initial.empty() ? nullptr : text_in(item.initial.front());
        here.erase(item.name);
        if (item.dimensions.empty() && (text != nullptr || item.initial.empty()))
          here[item.name] = text != nullptr ? text->text : std::string();
      }
    } else if (const auto* a = std::get_if<Assign>(&s.node)) {
      for (const auto& item : a->items) {
        const std::string name = item.to_system ? std::string() : name_of(item.target);
        if (name.empty()) continue;
        const auto* text = text_in(item.value);
        if (text != nullptr && s.line.skip_mask == 0)
          here[name] = text->text;
        else
          here.erase(name);
      }
    } else {
      each_target(s, [&](const VarRef& v) { here.erase(name_of(v)); });
      if (const auto* c = std::get_if<CallRoutine>(&s.node)) {
        for (const auto& argument : c->arguments) {
          if (argument.by_reference) here.erase(name_of(argument.reference));
        }
      }
      if (runs_again(s)) here.clear();
    }
  }
  /// Text of the routine may run here that stands elsewhere, or that is not known.
  static bool runs_again(const Statement& s) {
    const auto* c = std::get_if<CallRoutine>(&s.node);
    return std::holds_alternative<Repeat>(s.node) || std::holds_alternative<Opaque>(s.node) ||
           (c != nullptr && c->has_range);
  }
  void forget(const Body& body, Texts& here) const {
    for_each_statement(body, [&](const Statement& s) {
      each_target(s, [&](const VarRef& v) { here.erase(name_of(v)); });
      if (runs_again(s) || std::holds_alternative<CallRoutine>(s.node)) here.clear();
    });
  }

  static void leave(Statement& s) {
    s.node = Block{};
    settle(s);
  }
  /// Definitions and assignments of variables that nothing reads any more.
  void remove(Body& body) {
    for (auto& s : body) {
      each_body(s, [this](Body& inner) { remove(inner); });
      if (auto* d = std::get_if<Declare>(&s.node); d != nullptr && d->type == Type::string) {
        std::erase_if(d->items, [this](const Declare::Item& i) { return left_.count(i.name) == 0; });
        if (d->items.empty()) leave(s);
      } else if (auto* a = std::get_if<Assign>(&s.node)) {
        std::erase_if(a->items, [this](const Assign::Item& i) {
          const std::string name = i.to_system ? std::string() : name_of(i.target);
          return !name.empty() && left_.count(name) == 0 && text_in(i.value) != nullptr;
        });
        if (a->items.empty()) leave(s);
      }
    }
  }

  Program& program_;
  Routine& routine_;
  LabelUses uses_;
  std::set<std::string> left_;  ///< variables that are still read
};

}  // namespace

void write_known_texts(Program& program, const LegaliseContext& context) {
  const auto texts = [](const VariableSpace& s) { return s.type == Type::string; };
  if (std::any_of(context.target.spaces.begin(), context.target.spaces.end(), texts)) return;
  if (std::none_of(program.spaces.begin(), program.spaces.end(), texts)) return;
  for (auto& r : program.routines) KnownTexts(program, r).run();
}

}  // namespace cnctrans::ir::passes
