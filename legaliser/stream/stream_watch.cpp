#include "legaliser/stream/stream_watch.h"
#include "machine/tool_data.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "legaliser/edit/blocks.h"
#include "legaliser/technology/mixed_feeds.h"

namespace cnctrans::ir {

namespace {

const ModalSet* set_of(const Action& a, Setting s) {
  const auto* m = std::get_if<ModalSet>(&a.data);
  return m != nullptr && m->setting == s ? m : nullptr;
}

template <class Data>
bool has(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(),
                     [](const Action& a) { return std::holds_alternative<Data>(a.data); });
}

/// The value in force in the block: its own word, else the state before.
template <class Enum>
Enum in_block(const Block& b, Setting s, Enum before) {
  for (const auto& a : b.actions) {
    const auto* m = a.order == Order::after ? nullptr : set_of(a, s);
    if (m != nullptr) before = static_cast<Enum>(m->value);
  }
  return before;
}

bool is_centre_arc(MotionKind k) {
  return k == MotionKind::arc_cw || k == MotionKind::arc_ccw;
}

}  // namespace

StreamWatch::StreamWatch(const Capabilities& target, const machine::Profile& source,
                         const machine::Profile& target_machine)
    : target_(target),
      source_(source),
      target_machine_(target_machine),
      state_(source.power_on),
      places_(std::max(0, std::min(target.word_decimals, target.word_decimals_inch))),
      at_once_(machine::changes_on_select(target_machine)),
      keeps_differ_(source.option("frame.change_keeps") != target_machine.option("frame.change_keeps")),
      stop_differs_(source.option("stop.spindle") != target_machine.option("stop.spindle")),
      rapid_differs_(source.option("comp.rapid") != target_machine.option("comp.rapid")),
      needs_gear_(target.gear_needed && source.dialect != target.dialect),
      tables_differ_(passes::offset_tables_differ(source, target_machine)),
      bare_differs_(source.dialect != target.dialect && passes::bare_offsets_differ(source, target_machine)),
      pitch_each_block_(target_machine.option("thread.pitch") == "each_block"),
      mixed_feeds_differ_(passes::mixed_feeds_differ(source, target_machine)),
      lengths_differ_(source.dialect != target.dialect && passes::length_axes_differ(source, target_machine)),
      needs_places_(source.kind == machine::Kind::mill && source.dialect != target.dialect &&
                    target.centers.count(CenterMode::from_start) == 0) {
  for (std::size_t i = 0; i < setting_count; ++i) facts_.settings[i] = state_.get(static_cast<Setting>(i));
  facts_.motion = state_.motion;
  facts_.work_offset = state_.work_offset;
  facts_.reachable = true;
  bare_tool_ = passes::BareTool(source);
  const bool source_on = source.power_on.length_comp == OnOff::on;
  const bool target_on = target_machine.power_on.length_comp == OnOff::on;
  adds_length_ = target.length_comp_switch && source_on && !target_on;
  never_on_ = !source_on && (!target.length_comp_switch || target_on);
}

bool StreamWatch::too_long(const Value& v) const {
  if (v.text.empty()) return v.number != std::trunc(v.number);
  const std::size_t point = v.text.find('.');
  return point != std::string_view::npos && v.text.size() - point - 1 > static_cast<std::size_t>(places_);
}

bool StreamWatch::possible() const {
  if (source_.kind != machine::Kind::lathe) return true;
  return target_.diameter_switch || target_.fixed_diameter == source_.power_on.diameter;
}

// --- the head -------------------------------------------------------------------------------------------------------

bool StreamWatch::take_head(const Statement& s) {
  const auto& block = std::get<Block>(s.node);
  for (const auto& a : block.actions) {
    const auto* units = set_of(a, Setting::units);
    if (units != nullptr && units->value != static_cast<std::uint8_t>(source_.power_on.units)) return false;
    if (set_of(a, Setting::diameter) != nullptr) return false;
    const auto* feed = set_of(a, Setting::feed_mode);
    if (feed != nullptr && feed->value == static_cast<std::uint8_t>(FeedMode::inverse_time)) return false;
    const bool once = feed != nullptr || set_of(a, Setting::path_mode) != nullptr;
    if (units == nullptr && !once && action_needs_whole(block, a)) return false;
  }
  if (block.has_motion && motion_needs_whole(block)) return false;
  if (cuts_without_feed(block)) return false;
  follow_head(block);
  follow(s);
  return true;
}

