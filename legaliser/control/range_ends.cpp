// Ends of ranges (equivalences 20.4): a line with an assignment beside its words is several statements, and the range
// that ends at its number ends behind the last of them. A last line that later passes may write as several (a call, a
// condition, a point of a modal call) has the end behind it on a mark, which goes where it stayed one line.
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "ir/edit/lines.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/editor.h"
#include "legaliser/edit/refuse.h"

namespace cnctrans::ir::passes {

namespace {

/// A move in machine coordinates behind which the target selects the offset again.
bool ends_offset(const Block& b, const Capabilities& target) {
  return target.machine_move_ends_offset && b.has_motion && b.motion.frame == FrameUse::machine;
}

class RangeEnds {
 public:
  RangeEnds(Program& program, Routine& routine, const LegaliseContext& context)
      : program_(program), routine_(routine), editor_(program, routine, context), uses_(label_uses(program, routine)) {
    branches_turns_ = context.target_machine.policies.rotary_direction == machine::RotaryDirection::in_word;
  }

  void run() {
    if (program_.dialect != editor_.context.target.dialect) {
      refuse_ends_at_else();
      refuse_broken_parts();
    }
    each_line(routine_.body, [this](const LineInfo& line) {
      for (const auto& l : labels_on(line)) ++carriers_[{l.is_number, l.text}];
    });
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [this](const Statement& s) {
        modal_calls_ = modal_calls_ || std::holds_alternative<ModalCall>(s.node);
      });
    }
    for_each_statement(routine_.body, [this](const Statement& s) {
      const auto* r = std::get_if<Repeat>(&s.node);
      if (r != nullptr && !r->has_program && r->search != Search::whole_first)
        nearest_.insert({r->last.is_number, r->last.text});
    });
    walk(routine_.body);
    for (const auto& [from, to] : moved_) redirect(from, to);
  }

 private:
  void walk(Body& body) {
    Body out;
    out.reserve(body.size());
    for (std::size_t i = 0; i < body.size();) {
      std::size_t end = i + 1;
      while (end < body.size() && body[end].line.joined) ++end;
      if (end == i + 1) to_here(body[i], out);
      line(body, i, end, out);
      behind_loop(out);
      i = end;
    }
    body = std::move(out);
  }

