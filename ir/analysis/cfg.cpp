// The control-flow graph of a routine.
#include <algorithm>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/text.h"
#include "ir/analysis/dataflow.h"
#include "ir/analysis/value_set.h"
#include "ir/edit/labels.h"
#include "ir/nesting.h"

namespace cnctrans::ir {
namespace {

using Ids = std::vector<std::uint32_t>;

void add_id(Ids& ids, std::uint32_t id) {
  if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
}
void add_ids(Ids& ids, const Ids& more) {
  for (const auto id : more) add_id(ids, id);
}

/// Blocks of the routine are run from another one, or nobody knows which: its ranges have other ends too.
bool run_in_part_elsewhere(const Program& program, const Routine& routine) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      if (const auto* p = std::get_if<Repeat>(&s.node)) found = found || (p->has_program && p->program == routine.name);
      if (const auto* c = std::get_if<CallRoutine>(&s.node))
        found = found || (c->has_range && (c->computed || c->routine == routine.name));
    });
  }
  return found;
}

class Builder {
 public:
  Builder(const Program& program, const Routine& routine) : program_(program), routine_(routine) {}

  ControlFlow build() {
    prepare(routine_.body);
    find_ranges();
    // What follows a repeated range depends on what follows its Repeat, which may itself end a range.
    do {
      for (auto& s : flow_.successors) s.clear();
      jumps_.clear();
      body(routine_.body, {0}, nullptr);
    } while (grow_ranges());
    for (const auto& [from, site] : jumps_) {
      const Ids to = targets(site);
      flow_.successors[from].insert(flow_.successors[from].end(), to.begin(), to.end());
    }
    for (auto& ids : flow_.successors) {
      std::sort(ids.begin(), ids.end());
      ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    }
    end_ranges();
    return std::move(flow_);
  }

 private:
  /// A range of lines run again by `repeat`: after `end` comes `first` again, or what follows the Repeat.
  struct Range {
    std::uint32_t repeat, first, end;
    bool again;  ///< more than once
    /// A pass that jumps past its end ends at the next label of that name: these count as well.
    Ids later_ends{};

    [[nodiscard]] bool ends_at(std::uint32_t id) const {
      return id == end || std::find(later_ends.begin(), later_ends.end(), id) != later_ends.end();
    }
  };

