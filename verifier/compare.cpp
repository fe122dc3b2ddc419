#include "verifier/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/text.h"
#include "ir/geometry/geometry.h"
#include "verifier/commands.h"
#include "verifier/cycle_pairs.h"
#include "verifier/dwells.h"
#include "verifier/normalise.h"
#include "verifier/offset_numbers.h"
#include "verifier/tool_names.h"

namespace cnctrans::verifier {

using interpreter::Event;
using interpreter::EventKind;
using interpreter::Position;

namespace {

constexpr double exact = 1e-6;

bool rotary(std::size_t axis) {
  return ir::is_rotary_letter(static_cast<ir::AxisId>(axis));
}

std::string axis_label(std::size_t axis) {
  const auto fixed = ir::fixed_axis_name(static_cast<ir::AxisId>(axis));
  return fixed.empty() ? "axis " + std::to_string(axis) : std::string(fixed);
}

/// Walks two normalised traces side by side.
class Comparison {
 public:
  Comparison(const std::vector<Event>& source, const std::vector<Event>& target, const Options& options,
             Verdict& verdict)
      : a_(normalise(source, options.offset_numbers, options.makes_ready, options.shows_messages)),
        b_(normalise(target, options.offset_numbers, options.makes_ready, options.shows_messages)),
        first_a_(source.data()),
        first_b_(target.data()),
        options_(options),
        offsets_(source, target),
        verdict_(verdict),
        from_a_(options.source_start),
        from_b_(options.target_start),
        cycles_(a_, b_, first_a_, first_b_, options) {}

  void run() {
    while (walk()) {
    }
  }

 private:
  /// Side by side to the end or to a difference; true: that was one of a cycle, and the comparison goes on behind it.
  bool walk() {
    while (i_ < a_.size() && j_ < b_.size()) {
      if (!step()) return false;
    }
    while (i_ < a_.size() && passed_over(*a_[i_], from_a_, from_b_)) take_a();
    while (j_ < b_.size() && passed_over(*b_[j_], from_b_, from_a_)) take_b();
    if (i_ < a_.size()) {
      return differ(fmt::format("the translation ends too early: {} of the source has no counterpart",
                                interpreter::name(a_[i_]->kind)),
                    i_, b_.size());
    }
    if (j_ < b_.size()) {
      return differ(fmt::format("the translation does more: {} has no counterpart in the source",
                                interpreter::name(b_[j_]->kind)),
                    a_.size(), j_);
    }
    return false;
  }

  bool step() {
    if (const auto* run = cycles_.begins(i_); run != nullptr && run != cycle_) {
      cycle_ = run;
      before_cycle_ = {i_, j_, from_a_, from_b_};
      verdict_before_ = verdict_;
    }
    const Event& a = *a_[i_];
    const Event& b = *b_[j_];
    if (a.kind != b.kind) {
      // A move below the tolerance may exist on one side only (rounded away).
      if (passed_over(a, from_a_, from_b_)) return take_a();
      if (passed_over(b, from_b_, from_a_)) return take_b();
      const bool stops = b.kind == EventKind::end && !b.text.empty();
      return differ(fmt::format("{} there, {} here{}{}", interpreter::name(a.kind), interpreter::name(b.kind),
                                stops ? ": " : "", stops ? b.text : std::string()),
                    i_, j_);
    }
    if (is_motion(a.kind)) return step_motion(a, b);
    if (a.kind == EventKind::dwell) return step_dwell();
    const std::string what = command_difference(a, b, options_, tools_);
    if (!what.empty()) return differ(what, i_, j_);
    if (a.kind == EventKind::spindle) rpm_[a.number] = a.state == "off" || a.css ? 0 : a.value;
    ++verdict_.events;
    ++i_;
    ++j_;
    return true;
  }

