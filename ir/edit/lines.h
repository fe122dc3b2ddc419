// The lines of a routine, those that close a structure too.
#pragma once

#include <variant>

#include "ir/statement.h"

namespace cnctrans::ir::passes {

/// Calls `visit` with every line of the body in the order of the text: statements, ELSE and the lines that close a
/// structure.
template <class BodyType, class Visit>
void each_line(BodyType& body, const Visit& visit) {
  for (auto& s : body) {
    visit(s.line);
    std::visit(
        [&visit](auto& node) {
          if constexpr (requires { node.else_line; }) {
            each_line(node.then_body, visit);
            visit(node.else_line);
            each_line(node.else_body, visit);
          } else if constexpr (requires { node.end_line; }) {
            each_line(node.body, visit);
          }
          if constexpr (requires { node.end_line; }) visit(node.end_line);
        },
        s.node);
  }
}

}  // namespace cnctrans::ir::passes
