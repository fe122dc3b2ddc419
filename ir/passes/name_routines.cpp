// Names of subprograms (equivalences 2.2): a target that knows numbers only gets numbers; the name stays as the title.
#include <algorithm>
#include <map>
#include <set>

#include "base/saturate.h"
#include "base/text.h"
#include "ir/passes/passes.h"
#include "ir/passes/rewrite.h"

namespace cnctrans::ir::passes {

namespace {

/// The digits at the end of "L140" or "SUB20"; -1: none, or something else behind them.
std::int64_t digits_of(const std::string& name) {
  const auto first = name.find_first_of("0123456789");
  if (first == std::string::npos || name.find_first_not_of("0123456789", first) != std::string::npos) return -1;
  const auto v = parse_decimal(std::string_view(name).substr(first));
  return v && *v < 1e9 ? saturate<std::int64_t>(*v) : -1;
}

class RoutineNames {
 public:
  RoutineNames(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  /// Two subprograms of one name (a local and a global one): calls reach the first; the other gets a free number, so
  /// that it can't take the first one's place.
  void part_namesakes() {
    for (const auto& r : program_.routines) {
      if (r.name.number >= 0) used_.insert(r.name.number);
      if (const auto n = digits_of(r.name.text); n >= 0) used_.insert(n);
    }
    for (auto& r : program_.routines) {
      const Routine* reached = r.kind == RoutineKind::sub ? program_.find(r.name) : nullptr;
      if (reached == nullptr || reached == &r || reached->kind != RoutineKind::sub) continue;
      const std::int64_t n = free_number();
      if (n < 0) {
        context_.diagnostics.error("TRN-194", r.header.span, "no number is free for this subprogram");
        continue;
      }
      context_.diagnostics.warning("TRN-186", r.header.span,
                                   "a subprogram with a name that another one has already: calls reach the other "
                                   "one; this one is written as " +
                                       std::to_string(n),
                                   "give one of them another number");
      used_.insert(n);
      if (context_.report != nullptr) {
        context_.report->renamed.push_back({Renamed::Kind::routine, shown(r.name), std::to_string(n), {}});
      }
      r.name = RoutineName{n, {}};
    }
    used_.clear();
  }

  void run() {
    std::set<std::int64_t> seen;
    for (auto& r : program_.routines) {
      if (good(r.name.number)) used_.insert(r.name.number);
      if (r.kind == RoutineKind::main && good(r.name.number)) seen.insert(r.name.number);
    }
    for (auto& r : program_.routines) {
      if (r.kind != RoutineKind::sub) continue;
      const bool by_number = good(r.name.number) && r.name.text.empty() && seen.insert(r.name.number).second;
      if (by_number) continue;
      const std::int64_t wanted =
          good(r.name.number) && seen.count(r.name.number) == 0 ? r.name.number : digits_of(r.name.text);
      std::int64_t n = good(wanted) && (used_.count(wanted) == 0 || wanted == r.name.number) && seen.count(wanted) == 0
                           ? wanted
                           : free_number();
      if (n < 0) {
        context_.diagnostics.error("TRN-194", r.header.span, "no number is free for this subprogram");
        continue;
      }
      used_.insert(n);
      seen.insert(n);
      rename(r, n);
    }
    references();
  }

 private:
  bool good(std::int64_t n) const {
    return n >= context_.target.routine_number_min && n <= context_.target.routine_number_max;
  }
  std::int64_t free_number() const {
    for (std::int64_t n = std::max<std::int64_t>(1, context_.target.routine_number_min);
         n <= context_.target.routine_number_max; ++n) {
      if (used_.count(n) == 0) return n;
    }
    return -1;
  }
  static std::string shown(const RoutineName& n) { return n.text.empty() ? std::to_string(n.number) : n.text; }

  void rename(Routine& r, std::int64_t n) {
    const RoutineName from = r.name;
    r.name = RoutineName{n, {}};
    changes_.emplace_back(from, r.name);
    if (digits_of(from.text) != n && r.title.empty()) r.title = from.text;
    if (context_.report != nullptr) {
      context_.report->renamed.push_back({Renamed::Kind::routine, shown(from), std::to_string(n), {}});
    }
  }

  void change(RoutineName& name, const Statement& s) {
    for (const auto& [from, to] : changes_) {
      const bool same = !from.text.empty() ? from.text == name.text : name.text.empty() && from.number == name.number;
      if (!same) continue;
      name = to;
      return;
    }
    if (name.text.empty() || program_.find(name) != nullptr) return;
    const auto n = digits_of(name.text);
    if (good(n) && used_.count(n) == 0) {  // not at hand: called by the digits of its name
      name = RoutineName{n, {}};
      return;
    }
    context_.diagnostics.error(
        "TRN-193", s.line.span,
        "the called program " + quoted(name.text) + " is not at hand, and the target calls by number",
        "add the folder with the subprogram with --lib");
  }

  void references() {
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [this](Statement& s) {
        if (auto* c = std::get_if<CallRoutine>(&s.node)) {
          if (!c->computed) change(c->routine, s);
        } else if (auto* m = std::get_if<ModalCall>(&s.node)) {
          if (!m->off && !m->cycle && !m->call.computed) change(m->call.routine, s);
        } else if (auto* rep = std::get_if<Repeat>(&s.node)) {
          if (rep->has_program) change(rep->program, s);
        }
      });
    }
  }

  Program& program_;
  const LegaliseContext& context_;
  std::set<std::int64_t> used_;
  std::vector<std::pair<RoutineName, RoutineName>> changes_;
};

}  // namespace

void name_routines(Program& program, const LegaliseContext& context) {
  RoutineNames names(program, context);
  names.part_namesakes();
  if (!context.target.named_routines) names.run();
}

}  // namespace cnctrans::ir::passes
