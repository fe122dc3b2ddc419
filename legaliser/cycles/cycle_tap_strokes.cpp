// Modal calls, points without the cycle, and taps as several blocks, in the cycle pass.
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

namespace {

/// A tap in numbers where it stands, and the unit of its lengths in mm.
struct TapHere {
  cycles::HoleNumbers numbers;
  double unit = 1, retract = 0;

  [[nodiscard]] Value length(double mm) const { return Value(std::round(mm / unit * 1e9) / 1e9); }
};

/// `height` in mm, of the tool at the definition. nullopt: not known in full.
std::optional<TapHere> tap_here(const HoleCycle& c, const Block& b, const Facts& facts, std::optional<double> height) {
  const auto units = setting_in<Units>(b, facts, Setting::units);
  const auto distance = setting_in<Distance>(b, facts, Setting::distance);
  if ((c.kind != HoleKind::tap && c.kind != HoleKind::tap_floating) || !units || distance != Distance::absolute)
    return std::nullopt;
  TapHere t;
  t.unit = *units == Units::inch ? 25.4 : 1;
  cycles::HoleContext context;
  context.length_unit = context.level_unit = context.feed_unit = t.unit;
  context.height = height.value_or(std::nan(""));
  const auto literal = [](const Value& v) { return v.literal() ? std::optional(v.number) : constant_value(v.expr); };
  std::string error;
  const auto n = cycles::resolve(c, context, literal, &error);
  const auto plane = setting_in<RetractPlane>(b, facts, Setting::retract_plane).value_or(RetractPlane::initial);
  if (!n || std::isnan(cycles::retract_level(*n, plane))) return std::nullopt;
  t.numbers = *n;
  t.retract = cycles::retract_level(*n, plane);
  return t;
}

/// The pitch is what feed and speed give, and the spindle turns on as it did before.
bool by_feed_and_sense(const HoleCycle& c) {
  return c.pitch.is(0) && c.spindle_before == SpindleStep::usual && c.spindle_bottom == SpindleStep::usual &&
         c.spindle_after == SpindleStep::usual && !c.orient_first && !c.has_speed && !c.has_speed_out && !c.has_feed &&
         !c.has_feed_out && !c.dwell_in_revolutions && c.dwell_top.is(0);
}

}  // namespace

std::optional<Explosion> CyclePass::axial_tap(const HoleCycle& c, const Statement& s, const Block& b,
                                              std::optional<SpindleState> sense) {
  if (c.pecks.law != PeckLaw::none || (sense != SpindleState::cw && sense != SpindleState::ccw)) return std::nullopt;
  const Facts facts = facts_for_tap(s, b);
  const auto t = tap_here(c, b, facts, active_->defined_at ? active_->defined_at : active_->height);
  const bool moves_x = moves_along(b, axis::x);
  const auto x = moves_x ? height_after(b, facts, axis::x) : height_mm(b, facts, axis::x);
  const bool plain = setting_in<CompSide>(b, facts, Setting::comp) == CompSide::off;
  if (!t || !plain || cycle_axis(c, b, facts) != axis::z || x != 0.0) return std::nullopt;
  std::vector<TapForm> forms = tap_forms(c, b, facts, sense, feed_scale_);
  forms.insert(forms.begin(), TapForm{c, {}});
  const auto form =
      std::find_if(forms.begin(), forms.end(), [](const TapForm& f) { return by_feed_and_sense(f.cycle); });
  if (form == forms.end()) return std::nullopt;
  const cycles::HoleNumbers& n = t->numbers;
  const bool follows = c.kind == HoleKind::tap;
  NamedCycle tap;
  tap.name = "turn.drill";
  tap.words = {{"x", Value(0.0)},
               {"z", t->length(n.reference)},
               {"depth", t->length(n.reference - n.bottom)},
               {"peck", Value(0.0)}};
  if (n.dwell_bottom > 0) tap.words.emplace_back("dwell", Value(std::round(n.dwell_bottom * 1e11) / 1e9));
  if (follows) tap.words.emplace_back("factor", Value(2.0));
  const auto cycle = std::make_shared<const Cycle>(Cycle{std::move(tap)});
  if (!context_.target.native_cycle(*cycle)) return std::nullopt;
  LineInfo like;
  like.span = s.line.span;
  like.skip_mask = s.line.skip_mask;
  Explosion out;
  const auto& feed = form->needs.feed;
  if (feed) out.blocks.push_back(make_block(like, action(SetFeed{*feed, false})));
  out.blocks.push_back(single_run(like, cycle));
  if (follows) out.blocks.push_back(make_block(like, action(SpindleRun{facts.master.value_or(1), *sense})));
  if (std::fabs(t->retract - n.reference) > 1e-9)
    out.blocks.push_back(made(like, straight_move(MotionKind::rapid, axis::z, t->length(t->retract))));
  if (feed && facts.feed && !feeds_.at(s, b, facts).none)
    out.blocks.push_back(make_block(like, action(SetFeed{Value{*facts.feed}, false})));
  out.end_height = t->retract;
  return out;
}

