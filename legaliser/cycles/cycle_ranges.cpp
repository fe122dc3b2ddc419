// The same points drilled, tapped, reamed: a range of points is repeated under one cycle after the other. A target that
// writes one of those cycles out, or ends it between the points, needs the points once for each cycle.
#include "legaliser/cycles/cycle_ranges.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "ir/edit/labels.h"
#include "ir/edit/search.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

constexpr std::size_t most_copied = 400;  ///< statements in the place of one repetition
constexpr int most_nested = 8;            ///< ranges in ranges

/// The statements `first` to `last` (inclusive) of one body.
struct Range {
  Body* body = nullptr;
  std::size_t first = 0, last = 0;
};

std::optional<Range> range_in(Body& body, std::uint32_t first, std::uint32_t last) {
  std::optional<std::size_t> from, to;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (body[i].id == first) from = i;
    if (body[i].id == last) to = i;
  }
  if (from && to && *from <= *to) return Range{&body, *from, *to};
  if (from || to) return std::nullopt;
  std::optional<Range> found;
  for (auto& s : body) {
    each_body(s, [&](Body& inner) {
      if (!found) found = range_in(inner, first, last);
    });
  }
  return found;
}

void each_line_of(Statement& s, const std::function<void(LineInfo&)>& visit) {
  visit(s.line);
  if (auto* i = std::get_if<If>(&s.node)) {
    visit(i->else_line);
    visit(i->end_line);
  } else if (auto* w = std::get_if<While>(&s.node)) {
    visit(w->end_line);
  } else if (auto* u = std::get_if<Until>(&s.node)) {
    visit(u->end_line);
  } else if (auto* f = std::get_if<For>(&s.node)) {
    visit(f->end_line);
  } else if (auto* l = std::get_if<Loop>(&s.node)) {
    visit(l->end_line);
  }
}

class Separation {
 public:
  Separation(Program& program, Routine& routine, const LegaliseContext& context, const FactsOf& facts)
      : program_(program), routine_(routine), editor_(program, routine, context), facts_(facts), table_(routine) {}

  /// True when something was copied. `lines`: where the cycle pass did not know the cycle.
  bool run(const std::set<std::uint32_t>& lines) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> wanted;  // first and last statement of the ranges
    for_each_statement(routine_.body, [&](Statement& s) {
      const auto ends = ends_of(s);
      if (!ends || std::find(wanted.begin(), wanted.end(), *ends) != wanted.end()) return;
      if (in_doubt(*ends, lines)) wanted.push_back(*ends);
    });
    if (wanted.empty()) return false;
    std::vector<std::uint32_t> calls;
    for_each_statement(routine_.body, [&](Statement& s) {
      const auto ends = ends_of(s);
      if (ends && std::find(wanted.begin(), wanted.end(), *ends) != wanted.end() && copy_for(s)) calls.push_back(s.id);
    });
    if (calls.empty()) return false;
    rewrite_body(routine_.body, [this](Statement&& s, Body& out) {
      const auto at = copies_.find(s.id);
      if (s.id == 0 || at == copies_.end()) return out.push_back(std::move(s));
      Body pieces = std::move(at->second);
      if (!s.line.number.empty() || !s.line.labels.empty() || !s.line.comments.empty() || s.line.joined ||
          pieces.empty()) {
        s.node = Label{};
        out.push_back(std::move(s));
      } else {
        pieces.front().line.blank_lines_before = s.line.blank_lines_before;
      }
      std::move(pieces.begin(), pieces.end(), std::back_inserter(out));
    });
    return true;
  }

 private:
  /// First and last statement of the range that the statement repeats, where it may be copied.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> ends_of(const Statement& s) const {
    const auto* r = std::get_if<Repeat>(&s.node);
    if (r == nullptr || r->has_program || r->curve_use != CurveUse::none || r->first.computed || r->last.computed ||
        r->last.text.empty() || s.line.skip_mask != 0)
      return std::nullopt;
    const auto sites = table_.range(*r, table_.order(s.id));
    if (!sites || sites->first.part != SitePart::statement || sites->second.part != SitePart::statement)
      return std::nullopt;
    return std::pair{sites->first.statement, sites->second.statement};
  }

  /// Points of the range whose cycle the pass did not know, or that end a cycle which another one may be.
  bool in_doubt(const std::pair<std::uint32_t, std::uint32_t>& ends, const std::set<std::uint32_t>& lines) {
    const auto range = range_in(routine_.body, ends.first, ends.second);
    if (!range) return false;
    bool doubt = false;
    for (std::size_t i = range->first; i <= range->last; ++i) {
      Body one{(*range->body)[i]};
      for_each_statement(one, [&](const Statement& s) {
        const Facts& before = facts_.before(s);
        const bool several = before.reachable && before.cycle_from == Facts::several_cycles;
        const auto* b = std::get_if<Block>(&s.node);
        const bool ends_one = b != nullptr && (action_in<CycleCancel>(*b) != nullptr || defines(*b));
        doubt = doubt || (several && (ends_one || lines.count(s.line.span.line) != 0));
      });
    }
    return doubt;
  }
  static bool defines(const Block& b) {
    const auto* d = action_in<CycleDefine>(b);
    return d != nullptr && d->modal;
  }

  /// Makes the copies for one repetition. False: the range leads out of itself, or is too long.
  bool copy_for(const Statement& s) {
    const auto ends = ends_of(s);
    const auto range = range_in(routine_.body, ends->first, ends->second);
    const auto& repeat = std::get<Repeat>(s.node);
    const auto count = repeat.count ? constant_value(repeat.count) : std::optional(1.0);
    if (!range || !count || *count < 0 || *count > 100) return false;
    const std::size_t size = range->last - range->first + 1;
    if (size * static_cast<std::size_t>(*count) > most_copied || holds(*range, s.id) || !closed(*range)) return false;
    Body all;
    for (int pass = 0; pass < static_cast<int>(*count); ++pass) {
      Body copy(range->body->begin() + static_cast<std::ptrdiff_t>(range->first),
                range->body->begin() + static_cast<std::ptrdiff_t>(range->last) + 1);
      plain_lines(copy);
      std::move(copy.begin(), copy.end(), std::back_inserter(all));
    }
    copies_[s.id] = std::move(all);
    return true;
  }

  static bool holds(const Range& range, std::uint32_t id) {
    bool found = false;
    for (std::size_t i = range.first; i <= range.last; ++i) {
      Body one{(*range.body)[i]};
      for_each_statement(one, [&](const Statement& s) { found = found || s.id == id; });
    }
    return found;
  }

  /// No jump leads out of the range or finds its target at run time, and nothing returns from it.
  static bool closed(const Range& range) {
    Body all(range.body->begin() + static_cast<std::ptrdiff_t>(range.first),
             range.body->begin() + static_cast<std::ptrdiff_t>(range.last) + 1);
    std::set<std::pair<bool, std::string>> inside;
    for_each_statement(all, [&](Statement& s) {
      each_line_of(s, [&](LineInfo& l) {
        for (const auto& label : labels_on(l)) inside.emplace(label.is_number, label.text);
      });
    });
    bool good = true;
    for_each_statement(all, [&](const Statement& s) {
      if (const auto* j = std::get_if<Jump>(&s.node))
        good = good && !j->target.computed && inside.count({j->target.is_number, j->target.text}) != 0;
      good = good && !std::holds_alternative<Switch>(s.node) && !std::holds_alternative<Return>(s.node) &&
             !std::holds_alternative<Exit>(s.node);
    });
    return good;
  }

  /// The lines of a copy: no numbers but those that its own jumps ask for, and those anew.
  void plain_lines(Body& copy) {
    std::map<std::pair<bool, std::string>, LabelRef> fresh;
    for_each_statement(copy, [&](Statement& s) {
      if (const auto* j = std::get_if<Jump>(&s.node))
        fresh.try_emplace({j->target.is_number, j->target.text}, LabelRef{});
    });
    for (auto& [old, label] : fresh) label = editor_.fresh_label();
    std::set<std::pair<bool, std::string>> placed;
    for_each_statement(copy, [&](Statement& s) {
      s.id = 0;
      if (auto* j = std::get_if<Jump>(&s.node)) j->target = fresh.at({j->target.is_number, j->target.text});
      each_line_of(s, [&](LineInfo& line) {
        const auto labels = labels_on(line);
        line.number = {};
        line.labels.clear();
        for (const auto& l : labels) {
          const auto at = fresh.find({l.is_number, l.text});
          if (at != fresh.end() && placed.insert(at->first).second) set_label(line, at->second, program_);
        }
      });
    });
  }

  Program& program_;
  Routine& routine_;
  Editor editor_;
  const FactsOf& facts_;
  LabelTable table_;
  std::map<std::uint32_t, Body> copies_;  ///< by the id of the repetition
};