  /// Dwells that follow each other are one. Revolutions of a known speed are a time.
  bool step_dwell() {
    const Dwells a(a_, i_), b(b_, j_);
    if (!a.same(b, rpm_, options_.tolerances.seconds))
      return differ(fmt::format("dwell of {} in the source, {} in the translation", a.said(), b.said()), i_, j_);
    verdict_.events += std::max(a.parts.size(), b.parts.size());
    i_ += a.parts.size();
    j_ += b.parts.size();
    return true;
  }

  bool step_motion(const Event& a, const Event& b) {
    const double apart = distance(a.to, b.to);
    if (!ends_agree(a.to, b.to)) {
      const bool straight = a.kind == EventKind::linear || a.kind == EventKind::rapid;
      if (straight && same_feed(a, b) && tool_difference(a, b).empty()) {
        // One side has split the move: the shorter part must lie on the longer one, ahead of the parts before it.
        if (part_of(a.to, from_a_, from_b_, b.to)) return take_part(true);
        if (part_of(b.to, from_b_, from_a_, a.to)) return take_part(false);
      }
      if (passed_over(a, from_a_, from_b_)) return take_a();
      if (passed_over(b, from_b_, from_a_)) return take_b();
      return differ(end_difference(a, b), i_, j_);
    }
    std::string what = motion_difference(a, b);
    if (what.empty()) what = tool_difference(a, b);
    if (what.empty()) what = offsets_.difference(a, b);
    if (what.empty()) what = zero_difference(a, b);
    if (what.empty()) what = corner_difference(a, b);
    if (!what.empty() && a.kind == EventKind::arc && passed_over(a, from_a_, from_b_)) return take_a();
    if (!what.empty() && a.kind == EventKind::arc && passed_over(b, from_b_, from_a_)) return take_b();
    if (!what.empty()) return differ(what, i_, j_);
    if (a.zero_open && options_.zero_is_open) ++verdict_.open_zero_moves;
    verdict_.max_length = std::max(verdict_.max_length, apart);
    ++verdict_.events;
    ++verdict_.moves;
    from_a_ = a.to;
    from_b_ = b.to;
    part_.reset();
    ++i_;
    ++j_;
    return true;
  }

  /// A part of a move that the other side makes in one: the rest has to follow.
  bool take_part(bool of_source) {
    part_ = std::pair(i_, j_);
    return of_source ? take_a() : take_b();
  }

  bool take_a() {
    if (is_motion(a_[i_]->kind)) from_a_ = a_[i_]->to;
    ++i_;
    ++verdict_.events;
    return true;
  }
  bool take_b() {
    if (is_motion(b_[j_]->kind)) from_b_ = b_[j_]->to;
    ++j_;
    ++verdict_.events;
    return true;
  }

  /// Cycles whose moves differ are compared by what they leave; true: that is the same, both stand behind them.
  bool similar_cycles(std::string& what) {
    if (cycle_ == nullptr || !cycles_.about(*cycle_, before_cycle_, {i_, j_, {}, {}})) return false;
    std::string why;
    Verdict verdict = verdict_before_;
    double apart = 0;
    const auto behind = cycles_.skip(*cycle_, before_cycle_, apart, why);
    if (!why.empty()) what = why;
    if (!behind) return false;
    verdict.events += std::max(behind->i - before_cycle_.i, behind->j - before_cycle_.j);
    ++verdict.similar_cycles;
    verdict.max_length = std::max(verdict.max_length, apart);
    verdict.similar_length = std::max(verdict.similar_length, apart);
    verdict_ = verdict;
    i_ = behind->i;
    j_ = behind->j;
    from_a_ = behind->from_a;
    from_b_ = behind->from_b;
    part_.reset();
    cycle_ = nullptr;
    return true;
  }

