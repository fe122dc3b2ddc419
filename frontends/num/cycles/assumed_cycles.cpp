// G63, G66 and G31 (reference 12.5, 11.5): cycles whose moves the manuals at hand leave open. They run as the options
// of the machine profile say.
#include <utility>

#include "base/text.h"
#include "frontends/num/state/actions.h"
#include "frontends/num/state/lower.h"
#include "ir/cycles/assumed.h"

namespace cnctrans::frontends::num {

using slot::e;
using slot::letter;

namespace {

using Words = std::vector<std::pair<std::string, ir::Value>>;

void put_habits(const dialects::num::CycleHabits& habits, Words& words, std::string_view assumed) {
  for (const auto& h : {habits.first, habits.second}) {
    if (h.given && h.value != 0) words.emplace_back(std::string(h.word), ir::Value(h.value));
  }
  if (!habits.confirmed)
    words.emplace_back(std::string(assumed), ir::Value(ir::string_literal(std::string(habits.option))));
}

}  // namespace

void Lowering::tell_assumed(const Word& g, const dialects::num::CycleHabits& habits) {
  if (habits.confirmed) return;
  report_.warn("NUM-071", g.pos,
               "`" + std::string(text_of(g)) + "`: the manuals at hand do not describe its moves; a run takes it so: " +
                   std::string(habits.in_words),
               "compare with the machine, then set " + std::string(habits.option) + " in its profile");
}

/// Words of which nothing is known but their name.
bool Lowering::keeps_open_words(const Word& g, std::initializer_list<int> slots) {
  for (const int s : slots) {
    if (!has(s)) continue;
    const Word& w = *pending_[static_cast<std::size_t>(s)];
    report_.keep("NUM-004", w.pos,
                 "`" + std::string(text_of(w)) + "`: what it says in " + std::string(text_of(g)) +
                     " is not described; the block is kept as text",
                 settings_.lathe ? "cycle.turning" : "cycle.milling");
    return true;
  }
  return false;
}

void Lowering::reentrant_stock(const Word& g) {
  const auto refuse = [&](std::string_view why) {
    report_.refuse("NUM-004", g.pos, "G63" + std::string(why), {}, "cycle.turning");
  };
  if (keeps_open_words(g, {e('X'), e('Z')})) return;
  auto cycle = std::make_shared<ir::Cycle>();
  cycle->node = ir::NamedCycle{"stock.reentrant", {}};
  auto& words = std::get<ir::NamedCycle>(cycle->node).words;
  if (!profile_labels(g, std::get<ir::NamedCycle>(cycle->node))) return;
  auto x = take_absolute(ir::axis::x), z = take_absolute(ir::axis::z);
  if (report_.refused()) return;
  if (!x || !z) return refuse(" needs X and Z, the corner of the blank");
  if (!out_->motion.coords.empty()) return refuse(" has no other axis than X and Z");
  const Word *p = use(letter('P')), *r = use(letter('R'));
  if ((p != nullptr) == (r != nullptr)) return refuse(" needs one depth of cut: P or R");
  words.emplace_back("x_2", *std::move(x));
  words.emplace_back("z_2", *std::move(z));
  words.emplace_back(p != nullptr ? "step" : "axial_step", value(p != nullptr ? *p : *r));
  const std::pair<int, const char*> rest[] = {{letter('I'), "stock_x"},
                                              {letter('K'), "stock_z"},
                                              {e('R'), "withdrawal"},
                                              {e('A'), "entry_angle"},
                                              {e('F'), "groove_feed"}};
  for (const auto& [s, name] : rest) {
    if (const Word* w = use(s)) words.emplace_back(name, value(*w));
  }
  put_habits(settings_.reentrant, words, ir::cycles::assumed_word);
  tell_assumed(g, settings_.reentrant);
  put_machining(g, std::move(cycle));
}

void Lowering::plunged_groove(const Word& g) {
  const auto refuse = [&](std::string_view why) {
    report_.refuse("NUM-004", g.pos, "G66" + std::string(why), {}, "cycle.turning");
  };
  if (keeps_open_words(g, {e('X'), e('Z')})) return;
  auto cycle = std::make_shared<ir::Cycle>();
  cycle->node = ir::NamedCycle{"groove.plunged", {}};
  auto& words = std::get<ir::NamedCycle>(cycle->node).words;
  if (const Word* d = use(letter('D'))) words.emplace_back("second_edge", value(*d));
  auto x = take_absolute(ir::axis::x), z = take_absolute(ir::axis::z);
  if (report_.refused()) return;
  if (!x || !z) return refuse(" needs X and Z, the opposite corner of the groove");
  if (!out_->motion.coords.empty()) return refuse(" has no other axis than X and Z");
  const Word *p = use(letter('P')), *r = use(letter('R'));
  if ((p != nullptr) == (r != nullptr)) return refuse(" needs one step across: P or R");
  words.emplace_back("x_end", *std::move(x));
  words.emplace_back("z_end", *std::move(z));
  if (const Word* ea = use(e('A'))) words.emplace_back("slope_angle", value(*ea));
  words.emplace_back(p != nullptr ? "step" : "axial_step", value(p != nullptr ? *p : *r));
  if (const Word* ef = use(e('F'))) words.emplace_back("base_dwell", value(*ef));
  const auto& habits = p != nullptr ? settings_.plunged_by_p : settings_.plunged_by_r;
  if (const auto width = parse_decimal(settings_.options.plunged_width); width && *width > 0)
    words.emplace_back("width", ir::Value(state_.inch ? *width / 25.4 : *width));
  else if (!habits.confirmed)
    words.emplace_back("assumed_width", ir::Value(1));
  put_habits(habits, words, ir::cycles::assumed_word);
  tell_assumed(g, habits);
  put_machining(g, std::move(cycle));
}

/// A thread by a single point, at the tool's place or at the X Y of the block; modal as the cycles of holes.
void Lowering::chased_on_mill(const Word& g) {
  const auto refuse = [&](const Word& at, std::string_view why) {
    report_.refuse("NUM-027", at.pos, std::string(why), {}, "cycle.milling");
  };
  if (settings_.lathe) return refuse(g, "G31 is a cycle of mills");
  if (marks_.motion && out_->motion.kind != ir::MotionKind::rapid) {
    report_.refuse("NUM-026", out_->motion.code_pos,
                   "a cycle positions in rapid: this motion function can't stand beside it");
    return;
  }
  if (keeps_open_words(g, {e('F'), e('P'), e('S'), e('B')})) return;
  ir::HoleCycle cycle;
  cycle.kind = ir::HoleKind::mill;
  cycle.mill.shape = "thread.chased";
  cycle.approach_by_retract = true;
  if (!cycle_bottom(cycle, g)) return;
  cycle.retract = cycle.reference =
      ir::Level{ir::Value(0), ir::LevelBase::from_initial, ir::LevelBase::from_initial, true};
  state_.cycle.has_impact_plane = false;
  if (!plane_words(cycle)) return;
  if (!has(letter('K')) || !has(letter('P'))) return refuse(g, "G31 needs the pitch K and the depth P");
  const std::pair<char, const char*> rows[] = {
      {'K', "pitch"}, {'P', "depth"}, {'Q', "last_pass"}, {'F', "starts"}, {'S', "passes"}};
  for (const auto& [address, name] : rows) {
    const Word* w = use(letter(address));
    if (w == nullptr) continue;
    if (!w->is_expression && w->number < 0) return refuse(*w, "the words of G31 are not negative");
    cycle.mill.words.emplace_back(name, value(*w));
  }
  if (const Word* ec = use(e('C'))) cycle.mill.words.emplace_back("angle", value(*ec));
  put_habits(settings_.chased, cycle.mill.words, ir::cycles::assumed_mill_word);
  tell_assumed(g, settings_.chased);
  state_.cycle.code = 31;
  out_->has_motion = out_->has_motion || !out_->motion.coords.empty();
  put_cycle(g, std::make_shared<const ir::HoleCycle>(std::move(cycle)), true);
}

}  // namespace cnctrans::frontends::num
