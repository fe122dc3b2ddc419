// Control flow (equivalences 20): structured statements and switches become jumps where the target lacks them.
#include <algorithm>

#include "legaliser/control/structures.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"
#include "legaliser/expressions/expression_lowering.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

class ControlPass {
 public:
  ControlPass(Editor& editor, const ExactNumbers& numbers)
      : editor_(editor), target_(editor.target()), structures_(editor.program, editor.routine, numbers) {}

  void body(Body& b) {
    Body out;
    out.reserve(b.size());
    for (auto& s : b) one(std::move(s), out);
    b = std::move(out);
  }

 private:
  /// End label of a loop; made when something leaves to it.
  struct LoopEnd {
    std::optional<LabelRef> label;
    bool kept = false;  ///< the loop stays structured
  };

  void one(Statement&& s, Body& out) {
    if (!own() && skipped_structure(s)) return refused_structure(std::move(s), out);
    if (std::holds_alternative<If>(s.node)) return if_else(std::move(s), out);
    if (std::holds_alternative<While>(s.node)) return while_loop(std::move(s), out);
    if (std::holds_alternative<Until>(s.node)) return until_loop(std::move(s), out);
    if (std::holds_alternative<For>(s.node)) return for_loop(std::move(s), out);
    if (std::holds_alternative<Loop>(s.node)) return endless(std::move(s), out);
    if (std::holds_alternative<Switch>(s.node)) return switch_jump(std::move(s), out);
    if (std::holds_alternative<Exit>(s.node)) return exit_loop(std::move(s), out);
    out.push_back(std::move(s));
  }

  /// A mark at the head or the end of a loop, or at ELSE: what the other line does without it is stated nowhere.
  static bool skipped_structure(const Statement& s) {
    if (skipped_else(s)) return true;
    const auto* until = std::get_if<Until>(&s.node);  // its closing line asks
    if (until != nullptr && until->end_line.skip_mask != 0) return true;
    return s.line.skip_mask != 0 && (std::holds_alternative<While>(s.node) || std::holds_alternative<For>(s.node) ||
                                     std::holds_alternative<Loop>(s.node) || std::holds_alternative<Until>(s.node));
  }
  static bool skipped_else(const Statement& s) {
    const auto* branch = std::get_if<If>(&s.node);
    return branch != nullptr && branch->else_line.skip_mask != 0;
  }
  void refused_structure(Statement&& s, Body& out) {
    const bool branch = skipped_else(s);
    refuse(s, editor_.program, editor_.context, "TRN-163",
           branch ? "the ELSE of this IF can be skipped: what is carried out then is stated nowhere"
                  : "a line of a loop can be skipped: what the loop does then is stated nowhere",
           branch ? "put the skip mark on the lines of the branch" : "put a jump with the skip mark before the loop");
    out.push_back(std::move(s));
  }

  // --- pieces ---------------------------------------------------------------------------------------------------

  bool plain_condition(const ExprPtr& e) const {
    return target_.conditions == ConditionForm::expression && expression_fits(e, target_);
  }
  /// The structure stays; its condition is then in the target's form.
  bool stays(ExprPtr& condition, std::initializer_list<const Body*> bodies) const {
    if (target_.conditions == ConditionForm::expression) return expression_fits(condition, target_);
    if (own()) return true;
    if (!structures_.condition_fits(condition, target_) || !all_closed(bodies)) return false;
    condition = in_target_form(condition, target_.compare);
    return true;
  }
  /// An IF of one relation: its sides are put into variables before it.
  bool lifted(ExprPtr& condition, std::initializer_list<const Body*> bodies, const LineInfo& like, Body& pre) {
    if (target_.conditions == ConditionForm::expression || !structures_.relation_fits(condition, target_) ||
        !all_closed(bodies))
      return false;
    const Binary relation = std::get<Binary>(condition->node);
    std::vector<VarRef> taken;
    const auto side = [&](const ExprPtr& e) -> ExprPtr {
      if (structures_.operand_fits(e, target_)) return e;
      const auto v = editor_.take(like);
      if (!v) return nullptr;
      taken.push_back(*v);
      pre.push_back(make_assign(like, *v, e));
      return variable(*v, e->type);
    };
    const ExprPtr left = side(relation.left), right = side(relation.right);
    for (const auto& v : taken) editor_.release(v);
    if (!left || !right) return false;
    condition = in_target_form(binary(relation.op, left, right), target_.compare);
    return true;
  }
  bool all_closed(std::initializer_list<const Body*> bodies) const {
    return target_.conditions == ConditionForm::expression || own() ||
           std::all_of(bodies.begin(), bodies.end(), [this](const Body* b) { return structures_.closed(*b); });
  }
  /// The source speaks the target's language.
  bool own() const { return !editor_.program.dialect.empty() && editor_.program.dialect == target_.dialect; }
  bool may_keep(const LineInfo& line) const { return line.skip_mask == 0 || target_.skip_on_structures; }

