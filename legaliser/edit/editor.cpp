#include "legaliser/edit/editor.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "base/text.h"
#include "ir/analysis/value_set.h"
#include "ir/edit/lines.h"
#include "legaliser/edit/given_names.h"

namespace cnctrans::ir::passes {

void UsedVariables::add(const Program& program, const Routine& routine) {
  const auto note = [&](const VarRef& v) {
    if (!v.name.empty()) names_.insert(v.name);
    if (v.space >= program.spaces.size() || !v.index) return;
    if (const auto n = constant_index(v)) numbers_[program.spaces[v.space].prefix].insert(*n);
  };
  const auto note_expr = [&](const ExprPtr& e) {
    walk(e, [&](const ExprPtr& n) {
      if (const auto* v = as_variable(n)) note(*v);
    });
  };
  for (const auto& p : routine.parameters) note(p.variable);
  for_each_statement(routine.body, [&](const Statement& s) {
    each_expression(s, note_expr);
    each_target(s, note);
    if (const auto* d = std::get_if<Declare>(&s.node)) {
      for (const auto& i : d->items) names_.insert(i.name);
    }
  });
}

bool UsedVariables::has(std::string_view prefix, std::int64_t n) const {
  const auto it = numbers_.find(prefix);
  return it != numbers_.end() && it->second.count(n) != 0;
}

Editor::Editor(Program& p, Routine& r, const LegaliseContext& c)
    : program(p), routine(r), context(c), uses_(label_uses(p, r)), used_(p, r) {
  each_line(routine.body, [this](const LineInfo& line) {
    for (const auto& l : labels_on(line)) {
      std::int64_t n = 0;
      if (!l.is_number) {
        identifiers_.insert(l.text);
      } else if (std::from_chars(l.text.data(), l.text.data() + l.text.size(), n).ec == std::errc{}) {
        numbers_.push_back(n);
        next_number_ = std::max(next_number_, n);
      }
    }
  });
}

UsedVariables& Editor::used() {
  if (!used_whole_) {
    for (const auto& r : program.routines) used_.add(program, r);
  }
  used_whole_ = true;
  return used_;
}

LabelRef Editor::fresh_label() {
  const bool identifier = target().identifier_labels;
  if (identifier) {
    std::string text;
    do {
      text = target().label_prefix + std::to_string(++next_identifier_);
    } while (!identifiers_.insert(text).second);
    return LabelRef{text, false, nullptr};
  }
  std::int64_t n = (next_number_ / 10 + 1) * 10;
  if (n > target().label_max) {  // the space above is used up: take a gap
    n = 1;
    std::sort(numbers_.begin(), numbers_.end());
    for (const std::int64_t used : numbers_) n += used == n ? 1 : 0;
  } else {
    next_number_ = n;
  }
  numbers_.push_back(n);
  return LabelRef{std::to_string(n), true, nullptr};
}

VarRef Editor::variable_number(const std::string& prefix, std::int64_t n) {
  SpaceId space = program.space(prefix);
  if (space == program.spaces.size()) {
    VariableSpace s;
    s.prefix = prefix;
    s.segments.push_back({n, n, Scope::global, true, false, false});
    program.spaces.push_back(std::move(s));
  }
  return VarRef{space, {}, number(static_cast<double>(n)), {}};
}

std::optional<VarRef> Editor::take(const LineInfo& where) {
  if (!free_.empty()) {
    VarRef v = free_.back();
    free_.pop_back();
    return v;
  }
  if (target().declares_variables) {
    // With a map of names a subprogram is written for each program that calls it, and must have one text: the names of
    // its callers count for nothing then.
    UsedVariables& all = context.names != nullptr ? used_ : used();
    std::string name;
    int i = 0;
    do {
      name = "_T" + std::to_string(++i);
    } while (all.has_name(name));
    all.add_name(name);
    declared_.push_back(name);
    const SpaceId space = program.space("");
    if (space == program.spaces.size()) program.spaces.emplace_back();
    return VarRef{space, name, nullptr, {}};
  }
  const bool shared = context.names != nullptr && context.report != nullptr && routine.kind != RoutineKind::main;
  // For the same reason the temporaries of a subprogram stand in the map: "TEMPORARY 1(ROW2)".
  std::string key;
  if (shared) {
    for (int i = 1; key.empty(); ++i) {
      std::string name = temporary_in_map(routine.name, i);
      const auto n = given_number(context, name);
      if (n && used().has(n->first, n->second)) continue;
      if (n) {
        used().add(n->first, n->second);
        context.report->names.variables[name] = n->first + std::to_string(n->second);
        return variable_number(n->first, n->second);
      }
      key = std::move(name);
    }
  }
  const auto given = given_numbers(context);
  for (const bool preferred : {true, false}) {
    for (const auto& pool : target().pools) {
      if (pool.temporaries != preferred) continue;
      for (std::int64_t n = pool.hi; n >= pool.lo; --n) {
        if (used().has(pool.prefix, n) || given.count({pool.prefix, n}) != 0) continue;
        used().add(pool.prefix, n);
        if (shared) context.report->names.variables[key] = pool.prefix + std::to_string(n);
        return variable_number(pool.prefix, n);
      }
    }
  }
  if (!reported_) {
    reported_ = true;
    context.diagnostics.error("TRN-110", where.span, "no variable of the target is free for an intermediate value",
                              "use fewer variables");
  }
  return std::nullopt;
}

void Editor::release(const VarRef& v) {
  for (const auto& f : free_) {
    if (same_variable(f, v)) return;
  }
  free_.push_back(v);
}

void Editor::put(Body& out, Body&& pre, Statement&& s) {
  const std::size_t main = pre.size();
  pre.push_back(std::move(s));
  put_group(out, std::move(pre), main);
}

void Editor::put_group(Body& out, Body&& pieces, std::size_t main) {
  bool end = false, target_too = false;
  const auto labels = labels_on(pieces[main].line);
  for (const auto& l : labels) {
    end = end || uses_.is_end(l);
    target_too = target_too || uses_.is_target(l);
  }
  if (main != 0) {
    move_head(pieces[main].line, pieces.front().line);
    pieces[main].line.joined = false;
  }
  if (end && pieces.size() > 1) {
    if (!labels_on(pieces.back().line).empty()) {  // jumped to by the pieces: the end of the range stands behind it
      Statement mark = made(pieces.back().line, Label{});
      mark.line.skip_mask = 0;
      pieces.push_back(std::move(mark));
    }
    LineInfo& first = pieces.front().line;
    LineInfo& last = pieces.back().line;
    if (!target_too) {  // the mark of a range's end stands on the last piece
      last.number = std::exchange(first.number, {});
      last.labels = std::exchange(first.labels, {});
    } else {
      const LabelRef fresh = fresh_label();
      set_label(last, fresh, program);
      for (const auto& l : labels) renamed_ends_.emplace_back(l, fresh);
    }
  }
  for (auto& p : pieces) out.push_back(std::move(p));
}

Editor::~Editor() {
  for (const auto& [from, to] : renamed_ends_) {
    for_each_statement(routine.body, [&from = from, &to = to](Statement& s) {
      each_label_ref(s, [&](LabelRef& l, bool is_end) {
        if (is_end && same_label(l, from)) l = to;
      });
    });
  }
  if (declared_.empty()) return;
  Declare d;
  d.type = Type::real;
  d.space = program.space("");
  for (const auto& n : declared_) d.items.push_back({n, {}, {}});
  Statement s;
  s.node = std::move(d);
  routine.body.insert(below_head(routine.body), std::move(s));
}

}  // namespace cnctrans::ir::passes
