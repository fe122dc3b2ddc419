#include "legaliser/control/copies.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "base/text.h"
#include "ir/edit/labels.h"
#include "ir/expr.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

constexpr double most_passes = 8;  ///< the one in the text included

/// A Repeat and what it runs, as places in the body of its routine.
struct RepeatedPart {
  std::size_t routine = 0, repeat = 0, first = 0, last = 0;
  double passes = 1;  ///< of the Repeat
};

/// It goes on with the statement behind it, whatever it holds.
bool goes_on(const Statement& s) {
  return std::holds_alternative<Block>(s.node) || std::holds_alternative<Assign>(s.node) ||
         std::holds_alternative<Message>(s.node) || std::holds_alternative<Label>(s.node) ||
         std::holds_alternative<Repeat>(s.node) || std::holds_alternative<CallRoutine>(s.node) ||
         std::holds_alternative<ModalCall>(s.node);
}

std::optional<RepeatedPart> part_of(const Program& program, std::size_t routine, std::size_t at) {
  const Body& body = program.routines[routine].body;
  const auto* r = std::get_if<Repeat>(&body[at].node);
  if (r == nullptr || r->has_program || r->first.computed || r->last.computed || r->last.text.empty() ||
      r->curve_use != CurveUse::none || body[at].line.skip_mask != 0 || body[at].line.joined)
    return std::nullopt;
  RepeatedPart part{routine, at, 0, 0, 1};
  if (r->count) {
    const auto count = constant_value(r->count);
    if (!count || *count < 1) return std::nullopt;
    part.passes = *count;
  }
  const LabelTable labels(program.routines[routine]);
  auto range = labels.range(*r, labels.order(body[at].id));
  if (!range && r->order_free) {
    Repeat turned = *r;
    std::swap(turned.first, turned.last);
    range = labels.range(turned, labels.order(body[at].id));
  }
  if (!range || range->first.part != SitePart::statement || range->second.part != SitePart::statement)
    return std::nullopt;
  const auto place = [&body](std::uint32_t id) {
    const auto it = std::find_if(body.begin(), body.end(), [id](const Statement& s) { return s.id == id; });
    return static_cast<std::size_t>(it - body.begin());
  };
  part.first = place(range->first.statement);
  part.last = place(range->second.statement);
  if (part.first >= body.size() || part.last >= body.size() || part.first > part.last) return std::nullopt;
  while (part.last + 1 < body.size() && body[part.last + 1].line.joined) ++part.last;
  if (at >= part.first && at <= part.last) return std::nullopt;
  const auto from = body.begin() + static_cast<std::ptrdiff_t>(part.first);
  if (!std::all_of(from, body.begin() + static_cast<std::ptrdiff_t>(part.last) + 1, goes_on)) return std::nullopt;
  return part;
}

std::vector<RepeatedPart> parts(Program& program) {
  number_statements(program);
  std::vector<RepeatedPart> found;
  for (std::size_t r = 0; r < program.routines.size(); ++r) {
    for (std::size_t i = 0; i < program.routines[r].body.size(); ++i) {
      if (auto part = part_of(program, r, i)) found.push_back(*part);
    }
  }
  return found;
}

const Span& place_of(const Program& program, const RepeatedPart& part) {
  return program.routines[part.routine].body[part.repeat].line.span;
}

std::string shown(const Repeat& r) {
  return label_text(r.first) + (same_label(r.first, r.last) ? "" : " - " + label_text(r.last));
}

/// The part without what leads to it from elsewhere.
Body copy_of(const Body& body, const RepeatedPart& part) {
  Body copy(body.begin() + static_cast<std::ptrdiff_t>(part.first),
            body.begin() + static_cast<std::ptrdiff_t>(part.last) + 1);
  for (auto& s : copy) {
    s.id = 0;
    s.line.number = {};
    s.line.labels.clear();
    s.line.blank_lines_before = 0;
  }
  return copy;
}

void append(Body& to, Body&& more) {
  std::move(more.begin(), more.end(), std::back_inserter(to));
}

