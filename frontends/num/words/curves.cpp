// Splines with a number: G48 defines one by the blocks of its points, G06 runs it, G49 deletes it (reference 6.8).
#include "base/saturate.h"
#include "frontends/num/state/lower.h"

namespace cnctrans::frontends::num {

bool Lowering::curve(const Flow& flow, ir::Statement& out) {
  const Word& g = *flow.word;
  const auto refuse = [&](WordPos pos, std::string_view what) {
    report_.refuse("NUM-004", pos, std::string(text_of(g)) + ": " + std::string(what), {}, "motion.spline");
    return false;
  };
  const Word* nu = flow.curve;
  if (nu == nullptr || nu->is_expression || nu->number < 0 ||
      nu->number != static_cast<double>(saturate<int>(nu->number)))
    return refuse(nu != nullptr ? nu->pos : g.pos, "it names its curve by a whole number (NU)");
  if (flow.program != nullptr) return refuse(flow.program->pos, "points in another program are not carried");
  ir::Repeat repeat;
  repeat.curve = saturate<std::int32_t>(nu->number);
  constexpr int run = 6, define = 48;
  if (flow.code->code == define) {
    if (flow.label_count != 2) return refuse(g.pos, "the blocks of its points are named by two block numbers (N N)");
    if (!label(*flow.labels[0], repeat.first) || !label(*flow.labels[1], repeat.last)) return false;
    if (repeat.first.computed || repeat.last.computed) return refuse(g.pos, "the block numbers are fixed numbers");
    if (!settings_.range_by_position && flow.labels[0]->number > flow.labels[1]->number)
      std::swap(repeat.first, repeat.last);
    repeat.order_free = settings_.range_by_position;
    repeat.curve_use = ir::CurveUse::define;
    const auto [known, fresh] = curves_.emplace(repeat.curve, repeat);
    const bool same = known->second.first.text == repeat.first.text && known->second.last.text == repeat.last.text;
    if (!fresh && !same) return refuse(nu->pos, "this curve is defined before by other blocks: use another number");
  } else {
    if (flow.label_count != 0) return refuse(flow.labels[0]->pos, "a block number means nothing here");
    if (const auto known = curves_.find(repeat.curve); known != curves_.end()) repeat = known->second;
    repeat.curve_use = flow.code->code == run ? ir::CurveUse::run : ir::CurveUse::remove;
    const bool beside = nu->pos.column >= g.pos.column + g.pos.length;
    if (repeat.curve_use == ir::CurveUse::run && !beside) return refuse(nu->pos, "NU stands behind it");
  }
  out.node = std::move(repeat);
  return true;
}

}  // namespace cnctrans::frontends::num
