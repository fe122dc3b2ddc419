// Machining cycles of a lathe as cycles of the target, and those whose words only the run knows.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/noise.h"
#include "base/text.h"
#include "ir/cycles/profile_blocks.h"
#include "ir/known_number.h"
#include "legaliser/cycles/turning/machining_moves.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

namespace {

using cycles::TurnMove;
using cycles::TurnNumbers;
using cycles::TurnStep;

bool same_move(const TurnMove& a, const TurnMove& b) {
  constexpr double room = 5e-4;  // mm: what a target of three places rounds away
  const auto near = [](double u, double v, double by) { return std::abs(u - v) <= by; };
  return a.step == b.step && near(a.to.x, b.to.x, room) && near(a.to.z, b.to.z, room) &&
         near(a.centre.x, b.centre.x, room) && near(a.centre.z, b.centre.z, room) && a.ccw == b.ccw &&
         near(a.pitch, b.pitch, 1e-6) && near(a.start_angle, b.start_angle, 1e-4) &&
         near(a.pitch_change, b.pitch_change, 1e-6) && near(a.seconds, b.seconds, 5e-3) && a.has_feed == b.has_feed &&
         near(a.feed, b.feed, 1e-6);
}

/// A thread by its size or in newer words, in those that have cycles of the same kind elsewhere.
NamedCycle in_older_words(const NamedCycle& named, const ModalState& modes) {
  TurnNumbers numbers;
  const bool by_size = std::any_of(named.words.begin(), named.words.end(),
                                   [](const auto& word) { return word.first == "size" && !word.second.is(0); });
  if ((named.name != "shape.thread" && !by_size) || !machining_numbers(named, modes, numbers)) return named;
  const auto older = cycles::counted_thread_of(named.name, numbers);
  if (!older) return named;
  NamedCycle out;
  out.name = "thread.counted";
  for (const auto& [name, v] : *older) {
    const double by = cycles::factor_of(cycles::find_parameter(name)->quantity, turn_units(modes));
    out.words.emplace_back(std::string(name), Value(without_noise(v / by)));
  }
  return out;
}

TurnMove rapid_to(cycles::TurnPoint place) {
  TurnMove m;
  m.to = place;
  return m;
}

}  // namespace

cycles::TurnUnits turn_units(const ModalState& m) {
  cycles::TurnUnits u;
  u.along = u.length = u.feed = m.units == Units::inch ? 25.4 : 1;
  u.cross = m.diameter == DiameterMode::radius ? u.length : u.length / 2;
  return u;
}

std::optional<TurnForm> TurnCycles::native(const NamedCycle& words, const Statement& s, const Block& b,
                                           const Facts& facts) const {
  const auto& accepts = context_.target.native_cycle;
  const auto it = sites_.find(s.id);
  if (!accepts || context_.options.cycles == CycleWriting::explode || it == sites_.end()) return std::nullopt;
  const auto m = modes_at(b, facts, context_.source_machine.power_on);
  // The words of a cycle keep their numbers: both controls have to count them the same way.
  if (!m || m->units != Units::metric || m->diameter == DiameterMode::absolute_only) return std::nullopt;
  if (m->distance != Distance::absolute) return std::nullopt;
  if (!context_.target.diameter_switch && context_.target.fixed_diameter != m->diameter) return std::nullopt;
  const NamedCycle named = in_older_words(words, *m);
  const double k = m->diameter == DiameterMode::radius ? 1 : 2;
  TurnStart start{it->second.state.x, it->second.state.z};
  if (const auto x = facts.position[axis::x]) start.x = Value(*x * k);
  if (const auto z = facts.position[axis::z]) start.z = Value(*z);
  for (auto& form : turning_forms(named, k, start, context_.target.word_decimals)) {
    const bool there =
        form.from.x && start.x && start.z && equal(*form.from.x, *start.x) && equal(*form.from.z, *start.z);
    if (there) form.from = {};
    if (!accepts(Cycle{form.cycle})) continue;
    const auto* own = cycles::find_machining(named.name);
    const auto* other = cycles::find_machining(form.cycle.name);
    const bool comp_off = own->ends_comp || setting_in<CompSide>(b, facts, Setting::comp) == CompSide::off;
    if (!comp_off && other->ends_comp) continue;
    TurnNumbers mine, theirs;
    if (machining_numbers(named, *m, mine) && machining_numbers(form.cycle, *m, theirs)) {
      constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
      cycles::TurnContext before, after;
      const auto place = [&](const std::optional<Value>& v, double by) {
        const auto n = v ? known_number(*v) : std::nullopt;
        return n ? *n / by : unknown;
      };
      before.start = {place(start.x, k), place(start.z, 1)};
      after.start = form.from.x ? cycles::TurnPoint{place(form.from.x, k), place(form.from.z, 1)} : before.start;
      std::string error;
      const auto a = cycles::expand(*own, mine, before, &error), c = cycles::expand(*other, theirs, after, &error);
      if (!a || !c) continue;
      std::vector<TurnMove> moves;
      if (form.from.x) moves.push_back(rapid_to(after.start));
      moves.insert(moves.end(), c->begin(), c->end());
      if (!std::equal(a->begin(), a->end(), moves.begin(), moves.end(), same_move)) continue;
      return std::move(form);
    }
    if (form.proved) return std::move(form);
  }
  return std::nullopt;
}

