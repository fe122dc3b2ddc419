// How two machines begin.
#include "verifier/compare.h"

namespace cnctrans::verifier {

interpreter::Position start_of(const machine::Profile& machine, const machine::World* world) {
  interpreter::Position p;
  for (const auto& a : machine.axes) {
    p.value[a.id] = world != nullptr ? world->start(a) : a.start;
    p.known |= 1U << a.id;
  }
  return p;
}

void compare_zeros(Options& options, const machine::Profile& source, const machine::Profile& target) {
  const auto zero = source.power_on.work_offset;
  const bool same = zero == target.power_on.work_offset;
  options.selects_zero = zero != 0 && !same;
  options.zero_is_open = zero == 0 && !(same && source.policies.work_offset_kept == target.policies.work_offset_kept);
}

}  // namespace cnctrans::verifier
