#include "tests/mutation/documented.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

#include "base/text.h"
#include "translator/files/registry.h"

namespace cnctrans::mutation {

using interpreter::CycleRun;
using interpreter::Event;
using interpreter::EventKind;
using interpreter::Position;

namespace {

enum Aspect : std::uint32_t {
  state_order = 1U << 0U,
  offset_numbers = 1U << 1U,
  selections = 1U << 2U,
  small_moves = 1U << 3U,
  tolerances = 1U << 4U,
  texts = 1U << 5U,
  taps = 1U << 6U,
  unfed = 1U << 7U,
  cycles = 1U << 8U,
  open_offset = 1U << 9U,
  exact_stops = 1U << 10U,
  reads_first = 1U << 11U,  // known from the verdict: see trial.cpp
};
struct Row {
  Aspect aspect;
  const char* name;
  const char* sentence;  ///< of docs/verify.md
};
constexpr std::array<Row, 12> table = {{
    {state_order, "order of commands", "the order of spindle, coolant, tool and machine functions among each other"},
    {offset_numbers, "offset numbers", "offset numbers"},
    {selections, "tools made ready",
     "a tool that is only made ready when a T of one of the two programs changes the tool at once"},
    {small_moves, "small moves", "a move below the tolerance, on one side only"},
    {tolerances, "tolerance",
     "Tolerances: 0.001 mm (0.0014 in programs with inches: half of their fourth decimal) and 0.0011 degrees on end "
     "points"},
    {texts, "signs of messages", "Messages are the same text, letters and signs, as far as a target can show it"},
    {taps, "sense in a tap", "there the sense of the spindle follows from the path"},
    {unfed, "feed before any F", "The feed the target's power-on state gives such a move"},
    {cycles, "passes of a cycle",
     "the number of passes, the infeeds up to that limit and the ways between them are not compared"},
    {open_offset, "offset before the first D", "the offset before the first D or change of the program"},
    {exact_stops, "exact stop without a mode", "no such mode, or no such word, the source's is not asked for"},
    {reads_first, "variable read first", "The answer names them"},
}};
constexpr std::uint32_t everything = (1U << table.size()) - 1;

bool moves(EventKind k) {
  return k == EventKind::rapid || k == EventKind::linear || k == EventKind::arc || k == EventKind::thread ||
         k == EventKind::probe;
}
bool cuts(EventKind k) {
  return k == EventKind::linear || k == EventKind::arc;
}
bool stands_between(EventKind k) {
  return moves(k) || k == EventKind::dwell || k == EventKind::stop || k == EventKind::end || k == EventKind::message;
}

struct Spindle {
  std::string state = "off";
  bool css = false;
  double value = 0, limit = 0, angle = 0;
  bool operator==(const Spindle&) const = default;
};
/// A move, a dwell, a stop, a message or the end, with the state in which the machine comes to it.
struct Item {
  Event e;
  std::map<std::int32_t, Spindle> spindles;
  std::string coolant = "off";
  std::int32_t offset = -1;  ///< the number of the last one
  bool comp = false;
  std::vector<std::string> commands;  ///< since the last one
  // Of a cycle as a whole
  const CycleRun* run = nullptr;
  Position low, high;                         ///< of its moves
  Position first, last;                       ///< of these: of a thread the ends of its passes
  bool unbounded = true;                      ///< no move of it counts for these yet
  std::vector<std::pair<int, double>> feeds;  ///< that it uses: by what, and how fast
  double infeed = 0;  ///< the longest way at feed along one axis, of a pocket or tap into the part
};

struct Tolerance {
  double length = 1e-9, center = 1e-9, relative = 1e-9, seconds = 1e-9, small = 1e-9;
};

bool close(double a, double b, const Tolerance& t) {
  return std::fabs(a - b) <= std::max(t.small, t.relative * std::max(std::fabs(a), std::fabs(b)));
}

std::string core(const std::string& text) {
  std::string out;
  for (const char c : to_upper_ascii(text)) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) out += c;
  }
  return out;
}

