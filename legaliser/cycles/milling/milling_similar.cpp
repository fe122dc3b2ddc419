// Pockets as a cycle of the target that leaves the same part by other passes.
#include <cmath>
#include <utility>

#include "legaliser/cycles/milling/milling_moves.h"
#include "legaliser/cycles/milling/similar_pocket.h"
#include "legaliser/cycles/milling/single_pockets.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

namespace {

/// The word by which the block goes to an absolute place, else the number that the text gives.
std::optional<Value> place_word(const Block& b, const Facts& facts, AxisId axis) {
  const auto distance = setting_in<Distance>(b, facts, Setting::distance);
  for (const auto& c : b.motion.coords) {
    if (!b.has_motion || c.axis != axis || b.motion.extra || b.motion.frame != FrameUse::normal) continue;
    const bool absolute = c.mode == WordMode::absolute || (c.mode == WordMode::modal && distance == Distance::absolute);
    if (!absolute || c.scale != WordScale::modal) return std::nullopt;
    Value v = c.value;
    v.text = {};
    return v;
  }
  const auto n = place_after(b, facts, axis);
  return n ? std::optional(Value(*n)) : std::nullopt;
}

Statement rapid_to(const LineInfo& like, const std::vector<std::pair<AxisId, Value>>& place) {
  Block b;
  b.has_motion = true;
  b.motion.kind = MotionKind::rapid;
  b.motion.explicit_code = true;
  b.motion.keeps_modal = false;
  for (const auto& [axis, v] : place) {
    CoordWord c;
    c.axis = axis;
    c.mode = WordMode::absolute;
    c.value = v;
    b.motion.coords.push_back(c);
  }
  return made(like, std::move(b));
}

}  // namespace

std::optional<PocketSource> MillCycles::pocket_source(const HoleCycle& cycle, const Statement& s, const Block& b,
                                                      const Facts& facts, std::optional<SpindleState> sense,
                                                      std::string* why) const {
  const auto units = setting_in<Units>(b, facts, Setting::units);
  const auto distance = setting_in<Distance>(b, facts, Setting::distance);
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  if (!units || !plane || distance != Distance::absolute)
    return *why = "plane, units or absolute and incremental are not the same there", std::nullopt;
  const auto w = cycle_axis(cycle, b, facts);
  const auto axes = plane_axes(*plane);
  if (w != axes.w ||
      (*plane != Plane::xy && setting_in<DiameterMode>(b, facts, Setting::diameter) != DiameterMode::radius))
    return *why = "its plane, or diameters in it, are not those of the target's cycle", std::nullopt;
  if (context_.target.cycle_each_call && w != axis::z) return *why = "the target's cycles go along Z", std::nullopt;
  if (setting_in<CompSide>(b, facts, Setting::comp) != CompSide::off)
    return *why = "radius compensation is on, or may be", std::nullopt;
  const double unit = *units == Units::inch ? 25.4 : 1;
  PocketSource source;
  source.u = place_word(b, facts, axes.u);
  source.v = place_word(b, facts, axes.v);
  const FeedBefore feed = feeds_.at(s, b, facts);
  if (feed.value) source.feed = Value(*feed.value);
  for (const auto& a : b.actions) {
    const auto* own = std::get_if<SetFeed>(&a.data);
    if (own != nullptr && a.order != Order::after && !source.feed) source.feed = own->value;
  }
  std::string error;
  bool none = false;
  std::optional<double> r;
  for (const auto& [name, v] : cycle.mill.words) {
    if (name == cycles::tool_radius_word) r = known_number(v);
  }
  if (!r) r = radius(sites_.at(s.id), unit, &error, &none);
  if (r && *r > 0) source.radius = *r / unit;
  source.sense = sense;
  source.clearance = 1 / unit;
  source.mirrors = mirrors_;
  return source;
}

std::optional<MillCycles::Similar> MillCycles::similar(const HoleCycle& cycle, const Statement& s, const Block& b,
                                                       const Facts& facts, std::optional<double> defined_at,
                                                       std::optional<SpindleState> sense, bool last_resort,
                                                       std::string* why) const {
  why->clear();
  const auto asked = context_.options.cycles;
  if (asked != CycleWriting::native && !(last_resort && asked == CycleWriting::exact)) return std::nullopt;
  const auto& native = context_.target.native_cycle;
  if (!native || !sites_.contains(s.id)) return std::nullopt;
  const auto single = single_pockets(cycle, why);
  if (!single) return std::nullopt;
  auto source = pocket_source(cycle, s, b, facts, sense, why);
  if (!source) return std::nullopt;
  const auto axes = plane_axes(*setting_in<Plane>(b, facts, Setting::plane));
  const double unit = setting_in<Units>(b, facts, Setting::units) == Units::inch ? 25.4 : 1;
  const auto initial = defined_at ? std::optional(*defined_at / unit) : std::nullopt;
  const bool feed_given = !feeds_.at(s, b, facts).none;
  Similar out;
  LineInfo like;
  like.span = s.line.span;
  like.skip_mask = s.line.skip_mask;
  // The writers know heights by the words of the text only.
  auto height = height_mm(b, facts, axes.w);
  std::optional<Value> other_feed;
  for (const auto& one : single->pockets) {
    source->cycle = with_absolute_levels(one, b, facts, initial);
    source->cycle.axis = axis::none;
    auto form = similar_pocket(*source, native, why);
    if (!form) return std::nullopt;
    const auto retract = form->retract.literal() ? std::optional(form->retract.number * unit) : std::nullopt;
    // To the retract plane first, as the source does: the way across may be free at that height only.
    if (!retract || !height || std::fabs(*retract - *height) > 1e-9)
      out.blocks.push_back(rapid_to(like, {{axes.w, form->retract}}));
    if (form->feed && !(source->feed && equal(*form->feed, *source->feed))) other_feed = form->feed;
    if (other_feed && !source->feed && feed_given)
      return *why = "the feed in force behind it is not known here", std::nullopt;
    Block call;
    if (form->u && form->v) {
      source->u = form->u;
      source->v = form->v;
      call = way_to_pocket(rapid_to(like, {{axes.u, *form->u}, {axes.v, *form->v}}), out.blocks);
    }
    if (other_feed) call.actions.push_back(action(SetFeed{*other_feed, false}));
    for (const auto& c : form->cycles) {
      call.actions.push_back(
          action(CycleDefine{std::make_shared<const Cycle>(Cycle{c}), false, true, CycleTrigger::plane_axis_word}));
      out.blocks.push_back(made(like, std::move(call)));
      call = Block{};
    }
    height = out.end_height = retract;
    out.differs = form->differs;
  }
  if (other_feed && source->feed) out.blocks.push_back(make_block(like, action(SetFeed{*source->feed, false})));
  if (single->end) out.blocks.push_back(rapid_to(like, {{axes.u, single->end->first}, {axes.v, single->end->second}}));
  end_.reset();
  return out;
}

/// Controls that go to the place of a cycle in rapid take it into the block of the cycle.
Block MillCycles::way_to_pocket(Statement&& to, Body& out) const {
  const bool in_one = !context_.target.retract_plane_switch;
  if (!in_one || context_.target_machine.policies.cycle_positioning != machine::CyclePositioning::rapid) {
    out.push_back(std::move(to));
    return {};
  }
  Block call = std::move(std::get<Block>(to.node));
  by_itself(call);
  return call;
}

}  // namespace cnctrans::ir::passes