  // Tables by id, groups of joined statements, Repeats.
  void prepare(const Body& b) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      const Statement& s = b[i];
      if (flow_.successors.size() <= s.id) {
        flow_.successors.resize(s.id + 1);
        flow_.statements.resize(s.id + 1);
      }
      flow_.statements[s.id] = &s;
      if (const std::size_t last = detail::line_end(b, i); last != i) line_end_[s.id] = b[last].id;
      if (detail::skippable(b, i)) skipped_.insert(s.id);
      if (std::holds_alternative<Repeat>(s.node)) repeats_.push_back(&s);
      for (const Body* inner : detail::bodies_of(s)) {
        if (inner != nullptr) prepare(*inner);
      }
    }
  }

  const LabelTable& labels() {
    if (!labels_) labels_.emplace(routine_);
    return *labels_;
  }

  void find_ranges() {
    for (const Statement* s : repeats_) {
      const auto& r = std::get<Repeat>(s->node);
      if (r.has_program || r.first.computed || r.last.computed || r.last.text.empty()) continue;
      if (r.curve_use == CurveUse::define || r.curve_use == CurveUse::remove)
        continue;  // its lines run where they stand
      const auto range = labels().range(r, labels().order(s->id));
      if (!range) continue;
      const auto& [first, last] = *range;
      Range range_of{s->id, first.statement, line_end(last.statement), !detail::runs_once_at_most(r.count)};
      if (r.search != Search::whole_first && jumps_past(range_of)) {
        for (const auto& site : labels().all(r.last.text, r.last.is_number)) {
          if (site.order > last.order && site.part == SitePart::statement)
            range_of.later_ends.push_back(line_end(site.statement));
        }
      }
      ranges_.push_back(std::move(range_of));
    }
  }
  /// The last of the statements that stand on one line with this one.
  [[nodiscard]] std::uint32_t line_end(std::uint32_t id) const {
    const auto end = line_end_.find(id);
    return end == line_end_.end() ? id : end->second;
  }
  /// A jump within the range leaves it forward, or may.
  bool jumps_past(const Range& range) {
    const auto past = [&](const Jump& j, std::uint32_t from) {
      if (j.search == Search::to_start) return false;
      if (j.target.computed) return true;
      const auto site = labels().find(j.target, j.search, labels().order(from));
      return site && site->order > labels().order(range.end);
    };
    for (auto id = range.first; id <= range.end; ++id) {
      if (flow_.statements[id] == nullptr) continue;
      const auto& node = flow_.statements[id]->node;
      if (const auto* j = std::get_if<Jump>(&node); j != nullptr && past(*j, id)) return true;
      const auto* w = std::get_if<Switch>(&node);
      if (w == nullptr) continue;
      for (const auto& c : w->cases) {
        if (past(c.second, id)) return true;
      }
      for (const auto& j : w->fallback) {
        if (past(j, id)) return true;
      }
    }
    return false;
  }

  bool grow_ranges() {
    bool grown = false;
    for (const auto& r : ranges_) {
      Ids ends{r.end};
      add_ids(ends, r.later_ends);
      for (const auto end : ends) {
        Ids& more = after_range_[end];
        const std::size_t before = more.size();
        if (r.again) add_id(more, r.first);
        add_ids(more, continuation_[r.repeat]);
        grown |= more.size() != before;
      }
    }
    return grown;
  }

  /// The last statement of a range leads on in the text only where something else than the range comes to it.
  void end_ranges() {
    constexpr std::size_t most_states = 2'000'000;
    if (after_range_.empty() || routine_.body.empty() || flow_.successors.size() * (ranges_.size() + 1) > most_states ||
        run_in_part_elsewhere(program_, routine_))
      return;
    std::unordered_map<std::uint32_t, std::size_t> range_of;  // of a Repeat
    for (std::size_t k = 0; k < ranges_.size(); ++k) range_of[ranges_[k].repeat] = k + 1;
    // What comes next inside the range k (counted from 1; 0: in none), which ends at its last statement.
    std::vector<std::vector<bool>> seen(ranges_.size() + 1, std::vector<bool>(flow_.successors.size()));
    std::vector<std::pair<std::size_t, std::uint32_t>> open;
    const auto reach = [&](std::size_t k, std::uint32_t id) {
      if (id == 0 || seen[k][id]) return;
      seen[k][id] = true;
      open.emplace_back(k, id);
    };
    reach(0, routine_.body.front().id);
    while (!open.empty()) {
      const auto [k, id] = open.back();
      open.pop_back();
      const bool ends = k != 0 && ranges_[k - 1].ends_at(id);
      const auto called = range_of.find(id);
      if (called != range_of.end()) reach(called->second, ranges_[called->second - 1].first);
      if ((ends && !jumps(id)) || std::holds_alternative<Return>(flow_.statements[id]->node)) continue;
      if (called != range_of.end()) {
        for (const auto next : continuation_[id]) reach(k, next);
        continue;
      }
      for (const auto next : flow_.successors[id]) {
        if (!only_behind_range(id, next)) reach(k, next);
      }
    }
    for (const auto& [id, behind] : after_range_) {
      bool otherwise = seen[0][id] || jumps(id) || skipped_.count(id) != 0;
      for (std::size_t k = 1; k <= ranges_.size(); ++k)
        otherwise = otherwise || (seen[k][id] && !ranges_[k - 1].ends_at(id));
      if (otherwise || range_of.count(id) != 0) continue;
      auto& ids = flow_.successors[id];
      std::erase_if(ids,
                    [&, b = &behind](std::uint32_t to) { return std::find(b->begin(), b->end(), to) == b->end(); });
    }
  }
  /// It can go elsewhere than to the next statement.
  [[nodiscard]] bool jumps(std::uint32_t id) const {
    const auto& node = flow_.statements[id]->node;
    return !std::holds_alternative<Block>(node) && !std::holds_alternative<Assign>(node) &&
           !std::holds_alternative<Message>(node) && !std::holds_alternative<Opaque>(node) &&
           !std::holds_alternative<CallRoutine>(node);
  }
  /// The range that ends with the statement has brought this successor along, not the text.
  [[nodiscard]] bool only_behind_range(std::uint32_t id, std::uint32_t next) const {
    const auto behind = after_range_.find(id);
    if (behind == after_range_.end()) return false;
    const auto text = in_text_.find(id);
    const auto in = [next](const Ids& ids) { return std::find(ids.begin(), ids.end(), next) != ids.end(); };
    return in(behind->second) && (text == in_text_.end() || !in(text->second));
  }

  static std::uint32_t entry(const Body& b, std::uint32_t otherwise) { return b.empty() ? otherwise : b.front().id; }
  static void add_entry(Ids& ids, const Body& b, const Ids& otherwise) {
    if (b.empty()) {
      add_ids(ids, otherwise);
    } else {
      add_id(ids, b.front().id);
    }
  }

  /// `after`: what follows the body; `exit`: what follows the innermost loop.
  void body(const Body& b, const Ids& after, const Ids* exit) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      Ids next = i + 1 < b.size() ? Ids{b[i + 1].id} : after;
      if (const auto more = after_range_.find(b[i].id); more != after_range_.end()) {
        in_text_[b[i].id] = next;
        add_ids(next, more->second);
      }
      statement(b[i], next, exit);
      if (skipped_.count(b[i].id) != 0) add_ids(flow_.successors[b[i].id], next);
    }
  }

  void statement(const Statement& s, const Ids& next, const Ids* exit) {
    current_ = s.id;
    Ids& out = flow_.successors[s.id];
    if (const auto* i = std::get_if<If>(&s.node)) {
      add_entry(out, i->then_body, next);
      add_entry(out, i->else_body, next);
      continuation_[s.id] = next;
      body(i->then_body, next, exit);
      body(i->else_body, next, exit);
    } else if (const auto* w = std::get_if<While>(&s.node)) {
      loop(s.id, w->body, next, true);
    } else if (const auto* f = std::get_if<For>(&s.node)) {
      loop(s.id, f->body, next, true);
    } else if (const auto* l = std::get_if<Loop>(&s.node)) {
      loop(s.id, l->body, next, false);
    } else if (const auto* u = std::get_if<Until>(&s.node)) {
      Ids after_body{s.id};
      add_ids(after_body, next);
      continuation_[s.id] = after_body;
      add_entry(out, u->body, after_body);
      body(u->body, after_body, &next);
    } else if (std::holds_alternative<Exit>(s.node)) {
      add_ids(out, exit != nullptr ? *exit : next);
    } else if (const auto* j = std::get_if<Jump>(&s.node)) {
      jump(*j, next);
    } else if (const auto* w2 = std::get_if<Switch>(&s.node)) {
      for (const auto& c : w2->cases) jump(c.second, next);
      for (const auto& j2 : w2->fallback) jump(j2, next);
      if (w2->fallback.empty()) add_ids(out, next);
    } else if (const auto* r = std::get_if<Repeat>(&s.node)) {
      repeat(*r, next);
    } else if (const auto* c = std::get_if<CallRoutine>(&s.node)) {
      if (!c->tail) add_ids(out, next);
    } else if (const auto* back = std::get_if<Return>(&s.node)) {
      add_id(out, 0);
      for (const auto& range : ranges_) {  // in a pass of a repeated part it ends the repeat alone
        if (back->values.empty() && range.first <= s.id && s.id <= range.end) add_ids(out, continuation_[range.repeat]);
      }
    } else if (std::holds_alternative<End>(s.node)) {
      add_id(out, 0);
    } else {
      add_ids(out, next);
    }
  }

  void loop(std::uint32_t id, const Body& b, const Ids& next, bool tests_first) {
    Ids& out = flow_.successors[id];
    add_id(out, entry(b, id));
    if (tests_first) add_ids(out, next);
    continuation_[id] = {id};
    body(b, {id}, &next);
  }

  void jump(const Jump& j, const Ids& next) {
    const std::uint32_t from = current_;
    Ids& out = flow_.successors[from];
    if (j.search == Search::to_start) {
      add_id(out, entry(routine_.body, 0));
    } else if (j.target.computed) {
      computed(j.search, j.target.computed);
      if (j.quiet) add_ids(out, next);
    } else if (const auto site = labels().find(j.target, j.search, labels().order(from))) {
      jumps_.emplace_back(from, *site);
    } else if (j.quiet) {
      add_ids(out, next);
    }
    if (j.condition) add_ids(out, next);
  }

  /// To the labels that the program itself can make of the value; to every label when that is not known.
  void computed(Search search, const ExprPtr& value) {
    const auto from = labels().order(current_);
    if (const auto values = possible_values(program_, value)) {
      for (const double v : *values) {
        if (const auto site = labels().find(shortest(v), true, search, from)) jumps_.emplace_back(current_, *site);
      }
      return;
    }
    for (const auto& site : labels().sites()) {
      if (search == Search::forward && site.order <= from) continue;
      if (search == Search::backward && site.order > from) continue;
      jumps_.emplace_back(current_, site);
    }
  }

  void repeat(const Repeat& r, const Ids& next) {
    Ids& out = flow_.successors[current_];
    if (r.curve_use == CurveUse::define || r.curve_use == CurveUse::remove) return add_ids(out, next);
    continuation_[current_] = next;
    const bool known_range = !r.first.computed && !r.last.computed;
    if (!r.has_program && known_range) {
      const auto from = labels().order(current_);
      const auto range = labels().range(r, from);
      if (range) jumps_.emplace_back(current_, range->first);
      const auto first = r.last.text.empty() ? labels().find(r.first, r.search, from) : std::nullopt;
      if (first) jumps_.emplace_back(current_, *first);
    } else if (!r.has_program) {
      computed(Search::whole_first, r.first.computed);
    }
    // Up to this statement: the range comes back here by itself, and goes on after the last time.
    const bool comes_back_here = known_range && r.last.text.empty();
    if (r.has_program || !known_range || comes_back_here || !detail::runs_at_least_once(r.count)) add_ids(out, next);
  }

  /// Where a jump to a label continues.
  Ids targets(const LabelSite& site) {
    if (site.part == SitePart::statement) return {site.statement};
    return continuation_[site.statement];
  }

  const Program& program_;
  const Routine& routine_;
  std::optional<LabelTable> labels_;  ///< made when the first jump or range asks for it
  ControlFlow flow_;
  std::uint32_t current_ = 0;
  std::unordered_map<std::uint32_t, std::uint32_t> line_end_;  ///< first of joined statements -> the last
  std::unordered_set<std::uint32_t> skipped_;                  ///< statements that a block skip can leave out
  std::vector<const Statement*> repeats_;
  std::vector<Range> ranges_;
  std::unordered_map<std::uint32_t, Ids> after_range_;
  std::unordered_map<std::uint32_t, Ids> in_text_;  ///< what follows the end of a range in the text
  /// Repeats: what follows. Structured statements: what a label on their closing line leads to.
  std::unordered_map<std::uint32_t, Ids> continuation_;
  std::vector<std::pair<std::uint32_t, LabelSite>> jumps_;
};

}  // namespace

ControlFlow control_flow(const Program& program, const Routine& routine) {
  return Builder(program, routine).build();
}

}  // namespace cnctrans::ir