  void label(Body& out, const LabelRef& l, const LineInfo& like) {
    out.push_back(make_label(like, l, editor_.program));
  }
  /// The closing line of a structure: its label and comments stay on a mark.
  void closing(Body& out, const LineInfo& line, const std::optional<LabelRef>& l) {
    const bool shows = !line.number.empty() || !line.labels.empty() || !line.comments.empty();
    if (!shows && !l) return;
    Statement s = made(line, Label{});
    s.line = line;
    if (l) {
      if (l->is_number && !line.number.empty())
        label(out, *l, line);
      else
        set_label(s.line, *l, editor_.program);
    }
    out.push_back(std::move(s));
  }
  /// Label of a statement that is jumped to: the one it has, or a new one.
  LabelRef label_of_line(Statement& s) {
    const auto have = labels_on(s.line);
    if (!have.empty()) return have.front();
    const LabelRef fresh = editor_.fresh_label();
    set_label(s.line, fresh, editor_.program);
    return fresh;
  }
  /// A statement in the place of `s`: takes its line.
  template <class Node>
  static Statement in_place(const Statement& s, Node node) {
    Statement n;
    n.line = s.line;
    n.node = std::move(node);
    return n;
  }
  static Jump to(const LabelRef& l, ExprPtr condition = nullptr) {
    Jump j;
    j.target = l;
    j.condition = std::move(condition);
    return j;
  }

  // --- IF -------------------------------------------------------------------------------------------------------

  static bool single_assign(const Body& b) {
    return b.size() == 1 && std::holds_alternative<Assign>(b[0].node) && plain_line(b[0].line);
  }
  /// Nothing of the line is lost when another line takes its words.
  static bool plain_line(const LineInfo& line) {
    return line.comments.empty() && line.number.empty() && line.labels.empty() && line.skip_mask == 0;
  }
  static const Jump* single_jump(const Body& b) {
    if (b.size() != 1 || !b[0].line.number.empty() || !b[0].line.labels.empty()) return nullptr;
    const auto* j = std::get_if<Jump>(&b[0].node);
    return j != nullptr && !j->condition ? j : nullptr;
  }

  void if_else(Statement&& s, Body& out) {
    const If& source = std::get<If>(s.node);
    if (own() && source.one_line && !(single_jump(source.then_body) && source.else_body.empty())) {
      out.push_back(std::move(s));
      return;
    }
    If node = std::move(std::get<If>(s.node));
    if (const Jump* j = single_jump(node.then_body)) {  // IF c GOTO n [ELSE ...]
      Jump jump = *j;
      jump.condition = node.condition;
      Statement first = in_place(s, std::move(jump));
      for (const auto& c : node.then_body[0].line.comments) first.line.comments.push_back(c);
      out.push_back(std::move(first));
      for (auto& e : node.else_body) one(std::move(e), out);
      closing(out, node.end_line, std::nullopt);
      return;
    }
    Body pre;
    if (target_.structured_if && may_keep(s.line) &&
        (stays(node.condition, {&node.then_body, &node.else_body}) ||
         lifted(node.condition, {&node.then_body, &node.else_body}, s.line, pre))) {
      node.one_line = false;
      body(node.then_body);
      body(node.else_body);
      node.has_else = node.has_else || !node.else_body.empty();
      s.node = std::move(node);
      editor_.put(out, std::move(pre), std::move(s));
      return;
    }
    const bool one_action = single_assign(node.then_body) &&
                            (node.else_body.empty() || single_assign(node.else_body)) &&
                            std::get<Assign>(node.then_body[0].node).items.size() == 1;
    // A skip mark leaves the condition out only.
    const bool one_line =
        one_action && s.line.skip_mask == 0 && plain_line(node.else_line) && plain_line(node.end_line);
    if (target_.one_line_if_action && plain_condition(node.condition) && one_line && all_fit(node)) {
      node.one_line = true;
      s.node = std::move(node);
      out.push_back(std::move(s));
      return;
    }
    flatten_if(std::move(s), std::move(node), out);
  }
  bool all_fit(const If& node) const {
    bool fits = true;
    for (const Body* b : {&node.then_body, &node.else_body}) {
      for (const auto& s : *b) {
        each_expression(s, [&](const ExprPtr& e) { fits = fits && expression_fits(e, target_); });
      }
    }
    return fits;
  }

