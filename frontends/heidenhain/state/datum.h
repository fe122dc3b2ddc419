// Data of the machine in formulas and words.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "ir/expr.h"

namespace cnctrans::frontends::heidenhain {

/// `text`: its name in the source, or the one under which the machine's profile gives it.
inline ir::ExprPtr datum(ir::Datum d, std::string text, ir::AxisId axis = ir::axis::none) {
  ir::SystemRef ref;
  ref.datum = d;
  ref.text = std::move(text);
  ref.axis = axis;
  auto e = std::make_shared<ir::Expr>();
  e->node = std::move(ref);
  return e;
}

}  // namespace cnctrans::frontends::heidenhain