bool by_threads(const CycleRun& run) {
  return run.family == "thread" || run.family == "tap";
}

/// The trace without what the aspects leave out.
class Reduced {
 public:
  Reduced(const Trace& trace, std::uint32_t without, std::size_t unfed_moves)
      : trace_(trace), without_(without), unfed_(unfed_moves) {
    for (std::size_t k = 0; k < trace.events.size(); ++k) one(trace.events[k], k);
    // The ways to a cycle, and away from a thread, may be in several parts.
    for (std::size_t k = 1; k < items.size();) {
      Item &before = items[k - 1], &item = items[k];
      const bool plain = item.run == nullptr && item.e.kind == EventKind::rapid && item.commands.empty();
      const bool away = plain && before.run != nullptr && by_threads(*before.run);
      const bool on_the_way = plain && before.run == nullptr && before.e.kind == EventKind::rapid && leads_to_cycle(k);
      if (away) before.e.to = item.e.to;
      if (on_the_way) item.commands = std::move(before.commands);
      if (away || on_the_way)
        items.erase(items.begin() + static_cast<std::ptrdiff_t>(away ? k : k - 1));
      else
        ++k;
    }
    for (std::size_t k = 0; k < items.size(); ++k) {  // where the tool does not go on, or back, it stops in any case
      if (k + 1 == items.size() || !moves(items[k + 1].e.kind) || turns_round(k)) items[k].e.stop = {};
    }
  }
  std::vector<Item> items;
  /// The next move goes straight back along this one.
  [[nodiscard]] bool turns_round(std::size_t k) const {
    const auto straight = [](EventKind kind) { return kind == EventKind::linear || kind == EventKind::rapid; };
    if (k == 0 || !moves(items[k - 1].e.kind) || !straight(items[k].e.kind) || !straight(items[k + 1].e.kind))
      return false;
    double along = 0, way = 0, back = 0;
    for (std::size_t a = 0; a < items[k].e.to.value.size(); ++a) {
      const double there = items[k].e.to.value[a] - items[k - 1].e.to.value[a];
      const double then = items[k + 1].e.to.value[a] - items[k].e.to.value[a];
      along += there * then;
      way += there * there;
      back += then * then;
    }
    return along < 0 && along * along > way * back * (1 - 1e-9);
  }
  /// With nothing but rapid moves in between.
  [[nodiscard]] bool leads_to_cycle(std::size_t k) const {
    while (k < items.size() && items[k].run == nullptr && items[k].e.kind == EventKind::rapid) ++k;
    return k < items.size() && items[k].run != nullptr;
  }

 private:
  [[nodiscard]] bool has(Aspect a) const { return (without_ & a) != 0; }

  using Tool = std::pair<std::int32_t, std::string>;
  [[nodiscard]] const CycleRun* run_at(std::size_t k) const {
    if (!has(cycles)) return nullptr;
    for (const auto& run : trace_.cycles) {
      if (run.first <= k && k < run.last) return &run;
    }
    return nullptr;
  }

  static bool is_state(EventKind k) {
    return k == EventKind::comp || k == EventKind::coolant || k == EventKind::spindle;
  }
  template <class State>
  static bool update(State& known, const State& now) {
    return std::exchange(known, now) != now;
  }
  /// A command that leaves the machine as it is says nothing.
  bool changes(const Event& e) {
    if (e.kind == EventKind::comp) return update(now_.comp, e.state != "off");
    if (e.kind == EventKind::coolant) return update(now_.coolant, e.state);
    const bool off = e.state == "off" || e.state == "oriented";  // neither has a speed
    const Spindle now{e.state, !off && e.css, off ? 0 : e.value, off || !e.has_limit ? 0 : e.limit,
                      e.state == "oriented" ? e.angle : 0};
    return update(now_.spindles[e.number], now);
  }

