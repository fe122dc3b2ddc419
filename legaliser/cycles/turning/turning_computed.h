// Turning cycles whose words only the run knows, written out: the moves of ir/cycles/turning/threading.cpp,
// counted_threads.cpp and turning.cpp with expressions for numbers, and loops over the passes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "legaliser/cycles/parts/cycle_parts.h"

namespace cnctrans::ir::passes {

/// Where the tool stands when the cycle is called, as absolute words of the program would say it; nullopt: not known.
struct TurnStart {
  std::optional<Value> x, z;
};

/// The moves of a machining cycle as blocks, loops and assignments in the source's units.
class ComputedTurn {
 public:
  /// `modes`: units and diameters in force. `nose_width` in mm, 0: not known.
  ComputedTurn(const NamedCycle& cycle, const LineInfo& like, const ModalState& modes, TurnStart start,
               double nose_width, Editor& editor);
  ~ComputedTurn();
  ComputedTurn(const ComputedTurn&) = delete;
  ComputedTurn& operator=(const ComputedTurn&) = delete;

  /// nullopt: `error` says why it can't be told.
  std::optional<Body> run();
  std::string error;
  FeedBefore usual_feed;  ///< in force before the cycle

 private:
  /// An axis by its role: one unit of a radius length is `k` units of its words.
  struct Role {
    AxisId axis = axis::z;
    double k = 1;
  };
  struct Spot {
    std::optional<Value> p, q;
  };

  bool fail(std::string text);
  [[nodiscard]] const Value* find(std::string_view name) const;
  [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }
  [[nodiscard]] Value word(std::string_view name, double otherwise = 0) const;
  /// A number; fails when it is computed.
  double number_word(std::string_view name, double otherwise = 0);
  [[nodiscard]] Value coordinate(bool of_p, bool end) const;

  std::optional<VarRef> variable_of(const Value& v);
  Value kept(const Value& v);
  void set(const VarRef& v, const Value& value);
  void when(ExprPtr condition, const VarRef& v, const Value& value);
  Value magnitude(const Value& v);
  /// +1 or -1.
  Value sign_of(const Value& v);
  /// base + by * k, `by` a length.
  Value moved(const Value& base, const Role& role, const Value& by) const;
  Value tangent(const Value& degrees);

  void move(MotionKind kind, const Spot& to);
  void rapid(const Spot& to) { move(MotionKind::rapid, to); }
  void feed(const Spot& to) { move(MotionKind::linear, to); }
  void thread(const Spot& to, const Value& angle);
  /// The body of a loop is built between these two.
  Body* open(Body& inner);
  void close_while(Body* outer, ExprPtr condition, Body&& inner);

  bool thread_by_section();
  bool law(const Value& rough, const VarRef& d, const VarRef& n);
  void pass(const Value& d);
  bool thread_by_count();
  bool counted_starts(const Value& passes, const Value& rough, const Value& stock, const Value& idle, bool falling);
  void counted_pass(const Value& h);
  bool thread_from_here();
  bool groove();
  void feed_at(const Spot& to, const Value& f);
  void withdraw_along(const Value& now, const Value& then, const Value& height, const Value& there, const Spot& last);
  Value slope_of(const Value& rise, const Value& way);
  bool straight();

  const NamedCycle& cycle_;
  LineInfo like_;
  double unit_ = 1;
  Role p_, q_;
  TurnStart start_;
  double nose_width_ = 0;
  Editor& editor_;
  std::vector<VarRef> taken_;
  Body out_;
  Body* body_ = &out_;

  // of the thread at hand
  Value first_p_, last_p_, first_q_, last_q_, safe_first_, safe_last_, depth_, out_sign_, dir_, tan_, pitch_, change_,
      angle_;
  int entry_ = 0;
  double starts_ = 1;
  std::optional<VarRef> side_;
  bool has_exit_ = false, alternates_ = false;
  AxisId lead_axis_ = axis::z;
};

}  // namespace cnctrans::ir::passes
