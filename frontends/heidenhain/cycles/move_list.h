// The steps of a cycle that is told by what it does, in their order.
#pragma once

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/noise.h"
#include "dialects/heidenhain/limits.h"
#include "frontends/heidenhain/cycles/build.h"

namespace cnctrans::frontends::heidenhain {

class MoveList {
 public:
  using Kind = CycleMove::Kind;

  /// Along the tool axis. A move that goes nowhere is left out.
  void rapid(const ir::Value& w) { along(Kind::rapid, w, 0); }
  /// FMAX and the numbers that programs write for it are rapid.
  void feed(const ir::Value& w, double f) {
    const bool fast = f >= dialects::heidenhain::rapid_stand_in;
    along(fast ? Kind::rapid : Kind::feed, w, f);
  }
  /// In the plane; no feed: rapid. `w`: to that height at the same time.
  void plane(PlaneMove to, std::optional<double> f = {}, std::optional<ir::Value> w = {}) {
    CycleMove& m = put(f ? Kind::feed : Kind::rapid, f.value_or(0));
    m.plane = std::move(to);
    if (!w) return;
    at_ = w;
    m.w = std::move(w);
  }
  void arc(PlaneMove to, bool ccw, double f) { put(ccw ? Kind::arc_ccw : Kind::arc_cw, f).plane = std::move(to); }
  void dwell(double seconds) {
    if (seconds > 0) put(Kind::dwell, seconds);
  }
  void thread(ir::Value by, ir::Value lead) {
    at_.reset();
    CycleMove& m = put(Kind::thread, 0);
    m.w = std::move(by);
    m.lead = std::move(lead);
  }
  void spindle_stop() { put(Kind::spindle_stop, 0); }
  void spindle(int code, double speed) { put(Kind::spindle, speed).code = code; }
  void function(double code) {
    if (code > 0) put(Kind::function, code);
  }
  void cycle(ir::CyclePtr c) {
    at_.reset();
    put(Kind::cycle, 0).cycle = std::move(c);
  }
  void add(CycleMove m) {
    if (m.w) at_ = m.w;
    moves_.push_back(std::move(m));
  }
  [[nodiscard]] std::size_t size() const { return moves_.size(); }
  std::vector<CycleMove> take() { return std::move(moves_); }

 private:
  void along(Kind kind, ir::Value w, double f) {
    constexpr double nothing = 1e-9, places = 1e10;
    if (w.literal()) w = ir::Value(without_noise(w.number, places));
    if (at_ && (ir::equal(*at_, w) || (at_->literal() && w.literal() && std::abs(at_->number - w.number) < nothing)))
      return;
    at_ = w;
    put(kind, f).w = std::move(w);
  }
  CycleMove& put(Kind kind, double amount) {
    CycleMove& m = moves_.emplace_back();
    m.kind = kind;
    m.amount = amount;
    return m;
  }

  std::vector<CycleMove> moves_;
  std::optional<ir::Value> at_;
};

}  // namespace cnctrans::frontends::heidenhain
