// Targets without modal cycles: each point of the source's cycle gets a call of its own.
#include "legaliser/cycles/cycle_pass.h"

namespace cnctrans::ir::passes {

/// The block without the definition; where it is a point as well, its call follows.
void CyclePass::define_each(Statement&& s, const CycleDefine& d, Active&& a, Body&& pieces, Body& out) {
  auto& b = std::get<Block>(s.node);
  a.single = true;
  if (d.here && refuse_feed_of_tap(s, a)) {
    out.push_back(std::move(s));
    return;
  }
  const LineInfo like = s.line;
  if (d.here) position_rapid(b, context_);
  const CyclePtr native = a.native;
  if (!d.here) {
    const auto w = tool_axis(d.cycle, b, facts_.before(s));
    if (w && moves_along(b, *w)) a.height = height_after(b, facts_.before(s), *w);
  }
  if (d.modal) active_ = std::move(a);
  if (d.here && b.empty()) {
    b.actions.push_back(action(CycleDefine{native, false, true, CycleTrigger::plane_axis_word}));
    return put(out, std::move(pieces), std::move(s));
  }
  if (!d.here) return put(out, std::move(pieces), std::move(s));
  const std::size_t main = pieces.size();
  pieces.push_back(std::move(s));
  pieces.push_back(single_run(like, native));
  put_group(out, std::move(pieces), main);
}

}  // namespace cnctrans::ir::passes
