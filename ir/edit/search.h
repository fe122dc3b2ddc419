// Looking for actions in blocks and programs.
#pragma once

#include <variant>

#include "ir/program.h"

namespace cnctrans::ir {

/// The last action of kind T in the block, which is the one that holds behind it; nullptr: none. As const as the block.
template <class T, class BlockType>
auto action_in(BlockType& b) -> decltype(std::get_if<T>(&b.actions.front().data)) {
  decltype(std::get_if<T>(&b.actions.front().data)) found = nullptr;
  for (auto& a : b.actions) {
    if (auto* x = std::get_if<T>(&a.data)) found = x;
  }
  return found;
}

/// Some block of the program holds an action for which `test(const Action&)` is true.
template <class Test>
bool any_action(const Program& program, const Test& test) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = found ? nullptr : std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) found = found || test(a);
    });
  }
  return found;
}

}  // namespace cnctrans::ir