  void flatten_if(Statement&& s, If node, Body& out) {
    const bool has_else = !node.else_body.empty();
    const LabelRef end = editor_.fresh_label();
    const LabelRef other = has_else ? editor_.fresh_label() : end;
    LineInfo like = s.line;
    like.skip_mask = 0;  // only the line of the condition is left out: what stands behind it is carried out up to ELSE
    out.push_back(in_place(s, to(other, negated_condition(node.condition))));
    for (auto& t : node.then_body) one(std::move(t), out);
    if (has_else) {
      LineInfo middle = node.else_line;
      if (!middle.number.empty() || !middle.labels.empty()) {  // a jump to it leaves the branch
        closing(out, middle, std::nullopt);
        middle = LineInfo{};
        middle.span = node.else_line.span;
      }
      out.push_back(make_jump(like, end));
      closing(out, middle, other);
      for (auto& e : node.else_body) one(std::move(e), out);
    }
    LineInfo last = node.end_line;
    if (!last.span.known()) last.span = like.span;
    closing(out, last, end);
  }

  // --- loops ----------------------------------------------------------------------------------------------------

  LabelRef loop_end() {
    LoopEnd& end = loops_.back();
    if (!end.label) end.label = editor_.fresh_label();
    return *end.label;
  }

  void exit_loop(Statement&& s, Body& out) {
    if (loops_.empty()) {
      out.push_back(std::move(s));
      return;
    }
    if (loops_.back().kept && target_.loop_exit) {
      out.push_back(std::move(s));
      return;
    }
    out.push_back(in_place(s, to(loop_end())));
  }

  template <class Node>
  void keep_loop(Statement&& s, Node node, Body& out) {
    loops_.push_back({std::nullopt, true});
    body(node.body);
    const auto end = loops_.back().label;
    loops_.pop_back();
    const LineInfo like = s.line;
    s.node = std::move(node);
    out.push_back(std::move(s));
    if (end) label(out, *end, like);
  }

  void inner(Body& b, Body& out) {
    for (auto& s : b) one(std::move(s), out);
  }
  void finish_loop(Body& out, const LineInfo& end_line, const LineInfo& like) {
    LineInfo line = end_line;
    if (!line.span.known()) line.span = like.span;
    closing(out, line, loops_.back().label);
    loops_.pop_back();
  }

  void while_loop(Statement&& s, Body& out) {
    While node = std::move(std::get<While>(s.node));
    if (target_.while_loop && may_keep(s.line) && stays(node.condition, {&node.body}))
      return keep_loop(std::move(s), std::move(node), out);
    loops_.emplace_back();
    const LineInfo like = s.line;
    Statement test = in_place(s, to(loop_end(), negated_condition(node.condition)));
    const LabelRef start = label_of_line(test);
    out.push_back(std::move(test));
    inner(node.body, out);
    out.push_back(make_jump(like, start));
    finish_loop(out, node.end_line, like);
  }

  void until_loop(Statement&& s, Body& out) {
    Until node = std::move(std::get<Until>(s.node));
    if (target_.until_loop && may_keep(s.line) && stays(node.condition, {&node.body}))
      return keep_loop(std::move(s), std::move(node), out);
    loops_.emplace_back();
    const LineInfo like = s.line;
    Statement head = in_place(s, Label{});
    const LabelRef start = label_of_line(head);
    out.push_back(std::move(head));
    inner(node.body, out);
    Statement back =
        made(node.end_line.span.known() ? node.end_line : like, to(start, negated_condition(node.condition)));
    back.line.number = node.end_line.number;
    back.line.labels = node.end_line.labels;
    back.line.comments = node.end_line.comments;
    out.push_back(std::move(back));
    finish_loop(out, LineInfo{}, like);
  }

  void endless(Statement&& s, Body& out) {
    Loop node = std::move(std::get<Loop>(s.node));
    if (target_.endless_loop && may_keep(s.line)) return keep_loop(std::move(s), std::move(node), out);
    loops_.emplace_back();
    const LineInfo like = s.line;
    Statement head = in_place(s, Label{});
    const LabelRef start = label_of_line(head);
    out.push_back(std::move(head));
    inner(node.body, out);
    out.push_back(make_jump(like, start));
    finish_loop(out, node.end_line, like);
  }