  void command(const Event& e) {
    if (e.kind == EventKind::offset && (has(offset_numbers) || !update(now_.offset, e.number))) return;
    if (e.kind == EventKind::feed_stop) return;       // said by the move
    if (e.kind == EventKind::tool) now_.offset = -1;  // a D selects again, for another tool
    if (e.kind == EventKind::tool && !e.change && (has(selections) || ready_ == Tool{e.number, e.text})) return;
    if (e.kind == EventKind::tool) ready_ = e.change ? Tool{} : Tool{e.number, e.text};
    if (is_state(e.kind) && (!changes(e) || has(state_order))) return;
    const bool has_state = is_state(e.kind) || e.kind == EventKind::tool;  // the others keep that of an event before
    now_.commands.push_back(std::string(interpreter::name(e.kind)) + " " + std::to_string(e.number) + " " +
                            (has_state ? e.state : "") + " " + e.text + " " + (e.change ? "change" : "") + " " +
                            shortest(is_state(e.kind) ? e.value : 0));
  }

  void one(const Event& e, std::size_t k) {
    const CycleRun* run = run_at(k);
    if (run != nullptr && !items.empty() && goes_on(items.back(), *run, e)) {
      if (!stands_between(e.kind)) return command(e);
      items.back().run = run;
      return widen(items.back(), e);
    }
    if (!stands_between(e.kind)) return command(e);
    if (e.kind == EventKind::dwell && !items.empty() && items.back().e.kind == EventKind::dwell &&
        now_.commands.empty() && items.back().e.revolutions == e.revolutions) {
      items.back().e.amount += e.amount;
      return;
    }
    Item item = now_;
    item.e = e;
    if (has(unfed) && (e.kind == EventKind::linear || e.kind == EventKind::arc) && unfed_ > 0) {
      --unfed_;
      item.e.feed = 0;
    }
    if (has(state_order)) std::sort(item.commands.begin(), item.commands.end());
    item.run = run;
    if (has(taps)) sense(item);
    now_.commands.clear();
    if (run != nullptr) {
      widen(item, e);
    } else if (moves(e.kind)) {
      if (joins(item)) return;
    }
    items.push_back(std::move(item));
  }

  /// The same cycle, or one more stroke of a tap into the same hole.
  static bool goes_on(const Item& item, const CycleRun& run, const Event& e) {
    if (item.run == &run || item.run == nullptr) return item.run != nullptr;
    if (item.run->family != "tap" || run.family != "tap") return false;
    const auto axes = ir::plane_axes(run.plane);
    return item.e.to.value[axes.u] == e.to.value[axes.u] && item.e.to.value[axes.v] == e.to.value[axes.v];
  }

  void widen(Item& item, const Event& e) const {
    if (!moves(e.kind)) return;
    const bool bounds = !by_threads(*item.run) || e.kind == EventKind::thread;
    if (bounds && item.unbounded) item.low = item.high = item.first = e.to;
    if (bounds) item.last = e.to;
    item.unbounded = item.unbounded && !bounds;
    for (std::size_t k = 0; bounds && k < e.to.value.size(); ++k) {
      item.low.value[k] = std::min(item.low.value[k], e.to.value[k]);
      item.high.value[k] = std::max(item.high.value[k], e.to.value[k]);
    }
    if (item.run->family == "tap" && e.kind == EventKind::thread) {
      for (const auto& [n, s] : now_.spindles) use(item, {3, s.value});
    }
    // Along the tool, or in the plane.
    const auto axes = ir::plane_axes(item.run->plane);
    const double down = item.e.to.value[axes.w] - e.to.value[axes.w];
    const bool plane = item.e.to.value[axes.u] != e.to.value[axes.u] || item.e.to.value[axes.v] != e.to.value[axes.v];
    const bool cut = cuts(e.kind);
    if (item.run->family == "pocket" && cut) item.infeed = std::max(item.infeed, down);
    item.e.to = e.to;
    if (!bounds) return;
    const double feed = e.kind == EventKind::rapid ? 0 : (e.kind == EventKind::thread ? e.pitch : e.feed);
    use(item, {item.run->family == "pocket" && cut ? (plane ? 2 : 1) : 0, feed});
  }
  static void use(Item& item, const std::pair<int, double>& used) {
    const auto same = [&used](const auto& f) {
      return f.first == used.first && std::fabs(f.second - used.second) < 1e-9;
    };
    if (std::none_of(item.feeds.begin(), item.feeds.end(), same)) item.feeds.push_back(used);
    std::sort(item.feeds.begin(), item.feeds.end());
  }

