// Jumps to computed labels, for targets that lack them.
#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "ir/analysis/value_set.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"
#include "legaliser/expressions/expression_lowering.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// A jump to a computed label becomes a switch over the labels of the routine that the value may name.
class ComputedJumps {
 public:
  ComputedJumps(Editor& editor) : editor_(editor) {}

  void run() {
    std::vector<LabelRef> labels;
    std::set<std::string> numbers;
    for_each_statement(editor_.routine.body, [&](const Statement& s) {
      for (const auto& l : labels_on(s.line)) {
        if (l.is_number && numbers.insert(l.text).second) labels.push_back(l);
      }
    });
    // The values are looked up now: while the body is rewritten the program is not whole.
    for_each_statement(editor_.routine.body, [&](const Statement& s) {
      const auto* j = std::get_if<Jump>(&s.node);
      if (j != nullptr && j->target.computed) values_.try_emplace(j->target.computed.get(), editor_.program, j->target);
    });
    rewrite_body(editor_.routine.body, [&](Statement&& s, Body& out) {
      auto* j = std::get_if<Jump>(&s.node);
      if (j == nullptr || !j->target.computed || editor_.target().computed_jump) {
        out.push_back(std::move(s));
        return;
      }
      rewrite(std::move(s), labels, out);
    });
  }

 private:
  void rewrite(Statement&& s, const std::vector<LabelRef>& all, Body& out) {
    constexpr std::size_t most = 200;
    const Jump j = std::get<Jump>(s.node);
    const ComputedLabel& value = values_.at(j.target.computed.get());
    std::vector<LabelRef> labels;
    std::copy_if(all.begin(), all.end(), std::back_inserter(labels),
                 [&](const LabelRef& l) { return value.may_be(l.text, l.is_number); });
    if (labels.size() > most) {
      refuse(s, editor_.program, editor_.context, "TRN-191", "a jump to a computed label among more than 200 labels",
             "jump to fixed labels");
      out.push_back(std::move(s));
      return;
    }
    Switch node;
    node.value = j.target.computed;
    for (const auto& l : labels) {
      Jump to = j;
      to.target = l;
      to.condition = nullptr;
      node.cases.emplace_back(number(std::stod(l.text)), std::move(to));
    }
    const LineInfo like = s.line;
    Body pieces;
    std::optional<LabelRef> behind;
    if (j.condition) {
      behind = editor_.fresh_label();
      pieces.push_back(make_jump(like, *behind, negated_condition(j.condition)));
    }
    s.node = std::move(node);
    const std::size_t main = pieces.size();
    pieces.push_back(std::move(s));
    // No label fits: the source stops with an error here.
    if (!j.quiet) pieces.push_back(make_block(like, action(Stop{}, Order::after)));
    if (behind) pieces.push_back(make_label(like, *behind, editor_.program));
    editor_.put_group(out, std::move(pieces), main);
  }

  Editor& editor_;
  std::map<const Expr*, ComputedLabel> values_;
};

}  // namespace

void lower_computed_jumps(Program& program, const LegaliseContext& context) {
  leave_out_refused_data(program, context);
  for (auto& r : program.routines) {
    Editor editor(program, r, context);
    ComputedJumps(editor).run();
  }
}

}  // namespace cnctrans::ir::passes
