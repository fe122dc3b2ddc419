#include "frontends/heidenhain/program/tools.h"

#include <algorithm>

#include "frontends/heidenhain/program/ways_of_text.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;

namespace {

bool of_tool(const QValue& v) {
  return v.of_tool_feed || v.of_speed != 0;
}

const CycleDefinition* cycle_at(const Flat& flat, int index) {
  return index < 0 ? nullptr : &flat.cycles[static_cast<std::size_t>(index)];
}

bool defines_by_tool(const Flat& flat, const Item& item) {
  const auto* cycle = item.kind == ItemKind::cycle ? cycle_at(flat, item.index) : nullptr;
  return cycle != nullptr && std::any_of(cycle->values.begin(), cycle->values.end(),
                                         [](const auto& value) { return of_tool(value.second); });
}

/// False: a value that is asked for is not there.
bool take(Lowering& lowering, Item& item, const ToolState& tool) {
  item.tool_radius = tool.radius;
  if (item.tool_feed) {
    if (!tool.feed) return false;
    for (auto& a : std::get<ir::Block>(item.statement.node).actions) {
      if (auto* f = std::get_if<ir::SetFeed>(&a.data)) f->value = *tool.feed;
    }
  }
  if (!defines_by_tool(lowering.flat(), item)) return true;
  for (auto& [q, v] : lowering.flat().cycles[static_cast<std::size_t>(item.index)].values) {
    if (!of_tool(v)) continue;
    const bool known = v.of_tool_feed ? tool.feed.has_value() : tool.speed && tool.speed->literal();
    if (!known) return false;
    v.value = v.of_tool_feed ? *tool.feed : ir::Value(v.of_speed * tool.speed->number);
  }
  return true;
}

/// Q108 is the radius that TOOL DEF says, where the ways bring one tool without an oversize.
void write_radius(Flat& flat) {
  bool asked = false;
  const auto is_radius = [](const ir::ExprPtr& e) {
    const auto* s = std::get_if<ir::SystemRef>(&e->node);
    return s != nullptr && s->datum == ir::Datum::tool_radius && s->args.empty();
  };
  const auto asks = [&](const ir::ExprPtr& e) { asked = asked || is_radius(e); };
  for (const Item& i : flat.items) ir::passes::each_expression(i.statement, asks);
  for (const Pole& p : flat.poles) {
    for (const auto& w : p.words) asked = asked || w.value.expr;
  }
  if (!asked || flat.tools.empty()) return;
  const Flow flow(flat);
  for (std::size_t n = 0; n < flat.items.size(); ++n) {
    Item& item = flat.items[n];
    const int tool = flow.arrivals()[n].tool;
    const ToolState* state = tool < 0 ? nullptr : &flat.tools[static_cast<std::size_t>(tool)];
    if (state == nullptr || !state->radius || state->oversize) continue;
    const auto known = [&](const ir::ExprPtr& e) { return is_radius(e) ? ir::number(*state->radius) : e; };
    const auto in = [&](const ir::ExprPtr& e) { return ir::passes::map_expr(e, known); };
    ir::passes::visit_statement(item.statement, {in, {}});
    if (item.kind != ItemKind::pole) continue;
    for (auto& w : flat.poles[static_cast<std::size_t>(item.index)].words) {
      if (w.value.expr) w.value = ir::Value(in(w.value.expr));
    }
  }
}

}  // namespace

bool asks_tool(const Flat& flat, const Item& item, const Arrival& arrival) {
  const auto* cycle = item.call == CycleCall::none ? nullptr : cycle_at(flat, arrival.cycle);
  const bool mills = cycle != nullptr && cycle->row != nullptr && cycle->row->kind == facts::CycleKind::mill;
  return item.tool_feed || defines_by_tool(flat, item) || mills;
}

void take_tools(Lowering& lowering, bool all) {
  Flat& flat = lowering.flat();
  if (!all) write_radius(flat);
  if (flat.tools.size() < 2) return;
  const Flow flow(flat);
  for (std::size_t i = 0; i < flat.items.size(); ++i) {
    Item& item = flat.items[i];
    const Arrival& a = flow.arrivals()[i];
    const bool several = a.tool == Arrival::several;
    if (!a.reached || a.tool == Arrival::none || (several && !all) || !asks_tool(flat, item, a)) continue;
    if (several ? !item.tool_feed && !defines_by_tool(flat, item)
                : take(lowering, item, flat.tools[static_cast<std::size_t>(a.tool)])) {
      if (several) item.tool_radius.reset();
      continue;
    }
    lowering.report().start(item.statement.line.span);
    constexpr std::string_view feature = "feed.of_the_tool";
    lowering.report().keep("HEI-005", {},
                           several ? "which TOOL CALL gives the feed here depends on the way"
                                   : "the TOOL CALL from which the way comes gives no feed or speed",
                           feature, "write F as a number");
    give_up(flat, item, "F AUTO", feature);
  }
}

}  // namespace cnctrans::frontends::heidenhain