  /// The loop's end has been passed: by the sign of the step.
  static ExprPtr passed(const For& f) {
    const ExprPtr counter = variable(f.counter);
    const ExprPtr above = binary(BinaryOp::gt, counter, f.to), below = binary(BinaryOp::lt, counter, f.to);
    if (!f.step) return above;
    if (const auto step = constant_value(f.step)) return *step < 0 ? below : above;
    const ExprPtr up = binary(BinaryOp::ge, f.step, number(0)), down = binary(BinaryOp::lt, f.step, number(0));
    return binary(BinaryOp::logical_or, binary(BinaryOp::logical_and, up, above),
                  binary(BinaryOp::logical_and, down, below));
  }

  bool for_fits(const For& f) const {
    if (target_.conditions == ConditionForm::expression) {
      return expression_fits(f.from, target_) && expression_fits(f.to, target_) &&
             (!f.step || expression_fits(f.step, target_));
    }
    if (own()) return true;
    const bool step = !f.step || (constant_value(f.step).value_or(0) != 0 && structures_.operand_fits(f.step, target_));
    return step && structures_.operand_fits(f.from, target_) && structures_.operand_fits(f.to, target_) &&
           all_closed({&f.body});
  }

  void for_loop(Statement&& s, Body& out) {
    For node = std::move(std::get<For>(s.node));
    const bool unit_step = !node.step || constant_value(node.step) == 1.0;
    if (target_.conditions != ConditionForm::expression) {
      for (ExprPtr* e : {&node.from, &node.to, &node.step}) *e = structures_.unrounded(*e);
    }
    if (target_.for_loop && (unit_step || target_.for_step) && for_fits(node) && may_keep(s.line)) {
      return keep_loop(std::move(s), std::move(node), out);
    }
    loops_.emplace_back();
    const LineInfo like = s.line;
    Assign first;
    first.items.push_back({node.counter, node.from, {}, {}, false});
    out.push_back(in_place(s, std::move(first)));
    Statement test = made(like, to(loop_end(), passed(node)));
    const LabelRef start = label_of_line(test);
    out.push_back(std::move(test));
    inner(node.body, out);
    const ExprPtr step = node.step ? node.step : number(1);
    const auto literal = constant_value(step);
    const ExprPtr next = literal && *literal < 0 ? binary(BinaryOp::subtract, variable(node.counter), number(-*literal))
                                                 : binary(BinaryOp::add, variable(node.counter), step);
    out.push_back(make_assign(like, node.counter, next));
    out.push_back(make_jump(like, start));
    finish_loop(out, node.end_line, like);
  }

  // --- switches and computed jumps ------------------------------------------------------------------------------

  void switch_jump(Statement&& s, Body& out) {
    if (target_.switch_jump) {
      out.push_back(std::move(s));
      return;
    }
    Switch node = std::move(std::get<Switch>(s.node));
    ExprPtr value = node.value;
    Body pieces;
    if (!is_primary(value)) {
      if (const auto v = editor_.take(s.line)) {
        pieces.push_back(make_assign(s.line, *v, value));
        value = variable(*v, value->type);
        editor_.release(*v);
      }
    }
    const auto add = [&](const Jump& jump, ExprPtr condition) {
      Jump j = jump;
      j.condition = std::move(condition);
      pieces.push_back(made(s.line, std::move(j)));
    };
    for (const auto& [test, jump] : node.cases) add(jump, binary(BinaryOp::eq, value, test));
    for (const auto& jump : node.fallback) add(jump, nullptr);
    if (pieces.empty()) return;
    s.node = std::move(pieces.front().node);
    pieces.front() = std::move(s);
    editor_.put_group(out, std::move(pieces), 0);
  }

  Editor& editor_;
  const Capabilities& target_;
  Structures structures_;
  std::vector<LoopEnd> loops_;
};

}  // namespace

void lower_structures(Editor& editor, Body& body) {
  const ExactNumbers numbers(editor.program);
  ControlPass(editor, numbers).body(body);
}

void lower_control(Program& program, const LegaliseContext& context) {
  const ExactNumbers numbers(program);
  for (auto& r : program.routines) {
    Editor editor(program, r, context);
    ControlPass(editor, numbers).body(r.body);
  }
}

}  // namespace cnctrans::ir::passes
