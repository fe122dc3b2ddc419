#include "frontends/fagor/program/subroutine_ends.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/saturate.h"
#include "ir/edit/labels.h"

namespace cnctrans::fagor {

namespace {

using Statements = std::vector<const ir::Statement*>;

/// Blocks named by statements: by their keys; `any`: by a number that is computed, or in a whole program (`MEXEC`).
struct Names {
  std::set<std::string> keys;
  bool any = false;

  void take(const ir::LabelRef& l) {
    if (l.computed) any = true;
    if (!l.computed && !l.text.empty()) keys.insert(ir::label_key(l.text, l.is_number));
  }
  void take(const ir::NamedCycle& cycle) {
    for (const auto& [word, value] : cycle.words) {
      if (!word.ends_with("_label")) continue;
      if (!value.literal() || value.number < 0 || value.number != std::floor(value.number)) {
        any = true;
      } else {
        keys.insert(ir::label_key(std::to_string(saturate<std::int64_t>(value.number)), true));
      }
    }
  }
  void take(const ir::Block& b) {
    for (const auto& a : b.actions) {
      const auto* d = std::get_if<ir::CycleDefine>(&a.data);
      const auto* named = d != nullptr && d->cycle ? std::get_if<ir::NamedCycle>(&d->cycle->node) : nullptr;
      if (named != nullptr) take(*named);
    }
  }
  void take(const ir::Statement& s) {
    if (const auto* j = std::get_if<ir::Jump>(&s.node)) {
      take(j->target);
    } else if (const auto* r = std::get_if<ir::Repeat>(&s.node)) {
      take(r->first);
      take(r->last);
    } else if (const auto* b = std::get_if<ir::Block>(&s.node)) {
      take(*b);
    } else if (const auto* i = std::get_if<ir::If>(&s.node)) {
      for (const auto& t : i->then_body) take(t);
      for (const auto& t : i->else_body) take(t);
    }
  }
  void take(const Statements& statements) {
    for (const auto* s : statements) take(*s);
  }
  [[nodiscard]] bool hold(const Statements& statements) const {
    return std::any_of(statements.begin(), statements.end(), [this](const ir::Statement* s) {
      return !s->line.number.empty() && (any || keys.count(ir::label_key(s->line.number, true)) != 0);
    });
  }
};

bool trivial(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  return b != nullptr && b->empty() && s.line.number.empty();
}

/// Nothing runs on behind the body.
bool ends(const ir::Body& body) {
  const auto last = std::find_if_not(body.rbegin(), body.rend(), trivial);
  if (last == body.rend() || last->line.skip_mask != 0) return false;
  if (const auto* j = std::get_if<ir::Jump>(&last->node)) return !j->condition;
  if (const auto* c = std::get_if<ir::CallRoutine>(&last->node)) return c->tail;
  if (const auto* i = std::get_if<ir::If>(&last->node)) {
    return i->has_else && ends(i->then_body) && ends(i->else_body);
  }
  return std::holds_alternative<ir::End>(last->node);
}

/// The parts of a subroutine from (RET) to (RET); the last one may be without.
std::vector<Statements> parts_of(const ir::Routine& r) {
  std::vector<Statements> parts(1);
  for (const auto& s : r.body) {
    if (!trivial(s)) parts.back().push_back(&s);
    if (std::holds_alternative<ir::Return>(s.node) && s.line.skip_mask == 0) parts.emplace_back();
  }
  if (parts.back().empty()) parts.pop_back();
  return parts;
}

/// How many of the parts are the subroutine's own: those up to the last one that it names itself.
std::size_t own_parts(const std::vector<Statements>& parts) {
  Names names;
  std::size_t own = 0;
  for (std::size_t last = 1; own < last && own < parts.size();) {
    while (own < last) names.take(parts[own++]);
    for (std::size_t i = own; i < parts.size(); ++i) {
      if (names.hold(parts[i])) last = i + 1;
    }
  }
  return own;
}

}  // namespace

std::set<std::uint32_t> lines_of_the_main_part(const ir::Program& program) {
  std::set<std::uint32_t> lines;
  const ir::Routine& main = program.routines.front();
  if (main.kind != ir::RoutineKind::main || !ends(main.body)) return lines;
  Names named;
  for (const auto& s : main.body) named.take(s);
  // What the main part reaches may name further blocks; a part without a (RET) at its end can be nobody else's.
  for (bool more = true; more;) {
    more = false;
    for (const auto& r : program.routines) {
      if (r.kind == ir::RoutineKind::main || r.locality == ir::Locality::file_local) continue;
      const auto parts = parts_of(r);
      for (std::size_t i = own_parts(parts); i < parts.size(); ++i) {
        const bool open = !std::holds_alternative<ir::Return>(parts[i].back()->node);
        if (!open && !named.hold(parts[i])) continue;
        if (lines.insert(parts[i].front()->line.span.line).second) {
          for (std::size_t k = i; k < parts.size(); ++k) named.take(parts[k]);
          more = true;
        }
        break;
      }
    }
  }
  return lines;
}

}  // namespace cnctrans::fagor