  /// The statements of one line of the source.
  void line(Body& body, std::size_t begin, std::size_t end, Body& out) {
    for (std::size_t k = begin; k < end; ++k) each_body(body[k], [this](Body& inner) { walk(inner); });
    const LineInfo like = body[begin].line;
    const auto labels = labels_on(like);
    const bool ends = std::any_of(labels.begin(), labels.end(), [this](const LabelRef& l) { return uses_.is_end(l); });
    const bool grows = may_grow(body[end - 1]) && meant(labels);
    if (ends && grows) {
      put(body, begin, end, out);
      const LabelRef fresh = editor_.fresh_label();
      out.push_back(make_label(like, fresh, program_));
      for (const auto& l : labels) moved_.emplace_back(l, fresh);
      pass(labels);
      return;
    }
    if (ends && end - begin > 1 && meant(labels)) {
      const LabelRef fresh = editor_.fresh_label();
      body[end - 1].line.joined = false;
      set_label(body[end - 1].line, fresh, program_);
      for (const auto& l : labels) moved_.emplace_back(l, fresh);
    } else if (ends && end - begin > 1 && labels.size() == 1 && !uses_.is_target(labels[0])) {
      // One of several marks of this name (ENDLABEL): it goes along, its name is settled later.
      body[begin].line.labels.clear();
      if (labels[0].is_number) body[begin].line.number = {};
      body[end - 1].line.joined = false;
      set_label(body[end - 1].line, labels[0], program_);
    }
    put(body, begin, end, out);
    pass(labels);
  }
  void pass(const std::vector<LabelRef>& labels) {
    for (const auto& l : labels) passed_.insert({l.is_number, l.text});
  }
  /// Exits of a loop come to the line behind it. Written as jumps they must not pass over the end of a part that ends
  /// with the loop.
  void behind_loop(Body& out) {
    Statement& s = out.back();
    const LineInfo* line = loop_end(s);
    if (line == nullptr || !has_exit(s)) return;
    const auto labels = labels_on(*line);
    const bool ends = std::any_of(labels.begin(), labels.end(), [this](const LabelRef& l) { return uses_.is_end(l); });
    const bool here = ends && meant(labels);
    pass(labels);
    if (!here) return;
    const LabelRef fresh = editor_.fresh_label();
    for (const auto& l : labels) moved_.emplace_back(l, fresh);
    out.push_back(make_label(*line, fresh, program_));
  }
  /// The closing line of a loop.
  static const LineInfo* loop_end(const Statement& s) {
    return std::visit(
        [](const auto& node) -> const LineInfo* {
          if constexpr (requires {
                          node.body;
                          node.end_line;
                        })
            return &node.end_line;
          else
            return nullptr;
        },
        s.node);
  }
  /// Some way leaves the loop by an exit, not one of a loop inside.
  static bool has_exit(Statement& s) {
    bool found = std::holds_alternative<Exit>(s.node);
    each_body(s, [&found](Body& body) {
      for (auto& inner : body) found = found || (loop_end(inner) == nullptr && has_exit(inner));
    });
    return found;
  }
  /// Each of the labels means this line: no other one has it, or this is the first and the first counts.
  [[nodiscard]] bool meant(const std::vector<LabelRef>& labels) {
    return std::all_of(labels.begin(), labels.end(), [this](const LabelRef& l) {
      const auto key = std::make_pair(l.is_number, l.text);
      return carriers_[key] == 1 || (passed_.count(key) == 0 && nearest_.count(key) == 0);
    });
  }
  static void put(Body& body, std::size_t begin, std::size_t end, Body& out) {
    for (std::size_t k = begin; k < end; ++k) out.push_back(std::move(body[k]));
  }

  /// The part that is repeated ends right before the repetition.
  void to_here(Statement& s, Body& out) {
    auto* r = std::get_if<Repeat>(&s.node);
    if (r == nullptr || r->has_program || r->first.computed || r->last.computed || !r->last.text.empty() ||
        out.empty() || !may_grow(out.back()))
      return;
    r->last = editor_.fresh_label();
    out.push_back(make_label(out.back().line, r->last, program_));
  }

  /// A statement that the target may say with several.
  [[nodiscard]] bool may_grow(const Statement& s) const {
    if (const auto* b = std::get_if<Block>(&s.node))
      return modal_calls_ || action_in<CycleDefine>(*b) != nullptr || action_in<SurfaceSet>(*b) != nullptr ||
             (branches_turns_ && turns_by_a_sign(*b)) || ends_offset(*b, editor_.context.target);
    if (const auto* i = std::get_if<If>(&s.node)) {
      const bool jump = i->then_body.size() == 1 && std::holds_alternative<Jump>(i->then_body[0].node);
      return !jump || !i->else_body.empty();
    }
    return !std::holds_alternative<Assign>(s.node) && !std::holds_alternative<Jump>(s.node) &&
           !std::holds_alternative<Label>(s.node) && !std::holds_alternative<Opaque>(s.node);
  }

  /// A computed sign that says which way a rotary axis turns.
  static bool turns_by_a_sign(const Block& b) {
    return b.has_motion && std::any_of(b.motion.coords.begin(), b.motion.coords.end(), [](const CoordWord& w) {
             return w.direction == RotaryDirection::by_sign && !w.value.literal();
           });
  }