/// A cut that the pass over feeds has to look at.
bool StreamWatch::cuts_without_feed(const Block& block) const {
  if (!block.has_motion || !block.motion.moves() || has<SetFeed>(block)) return false;
  const MotionKind kind = block.motion.kind == MotionKind::modal ? state_.motion : block.motion.kind;
  if (kind == MotionKind::rapid) return false;
  return waits_for_feed_ || (!fed_ && source_.power_on_feed <= 0);
}

/// safe_start looks for the first motion function and the first feed, the pass over feeds for a feed after the last
/// change of its mode.
void StreamWatch::follow_head(const Block& block) {
  for (const auto& a : block.actions) {
    if (set_of(a, Setting::feed_mode) != nullptr) waits_for_feed_ = true;
  }
  if (has<SetFeed>(block)) {
    fed_ = true;
    waits_for_feed_ = false;
  }
  if (!block.has_motion) return;
  const Motion& m = block.motion;
  said_motion_ = said_motion_ || m.kind != MotionKind::modal || (m.moves() && m.centers.empty());
  moved_ = moved_ || m.moves();
  const MotionKind kind = m.kind == MotionKind::modal ? state_.motion : m.kind;
  const bool at_feed = m.moves() && kind != MotionKind::rapid;
  head_done_ = said_motion_ && moved_ && (at_feed || (fed_ && !waits_for_feed_));
}

// --- blocks ---------------------------------------------------------------------------------------------------------

bool StreamWatch::action_needs_whole(const Block& block, const Action& a) const {
  if (std::holds_alternative<MachineFunction>(a.data) || std::holds_alternative<FrameOp>(a.data)) return true;
  const auto* plane = set_of(a, Setting::plane);
  if (lengths_differ_ && plane != nullptr && plane->value != static_cast<std::uint8_t>(source_.power_on.plane))
    return true;
  if (state_.comp != CompSide::off && in_block(block, Setting::comp, state_.comp) != CompSide::off &&
      (std::holds_alternative<ToolSelect>(a.data) || std::holds_alternative<ToolChange>(a.data) ||
       std::holds_alternative<ToolOffset>(a.data) || std::holds_alternative<WorkOffset>(a.data) ||
       std::holds_alternative<Stop>(a.data) ||
       (plane != nullptr && plane->value != static_cast<std::uint8_t>(state_.plane))))
    return true;
  if (const auto* m = std::get_if<ModalSet>(&a.data)) {
    const Setting s = m->setting;
    return s == Setting::feed_mode || s == Setting::units || s == Setting::path_mode || s == Setting::diameter ||
           (s == Setting::length_comp && adds_length_);
  }
  if (const auto* g = std::get_if<SpindleGear>(&a.data); g != nullptr && g->automatic) return needs_gear_;
  if (const auto* t = std::get_if<ToolSelect>(&a.data); t != nullptr && !t->name.empty()) return true;  // gets a number
  if (const auto* t = std::get_if<ToolSelect>(&a.data)) return at_once_ && !t->changes && !has<ToolChange>(block);
  if (std::holds_alternative<ToolChange>(a.data)) {
    return (at_once_ || machine::changes_on_select(source_)) && !has<ToolSelect>(block);
  }
  return false;
}

bool StreamWatch::motion_needs_whole(const Block& block) const {
  const Motion& m = block.motion;
  if (m.coords.empty() && !m.centers.empty()) return true;
  if (source_.dialect != target_.dialect) {  // the sign of such a position follows from the one before
    for (const auto& c : m.coords) {
      if (!is_rotary_letter(c.axis)) continue;
      const std::string letters = target_machine_.option(std::string(target_.dialect) + ".rotary_modulo");
      if (letters.find(fixed_axis_name(c.axis)) != std::string::npos) return true;
    }
  }
  const auto distance = in_block(block, Setting::distance, state_.distance);
  if (source_.dialect != target_.dialect) {  // the rounding of increments is balanced over a row of blocks
    for (const auto& c : m.coords) {
      const bool absolute = c.mode == WordMode::modal ? distance == Distance::absolute : c.mode == WordMode::absolute;
      if (!absolute && too_long(c.value)) return true;
    }
  }
  if (keeps_differ_ && (offset_changed_ || has<WorkOffset>(block))) {
    for (const auto& c : m.coords) {
      const bool absolute = c.mode == WordMode::modal ? distance == Distance::absolute : c.mode == WordMode::absolute;
      if (!absolute) return true;
    }
  }
  const MotionKind kind = m.kind == MotionKind::modal ? state_.motion : m.kind;
  if (pitch_each_block_ && (kind == MotionKind::thread || kind == MotionKind::thread_variable) && !m.coords.empty())
    return true;
  if (mixed_feeds_differ_ && kind != MotionKind::rapid && passes::moves_and_turns(block, source_)) return true;
  if (!is_centre_arc(kind)) return false;
  const auto rounded = [this](const auto& word) { return too_long(word.value); };
  if (long_word_ || std::any_of(m.coords.begin(), m.coords.end(), rounded) ||
      std::any_of(m.centers.begin(), m.centers.end(), rounded) || (m.radius_given && too_long(m.radius)))
    return true;
  const PlaneAxes plane = plane_axes(in_block(block, Setting::plane, state_.plane));
  const auto written = [&m](AxisId axis) {
    return std::any_of(m.coords.begin(), m.coords.end(), [axis](const CoordWord& c) { return c.axis == axis; });
  };
  const bool both_ends = !target_.full_circle_needs_end || (written(plane.u) && written(plane.v));
  if (m.centers.empty()) return !m.radius_given || !both_ends;
  const auto outside = [&plane](const CenterWord& c) { return c.axis != plane.u && c.axis != plane.v; };
  if (std::any_of(m.centers.begin(), m.centers.end(), outside)) return true;
  if (is_arc_from_start(block)) return !knows_start(block);
  const CenterMode mode = m.centers.front().mode;
  const bool relative =
      mode == CenterMode::from_start || (mode == CenterMode::follows_distance && distance == Distance::incremental);
  if (!relative && m.centers.size() < 2) return true;
  return !both_ends;
}