  bool differ(std::string what, std::size_t i, std::size_t j) {
    const std::string plain = what;
    if (similar_cycles(what)) return true;
    if (what != plain) part_.reset();
    if (part_ && !ends_agree(from_a_, from_b_)) {  // the rest of a longer move did not come: that move differs
      i = part_->first;
      j = part_->second;
      what = end_difference(*a_[i], *b_[j]);
    }
    auto& d = verdict_.difference;
    d.what = std::move(what);
    d.source_event = i;
    d.target_event = j;
    if (i < a_.size() || !a_.empty()) {
      const Event& e = *a_[std::min(i, a_.size() - 1)];
      d.source_file = e.file;
      d.source_line = e.line;
    }
    if (j < b_.size() || !b_.empty()) {
      const Event& e = *b_[std::min(j, b_.size() - 1)];
      d.target_file = e.file;
      d.target_line = e.line;
      d.target_code = e.code;
    }
    verdict_.status = Status::differs;
    return false;
  }

  static std::uint32_t common(const Position& a, const Position& b) { return a.known & b.known; }

  static double distance(const Position& a, const Position& b) {
    double sum = 0;
    const std::uint32_t axes = common(a, b);
    for (std::size_t k = 0; k < a.value.size(); ++k) {
      if ((axes >> k & 1U) != 0) sum += (a.value[k] - b.value[k]) * (a.value[k] - b.value[k]);
    }
    return std::sqrt(sum);
  }

  [[nodiscard]] bool ends_agree(const Position& a, const Position& b) const {
    const std::uint32_t axes = common(a, b);
    for (std::size_t k = 0; k < a.value.size(); ++k) {
      if ((axes >> k & 1U) == 0) continue;
      constexpr double rounding = 1e-12;  // of a computed number, however large
      const double tolerance = rotary(k) ? options_.tolerances.angle : options_.tolerances.length;
      if (std::fabs(a.value[k] - b.value[k]) > std::fmax(tolerance, rounding * std::fabs(a.value[k]))) return false;
    }
    return true;
  }

  /// `p` strictly between `from` and `to`, on the line, within the tolerance.
  [[nodiscard]] bool on_segment(const Position& p, const Position& from, const Position& to) const {
    const double whole = distance(from, to);
    const double part = distance(from, p);
    if (whole <= options_.tolerances.length || part >= whole) return false;
    Position foot = from;
    for (std::size_t k = 0; k < foot.value.size(); ++k) foot.value[k] += (to.value[k] - from.value[k]) * part / whole;
    return ends_agree(p, foot);
  }

  /// `p` lies on the move `from` - `to` of the other side, and ahead of `before`, where this side stands on it.
  [[nodiscard]] bool part_of(const Position& p, const Position& before, const Position& from,
                             const Position& to) const {
    return on_segment(p, from, to) && on_segment(p, before, to);
  }

  /// A move below the tolerance that one side makes alone: behind it both tools must stand together, so that a row of
  /// such moves leads nowhere.
  [[nodiscard]] bool passed_over(const Event& e, const Position& from, const Position& other) const {
    return negligible(e, from) && ends_agree(e.to, other);
  }

  [[nodiscard]] bool negligible(const Event& e, const Position& from) const {
    if (e.kind == EventKind::arc) return distance(from, e.to) <= options_.tolerances.length && short_arc(e, from);
    if (e.kind != EventKind::linear && e.kind != EventKind::rapid) return false;
    return common(from, e.to) != 0 && distance(from, e.to) <= options_.tolerances.length;
  }

  /// Less than the tolerance along the arc: no (nearly) full circle.
  [[nodiscard]] bool short_arc(const Event& e, const Position& from) const {
    const auto [u, v, w] = ir::plane_axes(e.plane);
    (void)w;
    if (e.turns != 0 || (from.known >> u & 1U) == 0 || (from.known >> v & 1U) == 0) return false;
    const double radius = std::hypot(e.to.value[u] - e.center_u, e.to.value[v] - e.center_v);
    const double start = std::atan2(from.value[v] - e.center_v, from.value[u] - e.center_u);
    const double end = std::atan2(e.to.value[v] - e.center_v, e.to.value[u] - e.center_u);
    constexpr double full = 6.283185307179586;
    double sweep = e.cw ? start - end : end - start;
    if (sweep <= 0) sweep += full;
    return radius * sweep <= options_.tolerances.length;
  }

