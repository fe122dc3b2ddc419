// Block numbers where numbers are the only labels (equivalences 2.3, 20.1): those that passes made stand in the order
// of the text between the numbers of the source, and a range runs from its smaller number to its greater one.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "ir/cycles/milling/pocket_call.h"
#include "ir/edit/lines.h"
#include "legaliser/edit/editor.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

struct Mark {
  LineInfo* line = nullptr;
  std::int64_t number = 0;
  bool made = false;
};

class NumberPass {
 public:
  NumberPass(Program& program, Routine& routine, const LegaliseContext& context)
      : program_(program), routine_(routine), context_(context) {}

  void run() {
    if (!collect() || marks_.empty()) return;
    const LabelUses uses = label_uses(program_, routine_);
    if (uses.computed) return;  // any number may be a target
    std::erase_if(marks_, [&](const Mark& m) {
      const LabelRef l{std::string(m.line->number), true, nullptr};
      const bool idle = m.made && !uses.is_target(l) && !uses.is_end(l);  // its jump was folded away
      if (idle) m.line->number = {};
      return idle;
    });
    const std::vector<std::int64_t> before = numbers();
    place_made();
    if (!ranges_ascend()) renumber_all();
    write(before);
  }

 private:
  /// False: a number that is none.
  bool collect() {
    const auto* known = context_.source_numbers;
    const auto profiles = profile_numbers();
    bool good = true;
    each_line(routine_.body, [&](LineInfo& line) {
      const std::string_view text = line.number;
      if (text.empty()) return;
      Mark m;
      m.line = &line;
      const auto r = std::from_chars(text.data(), text.data() + text.size(), m.number);
      good = good && r.ec == std::errc{} && r.ptr == text.data() + text.size();
      m.made = known != nullptr && known->count(text.data()) == 0 && profiles.count(m.number) == 0;
      marks_.push_back(m);
    });
    return good;
  }
  /// Of the blocks that cycles name as their profile: they stay as they are.
  std::set<std::int64_t> profile_numbers() const {
    std::set<std::int64_t> found;
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&found](const Statement& s) {
        const auto* b = std::get_if<Block>(&s.node);
        for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
          const auto* d = std::get_if<CycleDefine>(&b->actions[i].data);
          const auto* named = d != nullptr && d->cycle ? std::get_if<NamedCycle>(&d->cycle->node) : nullptr;
          if (named == nullptr) continue;
          for (const auto& [w, v] : named->words) {
            if (cycles::is_label_word(w) && v.literal()) found.insert(std::lround(v.number));
          }
        }
      });
    }
    return found;
  }
  std::vector<std::int64_t> numbers() const {
    std::vector<std::int64_t> n;
    for (const auto& m : marks_) n.push_back(m.number);
    return n;
  }

  /// Numbers for `count` marks between two others (`hi` < 0: none behind): tens, fives, or as evenly as they fit.
  std::vector<std::int64_t> between(std::int64_t lo, std::int64_t hi, std::int64_t count) const {
    const std::int64_t top = hi < 0 ? context_.target.label_max + 1 : hi;
    for (const std::int64_t step : {10, 5, 2, 1}) {
      const std::int64_t first = (lo / step + 1) * step;
      if (first + (count - 1) * step >= top) continue;
      std::vector<std::int64_t> found;
      for (std::int64_t i = 0; i < count; ++i) found.push_back(first + i * step);
      return found;
    }
    return {};
  }
  void place_made() {
    std::set<std::int64_t> kept;
    for (const auto& m : marks_) {
      if (!m.made) kept.insert(m.number);
    }
    std::vector<Mark> placed = marks_;
    std::int64_t lo = 0;
    for (std::size_t i = 0; i < placed.size();) {
      if (!placed[i].made) {
        lo = placed[i++].number;
        continue;
      }
      std::size_t end = i;
      while (end < placed.size() && placed[end].made) ++end;
      const auto found = between(lo, end < placed.size() ? placed[end].number : -1, static_cast<std::int64_t>(end - i));
      if (found.empty()) return;
      for (const std::int64_t n : found) {
        if (kept.count(n) != 0) return;  // the source's own numbers don't ascend
        kept.insert(n);
        placed[i++].number = n;
      }
    }
    marks_ = std::move(placed);
  }

  [[nodiscard]] std::size_t place_of(const LabelRef& l) const {
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      if (same_label(LabelRef{std::string(marks_[i].line->number), true, nullptr}, l)) return i;
    }
    return marks_.size();
  }
  /// Of every range of this routine that the program runs: the first block has the smaller number.
  bool ranges_ascend() const {
    bool good = true;
    const auto check = [&](const LabelRef& first, const LabelRef& last) {
      if (!first.is_number || !last.is_number || first.computed || last.computed) return;
      const std::size_t a = place_of(first), b = place_of(last);
      if (a < b && b < marks_.size()) good = good && marks_[a].number < marks_[b].number;
    };
    each_range([&](LabelRef& first, LabelRef& last) { check(first, last); });
    return good;
  }
  /// Ranges of this routine, here and in calls of other programs.
  template <class F>
  void each_range(const F& visit) const {
    for (auto& other : program_.routines) {
      for_each_statement(other.body, [&](Statement& s) {
        if (auto* r = std::get_if<Repeat>(&s.node)) {
          if (r->has_program ? program_.find(r->program) == &routine_ : &other == &routine_) visit(r->first, r->last);
        } else if (auto* c = std::get_if<CallRoutine>(&s.node)) {
          if (c->has_range && program_.find(c->routine) == &routine_) visit(c->first, c->last);
        }
      });
    }
  }
  void renumber_all() {
    if (!profile_numbers().empty()) {
      context_.diagnostics.error("TRN-192", routine_.header.span,
                                 "a routine with a profile of a cycle must be numbered anew",
                                 "put the two numbers of every range in ascending order");
      return;
    }
    const auto found = between(0, -1, static_cast<std::int64_t>(marks_.size()));
    if (found.empty()) {
      context_.diagnostics.error("TRN-192", routine_.header.span,
                                 "more block numbers than the target has, in a routine that must be numbered anew",
                                 "divide the program");
      return;
    }
    for (std::size_t i = 0; i < marks_.size(); ++i) marks_[i].number = found[i];
    context_.diagnostics.note(
        "TRN-190", routine_.header.span,
        "the blocks are numbered anew: the target puts the two numbers of a range in ascending order");
  }

  void write(const std::vector<std::int64_t>& before) {
    std::map<std::int64_t, std::int64_t> changed;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      if (marks_[i].number != before[i]) changed.emplace(before[i], marks_[i].number);
    }
    if (changed.empty()) return;
    const auto follow = [&](LabelRef& l) {
      std::int64_t n = 0;
      if (!l.is_number || l.computed) return;
      if (std::from_chars(l.text.data(), l.text.data() + l.text.size(), n).ec != std::errc{}) return;
      if (const auto it = changed.find(n); it != changed.end()) l.text = std::to_string(it->second);
    };
    for_each_statement(routine_.body, [&](Statement& s) {
      if (std::holds_alternative<Repeat>(s.node)) return;
      each_label_ref(s, [&](LabelRef& l, bool) { follow(l); });
    });
    each_range([&](LabelRef& first, LabelRef& last) {
      follow(first);
      follow(last);
    });
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      if (marks_[i].number != before[i]) marks_[i].line->number = program_.keep(std::to_string(marks_[i].number));
    }
    if (context_.report == nullptr) return;
    const std::string owner = routine_.name.number >= 0 ? std::to_string(routine_.name.number) : routine_.name.text;
    for (auto& r : context_.report->renamed) {
      if (r.kind != Renamed::Kind::label || r.routine != owner) continue;
      for (const auto& [from, to] : changed) {
        if (r.to != label_text(LabelRef{std::to_string(from), true, nullptr})) continue;
        r.to = label_text(LabelRef{std::to_string(to), true, nullptr});
        break;
      }
    }
  }

  Program& program_;
  Routine& routine_;
  const LegaliseContext& context_;
  std::vector<Mark> marks_;
};

}  // namespace

void order_numbers(Program& program, const LegaliseContext& context) {
  if (context.target.identifier_labels || !context.target.number_labels) return;
  for (auto& r : program.routines) NumberPass(program, r, context).run();
}

}  // namespace cnctrans::ir::passes
