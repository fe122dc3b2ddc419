#include "dialects/sinumerik/variables.h"

#include <utility>

#include "dialects/sinumerik/limits.h"

namespace cnctrans::sinumerik {

std::vector<ir::VariableSpace> variable_spaces() {
  const auto named = [](ir::Scope scope, ir::Type type) {
    ir::VariableSpace s;
    s.scope = scope;
    s.type = type;
    s.starts_at_zero = scope == ir::Scope::routine;
    return s;
  };
  ir::VariableSpace r;
  r.prefix = "R";
  ir::SpaceSegment segment;
  segment.hi = r_parameter_max;
  r.segments.push_back(segment);
  return {std::move(r),
          named(ir::Scope::routine, ir::Type::real),
          named(ir::Scope::routine, ir::Type::integer),
          named(ir::Scope::routine, ir::Type::boolean),
          named(ir::Scope::routine, ir::Type::string),
          named(ir::Scope::routine, ir::Type::axis),
          named(ir::Scope::global, ir::Type::real),
          named(ir::Scope::global, ir::Type::integer),
          named(ir::Scope::global, ir::Type::boolean),
          named(ir::Scope::global, ir::Type::string),
          named(ir::Scope::routine, ir::Type::frame)};
}

std::optional<ir::SpaceId> space_of(ir::Type type, bool global) {
  switch (type) {
    case ir::Type::real: return global ? space::global_real : space::real;
    case ir::Type::integer: return global ? space::global_integer : space::integer;
    case ir::Type::boolean: return global ? space::global_boolean : space::boolean;
    case ir::Type::string: return global ? space::global_string : space::string;
    case ir::Type::axis:
      if (!global) return space::axis;
      return std::nullopt;
    case ir::Type::frame:
      if (!global) return space::frame;
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace cnctrans::sinumerik
