// Statements that read machine data which the target lacks, in a translation that goes on all the same: the whole
// statement is left out, not only the part that an expression pass would have written for it.
#include "ir/passes/early_passes.h"
#include "ir/passes/rewrite.h"
#include "ir/text.h"

namespace cnctrans::ir::passes {

namespace {

class RefusedData {
 public:
  RefusedData(const Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void body(Body& statements) const {
    rewrite_body(statements, [this](Statement&& s, Body& out) {
      if (!lacks(s)) return out.push_back(std::move(s));
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

 private:
  [[nodiscard]] bool lacks(const Statement& s) const {
    bool found = false;
    each_expression(s, [&](const ExprPtr& e) {
      walk(e, [&](const ExprPtr& x) {
        const auto* ref = std::get_if<SystemRef>(&x->node);
        found = found || (ref != nullptr && !context_.target.system_data(*ref));
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

  const Program& program_;
  const LegaliseContext& context_;
};

}  // namespace

void leave_out_refused_data(Program& program, const LegaliseContext& context) {
  if (!context.options.goes_on || !context.target.system_data || program.dialect == context.target.dialect) return;
  const RefusedData pass(program, context);
  for (auto& r : program.routines) pass.body(r.body);
}

}  // namespace cnctrans::ir::passes
