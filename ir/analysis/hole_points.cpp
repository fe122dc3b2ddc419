#include "ir/analysis/hole_points.h"

#include <algorithm>

#include "ir/edit/search.h"

namespace cnctrans::ir {

HolePoint hole_point(const Block& b, const Facts& facts) {
  if (const auto* define = action_in<CycleDefine>(b)) {
    const bool hole = define->cycle && std::holds_alternative<HoleCycle>(define->cycle->node);
    return define->here && hole ? HolePoint::yes : HolePoint::no;
  }
  const bool ends = action_in<CycleCancel>(b) != nullptr;
  if (ends || b.motion.frame != FrameUse::normal || (facts.cycle_active_known && !facts.cycle_active))
    return HolePoint::no;
  const auto plane = facts.settings[static_cast<std::size_t>(Setting::plane)];
  const AxisId along = plane ? plane_axes(static_cast<Plane>(*plane)).w : axis::none;
  const auto& words = b.motion.coords;
  if (!plane || std::any_of(words.begin(), words.end(), [along](const auto& w) { return w.axis == along; }))
    return HolePoint::no;
  return facts.cycle_active_known ? HolePoint::yes : HolePoint::perhaps;
}

}  // namespace cnctrans::ir
