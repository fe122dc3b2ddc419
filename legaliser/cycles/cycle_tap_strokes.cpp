// Modal calls, points without the cycle, and taps in pecks, in the cycle pass.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/text.h"
#include "legaliser/cycles/cycle_pass.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

void CyclePass::modal_call(Statement&& s, Body& out) {
  const ModalCall m = std::get<ModalCall>(s.node);
  const bool ends_old = old_may_run(facts_.before(s));
  tap_feed_ = tap_feed_ || tap_by_a_jump(facts_.before(s));
  leave_off();
  active_ = define(m.cycle, CycleTrigger::path_motion, Block{}, facts_for_tap(s, Block{}));
  active_->from = s.id;
  active_->said_by = {s.id};
  active_->deferred = true;
  lacking_ = lacking_ || !active_->native;
  tell_tap(*active_, s.line);
  active_->told = false;
  if (by_call_ && active_->native) {
    std::get<ModalCall>(s.node).cycle = active_->native;
    active_->on_target = true;
    out.push_back(std::move(s));
    return;
  }
  // The target defines and runs in one: each point gets its own. The way there must not run the cycle before.
  if (ends_old) {
    const LineInfo like = std::move(s.line);
    s = off_statement(like, by_call_);
    s.line = like;
    out.push_back(std::move(s));
    return;
  }
  leave_line(std::move(s), out);
}

void CyclePass::position(Statement&& s, Body& out) {
  auto& b = std::get<Block>(s.node);
  b.repeat_given = 0;
  b.repeat = Value{};
  const Facts& facts = facts_.before(s);
  const bool none = facts.cycle_active_known && !facts.cycle_active;
  if (!active_ && !none) {
    refuse(s, program_, context_, "TRN-199",
           "a block that only positions and leaves the active cycle out: which cycle that is can't be seen here",
           "cancel the cycle before the block");
    out.push_back(std::move(s));
    return;
  }
  const bool on = active_ && (active_->on_target || active_->maybe_on_target);
  if (active_ && (!sure(facts) || (on && facts.reachable && !surely_on(facts)))) {
    refuse_other_ways(s);
    out.push_back(std::move(s));
    return;
  }
  Body pieces;
  const LineInfo like = s.line;
  if (active_) follow_retract_plane(b, facts);
  if (on) pieces.push_back(off_statement(like, by_call_));
  const std::size_t main = pieces.size();
  pieces.push_back(std::move(s));
  if (on && by_call_ && active_->native)
    pieces.push_back(on_statement(like, active_->native));
  else if (on)
    active_->on_target = active_->maybe_on_target = false;  // the next point defines it again
  put_group(out, std::move(pieces), main);
}

void CyclePass::no_moves(Statement&& s, const std::string& why, Body& out) {
  constexpr std::string_view radius =
      "give the radius of the tool: --tools FILE, the profile's \"tools\", or --set TOOL_RADIUS=5";
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> hints{
      {{"radius of the tool", radius},
       {"which tool", radius},
       {"width of the grooving tool", "give the width of the tool: --tools FILE, or \"nose_width\" in the profile"}}};
  const auto known = std::find_if(hints.begin(), hints.end(),
                                  [&why](const auto& h) { return why.find(h.first) != std::string::npos; });
  refuse(
      s, program_, context_, "TRN-330", "a cycle that the target lacks can't be written out: " + why,
      std::string(known != hints.end() ? known->second : "give the cycle's words and the place before it as numbers"));
  late_.clear();
  out.push_back(std::move(s));
}

void CyclePass::tell_tap(const Active& a, const LineInfo& where) const {
  if (!a.native || a.needs.differs.empty()) return;
  context_.diagnostics.warning("TRN-423", where.span,
                               "the target's tap takes the place of this one: " + a.needs.differs,
                               "the thread is the same; check the tap on the target");
}

