// Structure raised from jumps (--structure=raise): a region that is entered at its head only and left at its end
// becomes IF, WHILE, REPEAT or LOOP where the target has it. Every other jump stays as it is.
#include <algorithm>
#include <map>

#include "ir/label_name.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"
#include "legaliser/expressions/expression_lowering.h"

namespace cnctrans::ir::passes {

namespace {

/// A jump whose target is written.
struct PlainJump {
  LabelRef target;
  ExprPtr condition;  ///< null: always
  Search search = Search::whole_first;
};

std::optional<PlainJump> plain_jump(const Statement& s) {
  if (s.line.skip_mask != 0 || s.line.joined) return std::nullopt;
  const auto* jump = std::get_if<Jump>(&s.node);
  ExprPtr condition;
  if (const auto* i = std::get_if<If>(&s.node); i != nullptr && i->then_body.size() == 1 && i->else_body.empty()) {
    const Statement& inner = i->then_body.front();
    jump = std::get_if<Jump>(&inner.node);
    if (jump == nullptr || jump->condition || !inner.line.number.empty() || !inner.line.labels.empty() ||
        !inner.line.comments.empty() || !i->end_line.comments.empty() || !i->end_line.number.empty())
      return std::nullopt;
    condition = i->condition;
  }
  if (jump == nullptr || jump->quiet || jump->target.computed || jump->search == Search::to_start) return std::nullopt;
  return PlainJump{jump->target, condition ? condition : jump->condition, jump->search};
}

bool finds_forward(const PlainJump& j) {
  return j.search != Search::backward;
}
bool finds_backward(const PlainJump& j) {
  return j.search != Search::forward;
}

class RaisePass {
 public:
  RaisePass(Program& program, Routine& routine, const Capabilities& target)
      : program_(program), routine_(routine), target_(target) {}

  void run() {
    bool fixed = !runs_for_others();
    for_each_statement(routine_.body, [&fixed](Statement& s) {
      each_label_ref(s, [&fixed](const LabelRef& l, bool) { fixed = fixed && !l.computed; });
    });
    if (!fixed) return;
    count_labels(routine_.body);
    body(routine_.body);
  }

 private:
  /// One body: where its labels stand and which of its statements lead to them.
  struct Map {
    std::map<LabelName, std::size_t> at;
    std::map<LabelName, std::vector<std::size_t>> users;  ///< `outside` for what is no jump of this body
    std::vector<bool> fixed;                              ///< statements that must not come into a structure
  };
  static constexpr std::size_t outside = static_cast<std::size_t>(-1);

  /// Another routine runs a range of this one.
  [[nodiscard]] bool runs_for_others() const {
    bool found = false;
    for (const auto& other : program_.routines) {
      for_each_statement(other.body, [&](const Statement& s) {
        const auto* c = std::get_if<CallRoutine>(&s.node);
        const auto* r = std::get_if<Repeat>(&s.node);
        if (c != nullptr && c->has_range) found = found || program_.find(c->routine) == &routine_;
        if (r != nullptr && r->has_program) found = found || program_.find(r->program) == &routine_;
      });
    }
    return found;
  }

  void count_labels(Body& b) {
    for (Statement& s : b) {
      for (const auto& l : labels_on(s.line)) ++count_[label_name(l)];
      each_body(s, [this](Body& inner) { count_labels(inner); });
    }
  }

  void body(Body& b) {
    for (Statement& s : b) {
      each_body(s, [this](Body& inner) { body(inner); });
    }
    bool changed = true;
    for (int depth = 0; changed && depth < deepest; ++depth) changed = round(b);
  }

  Map map_of(Body& b) {
    Map m;
    m.fixed.resize(b.size());
    std::map<LabelName, std::size_t> here, all;
    for (std::size_t i = 0; i < b.size(); ++i) {
      for (const auto& l : labels_on(b[i].line)) m.at.emplace(label_name(l), i);
      follow(b[i], i, m, here);
    }
    for_each_statement(routine_.body, [&all](Statement& s) {
      each_label_ref(s, [&all](const LabelRef& l, bool) { ++all[label_name(l)]; });
    });
    for (const auto& [name, i] : m.at) {
      if (all[name] != here[name]) m.users[name].push_back(outside);
    }
    return m;
  }
  /// Uses of labels in `s`, the `i`-th statement of the body, and in what it encloses.
  static void follow(Statement& s, std::size_t i, Map& m, std::map<LabelName, std::size_t>& here) {
    const bool range = std::holds_alternative<Repeat>(s.node);
    if (range || std::holds_alternative<Exit>(s.node)) m.fixed[i] = true;
    each_label_ref(s, [&](const LabelRef& l, bool) {
      ++here[label_name(l)];
      m.users[label_name(l)].push_back(range ? outside : i);
    });
    each_body(s, [&](Body& inner) {
      for (Statement& t : inner) follow(t, i, m, here);
    });
  }