  [[nodiscard]] bool same_feed(const Event& a, const Event& b) const {
    if (a.kind == EventKind::rapid) return true;
    if (a.feed_mode != b.feed_mode) return false;
    const bool same_spindle = a.feed_mode != ir::FeedMode::per_rev || a.number == b.number;
    return same_spindle && (a.feed == 0 || close_relative(a.feed, b.feed, options_.tolerances.feed_relative));
  }

  static std::string end_difference(const Event& a, const Event& b) {
    std::string there, here;
    const std::uint32_t axes = common(a.to, b.to);
    for (std::size_t k = 0; k < a.to.value.size(); ++k) {
      if ((axes >> k & 1U) == 0 || std::fabs(a.to.value[k] - b.to.value[k]) <= exact) continue;
      there += fmt::format(" {}{}", axis_label(k), shortest(a.to.value[k]));
      here += fmt::format(" {}{}", axis_label(k), shortest(b.to.value[k]));
    }
    return fmt::format("end of the {} move:{} in the source,{} in the translation", interpreter::name(a.kind), there,
                       here);
  }

  /// The path of the tool's centre under radius compensation: with the same move, on the same side of it in the same
  /// plane, it is the same for every radius.
  static std::string centre_difference(const Event& a, const Event& b) {
    if (a.centre_side == b.centre_side && (a.centre_side == ir::CompSide::off || a.plane == b.plane)) return {};
    const auto place = [](const Event& e) {
      if (e.centre_side == ir::CompSide::off) return std::string("on it");
      return fmt::format("{} of it in the plane {}", ir::name(e.centre_side), ir::name(e.plane));
    };
    return fmt::format("the centre of the tool at the {} move is {} in the source, {} in the translation",
                       interpreter::name(a.kind), place(a), place(b));
  }

  /// Where the tool stands beside the programmed point. It holds for every part of a move.
  [[nodiscard]] std::string tool_difference(const Event& a, const Event& b) const {
    const std::string centre = centre_difference(a, b);
    return centre.empty() ? offset_difference(a, b) : centre;
  }

  /// By which zero point a move goes: coordinates of the machine or of the work, and of which work where no offset is
  /// selected.
  [[nodiscard]] std::string zero_difference(const Event& a, const Event& b) const {
    const auto place = [](const Event& e) { return e.in_machine ? "of the machine" : "of the work"; };
    if (a.in_machine != b.in_machine)
      return fmt::format("the {} move goes by coordinates {} in the source, {} in the translation",
                         interpreter::name(a.kind), place(a), place(b));
    if (options_.selects_zero && b.zero_open)
      return fmt::format(
          "the {} move of the translation goes by the zero point that its machine has at the start: no "
          "work offset is selected",
          interpreter::name(a.kind));
    return {};
  }

  /// Where a move follows a control that does not stop rounds the corner.
  [[nodiscard]] std::string corner_difference(const Event& a, const Event& b) const {
    const auto &there = a.stop, &here = b.stop;
    if (!cuts(a) || there.exact == here.exact) return {};
    if (!has_corner(a_, i_, from_a_) || !has_corner(b_, j_, from_b_)) return {};
    const bool asked = options_.stops_by_mode || (there.in_block && options_.stops_in_block);
    if (there.exact && !asked) return {};
    const auto text = [](bool exact) { return exact ? "stops exactly at its end" : "goes on round the corner"; };
    return fmt::format("the {} move {} in the source, and {} in the translation", interpreter::name(a.kind),
                       text(there.exact), text(here.exact));
  }
  /// Another move follows, and not straight back the way that this one came: where the path turns round (the bottom of
  /// a hole) it stands still in any case.
  [[nodiscard]] bool has_corner(const std::vector<const Event*>& events, std::size_t k, const Position& from) const {
    const Event& e = *events[k];
    const auto next = std::find_if(events.begin() + static_cast<std::ptrdiff_t>(k) + 1, events.end(),
                                   [](const Event* n) { return is_barrier(n->kind); });
    if (next == events.end() || !is_motion((*next)->kind)) return false;
    const auto straight = [](const Event& m) { return m.kind == EventKind::linear || m.kind == EventKind::rapid; };
    if (!straight(e) || !straight(**next) || (e.to.known & ~from.known) != 0) return true;
    const Position& to = (*next)->to;
    return !ends_agree(from, to) && !on_segment(to, e.to, from) && !on_segment(from, e.to, to);
  }

