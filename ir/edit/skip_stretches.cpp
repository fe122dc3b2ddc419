#include "ir/edit/skip_stretches.h"

#include "base/text.h"
#include "ir/nesting.h"

namespace cnctrans::ir {

namespace {

void note(const LabelRef& l, bool range, NamedLabels& named) {
  if (l.computed) {
    named.computed = true;
  } else if (!l.text.empty()) {
    (range ? named.ranges : named.jumps).insert({l.is_number, l.text});
  }
}

std::string_view without_zeros(std::string_view digits) {
  while (digits.size() > 1 && digits.front() == '0') digits.remove_prefix(1);
  return digits;
}

bool carries(const LineInfo& line, const std::set<std::pair<bool, std::string>>& names) {
  if (names.empty()) return false;
  if (!line.number.empty() && names.count({true, std::string(without_zeros(line.number))}) != 0) return true;
  for (const auto& l : line.labels) {
    if (names.count({false, to_upper_ascii(l)}) != 0) return true;
  }
  return false;
}

/// What follows it in the text follows it in the flow too, and nothing else.
bool goes_on(const Statement& s) {
  const auto* call = std::get_if<CallRoutine>(&s.node);
  return std::holds_alternative<Block>(s.node) || std::holds_alternative<Assign>(s.node) ||
         std::holds_alternative<Message>(s.node) || std::holds_alternative<Label>(s.node) ||
         std::holds_alternative<ModalCall>(s.node) || (call != nullptr && !call->tail);
}

bool is_structure(const Statement& s) {
  for (const Body* inner : detail::bodies_of(s)) {
    if (inner != nullptr) return true;
  }
  return false;
}

class Finder {
 public:
  Finder(const NamedLabels& named, SkipStretches& out) : named_(named), out_(out) {}

  void body(const Body& b) {
    for (std::size_t i = 0; i < b.size();) {
      for (const Body* inner : detail::bodies_of(b[i])) {
        if (inner != nullptr) body(*inner);
      }
      const std::size_t end = stretch(b, i);
      if (end <= i + 1) {
        ++i;
        continue;
      }
      out_.last_of[b[i].id] = b[end - 1].id;
      for (; i < end; ++i) out_.inside.insert(b[i].id);
    }
  }

 private:
  /// Behind the last statement of the stretch that begins with statement `from`.
  [[nodiscard]] std::size_t stretch(const Body& b, std::size_t from) const {
    const auto mask = b[from].line.skip_mask;
    std::size_t end = from;
    if (mask == 0 || b[from].line.joined) return end;
    for (std::size_t i = from; i < b.size();) {
      const std::size_t next = detail::line_end(b, i) + 1;
      if (b[i].line.skip_mask != mask || carries(b[i].line, named_.ranges) ||
          (i != from && carries(b[i].line, named_.jumps)))
        break;
      bool plain = true;
      for (std::size_t k = i; k < next; ++k) plain = plain && !is_structure(b[k]);
      if (!plain) break;
      if (goes_on(b[next - 1])) end = next;
      i = next;
    }
    return end;
  }

  const NamedLabels& named_;
  SkipStretches& out_;
};

}  // namespace

NamedLabels named_labels(const Program& program) {
  NamedLabels named;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&named](const Statement& s) {
      if (const auto* j = std::get_if<Jump>(&s.node)) {
        note(j->target, false, named);
      } else if (const auto* sw = std::get_if<Switch>(&s.node)) {
        for (const auto& c : sw->cases) note(c.second.target, false, named);
        for (const auto& f : sw->fallback) note(f.target, false, named);
      } else if (const auto* p = std::get_if<Repeat>(&s.node)) {
        note(p->first, true, named);
        note(p->last, true, named);
      } else if (const auto* c = std::get_if<CallRoutine>(&s.node); c != nullptr && c->has_range) {
        note(c->first, true, named);
        note(c->last, true, named);
      }
    });
  }
  return named;
}

SkipStretches skip_stretches(const Routine& routine, const NamedLabels& named) {
  SkipStretches out;
  if (!named.computed) Finder(named, out).body(routine.body);
  return out;
}

}  // namespace cnctrans::ir