void write_copy(Program& program, const RepeatedPart& part, Copying way, const LegaliseContext& context) {
  Routine& routine = program.routines[part.routine];
  Editor editor(program, routine, context);
  Body out;
  for (std::size_t i = 0; i < routine.body.size(); ++i) {
    if (i != part.repeat) {
      out.push_back(routine.body[i]);
      continue;
    }
    Statement head = routine.body[i];
    Repeat again = std::get<Repeat>(head.node);
    const std::string name = shown(again);
    head.node = Label{};
    const LineInfo like = head.line;
    Body pieces{std::move(head)};
    const double written = way == Copying::each ? part.passes : 1;
    for (double pass = 1; pass <= written; ++pass) {
      pieces.push_back(make_comment(name + " again" + (written > 1 ? ": " + shortest(pass) : ""), program));
      Body copy = copy_of(routine.body, part);
      if (way == Copying::first && part.passes > 1) {
        again.first = again.last = editor.fresh_label();
        if (copy.size() > 1) again.last = editor.fresh_label();
        set_label(copy.front().line, again.first, program);
        if (copy.size() > 1) set_label(copy.back().line, again.last, program);
        again.count = part.passes > 2 ? number(part.passes - 1) : nullptr;
        again.search = Search::whole_first;
        again.order_free = false;
        append(pieces, std::move(copy));
        pieces.push_back(made(like, std::move(again)));
      } else {
        append(pieces, std::move(copy));
      }
    }
    editor.put_group(out, std::move(pieces), 0);
  }
  routine.body = std::move(out);
}

}  // namespace

bool InSource::operator()(const Span& a, const Span& b) const {
  return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
}

bool repeats_parts(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for (const auto& s : r.body) found = found || std::holds_alternative<Repeat>(s.node);
  }
  return found;
}

namespace {

bool shares(const RepeatedPart& a, const RepeatedPart& b) {
  const auto holds = [](const RepeatedPart& part, std::size_t at) { return at >= part.first && at <= part.last; };
  return a.routine == b.routine && a.repeat != b.repeat && a.first <= b.last && b.first <= a.last &&
         !holds(a, b.repeat) && !holds(b, a.repeat);
}

}  // namespace

std::vector<CopyChoice> copy_choices(Program& program, const std::vector<Span>& where) {
  std::vector<RepeatedPart> all = parts(program);
  std::stable_sort(all.begin(), all.end(),
                   [](const RepeatedPart& a, const RepeatedPart& b) { return a.last - a.first < b.last - b.first; });
  std::vector<CopyChoice> choices;
  for (const auto& part : all) {
    const Body& body = program.routines[part.routine].body;
    const bool asked = std::any_of(where.begin(), where.end(), [&](const Span& w) {
      return std::any_of(body.begin() + static_cast<std::ptrdiff_t>(part.first),
                         body.begin() + static_cast<std::ptrdiff_t>(part.last) + 1, [&w](const Statement& s) {
                           const Span& own = s.line.span;
                           return own.file == w.file && own.line <= w.line && w.line <= own.end_line;
                         });
    });
    if (!asked) continue;
    CopyChoice choice{place_of(program, part), {}, {}};
    for (const auto& other : all) {
      if (other.passes < most_passes && shares(part, other)) choice.shared.push_back(place_of(program, other));
    }
    if (part.passes > 1) choice.ways.push_back(Copying::first);
    if (part.passes < most_passes) choice.ways.push_back(Copying::each);
    choices.push_back(std::move(choice));
  }
  return choices;
}

void write_copies(Program& program, const Copies& copies, const LegaliseContext& context) {
  Copies open = copies;
  while (!open.empty()) {
    const auto all = parts(program);
    // From the inside out: a part that is written again takes along what was written in it.
    const auto next = std::find_if(all.begin(), all.end(), [&](const RepeatedPart& part) {
      return open.contains(place_of(program, part)) && std::none_of(all.begin(), all.end(), [&](const auto& other) {
               return other.routine == part.routine && other.repeat >= part.first && other.repeat <= part.last &&
                      open.contains(place_of(program, other));
             });
    });
    if (next == all.end()) return;
    const Span where = place_of(program, *next);
    const auto chosen = open.extract(where);
    write_copy(program, *next, chosen.mapped(), context);
    context.diagnostics.note("TRN-710", where,
                             "the part that is repeated here is written again: the target must say it otherwise where "
                             "it is carried out in another state");
  }
}

}  // namespace cnctrans::ir::passes
