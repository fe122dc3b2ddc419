// The motion code that the reader of the written text believes to be in force, beside the one of the IR.
#pragma once

#include <optional>

#include "ir/block.h"
#include "ir/motion_kinds.h"

namespace cnctrans::backends {

/// The code of a cut in a block that does not move.
inline bool is_code_alone(const ir::Motion& m) {
  return m.kind != ir::MotionKind::modal && m.kind != ir::MotionKind::rapid && !m.moves();
}

/// Both agree (whatever they are) as long as every code that is written stays in force in the IR too. A one-shot motion
/// (`keeps_modal` false) breaks that until the next written code.
class MotionTracker {
 public:
  /// `one_shots`: the program has motions that do not stay in force; only then joins of paths lose what is known.
  explicit MotionTracker(bool one_shots = false) : one_shots_(one_shots) {}

  /// Code to write for a motion without one of its own. nullopt: none needed. MotionKind::modal: one is needed, but it
  /// is not known which. `known_before`: what an analysis says about the IR's motion here.
  [[nodiscard]] std::optional<ir::MotionKind> needed(std::optional<ir::MotionKind> known_before) {
    if (in_step_) return std::nullopt;
    const auto kind = ir_ ? ir_ : known_before;
    if (!kind) return ir::MotionKind::modal;
    ir_ = text_ = kind;
    in_step_ = true;
    return kind;
  }
  /// A motion was written with its code, or the code is known to be in force already.
  void wrote(ir::MotionKind written, bool keeps_modal) {
    const ir::MotionKind kind = ir::left_in_force(written);
    text_ = kind;
    if (keeps_modal) {
      ir_ = kind;
      in_step_ = true;
    } else {
      in_step_ = ir_ && *ir_ == kind;
    }
  }
  /// What was written holds for its block only, and `kind` stays in force in the IR.
  void keeps_on(ir::MotionKind kind) {
    ir_ = kind;
    in_step_ = false;
  }
  [[nodiscard]] std::optional<ir::MotionKind> text() const { return text_; }
  /// A label, a call, the border of a structure: control can come from elsewhere.
  void join() {
    text_.reset();
    ir_.reset();
    if (one_shots_) in_step_ = false;
  }
  /// Two ways meet: this one and another. Only what holds on both is known.
  void merge(const MotionTracker& other) {
    in_step_ = in_step_ && other.in_step_;
    if (ir_ != other.ir_) ir_.reset();
    if (text_ != other.text_) text_.reset();
  }
  void start_routine() {
    text_.reset();
    ir_.reset();
    in_step_ = true;
  }

 private:
  bool one_shots_;
  bool in_step_ = true;
  std::optional<ir::MotionKind> ir_, text_;
};

}  // namespace cnctrans::backends