  /// Nothing leads into the statements from `first` to before `end` but themselves.
  static bool closed(const Body& b, std::size_t first, std::size_t end, const Map& m) {
    for (std::size_t i = first; i < end; ++i) {
      if (m.fixed[i]) return false;
      for (const auto& l : labels_on(b[i].line)) {
        const auto it = m.users.find(label_name(l));
        if (it == m.users.end()) continue;
        for (const std::size_t user : it->second) {
          if (user == outside || user < first || user >= end) return false;
        }
      }
    }
    return true;
  }
  /// Where the label stands, when it stands once.
  std::optional<std::size_t> place(const LabelRef& l, const Map& m) const {
    const auto it = m.at.find(label_name(l));
    const auto n = count_.find(label_name(l));
    if (it == m.at.end() || n == count_.end() || n->second != 1) return std::nullopt;
    return it->second;
  }
  static bool used_once(const LabelRef& l, const Map& m) {
    const auto it = m.users.find(label_name(l));
    return it != m.users.end() && it->second.size() == 1 && it->second.front() != outside;
  }
  static bool used(const Statement& s, const Map& m) {
    const auto labels = labels_on(s.line);
    return std::any_of(labels.begin(), labels.end(), [&m](const auto& l) { return m.users.count(label_name(l)) != 0; });
  }
  [[nodiscard]] bool writes(const ExprPtr& condition) const {
    return target_.conditions == ConditionForm::expression && expression_fits(condition, target_);
  }

  /// The shortest regions of the body become structures; true when there was one.
  bool round(Body& b) {
    const Map m = map_of(b);
    std::vector<Region> regions;
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (const auto r = region_of(b, i, m)) regions.push_back(*r);
    }
    // A loop before the branch that its test would be.
    std::stable_sort(regions.begin(), regions.end(), [](const Region& x, const Region& y) {
      return std::pair(x.size(), x.kind <= Kind::if_else) < std::pair(y.size(), y.kind <= Kind::if_else);
    });
    std::map<std::size_t, Region> chosen;
    std::vector<bool> taken(b.size());
    for (const Region& r : regions) {
      const auto first = taken.begin() + static_cast<std::ptrdiff_t>(r.first);
      const auto end = taken.begin() + static_cast<std::ptrdiff_t>(r.end);
      if (std::find(first, end, true) != end) continue;
      std::fill(first, end, true);
      chosen.emplace(r.first, r);
    }
    Body out;
    out.reserve(b.size());
    for (std::size_t i = 0; i < b.size();) {
      const auto r = chosen.find(i);
      if (r == chosen.end()) {
        out.push_back(std::move(b[i++]));
        continue;
      }
      out.push_back(make(b, r->second));
      i = r->second.end;
    }
    b = std::move(out);
    return !chosen.empty();
  }

  enum class Kind : std::uint8_t { if_then, if_else, while_loop, until_loop, endless };
  struct Region {
    Kind kind = Kind::if_then;
    std::size_t first = 0, end = 0;  ///< statements that it takes up
    std::size_t other = 0;           ///< if_else: the jump over the second part
    [[nodiscard]] std::size_t size() const { return end - first; }
  };

  std::optional<Region> region_of(const Body& b, std::size_t i, const Map& m) const {
    const auto j = plain_jump(b[i]);
    if (!j) return std::nullopt;
    const auto to = place(j->target, m);
    if (!to) return std::nullopt;
    if (*to <= i) return finds_backward(*j) ? loop(b, *to, i, *j, m) : std::nullopt;
    if (!j->condition || !finds_forward(*j) || *to < i + 2) return std::nullopt;
    return branch(b, i, *to, *j, m);
  }

