// Calls of some blocks of another program (equivalences 20.4), for a target that calls whole programs only: the blocks
// become a subprogram of their own, which the program that they stand in calls too. So do the blocks of a repetition
// that stand elsewhere, for a target that repeats only what stands right before.
#include <algorithm>
#include <optional>
#include <set>

#include "base/text.h"
#include "ir/label_name.h"
#include "legaliser/analysis/head_constants.h"
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

  /// Repetitions of blocks that stand elsewhere in their routine, or with a count that only the run knows.
  void run_repeats() {
    const HeadConstants constants(program_);
    constants_ = &constants;
    for (std::size_t n = 0; n < program_.routines.size(); ++n) {
      std::size_t from = 0;
      while (const auto at = repeat_of_others(program_.routines[n], from)) {
        from = *at + 1;
        if (separate_repeated(n, *at)) from = 0;
      }
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
    instead.line.skip_mask = 0;  // of its first block alone
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
  /// One line alone has it.
  static bool once(const Body& body, const LabelRef& label) {
    std::size_t count = 0;
    for_each_statement(body, [&](const Statement& s) {
      const auto on = labels_on(s.line);
      count += static_cast<std::size_t>(
          std::count_if(on.begin(), on.end(), [&label](const LabelRef& l) { return same_label(l, label); }));
    });
    return count == 1;
  }
  static std::string shown(const LabelRef& l) { return (l.is_number ? "N" : "") + l.text; }

  [[nodiscard]] std::optional<std::size_t> repeat_of_others(const Routine& routine, std::size_t from) const {
    const Body& body = routine.body;
    for (std::size_t i = from; i < body.size(); ++i) {
      const auto* r = std::get_if<Repeat>(&body[i].node);
      if (r == nullptr || r->has_program || r->first.computed || r->last.computed || r->last.text.empty() ||
          r->curve_use != CurveUse::none)
        continue;
      const auto before = i != 0 ? labels_on(body[i - 1].line) : std::vector<LabelRef>{};
      const bool computed = r->count && !context_.target.repeat_count_variable && !constant_value(r->count) &&
                            !constants_->count(r->count, routine, body[i]);
      const auto ends = [r](const LabelRef& l) { return same_label(l, r->last); };
      if (computed || std::none_of(before.begin(), before.end(), ends)) return i;
    }
    return std::nullopt;
  }

  static bool repeats(const Statement& s, const Repeat& r) {
    const auto* other = std::get_if<Repeat>(&s.node);
    return other != nullptr && !other->has_program && same_label(other->first, r.first) &&
           same_label(other->last, r.last);
  }

  bool separate_repeated(std::size_t home, std::size_t at) {
    Body& body = program_.routines[home].body;
    const Repeat repeat = std::get<Repeat>(body[at].node);
    const std::size_t begin = find(body, repeat.first);
    std::size_t end = find(body, repeat.last);
    if (begin == body.size() || end == body.size() || end < begin || (at >= begin && at <= end)) return false;
    if (!once(body, repeat.first) || !once(body, repeat.last)) return false;
    for (++end; end < body.size() && body[end].line.joined;) ++end;
    if ((at >= begin && at < end) || body[begin].line.joined || !apart(home, begin, end, repeat)) return false;
    Routine part;
    part.kind = RoutineKind::sub;
    part.locality = Locality::file_local;
    part.file = program_.routines[home].file;
    part.name = named_by(repeat.first);
    for_each_statement(body, [&](Statement& s) {
      if (!repeats(s, repeat)) return;
      CallRoutine call;
      call.routine = part.name;
      call.count = std::get<Repeat>(s.node).count;
      s.node = std::move(call);
    });
    const auto from = body.begin() + static_cast<std::ptrdiff_t>(begin),
               to = body.begin() + static_cast<std::ptrdiff_t>(end);
    CallRoutine own;
    own.routine = part.name;
    Statement instead = made(from->line, std::move(own));
    instead.line.skip_mask = 0;  // of its first block alone
    if (jumped_to(body, begin, end, repeat.first)) set_label(instead.line, repeat.first, program_);
    part.body.assign(std::make_move_iterator(from), std::make_move_iterator(to));
    context_.diagnostics.note("TRN-551", instead.line.span,
                              "the target repeats only what stands right before the repetition, and counts by numbers: "
                              "the blocks " +
                                  shown(repeat.first) + " to " + shown(repeat.last) +
                                  " become a subprogram of their own");
    body.insert(body.erase(from, to), std::move(instead));
    program_.routines.push_back(std::move(part));
    return true;
  }

  /// Something outside of the part jumps to its first block.
  static bool jumped_to(const Body& body, std::size_t begin, std::size_t end, const LabelRef& first) {
    bool found = false;
    for (std::size_t i = 0; i < body.size(); ++i) {
      if (i >= begin && i < end) continue;
      Body one{body[i]};
      for_each_statement(one, [&](Statement& s) {
        if (!std::holds_alternative<Repeat>(s.node))
          each_label_ref(s, [&](LabelRef& l, bool) { found = found || same_label(l, first); });
      });
    }
    return found;
  }

  /// Nothing but repetitions of this part and jumps to its first block lead into it, and nothing out of it.
  bool apart(std::size_t home, std::size_t begin, std::size_t end, const Repeat& repeat) const {
    const Body& body = program_.routines[home].body;
    std::set<LabelName> inside;
    bool good = true;
    for (std::size_t i = begin; i < end; ++i) {
      Body one{body[i]};
      for_each_statement(one, [&](const Statement& s) {
        for (const auto& l : labels_on(s.line)) inside.insert(label_name(l));
        good = good && !std::holds_alternative<Return>(s.node) && !std::holds_alternative<End>(s.node);
      });
    }
    for (std::size_t i = 0; i < body.size(); ++i) {
      Body one{body[i]};
      const bool in = i >= begin && i < end;
      for_each_statement(one, [&](Statement& s) {
        if (std::holds_alternative<CallRoutine>(s.node) || repeats(s, repeat)) return;
        const bool jumps = !in && !std::holds_alternative<Repeat>(s.node);
        each_label_ref(s, [&](LabelRef& l, bool) {
          if ((l.text.empty() && !l.computed) || (jumps && same_label(l, repeat.first))) return;
          good = good && !l.computed && (inside.count(label_name(l)) != 0) == in;
        });
      });
    }
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        const auto* c = std::get_if<CallRoutine>(&s.node);
        const auto* p = std::get_if<Repeat>(&s.node);
        if ((c != nullptr && c->has_range && program_.find(c->routine) == &program_.routines[home]) ||
            (p != nullptr && p->has_program && program_.find(p->program) == &program_.routines[home]))
          good = false;
      });
    }
    return good;
  }

  /// The number or name of the first block, where no routine has it.
  RoutineName named_by(const LabelRef& first) const {
    RoutineName name;
    if (first.is_number)
      name.number = static_cast<std::int64_t>(parse_decimal(first.text).value_or(1));
    else
      name.text = first.text;
    const bool taken = std::any_of(program_.routines.begin(), program_.routines.end(),
                                   [&name](const Routine& r) { return r.name == name; });
    return taken ? fresh(std::move(name)) : name;
  }

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
  const HeadConstants* constants_ = nullptr;
  Span where_;
};

}  // namespace

void separate_called_parts(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || context.target.call_range) return;
  CalledParts parts(program, context);
  parts.run();
  if (context.target.repeat_ends_here) parts.run_repeats();
}

}  // namespace cnctrans::ir::passes