  void sense(Item& item) {
    const auto kind = item.e.kind;
    const bool thread = kind == EventKind::thread || (item.run != nullptr && item.run->family == "tap");
    if (thread && !in_tap_) {  // started before it, with nothing but rapid moves between
      for (auto before = items.rbegin(); before != items.rend() && before->e.kind == EventKind::rapid; ++before)
        before->spindles.clear();
    }
    in_tap_ = thread || (in_tap_ && (kind == EventKind::rapid || kind == EventKind::dwell));
    if (!in_tap_) return;
    if (kind != EventKind::thread) return item.spindles.clear();  // a tap's speeds: see widen
    for (auto& [n, s] : item.spindles) {
      if (s.state == "cw" || s.state == "ccw") s.state = "turning";
      s.angle = 0;
    }
  }

  /// The move goes on along the last one, or goes nowhere.
  bool joins(const Item& item) {
    if (items.empty() || !moves(items.back().e.kind) || items.back().run != nullptr) return false;
    Item& last = items.back();
    const bool straight = item.e.kind == EventKind::rapid || item.e.kind == EventKind::linear;
    if (!straight || last.e.to.known != item.e.to.known || !item.commands.empty()) return false;
    if (has(small_moves) && distance(last.e.to, item.e.to) <= 0.0014) return true;
    const bool fed = last.e.kind != EventKind::rapid;
    if (last.e.kind != item.e.kind || (fed && (last.e.feed != item.e.feed || last.e.feed_mode != item.e.feed_mode)) ||
        last.e.centre_side != item.e.centre_side || (!has(open_offset) && last.e.offset.with != item.e.offset.with))
      return false;
    const Position* before = &trace_.start;
    for (std::size_t k = items.size() - 1; k-- > 0 && before == &trace_.start;) {
      if (moves(items[k].e.kind)) before = &items[k].e.to;
    }
    double dot = 0, a = 0, b = 0;
    for (std::size_t k = 0; k < item.e.to.value.size(); ++k) {
      if ((item.e.to.known >> k & 1U) == 0) continue;
      const double p = last.e.to.value[k] - before->value[k], q = item.e.to.value[k] - last.e.to.value[k];
      dot += p * q;
      a += p * p;
      b += q * q;
    }
    if (dot <= 0 || dot * dot < a * b * (1 - 1e-6)) return false;
    last.e.to = item.e.to;
    last.e.stop = item.e.stop;
    return true;
  }

  static double distance(const Position& a, const Position& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.value.size(); ++k) {
      if ((a.known & b.known) >> k & 1U) sum += (a.value[k] - b.value[k]) * (a.value[k] - b.value[k]);
    }
    return std::sqrt(sum);
  }

  const Trace& trace_;
  std::uint32_t without_;
  std::size_t unfed_;
  bool in_tap_ = false;
  Tool ready_;  ///< that is made ready: its number and its name
  Item now_;
};

std::string positions(const Position& a, const Position& b, const Tolerance& t) {
  for (std::size_t k = 0; k < a.value.size(); ++k) {
    if (((a.known & b.known) >> k & 1U) != 0 && std::fabs(a.value[k] - b.value[k]) > t.length) return "end point";
  }
  return {};
}

