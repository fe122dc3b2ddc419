#include "legaliser/control/skip_groups.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "ir/edit/lines.h"
#include "ir/edit/rewrite.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

using Names = std::multiset<std::pair<bool, std::string>>;

bool same_language(const Program& program, const LegaliseContext& context) {
  return !program.dialect.empty() && program.dialect == context.target.dialect;
}

Statement forward_jump(const LineInfo& like, const LabelRef& to) {
  Statement s = make_jump(like, to);
  std::get<Jump>(s.node).search = Search::forward;
  return s;
}

/// An end of the line that is under the switch as a whole.
std::size_t line_end(const Body& body, std::size_t i) {
  ++i;
  while (i < body.size() && body[i].line.joined) ++i;
  return i;
}

/// Puts the branches in.
class Opening {
 public:
  explicit Opening(Editor& editor) : editor_(editor), uses_(label_uses(editor.program, editor.routine)) {
    each_line(editor.routine.body, [this](const LineInfo& line) {
      for (const auto& l : labels_on(line)) taken_.insert(l.text);
    });
  }

  Body run(Body&& body) {
    Body out;
    out.reserve(body.size());
    for (std::size_t i = 0; i < body.size();) {
      const std::size_t end = group_end(body, i);
      if (end == i) {
        each_body(body[i], [this](Body& inner) { inner = run(std::move(inner)); });
        out.push_back(std::move(body[i++]));
        continue;
      }
      branch(body, i, end, out);
      i = end;
    }
    return out;
  }

 private:
  /// Behind the lines that make one branch with line `from`; `from` itself: it stays as it is.
  [[nodiscard]] std::size_t group_end(const Body& body, std::size_t from) const {
    const auto mask = body[from].line.skip_mask;
    if (mask == 0 || body[from].line.joined) return from;
    std::size_t end = from;
    bool acts = false;
    for (std::size_t i = from; i < body.size();) {
      const std::size_t next = line_end(body, i);
      if (body[i].line.skip_mask == 0 && is_remark(body[i])) {  // between two of its lines
        i = next;
        continue;
      }
      if (body[i].line.skip_mask != mask || (i != from && reached(body[i].line)) || !can_stand(body, i, next)) break;
      acts = acts || can_act(body, i, next);
      end = i = next;
    }
    return acts ? end : from;
  }
  /// A jump may come here: the branch is not entered at its head then.
  [[nodiscard]] bool reached(const LineInfo& line) const {
    const auto labels = labels_on(line);
    return std::any_of(labels.begin(), labels.end(), [this](const LabelRef& l) { return uses_.is_target(l); });
  }
  [[nodiscard]] bool can_stand(const Body& body, std::size_t begin, std::size_t end) const {
    for (std::size_t i = begin; i < end; ++i) {
      if (is_structure(body[i]) || std::holds_alternative<Declare>(body[i].node)) return false;
      for (const auto& l : labels_on(body[i].line)) {
        if (uses_.is_end(l)) return false;
      }
    }
    return true;
  }
  /// It does something whose effect passes follow. Jumps, ends and values of variables are followed with their mark.
  static bool can_act(const Body& body, std::size_t begin, std::size_t end) {
    return std::any_of(body.begin() + static_cast<std::ptrdiff_t>(begin),
                       body.begin() + static_cast<std::ptrdiff_t>(end), [](const Statement& s) {
                         if (const auto* b = std::get_if<Block>(&s.node)) return !b->empty() || b->repeat_given != 0;
                         const auto* j = std::get_if<Jump>(&s.node);
                         return (j != nullptr && j->condition) || std::holds_alternative<If>(s.node) ||
                                std::holds_alternative<CallRoutine>(s.node) ||
                                std::holds_alternative<ModalCall>(s.node) || std::holds_alternative<Repeat>(s.node);
                       });
  }

  void branch(Body& body, std::size_t begin, std::size_t end, Body& out) {
    LineInfo bare;
    bare.span = body[begin].line.span;
    LineInfo under = bare;
    under.skip_mask = body[begin].line.skip_mask;
    const auto [here, past] = new_labels();
    Body pieces;
    pieces.push_back(forward_jump(under, here));
    pieces.push_back(forward_jump(bare, past));
    pieces.push_back(make_label(bare, here, editor_.program));
    for (std::size_t i = begin; i < end; ++i) {
      body[i].line.skip_mask = 0;
      pieces.push_back(std::move(body[i]));
    }
    pieces.push_back(make_label(bare, past, editor_.program));
    editor_.put_group(out, std::move(pieces), 3);
  }

  /// Names even where the target has numbers: most of them go again, and the numbers stay free.
  std::pair<LabelRef, LabelRef> new_labels() {
    for (;;) {
      const std::string n = std::to_string(++count_);
      LabelRef here = label_of("TAKE" + n, false), past = label_of("SKIP" + n, false);
      if (taken_.count(here.text) == 0 && taken_.count(past.text) == 0) return {std::move(here), std::move(past)};
    }
  }

  Editor& editor_;
  LabelUses uses_;
  std::set<std::string> taken_;  ///< names of the routine's own labels
  int count_ = 0;
};

/// Takes them out.
class Closing {
 public:
  Closing(Program& program, Routine& routine) : outside_(label_uses(program, routine)) {
    for_each_statement(routine.body, [this](Statement& s) { note(s, used_); });
  }

  void run(Body& body) {
    Body out;
    out.reserve(body.size());
    for (std::size_t i = 0; i < body.size();) {
      const std::size_t past = past_label(body, i);
      if (past == 0) {
        each_body(body[i], [this](Body& inner) { run(inner); });
        out.push_back(std::move(body[i++]));
        continue;
      }
      lines(body, i, past, out);
      i = past + 1;
    }
    body = std::move(out);
  }

