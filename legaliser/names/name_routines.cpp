// Names of subprograms (equivalences 2.2): a target that knows numbers only gets numbers; the name stays as the title.
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/saturate.h"
#include "base/text.h"
#include "ir/edit/rewrite.h"
#include "legaliser/names/number_programs.h"
#include "legaliser/passes.h"

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

  /// An archive with two main programs: the second one would stand among the subprograms of the first.
  void part_mains() {
    const Routine* first = program_.main();
    for (auto& r : program_.routines) {
      if (r.kind != RoutineKind::main || &r == first || r.name.number >= 0) continue;
      context_.diagnostics.error("TRN-478", r.header.span,
                                 "a second main program in one file: the target takes it as a program of its own",
                                 "save it in a file of its own and translate that");
      if (const std::int64_t n = free_number(); n >= 0) {
        used_.insert(n);
        rename(r, n);
      }
    }
  }

  void run() {
    std::set<std::int64_t> seen;
    reserve_given();
    for (auto& r : program_.routines) {
      if (good(r.name.number)) used_.insert(r.name.number);
      if (r.kind == RoutineKind::main && good(r.name.number)) seen.insert(r.name.number);
    }
    for (auto& r : program_.routines) {
      if (r.kind != RoutineKind::sub) continue;
      if (const auto n = given(r.name)) {
        if (!seen.insert(*n).second) taken_twice(r, *n);
        rename(r, *n);
        continue;
      }
      const bool by_number = good(r.name.number) && r.name.text.empty() && given_.count(r.name.number) == 0 &&
                             seen.insert(r.name.number).second;
      if (by_number) {
        note(r.name, r.name.number);
        continue;
      }
      const std::int64_t wanted =
          good(r.name.number) && given_.count(r.name.number) == 0 && seen.count(r.name.number) == 0
              ? r.name.number
              : digits_of(r.name.text);
      std::int64_t n = good(wanted) && (used_.count(wanted) == 0 || wanted == r.name.number) &&
                               given_.count(wanted) == 0 && seen.count(wanted) == 0
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
    part_mains();
    references();
  }

  /// Names that the target can't write become plain ones, or numbers.
  void plain_names() {
    if (!context_.target.plain_name) return;
    for (const auto& r : program_.routines) used_.insert(r.name.text.empty() ? r.name.number : digits_of(r.name.text));
    for (auto& r : program_.routines) {
      if (r.kind != RoutineKind::sub || r.name.text.empty() || given_name(r.name)) continue;
      RoutineName to{-1, context_.target.plain_name(r.name.text)};
      if (to.text == r.name.text) continue;
      if (to.text.empty() || program_.find(to) != nullptr) to = RoutineName{free_number(), {}};
      used_.insert(to.number);
      changes_.emplace_back(r.name, to);
      if (context_.report != nullptr)
        context_.report->renamed.push_back({Renamed::Kind::routine, shown(r.name), shown(to), {}});
      r.name = to;
    }
    references();
    changes_.clear();
  }

  /// Names that the map gives in a target which has names: those only.
  void run_named() {
    plain_names();
    if (context_.names == nullptr) return;
    for (auto& r : program_.routines) {
      if (r.kind != RoutineKind::sub) continue;
      const auto to = given_name(r.name);
      if (!to) continue;
      if (!to->text.empty() && !identifier(to->text)) {
        context_.diagnostics.error("TRN-441", r.header.span,
                                   "the map of names calls this subprogram " + quoted(to->text) +
                                       ", which is no name: two letters, then letters, digits and _",
                                   "give it a name or a number in the map");
        continue;
      }
      changes_.emplace_back(r.name, *to);
      if (context_.report != nullptr) {
        context_.report->renamed.push_back({Renamed::Kind::routine, shown(r.name), shown(*to), {}});
        context_.report->names.routines[shown(r.name)] = context_.names->routines.at(shown(r.name));
      }
      r.name = *to;
    }
    for (const auto& r : program_.routines) {
      if (r.kind == RoutineKind::sub && program_.find(r.name) != &r) taken_twice(r, r.name.number);
    }
    references();
  }

 private:
  /// What the map gives a subprogram, as the text says it: a number, or letters and more.
  [[nodiscard]] const std::string* entry(const RoutineName& name) const {
    return context_.names != nullptr ? context_.names->given(name) : nullptr;
  }
  static bool identifier(const std::string& name) {
    constexpr std::size_t longest = 24;
    const auto letter = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; };
    return name.size() >= 2 && name.size() <= longest && letter(name[0]) && letter(name[1]) &&
           std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
  }
  [[nodiscard]] std::optional<std::int64_t> given(const RoutineName& name) const {
    const std::string* to = entry(name);
    if (to == nullptr) return std::nullopt;
    const auto n = digits_of(*to);
    return good(n) ? std::optional(n) : std::nullopt;
  }
  [[nodiscard]] std::optional<RoutineName> given_name(const RoutineName& name) const {
    const std::string* to = entry(name);
    if (to == nullptr) return std::nullopt;
    if (const auto n = digits_of(*to); n >= 0) return RoutineName{n, {}};
    return RoutineName{-1, to_upper_ascii(*to)};
  }
  /// The numbers of the map are nobody else's, also where this program does not call what has them.
  void reserve_given() {
    if (context_.names == nullptr) return;
    for (const auto& [stem, name] : context_.names->programs) {
      if (const auto n = name.front() == '%' ? digits_of(name) : -1; n >= 0) used_.insert(n);
    }
    for (const auto& [from, to] : context_.names->routines) {
      const auto n = digits_of(to);
      if (good(n)) {
        used_.insert(n);
        given_.insert(n);
      } else {
        context_.diagnostics.error("TRN-441", {},
                                   "the map of names calls the subprogram " + from + " " + quoted(to) +
                                       ", and the target has the numbers " +
                                       std::to_string(context_.target.routine_number_min) + " to " +
                                       std::to_string(context_.target.routine_number_max),
                                   "give it one of them in the map");
      }
    }
  }
  void taken_twice(const Routine& r, std::int64_t n) const {
    context_.diagnostics.error("TRN-441", r.header.span,
                               "the map of names gives " + (n >= 0 ? std::to_string(n) : quoted(r.name.text)) +
                                   " to two subprograms of this program",
                               "give one of them another one in the map");
  }

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
  static std::string shown(const RoutineName& n) { return NameMap::key(n); }

  void rename(Routine& r, std::int64_t n) {
    const RoutineName from = r.name;
    r.name = RoutineName{n, {}};
    changes_.emplace_back(from, r.name);
    if (digits_of(from.text) != n && r.title.empty()) r.title = from.text;
    if (context_.report != nullptr) {
      context_.report->renamed.push_back({Renamed::Kind::routine, shown(from), std::to_string(n), {}});
    }
    note(from, n);
  }
  void note(const RoutineName& from, std::int64_t n) const {
    if (context_.report != nullptr) context_.report->names.routines[shown(from)] = std::to_string(n);
  }

  void change(RoutineName& name, const Statement& s) {
    for (const auto& [from, to] : changes_) {
      const bool same = !from.text.empty() ? from.text == name.text : name.text.empty() && from.number == name.number;
      if (!same) continue;
      name = to;
      return;
    }
    if (context_.target.named_routines) {  // not at hand
      if (const auto to = program_.find(name) == nullptr ? given_name(name) : std::nullopt) call_outside(name, *to, s);
      return;
    }
    if (const auto n = program_.find(name) == nullptr ? given(name) : std::nullopt) {
      call_outside(name, RoutineName{*n, {}}, s);
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

  void call_outside(RoutineName& name, const RoutineName& to, const Statement& s) const {
    context_.diagnostics.warning("TRN-442", s.line.span,
                                 "the called program " + quoted(shown(name)) +
                                     " is not at hand: the call is written as the map of names says, and what it does "
                                     "on the target is not known",
                                 "see to it that " + quoted(shown(to)) + " of the target does the same");
    name = to;
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
  std::set<std::int64_t> given_;  ///< by the map
  std::vector<std::pair<RoutineName, RoutineName>> changes_;
};

}  // namespace

void number_programs(Program& program, Diagnostics& diagnostics, bool all_calls) {
  const auto number_in = [](const RoutineName& n) {
    return n.text.find_first_not_of("0123456789") == std::string::npos ? digits_of(n.text) : -1;
  };
  std::map<std::string, RoutineName> numbers;
  bool moved = false;
  for (auto& r : program.routines) {
    std::int64_t n = r.kind == RoutineKind::sub ? number_in(r.name) : -1;
    if (n < 0) continue;
    const bool taken = program.find(RoutineName{n, {}}) != nullptr;
    if (taken) n = 1;
    while (taken && program.find(RoutineName{n, {}}) != nullptr) ++n;
    moved = moved || taken;
    numbers[r.name.text] = RoutineName{n, {}};
    r.name = RoutineName{n, {}};
  }
  const auto change = [&](RoutineName& name, const Statement& s) {
    const auto n = number_in(name);
    if (const auto it = numbers.find(name.text); n >= 0 && it != numbers.end()) {
      name = it->second;
    } else if (!all_calls) {
      return;
    } else if (n >= 0 && program.find(RoutineName{n, {}}) == nullptr) {
      name = RoutineName{n, {}};
    } else if (n >= 0) {
      diagnostics.error("TRN-621", s.line.span,
                        "the program " + name.text + " is not at hand, and a subprogram has the same number",
                        "add the folder with the program with --lib, or give the subprogram another number");
    }
  };
  const auto call = [&](CallRoutine& c, const Statement& s) {
    const auto* text = c.computed ? std::get_if<Call>(&c.computed->node) : nullptr;
    if (!c.computed) {
      change(c.routine, s);
    } else if (all_calls && moved && text != nullptr && text->function == Function::to_string) {
      diagnostics.error("TRN-621", s.line.span,
                        "a program chosen when the program runs, and one of them has the number of a subprogram",
                        "give the subprogram another number");
    }
  };
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      if (auto* c = std::get_if<CallRoutine>(&s.node)) {
        call(*c, s);
      } else if (auto* m = std::get_if<ModalCall>(&s.node)) {
        if (!m->off && !m->cycle) call(m->call, s);
      } else if (auto* rep = std::get_if<Repeat>(&s.node)) {
        if (rep->has_program) change(rep->program, s);
      }
    });
  }
}

void name_routines(Program& program, const LegaliseContext& context) {
  number_programs(program, context.diagnostics, true);
  RoutineNames names(program, context);
  names.part_namesakes();
  if (context.target.named_routines)
    names.run_named();
  else
    names.run();
}

}  // namespace cnctrans::ir::passes
