// The straight steps of splines and polynomials as blocks: points, weights and coefficients that are numbers here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ir/geometry/curve.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Settings that mean something to curves only.
bool curve_setting(const Action& a);

class CurveSteps {
 public:
  /// Reads the axes of splines and the scales of the whole program.
  CurveSteps(const Program& program, const LegaliseContext& context);

  /// Appends the blocks of a spline as their steps. `list`: the statements from its first point to its last, `now`: the
  /// facts before them, `following`: see direction_of, `degree`: said before the first point. False with a sentence.
  bool spline(const std::vector<Statement*>& list, MotionKind kind, Facts now, const curves::Point& following,
              const std::optional<Value>& degree, Body& out, std::string& why);
  /// Whether later splines must begin where their first block stands.
  void begins_at_first_point(bool must) { at_first_point_ = must; }
  /// The same of one block with polynomials.
  bool polynomial(Statement& s, const Block& b, const Facts& before, std::optional<OnOff> on, Body& out,
                  std::string& why);
  /// Of a straight move, in the axes of splines; empty: not known.
  [[nodiscard]] curves::Point direction_of(const Statement& s, const Facts& before) const;

 private:
  using Point = curves::Point;
  void find_axes(const Statement& s, bool& chosen);
  bool collect(const std::vector<Statement*>& list, Facts& now, const std::vector<AxisId>& order,
               const std::vector<AxisId>& moved, double unit, curves::SplinePoints& in, std::string& why);
  bool put_steps(Statement&& s, const Facts& before, const std::vector<AxisId>& axes, Point from,
                 const std::vector<Point>& steps, double unit, Body& out);
  [[nodiscard]] double length_unit(AxisId axis, double unit) const;
  void told(const Span& where, std::size_t count) const;

  struct Taken {
    Statement* s = nullptr;
    Facts before;
    Point at;
  };
  const LegaliseContext& context_;
  double tolerance_ = 0.001;
  std::vector<AxisId> group_;  ///< axes of splines
  bool several_groups_ = false, unequal_ = false, at_first_point_ = false;
  std::vector<Taken> taken_;
  std::optional<SplineEnd> last_end_;
  Point last_;  ///< where the steps put out last end
  Span span_;
};

}  // namespace cnctrans::ir::passes
