#include "translator/translation/outside_calls.h"

#include <algorithm>
#include <tuple>

#include "base/text.h"
#include "ir/edit/outside.h"
#include "ir/edit/rewrite.h"
#include "ir/text/text.h"
#include "legaliser/control/lower_calls.h"

namespace cnctrans::translator {

using ir::passes::made;
using ir::passes::rewrite_body;

namespace {

/// A call by a fixed name of a whole routine.
template <class StatementType>
auto whole_call(StatementType& s) -> decltype(std::get_if<ir::CallRoutine>(&s.node)) {
  auto* call = std::get_if<ir::CallRoutine>(&s.node);
  auto* modal = std::get_if<ir::ModalCall>(&s.node);
  if (modal != nullptr && !modal->off && !modal->cycle) call = &modal->call;
  return call == nullptr || call->computed || call->has_range ? nullptr : call;
}

/// The digits at the end of a name: "L903".
std::string digits_at_end(const std::string& name) {
  const auto last = name.find_last_not_of("0123456789");
  return last == std::string::npos ? name : name.substr(last + 1);
}

/// The variable of the target that argument number `at` goes to; nullptr: the file names none.
const std::string* place_of_argument(const OutsideRoutine* says, const ir::Argument& a, std::size_t at) {
  if (says == nullptr) return nullptr;
  std::size_t position = 0;
  for (const auto& [letter, variable] : says->arguments) {
    const bool meant = letter.empty() ? position == at : letter == a.name;
    if (letter.empty()) ++position;
    if (meant) return variable.empty() ? nullptr : &variable;
  }
  return nullptr;
}

ir::Statement assign_given(const ir::LineInfo& like, const std::string& place, ir::ExprPtr value) {
  ir::Assign a;
  ir::Assign::Item item;
  item.to_system = true;
  item.system.text = place;
  item.system.given = true;
  item.value = std::move(value);
  a.items.push_back(std::move(item));
  return made(like, std::move(a));
}

ir::Statement as_text(ir::Statement&& s, const ir::Program& program) {
  ir::Opaque o;
  o.text = ir::to_text(s, program);
  s.node = std::move(o);
  return std::move(s);
}

/// The assignments before a call; empty `why`: nothing is in the way.
ir::Body assignments(const ir::Statement& s, const ir::CallRoutine& call, const OutsideRoutine* says,
                     std::string& why) {
  ir::Body before;
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const ir::Argument& a = call.arguments[i];
    if (!a.value && !a.by_reference) continue;  // left out: the routine takes what it takes then
    const std::string which = a.name.empty() ? "number " + std::to_string(i + 1) : a.name;
    const std::string* to = place_of_argument(says, a, i);
    if (to == nullptr) {
      why = "how argument " + which + " arrives in the target is not known";
    } else if (a.by_reference) {
      why = "argument " + which + " gives a value back";
    } else if (a.value->type == ir::Type::string) {
      why = "argument " + which + " is a text";
    } else {
      before.push_back(assign_given(s.line, *to, a.value));
    }
  }
  if (std::holds_alternative<ir::ModalCall>(s.node) && !before.empty()) why = "a modal call has arguments";
  return before;
}

void place_arguments(ir::Program& program, const Outside& o, Diagnostics& diagnostics) {
  bool told = false;
  const auto place = [&](ir::Statement&& s, ir::Body& out) {
    auto* call = whole_call(s);
    if (call == nullptr || call->routine != o.name || call->arguments.empty()) return out.push_back(std::move(s));
    std::string why;
    ir::Body before = assignments(s, *call, o.says, why);
    if (why.empty()) {
      call->arguments.clear();
      call->level = ir::CallLevel::shared;
      return ir::passes::surround(out, std::move(before), std::move(s), {});
    }
    if (!std::exchange(told, true)) {
      diagnostics.error("TRN-123", s.line.span, "the called subprogram is not at hand: " + why,
                        "say in the file of names which variable of the target gets it (--names, \"arguments\"), or "
                        "add the folder with the subprogram with --lib");
    }
    out.push_back(as_text(std::move(s), program));
  };
  for (auto& r : program.routines) rewrite_body(r.body, place);
}

}  // namespace

