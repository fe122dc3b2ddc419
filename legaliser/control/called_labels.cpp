#include "legaliser/control/called_labels.h"

#include <algorithm>
#include <set>

#include "base/text.h"

#include "legaliser/control/lower_calls.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

std::optional<SpaceId> space_of_texts(const Program& program) {
  for (std::size_t i = 0; i < program.spaces.size(); ++i) {
    const auto& s = program.spaces[i];
    if (s.named() && s.type == Type::string && s.scope == Scope::routine) return static_cast<SpaceId>(i);
  }
  return std::nullopt;
}

bool stands_in(const Routine& routine, const LabelRef& label) {
  bool found = false;
  for_each_statement(routine.body, [&](const Statement& s) {
    const auto on = labels_on(s.line);
    found = found || std::any_of(on.begin(), on.end(), [&label](const LabelRef& l) { return same_label(l, label); });
  });
  return found;
}

/// The two labels of a call of some blocks of another routine, in one routine.
class CalledLabels {
 public:
  CalledLabels(Program& program, Routine& routine, const LegaliseContext& context)
      : program_(program), routine_(routine), context_(context) {}

  void run() {
    for_each_statement(routine_.body, [this](Statement& s) {
      auto* c = std::get_if<CallRoutine>(&s.node);
      if (c == nullptr || !c->has_range || c->computed || program_.find(c->routine) == &routine_) return;
      if (!known(*c)) {
        refuse(s, program_, context_, "TRN-660",
               "some blocks of another program are called, and that program with their labels is not at hand, or the "
               "labels are known only when the program runs",
               "give its folder with --lib, or make the blocks a subprogram");
        return;
      }
      if (!names_parts_by_texts(context_.target)) return;
      const auto space = space_of_texts(program_);
      if (!space) return;
      if (c->last.text.empty()) c->last = c->first;
      c->first.computed = by_text(c->first, *space);
      c->last.computed = by_text(c->last, *space);
    });
    declare();
  }

 private:
  bool known(const CallRoutine& c) const {
    if (c.first.computed || c.last.computed) return false;
    const Routine* callee = program_.find(c.routine);
    const auto by_number = [this](const LabelRef& l) { return l.is_number && context_.target.number_labels; };
    // A program that is not translated along keeps its numbers.
    if (callee == nullptr) return !names_parts_by_texts(context_.target) && by_number(c.first) && by_number(c.last);
    return stands_in(*callee, c.first) && (c.last.text.empty() || stands_in(*callee, c.last));
  }

  ExprPtr by_text(const LabelRef& label, SpaceId space) {
    VarRef v;
    v.space = space_ = space;
    v.name = name_of(label);
    return variable(v, Type::string);
  }
  std::string name_of(const LabelRef& label) {
    const std::string text = label_text(label);
    const auto it = std::find_if(named_.begin(), named_.end(), [&text](const auto& n) { return n.second == text; });
    if (it != named_.end()) return it->first;
    if (taken_.empty()) collect();
    std::string name = "TO_" + text;
    while (taken_.count(name) != 0) name += '_';
    taken_.insert(name);
    named_.emplace_back(name, text);
    return name;
  }
  void collect() {
    taken_.insert({});
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [this](const Statement& s) {
        for (const auto& l : labels_on(s.line)) taken_.insert(to_upper_ascii(l.text));
        const auto* d = std::get_if<Declare>(&s.node);
        for (std::size_t i = 0; d != nullptr && i < d->items.size(); ++i)
          taken_.insert(to_upper_ascii(d->items[i].name));
      });
    }
  }
  void declare() {
    for (const auto& [name, label] : named_) {
      Declare d;
      d.type = Type::string;
      d.space = space_;
      d.items.push_back({name, {}, {string_literal(label)}});
      Statement s;
      s.node = std::move(d);
      routine_.body.insert(below_head(routine_.body), std::move(s));
    }
  }

  Program& program_;
  Routine& routine_;
  const LegaliseContext& context_;
  SpaceId space_ = 0;
  std::vector<std::pair<std::string, std::string>> named_;  ///< variable, label
  std::set<std::string> taken_;
};

}  // namespace

bool names_parts_by_texts(const Capabilities& target) {
  return target.call_range && target.identifier_labels;
}

void name_called_labels(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || !context.target.call_range) return;
  for (auto& r : program.routines) CalledLabels(program, r, context).run();
}

}  // namespace cnctrans::ir::passes
