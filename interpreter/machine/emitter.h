// Hands events to the sink: counts them, ends at the limit, and holds them back while a corner waits for its second
// element.
#pragma once

#include <cstdint>
#include <vector>

#include "interpreter/trace/trace.h"

namespace cnctrans::interpreter {

class Emitter {
 public:
  Emitter(TraceSink& sink, std::uint64_t max_events) : sink_(sink), left_(max_events) {}

  void emit(const Event& e) {
    if (holding_) {
      held_.push_back(e);
    } else {
      pass(e);
    }
  }
  /// From now on events wait.
  void hold() { holding_ = true; }
  [[nodiscard]] bool holding() const { return holding_; }
  /// Past the held ones: for the moves that come before them.
  void pass(const Event& e) {
    if (left_ == 0) {
      limit_ = true;
      return;
    }
    --left_;
    ++count_;
    sink_.on_event(e);
  }
  /// The held events go out.
  void release() {
    holding_ = false;
    pass_held(held_.size());
    held_.clear();
    passed_ = 0;
  }
  /// How many events wait, and the first `count` of them go out while the others wait on.
  [[nodiscard]] std::size_t held() const { return held_.size(); }
  void pass_held(std::size_t count) {
    for (; passed_ < count; ++passed_) pass(held_[passed_]);
  }
  /// The `end` event is always delivered.
  void finish(const Event& e) {
    release();
    ++count_;
    sink_.on_event(e);
  }
  [[nodiscard]] bool limit_reached() const { return limit_; }
  /// Events so far, the held ones too.
  [[nodiscard]] std::uint64_t seen() const { return count_ + held_.size() - passed_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  TraceSink& sink_;
  std::uint64_t left_;
  std::uint64_t count_ = 0;
  bool limit_ = false;
  bool holding_ = false;
  std::vector<Event> held_;
  std::size_t passed_ = 0;  ///< of them
};

}  // namespace cnctrans::interpreter
