#include "legaliser/cycles/turning/machining_moves.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/saturate.h"
#include "base/text.h"
#include "ir/cycles/profile_blocks.h"
#include "ir/edit/search.h"
#include "ir/known_number.h"
#include "ir/tool_number.h"
#include "legaliser/data/written_data.h"
#include "legaliser/edit/blocks.h"
#include "machine/cycle_context.h"

namespace cnctrans::ir::passes {

namespace {

using cycles::TurnMove;
using cycles::TurnNumbers;
using cycles::TurnStep;

const NamedCycle* machining_of(const Block& b) {
  for (const auto& a : b.actions) {
    const auto* d = std::get_if<CycleDefine>(&a.data);
    const auto* named = d != nullptr && d->cycle ? std::get_if<NamedCycle>(&d->cycle->node) : nullptr;
    if (named != nullptr && cycles::find_machining(named->name) != nullptr) return named;
  }
  return nullptr;
}

/// The drilling cycle without pecks, as a tap that follows the spindle.
bool taps_rigidly(const cycles::MachiningCycle& cycle, const TurnNumbers& numbers) {
  const auto zero = [&](std::string_view name) { return numbers.count(name) == 0 || numbers.at(name) == 0; };
  return cycle.kind == cycles::MachiningKind::drill && zero("peck") && !zero("factor");
}

std::optional<std::int32_t> known_count(const Value& v) {
  const auto n = known_number(v);
  return n ? std::optional(saturate<std::int32_t>(std::round(*n))) : std::nullopt;
}

/// Moves as blocks.
class TurnWriter {
 public:
  TurnWriter(const LineInfo& like, const ModalState& modes, const FeedBefore& feed, const TurnState& state)
      : modes_(modes),
        unit_(modes.units == Units::inch ? 25.4 : 1),
        feed_(feed.value),
        minute_feed_(feed.per_minute),
        no_feed_(feed.none),
        state_(state) {
    line_.span = like.span;
    line_.skip_mask = like.skip_mask;
  }
  Body blocks;
  cycles::TurnPoint at;

  bool add(const TurnMove& m, std::string* error) {
    switch (m.step) {
      case TurnStep::dwell: return put(Dwell{Value{m.seconds}, 1, false});
      case TurnStep::spindle_stop: return put(SpindleRun{1, SpindleState::off});
      case TurnStep::spindle_reverse:
      case TurnStep::spindle_restore: {
        if (!state_.spindle || *state_.spindle == SpindleState::off)
          return *error = "whether the spindle runs, and in which sense, can't be seen in the text", false;
        const bool cw = (*state_.spindle == SpindleState::cw) == (m.step == TurnStep::spindle_restore);
        return put(SpindleRun{1, cw ? SpindleState::cw : SpindleState::ccw});
      }
      case TurnStep::spindle_orient: return put(SpindleOrient{1, Value{m.start_angle}});
      case TurnStep::live_run: {
        Block b;
        b.actions.push_back(action(SetSpindle{live, Value{std::abs(m.speed)}}));
        b.actions.push_back(action(SpindleRun{live, m.speed < 0 ? SpindleState::ccw : SpindleState::cw}));
        return blocks.push_back(made(line_, std::move(b))), true;
      }
      case TurnStep::spindle_speed:
      case TurnStep::spindle_cutting_speed: return turn_at(m);
      case TurnStep::live_stop: return put(SpindleRun{live, SpindleState::off});
      case TurnStep::comp_left: return comp(CompSide::left);
      case TurnStep::comp_right: return comp(CompSide::right);
      case TurnStep::comp_off: return comp(CompSide::off);
      default: return move(m, error);
    }
  }
  /// Rapid is in force afterwards; else the feed is as before.
  bool finish(bool ends_modes, std::string* error) {
    if (minutes_) {
      if (!no_feed_ && !feed_) return *error = "the feed after the cycle's own one is not known here", false;
      mode(modes_.feed_mode, feed_);
      changed_ = false;
    }
    if (!ends_modes && changed_ && !no_feed_) {
      if (!feed_) return *error = "the feed after the cycle's own one is not known here", false;
      put(SetFeed{Value{*feed_}, false});
    }
    if (!ends_modes) return true;
    for (auto it = blocks.rbegin(); it != blocks.rend(); ++it) {
      auto* b = std::get_if<Block>(&it->node);
      if (b == nullptr || !b->has_motion) continue;
      if (b->motion.kind == MotionKind::rapid) {
        b->motion.keeps_modal = true;
        return true;
      }
      break;
    }
    Block b;
    b.has_motion = true;
    b.motion.kind = MotionKind::rapid;
    b.motion.explicit_code = true;
    blocks.push_back(made(line_, std::move(b)));
    return true;
  }

