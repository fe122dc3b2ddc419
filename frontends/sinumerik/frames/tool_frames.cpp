// Frames by the direction of the tool (TOFRAME, TOROT) and of swivelled planes (CYCLE800): a shift and a turn between
// the settable and the programmable frame. The direction is followed in the order of the text (motion reference 7.7,
// 10.2; language reference 18.5).
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/state/words.h"
#include "frontends/sinumerik/statements/row_parts.h"
#include "frontends/sinumerik/values/angles.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;
using syntax::Word;

namespace {

std::shared_ptr<ir::FrameChange> cleared(ir::FrameSlot slot) {
  auto out = std::make_shared<ir::FrameChange>();
  out->slot = slot;
  out->combine = ir::FrameCombine::clear;
  return out;
}

std::shared_ptr<ir::FrameChange> turn(ir::AxisId about, double angle, ir::FrameCombine combine) {
  auto out = std::make_shared<ir::FrameChange>();
  out->slot = ir::FrameSlot::rotation;
  out->kind = ir::FrameKind::rotate;
  out->combine = combine;
  out->has_angle = true;
  out->angle = ir::Value(angle);
  out->rotation_axis = about;
  return out;
}

struct Turn {
  ir::AxisId axis;
  double angle;  ///< degrees
};

/// The turns, each about the axes that the ones before have made, that bring axis `along` into the direction `v`. The
/// axis behind it in the order X Y Z X stays in the old plane of these two.
std::array<Turn, 2> turns_to(ir::AxisId along, const std::array<double, 3>& v) {
  const auto next = static_cast<ir::AxisId>((along + 1) % 3), last = static_cast<ir::AxisId>((along + 2) % 3);
  return {Turn{last, degrees * std::atan2(v[next], v[along])},
          Turn{next, -degrees * std::asin(std::clamp(v[last], -1.0, 1.0))}};
}

}  // namespace

/// A3=, B3=, LEAD= and their like: the orientation of the tool, kept; the position of its tip is in the other words.
void WordLowering::orientation(const Word& w) {
  push(ir::OpaqueWord{c_.slice(w.pos)}, Rank::setting, ir::Order::before, w.pos);
  constexpr std::int32_t direction = 3;
  const char letter = w.address.size() == 1 ? w.address[0] : '\0';
  const int part = letter >= 'a' ? letter - 'a' : letter - 'A';
  if (w.extension == direction && !w.is_expression && part >= 0 && part < 3) {
    vector_[static_cast<std::size_t>(part)] = w.number;
    has_vector_ = true;
  } else {
    other_orientation_ = true;
  }
  if (c_.first_time("A3=")) {
    c_.note(
        "SIN-009", w.pos,
        std::string(c_.slice(w.pos)) + ": the orientation of the tool is kept as text; positions are those of its tip");
  }
}

/// What the block's words say of the tool's direction holds from its end on.
void WordLowering::finish_orientation() {
  if (!has_vector_ && !other_orientation_) return;
  c_.tool.has_outside = false;
  const double length = std::hypot(vector_[0], vector_[1], vector_[2]);
  const bool oriented = c_.tool.state != ToolDirection::State::normal;
  if (other_orientation_ || length == 0 || !oriented) {
    if (oriented) c_.tool.state = ToolDirection::State::unsure;
    return;
  }
  c_.tool.state = ToolDirection::State::known;
  for (std::size_t i = 0; i < 3; ++i) c_.tool.vector[i] = vector_[i] / length;
}