/// A thread reaches as far as its passes go down; they begin anywhere in the V of the source's, as many as they are.
void leave_first_passes(Item& item) {
  if (item.run->family != "thread") return;
  for (std::size_t k = 0; k < item.low.value.size(); ++k) {
    auto &low = item.low.value[k], &high = item.high.value[k];
    if (item.last.value[k] > item.first.value[k]) low = high;
    if (item.last.value[k] < item.first.value[k]) high = low;
  }
}

std::string cycle_difference(Item a, Item b, const Tolerance& t) {
  const Tolerance wide{0.004, 0.004, t.relative, t.seconds, t.small};
  leave_first_passes(a);
  leave_first_passes(b);
  if (!positions(a.low, b.low, wide).empty() || !positions(a.high, b.high, wide).empty()) return "extent of a cycle";
  if (!positions(a.e.to, b.e.to, wide).empty()) return "end of a cycle";
  if (a.feeds.size() != b.feeds.size() ||
      !std::equal(a.feeds.begin(), a.feeds.end(), b.feeds.begin(),
                  [&](const auto& x, const auto& y) { return x.first == y.first && close(x.second, y.second, t); }))
    return "feeds of a cycle";
  if (b.infeed > a.infeed * 1.1 + 0.01) return "infeed of a cycle";
  return {};
}

std::string difference(const Item& a, const Item& b, const Tolerance& t, std::uint32_t without) {
  const std::string kind(interpreter::name(a.e.kind));
  if (a.e.kind != b.e.kind) return kind + " against " + std::string(interpreter::name(b.e.kind));
  if (a.commands != b.commands) return "commands before " + kind;
  if (a.coolant != b.coolant) return "coolant at " + kind;
  if (a.comp != b.comp) return "compensation at " + kind;
  const auto spindle_of = [](const Item& i, std::int32_t n) {
    const auto it = i.spindles.find(n);
    return it == i.spindles.end() ? Spindle{} : it->second;
  };
  for (const auto* side : {&a, &b}) {
    for (const auto& [n, ignored] : side->spindles) {
      const Spindle x = spindle_of(a, n), y = spindle_of(b, n);
      if (x.state != y.state || x.css != y.css || !close(x.value, y.value, t) || !close(x.limit, y.limit, t) ||
          std::fabs(x.angle - y.angle) > t.length)
        return "spindle at " + kind;
    }
  }
  if ((a.run == nullptr) != (b.run == nullptr)) return "a cycle on one side";
  if (a.run != nullptr) return cycle_difference(a, b, t);
  switch (a.e.kind) {
    case EventKind::dwell:
      return a.e.revolutions != b.e.revolutions || std::fabs(a.e.amount - b.e.amount) > t.seconds ? "dwell" : "";
    case EventKind::message:
      return ((without & texts) != 0 ? core(a.e.text) != core(b.e.text) : a.e.text != b.e.text) ? "message" : "";
    case EventKind::stop: return a.e.optional_stop != b.e.optional_stop ? "kind of stop" : "";
    case EventKind::end: return a.e.reason != b.e.reason ? "end" : "";
    default: break;
  }
  if (const auto what = positions(a.e.to, b.e.to, t); !what.empty()) return what + " of " + kind;
  if (a.e.centre_side != b.e.centre_side) return "side at " + kind;
  if (a.e.centre_side != ir::CompSide::off && a.e.plane != b.e.plane) return "plane of compensation at " + kind;
  if (cuts(a.e.kind) && a.e.stop.exact != b.e.stop.exact && (without & exact_stops) == 0)
    return "exact stop at " + kind;
  const std::uint32_t unsaid = (without & open_offset) != 0 ? a.e.offset.unsaid | b.e.offset.unsaid : 0;
  const std::uint32_t known = a.e.offset.known & b.e.offset.known & ~unsaid;
  if (((a.e.offset.with ^ b.e.offset.with) & known) != 0) return "tool offset at " + kind;
  if ((without & open_offset) == 0 && a.e.offset.known != b.e.offset.known) return "tool offset not known at " + kind;
  if (a.e.kind == EventKind::rapid) return {};
  if (a.e.kind == EventKind::thread) {
    return !close(a.e.pitch, b.e.pitch, t) || std::fabs(a.e.pitch_change - b.e.pitch_change) > 1e-6 ||
                   std::fabs(a.e.start_angle - b.e.start_angle) > t.length
               ? "thread"
               : "";
  }
  if (a.e.feed_mode != b.e.feed_mode) return "feed mode at " + kind;
  if (!close(a.e.feed, b.e.feed, t)) return "feed at " + kind;
  if (a.e.kind == EventKind::probe && a.e.change != b.e.change) return "sense of probe";
  if (a.e.kind != EventKind::arc) return {};
  if (a.e.plane != b.e.plane || a.e.cw != b.e.cw || a.e.turns != b.e.turns) return "sense of arc";
  if (std::hypot(a.e.center_u - b.e.center_u, a.e.center_v - b.e.center_v) > t.center) return "centre of arc";
  return {};
}