  /// What the way that does not come to the line carries out is stated nowhere.
  void refuse_ends_at_else() {
    std::set<std::pair<bool, std::string>> marks;
    for_each_statement(routine_.body, [&marks](const Statement& s) {
      const auto* branch = std::get_if<If>(&s.node);
      if (branch == nullptr || !branch->has_else) return;
      for (const auto& l : labels_on(branch->else_line)) marks.emplace(l.is_number, l.text);
    });
    if (marks.empty()) return;
    for_each_statement(routine_.body, [&](Statement& s) {
      const auto* r = std::get_if<Repeat>(&s.node);
      if (r == nullptr || r->has_program) return;
      const auto at_mark = [&marks](const LabelRef& l) {
        return !l.computed && marks.count({l.is_number, l.text}) != 0;
      };
      if (at_mark(r->first) || at_mark(r->last))
        refuse(s, program_, editor_.context, "TRN-163",
               "the repeated part begins or ends at the ELSE of an IF: what is carried out then is stated nowhere",
               "put the number on a line of the branch");
    });
  }

  /// Whether a run of the part comes to its end depends on a condition, or the part repeats itself.
  void refuse_broken_parts() {
    struct Place {
      const Body* body = nullptr;
      std::size_t at = 0, end = 0;  ///< lines: its own, and the last one inside of it
    };
    std::map<std::pair<bool, std::string>, Place> places;
    struct Part {
      Statement* s;
      std::size_t at;
      const LabelRef *first, *last;
    };
    std::vector<Part> parts;
    std::size_t n = 0;
    const std::function<void(Body&)> look = [&](Body& body) {
      for (auto& s : body) {
        if (!s.line.joined) ++n;
        const auto at = n;
        if (const auto* r = std::get_if<Repeat>(&s.node); r != nullptr && !r->has_program)
          parts.push_back({&s, n, &r->first, &r->last});
        if (const auto* c = std::get_if<CallRoutine>(&s.node);
            c != nullptr && c->has_range && !c->computed && program_.find(c->routine) == &routine_)
          parts.push_back({&s, n, &c->first, &c->last});
        each_body(s, look);
        for (const auto& l : labels_on(s.line))
          places.emplace(std::make_pair(l.is_number, l.text), Place{&body, at, n});
      }
    };
    look(routine_.body);
    for (const auto& [s, at, from, to] : parts) {
      if (from->computed || to->computed) continue;
      const auto first = places.find({from->is_number, from->text}), last = places.find({to->is_number, to->text});
      if (first == places.end() || last == places.end()) continue;
      const bool broken = first->second.body != last->second.body;
      const bool itself = at >= first->second.at && at <= last->second.end;
      if (!broken && !itself) continue;
      refuse(*s, program_, editor_.context, "TRN-163",
             broken ? "the repeated part begins or ends in a branch or loop that it does not begin and end in"
                    : "the repeated part repeats itself: where its runs end is stated nowhere",
             broken ? "let the part begin and end in the same branch" : "put the repetition behind the part");
    }
  }

  void redirect(const LabelRef& from, const LabelRef& to) {
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [&](Statement& s) {
        if (auto* c = std::get_if<CallRoutine>(&s.node)) {
          if (c->has_range && program_.find(c->routine) == &routine_) change(c->last, from, to);
        } else if (auto* x = std::get_if<Repeat>(&s.node)) {
          const bool here = x->has_program ? program_.find(x->program) == &routine_ : &r == &routine_;
          if (here) change(x->last, from, to);
        }
      });
    }
  }
  static void change(LabelRef& last, const LabelRef& from, const LabelRef& to) {
    if (!last.computed && same_label(last, from)) last = to;
  }

  Program& program_;
  Routine& routine_;
  Editor editor_;
  LabelUses uses_;
  std::vector<std::pair<LabelRef, LabelRef>> moved_;
  std::map<std::pair<bool, std::string>, int> carriers_;  ///< lines that carry a label
  std::set<std::pair<bool, std::string>> passed_;         ///< labels of the lines so far
  std::set<std::pair<bool, std::string>> nearest_;        ///< labels of which an end is the next one, not the first
  bool modal_calls_ = false;
  bool branches_turns_ = false;  ///< a turn by a computed sign becomes a branch
};

