// Pockets with islands: the operations that a call names, one after the other, and the places of their drilling.
#include <algorithm>
#include <string>

#include "interpreter/machine/block_machine.h"
#include "interpreter/trace/run_codes.h"
#include "ir/cycles/milling/pocket_call.h"
#include "ir/cycles/milling/pocket_moves.h"

namespace cnctrans::interpreter {

bool BlockMachine::run_pocket(const ir::NamedCycle& call) {
  if (call.name != ir::cycles::pocket::call)
    return failure_.fail(code::bad_cycle, "an operation of a pocket runs only through the call of the pocket");
  if (program_ == nullptr)
    return failure_.fail(code::needs_whole_program, "a cycle with a contour needs the whole program");
  if (pending_) {
    release_pending();
    if (!without_corner("a cycle follows a corner function")) return false;
  }
  std::string error;
  const auto operations = ir::cycles::pocket_operations(*program_, *routine_, call, &error);
  if (!operations) {
    return failure_.fail(error.ends_with("not carried out yet") ? code::not_carried : code::bad_cycle, error);
  }
  cycle_.hole.reset();
  const Span here = failure_.where;
  for (const auto& s : operations->blocks) {
    if (!block(std::get<ir::Block>(s.node), s.line.span)) return false;
  }
  modal_.motion = ir::MotionKind::rapid;
  failure_.where = here;
  path_event_.file = event_.file = here.file;
  path_event_.line = event_.line = here.line;
  return true;
}

/// By the tool of the roughing, which the words of the cycle name.
bool BlockMachine::find_pocket_entries() {
  ir::cycles::MillContext context;
  if (!mill_context(context)) return false;
  const auto number = [this](std::string_view word, std::int32_t otherwise) {
    const auto it = cycle_.mill.words.find(word);
    return it == cycle_.mill.words.end() ? otherwise : static_cast<std::int32_t>(it->second);
  };
  const ToolInUse here = tool_;
  tool_.pretend(number("tool", tool_.number()), number("offset", tool_.offset()));
  context.tool_radius = cycle_.mill.tool_radius.value_or(tool_radius());
  tool_ = here;
  if (context.tool_radius <= 0)
    return failure_.fail(code::bad_cycle,
                         "the places of the drilling depend on the radius of the roughing tool, which "
                         "is not known: give it with --tools FILE, in the profile's \"tools\" or by --set "
                         "TOOL_RADIUS=5");
  std::string error;
  const auto points = ir::cycles::pocket_entries(cycle_.mill, context, &error);
  if (points.empty()) return failure_.fail(code::bad_cycle, error);
  for (const auto& p : points) hole_entries_.emplace_back(p.u, p.v);
  return true;
}

}  // namespace cnctrans::interpreter