 private:
  static void note(Statement& s, Names& names) {
    each_label_ref(s, [&names](LabelRef& l, bool /*is_end*/) {
      if (!l.computed) names.insert({l.is_number, l.text});
    });
  }
  static const LabelRef* plain_jump(const Statement& s) {
    const auto* j = std::get_if<Jump>(&s.node);
    return j != nullptr && !j->condition && !j->target.computed && j->search == Search::forward ? &j->target : nullptr;
  }
  static bool is_mark(const Statement& s, const LabelRef& of) {
    const auto labels = labels_on(s.line);
    return std::holds_alternative<Label>(s.node) && labels.size() == 1 && same_label(labels[0], of) &&
           s.line.comments.empty();
  }
  [[nodiscard]] std::size_t used(const LabelRef& l) const { return used_.count({l.is_number, l.text}); }

  /// The place of label B when a branch begins at `i` whose lines can carry its mark; else 0.
  [[nodiscard]] std::size_t past_label(Body& body, std::size_t i) const {
    if (i + 3 >= body.size() || body[i].line.skip_mask == 0 || body[i + 1].line.skip_mask != 0) return 0;
    const LabelRef* here = plain_jump(body[i]);
    const LabelRef* past = plain_jump(body[i + 1]);
    if (here == nullptr || past == nullptr || !is_mark(body[i + 2], *here) || used(*here) != 1) return 0;
    if (!labels_on(body[i + 1].line).empty()) return 0;
    Names inside;
    std::vector<LabelRef> labels;
    for (std::size_t k = i + 3; k < body.size(); ++k) {
      if (is_mark(body[k], *past)) return own_labels(labels, inside) ? k : 0;
      if (is_structure(body[k]) || body[k].line.skip_mask != 0 || std::holds_alternative<Declare>(body[k].node))
        return 0;
      note(body[k], inside);
      for (const auto& l : labels_on(body[k].line)) labels.push_back(l);
      if (auto* branch = std::get_if<If>(&body[k].node)) {
        for (Body* inner : {&branch->then_body, &branch->else_body}) {
          for (auto& s : *inner) note(s, inside);
        }
      }
    }
    return 0;
  }
  /// Nothing outside of the branch leads to a label in it.
  [[nodiscard]] bool own_labels(const std::vector<LabelRef>& labels, const Names& inside) const {
    return std::all_of(labels.begin(), labels.end(), [&](const LabelRef& l) {
      const auto all = used(l);
      return all == inside.count({l.is_number, l.text}) && (all != 0 || !outside_.is_target(l)) && !outside_.is_end(l);
    });
  }

  void lines(Body& body, std::size_t head, std::size_t past, Body& out) const {
    const LineInfo& under = body[head].line;
    bool first = true;
    for (std::size_t k = head + 3; k < past; ++k) {
      Statement& s = body[k];
      if (first) {
        if (!labels_on(s.line).empty() || std::holds_alternative<Label>(s.node)) {
          Statement mark = make_label_line(under);
          if (!labels_on(under).empty() || !under.comments.empty()) out.push_back(std::move(mark));
        } else {
          LineInfo from = under;
          move_before(from, s.line);
        }
      }
      if (!is_remark(s) && !std::holds_alternative<Label>(s.node)) s.line.skip_mask = under.skip_mask;
      if (!first && out.back().line.skip_mask != s.line.skip_mask) s.line.joined = false;  // a line has one mark
      first = false;
      out.push_back(std::move(s));
    }
    if (first && (!labels_on(under).empty() || !under.comments.empty())) out.push_back(make_label_line(under));
    const LabelRef to = labels_on(body[past].line).front();
    if (used(to) > 1) out.push_back(std::move(body[past]));
  }
  /// What the line of the branch showed, with nothing in it.
  static Statement make_label_line(const LineInfo& line) {
    Statement s;
    s.line = line;
    s.line.skip_mask = 0;
    s.node = Label{};
    return s;
  }
  static void move_before(LineInfo& from, LineInfo& to) {
    to.number = from.number;
    to.number_mark = from.number_mark;
    to.labels = std::move(from.labels);
    to.blank_lines_before = std::max(from.blank_lines_before, to.blank_lines_before);
    to.joined = from.joined;
    to.comments.insert(to.comments.begin(), from.comments.begin(), from.comments.end());
  }

  LabelUses outside_;
  Names used_;
};

bool has_marks(const Routine& r) {
  bool found = false;
  for_each_statement(r.body, [&found](const Statement& s) { found = found || s.line.skip_mask != 0; });
  return found;
}

}  // namespace

bool is_structure(const Statement& s) {
  if (const auto* i = std::get_if<If>(&s.node)) return !i->one_line;
  return std::holds_alternative<While>(s.node) || std::holds_alternative<Until>(s.node) ||
         std::holds_alternative<For>(s.node) || std::holds_alternative<Loop>(s.node);
}

void open_skip_groups(Program& program, const LegaliseContext& context) {
  if (same_language(program, context) || context.target.searches.empty()) return;
  for (auto& r : program.routines) {
    if (!has_marks(r)) continue;
    Editor editor(program, r, context);
    r.body = Opening(editor).run(std::move(r.body));
  }
}

void close_skip_groups(Program& program, const LegaliseContext& context) {
  if (same_language(program, context)) return;
  for (auto& r : program.routines) {
    if (has_marks(r)) Closing(program, r).run(r.body);
  }
}

}  // namespace cnctrans::ir::passes