std::optional<Explosion> CyclePass::tap_strokes(const HoleCycle& c, const Statement& s, const Block& b,
                                                std::string* differs) {
  const Facts facts = facts_for_tap(s, b);
  const auto w = cycle_axis(c, b, facts);
  const auto t = tap_here(c, b, facts, active_->defined_at ? active_->defined_at : active_->height);
  if (!t || !w) return std::nullopt;
  const cycles::HoleNumbers& n = t->numbers;
  const double unit = t->unit;
  const auto level = [&t](double mm) {
    Level l;
    l.value = t->length(mm);
    l.given = true;
    return l;
  };
  double z = n.from_surface ? n.surface : n.reference;
  const double depth = std::fabs(z - n.bottom);
  const auto sizes = c.pecks.law == PeckLaw::none ? std::vector{depth} : cycles::peck_sizes(n, depth);
  constexpr std::size_t most_strokes = 100;
  if (sizes.size() > most_strokes) return std::nullopt;
  HoleCycle one = c;
  one.pecks = Pecks{};
  one.surface = Level{};
  one.reference = one.retract = level(n.reference);
  one.approach_by_retract = false;
  LineInfo like;
  like.span = s.line.span;
  like.skip_mask = s.line.skip_mask;
  Explosion out;
  TapNeeds needs;
  needs.scale = feed_scale_;
  const bool over_it = active_->height == t->retract && !moves_along(b, *w);
  if (c.approach_by_retract && !over_it)
    out.blocks.push_back(made(like, straight_move(MotionKind::rapid, *w, t->length(t->retract))));
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    z -= n.up * sizes[i];
    one.bottom = level(i + 1 < sizes.size() ? z : n.bottom);
    auto cycle = std::make_shared<Cycle>();
    cycle->node = one;
    const auto form = native_form(cycle, b, facts, context_, n.reference / unit, sense_.now(), &needs);
    if (!form) return std::nullopt;
    if (i == 0 && needs.feed) out.blocks.push_back(make_block(like, action(SetFeed{*needs.feed, false})));
    out.blocks.push_back(single_run(like, *form));
  }
  *differs = needs.differs;
  if (n.lift > 0)
    *differs += (differs->empty() ? "" : ", ") + std::string("each peck comes back to the reference plane, not by ") +
                shortest(n.lift / unit);
  if (std::fabs(t->retract - n.reference) > 1e-9)
    out.blocks.push_back(made(like, straight_move(MotionKind::rapid, *w, t->length(t->retract))));
  if (needs.feed && facts.feed && !feeds_.at(s, b, facts).none)
    out.blocks.push_back(make_block(like, action(SetFeed{Value{*facts.feed}, false})));
  out.end_height = t->retract;
  return out;
}

}  // namespace cnctrans::ir::passes
