#include "translator/proving/zero_data.h"

#include "ir/edit/rewrite.h"
#include "ir/nesting.h"
#include "translator/proving/explore.h"

namespace cnctrans::translator {

namespace {

bool is_place(ir::Datum d) {
  return d == ir::Datum::machine_position || d == ir::Datum::work_position || d == ir::Datum::work_offset ||
         d == ir::Datum::programmed_shift;
}

bool counts_places(const ir::ExprPtr& e) {
  bool found = false;
  ir::walk(e, [&found](const ir::ExprPtr& n) {
    const auto* s = std::get_if<ir::SystemRef>(&n->node);
    found = found || (s != nullptr && is_place(s->datum));
  });
  return found;
}

}  // namespace

std::set<std::string> zero_data(const ir::Program& program) {
  std::set<std::string> names;
  const auto take = [&](const ir::ExprPtr& e) {
    ir::walk(e, [&](const ir::ExprPtr& n) {
      const auto* v = std::get_if<ir::VarRef>(&n->node);
      const auto number = v != nullptr ? ir::passes::constant_index(*v) : std::nullopt;
      if (number && v->space < program.spaces.size())
        names.insert(plain_name(program.spaces[v->space].prefix + std::to_string(*number)));
    });
  };
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* assign = std::get_if<ir::Assign>(&s.node);
      if (assign == nullptr) return;
      for (const auto& item : assign->items) {
        if (item.value && ((item.to_system && is_place(item.system.datum)) || counts_places(item.value)))
          take(item.value);
      }
    });
  }
  return names;
}

}  // namespace cnctrans::translator
