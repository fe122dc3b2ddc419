// G49, the inclined plane of the mill (25.6).
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "frontends/fagor/statements/expr.h"
#include "frontends/fagor/words/block.h"

namespace cnctrans::fagor {

namespace {

using ir::Function;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

ir::ExprPtr function(Function f, const ir::Value& v) {
  return ir::call(f, {ir::as_expr(v)});
}

/// atan(tan(steep) * cos(other)): the turn behind one about the other axis after which the plane meets the coordinate
/// plane of its own axis at `steep`.
ir::Value by_trace(const ir::Value& steep, const ir::Value& other) {
  if (steep.is(0) || other.is(0)) return steep;
  if (steep.literal() && other.literal())
    return ir::Value(degrees(std::atan(std::tan(radians(steep.number)) * std::cos(radians(other.number)))));
  return ir::Value(ir::call(Function::atan, {ir::binary(ir::BinaryOp::multiply, function(Function::tan, steep),
                                                        function(Function::cos, other))}));
}

/// asin(sin(steep) / cos(other)): the turn before one about the other axis after which the plane itself meets its axis
/// at `steep`. nullopt: no plane forms both angles.
std::optional<ir::Value> by_axis(const ir::Value& steep, const ir::Value& other) {
  if (steep.is(0) || other.is(0)) return steep;
  if (steep.literal() && other.literal()) {
    const double sine = std::sin(radians(steep.number)) / std::cos(radians(other.number));
    if (!(std::abs(sine) <= 1 + 1e-12)) return std::nullopt;
    return ir::Value(degrees(std::asin(std::clamp(sine, -1.0, 1.0))));
  }
  return ir::Value(ir::call(Function::asin, {ir::binary(ir::BinaryOp::divide, function(Function::sin, steep),
                                                        function(Function::cos, other))}));
}

/// The third angle: sin I ^2 + sin J ^2 + sin K ^2 = 1; that of a plane that rises. nullopt: there is none.
std::optional<ir::Value> third_angle(const ir::Value& a, const ir::Value& b) {
  if (!a.literal() || !b.literal()) return std::nullopt;
  const auto square = [](double d) { return std::sin(radians(d)) * std::sin(radians(d)); };
  const double left = 1 - square(a.number) - square(b.number);
  if (left < -1e-12) return std::nullopt;
  return ir::Value(degrees(std::asin(std::sqrt(std::max(left, 0.0)))));
}

std::shared_ptr<const ir::FrameChange> turn_about(ir::AxisId axis, ir::Value angle) {
  ir::FrameChange turn;
  turn.slot = ir::FrameSlot::chain;
  turn.kind = ir::FrameKind::rotate;
  turn.combine = ir::FrameCombine::compose;
  turn.has_angle = true;
  turn.angle = std::move(angle);
  turn.rotation_axis = axis;
  return std::make_shared<const ir::FrameChange>(std::move(turn));
}

}  // namespace

/// G49 T: the plane across the tool. A tool that no rotary axis has turned points along Z, and the plane is not
/// inclined.
void BlockLowerer::along_the_tool(const GWord& g, bool by_axes) {
  if (by_axes) state_.error("FAG-014", g.word->pos, "G49 T takes X Y Z and S [27]");
  state_.facts.tool_planes.push_back(word_span(state_.line(), g.word->pos));
  if (state_.longitudinal_given() != ir::axis::none || state_.plane_now() != ir::Plane::xy)
    state_.error("FAG-014", g.word->pos, "G49 T with another tool axis than Z is not carried", "write G17 before it");
  state_.warning(
      "FAG-054", g.word->pos,
      "the plane across the tool (G49 T): the tool is taken to point along Z, as on a head that no axis turns",
      "write the angles (A B C or Q R S) for a head that is swivelled by hand");
}

/// G49 X Y Z A B C turns about X, the new Y and the new Z, with Q R S about Z, the new Y and the new Z (25.6); alone it
/// ends the plane. All three turns stand in the IR, 0 with the place of the code where the word is missing.
void BlockLowerer::inclined_plane(const GWord& g) {
  constexpr std::array<char, 3> letters{'Q', 'R', 'S'};
  const auto written = [this](char c) { return c == 'R' ? radius_count_ != 0 : letter(c) != nullptr; };
  const bool by_angles = written('I') || written('J') || written('K');
  const bool spherical = !by_angles && std::any_of(letters.begin(), letters.end(), written);
  const Word* tool = take('T');
  const bool by_tool = tool != nullptr;
  if (by_tool &&
      (by_angles || written('Q') || written('R') || tool->has_value || spelling(*g.word, *tool).size() > 8)) {
    state_.error("FAG-014", g.word->pos, "G49 T is followed by X Y Z and S [27]");
    return;
  }
  result_->needs_program = true;
  ir::FrameChange origin;
  origin.slot = ir::FrameSlot::chain;
  origin.combine = ir::FrameCombine::replace;
  std::array<const Word*, 3> turned{};
  for (std::size_t i = 0; i < coord_count_; ++i) {
    const ir::AxisId axis = ir::fixed_axis(word_letter(*coords_[i]));
    if (axis >= ir::axis::a && axis <= ir::axis::c)
      turned[static_cast<std::size_t>(axis - ir::axis::a)] = coords_[i];
    else if (axis <= ir::axis::z)
      origin.words.push_back({axis, value(*coords_[i]), ir::WordScale::modal, coords_[i]->pos});
    else
      state_.error("FAG-014", coords_[i]->pos, "G49 takes X Y Z with A B C or with Q R S [27]");
  }
  const bool by_axes = std::any_of(turned.begin(), turned.end(), [](const Word* w) { return w != nullptr; });
  if (by_axes && (spherical || by_angles))
    state_.error("FAG-014", g.word->pos, "G49 takes A B C or Q R S, not both [27]");
  coords_taken_ = true;
  const bool alone = coord_count_ == 0 && !spherical && !by_tool && !by_angles;
  if (by_tool) along_the_tool(g, by_axes);
  act(ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(origin))}, g.word);
  if (by_tool) out_->actions.back().text = spelling(*g.word, *tool);
  if (alone) {
    state_.facts.inclined_ends.push_back(word_span(state_.line(), g.word->pos));
    return;
  }
  if (!state_.facts.first_inclined_plane.known())
    state_.facts.first_inclined_plane = word_span(state_.line(), g.word->pos);
  if (by_angles) return plane_by_angles(g);
  for (std::size_t i = 0; i < 3; ++i) {
    const Word* w = turned[i];
    if (spherical) w = letters[i] != 'R' ? take(letters[i]) : radius_count_ != 0 ? radii_[0] : nullptr;
    if (spherical && letters[i] == 'R') radii_taken_ = std::min<std::size_t>(radius_count_, 1);
    const ir::AxisId about = spherical ? (i == 1 ? ir::axis::y : ir::axis::z) : static_cast<ir::AxisId>(i);
    act(ir::FrameOp{turn_about(about, w != nullptr ? value(*w) : ir::Value(0))}, w != nullptr ? w : g.word);
  }
}

