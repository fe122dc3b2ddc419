// Labels (equivalences 2.3, 20.1): every jump finds the same block under the target's way of searching; duplicates get
// names of their own, identifiers become numbers where the target has numbers only, limits are kept.
#include <algorithm>
#include <charconv>
#include <map>

#include "ir/edit/labels.h"
#include "legaliser/edit/editor.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

class LabelPass {
 public:
  LabelPass(Program& program, Routine& routine, const LegaliseContext& context)
      : program_(program), routine_(routine), context_(context), target_(context.target) {}

  void run() {
    collect();
    resolve_all();
    if (computed_ && !target_.computed_jump) computed_ = false;  // the control pass has reported
    name_targets();
    apply();
    write_references();
  }

 private:
  struct Mark {
    Statement* s = nullptr;
    std::size_t position = 0;
    LabelRef label;
    bool used = false, range = false;
    bool hidden = false;  ///< another block with the same label is found first
    std::optional<LabelRef> renamed;
  };
  struct Use {
    Statement* s;
    LabelRef* ref;
    std::size_t position;
    std::size_t mark = 0;
    bool found = false, range = false;
    bool outside = false;  ///< in a call of another routine, or in one of this routine by its name
  };

  void collect() {
    std::size_t position = 0;
    for_each_statement(routine_.body, [&](Statement& s) {
      ++position;
      positions_[&s] = position;
      for (const auto& l : labels_on(s.line)) marks_.push_back({&s, position, l, false, false, false, std::nullopt});
    });
    for_each_statement(routine_.body, [&](Statement& s) {
      each_label_ref(s, [&](LabelRef& l, bool) {
        if (l.computed) {
          computed_ = true;
          const Search search = search_of(s);
          directed_ = directed_ || (search != Search::whole_first && target_.searches.count(search) == 0);
          return;
        }
        uses_.push_back({&s, &l, positions_[&s], 0, false, std::holds_alternative<Repeat>(s.node)});
      });
    });
    for (auto& other : program_.routines)
      for_each_statement(other.body, [this](Statement& s) { collect_called_part(s); });
  }

  /// Blocks of this routine that other routines run: their labels get their names here.
  void collect_called_part(Statement& s) {
    auto* c = std::get_if<CallRoutine>(&s.node);
    auto* r = std::get_if<Repeat>(&s.node);
    const bool call = c != nullptr && c->has_range && !c->computed && program_.find(c->routine) == &routine_;
    const bool part = r != nullptr && r->has_program && program_.find(r->program) == &routine_;
    if (!call && !part) return;
    for (LabelRef* l : {call ? &c->first : &r->first, call ? &c->last : &r->last}) {
      if (!l->computed && !l->text.empty()) uses_.push_back({&s, l, 0, 0, false, true, true});
    }
  }

  static Search search_of(const Statement& s) {
    if (const auto* j = std::get_if<Jump>(&s.node)) return j->search;
    if (const auto* r = std::get_if<Repeat>(&s.node)) return r->search;
    return Search::whole_first;
  }

