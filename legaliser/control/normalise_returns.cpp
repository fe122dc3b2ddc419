// Returns and program ends (equivalences 21.1): early returns become jumps to the last one, a program end inside a
// subprogram is carried up to the main program where the target's end word only returns.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ir/analysis/call_graph.h"
#include "legaliser/edit/editor.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

bool ends_all(const Statement& s) {
  const auto* e = std::get_if<End>(&s.node);
  return e != nullptr && !e->returns_from_sub;
}

/// Ends of the program in subprograms, for a target where they return only: a flag tells the callers.
class EndInSub {
 public:
  EndInSub(Program& program, const LegaliseContext& context) : program_(program), context_(context), calls_(program) {}

  void run() {
    find_enders();
    if (enders_.empty()) return;
    for (const auto& site : calls_.sites()) {  // the statements move when the bodies are rewritten
      const auto* c = site.callee ? std::get_if<CallRoutine>(&site.statement->node) : nullptr;
      if (c != nullptr && c->count && constant_value(c->count) != 1.0) called_again_.insert(*site.callee);
    }
    flag_ = VarRef{frame_space(program_), "END@program", nullptr, {}};
    for (std::size_t r = 0; r < program_.routines.size(); ++r) rewrite(r);
    for (auto& r : program_.routines) {
      if (r.kind != RoutineKind::main) continue;
      r.body.insert(below_head(r.body), make_assign(LineInfo{}, flag_, number(0)));
    }
  }

 private:
  void find_enders() {
    for (std::size_t r = 0; r < program_.routines.size(); ++r) {
      if (program_.routines[r].kind == RoutineKind::main) continue;
      for_each_statement(program_.routines[r].body, [&](const Statement& s) {
        if (ends_all(s)) enders_.insert(r);
      });
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& site : calls_.sites()) {
        if (site.callee && enders_.count(*site.callee) != 0 &&
            program_.routines[site.caller].kind == RoutineKind::sub) {
          changed = enders_.insert(site.caller).second || changed;
        }
      }
    }
  }

  void rewrite(std::size_t r) {
    Routine& routine = program_.routines[r];
    const bool sub = routine.kind == RoutineKind::sub;
    Editor editor(program_, routine, context_);
    std::optional<LabelRef> end_label;
    if (sub && enders_.count(r) != 0 && called_again_.count(r) != 0) end_label = editor.fresh_label();
    const std::optional<LabelRef> head_test = end_label;
    rewrite_body(routine.body, [&](Statement&& s, Body& out) {
      if (sub && ends_all(s)) {
        Body pieces;
        pieces.push_back(make_assign(s.line, flag_, number(1)));
        s.node = Return{};
        pieces.push_back(std::move(s));
        editor.put_group(out, std::move(pieces), 1);
        return;
      }
      if (const auto* m = std::get_if<ModalCall>(&s.node); m != nullptr && !m->off && !m->cycle) modal(*m, s);
      const auto* c = std::get_if<CallRoutine>(&s.node);
      const auto callee = c != nullptr && !c->computed ? calls_.index_of(c->routine) : std::nullopt;
      const LineInfo like = s.line;
      out.push_back(std::move(s));
      if (!callee || enders_.count(*callee) == 0) return;
      if (!end_label) end_label = editor.fresh_label();
      out.push_back(make_jump(like, *end_label, binary(BinaryOp::ne, variable(flag_), number(0))));
    });
    if (!end_label) return;
    if (head_test)
      routine.body.insert(below_head(routine.body),
                          make_jump(LineInfo{}, *head_test, binary(BinaryOp::ne, variable(flag_), number(0))));
    // Where the flag leads: the last End of the main program, the last Return of a subprogram.
    auto& body = routine.body;
    const auto last = std::find_if(body.rbegin(), body.rend(), [&](const Statement& s) {
      return sub ? std::holds_alternative<Return>(s.node) : std::holds_alternative<End>(s.node);
    });
    if (last == body.rend()) {
      body.push_back(make_label(LineInfo{}, *end_label, program_));
      Statement s;
      if (sub)
        s.node = Return{};
      else
        s.node = End{};
      body.push_back(std::move(s));
    } else {
      last->line.joined = false;
      body.insert(last.base() - 1, make_label(last->line, *end_label, program_));
    }
  }

  /// The moves behind a modal call would go on.
  void modal(const ModalCall& m, const Statement& s) const {
    const auto callee = m.call.computed ? std::nullopt : calls_.index_of(m.call.routine);
    if (!callee || enders_.count(*callee) == 0) return;
    context_.diagnostics.error("TRN-380", s.line.span,
                               "the program can end inside of this modal subprogram, where the target only returns",
                               "call it by a block of its own behind each move");
  }

  Program& program_;
  const LegaliseContext& context_;
  CallGraph calls_;
  std::set<std::size_t> enders_;
  /// Some call runs the routine several times: it must do nothing once the program has ended.
  std::set<std::size_t> called_again_;
  VarRef flag_;
};