/// Ranges that stood apart and that nothing runs any more.
void remove_unreached(Program& program, Routine& routine, const LegaliseContext& context,
                      const std::set<std::uint32_t>& reached_before) {
  const FactsOf facts(program, context);
  rewrite_body(routine.body, [&](Statement&& s, Body& out) {
    const bool was = reached_before.count(s.line.span.line) != 0;
    if (was && !std::holds_alternative<Declare>(s.node) && !facts.before(s).reachable) return;
    out.push_back(std::move(s));
  });
}

bool ambiguous(const Program& program, const FactsOf& facts) {
  bool found = false;
  for (const auto& r : program.routines) {
    bool repeats = false;
    for_each_statement(r.body,
                       [&](const Statement& s) { repeats = repeats || std::holds_alternative<Repeat>(s.node); });
    if (!repeats) continue;
    for_each_statement(r.body, [&](const Statement& s) {
      const Facts& before = facts.before(s);
      found = found || (before.reachable && before.cycle_from == Facts::several_cycles);
    });
  }
  return found;
}

}  // namespace

void separate_cycle_ranges(Program& program, const LegaliseContext& context,
                           const std::function<void(Program&, const LegaliseContext&)>& carry_out) {
  for (int round = 0; round < most_nested; ++round) {
    const FactsOf facts(program, context);
    if (!ambiguous(program, facts)) return;
    Program trial = program;
    Diagnostics found;
    const LegaliseContext quiet{context.target, context.source_machine, context.target_machine, context.options, found,
                                nullptr,        context.source_numbers, context.names};
    carry_out(trial, quiet);
    std::set<std::uint32_t> lines;
    for (const auto& d : found.all()) {
      if (d.severity == Severity::error && d.code == "TRN-331") lines.insert(d.span.line);
    }
    bool changed = false;
    for (auto& r : program.routines) {
      std::set<std::uint32_t> reached;
      for_each_statement(r.body, [&](const Statement& s) {
        if (facts.before(s).reachable) reached.insert(s.line.span.line);
      });
      if (!Separation(program, r, context, facts).run(lines)) continue;
      changed = true;
      remove_unreached(program, r, context, reached);
    }
    if (!changed) return;
  }
}

}  // namespace cnctrans::ir::passes
