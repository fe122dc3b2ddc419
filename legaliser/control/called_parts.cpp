// Calls of some blocks of another program (equivalences 20.4), for a target that calls whole programs only: the blocks
// become a subprogram of their own, which the program that they stand in calls too.
#include <algorithm>
#include <optional>
#include <set>

#include "ir/label_name.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

class CalledParts {
 public:
  CalledParts(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void run() {
    while (const auto call = next()) {
      if (!separate(*call)) left_.push_back(*call);
    }
  }

 private:
  static bool same(const CallRoutine& a, const CallRoutine& b) {
    return a.routine == b.routine && same_label(a.first, b.first) && same_label(a.last, b.last);
  }
  static bool candidate(const CallRoutine& c) {
    return c.has_range && !c.computed && !c.tail && c.arguments.empty() && !c.first.computed && !c.last.computed;
  }

  std::optional<CallRoutine> next() {
    std::optional<CallRoutine> found;
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        const auto* c = std::get_if<CallRoutine>(&s.node);
        if (found || c == nullptr || !candidate(*c) || program_.find(c->routine) == nullptr ||
            program_.find(c->routine) == &r ||
            std::any_of(left_.begin(), left_.end(), [c](const auto& l) { return same(l, *c); }))
          return;
        found = *c;
        where_ = s.line.span;
      });
    }
    return found;
  }

  static std::size_t find(const Body& body, const LabelRef& label) {
    const auto at = std::find_if(body.begin(), body.end(), [&label](const Statement& s) {
      const auto on = labels_on(s.line);
      return std::any_of(on.begin(), on.end(), [&label](const LabelRef& l) { return same_label(l, label); });
    });
    return static_cast<std::size_t>(at - body.begin());
  }

  bool separate(const CallRoutine& call) {
    const Routine* callee = program_.find(call.routine);
    const auto home = std::find_if(program_.routines.begin(), program_.routines.end(),
                                   [callee](const Routine& r) { return &r == callee; });
    Body& body = home->body;
    const std::size_t begin = find(body, call.first);
    std::size_t end = find(body, call.last);
    if (begin == body.size() || end == body.size() || end < begin) return false;
    for (++end; end < body.size() && body[end].line.joined;) ++end;
    if (begin == 0 && end == body.size()) {
      redirect(call, home->name);
      return true;
    }
    if (home->kind == RoutineKind::main || !closed(*home, begin, end, call)) return false;
    Routine part;
    part.kind = RoutineKind::sub;
    part.locality = home->locality;
    part.file = home->file;
    part.name = fresh(home->name);
    const auto from = body.begin() + static_cast<std::ptrdiff_t>(begin),
               to = body.begin() + static_cast<std::ptrdiff_t>(end);
    CallRoutine own;
    own.routine = part.name;
    Statement instead = made(from->line, std::move(own));
    part.body.assign(std::make_move_iterator(from), std::make_move_iterator(to));
    part.body.front().line.joined = false;
    body.insert(body.erase(from, to), std::move(instead));
    context_.diagnostics.note("TRN-551", where_,
                              "the target calls whole programs only: the blocks " + shown(call.first) + " to " +
                                  shown(call.last) + " become a subprogram of their own");
    redirect(call, part.name);
    program_.routines.push_back(std::move(part));
    return true;
  }
  static std::string shown(const LabelRef& l) { return (l.is_number ? "N" : "") + l.text; }

  /// No way but the call and the blocks around it leads into the part or out of it.
  bool closed(const Routine& home, std::size_t begin, std::size_t end, const CallRoutine& call) const {
    std::set<LabelName> inside;
    const auto each = [&](std::size_t from, std::size_t to, const auto& visit) {
      for (std::size_t i = from; i < to; ++i) {
        Body one{home.body[i]};
        for_each_statement(one, visit);
      }
    };
    each(begin, end, [&inside](const Statement& s) {
      for (const auto& l : labels_on(s.line)) inside.insert(label_name(l));
    });
    bool good = true;
    const auto check = [&](bool in) {
      return [&good, &inside, in](Statement& s) {
        if (std::holds_alternative<CallRoutine>(s.node)) return;  // of another program
        each_label_ref(s, [&](LabelRef& l, bool) {
          if (l.text.empty() && !l.computed) return;
          good = good && !l.computed && (inside.count(label_name(l)) != 0) == in;
        });
      };
    };
    each(begin, end, check(true));
    each(0, begin, check(false));
    each(end, home.body.size(), check(false));
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        const auto* c = std::get_if<CallRoutine>(&s.node);
        const auto* p = std::get_if<Repeat>(&s.node);
        if (c != nullptr && c->has_range && program_.find(c->routine) == &home && !same(*c, call))
          good = good && !c->first.computed && !c->last.computed && inside.count(label_name(c->first)) == 0 &&
                 inside.count(label_name(c->last)) == 0;
        if (p != nullptr && p->has_program && program_.find(p->program) == &home) good = false;
      });
    }
    return good;
  }

  RoutineName fresh(RoutineName name) const {
    const auto taken = [this](const RoutineName& n) {
      return std::any_of(program_.routines.begin(), program_.routines.end(),
                         [&n](const Routine& r) { return r.name == n; });
    };
    if (!name.text.empty()) {
      name.text += "_PART";
      while (taken(name)) name.text += 'A';
      return name;
    }
    do ++name.number;
    while (taken(name));
    return name;
  }

  void redirect(const CallRoutine& call, const RoutineName& name) {
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [&](Statement& s) {
        auto* c = std::get_if<CallRoutine>(&s.node);
        if (c == nullptr || !candidate(*c) || !same(*c, call)) return;
        c->has_range = false;
        c->first = c->last = {};
        c->routine = name;
      });
    }
  }

  Program& program_;
  const LegaliseContext& context_;
  std::vector<CallRoutine> left_;  ///< these stay
  Span where_;
};

}  // namespace

void separate_called_parts(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || context.target.call_range) return;
  CalledParts(program, context).run();
}

}  // namespace cnctrans::ir::passes
