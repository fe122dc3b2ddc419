#include "verifier/piecewise.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "verifier/normalise.h"

namespace cnctrans::verifier {

using interpreter::Event;
using interpreter::EventKind;

namespace {

constexpr std::size_t piece = 20'000;      ///< events that are waited for
constexpr std::size_t longest = 200'000;   ///< without a place to end
constexpr std::size_t around = 4;          ///< moves on both sides of such a place that must be alike
constexpr std::size_t places_tried = 500;  ///< from the end of the piece back

std::vector<std::size_t> moves_of(const std::vector<Event>& events) {
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (is_motion(events[i].kind)) at.push_back(i);
  }
  return at;
}

/// A straight move to the same place.
bool alike(const Event& a, const Event& b, double length) {
  if (a.kind != b.kind || (a.kind != EventKind::rapid && a.kind != EventKind::linear)) return false;
  const std::uint32_t axes = a.to.known & b.to.known;
  for (std::size_t k = 0; k < a.to.value.size(); ++k) {
    if ((axes >> k & 1U) != 0 && std::fabs(a.to.value[k] - b.to.value[k]) > length) return false;
  }
  return true;
}

/// A later event of this kind says all that an earlier one has said.
bool same_state(const Event& a, const Event& b) {
  if (a.kind != b.kind) return false;
  switch (a.kind) {
    case EventKind::spindle: return a.number == b.number;
    case EventKind::tool: return a.change == b.change;
    case EventKind::coolant:
    case EventKind::comp:
    case EventKind::offset: return true;
    default: return false;
  }
}

bool is_state(EventKind k) {
  return k == EventKind::spindle || k == EventKind::tool || k == EventKind::coolant || k == EventKind::comp ||
         k == EventKind::offset;
}

std::vector<Event> take_front(std::vector<Event>& from, std::size_t count) {
  const auto end = from.begin() + static_cast<std::ptrdiff_t>(count);
  std::vector<Event> front(std::make_move_iterator(from.begin()), std::make_move_iterator(end));
  from.erase(from.begin(), end);
  return front;
}

}  // namespace

void PiecewiseComparison::keep_state(const Events& done, Events& rest, std::size_t& kept) const {
  Events state;
  for (const auto& e : done) {
    if (!is_state(e.kind)) continue;
    std::erase_if(state, [&e](const Event& before) { return same_state(before, e); });
    state.push_back(e);
  }
  kept = state.size();
  rest.insert(rest.begin(), std::make_move_iterator(state.begin()), std::make_move_iterator(state.end()));
}

bool PiecewiseComparison::compare_piece(Events a, Events b) {
  const Events state_a(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(kept_source_));
  const Events state_b(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(kept_target_));
  const Verdict v = compare(a, b, options_);
  const bool nothing = v.status == Status::nothing_to_compare && !first_;  // the end alone
  if (!v.good() && !nothing) return false;
  verdict_.events += v.events - (first_ ? 0 : compare(state_a, state_b, options_).events);
  verdict_.moves += v.moves;
  verdict_.unfed_moves += v.unfed_moves;
  verdict_.open_zero_moves += v.open_zero_moves;
  verdict_.max_length = std::max(verdict_.max_length, v.max_length);
  if (first_ || v.status == Status::within_tolerance) verdict_.status = v.status;
  first_ = false;
  const auto last_move = [](const Events& events, interpreter::Position& at) {
    const auto it = std::find_if(events.rbegin(), events.rend(), [](const Event& e) { return is_motion(e.kind); });
    if (it != events.rend()) at = it->to;
  };
  last_move(a, options_.source_start);
  last_move(b, options_.target_start);
  keep_state(a, source, kept_source_);
  keep_state(b, target, kept_target_);
  return true;
}

bool PiecewiseComparison::advance() {
  if (std::min(source.size(), target.size()) < piece) return std::max(source.size(), target.size()) < longest;
  const auto a = moves_of(source), b = moves_of(target);
  const std::size_t moves = std::min(a.size(), b.size());
  const auto good_place = [&](std::size_t n) {
    for (std::size_t m = n - around; m <= n + around; ++m) {
      if (!alike(source[a[m]], target[b[m]], options_.tolerances.length)) return false;
    }
    return true;
  };
  for (std::size_t tried = 0; tried < places_tried && moves > 2 * around + tried; ++tried) {
    const std::size_t n = moves - 1 - around - tried;
    if (n < around) break;
    if (!good_place(n)) continue;
    Events left = take_front(source, a[n] + 1), right = take_front(target, b[n] + 1);
    return compare_piece(std::move(left), std::move(right));
  }
  return std::max(source.size(), target.size()) < longest;
}

bool PiecewiseComparison::finish() {
  Events left = std::exchange(source, {}), right = std::exchange(target, {});
  return compare_piece(std::move(left), std::move(right));
}

}  // namespace cnctrans::verifier