  /// An axis that stands with the offset of the tool on one side and without on the other stands elsewhere on a real
  /// machine.
  [[nodiscard]] std::string offset_difference(const Event& a, const Event& b) const {
    const std::uint32_t known = known_of_source(a, options_.switches_length);
    // Before its first D the source works with what its machine has; a word of the translation that selects an offset,
    // or none, does not.
    const std::uint32_t said =
        (~a.offset.known & b.offset.known & ~b.offset.unsaid) | (a.offset.of_start & b.offset.selected);
    const std::uint32_t open = !options_.offset_of_start || a.in_machine || b.in_machine ? 0 : said;
    const std::uint32_t here = (a.offset.with ^ b.offset.with) & known & b.offset.known;
    const std::uint32_t other =
        (here | open | (a.offset.with & known & ~a.offset.elsewhere & b.offset.elsewhere)) & common(a.to, b.to);
    if (other == 0) return {};
    const auto axis = static_cast<std::size_t>(std::countr_zero(other));
    const auto text = [axis](const Event& e) {
      if ((e.offset.elsewhere >> axis & 1U) != 0) return "in a plane where the length acts along another axis";
      if ((e.offset.of_start >> axis & 1U) != 0) return "with the tool offset of the start";
      const auto with = e.offset.with | (e.offset.selected & ~e.offset.known);
      return (with >> axis & 1U) != 0 ? "with a tool offset" : "without tool offset";
    };
    return fmt::format("the {} move brings {} to its end {} in the source, {} in the translation",
                       interpreter::name(a.kind), axis_label(axis), text(a), text(b));
  }

  std::string motion_difference(const Event& a, const Event& b) {
    if (a.kind != EventKind::rapid && a.kind != EventKind::thread && !same_feed(a, b)) {
      const auto spindle = [&](const Event& e) {
        return a.feed_mode == b.feed_mode && a.number != b.number ? fmt::format(", spindle {}", e.number) : "";
      };
      return fmt::format("feed {} ({}{}) in the source, {} ({}{}) in the translation", shortest(a.feed),
                         ir::name(a.feed_mode), spindle(a), shortest(b.feed), ir::name(b.feed_mode), spindle(b));
    }
    if (a.kind != EventKind::rapid && a.kind != EventKind::thread && a.feed == 0 && b.feed != 0) ++verdict_.unfed_moves;
    if (a.kind == EventKind::arc) return arc_difference(a, b);
    if (a.kind == EventKind::thread && (!close_relative(a.pitch, b.pitch, options_.tolerances.feed_relative) ||
                                        std::fabs(a.pitch_change - b.pitch_change) > exact ||
                                        std::fabs(a.start_angle - b.start_angle) > options_.tolerances.angle)) {
      return fmt::format("thread pitch {} in the source, {} in the translation (or its change or start angle)",
                         shortest(a.pitch), shortest(b.pitch));
    }
    if (a.kind == EventKind::thread) return stroke_difference(a, b, options_.tolerances);
    if (a.kind == EventKind::probe && a.change != b.change)
      return fmt::format("probing {} the part in the source, {} in the translation", a.change ? "toward" : "away from",
                         b.change ? "toward" : "away from");
    return {};
  }