  /// The mark that the source's search finds.
  std::optional<std::size_t> find(const LabelRef& l, std::size_t from, Search search) const {
    std::optional<std::size_t> forward, backward, first;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      if (!same_label(marks_[i].label, l)) continue;
      if (!first) first = i;
      if (marks_[i].position <= from)
        backward = i;
      else if (!forward)
        forward = i;
    }
    switch (search) {
      case Search::whole_first:
      case Search::to_start: return first;
      case Search::forward: return forward;
      case Search::backward: return backward;
      case Search::forward_then_backward: return forward ? forward : backward;
    }
    return first;
  }

  /// The mark of one end of a repeated range, as the table of labels finds it.
  std::optional<std::size_t> end_of_range(const Use& u, const Repeat& r, const LabelTable& table) const {
    std::optional<LabelSite> site;
    if (r.last.text.empty() || r.last.computed || r.first.computed) {
      site = table.find(*u.ref, r.search, table.order(u.s->id));
    } else if (const auto range = table.range(r, table.order(u.s->id))) {
      const auto has = [&](const LabelSite& at) {
        const auto& all = table.all(u.ref->text, u.ref->is_number);
        return std::find(all.begin(), all.end(), at) != all.end();
      };
      const bool first = u.ref == &r.first ? has(range->first) : !has(range->second);
      site = first ? range->first : range->second;
    }
    if (!site) return std::nullopt;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      if (marks_[i].s->id == site->statement && same_label(marks_[i].label, *u.ref)) return i;
    }
    return std::nullopt;
  }

  void resolve_all() {
    const LabelTable table(routine_);
    for (auto& u : uses_) {
      Search search = search_of(*u.s);
      if (const auto* sw = std::get_if<Switch>(&u.s->node)) search = search_in_switch(*sw, u.ref);
      if (search == Search::to_start) continue;
      if (u.outside) search = Search::whole_first;
      const auto* repeat = std::get_if<Repeat>(&u.s->node);
      const auto mark =
          repeat != nullptr && !u.outside ? end_of_range(u, *repeat, table) : find(*u.ref, u.position, search);
      if (!mark) continue;  // reported when the source is checked
      u.mark = *mark;
      u.found = true;
      marks_[*mark].used = true;
      marks_[*mark].range = marks_[*mark].range || u.range;
    }
  }
  static Search search_in_switch(const Switch& sw, const LabelRef* ref) {
    for (const auto& c : sw.cases) {
      if (&c.second.target == ref) return c.second.search;
    }
    for (const auto& f : sw.fallback) {
      if (&f.target == ref) return f.search;
    }
    return Search::whole_first;
  }

  // --- names ----------------------------------------------------------------------------------------------------

  bool takes(const Mark& m) const {
    if (!m.label.is_number) return target_.identifier_labels && plain(m.label.text) == m.label.text;
    if (m.range && target_.repeat_needs_identifiers && target_.identifier_labels && is_range_of_repeat(m)) return false;
    if (!target_.number_labels) return false;
    std::int64_t n = 0;
    const auto& t = m.label.text;
    const auto r = std::from_chars(t.data(), t.data() + t.size(), n);
    return r.ec == std::errc{} && n <= target_.label_max;
  }
  [[nodiscard]] std::string plain(const std::string& name) const {
    return target_.plain_name ? target_.plain_name(name) : name;
  }
  bool is_range_of_repeat(const Mark& m) const {
    return std::any_of(uses_.begin(), uses_.end(),
                       [&](const Use& u) { return u.range && u.found && &marks_[u.mark] == &m; });
  }

  void name_targets() {
    Editor editor(program_, routine_, context_);
    bool renumber = false;
    std::map<std::pair<bool, std::string>, std::size_t> seen;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      if (marks_[i].used) used_marks_[{marks_[i].label.is_number, marks_[i].label.text}].push_back(i);
    }
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      Mark& m = marks_[i];
      const auto key = std::make_pair(m.label.is_number, m.label.text);
      const bool duplicate = !seen.emplace(key, i).second;
      m.hidden = duplicate;
      if (duplicate && computed_ && directed_ && m.label.is_number) {
        context_.diagnostics.error("TRN-192", m.s->line.span,
                                   "the number of this block stands twice, and a jump to a computed number looks for "
                                   "the nearest one; the target takes the first",
                                   "give the block another number");
      }
      if (!m.used && !(computed_ && m.label.is_number)) {
        drop_if_needed(m, duplicate);
        continue;
      }
      if (!takes(m)) {
        if (m.label.is_number && !(m.range && target_.repeat_needs_identifiers)) renumber = true;
        m.renamed = new_name(editor, m);
      } else if (duplicate) {
        m.renamed = editor.fresh_label();
      }
    }
    // A number that is kept may be found under the same number by others: first one wins, the rest have new names.
    if (renumber && computed_) {
      context_.diagnostics.error("TRN-192", routine_.header.span,
                                 "labels above the target's limit in a routine with a jump to a computed label",
                                 "use labels up to " + std::to_string(target_.label_max));
    }
  }

  /// An unused label that the target can't carry or that would be found in place of another.
  void drop_if_needed(Mark& m, bool duplicate) const {
    const auto used = used_marks_.find({m.label.is_number, m.label.text});
    const bool first_of_used =
        used != used_marks_.end() && std::any_of(used->second.begin(), used->second.end(),
                                                 [&](std::size_t o) { return &marks_[o] != &m && !marks_[o].renamed; });
    if (!m.label.is_number) {
      if (!takes(m) || duplicate || first_of_used) m.renamed = LabelRef{};
      return;
    }
    if (first_of_used || !takes(m)) m.renamed = LabelRef{};
  }

  LabelRef new_name(Editor& editor, const Mark& m) {
    if (m.label.is_number && target_.identifier_labels) {
      for (const Mark& o : marks_) {  // a block has one label: the name that a cycle knows it by, say
        if (o.s == m.s && !o.label.is_number && !o.renamed) return o.label;
      }
      const std::string wanted = target_.label_prefix + m.label.text;
      if (!taken(LabelRef{wanted, false, nullptr})) return LabelRef{wanted, false, nullptr};
    }
    if (!m.label.is_number && target_.identifier_labels) {
      const LabelRef wanted{plain(m.label.text), false, nullptr};
      if (!wanted.text.empty() && !taken(wanted)) return wanted;
    }
    LabelRef fresh = editor.fresh_label();
    while (taken(fresh)) fresh = editor.fresh_label();
    return fresh;
  }
  /// A label of the routine has the name, or has been given it.
  [[nodiscard]] bool taken(const LabelRef& name) const {
    return std::any_of(marks_.begin(), marks_.end(), [&name](const Mark& o) {
      return same_label(o.label, name) || (o.renamed && same_label(*o.renamed, name));
    });
  }

  // --- writing --------------------------------------------------------------------------------------------------

  void apply() {
    for (auto& m : marks_) {
      if (!m.renamed) continue;
      LineInfo& line = m.s->line;
      const bool dropped = m.renamed->text.empty();
      if (m.label.is_number) {
        // The number of a block that got a name as well stays for the eye where the target numbers its blocks freely.
        // Not so where a computed jump would find it instead of the first one.
        const bool found_too = m.hidden && computed_;
        if (dropped || m.renamed->is_number || !target_.duplicate_labels || found_too) line.number = {};
      } else {
        std::erase_if(line.labels,
                      [&](std::string_view l) { return same_label(label_of(std::string(l), false), m.label); });
      }
      if (!dropped) {
        if (!m.label.is_number && m.renamed->is_number) keep_as_comment(line, m.label.text);
        if (m.renamed->is_number && !line.number.empty())
          second_number(m);
        else if (!has_label(line, *m.renamed))
          set_label(line, *m.renamed, program_);
      }
      if (context_.report != nullptr && !dropped) {
        const std::string owner = routine_.name.number >= 0 ? std::to_string(routine_.name.number) : routine_.name.text;
        context_.report->renamed.push_back({Renamed::Kind::label, label_text(m.label), label_text(*m.renamed), owner});
      }
    }
  }
  static bool has_label(const LineInfo& line, const LabelRef& label) {
    const auto have = labels_on(line);
    return std::any_of(have.begin(), have.end(), [&label](const LabelRef& l) { return same_label(l, label); });
  }

  /// Two labels on one line, and numbers only: the number that stands there serves both, but for one that an earlier
  /// block has too and that is found there.
  void second_number(Mark& m) {
    LineInfo& line = m.s->line;
    const LabelRef number = label_of(std::string(line.number), true);
    const auto hidden = [&](const Mark& o) {
      return o.s == m.s && o.hidden && !o.renamed && same_label(o.label, number);
    };
    if (std::none_of(marks_.begin(), marks_.end(), hidden)) {
      m.renamed = number;
      return;
    }
    line.number = {};
    set_label(line, *m.renamed, program_);
  }

  void keep_as_comment(LineInfo& line, const std::string& name) {
    CommentText c;
    c.text = program_.keep(name);
    line.comments.push_back(c);
  }

  Search target_search(const Use& u) const {
    const auto& searches = target_.searches;
    if (searches.empty() || searches.count(Search::whole_first) != 0) return Search::whole_first;
    const Search wanted = marks_[u.mark].position > u.position ? Search::forward : Search::backward;
    if (searches.count(wanted) != 0) return wanted;
    return Search::forward_then_backward;
  }

  void write_references() {
    for (auto& u : uses_) {
      if (!u.found) continue;
      const Mark& m = marks_[u.mark];
      if (m.renamed) *u.ref = *m.renamed;
      if (u.outside) continue;
      const Search search = target_search(u);
      if (auto* j = std::get_if<Jump>(&u.s->node)) {
        // A jump that would pass over a missing label has one: where it must search both ways to be quiet it may, else
        // it is a plain jump.
        if (j->quiet && j->search == Search::forward_then_backward && target_.searches.count(j->search) != 0) continue;
        j->quiet = false;
        j->search = search;
      }
      if (auto* r = std::get_if<Repeat>(&u.s->node))
        r->search =
            target_.searches.count(Search::whole_first) != 0 ? Search::whole_first : Search::forward_then_backward;
      if (auto* sw = std::get_if<Switch>(&u.s->node)) {
        for (auto& c : sw->cases) {
          if (&c.second.target == u.ref) c.second.search = search;
        }
        for (auto& f : sw->fallback) {
          if (&f.target == u.ref) f.search = search;
        }
      }
    }
    for_each_statement(routine_.body, [this](Statement& s) {
      auto* j = std::get_if<Jump>(&s.node);
      if (j == nullptr) return;
      if (j->quiet && !j->target.computed && target_.searches.count(Search::forward_then_backward) == 0) {
        s.node = Label{};  // its label is missing: the source goes on with the next block
        return;
      }
      if (j->target.computed && target_.searches.count(j->search) == 0) {
        j->search = target_.searches.count(Search::forward_then_backward) != 0 ? Search::forward_then_backward
                                                                               : Search::whole_first;
      }
      if (j->search == Search::to_start && target_.searches.count(Search::to_start) == 0) jump_to_start(*j);
    });
  }

  /// A jump to the first block: the first block gets a label.
  void jump_to_start(Jump& j) {
    if (routine_.body.empty()) return;
    Statement& first = routine_.body.front();
    auto have = labels_on(first.line);
    if (have.empty()) {
      Editor editor(program_, routine_, context_);
      have.push_back(editor.fresh_label());
      set_label(first.line, have.front(), program_);
    }
    j.target = have.front();
    j.search = target_.searches.count(Search::whole_first) != 0 ? Search::whole_first : Search::backward;
  }

  Program& program_;
  Routine& routine_;
  const LegaliseContext& context_;
  const Capabilities& target_;
  std::map<std::pair<bool, std::string>, std::vector<std::size_t>> used_marks_;  ///< by label, while names are given
  std::vector<Mark> marks_;
  std::vector<Use> uses_;
  std::map<const Statement*, std::size_t> positions_;
  bool computed_ = false;
  bool directed_ = false;  ///< a computed jump looks in one direction, which the target can't
};

}  // namespace

void resolve_labels(Program& program, const LegaliseContext& context) {
  number_statements(program);
  for (auto& r : program.routines) LabelPass(program, r, context).run();
}

}  // namespace cnctrans::ir::passes