/// G49 X Y Z I J K R S: two of the angles that the plane forms with X, Y and Z; R0 lays the new X, R1 the new Y on the
/// edge that the plane has with the coordinate plane of that axis and Z; S turns about the new Z (operating manual of
/// the mill, 15.1.1). The turn that reaches the edge comes first. What the manual leaves open is an option (FAG-102).
void BlockLowerer::plane_by_angles(const GWord& g) {
  const Word* i = take('I');
  const Word* j = take('J');
  const Word* k = take('K');
  const Word* s = take('S');
  const Word* r = radius_count_ != 0 ? radii_[0] : nullptr;
  radii_taken_ = std::min<std::size_t>(radius_count_, 1);
  if ((i != nullptr) + (j != nullptr) + (k != nullptr) != 2 || letter('Q') != nullptr) {
    state_.error("FAG-014", g.word->pos, "G49 takes two of the angles I, J, K, with R and S [27]");
    return;
  }
  if (r != nullptr && (r->expr >= 0 || (r->number != 0 && r->number != 1))) {
    state_.error("FAG-014", r->pos, "R says which axis lies on the edge: 0 for X, 1 for Y");
    return;
  }
  const bool along_y = r != nullptr && r->number == 1;
  const bool itself = state_.options().plane_angles == dialects::fagor::PlaneAngles::axis;
  const Word* words[] = {i != nullptr ? i : k, j != nullptr ? j : k};
  const auto refused = [&](const Word& w, std::string text, std::string hint) {
    state_.error("FAG-102", w.pos, std::move(text), std::move(hint));
  };
  ir::Value angle_i = i != nullptr ? value(*i) : ir::Value(0), angle_j = j != nullptr ? value(*j) : ir::Value(0);
  for (const auto& [w, v] : {std::pair{i, &angle_i}, std::pair{j, &angle_j}}) {
    if (w != nullptr && v->literal() && std::abs(v->number) >= 90)
      return refused(*w, "an inclined plane that stands upright is not carried with I J K", "write A B C or Q R S");
  }
  if (k != nullptr) {
    if (!itself)
      return refused(*k, "from which line the angle K of an inclined plane counts is not said",
                     "write I and J, or set the option fagor.plane_angles to axis");
    const auto third = third_angle(i != nullptr ? angle_i : angle_j, value(*k));
    if (!third || third->number > 90 - 1e-9)
      return refused(*k, "no inclined plane that is known here forms these two angles", "write I and J");
    (i == nullptr ? angle_i : angle_j) = *third;
  }
  const bool falls = state_.options().plane_tilt == dialects::fagor::PlaneTilt::falls;
  const ir::Value& first_angle = along_y ? angle_j : angle_i;
  const ir::Value& second_angle = along_y ? angle_i : angle_j;
  std::optional<ir::Value> first = first_angle, second = second_angle;
  if (itself)
    first = by_axis(first_angle, second_angle);
  else
    second = by_trace(second_angle, first_angle);
  if (!first) return refused(*words[0], "no plane forms these two angles with its axes", "their sum is at most 90");
  assume_plane(g, angle_i, angle_j, k != nullptr);
  // About X a plane turned by a positive angle rises toward Y, about Y it falls toward X.
  for (const bool now_x : {along_y, !along_y}) {
    ir::Value turn = now_x == along_y ? *first : *second;
    if (now_x == falls && !turn.is(0)) turn = ir::negate(turn);
    act(ir::FrameOp{turn_about(now_x ? ir::axis::x : ir::axis::y, std::move(turn))}, words[now_x ? 1 : 0]);
  }
  if (r != nullptr) act(ir::FrameOp{turn_about(ir::axis::z, ir::Value(0))}, r);
  act(ir::FrameOp{turn_about(ir::axis::z, s != nullptr ? value(*s) : ir::Value(0))}, s != nullptr ? s : g.word);
}

/// Tells what is taken for granted of the angles, unless the profile says it.
void BlockLowerer::assume_plane(const GWord& g, const ir::Value& i, const ir::Value& j, bool third) {
  const auto& options = state_.profile().options;
  const bool level = i.is(0) && j.is(0);
  const bool both = !third && !i.is(0) && !j.is(0);
  std::string open;
  if (both && options.count("fagor.plane_angles") == 0)
    open = "I counts from X to the line in which the plane meets the plane X Z, J from Y in Y Z";
  if (!level && options.count("fagor.plane_tilt") == 0)
    open += (open.empty() ? "" : "; ") + std::string("a positive angle rises toward the plus side of its axis");
  if (open.empty()) return;
  state_.warning(
      "FAG-102", g.word->pos, "the angles of an inclined plane: " + open + " (assumed)",
      "compare with the machine; set fagor.plane_tilt (rises, falls) and fagor.plane_angles (trace, axis) in "
      "its profile, or write A B C");
}

}  // namespace cnctrans::fagor