  /// `first` carries the label, `last` is the jump back.
  std::optional<Region> loop(const Body& b, std::size_t first, std::size_t last, const PlainJump& back,
                             const Map& m) const {
    if (first == last || !used_once(back.target, m) || used(b[last], m)) return std::nullopt;
    // The head's label has this one user, inside.
    if (!closed(b, first, last + 1, m)) return std::nullopt;
    if (back.condition) {
      if (!target_.until_loop || !writes(negated_condition(back.condition))) return std::nullopt;
      return Region{Kind::until_loop, first, last + 1, 0};
    }
    const auto test = plain_jump(b[first]);
    if (test && test->condition && finds_forward(*test) && target_.while_loop &&
        writes(negated_condition(test->condition)) && place(test->target, m) == last + 1)
      return Region{Kind::while_loop, first, last + 1, 0};
    if (!target_.endless_loop) return std::nullopt;
    return Region{Kind::endless, first, last + 1, 0};
  }

  std::optional<Region> branch(const Body& b, std::size_t first, std::size_t to, const PlainJump& j,
                               const Map& m) const {
    if (!target_.structured_if || !writes(negated_condition(j.condition)) || !closed(b, first + 1, to, m))
      return std::nullopt;
    const auto over = plain_jump(b[to - 1]);
    if (over && !over->condition && finds_forward(*over) && used_once(j.target, m) && !used(b[to - 1], m)) {
      const auto end = place(over->target, m);
      if (end && *end > to && to - 1 > first + 1 && closed_else(b, to, *end, j.target, m))
        return Region{Kind::if_else, first, *end, to - 1};
    }
    // A jump out at the end of the part is a loop's or an exit; it stays inside.
    return Region{Kind::if_then, first, to, 0};
  }
  static bool closed_else(const Body& b, std::size_t first, std::size_t end, const LabelRef& head, const Map& m) {
    Map inside = m;
    inside.users.erase(label_name(head));
    return closed(b, first, end, inside);
  }

  static void take(Body& from, std::size_t first, std::size_t end, Body& to) {
    for (std::size_t i = first; i < end; ++i) to.push_back(std::move(from[i]));
  }
  /// The line at the head of a structure that a statement does not give.
  static LineInfo heading(const Statement& s) {
    LineInfo line;
    line.span = s.line.span;
    return line;
  }

  static Statement make(Body& b, const Region& r) {
    Statement s;
    const std::size_t last = r.end - 1;
    switch (r.kind) {
      case Kind::if_then:
      case Kind::if_else: {
        If node;
        node.condition = negated_condition(plain_jump(b[r.first])->condition);
        s.line = b[r.first].line;
        node.end_line = heading(b[last]);
        if (r.kind == Kind::if_else) {
          node.has_else = true;
          node.else_line = b[r.other].line;
          take(b, r.first + 1, r.other, node.then_body);
          take(b, r.other + 1, r.end, node.else_body);
        } else {
          take(b, r.first + 1, r.end, node.then_body);
        }
        s.node = std::move(node);
        return s;
      }
      case Kind::while_loop: {
        While node;
        node.condition = negated_condition(plain_jump(b[r.first])->condition);
        s.line = b[r.first].line;
        node.end_line = b[last].line;
        take(b, r.first + 1, last, node.body);
        s.node = std::move(node);
        return s;
      }
      case Kind::until_loop: {
        Until node;
        node.condition = negated_condition(plain_jump(b[last])->condition);
        s.line = heading(b[r.first]);
        node.end_line = b[last].line;
        take(b, r.first, last, node.body);
        s.node = std::move(node);
        return s;
      }
      case Kind::endless: {
        Loop node;
        s.line = heading(b[r.first]);
        node.end_line = b[last].line;
        take(b, r.first, last, node.body);
        s.node = std::move(node);
        return s;
      }
    }
    return s;
  }

  static constexpr int deepest = 8;  ///< levels of structures that are made; controls allow more

  Program& program_;
  Routine& routine_;
  const Capabilities& target_;
  std::map<LabelName, int> count_;
};

}  // namespace

void raise_structure(Program& program, const LegaliseContext& context) {
  if (!context.options.raise_structure) return;
  for (auto& r : program.routines) RaisePass(program, r, context.target).run();
}

}  // namespace cnctrans::ir::passes