 private:
  static constexpr std::uint8_t live = 3;

  template <class Data>
  bool put(Data data) {
    blocks.push_back(make_block(line_, action(std::move(data))));
    return true;
  }
  bool turn_at(const TurnMove& m) {
    ModalSet set;
    set.setting = Setting::spindle_mode;
    const bool cut = m.step == TurnStep::spindle_cutting_speed;
    set.value = static_cast<std::uint8_t>(cut ? SpindleMode::css : SpindleMode::rpm);
    Block b;
    if (m.limit > 0) b.actions.push_back(action(SpindleLimit{1, Value{m.limit}, false}));
    b.actions.push_back(action(set));
    b.actions.push_back(action(SetSpindle{1, Value{m.speed}}));
    if (m.sense != 0) b.actions.push_back(action(SpindleRun{1, m.sense > 0 ? SpindleState::cw : SpindleState::ccw}));
    return blocks.push_back(made(line_, std::move(b))), true;
  }
  bool comp(CompSide side) {
    pending_comp_ = side;
    return true;
  }
  void coordinate(Motion& m, AxisId axis, double value) const {
    CoordWord c;
    c.axis = axis;
    c.mode = WordMode::absolute;
    c.scale = axis == axis::x ? WordScale::radius : WordScale::modal;
    c.value = Value{value / unit_};
    m.coords.push_back(c);
  }
  void centre(Motion& m, AxisId axis, double value) const {
    CenterWord c;
    c.axis = axis;
    c.mode = CenterMode::from_start;
    c.scale = WordScale::radius;
    c.value = Value{value / unit_};
    m.centers.push_back(c);
  }
  void mode(FeedMode mode, std::optional<double> feed) {
    ModalSet set;
    set.setting = Setting::feed_mode;
    set.value = static_cast<std::uint8_t>(mode);
    set.feed_memory = FeedMemory::per_mode;
    Block b;
    b.actions.push_back(action(set));
    if (feed) b.actions.push_back(action(SetFeed{Value{*feed}, false}));
    blocks.push_back(made(line_, std::move(b)));
  }
  /// The cycles of a driven tool feed in millimetres per minute whatever mode is in force, at the F of that mode or at
  /// their own one.
  bool in_minutes(const TurnMove& m, std::string* error) {
    if (!m.per_minute || minutes_ || modes_.feed_mode == FeedMode::per_minute) return true;
    if (!m.has_feed && !minute_feed_)
      return *error = "the feed in millimetres per minute is not the one in force here", false;
    mode(FeedMode::per_minute, std::nullopt);
    minutes_ = true;
    return true;
  }
  /// In a mode that was put in force for the cycle every change of F is written.
  bool feed_in_minutes(const TurnMove& m, Block& b, std::string* error) {
    const auto wanted = m.has_feed ? std::optional(m.feed / unit_) : minute_feed_;
    if (!m.per_minute || !wanted)
      return *error = "the feed in millimetres per minute is not the one in force here", false;
    if (changed_ && last_feed_ == *wanted) return true;
    b.actions.push_back(action(SetFeed{Value{*wanted}, false}));
    changed_ = true;
    last_feed_ = *wanted;
    return true;
  }
  bool feed(const TurnMove& m, Block& b, std::string* error) {
    if (minutes_) return feed_in_minutes(m, b, error);
    if (m.has_feed) {
      if (changed_ ? last_feed_ == m.feed : feed_ && *feed_ == m.feed / unit_) return true;
      b.actions.push_back(action(SetFeed{Value{m.feed / unit_}, false}));
      changed_ = true;
      last_feed_ = m.feed;
    } else if (changed_) {
      if (!feed_) return *error = "the feed after the cycle's own one is not known here", false;
      b.actions.push_back(action(SetFeed{Value{*feed_}, false}));
      changed_ = false;
    }
    return true;
  }
  bool thread(const TurnMove& m, Motion& motion, std::string* error) {
    double pitch = m.pitch;
    const bool minutes = minutes_ || modes_.feed_mode == FeedMode::per_minute;
    const auto feed = minutes_ ? minute_feed_ : feed_;
    if (pitch == 0 && feed && modes_.feed_mode == FeedMode::per_rev && !minutes) pitch = *feed * unit_;
    if (pitch == 0 && feed && minutes && m.speed != 0) pitch = *feed * unit_ / std::abs(m.speed);
    if (pitch == 0) return *error = "the pitch follows from a feed and a speed that are not known here", false;
    auto extra = std::make_shared<MotionExtra>();
    extra->has_lead = true;
    extra->lead = Value{pitch / unit_};
    const bool along = std::abs(m.to.z - at.z) >= std::abs(m.to.x - at.x);
    extra->lead_axis = along ? axis::z : axis::x;
    if (m.start_angle != 0) {
      extra->has_start_angle = true;
      extra->start_angle = Value{m.start_angle};
    }
    motion.kind = MotionKind::thread;
    if (m.pitch_change != 0) {
      motion.kind = MotionKind::thread_variable;
      extra->lead_change = Value{m.pitch_change / unit_};
    }
    motion.extra = std::move(extra);
    return true;
  }
  bool move(const TurnMove& m, std::string* error) {
    Block b;
    if (pending_comp_) {
      ModalSet set;
      set.setting = Setting::comp;
      set.value = static_cast<std::uint8_t>(*pending_comp_);
      b.actions.push_back(action(set));
      pending_comp_.reset();
    }
    if (!in_minutes(m, error)) return false;
    b.has_motion = true;
    Motion& motion = b.motion;
    motion.explicit_code = true;
    motion.keeps_modal = false;
    motion.kind = MotionKind::rapid;
    if (m.step == TurnStep::thread) {
      if (!thread(m, motion, error)) return false;
    } else if (m.step != TurnStep::rapid) {
      motion.kind = m.step == TurnStep::feed ? MotionKind::linear : m.ccw ? MotionKind::arc_ccw : MotionKind::arc_cw;
      if (!feed(m, b, error)) return false;
      if (m.sharp && !state_.exact_stop) b.actions.push_back(action(ExactStopBlock{}));
    }
    const bool whole = m.step == TurnStep::arc;
    // A place that is not known is not gone to; one from which the way is not known is written.
    const auto same = [](double to, double from) { return std::isnan(to) || std::abs(to - from) <= 1e-9; };
    if (whole || !same(m.to.x, at.x)) coordinate(motion, axis::x, m.to.x);
    if (whole || !same(m.to.z, at.z)) coordinate(motion, axis::z, m.to.z);
    if (whole) {
      centre(motion, axis::x, m.centre.x - at.x);
      centre(motion, axis::z, m.centre.z - at.z);
    }
    at = m.to;
    blocks.push_back(made(line_, std::move(b)));
    return true;
  }

