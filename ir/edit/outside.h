// A routine that is not at hand and keeps the state of its callers: an empty one stands for it in the program, so that
// every analysis knows what holds behind its calls. It is never written.
#pragma once

#include <string_view>
#include <utility>

#include "ir/program.h"

namespace cnctrans::ir {

inline constexpr std::string_view outside_mark = "=outside";

inline bool is_outside(const Routine& r) {
  return r.header_text == outside_mark;
}

inline void add_outside(Program& program, RoutineName name) {
  Routine r;
  r.kind = RoutineKind::sub;
  r.name = std::move(name);
  r.header_text = outside_mark;
  program.routines.push_back(std::move(r));
}

}  // namespace cnctrans::ir