void TurnCycles::keep_profile(const Program& program, const Routine& routine, const NamedCycle& named, Site& site) {
  std::string error;
  const auto blocks = cycles::profile_blocks(program, routine, named, &error);
  for (const auto* block : blocks) {
    profile_blocks_.insert(block->id);
    site.blocks.push_back(*block);
  }
  if (blocks.empty()) return;
  for (const auto& r : program.routines) {
    const auto in = [&r](const Statement* s) {
      return std::any_of(r.body.begin(), r.body.end(), [s](const Statement& t) { return &t == s; });
    };
    site.apart = site.apart || std::all_of(blocks.begin(), blocks.end(), in);
  }
}

namespace {

/// A block that says nothing but an element of a profile, in words that mean the same wherever it stands. `here`: it
/// stays where the program runs through it, so that the later passes know what holds there. `copied`: the blocks are
/// set where the cycle is called, under its frames and modes, and may name a point of the frame.
bool plain_element(const Block& b, bool here, bool copied) {
  const bool words = std::all_of(b.motion.coords.begin(), b.motion.coords.end(), [](const CoordWord& c) {
    return c.mode != WordMode::incremental && c.scale == WordScale::modal;
  });
  const bool centres = std::all_of(b.motion.centers.begin(), b.motion.centers.end(), [&](const CenterWord& c) {
    return here || (copied && c.mode == CenterMode::absolute) ||
           (c.mode == CenterMode::from_start && c.scale == WordScale::radius);
  });
  if (!words || !centres) return false;
  const bool kind = b.motion.kind == MotionKind::modal || b.motion.kind == MotionKind::linear ||
                    b.motion.kind == MotionKind::arc_cw || b.motion.kind == MotionKind::arc_ccw;
  const bool actions = std::all_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    return std::holds_alternative<Corner>(a.data) || std::holds_alternative<SetFeed>(a.data);
  });
  return b.empty() || (b.has_motion && kind && b.motion.frame == FrameUse::normal && !b.motion.extra && actions &&
                       b.repeat_given == 0);
}

/// A block without an element, which says only what holds where the cycle is called.
bool says_nothing_new(const Block& b, const Block& at_call, const Facts& facts) {
  const bool words = b.has_motion && (b.motion.moves() || b.motion.kind == MotionKind::arc_cw ||
                                      b.motion.kind == MotionKind::arc_ccw || b.motion.extra);
  return !words && std::all_of(b.actions.begin(), b.actions.end(), [&](const Action& a) {
    const auto* set = std::get_if<ModalSet>(&a.data);
    if (set == nullptr || a.order == Order::after) return false;
    const bool read = set->setting == Setting::plane || set->setting == Setting::distance ||
                      set->setting == Setting::diameter || set->setting == Setting::units;
    return read && setting_in<std::uint8_t>(at_call, facts, set->setting) == set->value;
  });
}

/// Two free numbers, ten apart, behind those of the blocks.
std::int64_t free_numbers(const Program& program, const Body& blocks) {
  std::int64_t most = 0;
  for (const auto& s : blocks) {
    for (const auto& l : labels_on(s.line)) {
      if (l.is_number && l.text.size() < 10) most = std::max<std::int64_t>(most, std::stol(l.text));
    }
  }
  const auto used = block_numbers(program);
  std::int64_t n = (most + 9) / 10 * 10 + 10;
  while (used.count(n) != 0 || used.count(n + 10) != 0) n += 10;
  return n;
}

std::string label_of_use(const Program& program, const std::string& prefix, const NamedCycle& named,
                         std::string_view word) {
  for (const auto& [w, v] : named.words) {
    if (w != word) continue;
    const auto n = known_number(v);
    std::string text = n ? prefix + shortest(*n) : std::string();
    bool taken = text.empty();
    for (const auto& r : program.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        for (const auto& l : labels_on(s.line)) taken = taken || (!l.is_number && l.text == text);
      });
    }
    return taken ? std::string() : text;
  }
  return {};
}

}  // namespace