  LineInfo line_;
  ModalState modes_;
  double unit_;
  std::optional<double> feed_;
  std::optional<double> minute_feed_;  ///< that the control has kept behind another feed mode
  bool no_feed_ = false;
  bool minutes_ = false;  ///< millimetres per minute were put in force for the moves of the cycle
  TurnState state_;
  std::optional<CompSide> pending_comp_;
  bool changed_ = false;
  double last_feed_ = 0;
};

/// The only sense in which the program ever turns its spindle; nullopt: both, or none.
std::optional<SpindleState> only_sense(const Program& program) {
  const auto turns = [&program](SpindleState sense) {
    return any_action(program, [sense](const Action& a) {
      const auto* run = std::get_if<SpindleRun>(&a.data);
      return run != nullptr && run->number == 1 && run->state == sense;
    });
  };
  const bool cw = turns(SpindleState::cw);
  if (cw == turns(SpindleState::ccw)) return std::nullopt;
  return cw ? SpindleState::cw : SpindleState::ccw;
}

/// No block of the program counts from where the tool stands.
bool always_absolute(const Program& program, const ModalState& power_on) {
  return power_on.distance == Distance::absolute && !any_action(program, [](const Action& a) {
           const auto* set = std::get_if<ModalSet>(&a.data);
           return set != nullptr && set->setting == Setting::distance &&
                  set->value != static_cast<std::uint8_t>(Distance::absolute);
         });
}

/// The cycle of the block leaves the tool where it was.
bool ends_at_call(const Block& b) {
  const auto* named = machining_of(b);
  return named != nullptr && cycles::find_machining(named->name)->ends == cycles::CycleEnd::at_call;
}

/// The words of X and Z, as far as they say where the tool stands afterwards.
void follow_place(const Block& b, bool absolute, TurnState& state) {
  for (const auto& a : b.actions) {
    const auto* set = std::get_if<ModalSet>(&a.data);
    const bool other = set != nullptr && (set->setting == Setting::units || set->setting == Setting::diameter);
    if (other || std::holds_alternative<FrameOp>(a.data) || std::holds_alternative<WorkOffset>(a.data) ||
        (std::holds_alternative<CycleDefine>(a.data) && !ends_at_call(b)) || std::holds_alternative<ToolSelect>(a.data))
      state.x.reset(), state.z.reset();
  }
  if (!b.has_motion) return;
  const bool plain = b.motion.frame == FrameUse::normal && b.motion.extra == nullptr;
  for (const auto& c : b.motion.coords) {
    auto* place = c.axis == axis::x ? &state.x : c.axis == axis::z ? &state.z : nullptr;
    if (place == nullptr) continue;
    const bool said = c.mode == WordMode::absolute || (c.mode == WordMode::modal && absolute);
    place->reset();
    if (plain && said && c.scale == WordScale::modal) *place = c.value;
    if (*place) (*place)->text = {};
  }
  if (!plain) state.x.reset(), state.z.reset();
}

void follow(const Block& b, TurnState& state) {
  for (const auto& a : b.actions) {
    if (const auto* run = std::get_if<SpindleRun>(&a.data); run != nullptr && run->number == 1)
      state.spindle = run->state;
    if (std::holds_alternative<SpindleOrient>(a.data)) state.spindle = SpindleState::off;
    if (std::holds_alternative<CycleDefine>(a.data) && machining_of(b) != nullptr &&
        machining_of(b)->name == "part.off")
      state.spindle.reset();  // it may turn the other way
    if (const auto* t = std::get_if<ToolSelect>(&a.data))
      state.tool = has_number(*t) ? known_count(t->number) : std::nullopt;
    if (const auto* d = std::get_if<ToolOffset>(&a.data)) state.offset = known_count(d->number);
  }
}

/// What both ways leave: the one through blocks that a switch passes over and the one around them.
TurnState join(TurnState a, const TurnState& b) {
  if (a.spindle != b.spindle) a.spindle.reset();
  if (a.tool != b.tool) a.tool.reset();
  if (a.offset != b.offset) a.offset.reset();
  for (const auto place : {&TurnState::x, &TurnState::z}) {
    if (a.*place && !(b.*place && equal(*(a.*place), *(b.*place)))) (a.*place).reset();
  }
  return a;
}

}  // namespace

std::optional<ModalState> modes_at(const Block& b, const Facts& facts, const ModalState& power_on) {
  ModalState m = power_on;
  const auto units = setting_in<Units>(b, facts, Setting::units);
  const auto diameter = setting_in<DiameterMode>(b, facts, Setting::diameter);
  const auto distance = setting_in<Distance>(b, facts, Setting::distance);
  const auto feed = setting_in<FeedMode>(b, facts, Setting::feed_mode);
  if (!units || !diameter || !distance || !feed) return std::nullopt;
  m.units = *units;
  m.diameter = *diameter;
  m.distance = *distance;
  m.feed_mode = *feed;
  return m;
}

bool machining_numbers(const NamedCycle& cycle, const ModalState& modes, TurnNumbers& out) {
  for (const auto& [word, v] : cycle.words) {
    const auto* p = cycles::find_parameter(word);
    if (p == nullptr) return false;
    if (p->quantity == cycles::Quantity::text || cycles::is_text(v)) continue;
    const auto n = known_number(v);
    if (!n) return false;
    out[p->name] = *n * cycles::factor_of(p->quantity, turn_units(modes));
  }
  return true;
}

TurnCycles::TurnCycles(const Program& program, const Routine& routine, const LegaliseContext& context,
                       const FeedsBefore& feeds)
    : context_(context),
      feeds_(feeds),
      program_(program),
      routine_(routine),
      constants_(program),
      written_(written_data(program, context.source_machine)) {
  const LabelUses uses = label_uses(program, routine);
  TurnState state, around;     // `around`: at the first of the blocks at hand that one switch passes over
  std::uint16_t switches = 0;  // of these blocks; 0: the block at hand is carried out always
  const auto sense = only_sense(program);
  const bool absolute = always_absolute(program, context.source_machine.power_on);
  for_each_statement(routine.body, [&](const Statement& s) {
    if (s.line.skip_mask != switches) {
      if (switches != 0) state = join(state, around);
      around = state;
      switches = s.line.skip_mask;
    }
    for (const auto& l : labels_on(s.line)) {
      if (!uses.is_target(l)) continue;
      // It runs one way only: that it runs has been seen before, and the label is reached from there or later.
      if (!(sense && state.spindle == sense)) state.spindle.reset();
      state.tool.reset(), state.offset.reset();
      state.x.reset(), state.z.reset();
    }
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) {
      for (auto* place : {&state.x, &state.z}) {
        if (std::holds_alternative<Assign>(s.node) && *place && !(*place)->literal()) place->reset();
      }
      if (!ToolHeight::keeps(s) && !std::holds_alternative<Jump>(s.node)) state = TurnState{};
      return;
    }
    follow(*b, state);
    const auto* named = machining_of(*b);
    const TurnState before = state;
    follow_place(*b, absolute, state);
    if (named == nullptr) return;
    Site& site = sites_[s.id];
    site.state = before;
    if (!cycles::has_profile(*named)) return;
    site.profile = cycles::contour_in(*named, &site.fault);
    if (!site.profile) return;
    keep_profile(program, routine, *named, site);
  });
}

