// 241, and pecks of 203 and 205 that no cycle of the IR has (reference 16.x): written as the moves that they are.
#include <algorithm>
#include <cmath>

#include "frontends/heidenhain/cycles/move_list.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;

namespace {

constexpr double nothing = 1e-9;

class PeckMoves {
 public:
  PeckMoves(const std::map<std::int16_t, double>& q, double shift, bool inch)
      : q_(q), surface_(get(203) + shift), depth_(std::abs(get(201))), clear_(surface_ + get(200)), inch_(inch) {}

  std::vector<CycleMove> universal() {
    moves_.rapid(ir::Value(clear_));
    double done = 0, stroke = get(202), breaks = 0;
    bool out = false;
    while (moves_.size() < most_moves) {
      const double next = stroke <= nothing ? depth_ : std::min(done + stroke, depth_);
      if (out) moves_.rapid(ir::Value(surface_ - done + get(200)));
      moves_.feed(ir::Value(surface_ - next), get(206));
      done = next;
      if (depth_ - done < nothing) break;
      out = breaks >= get(213);
      if (out) {
        moves_.rapid(ir::Value(clear_));
        moves_.dwell(get(210));
        breaks = 0;
      } else {
        moves_.feed(ir::Value(surface_ - done + get(256)), get(206));
        ++breaks;
      }
      stroke = shrunk(stroke);
    }
    return end();
  }
  std::vector<CycleMove> pecking() {
    moves_.rapid(ir::Value(clear_));
    double done = std::max(0.0, get(379));
    if (done > nothing) moves_.feed(ir::Value(surface_ - done + get(200)), get(253));
    std::vector<double> bottoms;
    double stroke = get(202);
    for (double at = done; depth_ - at > nothing && bottoms.size() < most_moves; stroke = shrunk(stroke)) {
      at = stroke <= nothing ? depth_ : std::min(at + stroke, depth_);
      bottoms.push_back(at);
    }
    const double entries = std::max(1.0, static_cast<double>(bottoms.size()) - 2);
    for (std::size_t k = 0; k < bottoms.size(); ++k) {
      if (k != 0) {
        moves_.rapid(ir::Value(clear_));
        const double stop = get(258) + (get(259) - get(258)) * static_cast<double>(k - 1) / entries;
        moves_.rapid(ir::Value(surface_ - done + stop));
      }
      const double chip = get(257), lift = get(256);
      for (double at = done + chip; chip > nothing && bottoms[k] - at > nothing && moves_.size() < most_moves;
           at += chip) {
        moves_.feed(ir::Value(surface_ - at), get(206));
        moves_.feed(ir::Value(surface_ - at + lift), facts::chip_break_feed / (inch_ ? 25.4 : 1));
      }
      moves_.feed(ir::Value(surface_ - bottoms[k]), get(206));
      done = bottoms[k];
    }
    return end();
  }

  /// Slowly into the hole that is there already, then at the speed of drilling (241).
  std::vector<CycleMove> single_lip() {
    moves_.rapid(ir::Value(clear_));
    moves_.spindle(static_cast<int>(get(426)), get(427));
    const double start = std::max(0.0, get(379));
    if (start > nothing) moves_.feed(ir::Value(surface_ - start + get(200)), get(253));
    moves_.spindle(3, get(428));
    moves_.function(get(429));
    if (get(435) > nothing && get(435) < depth_) {
      moves_.feed(ir::Value(surface_ - get(435)), get(206));
      moves_.dwell(get(211));
    }
    moves_.feed(ir::Value(surface_ - depth_), get(206));
    moves_.dwell(get(211));
    moves_.function(get(430));
    moves_.spindle(static_cast<int>(get(426)), get(427));
    moves_.feed(ir::Value(clear_), get(208) == 0 ? get(206) : get(208));
    if (get(204) > get(200)) moves_.rapid(ir::Value(surface_ + get(204)));
    return moves_.take();
  }

 private:
  static constexpr std::size_t most_moves = 20'000;
  [[nodiscard]] double get(std::int16_t n) const {
    const auto it = q_.find(n);
    return it == q_.end() ? 0 : it->second;
  }
  [[nodiscard]] double shrunk(double stroke) const {
    return get(212) > nothing ? std::max(stroke - get(212), std::max(get(205), nothing)) : stroke;
  }
  std::vector<CycleMove> end() {
    moves_.dwell(get(211));
    moves_.feed(ir::Value(clear_), get(208) == 0 ? get(206) : get(208));
    if (get(204) > get(200)) moves_.rapid(ir::Value(surface_ + get(204)));
    return moves_.take();
  }

  const std::map<std::int16_t, double>& q_;
  double surface_, depth_, clear_;
  bool inch_;
  MoveList moves_;
};

}  // namespace

std::vector<CycleMove> peck_moves(const CycleDefinition& cycle, const CycleContext& context) {
  std::map<std::int16_t, double> q;
  for (const auto& [number, v] : cycle.values) {
    const bool plain = v.kind == QValue::Kind::value || v.kind == QValue::Kind::rapid;
    const ir::Value now = context.value(number);
    if (!plain || !now.literal()) return {};
    q[number] = now.number;
  }
  if (context.shift && !context.shift->literal()) return {};
  const double shift = context.shift ? context.shift->number : 0;
  if (q[201] >= 0) return {};
  PeckMoves moves(q, shift, context.inch);
  return cycle.number == 241 ? moves.single_lip() : cycle.number == 203 ? moves.universal() : moves.pecking();
}

}  // namespace cnctrans::frontends::heidenhain