Body TurnCycles::elements_of(const Site& site, const Block& at_call, const Facts& facts) {
  Body out = site.blocks;
  bool straight = false;
  while (!out.empty()) {
    auto& b = std::get<Block>(out.front().node);
    if (out.front().line.skip_mask != 0 || !says_nothing_new(b, at_call, facts)) {
      if (straight && b.motion.kind == MotionKind::modal && b.has_motion) b.motion.kind = MotionKind::linear;
      break;
    }
    if (b.has_motion && b.motion.kind != MotionKind::modal) straight = b.motion.kind == MotionKind::linear;
    out.erase(out.begin());
  }
  while (!out.empty() && std::get<Block>(out.back().node).empty()) out.pop_back();
  // A copy stands where nobody knows the mode of the call.
  const bool absolute = setting_in<Distance>(at_call, facts, Setting::distance) == Distance::absolute;
  for (auto& s : out) {
    for (auto& c : std::get<Block>(s.node).motion.centers) {
      if (absolute && c.mode == CenterMode::follows_distance) c.mode = CenterMode::absolute;
    }
  }
  return out;
}

std::optional<ProfileUse> TurnCycles::use_of(const NamedCycle& named, const Site& site, const Body& blocks,
                                             const FactsOf& facts, std::optional<double> tail, bool face,
                                             std::string* why) const {
  ProfileUse use;
  *why = "its profile stands where the target's cycle can't read it";
  const bool numbers = !context_.target.identifier_labels;
  if (!site.apart || blocks.size() < (numbers ? 3 : 2)) return std::nullopt;
  use.first = blocks.front().id;
  use.last = blocks.back().id;
  bool run = false;
  for (const auto& s : blocks) {
    const auto& b = std::get<Block>(s.node);
    run = run || facts.before(s).reachable;
    if (s.line.skip_mask != 0 || !plain_element(b, run && !numbers && !tail, numbers)) {
      *why = "a block of its profile says more than an element of it";
      return std::nullopt;
    }
  }
  use.numbers = numbers;
  const auto& head = std::get<Block>(blocks.front().node);
  const bool begins = head.has_motion && head.motion.coords.size() == 2 &&
                      motion_in(head, facts.before(blocks.front())) == MotionKind::linear;
  if (numbers) {
    *why = "its profile does not begin with a straight move to a point";
    if (!begins) return std::nullopt;
    const auto number = free_numbers(program_, blocks);
    if (number + 10 > context_.target.label_max) return std::nullopt;
    use.first = blocks[1].id;  // the point before it stands among the words
    use.first_label = std::to_string(number);
    use.last_label = std::to_string(number + 10);
    use.blocks = {blocks.begin() + 1, blocks.end()};
    const bool points = std::any_of(use.blocks.begin(), use.blocks.end(), [](const Statement& s) {
      const auto& centers = std::get<Block>(s.node).motion.centers;
      return std::any_of(centers.begin(), centers.end(),
                         [](const CenterWord& c) { return c.mode == CenterMode::absolute; });
    });
    if (run || points) use.copy = use.blocks;
    why->clear();
    return use;
  }
  use.first_label = label_of_use(program_, context_.target.label_prefix, named, "first_label");
  use.last_label = label_of_use(program_, context_.target.label_prefix, named, "last_label");
  for (const auto& [w, v] : named.words) {
    if (w == "x" || w == "z") (w == "x" ? use.x : use.z) = v;
  }
  if (use.x) use.x->text = {};
  if (use.z) use.z->text = {};
  use.blocks = blocks;
  use.tail = tail;
  use.face = face;
  // Labels that are words count in their own program only: it gets the blocks too.
  const bool here =
      std::any_of(routine_.body.begin(), routine_.body.end(), [&use](const Statement& t) { return t.id == use.first; });
  if (!here || (run && (use.x || use.tail))) use.copy = blocks;
  if (!use.x && !begins) {
    *why = "its profile does not begin with a straight move to a point";
    return std::nullopt;
  }
  if (use.first_label.empty() || use.last_label.empty() || use.first_label == use.last_label) return std::nullopt;
  why->clear();
  return use;
}