std::optional<Body> TurnCycles::write_out(const NamedCycle& words, const Statement& s, const Block& b,
                                          const Facts& facts, std::string* error, std::string* values) const {
  NamedCycle named = words;
  std::map<std::string, double> used;
  const auto fold = [&](const Value& v) { return constants_.fold(v, routine_, s, &used); };
  if (values != nullptr) {
    for (auto& [word, v] : named.words) v = fold(v);
  }
  const auto* cycle = cycles::find_machining(named.name);
  const auto it = sites_.find(s.id);
  if (cycle == nullptr || it == sites_.end()) return *error = "cycles of this kind are not carried yet", std::nullopt;
  const Site& site = it->second;
  const auto m = modes_at(b, facts, context_.source_machine.power_on);
  TurnNumbers numbers;
  if (!m) return *error = "units, diameters or absolute and incremental are not known here", std::nullopt;
  if (!machining_numbers(named, *m, numbers))
    return *error = "its words are computed when the program runs", std::nullopt;
  // Cycles that end at a place of their own begin at one as well, with a rapid to it.
  const bool anywhere = cycle->ends != cycles::CycleEnd::at_call;
  const double unit = m->units == Units::inch ? 25.4 : 1;
  std::optional<double> x = facts.position[axis::x], z = facts.position[axis::z];
  if (values != nullptr && !anywhere) {
    const auto place = [&](std::optional<double>& at, const std::optional<Value>& word, double k) {
      const auto n = at || !word ? std::nullopt : known_number(fold(*word));
      if (n) at = *n / k;
    };
    place(x, site.state.x, m->diameter == DiameterMode::radius ? 1 : 2);
    place(z, site.state.z, 1);
  }
  if (!anywhere && (!x || !z)) return *error = "the place of the tool before it is not known here", std::nullopt;
  cycles::TurnContext context;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  context.start = {x.value_or(unknown) * unit, z.value_or(unknown) * unit};
  machine::tell_tool(context_.source_machine, site.state.tool, context);
  context.nose_width = nose_width(site.state, unit);
  if (cycles::has_profile(named)) {
    if (!site.profile) return *error = site.fault, std::nullopt;
    context.profile = &*site.profile;
  }
  auto moves = cycles::expand(*cycle, numbers, context, error);
  if (!moves) return std::nullopt;
  if (taps_rigidly(*cycle, numbers))
    return *error = "of a rigid tap, the axis would stand at the bottom while the spindle turns back", std::nullopt;
  for (auto& move : *moves) {
    if (move.step == TurnStep::thread && move.speed != 0)
      return *error = "a tap that follows the driven tool", std::nullopt;
    if (move.step == TurnStep::thread) move.speed = facts.spindle.value_or(0);
    if (move.step == TurnStep::arc && setting_in<Plane>(b, facts, Setting::plane) != Plane::zx)
      return *error = "its arcs need the plane of Z and X", std::nullopt;
  }
  TurnState state = site.state;
  state.exact_stop = setting_in<PathMode>(b, facts, Setting::path_mode) == PathMode::exact_stop;
  TurnWriter writer(s.line, *m, feeds_.at(s, b, facts), state);
  writer.at = context.start;
  for (const auto& move : *moves) {
    if (!writer.add(move, error)) return std::nullopt;
  }
  if (cycle->name == "part.off" && context.choices.parting_restores) {
    const auto mode = setting_in<SpindleMode>(b, facts, Setting::spindle_mode);
    const bool speeds = std::any_of(moves->begin(), moves->end(), [](const auto& move) {
      return move.step == TurnStep::spindle_speed || move.step == TurnStep::spindle_cutting_speed;
    });
    if (speeds && (!mode || !facts.spindle))
      return *error = "the speed of the spindle before it, which comes back, is not known here", std::nullopt;
    TurnMove again;
    again.step = mode == SpindleMode::css ? TurnStep::spindle_cutting_speed : TurnStep::spindle_speed;
    again.speed = facts.spindle.value_or(0);
    if (speeds && !writer.add(again, error)) return std::nullopt;
  }
  if (!writer.finish(cycle->ends_modes, error)) return std::nullopt;
  if (values != nullptr) *values = listed(used);
  return std::move(writer.blocks);
}

}  // namespace cnctrans::ir::passes