/// TOROT turns the coordinates so that an axis points along the tool, TOFRAME puts their origin to its tip as well.
void WordLowering::tool_frame(const GFunction& g, WordPos pos) {
  constexpr std::uint8_t off = 3;
  const bool ends = g.a == off;
  if (ends && !c_.tool_frame) {
    push(ir::OpaqueWord{c_.slice(pos)}, Rank::setting, ir::Order::with, pos);
    return c_.note("SIN-009", pos, std::string(g.name) + " is kept as text: no frame of the tool is in force");
  }
  const auto add = [&](std::shared_ptr<const ir::FrameChange> change) {
    push(ir::FrameOp{std::move(change)}, Rank::setting, ir::Order::before, pos);
  };
  push(ir::OpaqueWord{c_.slice(pos)}, Rank::setting, ir::Order::after, pos);
  if (ends) {
    add(cleared(ir::FrameSlot::shift));
    add(cleared(ir::FrameSlot::rotation));
    c_.tool_frame = false;
    if (c_.tool.state != ToolDirection::State::known) return;
    if (!c_.tool.has_outside) c_.tool.state = ToolDirection::State::unsure;
    c_.tool.vector = c_.tool.outside;
    return;
  }
  const bool upright = c_.tool.state == ToolDirection::State::normal;
  const bool other = c_.other_plane || c_.machine.profile->power_on.plane != ir::Plane::xy;
  if (c_.tool.state == ToolDirection::State::unsure || (upright && other))
    return refuse("motion.transformation", pos, std::string(g.name) + ": the text does not tell where the tool points",
                  "write the direction (A3= B3= C3=) between TRAORI and this block, without a jump or a call between");
  if (c_.framed || (c_.tool_frame && g.b != 0))
    return refuse("motion.transformation", pos,
                  std::string(g.name) + " while another frame is in force is not carried yet");
  if (g.b != 0) {
    auto shift = std::make_shared<ir::FrameChange>();
    shift->slot = ir::FrameSlot::shift;
    for (const ir::AxisId axis : {ir::axis::x, ir::axis::y, ir::axis::z}) {
      if (c_.machine.profile->axis(axis) == nullptr) continue;
      ir::SystemRef here;
      here.datum = ir::Datum::programmed_position;
      here.axis = axis;
      here.text = "$P_EP";
      shift->words.push_back(
          ir::FrameWord{axis, ir::Value(make_expr(std::move(here), ir::Type::real, pos)), ir::WordScale::modal, pos});
    }
    add(std::move(shift));
  }
  const auto vector = upright ? std::array<double, 3>{0, 0, 1} : c_.tool.vector;
  constexpr double nothing = 1e-12;
  for (const Turn& t : turns_to(g.a, vector)) {
    if (std::abs(t.angle) > nothing) add(turn(t.axis, t.angle, ir::FrameCombine::compose));
  }
  if (!c_.tool_frame) {
    c_.tool.outside = vector;
    c_.tool.has_outside = true;
  }
  c_.tool_frame = true;
  c_.tool.vector = {0, 0, 0};  // it points along this axis of the new coordinates
  c_.tool.vector[g.a] = 1;
  if (c_.first_time("TOROT")) {
    c_.warning("SIN-052", pos,
               std::string(g.name) +
                   ": the other two axes are taken as turned by the least angles; on the machine data (MD21110, "
                   "SD42980) depends where they point");
  }
}

/// PAROT: with a carrier chosen, the turn of its table is added behind the block (lower_carrier.cpp).
void WordLowering::table_frame(WordPos pos) {
  const bool carrier = c_.carrier.chosen.value_or(0) > 0;
  if (!carrier && c_.carrier.chosen != 0 && c_.tool.state != ToolDirection::State::normal)
    return refuse("motion.transformation", pos, "PAROT of an orientable table is not carried yet");
  std::string why;
  const auto turn = carrier ? c_.table_turn(why) : std::optional(std::array<double, 3>{});
  if (!turn) {
    return refuse(
        "motion.transformation", pos, "PAROT is not carried: " + why,
        "data: $TC_CARR23[n] (T, P or M), angles and directions, in the program or under \"data\" in the profile "
        "(a letter by its code); sense: the option sinumerik.table_turn");
  }
  push(ir::OpaqueWord{c_.slice(pos)}, Rank::setting, ir::Order::with, pos);
  if (*turn != std::array<double, 3>{})
    return c_.warning(
        "SIN-141", pos,
        "PAROT turns the coordinates with the table of tool carrier " + std::to_string(*c_.carrier.chosen) +
            ": about Z by " + shortest((*turn)[2]) + ", the new Y by " + shortest((*turn)[1]) + ", the new X by " +
            shortest((*turn)[0]) +
            " degrees, as its angles in $TC_CARR13 and $TC_CARR14 say; where the table takes the part is not "
            "computed");
  c_.note("SIN-009", pos,
          carrier ? "PAROT is kept as text: the table of the tool carrier is not turned"
                  : "PAROT is kept as text: no carrier is selected, so it turns nothing");
}

// --- swivelled planes -------------------------------------------------------------------------------------------

bool StatementLowering::swivel_end(WordPos pos, Parts& parts) {
  if (!c_.tool_frame) return without_effect("CYCLE800", pos, parts);
  const auto add = [&](ir::ActionData data) { parts.act(std::move(data), pos, c_.slice(pos)); };
  add(ir::FrameOp{cleared(ir::FrameSlot::shift)});
  add(ir::FrameOp{cleared(ir::FrameSlot::rotation)});
  c_.tool_frame = false;
  return true;
}