/// Marks at ends of ranges that nothing but the range asks for, behind one line: that line is the end.
class EndMarks {
 public:
  EndMarks(Program& program, Routine& routine, const Capabilities& target)
      : program_(program), routine_(routine), target_(target), uses_(label_uses(program, routine)) {}

  void run() { walk(routine_.body); }

 private:
  void walk(Body& body) {
    for (std::size_t i = 0; i < body.size(); ++i) {
      each_body(body[i], [this](Body& inner) { walk(inner); });
      if (i > 0 && is_mark(body[i]) && take(body[i - 1], labels_on(body[i].line).front()))
        body.erase(body.begin() + static_cast<std::ptrdiff_t>(i--));
    }
  }
  [[nodiscard]] bool is_mark(const Statement& s) const {
    const auto labels = labels_on(s.line);
    return std::holds_alternative<Label>(s.node) && labels.size() == 1 && s.line.comments.empty() && !s.line.joined &&
           s.line.skip_mask == 0 && uses_.is_end(labels[0]) && !uses_.is_target(labels[0]) && !computed();
  }
  [[nodiscard]] bool computed() const { return uses_.computed || uses_.computed_name; }

  /// The line before takes the mark's place; false: it is no single line.
  bool take(Statement& s, const LabelRef& mark) {
    const auto* branch = std::get_if<If>(&s.node);
    const auto* block = std::get_if<Block>(&s.node);
    const bool one = (block != nullptr && !ends_offset(*block, target_)) || std::holds_alternative<Assign>(s.node) ||
                     std::holds_alternative<CallRoutine>(s.node) || (branch != nullptr && branch->one_line);
    if (!one || s.line.joined || s.line.skip_mask != 0 || ends_a_hole(s)) return false;
    const auto have = labels_on(s.line);
    if (have.empty()) {
      set_label(s.line, mark, program_);
      return true;
    }
    const auto fits = std::find_if(have.begin(), have.end(), [this](const LabelRef& l) {
      return carried_once(l) && (l.is_number ? !target_.repeat_needs_identifiers : target_.identifier_labels);
    });
    const LabelRef to = fits != have.end() ? *fits : have.front();
    if (!carried_once(to) || !carried_once(mark)) return false;  // ENDLABEL, say, ends other ranges elsewhere
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [&](Statement& x) {
        each_label_ref(x, [&](LabelRef& l, bool is_end) {
          if (is_end && same_label(l, mark) && &r == &routine_) l = to;
        });
        if (auto* c = std::get_if<CallRoutine>(&x.node);
            c != nullptr && c->has_range && same_label(c->last, mark) && program_.find(c->routine) == &routine_)
          c->last = to;
        if (auto* p = std::get_if<Repeat>(&x.node);
            p != nullptr && p->has_program && same_label(p->last, mark) && program_.find(p->program) == &routine_)
          p->last = to;
      });
    }
    return true;
  }
  /// One run of a hole cycle: a line behind it ends the cycle, where the target's is modal by itself.
  [[nodiscard]] bool ends_a_hole(const Statement& s) const {
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr || target_.modal_cycle_by_call) return false;
    return std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
      const auto* d = std::get_if<CycleDefine>(&a.data);
      return d != nullptr && !d->modal && d->cycle && std::holds_alternative<HoleCycle>(d->cycle->node);
    });
  }
  [[nodiscard]] bool carried_once(const LabelRef& label) const {
    int count = 0;
    for_each_statement(routine_.body, [&](const Statement& s) {
      for (const auto& l : labels_on(s.line)) count += same_label(l, label) ? 1 : 0;
    });
    return count == 1;
  }

  Program& program_;
  Routine& routine_;
  const Capabilities& target_;
  LabelUses uses_;
};

}  // namespace

void mark_range_ends(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect && !program.dialect.empty()) return;  // the lines stay as they are
  for (auto& r : program.routines) RangeEnds(program, r, context).run();
}

void fold_range_ends(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect && !program.dialect.empty()) return;
  for (auto& r : program.routines) EndMarks(program, r, context.target).run();
}

}  // namespace cnctrans::ir::passes
