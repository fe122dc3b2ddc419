// Ends of ranges (equivalences 20.4): a line with an assignment beside its words is several statements, and the range
// that ends at its number ends behind the last of them.
#include <algorithm>

#include "ir/passes/early_passes.h"
#include "ir/passes/editor.h"

namespace cnctrans::ir::passes {

namespace {

class RangeEnds {
 public:
  RangeEnds(Program& program, Routine& routine, const LegaliseContext& context)
      : program_(program), routine_(routine), editor_(program, routine, context), uses_(label_uses(program, routine)) {}

  void run() {
    walk(routine_.body);
    for (const auto& [from, to] : moved_) redirect(from, to);
  }

 private:
  void walk(Body& body) {
    for (std::size_t i = 0; i < body.size(); ++i) {
      each_body(body[i], [this](Body& inner) { walk(inner); });
      std::size_t last = i;
      while (last + 1 < body.size() && body[last + 1].line.joined) ++last;
      if (last == i) continue;
      const auto labels = labels_on(body[i].line);
      if (!std::any_of(labels.begin(), labels.end(), [this](const LabelRef& l) { return uses_.is_end(l); })) continue;
      const LabelRef fresh = editor_.fresh_label();
      body[last].line.joined = false;
      set_label(body[last].line, fresh, program_);
      for (const auto& l : labels) moved_.emplace_back(l, fresh);
    }
  }

  void redirect(const LabelRef& from, const LabelRef& to) {
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [&](Statement& s) {
        if (auto* c = std::get_if<CallRoutine>(&s.node)) {
          if (c->has_range && program_.find(c->routine) == &routine_) change(c->first, c->last, from, to);
        } else if (auto* x = std::get_if<Repeat>(&s.node)) {
          const bool here = x->has_program ? program_.find(x->program) == &routine_ : &r == &routine_;
          if (here) change(x->first, x->last, from, to);
        }
      });
    }
  }
  /// A range of one block names it once or twice.
  static void change(const LabelRef& first, LabelRef& last, const LabelRef& from, const LabelRef& to) {
    if (last.computed) return;
    if (same_label(last, from) || (last.text.empty() && same_label(first, from))) last = to;
  }

  Program& program_;
  Routine& routine_;
  Editor editor_;
  LabelUses uses_;
  std::vector<std::pair<LabelRef, LabelRef>> moved_;
};

}  // namespace

void mark_range_ends(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect && !program.dialect.empty()) return;  // the lines stay as they are
  for (auto& r : program.routines) RangeEnds(program, r, context).run();
}

}  // namespace cnctrans::ir::passes