bool StreamWatch::needs_whole(const Block& block) const {
  if (block.has_motion && motion_needs_whole(block)) return true;
  const bool compensates = comp_begins_ || std::any_of(block.actions.begin(), block.actions.end(), [](const Action& a) {
                             return set_of(a, Setting::comp) != nullptr;
                           });
  if (compensates && block.has_motion &&
      is_centre_arc(block.motion.kind == MotionKind::modal ? state_.motion : block.motion.kind))
    return true;
  return std::any_of(block.actions.begin(), block.actions.end(), [&](const Action& a) {
    const bool tool = std::holds_alternative<ToolSelect>(a.data) || std::holds_alternative<ToolOffset>(a.data);
    return (tool && never_on_ && !length_switched_) || action_needs_whole(block, a);
  });
}

/// The first start of the spindle without a gear range.
bool StreamWatch::gear_is_new(const Block& block) const {
  if (!needs_gear_ || gear_said_ || has<SpindleGear>(block)) return false;
  return std::any_of(block.actions.begin(), block.actions.end(), [](const Action& a) {
    const auto* run = std::get_if<SpindleRun>(&a.data);
    return run != nullptr && run->state != SpindleState::off;
  });
}

/// A D number of another table, the first one.
bool StreamWatch::offset_is_new(const Block& block) const {
  if (!tables_differ_ || offset_said_) return false;
  passes::OffsetNumbers numbers = offset_numbers_;
  for (const auto& a : block.actions) {
    if (const auto* t = std::get_if<ToolSelect>(&a.data)) numbers.follow(*t);
  }
  return std::any_of(block.actions.begin(), block.actions.end(), [&numbers](const Action& a) {
    const auto* o = std::get_if<ToolOffset>(&a.data);
    return o != nullptr && numbers.differs(*o);
  });
}

/// The block is the one that convert_tools switches length compensation on in.
bool StreamWatch::takes_length(const Block& block) const {
  const bool wanted = length_wanted_ || has<ToolChange>(block) || has<ToolSelect>(block);
  if (!wanted || !block.has_motion || block.motion.frame != FrameUse::normal) return false;
  const AxisId w = plane_axes(in_block(block, Setting::plane, state_.plane)).w;
  const auto& coords = block.motion.coords;
  return std::any_of(coords.begin(), coords.end(), [w](const CoordWord& c) { return c.axis == w; });
}

bool StreamWatch::is_arc_from_start(const Block& block) const {
  if (!needs_places_ || !block.has_motion || block.motion.centers.empty()) return false;
  const Motion& m = block.motion;
  return is_centre_arc(m.kind == MotionKind::modal ? state_.motion : m.kind) && state_.distance == Distance::absolute &&
         std::all_of(m.centers.begin(), m.centers.end(),
                     [](const CenterWord& c) { return c.mode == CenterMode::from_start; });
}

bool StreamWatch::knows_start(const Block& block) const {
  const PlaneAxes plane = plane_axes(in_block(block, Setting::plane, state_.plane));
  return is_arc_from_start(block) && !places_stale_ && facts_.position[plane.u] && facts_.position[plane.v];
}

