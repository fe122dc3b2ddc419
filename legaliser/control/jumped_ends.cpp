// Repeated parts whose end mark stands in several places (ENDLABEL): the part ends at the first one that control comes
// to. A jump past the first leads on to the next, and other controls name one end.
#include "legaliser/control/jumped_ends.h"

#include <map>
#include <set>
#include <vector>

#include "ir/analysis/dataflow.h"
#include "ir/edit/labels.h"
#include "ir/nesting.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

class JumpedEnds {
 public:
  JumpedEnds(Program& program, Routine& routine, const LegaliseContext& context)
      : program_(program),
        routine_(routine),
        labels_(routine),
        flow_(control_flow(program, routine)),
        editor_(program, routine, context) {
    behind(routine.body, 0);
  }

  void run() {
    for_each_statement(routine_.body, [this](Statement& s) {
      auto* r = std::get_if<Repeat>(&s.node);
      if (r == nullptr || r->has_program || r->first.computed || r->last.computed || r->last.text.empty()) return;
      const auto range = labels_.range(*r, labels_.order(s.id));
      if (!range) return;
      if (inside_.at(range->first.statement) != inside_.at(range->second.statement)) {
        refuse(
            s, program_, editor_.context, "TRN-524",
            "the repeated part ends inside of a branch that is not always carried out: where it ends on the other way "
            "is stated nowhere",
            "put the end of the part behind the branch");
        return;
      }
      const auto ends = ends_of(*r, range->first);
      if (r->search == Search::whole_first || labels_.all(r->last.text, r->last.is_number).size() < 2) return;
      if (ends.size() == 1 && *ends.begin() != range->second.statement) r->last = name_of(*ends.begin());
      if (ends.size() < 2) return;
      refuse(s, program_, editor_.context, "TRN-524",
             "a jump leads out of the repeated part, which then ends at its next end mark and else at the first one",
             "jump to the end mark inside of the part, or write a subprogram");
    });
  }

 private:
  /// The marks at which the part may end, ids.
  std::set<std::uint32_t> ends_of(const Repeat& r, const LabelSite& first) const {
    std::set<std::uint32_t> marks, ends, seen;
    for (const auto& site : labels_.all(r.last.text, r.last.is_number)) {
      if (site.order >= first.order) marks.insert(site.statement);
    }
    std::vector<std::uint32_t> open{first.statement};
    while (!open.empty()) {
      const auto id = open.back();
      open.pop_back();
      if (id == 0 || id >= flow_.statements.size() || flow_.statements[id] == nullptr || !seen.insert(id).second)
        continue;
      if (marks.count(id) != 0) {
        ends.insert(id);
      } else if (std::holds_alternative<Repeat>(flow_.statements[id]->node)) {  // another part has an end of its own
        open.push_back(behind_.at(id));
      } else {
        open.insert(open.end(), flow_.successors[id].begin(), flow_.successors[id].end());
      }
    }
    return ends;
  }
  void behind(const Body& body, std::uint32_t after) {
    for (std::size_t i = 0; i < body.size(); ++i) {
      inside_[body[i].id] = &body;
      const std::uint32_t next = i + 1 < body.size() ? body[i + 1].id : after;
      behind_[body[i].id] = next;
      for (const Body* inner : detail::bodies_of(body[i])) {
        if (inner != nullptr) behind(*inner, next);
      }
    }
  }
  /// A label that the statement alone has.
  LabelRef name_of(std::uint32_t id) {
    LabelRef name;
    for_each_statement(routine_.body, [&](Statement& s) {
      if (s.id != id) return;
      for (const auto& l : labels_on(s.line)) {
        if (labels_.all(l.text, l.is_number).size() == 1) name = l;
      }
      if (!name.text.empty()) return;
      name = editor_.fresh_label();
      set_label(s.line, name, program_);
    });
    return name;
  }

  Program& program_;
  Routine& routine_;
  LabelTable labels_;
  ControlFlow flow_;
  Editor editor_;
  std::map<std::uint32_t, std::uint32_t> behind_;  ///< what comes next in the text, by id
  std::map<std::uint32_t, const Body*> inside_;
};

bool has_repeats(const Routine& r) {
  bool found = false;
  for_each_statement(r.body, [&found](const Statement& s) { found = found || std::holds_alternative<Repeat>(s.node); });
  return found;
}

}  // namespace

void name_jumped_ends(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect && !program.dialect.empty()) return;
  bool numbered = false;
  for (auto& r : program.routines) {
    if (!has_repeats(r)) continue;
    if (!numbered) number_statements(program);
    numbered = true;
    JumpedEnds(program, r, context).run();
  }
}

}  // namespace cnctrans::ir::passes