  std::string arc_difference(const Event& a, const Event& b) {
    if (a.plane != b.plane)
      return fmt::format("arc in plane {} in the source, {} in the translation", ir::name(a.plane), ir::name(b.plane));
    if (a.cw != b.cw)
      return fmt::format("arc {} in the source, {} in the translation", a.cw ? "clockwise" : "counter-clockwise",
                         b.cw ? "clockwise" : "counter-clockwise");
    if (a.turns != b.turns)
      return fmt::format("{} added full turns in the source, {} in the translation", a.turns, b.turns);
    double apart = std::hypot(a.center_u - b.center_u, a.center_v - b.center_v);
    if (apart > options_.tolerances.center && a.turns == 0) apart = std::min(apart, paths_apart(a, b));
    if (apart > options_.tolerances.center) {
      return fmt::format("arc centre {} {} in the source, {} {} in the translation", shortest(a.center_u),
                         shortest(a.center_v), shortest(b.center_u), shortest(b.center_v));
    }
    verdict_.max_length = std::max(verdict_.max_length, apart);
    // A tiny arc and a full circle have the same end point: they must be the same on both sides.
    const auto full = [this](const Event& e, const Position& from) {
      return distance(from, e.to) <= options_.tolerances.length && !short_arc(e, from);
    };
    const bool full_a = full(a, from_a_), full_b = full(b, from_b_);
    if (full_a != full_b)
      return fmt::format("{} in the source, {} in the translation", full_a ? "a full circle" : "an arc",
                         full_b ? "a full circle" : "an arc");
    return {};
  }

  /// How far the paths of two arcs of one plane and sense lie apart; beyond all measure where a start is not known.
  [[nodiscard]] double paths_apart(const Event& a, const Event& b) const {
    const auto [u, v, w] = ir::plane_axes(a.plane);
    (void)w;
    const std::uint32_t both = 1U << u | 1U << v;
    if ((from_a_.known & from_b_.known & both) != both) return std::numeric_limits<double>::infinity();
    const auto arc = [u = u, v = v](const Event& e, const Position& from) {
      return ir::geometry::PlaneArc{
          {from.value[u], from.value[v]}, {e.to.value[u], e.to.value[v]}, {e.center_u, e.center_v}};
    };
    return ir::geometry::apart(arc(a, from_a_), arc(b, from_b_), !a.cw);
  }

  std::vector<const Event*> a_, b_;
  const Event *first_a_, *first_b_;  ///< of the traces before normalisation
  const Options& options_;
  ToolNames tools_;
  OffsetNumbers offsets_;
  Verdict& verdict_;
  std::size_t i_ = 0, j_ = 0;
  Position from_a_, from_b_;
  SpindleSpeeds rpm_;
  CyclePairs cycles_;
  const interpreter::CycleRun* cycle_ = nullptr;  ///< of the source: the last one that has begun
  PairPlace before_cycle_;
  Verdict verdict_before_;
  std::optional<std::pair<std::size_t, std::size_t>> part_;  ///< events of a split move and of the whole one
};

}  // namespace

Verdict compare(const std::vector<Event>& source, const std::vector<Event>& target, const Options& options) {
  Verdict verdict;
  verdict.status = Status::verified;
  Comparison(source, target, options, verdict).run();
  if (verdict.status != Status::verified) return verdict;
  // An empty trace never verifies: nothing was proved.
  const auto moved = [](const std::vector<Event>& events) {
    return std::any_of(events.begin(), events.end(), [](const Event& e) { return is_motion(e.kind); });
  };
  if (!moved(source) || !moved(target)) {
    verdict.status = Status::nothing_to_compare;
  } else if (verdict.max_length > exact || verdict.similar_cycles > 0) {
    verdict.status = Status::within_tolerance;
  }
  return verdict;
}

void add_distance(Verdict& sum, const Verdict& further) {
  sum.max_length = std::max(sum.max_length, further.max_length);
  if (further.status == Status::within_tolerance) sum.status = further.status;
}

bool close_relative(double a, double b, double tolerance) {
  constexpr double half_place = 0.00051;  // of the third decimal
  return std::fabs(a - b) <= std::max(half_place, tolerance * std::max(std::fabs(a), std::fabs(b)));
}

}  // namespace cnctrans::verifier
