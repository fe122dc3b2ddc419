// The spindles of a machine: what each is told, and what the trace has shown of it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "interpreter/trace/trace.h"
#include "ir/block.h"

namespace cnctrans::interpreter {

struct Spindle {
  ir::SpindleMode mode = ir::SpindleMode::rpm;
  ir::SpindleState state = ir::SpindleState::off;
  bool oriented = false;
  std::array<double, 2> value{};  ///< by SpindleMode: revolutions a minute, metres a minute
  bool has_limit = false;
  double limit = 0;  ///< revolutions a minute
  double angle = 0;  ///< degrees, of the last orientation

  [[nodiscard]] double speed() const { return value[static_cast<std::size_t>(mode)]; }
  [[nodiscard]] double rpm() const { return value[static_cast<std::size_t>(ir::SpindleMode::rpm)]; }
  [[nodiscard]] double cutting_speed() const { return value[static_cast<std::size_t>(ir::SpindleMode::css)]; }
  [[nodiscard]] double limit_in_force() const { return has_limit ? limit : 0; }
  [[nodiscard]] bool turns() const { return state != ir::SpindleState::off; }

  void set_speed(double v) { value[static_cast<std::size_t>(mode)] = v; }
  void set_rpm(double v) { value[static_cast<std::size_t>(ir::SpindleMode::rpm)] = v; }
  void set_limit(double v) {
    has_limit = true;
    limit = v;
  }
  void run(ir::SpindleState s) {
    state = s;
    oriented = false;
  }
  void orient(double at) {
    oriented = true;
    state = ir::SpindleState::off;
    angle = at;
  }
  /// Leaving constant cutting speed without a new S keeps the speed reached: n = 1000 v / (pi d).
  void set_mode(ir::SpindleMode m, bool with_value, double diameter) {
    if (m == ir::SpindleMode::rpm && mode == ir::SpindleMode::css && !with_value) {
      const double n = diameter > 0 ? 1000 * cutting_speed() / (std::numbers::pi * diameter) : limit;
      set_rpm(has_limit ? std::min(n, limit) : n);
    }
    mode = m;
  }

  /// Speed, mode or limit are others than the last event showed.
  [[nodiscard]] bool changed() const {
    return mode != shown_.mode || speed() != shown_.value || limit_in_force() != shown_.limit;
  }
  [[nodiscard]] bool mode_changed() const { return mode != shown_.mode; }
  /// Its event shows it as it is now.
  void show(Event& e) {
    e.state = oriented                         ? "oriented"
              : state == ir::SpindleState::cw  ? "cw"
              : state == ir::SpindleState::ccw ? "ccw"
                                               : "off";
    e.css = mode == ir::SpindleMode::css;
    e.value = speed();
    e.has_limit = has_limit;
    e.limit = limit;
    e.angle = angle;
    shown_ = {mode, speed(), limit_in_force()};
  }

 private:
  struct Shown {
    ir::SpindleMode mode = ir::SpindleMode::rpm;
    double value = 0, limit = 0;
  };
  Shown shown_;
};

class Spindles {
 public:
  explicit Spindles(ir::SpindleMode mode) {
    for (auto& s : all_) s.mode = mode;
  }
  /// Null: there is none of this number.
  Spindle* find(int number) {
    return number >= 0 && number < static_cast<int>(all_.size()) ? &all_[static_cast<std::size_t>(number)] : nullptr;
  }
  [[nodiscard]] const Spindle& first() const { return all_[1]; }
  Spindle& operator[](int number) { return all_[static_cast<std::size_t>(number)]; }
  /// The one that feed, threads and cycles follow.
  [[nodiscard]] std::uint8_t master_number() const { return master_; }
  Spindle& master() { return all_[master_]; }
  [[nodiscard]] const Spindle& master() const { return all_[master_]; }
  void make_master(std::uint8_t number) { master_ = number; }

 private:
  std::array<Spindle, 32> all_{};
  std::uint8_t master_ = 1;
};

}  // namespace cnctrans::interpreter