std::string difference(const Trace& a, const Trace& b, std::uint32_t without, std::size_t unfed_moves) {
  const Tolerance t = (without & tolerances) != 0 ? Tolerance{0.0014, 0.002, 1e-3, 0.0051, 0.00051} : Tolerance{};
  const Reduced x(a, without, unfed_moves), y(b, without, unfed_moves);
  // The way to a cycle that is compared by the part: a millimetre outside of the hull is left aside.
  for (std::size_t k = 0; k < std::min(x.items.size(), y.items.size()); ++k) {
    Tolerance here = t;
    if (x.items[k].e.kind == EventKind::rapid && x.leads_to_cycle(k) && y.leads_to_cycle(k)) here.length = 1;
    if (auto what = difference(x.items[k], y.items[k], here, without); !what.empty()) return what;
  }
  return x.items.size() == y.items.size() ? "" : "a part on one side only";
}

}  // namespace

Documented documented(const Translated& t, const Trace& with_fault) {
  std::size_t unfed_moves = 0;
  for (const auto& e : t.source_trace.events) {
    if (e.kind != EventKind::linear && e.kind != EventKind::arc) continue;
    if (e.feed != 0) break;
    ++unfed_moves;
  }
  std::uint32_t without = everything;
  const auto is_selection = [](const Event& e) { return e.kind == EventKind::tool && !e.change; };
  if (std::any_of(t.source_trace.events.begin(), t.source_trace.events.end(), is_selection) &&
      std::any_of(t.trace.events.begin(), t.trace.events.end(), is_selection))
    without &= ~std::uint32_t{selections};
  const auto* language = translator::find_dialect(t.to);
  if (language != nullptr && language->backend->capabilities().exact_stop_modal) without &= ~std::uint32_t{exact_stops};
  const auto left = [&](std::uint32_t aspects) { return difference(t.trace, with_fault, aspects, unfed_moves); };
  Documented found;
  found.equal = left(0).empty();
  if (found.equal) return found;
  found.what = left(without);
  if (!found.what.empty()) return found;
  for (const auto& row : table) {
    if ((without & row.aspect) == 0 || !left(without & ~std::uint32_t{row.aspect}).empty()) continue;
    without &= ~std::uint32_t{row.aspect};
  }
  for (const auto& row : table) {
    if ((without & row.aspect) != 0) found.aspects.emplace_back(row.name);
  }
  return found;
}

std::vector<std::string> missing_sentences(const std::string& page) {
  const auto words = [](const std::string& text) {
    std::string out;
    for (const char c : text) {
      const char d = c == '\n' ? ' ' : c;
      if (d != ' ' || out.empty() || out.back() != ' ') out += d;
    }
    return out;
  };
  std::vector<std::string> missing;
  for (const auto& row : table) {
    if (words(page).find(row.sentence) == std::string::npos) missing.emplace_back(row.sentence);
  }
  return missing;
}

}  // namespace cnctrans::mutation