std::vector<std::vector<Span>> mark_missing_calls(ir::Program& program, const std::vector<ir::RoutineName>& missing) {
  std::vector<std::vector<Span>> places(missing.size());
  if (missing.empty()) return places;
  for (auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](ir::Statement& s) {
      const auto* call = whole_call(s);
      if (call == nullptr || call->tail || call->optional) return;
      const auto it = std::find(missing.begin(), missing.end(), call->routine);
      if (it == missing.end()) return;
      places[static_cast<std::size_t>(it - missing.begin())].push_back(s.line.span);
      s = as_text(std::move(s), program);
    });
  }
  return places;
}

bool answered(const ir::RoutineName& name, const Names& names, bool numbers) {
  if (names.map.given(name) != nullptr) return true;
  const std::string key = ir::NameMap::key(name);
  return names.outside.count(key) != 0 && (!numbers || !digits_at_end(key).empty());
}

std::vector<Outside> outside_calls(const ir::Program& program, const Names& names, bool numbers,
                                   const std::function<bool(const ir::RoutineName&)>& has) {
  std::vector<Outside> list;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* call = whole_call(s);
      if (call == nullptr || !answered(call->routine, names, numbers)) return;
      const auto same = [call](const Outside& o) { return o.name == call->routine; };
      auto it = std::find_if(list.begin(), list.end(), same);
      if (it == list.end()) {
        if (program.find(call->routine) != nullptr || has(call->routine)) return;
        const auto says = names.outside.find(ir::NameMap::key(call->routine));
        it = list.insert(list.end(),
                         {call->routine, says == names.outside.end() ? nullptr : &says->second, s.line.span, 0});
      }
      const auto place = [](const Span& at) { return std::tuple(at.file, at.line); };
      if (place(s.line.span) < place(it->first)) it->first = s.line.span;
      ++it->calls;
    });
  }
  return list;
}

void settle_outside(ir::Program& work, const std::vector<Outside>& list, Diagnostics& diagnostics) {
  for (const Outside& o : list) {
    if (o.says == nullptr) continue;
    place_arguments(work, o, diagnostics);
    if (!o.says->keeps_state) continue;
    ir::add_outside(work, o.name);
    const std::string name = ir::NameMap::key(o.name);
    const std::string count = o.calls > 1 ? " (" + std::to_string(o.calls) + " calls)" : std::string();
    diagnostics.warning("TRN-443", o.first,
                        "the called program '" + name + "'" + count +
                            " is not at hand: the file of names says that it leaves everything as it is; what it does, "
                            "and what it is given, is not compared",
                        "see to it that the target's program does the same, and leaves functions, tool and zero point "
                        "as they were");
  }
}

void pass_over_outside(ir::Program& program, const std::vector<Outside>& list) {
  for (const Outside& o : list) {
    if (o.says == nullptr || !o.says->keeps_state) continue;
    for (auto& r : program.routines) {
      ir::for_each_statement(r.body, [&o](ir::Statement& s) {
        auto* call = whole_call(s);
        if (call != nullptr && call->routine == o.name) call->arguments.clear();
      });
    }
    ir::add_outside(program, o.name);
  }
}

void pass_over_outside(ir::Program& back, const std::vector<Outside>& list, const Names& names) {
  for (const Outside& o : list) {
    if (o.says == nullptr || !o.says->keeps_state) continue;
    const std::string* given = names.map.given(o.name);
    const std::string target = to_upper_ascii(given != nullptr ? *given : ir::NameMap::key(o.name));
    std::vector<ir::RoutineName> called;
    for (const auto& r : back.routines) {
      ir::for_each_statement(r.body, [&](const ir::Statement& s) {
        const auto* call = whole_call(s);
        if (call == nullptr || back.find(call->routine) != nullptr) return;
        const std::string name = ir::NameMap::key(call->routine);
        if (name == target || (!digits_at_end(target).empty() && digits_at_end(name) == digits_at_end(target)))
          called.push_back(call->routine);
      });
    }
    for (auto& name : called) {
      if (back.find(name) == nullptr) ir::add_outside(back, std::move(name));
    }
  }
}

}  // namespace cnctrans::translator