void CyclePass::tell_reference(const Active& a, const LineInfo& where) const {
  const auto* hole = std::get_if<HoleCycle>(&a.source->node);
  if (hole == nullptr || !hole->retract.given || !hole->reference.given || program_.dialect == context_.target.dialect)
    return;
  const bool by_surface = hole->reference.base == LevelBase::from_surface && hole->surface.given;
  if (hole->reference.value.literal() && (!by_surface || hole->surface.value.literal())) return;
  context_.diagnostics.warning(
      "TRN-334", where.span,
      "the reference plane is taken to lie below the retract plane: how high it is only the run "
      "knows, and above it the controls move otherwise or stop");
}

std::optional<Explosion> CyclePass::tap_strokes(const HoleCycle& c, const Statement& s, const Block& b,
                                                std::string* differs) {
  if ((c.kind != HoleKind::tap && c.kind != HoleKind::tap_floating) || c.pecks.law == PeckLaw::none)
    return std::nullopt;
  const Facts facts = facts_for_tap(s, b);
  const auto units = setting_in<Units>(b, facts, Setting::units);
  const auto distance = setting_in<Distance>(b, facts, Setting::distance);
  const auto w = cycle_axis(c, b, facts);
  if (!units || !w || distance != Distance::absolute) return std::nullopt;
  const double unit = *units == Units::inch ? 25.4 : 1;
  cycles::HoleContext context;
  context.length_unit = context.level_unit = context.feed_unit = unit;
  context.height = active_->defined_at.value_or(active_->height.value_or(std::nan("")));
  const auto literal = [](const Value& v) { return v.literal() ? std::optional(v.number) : constant_value(v.expr); };
  std::string error;
  const auto n = cycles::resolve(c, context, literal, &error);
  const auto plane = setting_in<RetractPlane>(b, facts, Setting::retract_plane).value_or(RetractPlane::initial);
  if (!n || std::isnan(cycles::retract_level(*n, plane))) return std::nullopt;
  const auto level = [unit](double mm) {
    Level l;
    l.value = Value(std::round(mm / unit * 1e9) / 1e9);
    l.given = true;
    return l;
  };
  const auto sizes = cycles::peck_sizes(*n, std::fabs(n->reference - n->bottom));
  constexpr std::size_t most_strokes = 100;
  if (sizes.size() > most_strokes) return std::nullopt;
  HoleCycle one = c;
  one.pecks = Pecks{};
  one.surface = Level{};
  one.reference = one.retract = level(n->reference);
  one.approach_by_retract = false;
  LineInfo like;
  like.span = s.line.span;
  like.skip_mask = s.line.skip_mask;
  Explosion out;
  TapNeeds needs;
  needs.scale = feed_scale_;
  double z = n->reference;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    z -= n->up * sizes[i];
    one.bottom = level(i + 1 < sizes.size() ? z : n->bottom);
    auto cycle = std::make_shared<Cycle>();
    cycle->node = one;
    const auto form = native_form(cycle, b, facts, context_, n->reference / unit, sense_.now(), &needs);
    if (!form) return std::nullopt;
    if (i == 0 && needs.feed) out.blocks.push_back(make_block(like, action(SetFeed{*needs.feed, false})));
    out.blocks.push_back(single_run(like, *form));
  }
  *differs = needs.differs;
  if (n->lift > 0)
    *differs += (differs->empty() ? "" : ", ") + std::string("each peck comes back to the reference plane, not by ") +
                shortest(n->lift / unit);
  const double retract = cycles::retract_level(*n, plane);
  if (std::fabs(retract - n->reference) > 1e-9) {
    Block up = straight_move(MotionKind::rapid, *w, level(retract).value);
    out.blocks.push_back(made(like, std::move(up)));
  }
  if (needs.feed && facts.feed && !feeds_.at(s, b, facts).none)
    out.blocks.push_back(make_block(like, action(SetFeed{Value{*facts.feed}, false})));
  out.end_height = retract;
  return out;
}

}  // namespace cnctrans::ir::passes