/// CYCLE800(FR,TC,ST,MODE,X0,Y0,Z0,A,B,C,X1,Y1,Z1,DIR,..), axis by axis: shift to X0 Y0 Z0, the three turns, each about
/// the new axes, shift by X1 Y1 Z1 in the turned coordinates. Turned about Z alone the tool stays upright, and a shift
/// and a rotation say all of it; tilted, the tool stands otherwise too.
bool StatementLowering::swivel(const std::vector<Expr>& args, WordPos pos, Parts& parts) {
  constexpr std::size_t fr = 0, st = 2, mode = 3, before = 4, angle = 7, behind = 10, used = 14;
  std::array<double, used> v{};
  for (std::size_t i = 0; i < std::min(args.size(), used); ++i) {
    if (i == 1 || args[i].kind == ExprKind::missing) continue;
    const auto e = exprs_.lower_as(args[i], ir::Type::real);
    const auto value = e ? ir::constant_value(e) : std::nullopt;
    if (!e) return false;
    if (!value) return refuse("motion.transformation", args[i].pos, "CYCLE800 with computed values is not carried yet");
    v[i] = *value;
  }
  const auto why = [&]() -> std::string_view {
    if (std::fmod(v[st], 100) > 1) return "aligns the tool";
    if (v[mode] < 0 || v[mode] >= 64) return "is given by solid, projected or direct angles";
    if (c_.framed || (c_.tool_frame && std::fmod(v[st], 10) == 1)) return "acts in another frame of the program";
    return {};
  }();
  if (!why.empty())
    return refuse("motion.transformation", pos, "CYCLE800 is not carried yet where it " + std::string(why));
  const auto code = saturate<unsigned>(v[mode]);
  const std::array<unsigned, 3> order{code & 3U, (code >> 2U) & 3U, (code >> 4U) & 3U};
  std::array<std::array<double, 3>, 3> m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < 3; ++i) {
    if (v[angle + i] == 0) continue;
    if (order[i] == 0) {
      c_.error("SIN-021", args[mode].pos, "MODE of CYCLE800 names no axis for this angle");
      return false;
    }
    const auto axis = static_cast<ir::AxisId>(order[i] - 1);
    turns.push_back({axis, v[angle + i]});
    const std::size_t a = (axis + 1U) % 3, b = (axis + 2U) % 3;
    const double c = std::cos(v[angle + i] / degrees), s = std::sin(v[angle + i] / degrees);
    for (auto& row : m) {  // the turn about the new axis acts inside of those before
      const double ra = row[a], rb = row[b];
      row[a] = ra * c + rb * s;
      row[b] = rb * c - ra * s;
    }
  }
  const auto add = [&](ir::ActionData data) -> ir::Action& { return parts.act(std::move(data), pos, c_.slice(pos)); };
  const bool tilted = std::any_of(turns.begin(), turns.end(), [](const Turn& t) { return t.axis != ir::axis::z; });
  if (tilted) add(ir::OpaqueWord{c_.slice(pos)}).order = ir::Order::after;
  auto shift = std::make_shared<ir::FrameChange>();
  shift->slot = ir::FrameSlot::shift;
  for (const ir::AxisId axis : {ir::axis::x, ir::axis::y, ir::axis::z}) {
    if (c_.machine.profile->axis(axis) == nullptr) continue;
    double to = v[before + axis];
    for (std::size_t k = 0; k < 3; ++k) to += m[axis][k] * v[behind + k];
    shift->words.push_back(ir::FrameWord{axis, ir::Value(to), ir::WordScale::radius, pos});
  }
  add(ir::FrameOp{std::move(shift)});
  add(ir::FrameOp{cleared(ir::FrameSlot::rotation)});
  for (const Turn& t : turns) add(ir::FrameOp{turn(t.axis, t.angle, ir::FrameCombine::compose)});
  c_.tool_frame = true;
  if (tilted) c_.tool.state = ToolDirection::State::unsure;
  c_.warning(
      "SIN-053", pos,
      std::string("positions are those of the swivelled plane; how the rotary axes of the machine turn, and where a "
                  "table takes the part, is not computed") +
          (v[fr] != 0 ? "; the retraction before it, to a position that the machine knows, is not shown" : ""),
      v[fr] != 0 ? "write every axis in the first block behind it" : "");
  return true;
}

}  // namespace cnctrans::sinumerik