/// In a subprogram an end word that only returns there is a return.
void ends_that_return(Program& program) {
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&r](Statement& s) {
      auto* e = std::get_if<End>(&s.node);
      if (e == nullptr || !e->returns_from_sub) return;
      if (r.kind == RoutineKind::sub)
        s.node = Return{{}, e->text};
      else
        e->returns_from_sub = false;
    });
  }
}

/// A return inside of a part that is repeated ends the repetition there; a jump to the end would leave the routine.
void refuse_in_repeated_parts(Program& program, Routine& routine, const LegaliseContext& context) {
  std::map<std::string, std::size_t> places;
  std::vector<std::pair<std::size_t, std::size_t>> parts;
  std::size_t at = 0;
  for_each_statement(routine.body, [&](const Statement& s) {
    ++at;
    for (const auto& l : labels_on(s.line)) places.emplace(l.text, at);
  });
  at = 0;
  for_each_statement(routine.body, [&](const Statement& s) {
    ++at;
    const auto* r = std::get_if<Repeat>(&s.node);
    if (r == nullptr || r->has_program || r->first.computed || r->last.computed) return;
    const auto first = places.find(r->first.text), last = places.find(r->last.text);
    if (first == places.end()) return;
    std::size_t end = at - 1;  // without an end label: up to here
    if (last != places.end()) end = last->second;
    parts.emplace_back(std::min(first->second, end), std::max(first->second, end));
  });
  if (parts.empty()) return;
  at = 0;
  for_each_statement(routine.body, [&](Statement& s) {
    ++at;
    const bool inside = std::any_of(parts.begin(), parts.end(),
                                    [at](const auto& part) { return part.first <= at && at <= part.second; });
    if (!inside || !std::holds_alternative<Return>(s.node)) return;
    refuse(s, program, context, "TRN-521",
           "a return inside of a repeated part: it ends the repetition when it comes there by one, and leaves the "
           "subprogram when not; whether the target does so is not known",
           "jump to a label behind the repetition");
  });
}

/// One return, at the end of the routine.
void single_return(Program& program, Routine& routine, const LegaliseContext& context) {
  if (routine.kind != RoutineKind::sub) return;
  auto& body = routine.body;
  std::size_t count = 0;
  for_each_statement(body, [&count](const Statement& s) { count += std::holds_alternative<Return>(s.node) ? 1 : 0; });
  const bool last_is_return = !body.empty() && std::holds_alternative<Return>(body.back().node);
  if (count == 0 || (count == 1 && last_is_return && body.back().line.skip_mask == 0)) return;
  Editor editor(program, routine, context);
  if (!last_is_return || body.back().line.skip_mask != 0) {
    ++count;
    Statement s;
    s.node = Return{};
    body.push_back(std::move(s));
  }
  body.back().line.joined = false;
  const auto have = labels_on(body.back().line);
  const LabelRef end = have.empty() ? editor.fresh_label() : have.front();
  if (have.empty()) set_label(body.back().line, end, program);
  std::size_t left = count;
  for_each_statement(body, [&](Statement& s) {
    const auto* r = std::get_if<Return>(&s.node);
    if (r == nullptr || --left == 0 || !r->values.empty()) return;  // one that goes on elsewhere is refused by writers
    Jump j;
    j.target = end;
    s.node = std::move(j);
  });
}

/// A return in a main program that nothing calls ends it; in a repeated part it ends the repetition.
void end_main_programs(Program& program) {
  const CallGraph calls(program);
  for (std::size_t r = 0; r < program.routines.size(); ++r) {
    Routine& routine = program.routines[r];
    if (routine.kind != RoutineKind::main || calls.called(r)) continue;
    bool repeats = false;
    for_each_statement(routine.body,
                       [&repeats](const Statement& s) { repeats = repeats || std::holds_alternative<Repeat>(s.node); });
    if (repeats) continue;
    for_each_statement(routine.body, [](Statement& s) {
      const auto* back = std::get_if<Return>(&s.node);
      if (back != nullptr && back->values.empty()) s.node = End{};
    });
  }
}

}  // namespace

void normalise_returns(Program& program, const LegaliseContext& context) {
  if (program.dialect != context.target.dialect) end_main_programs(program);
  if (context.target.end_in_sub_ends_all)
    ends_that_return(program);
  else
    EndInSub(program, context).run();
  if (program.dialect != context.target.dialect) {
    for (auto& r : program.routines) {
      if (r.kind == RoutineKind::sub) refuse_in_repeated_parts(program, r, context);
    }
  }
  if (context.target.early_return) return;
  for (auto& r : program.routines) single_return(program, r, context);
}

}  // namespace cnctrans::ir::passes