std::optional<SimilarForm> TurnCycles::similar(const NamedCycle& words, const Statement& s, const Block& b,
                                               const FactsOf& all, bool last_resort, std::string* why) const {
  why->clear();
  const auto it = sites_.find(s.id);
  const auto family = cycles::family_of(words.name);
  const auto asked = context_.options.cycles;
  if (asked != CycleWriting::native && !(last_resort && asked == CycleWriting::exact)) return std::nullopt;
  if (it == sites_.end() || family.empty()) return std::nullopt;
  if (!context_.target.native_cycle) return std::nullopt;
  const Facts& facts = all.before(s);
  const auto m = modes_at(b, facts, context_.source_machine.power_on);
  // The words of a cycle keep their numbers: both controls have to count them the same way.
  const bool counted = m && m->units == Units::metric && m->diameter != DiameterMode::absolute_only &&
                       m->distance == Distance::absolute &&
                       (context_.target.diameter_switch || context_.target.fixed_diameter == m->diameter);
  if (!counted) return *why = "units, diameters or absolute and incremental are not the same there", std::nullopt;
  const NamedCycle named = in_older_words(words, *m);
  const Site& site = it->second;
  const double k = m->diameter == DiameterMode::radius ? 1 : 2;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto fold = [&](const Value& v) { return constants_.fold(v, routine_, s, nullptr); };
  SimilarSource source{named,
                       *m,
                       {site.state.x, site.state.z},
                       {unknown, unknown},
                       nose_width(site.state, 1),
                       {},
                       {},
                       site.profile ? &*site.profile : nullptr,
                       context_.target,
                       fold};
  if (const auto x = facts.position[axis::x]) source.start.x = Value(*x * k);
  if (const auto z = facts.position[axis::z]) source.start.z = Value(*z);
  const auto place = [&](const std::optional<Value>& v, double by) {
    const auto n = v ? known_number(fold(*v)) : std::nullopt;
    return n ? *n / by : unknown;
  };
  source.at = {place(source.start.x, k), place(source.start.z, 1)};
  for (auto* v : {&source.start.x, &source.start.z}) {
    if (*v && (*v)->literal()) (*v)->text = {};
  }
  source.feed = facts.feed ? std::optional(Value(*facts.feed)) : std::nullopt;
  for (const auto& a : b.actions) {
    if (const auto* f = std::get_if<SetFeed>(&a.data); f != nullptr && a.order != Order::after) source.feed = f->value;
  }
  if (source.feed) source.feed->text = {};
  std::optional<SimilarForm> form;
  if (family == "stock") {
    if (!site.profile) return *why = site.fault, std::nullopt;
    const Body blocks = elements_of(site, b, facts);
    for (const auto& c :
         blocks.empty() ? std::vector<CoordWord>{} : std::get<Block>(blocks.front().node).motion.coords) {
      if (c.mode == WordMode::incremental || c.scale != WordScale::modal) continue;
      if (c.axis == axis::x) source.begins.x = c.value;
      if (c.axis == axis::z) source.begins.z = c.value;
    }
    for (auto* v : {&source.begins.x, &source.begins.z}) {
      if (*v) (*v)->text = {};
    }
    form = similar_stock(source, why);
    if (!form) return std::nullopt;
    form->use = use_of(named, site, blocks, all, form->tail, form->face, why);
    if (!form->use) return std::nullopt;
    form->use->name(form->cycle);
  } else if (family == "thread") {
    form = similar_thread(source, why);
    if (!form) return std::nullopt;
  }
  const auto* own = cycles::find_machining(named.name);
  const auto* other = form ? cycles::find_machining(form->cycle.name) : nullptr;
  const bool comp_off = own->ends_comp || setting_in<CompSide>(b, facts, Setting::comp) == CompSide::off;
  if (form && other->ends_comp && !comp_off)
    return *why = "radius compensation may be on, and would be off behind it", std::nullopt;
  if (form && other->ends_modes && !own->ends_modes) {
    const bool straight = facts.motion == MotionKind::rapid || facts.motion == MotionKind::linear;
    if (!straight) return *why = "the motion function in force behind it is not known here", std::nullopt;
    if (facts.motion == MotionKind::linear) form->motion = facts.motion;
  }
  return form;
}

std::optional<Body> TurnCycles::write_out_computed(const NamedCycle& named, const Statement& s, const Block& b,
                                                   const Facts& facts, Editor& editor, std::string* error) const {
  const auto it = sites_.find(s.id);
  const auto m = modes_at(b, facts, context_.source_machine.power_on);
  if (it == sites_.end() || !m) return *error = "units or diameters are not known here", std::nullopt;
  TurnStart start{it->second.state.x, it->second.state.z};
  const double k = m->diameter == DiameterMode::radius ? 1 : 2;
  if (const auto x = facts.position[axis::x]) start.x = Value(*x * k);
  if (const auto z = facts.position[axis::z]) start.z = Value(*z);
  const double unit = m->units == Units::inch ? 25.4 : 1;
  ComputedTurn turn(named, s.line, *m, start, nose_width(it->second.state, unit), editor);
  turn.usual_feed = feeds_.at(s, b, facts);
  auto out = turn.run();
  if (!out) *error = turn.error;
  return out;
}

}  // namespace cnctrans::ir::passes
