// Words whose value is per tooth or per cutting edge of the tool: FZ= and SVC= (language reference 14.7). What the tool
// has is asked of its data when the block runs: $TC_DPNT[T,D], its number of teeth, and its radius.
#include <algorithm>
#include <utility>

#include "frontends/sinumerik/state/words.h"

namespace cnctrans::sinumerik {

using syntax::Word;

namespace {

ir::ExprPtr datum(ir::Datum d, std::string text, WordPos pos) {
  ir::SystemRef ref;
  ref.datum = d;
  ref.text = std::move(text);
  return make_expr(std::move(ref), ir::Type::real, pos);
}

}  // namespace

/// FZ=0.1 under G95: the feed per revolution is that of all teeth.
void WordLowering::tooth_feed(const Word& w, const ir::Value& value) {
  if (!c_.per_rev)
    return refuse("feed.of_the_tool", w.pos, "FZ= acts under G95, and the text does not tell the kind of feed here",
                  "write G95 in this block");
  if (!*c_.per_rev) {
    push(ir::OpaqueWord{c_.slice(w.pos)}, Rank::setting, ir::Order::with, w.pos);
    return c_.warning("SIN-100", w.pos, "FZ= acts under G95 only: it is kept as text and leaves the feed as it is",
                      "write G95 before it");
  }
  ir::SystemRef teeth;
  teeth.text = "$TC_DPNT";
  teeth.args.push_back(datum(ir::Datum::tool_number, "$P_TOOLNO", w.pos));
  teeth.args.push_back(datum(ir::Datum::offset_number, "$P_TOOL", w.pos));
  auto feed =
      ir::binary(ir::BinaryOp::multiply, ir::as_expr(value), make_expr(std::move(teeth), ir::Type::real, w.pos));
  push(ir::SetFeed{ir::Value(ir::at(feed, w.pos)), false}, Rank::orient, ir::Order::before, w.pos);
  c_.words_of_tool = true;
}

/// SVC=100: the speed at which the edge of the tool cuts with 100 m/min; behind a tool change of the block.
void WordLowering::cutting_speed(const Word& w, const ir::Value& value) {
  if (c_.units_by_text != ir::Units::metric)
    return refuse("feed.of_the_tool", w.pos, "SVC= is carried where the text tells that lengths are metric (G71, G710)",
                  "write G71 before it");
  if (c_.css.value_or(true))
    return refuse("feed.of_the_tool", w.pos, "SVC= does not go with a constant cutting speed (G96)",
                  "write G97 before it");
  constexpr double pi = 3.14159265358979323846;
  constexpr double mm_per_m = 1000;
  auto path = ir::binary(ir::BinaryOp::multiply, ir::as_expr(value), ir::number(mm_per_m));
  auto round = ir::binary(ir::BinaryOp::multiply, ir::number(2 * pi), datum(ir::Datum::tool_radius, "$P_TOOLR", w.pos));
  auto speed = ir::binary(ir::BinaryOp::divide, std::move(path), std::move(round));
  push(ir::SetSpindle{c_.master_spindle, ir::Value(ir::at(speed, w.pos))}, Rank::orient, ir::Order::before, w.pos);
  c_.words_of_tool = true;
}

/// Another tool behind FZ= or SVC=: whether the control computes the value anew is not described.
void WordLowering::words_of_tool() {
  bool tool = false, own = false;
  for (const auto& a : out_->actions) {
    tool = tool || std::holds_alternative<ir::ToolSelect>(a.data) || std::holds_alternative<ir::ToolChange>(a.data) ||
           std::holds_alternative<ir::ToolOffset>(a.data);
    own = own || std::holds_alternative<ir::SetFeed>(a.data) || std::holds_alternative<ir::SetSpindle>(a.data);
  }
  if (!tool || own) return;
  c_.words_of_tool = false;
  c_.warning(
      "SIN-100", out_->actions.front().pos,
      "FZ= and SVC= are still in force, and are taken for the tool of before: the feed and the speed stay as they "
      "were",
      "write FZ=, SVC=, F or S again behind the tool change");
}

}  // namespace cnctrans::sinumerik