std::optional<Statement> StreamWatch::start_of(const Block& block) const {
  if (!knows_start(block)) return std::nullopt;
  const PlaneAxes plane = plane_axes(in_block(block, Setting::plane, state_.plane));
  Block start;
  start.has_motion = true;
  start.motion.kind = MotionKind::linear;
  start.motion.keeps_modal = false;
  for (const AxisId axis : {plane.u, plane.v}) {
    CoordWord word;
    word.axis = axis;
    word.value = Value(*facts_.position[axis]);
    start.motion.coords.push_back(word);
  }
  Statement s;
  s.node = std::move(start);
  return s;
}

bool StreamWatch::rapid_under_compensation(const Block& block) const {
  if (state_.comp == CompSide::off || !block.has_motion || block.motion.coords.empty()) return false;
  return (block.motion.kind == MotionKind::modal ? state_.motion : block.motion.kind) == MotionKind::rapid;
}

StreamWatch::Verdict StreamWatch::look(const Block& block) const {
  if (needs_whole(block)) return Verdict::whole;
  if (gear_is_new(block) || offset_is_new(block)) return Verdict::local;
  if (adds_length_ && takes_length(block)) return Verdict::local;
  if (rapid_differs_ && rapid_under_compensation(block)) return Verdict::local;
  if (stop_differs_ && has<Stop>(block)) return Verdict::local;
  return plain_legal(block, target_, &target_machine_) ? Verdict::plain : Verdict::local;
}

std::vector<std::string_view> StreamWatch::passes_for(const Block& block) const {
  const bool gear = gear_is_new(block), offset = offset_is_new(block);
  std::vector<std::string_view> names = head_passes();
  std::erase_if(names, [&](std::string_view name) {
    return name == length_pass || name == tool_pass || (name == gear_pass && !gear) || (name == offset_pass && !offset);
  });
  return names;
}

bool StreamWatch::follow(const Statement& s) {
  const auto& block = std::get<Block>(s.node);
  if (needs_places_) {
    if (std::exchange(places_stale_, false)) facts_.position.fill(std::nullopt);
    apply(s, facts_);
  }
  if (adds_length_) {
    if (takes_length(block)) {
      length_wanted_ = false;
    } else if (has<ToolChange>(block) || has<ToolSelect>(block)) {
      length_wanted_ = true;
    }
  }
  offset_said_ = offset_said_ || offset_is_new(block);
  const bool bare = bare_differs_ && bare_tool_.follow(block, s.line.span);
  for (const auto& a : block.actions) {
    const auto* run = std::get_if<SpindleRun>(&a.data);
    gear_said_ = gear_said_ || std::holds_alternative<SpindleGear>(a.data) ||
                 (run != nullptr && run->state != SpindleState::off);
    if (const auto* t = std::get_if<ToolSelect>(&a.data)) offset_numbers_.follow(*t);
    if (const auto* set = std::get_if<ModalSet>(&a.data)) {
      state_.set(set->setting, set->value);
      length_switched_ = length_switched_ || set->setting == Setting::length_comp;
      comp_begins_ = comp_begins_ || set->setting == Setting::comp;
    } else if (std::holds_alternative<WorkOffset>(a.data)) {
      offset_changed_ = true;
    }
  }
  if (!block.has_motion) return bare;
  const Motion& m = block.motion;
  if (m.moves()) comp_begins_ = false;
  if (m.kind != MotionKind::modal && m.keeps_modal) state_.motion = m.kind;
  for (const auto& c : m.coords) long_word_ = long_word_ || too_long(c.value);
  return bare;
}

std::uint64_t StreamWatch::key() const {
  std::uint64_t key = static_cast<std::uint64_t>(state_.motion);
  for (std::size_t s = 0; s < setting_count; ++s) key = key << 2U | state_.get(static_cast<Setting>(s));
  for (const bool flag : {long_word_, offset_changed_, length_wanted_, length_switched_, gear_said_, offset_said_,
                          comp_begins_, offset_numbers_.differs(ToolOffset{Value{1.0}})})
    key = key << 1U | (flag ? 1U : 0U);
  return key << 3U | bare_tool_.key();
}

machine::Profile StreamWatch::source_for(const Block& block) const {
  machine::Profile now = source_;
  now.power_on = state_;
  // For the passes this is the machine's habit, not a mode reached: on means that nothing has to be switched off.
  now.power_on.length_comp = source_.power_on.length_comp;
  if (adds_length_ && !takes_length(block)) now.power_on.length_comp = OnOff::off;
  if (never_on_ && length_switched_) now.power_on.length_comp = OnOff::on;
  return now;
}

}  // namespace cnctrans::ir
