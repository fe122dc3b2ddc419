// Statements that read machine data which the target lacks, in a translation that goes on all the same: the whole
// statement is left out, not only the part that an expression pass would have written for it.
#include <algorithm>
#include <set>

#include "ir/edit/rewrite.h"
#include "ir/text/text.h"
#include "legaliser/data/given_data.h"
#include "legaliser/early_passes.h"

namespace cnctrans::ir::passes {

namespace {

class RefusedData {
 public:
  RefusedData(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void routine(Routine& r) {
    routine_ = &r;
    body(r.body);
  }

  /// A remark and a warning at every statement that reads what a line left out would have set.
  void mark_readers(Routine& r) {
    std::vector<VarRef> now;
    for (const Lost& l : lost_) {
      const Scope scope = program_.spaces[l.variable.space].scope;
      if (l.routine == &r || scope == Scope::global || scope == Scope::program) now.push_back(l.variable);
    }
    if (now.empty()) return;
    Body& body = r.body;
    if (!straight(r)) {  // any line may come before any other
      for (std::size_t known = 0; known != now.size();) {
        known = now.size();
        for_each_statement(body, [&](const Statement& s) {
          if (read_of(s, now) == nullptr) return;
          each_target(s, [&now](const VarRef& v) { add(v, now); });
        });
      }
      for_each_statement(body, [&](Statement& s) { mark(s, now); });
      return;
    }
    std::erase_if(now, [&](const VarRef& v) { return lost_here(v, r); });
    std::set<const Statement*> outside;  // of every IF: what they set is set for certain
    for (const Statement& s : body) outside.insert(&s);
    for_each_statement(body, [&](Statement& s) {
      for (const Lost& l : lost_) {
        if (l.routine == &r && l.line == s.line.span.line && std::holds_alternative<Opaque>(s.node))
          add(l.variable, now);
      }
      const bool reads_lost = mark(s, now);
      each_target(s, [&](const VarRef& v) {
        if (reads_lost) return add(v, now);
        if (outside.contains(&s)) std::erase_if(now, [&v](const VarRef& x) { return same_variable(x, v); });
      });
    });
  }

 private:
  /// A variable that a left-out line would have set.
  struct Lost {
    VarRef variable;
    const Routine* routine = nullptr;
    std::uint32_t line = 0;
  };

  static void add(const VarRef& v, std::vector<VarRef>& to) {
    if (std::none_of(to.begin(), to.end(), [&v](const VarRef& x) { return same_variable(x, v); })) to.push_back(v);
  }
  [[nodiscard]] bool lost_here(const VarRef& v, const Routine& r) const {
    return std::any_of(lost_.begin(), lost_.end(),
                       [&](const Lost& l) { return l.routine == &r && same_variable(l.variable, v); });
  }
  /// No jump, loop, repetition or call: the lines run in their order, once.
  static bool straight(const Routine& r) {
    bool all = true;
    for_each_statement(r.body, [&all](const Statement& s) {
      all = all && (std::holds_alternative<If>(s.node) || std::holds_alternative<Block>(s.node) ||
                    std::holds_alternative<Assign>(s.node) || std::holds_alternative<Message>(s.node) ||
                    std::holds_alternative<Declare>(s.node) || std::holds_alternative<End>(s.node) ||
                    std::holds_alternative<Opaque>(s.node));
    });
    return all;
  }
  static const VarRef* read_of(const Statement& s, const std::vector<VarRef>& lost) {
    const VarRef* found = nullptr;
    each_expression(s, [&](const ExprPtr& e) {
      for (const VarRef& v : lost) {
        if (found == nullptr && reads(e, v)) found = &v;
      }
    });
    return found;
  }
  bool mark(Statement& s, const std::vector<VarRef>& lost) {
    const VarRef* read = read_of(s, lost);
    if (read == nullptr || std::holds_alternative<Opaque>(s.node)) return read != nullptr;
    const auto number = constant_index(*read);
    const std::string name =
        number ? program_.spaces[read->space].prefix + std::to_string(*number) : to_text(variable(*read), program_);
    context_.diagnostics.warning("TRN-540", s.line.span,
                                 "this block reads " + name + ", which a line that is left out would have set",
                                 "translate that line by hand, then check this one");
    CommentText remark;
    remark.text = program_.keep("!! TRN-540 " + name);
    s.line.comments.push_back(remark);
    return true;
  }

  void body(Body& statements) {
    rewrite_body(statements, [this](Statement&& s, Body& out) {
      if (!lacks(s)) return out.push_back(std::move(s));
      each_target(s, [&](const VarRef& v) { lost_.push_back({v, routine_, s.line.span.line}); });
      Body inside;
      if (auto* branch = std::get_if<If>(&s.node); branch != nullptr && !branch->one_line && !branch->has_else) {
        inside = std::move(branch->then_body);
      } else if (auto* loop = std::get_if<While>(&s.node)) {
        inside = std::move(loop->body);
      } else if (std::get_if<If>(&s.node) != nullptr && !branch->one_line) {
        branch->condition = binary(BinaryOp::eq, number(1), number(1));
        inside.push_back(std::move(s));
        s = made(inside.back().line, Label{});
      }
      out.push_back(left_out(std::move(s)));
      for (auto& x : inside) out.push_back(std::move(x));
    });
  }

  [[nodiscard]] bool lacks(const Statement& s) const {
    bool found = false;
    each_expression(s, [&](const ExprPtr& e) {
      walk(e, [&](const ExprPtr& x) {
        const auto* ref = std::get_if<SystemRef>(&x->node);
        found = found || (ref != nullptr && !has_name(*ref, context_));
      });
    });
    return found;
  }
  Statement left_out(Statement&& s) const {
    Opaque o;
    o.text = to_text(s, program_);
    o.feature = "language.statement";
    s.node = std::move(o);
    return std::move(s);
  }

  Program& program_;
  const LegaliseContext& context_;
  std::vector<Lost> lost_;
  const Routine* routine_ = nullptr;
};

}  // namespace

void leave_out_refused_data(Program& program, const LegaliseContext& context) {
  if (!context.options.goes_on || !context.target.system_data || program.dialect == context.target.dialect) return;
  RefusedData pass(program, context);
  for (auto& r : program.routines) pass.routine(r);
  for (auto& r : program.routines) pass.mark_readers(r);
}

}  // namespace cnctrans::ir::passes
